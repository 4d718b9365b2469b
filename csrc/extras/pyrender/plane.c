/* Planes: weights of a triangle's corners at any point of the picture, without clipping (Olano and Greer 1997). */
#include <math.h>

#include "extras/pyrender/picture.h"

/* How many vertices a primitive has. */
static int corners_count(int32_t mode)
{
    if (mode == E3D_PYR_TRIANGLES)
        return 3;
    return mode == E3D_PYR_LINES ? 2 : 1;
}

void pyr_corners(const e3d_pyr_draw *draw, int32_t number, int32_t out[3])
{
    int size = corners_count(draw->mode);
    for (int k = 0; k < 3; k++)
        out[k] = draw->indices[(size_t)number * (size_t)size + (size_t)(k < size ? k : 0)];
}

void pyr_set_plane(const e3d_pyr_frame *frame, const e3d_pyr_draw *draw, const pyr_vertex *vertices, int32_t triangle,
                   pyr_plane *out)
{
    double across = 2.0 / frame->width, down = -2.0 / frame->height;
    pyr_corners(draw, triangle, out->corner);
    for (int k = 0; k < 3; k++)
        out->vertex[k] = &vertices[out->corner[k]];
    for (int k = 0; k < 3; k++) {
        const double *a = out->vertex[(k + 1) % 3]->clip, *b = out->vertex[(k + 2) % 3]->clip;
        double cx = a[1] * b[3] - a[3] * b[1], cy = a[3] * b[0] - a[0] * b[3], cw = a[0] * b[1] - a[1] * b[0];
        out->row[k][0] = cx * across;
        out->row[k][1] = cy * down;
        out->row[k][2] = (cw - cx) + cy;
    }
}

static double weigh(const pyr_plane *plane, double x, double y, double out[3])
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        out[k] = (plane->row[k][0] * x + plane->row[k][1] * y) + plane->row[k][2];
        sum += out[k];
    }
    double scale = 1 / sum, w = 0, z = 0;
    if (!(fabs(scale) < 1e300)) { /* seen from the side: any point of it will do */
        out[0] = out[1] = out[2] = 1;
        scale = 1.0 / 3;
    }
    for (int k = 0; k < 3; k++) {
        out[k] *= scale;
        w += out[k] * plane->vertex[k]->clip[3];
        z += out[k] * plane->vertex[k]->clip[2];
    }
    return z / w;
}

double pyr_weigh(const pyr_plane *plane, double x, double y, pyr_weights *out)
{
    double exact[3], z = weigh(plane, x, y, exact);
    for (int k = 0; k < 3; k++) {
        out->corner[k] = plane->corner[k];
        out->weight[k] = (float)exact[k];
    }
    return z;
}

double pyr_depth_at(const pyr_plane *plane, double x, double y)
{
    double weights[3];
    return weigh(plane, x, y, weights);
}

double pyr_depth_at_place(const pyr_picture *picture, const pyr_plane *plane, int place, int32_t x, int32_t y)
{
    return pyr_depth_at(plane, x + 0.5 + picture->sample_x[place] / 256.0, y + 0.5 + picture->sample_y[place] / 256.0);
}

int pyr_misses_band(const pyr_band *band, const pyr_vertex *vertices, const int32_t *corner, int count)
{
    double height = band->picture->frame->height;
    double high = 1 - 2 * (band->top - 1) / height, low = 1 - 2 * (band->end + 1) / height;
    int above = 1, below = 1;
    for (int k = 0; k < count; k++) {
        const double *p = vertices[corner[k]].clip;
        above &= p[1] > high * p[3];
        below &= p[1] < low * p[3];
    }
    return above || below;
}

int pyr_shows_back(const pyr_vertex *vertices, const int32_t corner[3])
{
    const double *a = vertices[corner[0]].clip, *b = vertices[corner[1]].clip, *c = vertices[corner[2]].clip;
    return a[0] * (b[1] * c[3] - b[3] * c[1]) - a[1] * (b[0] * c[3] - b[3] * c[0]) + a[3] * (b[0] * c[1] - b[1] * c[0]) <= 0;
}
