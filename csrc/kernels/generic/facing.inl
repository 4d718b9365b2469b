/* cull: backfacing clusters, told by their cones of normals, a vector of clusters at a time.
 *
 * Facing is the sign of the area between snapped corners (R9), so a cluster goes only where snapping cannot turn any of its
 * triangles. With M the linear part of the clip matrix's rows x, y, w and e the eye (where all three vanish),
 *     twice the area on the screen = 256 half_w * 256 half_h * det(M) * 2 area * n.(p - e) / (w0 w1 w2),
 * while corners that move by up to d on each axis change it by at most 2 d (width + height) + 4 d^2, for a triangle's width and
 * height on the screen: each corner moves along the edge between the two others. Both are divided by the length of an edge here.
 * Cones after Shirmun and Abi-Ezzi (1993).
 */
#pragma once

#include <math.h>
#include <stddef.h>

#include "base/limits.h"
#include "data/mesh/mesh.h"
#include "kernels/kernels.h"
#include "kernels/types/vertices.h"
#include "kernels/generic/setup.inl"

typedef struct facing_cones {
    vf32 centre[3], reach; /* the centre of the box; no vertex is farther from the origin than `reach` */
    vf32 axis[3], cosine, altitude, radius;
} facing_cones;

static inline vf32 facing_abs(vf32 a) { return v_asf(v_andi(v_asi(a), v_seti(0x7FFFFFFF))); }

/* Loads clusters; lanes beyond the last one repeat the first. */
static inline facing_cones facing_load(const e3d_cluster *clusters, int count)
{
    enum { HALF = 8,
           LO = offsetof(e3d_cluster, lo) / 4 };
    _Static_assert(LO == 4 && sizeof(e3d_cluster) == 64, "a cluster's numbers are the last twelve of sixteen words");
    const void *first[V_LANES], *second[V_LANES];
    vi32 w[2 * HALF];
    facing_cones c;
    for (int l = 0; l < V_LANES; l++) {
        first[l] = &clusters[l < count ? l : 0];
        second[l] = (const int32_t *)first[l] + HALF;
    }
    v_load_rows(first, w);
    v_load_rows(second, w + HALF);
    c.radius = v_asf(w[15]);
    c.reach = v_mul(v_setf(1.001f), c.radius);
    for (int k = 0; k < 3; k++) {
        c.centre[k] = v_mul(v_setf(0.5f), v_add(v_asf(w[LO + k]), v_asf(w[LO + 3 + k])));
        c.reach = v_add(c.reach, facing_abs(c.centre[k]));
        c.axis[k] = v_asf(w[LO + 6 + k]);
    }
    c.cosine = v_asf(w[13]);
    c.altitude = v_asf(w[14]);
    return c;
}

/* A lower bound of the eye's distance from the planes of each cluster's faces, on the side `sign`; returns the lanes in which
 * it is positive. */
static inline vmask facing_distance(const facing_cones *c, const float eye[3], float sign, vf32 *distance)
{
    vf32 along = v_setf(0), square = v_setf(0), places = v_setf(0), zero = v_setf(0);
    for (int k = 0; k < 3; k++) {
        vf32 v = v_sub(c->centre[k], v_setf(eye[k]));
        along = v_add(along, v_mul(v_mul(v_setf(sign), c->axis[k]), v));
        square = v_add(square, v_mul(v, v));
        places = v_add(places, v_add(facing_abs(c->centre[k]), facing_abs(v_setf(eye[k]))));
    }
    vf32 across = v_sqrt(v_max(v_sub(square, v_mul(along, along)), zero));
    vf32 sine = v_sqrt(v_sub(v_setf(1), v_mul(c->cosine, c->cosine))), middle = v_mul(along, c->cosine);
    vf32 rounding = v_add(v_mul(v_setf(1e-5f), v_sqrt(square)), v_mul(v_setf(1e-6f), places));
    *distance = v_sub(v_sub(v_sub(middle, v_mul(across, sine)), c->radius), rounding);
    return v_mand(v_gt(c->altitude, zero), v_gt(*distance, zero));
}

/* One clip coordinate of a cluster's vertices: its value at the box's centre, the greatest deviation from that, and the part
 * of the deviation that is rounding. */
typedef struct facing_coordinate {
    vf32 middle, spread, slack;
} facing_coordinate;

static inline facing_coordinate facing_coordinate_of(const float row[4], float length, const facing_cones *c)
{
    vf32 slack = v_mul(v_setf(0x1p-20f), v_add(v_mul(v_setf(length), c->reach), v_setf(fabsf(row[3]))));
    vf32 middle = v_add(v_mul(v_setf(row[0]), c->centre[0]), v_mul(v_setf(row[1]), c->centre[1]));
    middle = v_add(v_add(middle, v_mul(v_setf(row[2]), c->centre[2])), v_setf(row[3]));
    return (facing_coordinate){middle, v_add(v_mul(v_setf(1.001f * length), c->radius), slack), slack};
}

