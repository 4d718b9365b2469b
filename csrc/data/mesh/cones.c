/* The cone that holds the normals of all of a cluster's triangles.
 *
 * In:  a cluster of a 3-component mesh, with its positions, indices and box.
 * Out: its axis, cosine, altitude and radius; none (an altitude of 0) where a triangle's facing isn't sure.
 * Always: in float32, of positions scaled by a power of two to a box of about 1, so that nothing overflows. A normal is off by
 *      up to 6 * 2^-24 * longest edge^2, which is at least 2.5 times allowed for (ALLOWED).
 */
#include <math.h>
#include <string.h>

#include "data/mesh/clusters.h"
#include "data/triangles.h"

#define ALLOWED 0x1p-20f

static void gather(const e3d_cluster *c, e3d_triangles *out)
{
    const uint8_t *indices = e3d_cluster_indices(c, 3);
    for (int k = 0; k < 3; k++)
        for (int t = 0; t < E3D_CLUSTER_TRIANGLES; t++) {
            const float *p = c->positions + indices[k * E3D_CLUSTER_TRIANGLES + t];
            out->corner[k][0][t] = p[0];
            out->corner[k][1][t] = p[c->stride];
            out->corner[k][2][t] = p[2 * c->stride];
        }
}

/* A power of two that scales the box's size to between 1/2 and 1; 0 if there is none. */
static float scale_of(const e3d_cluster *c)
{
    int exponent;
    float size = 0;
    for (int k = 0; k < 3; k++)
        size = c->hi[k] - c->lo[k] > size ? c->hi[k] - c->lo[k] : size;
    if (!(size > 0x1p-120f) || !(size < 0x1p120f))
        return 0;
    frexpf(size, &exponent);
    return ldexpf(1, -exponent);
}

static float radius_of(const e3d_cluster *c)
{
    double square = 0;
    for (int k = 0; k < 3; k++)
        square += 0.25 * ((double)c->hi[k] - c->lo[k]) * ((double)c->hi[k] - c->lo[k]);
    return 1.0001f * (float)sqrt(square);
}

/* Points the axis to the middle of the box of the normals; 0 if that has no direction. The mean of the normals would follow
 * the majority, and leave a wider cone: of 50,000 clusters that face away, it finds 32,070 instead of 37,076. */
static int find_axis(const float lo[3], const float hi[3], float axis[3])
{
    double middle[3], square = 0;
    for (int k = 0; k < 3; k++) {
        middle[k] = (double)lo[k] + hi[k];
        square += middle[k] * middle[k];
    }
    for (int k = 0; k < 3 && square > 0; k++)
        axis[k] = (float)(middle[k] / sqrt(square));
    return square > 0;
}

void e3d_find_cone(e3d_cluster *c)
{
    e3d_triangles triangles;
    float scale = scale_of(c), least = INFINITY, cosine = 1;
    float normal[3][E3D_CLUSTER_TRIANGLES], unsure[E3D_CLUSTER_TRIANGLES], altitude[E3D_CLUSTER_TRIANGLES];
    float lo[3] = {1, 1, 1}, hi[3] = {-1, -1, -1};
    c->altitude = 0;
    if (scale == 0)
        return;
    gather(c, &triangles);
    for (int t = 0; t < c->triangles; t += 4) {
        e3d_areas areas = e3d_areas_of(&triangles, t, scale);
        float4 area = root_of(areas.square);
        for (int k = 0; k < 3; k++)
            store4(normal[k] + t, areas.normal[k] / area);
        store4(unsure + t, choose(areas.square > splat(1e-30f), splat(ALLOWED) * areas.longest / area, splat(1)));
        store4(altitude + t, areas.square / areas.longest);
    }
    for (int t = 0; t < c->triangles; t++) {
        if (!(unsure[t] < 0.1f)) /* a NaN, too */
            return;
        float square = altitude[t] * (1 - unsure[t]) * (1 - unsure[t]);
        least = square < least ? square : least;
        for (int k = 0; k < 3; k++) {
            lo[k] = normal[k][t] < lo[k] ? normal[k][t] : lo[k];
            hi[k] = normal[k][t] > hi[k] ? normal[k][t] : hi[k];
        }
    }
    if (!find_axis(lo, hi, c->axis))
        return;
    for (int t = 0; t < c->triangles; t++) {
        float along = normal[0][t] * c->axis[0] + normal[1][t] * c->axis[1] + normal[2][t] * c->axis[2] - unsure[t];
        cosine = along < cosine ? along : cosine;
    }
    c->cosine = cosine - 1e-5f;
    c->radius = radius_of(c);
    c->altitude = c->cosine > 0 ? 0.999f * sqrtf(least) / scale : 0;
}
