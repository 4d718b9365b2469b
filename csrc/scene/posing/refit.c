/* refit: updates the clusters, groups and boxes of a posed mesh after its vertices moved.
 * In: positions of the vertices, and the vertices that each cluster was made from. Out: the clusters' positions and boxes;
 * boxes of groups and of the mesh; normals of faces (R75). */
#include <math.h>
#include <string.h>

#include "data/bounds.h"
#include "base/vectors.h"
#include "scene/posing/rest.h"

static inline float least_lane(float4 v)
{
    float a = v[0] < v[1] ? v[0] : v[1], b = v[2] < v[3] ? v[2] : v[3];
    return a < b ? a : b;
}

static void bound_slowly(e3d_cluster *c)
{
    int32_t any = 0;
    memset(c->lo, 0, sizeof c->lo);
    memset(c->hi, 0, sizeof c->hi);
    for (int v = 0; v < c->vertices; v++) {
        const float p[3] = {c->positions[v], c->positions[c->stride + v], c->positions[2 * c->stride + v]};
        e3d_grow_bounds(p, c->lo, c->hi, &any);
    }
    c->any_finite = (uint8_t)any;
}

/* Finds box and positions in one pass; if one isn't finite, the box is found vertex by vertex. */
static void refit_cluster(const int32_t *members, const float *positions, e3d_cluster *c, float *out)
{
    float4 lo[3], hi[3], none = splat(0), row[4], column[3];
    for (int k = 0; k < 3; k++)
        lo[k] = hi[k] = splat(positions[3 * (size_t)members[0] + (size_t)k]);
    for (int v = 0; v < c->stride; v += 4) {
        for (int i = 0; i < 4; i++)
            row[i] = load4(positions + 3 * (size_t)members[v + i]);
        columns_of(row, column);
        for (int k = 0; k < 3; k++) {
            store4(out + k * c->stride + v, column[k]);
            lo[k] = less_of(column[k], lo[k]);
            hi[k] = more_of(column[k], hi[k]);
            none += column[k] - column[k]; /* 0, or a NaN */
        }
    }
    c->any_finite = 1;
    c->altitude = 0; /* no cone: finding one takes as long as everything else, and setup drops backfaces faster */
    for (int k = 0; k < 3; k++) {
        c->lo[k] = least_lane(lo[k]);
        c->hi[k] = -least_lane(-hi[k]);
    }
    if (!((none[0] + none[1]) + (none[2] + none[3]) == 0))
        bound_slowly(c);
}

void e3d_refit_clusters(const e3d_rest *rest, e3d_mesh *posed, int32_t first, int32_t count)
{
    for (int32_t i = first; i < first + count; i++) {
        e3d_cluster *c = &posed->clusters[i];
        float *out = posed->slabs[0] + (c->positions - posed->slabs[0]);
        refit_cluster(rest->members + rest->member_starts[i], posed->desc.positions, c, out);
    }
}

static void refit_groups(e3d_mesh *posed)
{
    for (int32_t i = 0; i < posed->group_count; i++) {
        e3d_group_box *group = &posed->groups[i];
        group->any_finite = 0;
        memset(group->lo, 0, sizeof group->lo);
        memset(group->hi, 0, sizeof group->hi);
        for (int32_t k = 0; k < group->clusters; k++) {
            const e3d_cluster *c = &posed->clusters[group->first_cluster + k];
            if (c->any_finite) {
                e3d_grow_bounds(c->lo, group->lo, group->hi, &group->any_finite);
                e3d_grow_bounds(c->hi, group->lo, group->hi, &group->any_finite);
            }
        }
    }
}

/* The unit vector along the cross product of two edges, in f64, rounded once; 0 if there is no direction. */
static void face_normal(const float *positions, const int32_t face[3], float out[3])
{
    double p[3][3], a[3], b[3];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            p[k][i] = positions[3 * (size_t)face[k] + (size_t)i];
    for (int i = 0; i < 3; i++) {
        a[i] = p[1][i] - p[0][i];
        b[i] = p[2][i] - p[0][i];
    }
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    double length = sqrt((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
    for (int i = 0; i < 3; i++)
        out[i] = length > 0 && length < INFINITY ? (float)(n[i] / length) : 0;
}

void e3d_refit_mesh(e3d_mesh *posed, double box[E3D_POSED_BOX])
{
    refit_groups(posed);
    e3d_mesh_bound(posed);
    for (int32_t f = 0; posed->desc.face_normals && f < posed->desc.faces_count; f++) {
        float *own = posed->slabs[1] + (posed->desc.face_normals - posed->slabs[1]);
        face_normal(posed->desc.positions, posed->desc.faces + 3 * (size_t)f, own + 3 * (size_t)f);
    }
    for (int k = 0; k < 3; k++) {
        double lo = posed->any_finite ? (double)posed->lo[k] : INFINITY, hi = posed->any_finite ? (double)posed->hi[k] : -INFINITY;
        box[k] = lo;
        box[3 + k] = hi;
        box[6 + k] = fabs(lo) > fabs(hi) ? fabs(lo) : fabs(hi);
    }
}