/* The greatest |x| / w (or |y| / w) within both the guard band and twice the picture. */
static inline float facing_within(float guard) { return guard > 2 ? 2 : 0.999f * guard; }

/* A cluster on the screen: the least and the greatest w, the greatest |x| and |y| in NDC, and how far a corner may move: by
 * snapping, by the roundings from NDC to the screen (9 * 2^-24 of the scale), and by those of the clip coordinates. */
typedef struct facing_screen {
    vf32 least, most, right, up, moved;
} facing_screen;

/* Returns the lanes in which nothing is clipped (R7) and everything lies within twice the picture. */
static inline vmask facing_screen_of(const facing_cones *c, const e3d_facing *f, const float clip[16], const e3d_viewport *viewport,
                                     facing_screen *out)
{
    facing_coordinate x = facing_coordinate_of(clip, f->length[0], c), y = facing_coordinate_of(clip + 4, f->length[1], c);
    facing_coordinate z = facing_coordinate_of(clip + 8, f->length[3], c), w = facing_coordinate_of(clip + 12, f->length[2], c);
    vf32 least = v_sub(w.middle, w.spread), most = v_add(w.middle, w.spread);
    vf32 right = v_div(v_add(facing_abs(x.middle), x.spread), least), up = v_div(v_add(facing_abs(y.middle), y.spread), least);
    vf32 across = v_div(v_add(x.slack, v_mul(right, w.slack)), least), down = v_div(v_add(y.slack, v_mul(up, w.slack)), least);
    across = v_mul(v_setf(viewport->scale_x), v_add(v_setf(0x1p-20f), across));
    down = v_mul(v_setf(viewport->scale_y), v_add(v_setf(0x1p-20f), down));
    *out = (facing_screen){least, most, right, up, v_add(v_setf(0.51f), v_max(across, down))};
    vmask apart = v_mand(v_gt(least, v_setf(E3D_W_MIN)), v_gt(least, v_mul(v_setf(0x1p-10f), most)));
    vmask inside = v_mand(v_lt(right, v_setf(facing_within(viewport->guard_x))), v_lt(up, v_setf(facing_within(viewport->guard_y))));
    return v_mand(v_mand(apart, inside), v_gt(v_sub(z.middle, z.spread), v_mul(v_setf(-0.999f), least)));
}

/* Returns the lanes whose triangles' areas exceed any change by moved corners. A lane that overflows is not among them. */
static inline vmask facing_is_sure(const facing_cones *c, const e3d_facing *f, const facing_screen *s, const e3d_viewport *viewport,
                                   vf32 distance)
{
    vf32 wide = v_mul(v_setf(viewport->scale_x), v_add(v_setf(f->length[0]), v_mul(s->right, v_setf(f->length[2]))));
    vf32 high = v_mul(v_setf(viewport->scale_y), v_add(v_setf(f->length[1]), v_mul(s->up, v_setf(f->length[2]))));
    vf32 edges = v_div(v_mul(v_mul(v_setf(2), s->moved), v_add(wide, high)), s->least);
    vf32 corners = v_div(v_mul(v_mul(v_setf(4), s->moved), s->moved), c->altitude);
    vf32 area = v_mul(v_setf(f->scale), v_div(v_mul(v_setf(f->length[0]), c->altitude), s->most));
    area = v_mul(area, v_div(v_mul(v_setf(f->length[1]), distance), s->most));
    area = v_mul(area, v_div(v_setf(f->length[2]), s->most));
    return v_mand(v_gt(area, v_mul(v_setf(1.01f), v_add(edges, corners))), v_lt(area, v_setf(0x1p126f)));
}

static uint32_t facing_away(const e3d_cluster *clusters, int count, const e3d_facing *f, int drop, const float clip[16],
                            const e3d_viewport *viewport)
{
    facing_cones c = facing_load(clusters, count);
    facing_screen screen;
    vf32 distance;
    vmask away = facing_distance(&c, f->eye, (float)(f->sign * drop), &distance);
    if (!(v_bits(away) & setup_tail(count)))
        return 0;
    away = v_mand(away, facing_screen_of(&c, f, clip, viewport, &screen));
    return v_bits(v_mand(away, facing_is_sure(&c, f, &screen, viewport, distance))) & setup_tail(count);
}

static uint32_t kernel_face_away(const e3d_cluster *clusters, int count, const e3d_facing *f, int drop, const float clip[16],
                                 const e3d_viewport *viewport)
{
    uint32_t away = 0;
    if (!f->sign || !drop)
        return 0;
#ifdef E3D_NARROW_TABLE
    if (count <= V_LANES / 2)
        return E3D_NARROW_TABLE.face_away(clusters, count, f, drop, clip, viewport);
#endif
    for (int i = 0; i < count; i += V_LANES)
        away |= facing_away(clusters + i, count - i, f, drop, clip, viewport) << i;
    return away;
}
