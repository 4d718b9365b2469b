/* cull: clusters all of whose triangles face the side that is culled, told by their cone of normals.
 *
 * Facing is the sign of the area between snapped corners (R9), so a cluster goes only where snapping cannot turn any of its
 * triangles. With M the linear part of the clip matrix's rows x, y, w and e the eye (where all three vanish),
 *     twice the area on the screen = 256 half_w * 256 half_h * det(M) * 2 area * n.(p - e) / (w0 w1 w2),
 * while corners that move by up to d on each axis change it by at most 2 d (width + height) + 4 d^2, for a triangle's width and
 * height on the screen: each corner moves along the edge between the two others.
 * Cones after Shirmun and Abi-Ezzi (1993).
 */
#include <math.h>

#include "pipeline/frame.h"

static double determinant(const float *x, const float *y, const float *w)
{
    return (double)x[0] * ((double)y[1] * w[2] - (double)y[2] * w[1]) -
           (double)x[1] * ((double)y[0] * w[2] - (double)y[2] * w[0]) +
           (double)x[2] * ((double)y[0] * w[1] - (double)y[1] * w[0]);
}

static float length_of(const float v[3])
{
    return (float)sqrt((double)v[0] * v[0] + (double)v[1] * v[1] + (double)v[2] * v[2]);
}

static float row_at(const float *row, const float p[3])
{
    return row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
}

void e3d_facing_prepare(const e3d_viewport *viewport, const float clip[16], e3d_facing *out)
{
    const float *x = clip, *y = clip + 4, *w = clip + 12;
    double det = determinant(x, y, w), size = (double)length_of(x) * length_of(y) * length_of(w);
    *out = (e3d_facing){.sign = 0};
    if (!(fabs(det) > 1e-4 * size)) /* orthographic, flat, or not finite */
        return;
    /* M e = -t by Cramer's rule, a column replaced at a time. */
    for (int k = 0; k < 3; k++) {
        float a[3][3];
        for (int j = 0; j < 3; j++) {
            a[0][j] = j == k ? -x[3] : x[j];
            a[1][j] = j == k ? -y[3] : y[j];
            a[2][j] = j == k ? -w[3] : w[j];
        }
        out->eye[k] = (float)(determinant(a[0], a[1], a[2]) / det);
    }
    out->sign = det < 0 ? 1 : -1; /* the screen's Y is down */
    out->scale = fabs(det) * viewport->scale_x * viewport->scale_y;
    out->length[0] = length_of(x);
    out->length[1] = length_of(y);
    out->length[2] = length_of(w);
    out->length[3] = length_of(clip + 8);
}

/* How far from the cluster's faces' planes the eye surely is, on the side `sign`; negative if that isn't sure. */
static float distance_of(const e3d_cluster *c, const float centre[3], const float eye[3], float sign)
{
    float v[3], along = 0, square = 0, places = 0;
    for (int k = 0; k < 3; k++) {
        v[k] = centre[k] - eye[k];
        along += sign * c->axis[k] * v[k];
        square += v[k] * v[k];
        places += fabsf(centre[k]) + fabsf(eye[k]);
    }
    if (!(along * c->cosine > c->radius)) /* all that follows makes it less */
        return -1;
    float across = square - along * along, sine = sqrtf(1 - c->cosine * c->cosine);
    return along * c->cosine - (across > 0 ? sqrtf(across) : 0) * sine - c->radius -
           (1e-5f * sqrtf(square) + 1e-6f * places);
}

/* Clip coordinates of at most so many w are within the guard band, and within twice the picture. */
static float within(float guard) { return guard > 2 ? 2 : 0.999f * guard; }

/* One clip coordinate of a cluster's vertices: that of the box's centre, how far others are from it, and of that what rounding
 * may come to; `reach` is farther from the origin than any vertex. */
typedef struct coordinate {
    float middle, spread, slack;
} coordinate;

static coordinate coordinate_of(const float *row, float length, const float centre[3], float radius, float reach)
{
    float slack = 0x1p-20f * (length * reach + fabsf(row[3]));
    return (coordinate){row_at(row, centre), 1.001f * length * radius + slack, slack};
}

int e3d_faces_away(const e3d_viewport *viewport, const e3d_facing *f, const float clip[16], const e3d_cluster *c,
                   int drop)
{
    float centre[3], reach = 1.001f * c->radius;
    if (!f->sign || !drop || !(c->altitude > 0))
        return 0;
    for (int k = 0; k < 3; k++) {
        centre[k] = 0.5f * (c->lo[k] + c->hi[k]);
        reach += fabsf(centre[k]);
    }
    float distance = distance_of(c, centre, f->eye, (float)(f->sign * drop));
    if (!(distance > 0))
        return 0;
    coordinate x = coordinate_of(clip, f->length[0], centre, c->radius, reach);
    coordinate y = coordinate_of(clip + 4, f->length[1], centre, c->radius, reach);
    coordinate z = coordinate_of(clip + 8, f->length[3], centre, c->radius, reach);
    coordinate w = coordinate_of(clip + 12, f->length[2], centre, c->radius, reach);
    float least = w.middle - w.spread, most = w.middle + w.spread;
    float right = (fabsf(x.middle) + x.spread) / least, up = (fabsf(y.middle) + y.spread) / least; /* in NDC, or left and down */
    /* Nothing is clipped (R7), and all is within twice the picture. */
    if (!(least > E3D_W_MIN) || !(least > 0x1p-10f * most) || !(right < within(viewport->guard_x)) ||
        !(up < within(viewport->guard_y)) || !(z.middle - z.spread > -0.999f * least))
        return 0;
    /* Snapping, the roundings of NDC to the screen (9 * 2^-24 of the scale), and of the clip coordinates. */
    float across = viewport->scale_x * (0x1p-20f + (x.slack + right * w.slack) / least);
    float down = viewport->scale_y * (0x1p-20f + (y.slack + up * w.slack) / least), moved = 0.51f + (across > down ? across : down);
    float edges = viewport->scale_x * (f->length[0] + right * f->length[2]) +
                  viewport->scale_y * (f->length[1] + up * f->length[2]);
    double area = c->altitude * (double)distance * f->scale / ((double)most * most * most); /* float may overflow */
    return area > 1.01f * (2 * moved * edges / least + 4 * moved * moved / c->altitude);
}
