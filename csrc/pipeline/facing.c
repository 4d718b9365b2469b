/* cull: clusters all of whose triangles face the side that is culled, told by their cone of normals.
 *
 * Facing is the sign of the area between snapped corners (R9), so a cluster goes only where snapping cannot turn any of its
 * triangles. With M the linear part of the clip matrix's rows x, y, w and e the eye (where all three vanish),
 *     twice the area on the screen = 256 half_w * 256 half_h * det(M) * 2 area * n.(p - e) / (w0 w1 w2),
 * while corners that move by up to d on each axis change it by at most 4 d (|edge_x| + |edge_y|) + 8 d^2 for the longest edge.
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
static float distance_of(const e3d_cluster *c, const float centre[3], float radius, const float eye[3], float sign)
{
    float v[3], along = 0, square = 0, places = 0;
    for (int k = 0; k < 3; k++) {
        v[k] = centre[k] - eye[k];
        along += sign * c->axis[k] * v[k];
        square += v[k] * v[k];
        places += fabsf(centre[k]) + fabsf(eye[k]);
    }
    if (!(along * c->cosine > 0)) /* all that follows makes it less */
        return -1;
    float across = square - along * along, sine = sqrtf(1 - c->cosine * c->cosine);
    return along * c->cosine - (across > 0 ? sqrtf(across) : 0) * sine - radius -
           (1e-5f * sqrtf(square) + 1e-6f * places);
}

/* Clip coordinates of at most so many w are within the guard band, and within twice the picture. */
static float within(float guard) { return guard > 2 ? 2 : 0.999f * guard; }

int e3d_faces_away(const e3d_viewport *viewport, const e3d_facing *f, const float clip[16], const e3d_cluster *c,
                   int drop)
{
    float centre[3], half[3];
    if (!f->sign || !drop || !(c->altitude > 0))
        return 0;
    for (int k = 0; k < 3; k++) {
        centre[k] = 0.5f * (c->lo[k] + c->hi[k]);
        half[k] = 0.5f * (c->hi[k] - c->lo[k]);
    }
    float radius = 1.0001f * length_of(half);
    float distance = distance_of(c, centre, radius, f->eye, (float)(f->sign * drop));
    if (!(distance > 0))
        return 0;
    float terms = c->altitude, longest = f->length[0] + f->length[1] + 3 * f->length[2] + f->length[3];
    for (int k = 0; k < 3; k++)
        terms += fabsf(centre[k]) + half[k];
    float offset = fabsf(clip[3]) + fabsf(clip[7]) + fabsf(clip[11]) + 3 * fabsf(clip[15]);
    float slack = 0x1p-20f * (terms * longest + offset); /* what rounding of clip coordinates may come to */
    float w = row_at(clip + 12, centre), spread = 1.001f * f->length[2] * radius + slack;
    float least = w - spread, most = w + spread, x = fabsf(row_at(clip, centre)) + f->length[0] * radius + slack;
    float y = fabsf(row_at(clip + 4, centre)) + f->length[1] * radius + slack;
    float z = row_at(clip + 8, centre) - f->length[3] * radius - slack;
    /* Nothing is clipped (R7), and all is within twice the picture. */
    if (!(least > E3D_W_MIN) || !(least > 0x1p-10f * most) || !(x < within(viewport->guard_x) * least) ||
        !(y < within(viewport->guard_y) * least) || !(z > -0.999f * least))
        return 0;
    float larger = viewport->scale_x > viewport->scale_y ? viewport->scale_x : viewport->scale_y;
    float moved = 0.6f + larger * (0x1p-19f + slack / least);
    float edges = viewport->scale_x * (f->length[0] + 2 * f->length[2]) +
                  viewport->scale_y * (f->length[1] + 2 * f->length[2]);
    double area = c->altitude * (double)distance * f->scale / ((double)most * most * most); /* float may overflow */
    return area > 1.01f * (4 * moved * edges / least + 8 * moved * moved / c->altitude);
}
