/* setup, scalar half: finds a piece's facing, box and depth plane, makes a record of it (R8-R13), and bins it. */
#include <math.h>

#include "base/grow.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/setup.h"
#include "frame/pass/view.h"

static float clamp(float v, float lo, float hi)
{
    float t = v > lo ? v : lo;
    return t < hi ? t : hi;
}

/* Projects a vertex; 0 if it doesn't show. A clipped vertex that rounding moved off the guard band is put back on it. */
int e3d_project(const float v[4], int clipped, const e3d_viewport *viewport, e3d_corner *out)
{
    float iw = 1.0f / v[3];
    float xn = v[0] * iw, yn = v[1] * iw, zn = v[2] * iw;
    if (!isfinite(xn) || !isfinite(yn) || !isfinite(zn) || !isfinite(iw) || iw <= 0)
        return 0;
    if (clipped) {
        xn = clamp(xn, -viewport->guard_x, viewport->guard_x);
        yn = clamp(yn, -viewport->guard_y, viewport->guard_y);
    }
    out->x = (int32_t)lrintf(xn * viewport->scale_x + viewport->scale_x);
    out->y = (int32_t)lrintf(viewport->scale_y - yn * viewport->scale_y);
    out->zn = zn;
    out->iw = iw;
    return 1;
}

/* R13 */
static int depth_plane(const e3d_corner *c0, const e3d_corner *c1, const e3d_corner *c2, int64_t area,
                       const e3d_box *box, e3d_record *out)
{
    double ax = c1->x - c0->x, ay = c1->y - c0->y, cx = c2->x - c0->x, cy = c2->y - c0->y;
    double d1 = (double)c1->zn - (double)c0->zn, d2 = (double)c2->zn - (double)c0->zn;
    double r = 256.0 / (double)area;
    double gx = (d1 * cy - d2 * ay) * r, gy = (d2 * ax - d1 * cx) * r;
    double ex = (256 * box->x0 + 128 - c0->x) * (1.0 / 256), ey = (256 * box->y0 + 128 - c0->y) * (1.0 / 256);
    out->z0 = (float)((c0->zn + ex * gx) + ey * gy);
    out->gx = (float)gx;
    out->gy = (float)gy;
    float lo = c0->zn < c1->zn ? c0->zn : c1->zn, hi = c0->zn > c1->zn ? c0->zn : c1->zn;
    out->zmin = lo < c2->zn ? lo : c2->zn;
    out->zmax = hi > c2->zn ? hi : c2->zn;
    float none = (out->z0 - out->z0) + ((out->gx - out->gx) + (out->gy - out->gy));
    return none == 0.0f; /* v - v is 0 for finite v, and NaN for others */
}

static int append_corners(e3d_record_set *set, const e3d_corner *corner[3], uint32_t *meta)
{
    if (!e3d_array_reserve(&set->corners, set->corners.count + 1, 9 * sizeof(float)))
        return 0;
    float *c = (float *)set->corners.data + 9 * set->corners.count;
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++)
            c[3 * k + j] = corner[k]->c[j];
    *meta |= E3D_RECORD_CUT | (uint32_t)set->corners.count++ << E3D_RECORD_SHIFT;
    return 1;
}

static int append_key(e3d_record_set *set, const e3d_corner *corner[3])
{
    if (!e3d_array_reserve(&set->keys, set->records.count + 1, sizeof(float)))
        return 0;
    ((float *)set->keys.data)[set->records.count] = (corner[0]->zn + corner[1]->zn) + corner[2]->zn;
    return 1;
}

int e3d_records_fit(e3d_record_set *set, int id_bits, size_t more)
{
    return (set->records.count + more) >> (30 - id_bits) == 0 && /* IDs must be less than E3D_FRAGMENT_ID */
           e3d_array_reserve(&set->records, set->records.count + more, sizeof(e3d_record));
}

/* R9 */
static int is_culled(const e3d_view *view, const e3d_primitive *primitive, int front, const e3d_box *box)
{
    return (primitive->cull == E3D_CULL_BACK && !front && !e3d_meets_aperture(view, box)) ||
           (primitive->cull == E3D_CULL_FRONT && front);
}

e3d_chains *e3d_chains_of(e3d_record_set *set, int alpha) { return alpha < E3D_ALPHA_KINDS ? &set->alpha[alpha] : &set->chains; }

void e3d_emit(const e3d_prepared *pass, e3d_geometry_memory *state, const e3d_corner corner[3], const e3d_primitive *primitive)
{
    const int32_t x[3] = {corner[0].x, corner[1].x, corner[2].x};
    const int32_t y[3] = {corner[0].y, corner[1].y, corner[2].y};
    int64_t area = e3d_doubled_area(x, y);
    int front = (area < 0) != (primitive->mirrored != 0);
    e3d_box box = e3d_sample_box(x, y, &pass->view->viewport);
    if (area == 0 || is_culled(pass->view, primitive, front, &box) || primitive->alpha == E3D_ALPHA_UNSEEN)
        return;
    const e3d_corner *c[3] = {&corner[0], &corner[area < 0 ? 2 : 1], &corner[area < 0 ? 1 : 2]};
    e3d_record_set *set = &state->sets[primitive->set];
    int sorted = e3d_plans(pass, E3D_PLAN_SORTS) && primitive->set == E3D_SET_SCENE;
    if (!e3d_records_fit(set, state->id_bits, 1)) {
        state->failed = 1;
        return;
    }
    e3d_record *record = (e3d_record *)set->records.data + set->records.count;
    for (int k = 0; k < 3; k++) {
        record->x[k] = c[k]->x;
        record->y[k] = c[k]->y;
        record->iw[k] = c[k]->iw;
    }
    if (box.x0 > box.x1 || box.y0 > box.y1 ||
        !depth_plane(c[0], c[1], c[2], area < 0 ? -area : area, &box, record))
        return;
    record->order = primitive->order;
    record->meta = (front ? 0 : E3D_RECORD_BACK) | (area < 0 ? E3D_RECORD_SWAPPED : 0) |
                   (primitive->face ? E3D_RECORD_FACE : 0);
    if ((primitive->cut && !append_corners(set, c, &record->meta)) || (sorted && !append_key(set, c))) {
        state->failed = 1;
        return;
    }
    const e3d_tile_rect span = e3d_tile_rect_of(&box);
    uint32_t number = (uint32_t)set->records.count++;
    state->counters.records++;
    if (!sorted && !e3d_bin_records(pass->view, state, set, e3d_chains_of(set, primitive->alpha), number, &span, 1)) /* or after sorting */
        state->failed = 1;
}
