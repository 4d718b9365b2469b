/* The textures of a material on a batch, beside its base colour: coordinates, texels, tangents, mapped normals (R45-R48). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/texture_slots.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/texture.inl"
#include "kernels/generic/shade/texel_alpha.inl"
#include "kernels/generic/shade/anisotropic.inl"

/* ---- what surfaces bring ---- */

static inline vf32 negate_if(vmask negative, vf32 v) { return v_self(negative, v_sub(v_setf(0.0f), v), v); }

/* R47: tangents of vertices, which are directions in object space. */
static inline void slot_vertex_tangents(const e3d_surfaces *matrices, const element_lanes *lanes, e3d_texture_surfaces *m, int n)
{
    vf32 t[3][3]; /* [vertex][component] */
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            t[k][c] = v_loadf(m->tangent[c][k] + n);
    for (int row = 0; row < 3; row++) {
        vf32 world[3];
        for (int c = 0; c < 3; c++)
            world[c] = take(matrices->world[4 * row + c], lanes, lanes->same);
        for (int k = 0; k < 3; k++)
            v_storef(m->tangent[row][k] + n, dot_three(world, t[k]));
    }
}

/* R47: the tangent of a face, from its corners in world space and their coordinates. */
static inline void slot_face_tangents(const e3d_surfaces *s, e3d_texture_surfaces *m, int place, int n)
{
    vf32 u[3], v[3], p[3], zero = v_setf(0.0f);
    surface_load(m->uv[place][0], n, u);
    surface_load(m->uv[place][1], n, v);
    vf32 a = v_sub(u[1], u[0]), b = v_sub(v[1], v[0]), c = v_sub(u[2], u[0]), d = v_sub(v[2], v[0]);
    vmask turned = v_lt(v_sub(v_mul(a, d), v_mul(c, b)), zero);
    for (int row = 0; row < 3; row++) {
        surface_load(s->position[row], n, p);
        vf32 e = v_sub(p[1], p[0]), f = v_sub(p[2], p[0]);
        vf32 t = negate_if(turned, v_sub(v_mul(e, d), v_mul(f, b)));
        for (int k = 0; k < 3; k++)
            v_storef(m->tangent[row][k] + n, t);
    }
    v_storef(m->sign + n, v_self(turned, v_setf(-1.0f), v_setf(1.0f)));
}

/* Turns tangents of faces that look away, as normals are turned, and finds the signs of the bitangents. */
static inline void slot_turn(const e3d_surfaces *s, e3d_texture_surfaces *m, int n)
{
    vmask front = v_eqi(v_loadi(s->back + n), v_seti(0)), round = v_mnot(v_eqi(v_loadi(m->turned_round + n), v_seti(0)));
    vf32 zero = v_setf(0.0f), sign = negate_if(round, v_loadf(m->sign + n));
    v_storef(m->sign + n, negate_if(v_mnot(front), sign));
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) {
            vf32 t = v_loadf(m->tangent[c][k] + n);
            v_storef(m->tangent[c][k] + n, v_self(front, v_add(zero, t), v_sub(zero, t)));
        }
}

static inline void slot_slopes(const e3d_surfaces *s, e3d_texture_surfaces *m, int place, const float texels[2], int n)
{
    for (int k = 0; k < 2; k++)
        slopes_of(s, m->uv[place][k], texels[k], m->slope[place][k], n);
}

static void kernel_texture_surfaces(const e3d_surfaces *s, const e3d_read_textures *textures, e3d_texture_surfaces *m)
{
    for (int n = 0; n < s->count; n += V_LANES) {
        element_lanes lanes = elements_of(s->matrix + n);
        for (int p = 0; p < textures->place_count; p++)
            if (textures->places[p].has_level)
                slot_slopes(s, m, p, textures->places[p].texels, n);
        if (textures->tangent_place < 0)
            continue;
        if (textures->vertex_tangents)
            slot_vertex_tangents(surfaces_from(s, &lanes), &lanes, m, n);
        else
            slot_face_tangents(s, m, textures->tangent_place, n);
        slot_turn(s, m, n);
    }
}

/* ---- what samples take of it ---- */

typedef struct slot_stage {
    const e3d_read_textures *textures;
    const e3d_texture_surfaces *surfaces;
    e3d_texture_batch *out;
} slot_stage;

static ALWAYS_INLINE weight_lanes slot_weights(const e3d_batch *batch, const sample_vector *v)
{
    weight_lanes weights;
    interpolate_base(v->s, &v->elements, v->same, v_loadi(batch->sample + v->i), &weights);
    if (batch->pattern) {
        weights.dx = v_add(weights.dx, v_loadf(batch->shift[0] + v->i));
        weights.dy = v_add(weights.dy, v_loadf(batch->shift[1] + v->i));
    }
    for (int k = 0; k < 3; k++)
        weights.w[k] = v_loadf(batch->weight[k] + v->i);
    weights.r = v_loadf(batch->r + v->i);
    return weights;
}

/* R47 */
static ALWAYS_INLINE void slot_tangent(const e3d_batch *batch, const e3d_texture_surfaces *m, const weight_lanes *weights,
                                       const sample_vector *v, e3d_texture_batch *out)
{
    vf32 n[3], t[3];
    for (int c = 0; c < 3; c++) {
        n[c] = v_loadf(batch->normal[c] + v->i);
        t[c] = weighted_sum(m->tangent[c], &v->elements, v->same, weights->w);
    }
    vf32 along = dot_three(n, t);
    for (int c = 0; c < 3; c++)
        t[c] = v_sub(t[c], v_mul(n[c], along));
    unit_length(t);
    for (int c = 0; c < 3; c++)
        v_storef(out->tangent[c] + v->i, t[c]);
    v_storef(out->tangent[3] + v->i, take(m->sign, &v->elements, v->same));
}

static ALWAYS_INLINE void stage_maps(e3d_batch *batch, const sample_vector *v, const void *how)
{
    const slot_stage *stage = how;
    const e3d_read_textures *textures = stage->textures;
    const e3d_texture_surfaces *m = (const e3d_texture_surfaces *)((const float *)stage->surfaces + v->elements.first);
    weight_lanes weights = slot_weights(batch, v);
    for (int p = 0; p < textures->place_count; p++) {
        interpolate_into(stage->out->uv[p], 2, m->uv[p], &weights, v);
        if (textures->places[p].has_level)
            v_storei(stage->out->lod[p] + v->i, batch->finest ? v_seti(0) : level_of(m->slope[p], &weights, v));
    }
    if (textures->tangent_place >= 0)
        slot_tangent(batch, m, &weights, v, stage->out);
}

/* ---- texels ---- */

/* Whether two textures at one place have texels with the same numbers and weights. (Probes of anisotropic textures aren't
 * kept.) */
static inline int textures_are_alike(const e3d_read_texture *a, const e3d_read_texture *b)
{
    const e3d_texture_view *x = a->view, *y = b->view;
    return x->anisotropy == 1 && y->anisotropy == 1 && a->place == b->place && x->filter == y->filter && x->wrap[0] == y->wrap[0] && x->wrap[1] == y->wrap[1] &&
           x->channel_bits == y->channel_bits && x->level_count == y->level_count &&
           x->levels[0].width == y->levels[0].width && x->levels[0].height == y->levels[0].height;
}

static const float slot_ones[3] = {1.0f, 1.0f, 1.0f};

/* Reads a texture; its places may be known already. */
static ALWAYS_INLINE void slot_filter(texture_plan *plan, int filter, int bits, int is_found, const texture_source *from,
                                      e3d_lane_array *out)
{
    if (!is_found)
        texture_find_all(plan, filter, bits, from);
    texture_ask_all(plan, filter, bits, from->count);
    for (int i = 0; i < from->count; i += V_LANES) {
        texel_lanes texel = texture_read(plan, filter, bits, i);
        for (int k = 0; k < 3; k++)
            v_storef(out[k] + i, texel.c[k]);
    }
}

static inline void slot_texture(texture_plan *plan, const e3d_read_texture *texture, int is_found, int count,
                                e3d_texture_batch *out, e3d_lane_array *texels)
{
    const texture_source from = {out->uv[texture->place][0], out->uv[texture->place][1], out->lod[texture->place], count};
    const e3d_texture_view *view = texture->view;
    if (!is_found)
        texture_begin(plan, view, slot_ones);
    plan->view = view;
    if (view->filter == E3D_TRILINEAR)
        slot_filter(plan, E3D_TRILINEAR, 16, is_found, &from, texels);
    else if (view->filter == E3D_BILINEAR && view->channel_bits == 8)
        slot_filter(plan, E3D_BILINEAR, 8, is_found, &from, texels);
    else
        slot_filter(plan, view->filter, view->channel_bits, is_found, &from, texels);
    for (int i = 0; i < count && texture->has_alpha; i += V_LANES)
        v_storef(texels[3] + i, alpha_read(plan, view->filter, view->channel_bits, i));
}

static inline void slot_anisotropic(texture_plan *plan, const e3d_read_texture *texture, const e3d_batch *batch,
                                    const slot_stage *stage, const e3d_surfaces *surfaces,
                                    e3d_lane_array *texels)
{
    e3d_lane_array *uv = stage->out->uv[texture->place];
    const probe_source from = probes_from(batch, surfaces, stage->surfaces->slope[texture->place], uv[0], uv[1], texture->view);
    texture_begin(plan, texture->view, slot_ones);
    const probe_target to = {slot_ones, texels, texture->has_alpha ? texels[3] : NULL};
    anisotropic_read(plan, &from, &to);
}

/* Finds coordinates, tangents and texels of a batch whose weights and normals are known. */
static void kernel_read_textures(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_read_textures *textures,
                                 const e3d_texture_surfaces *m, e3d_texture_batch *out)
{
    const slot_stage stage = {textures, m, out};
    texture_plan plan;
    each_vector(batch, surfaces, stage_maps, &stage);
    for (int k = 0; k < textures->count; k++) {
        int is_found = k && textures_are_alike(&textures->read[k - 1], &textures->read[k]);
        if (textures->read[k].view->anisotropy > 1 && !batch->finest)
            slot_anisotropic(&plan, &textures->read[k], batch, &stage, surfaces, out->texel[k]);
        else
            slot_texture(&plan, &textures->read[k], is_found, batch->count, out, out->texel[k]);
    }
}

/* ---- normals ---- */

/* R48 for one vector. */
static ALWAYS_INLINE void map_normal(const e3d_texture_batch *m, const e3d_normal_texture *texture, int i, const vf32 n[3],
                                     vf32 out[3])
{
    vf32 t[3], b[3], two = v_setf(2.0f), one = v_setf(1.0f), along[3];
    for (int c = 0; c < 3; c++) {
        t[c] = v_loadf(m->tangent[c] + i);
        along[c] = v_sub(v_mul(v_mul(v_loadf(texture->texels[c] + i), v_setf(texture->unit)), two), one);
    }
    for (int c = 0; c < 2; c++)
        along[c] = v_mul(along[c], v_setf(texture->scale));
    cross_three(n, t, b);
    vf32 sign = v_loadf(m->tangent[3] + i);
    for (int c = 0; c < 3; c++)
        out[c] = v_add(v_add(v_mul(t[c], along[0]), v_mul(v_mul(b[c], sign), along[1])), v_mul(n[c], along[2]));
    unit_length(out);
}

static void kernel_map_normals(e3d_batch *batch, const e3d_normal_texture *surface, const e3d_normal_texture *coat,
                               e3d_texture_batch *m)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 n[3], mapped[3];
        for (int c = 0; c < 3; c++) {
            n[c] = v_loadf(batch->normal[c] + i);
            v_storef(m->shading_normal[c] + i, n[c]);
        }
        if (surface->texels) {
            map_normal(m, surface, i, n, mapped);
            for (int c = 0; c < 3; c++)
                v_storef(batch->normal[c] + i, mapped[c]);
        }
        if (coat->texels) {
            map_normal(m, coat, i, n, mapped);
            for (int c = 0; c < 3; c++)
                v_storef(m->coat_normal[c] + i, mapped[c]);
        }
    }
}

/* R46: out = texel * factor of each lane, or the factor. */
static ALWAYS_INLINE vf32 varying_at(const e3d_varying *varying, int i)
{
    vf32 factor = v_setf(varying->factor);
    return varying->lanes ? v_mul(v_loadf(varying->lanes + i), factor) : factor;
}

/* Finds the numbers of a batch. */
static void kernel_varying(const e3d_varying *varying, int count, float *out)
{
    for (int i = 0; i < count; i += V_LANES)
        v_storef(out + i, varying_at(varying, i));
}
