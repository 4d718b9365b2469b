/* texture: samples one texture, filtered with 8-bit weights (R28-R30). Texels have a border (data/texture.c), so the second
 * of two neighbours is always the next one in memory. */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"

/* R29: a texture coordinate in [0, 1]. */
static inline vf32 texture_wrap(vf32 s, int wrap)
{
    vf32 one = v_setf(1.0f);
    if (wrap == E3D_REPEAT)
        return v_max(v_sub(s, v_floor(s)), v_setf(0.0f));
    s = v_min(v_max(s, v_setf(-0x1p22f)), v_setf(0x1p22f));
    if (wrap == E3D_CLAMP)
        return v_min(v_max(s, v_setf(0.0f)), one);
    vf32 half = v_mul(s, v_setf(0.5f));
    vf32 m = v_mul(v_sub(half, v_floor(half)), v_setf(2.0f));
    return v_self(v_gt(m, one), v_sub(v_setf(2.0f), m), m);
}

/* The two texels along one coordinate that a filter blends, in each lane's level: the column (row) of the first, counted with
 * the border as column 0, and the weight of the second. */
typedef struct texture_taps {
    vi32 first, weight;
} texture_taps;

/* `scale`: 256 times the level's size. */
static inline texture_taps texture_linear(vf32 s, vf32 scale)
{
    vi32 p = v_addi(v_rint(v_mul(s, scale)), v_seti(128));
    return (texture_taps){v_sra(p, 8), v_andi(p, v_seti(255))};
}

/* The places of a batch's samples: the number of the upper left texel (with 16 bits, of the lower left one, too), and the
 * weights of the right and of the lower texels. All places are found and prefetched before any texel is read: a single loop
 * would not fit the out-of-order window. */
typedef struct texture_places {
    int32_t top[E3D_BATCH + E3D_PAD], bottom[E3D_BATCH + E3D_PAD];
    int32_t across[E3D_BATCH + E3D_PAD], down[E3D_BATCH + E3D_PAD];
} texture_places;

/* The level of each lane: how many texels come before it, how many lie from row to row, and its size times 256. */
typedef struct level_lanes {
    vi32 start, stride;
    vf32 scale[2];
} level_lanes;

static ALWAYS_INLINE void texture_place(const level_lanes *level, int bits, vf32 s, vf32 t, texture_places *places, int i)
{
    texture_taps x = texture_linear(s, level->scale[0]), y = texture_linear(t, level->scale[1]);
    /* Factors fit 16 bits: E3D_MAX_TEXTURE_SIZE */
    vi32 top = v_addi(v_addi(level->start, x.first), v_madd16(y.first, level->stride));
    v_storei(places->top + i, top);
    if (bits == 16)
        v_storei(places->bottom + i, v_addi(top, level->stride));
    v_storei(places->across + i, x.weight);
    v_storei(places->down + i, y.weight);
}

/* The channels of one vector of texels, in units of e3d_texture_unit. */
typedef struct texel_lanes {
    vf32 c[3];
} texel_lanes;

/* Blends texels of 16 bits. They use 15, so that their differences have a sign bit. Rows are blended first, to 15 bits again. */
static ALWAYS_INLINE texel_lanes texture_mix16(const void *texels, const int32_t *top, const int32_t *bottom, vi32 across, vi32 down)
{
    texel_lanes t;
    /* Both weights in a word: 256 - across, across */
    vi32 rows[3], weights = v_addi(v_subi(v_shl(across, 16), across), v_seti(256));
    v_rows16(texels, top, bottom, down, rows);
    for (int k = 0; k < 3; k++)
        t.c[k] = v_float(v_madd16(rows[k], weights));
    return t;
}

/* Texels of 8 bits are stored signed, since v_madd8 and v_madd16 multiply signed bytes and halves; sums are shifted back. */

/* Blends texels of 8 bits, whose rows are `stride` apart. Storing two rows side by side would save a load but take twice the
 * memory: a texture of 1024 x 1024 would no longer fit the second-level cache (0.49 instead of 0.43 ms for the head at 640 x
 * 480). */
static ALWAYS_INLINE texel_lanes texture_mix8(const char *texels, int32_t stride, const int32_t *at, vi32 across, vi32 down)
{
    texel_lanes t;
    vi32 four[3], twice = v_madd16(down, v_seti(0x0101)); /* the weight in both bytes of the lower half */
    across = v_xori(v_ori(across, v_shl(across, 16)), v_seti(0x000000FF)); /* both weights in each half: 255 - weight, weight */
    down = v_xori(v_ori(twice, v_shl(twice, 16)), v_seti(0x00FF00FF));
    v_quads8(texels, texels + 4 * (intptr_t)stride, at, four);
    for (int k = 0; k < 3; k++)
        t.c[k] = v_float(v_addi(v_madd16(v_madd8(down, four[k]), across), v_seti(128 * 255 * 255)));
    return t;
}

/* The levels of a texture as tables, indexed by lane. */
typedef struct texture_levels {
    int32_t start[E3D_MAX_LEVELS], stride[E3D_MAX_LEVELS];
    float scale[2][E3D_MAX_LEVELS];
} texture_levels;

static inline void texture_tabulate(const e3d_texture_view *view, texture_levels *out)
{
    int32_t start = 0;
    for (int l = 0; l < view->level_count; l++) {
        const e3d_level *level = &view->levels[l];
        out->start[l] = start;
        out->stride[l] = level->width + 2;
        out->scale[0][l] = (float)(256 * level->width);
        out->scale[1][l] = (float)(256 * level->height);
        start += (level->width + 2) * (level->height + 2);
    }
}

static inline level_lanes texture_one_level(const texture_levels *levels, int l)
{
    return (level_lanes){v_seti(levels->start[l]), v_seti(levels->stride[l]), {v_setf(levels->scale[0][l]), v_setf(levels->scale[1][l])}};
}

/* Looks up a number of each lane's level: in a register if a vector holds all levels, else by a gather. */
static inline vf32 level_number(const void *numbers, vi32 level)
{
    return V_LANES >= E3D_MAX_LEVELS ? v_pick(numbers, v_picker(level)) : v_asf(v_gatheri(numbers, level));
}

/* The level of each lane. Mostly all are at `guess`, and then nothing is looked up. */
static inline level_lanes texture_levels_of(const texture_levels *levels, vi32 level, int guess)
{
    if (!v_any(v_mnot(v_eqi(level, v_seti(guess)))))
        return texture_one_level(levels, guess);
    return (level_lanes){.start = v_asi(level_number(levels->start, level)),
                         .stride = v_asi(level_number(levels->stride, level)),
                         .scale = {level_number(levels->scale[0], level), level_number(levels->scale[1], level)}};
}

static inline vi32 texture_nearest_at(const e3d_level *level, vf32 s, vf32 t)
{
    vi32 x = v_mini(v_trunc(v_mul(s, v_setf((float)level->width))), v_seti(level->width - 1));
    vi32 y = v_mini(v_trunc(v_mul(t, v_setf((float)level->height))), v_seti(level->height - 1));
    vi32 one = v_seti(1), stride = v_seti(level->width + 2);
    return v_addi(v_addi(x, one), v_muli(v_addi(y, one), stride));
}

static inline texel_lanes texture_take(const void *texels, int bits, vi32 at)
{
    if (bits == 8) {
        vi32 texel = v_xori(v_gatheri(texels, at), v_seti((int32_t)0x80808080)), byte = v_seti(255);
        return (texel_lanes){{v_float(v_andi(texel, byte)), v_float(v_andi(v_shr(texel, 8), byte)),
                              v_float(v_andi(v_shr(texel, 16), byte))}};
    }
    vi32 first = v_gatheri(texels, v_shl(at, 1));
    vi32 second = v_gatheri(texels, v_addi(v_shl(at, 1), v_seti(1))), low = v_seti(0xFFFF);
    return (texel_lanes){{v_float(v_andi(first, low)), v_float(v_shr(first, 16)), v_float(v_andi(second, low))}};
}

/* Loads the levels of a vector's samples, limited to the texture's. Lanes beyond the last sample may hold a level of an
 * earlier batch, whose texture had more; it would index beyond the table. Their coordinates need no limit, since they are
 * wrapped. */
static inline vi32 load_level(const int32_t *lod, int i, int level_count)
{
    vi32 last = v_seti((level_count - 1) * 256);
    return v_mini(v_maxi(v_loadi(lod + i), v_seti(0)), last);
}

/* ---- every filter in three steps: find all places, prefetch their texels, then read them ---- */

/* The results of the first step, for the others. */
typedef struct texture_plan {
    const e3d_texture_view *view;
    float scale[3]; /* from texels to colours: the texture's unit times the material's colour */
    texture_levels levels;
    _Alignas(64) texture_places near, far; /* far: only where its weight isn't 0 */
    _Alignas(64) int32_t lod[E3D_BATCH + E3D_PAD]; /* trilinear */
} texture_plan;

static inline void texture_begin(texture_plan *plan, const e3d_texture_view *view, const float base[3])
{
    plan->view = view;
    for (int k = 0; k < 3; k++)
        plan->scale[k] = base[k] * e3d_texture_unit(view);
    texture_tabulate(view, &plan->levels);
}

/* Finds the texels of one vector; only a trilinear filter reads lod. `filter` and `bits` are the view's, as constants where
 * that matters. */
static ALWAYS_INLINE void texture_find(texture_plan *plan, int filter, int bits, int i, vf32 u, vf32 v, vi32 lod)
{
    const e3d_texture_view *view = plan->view;
    vf32 s = texture_wrap(u, view->wrap[0]), t = texture_wrap(v_sub(v_setf(1.0f), v), view->wrap[1]);
    if (filter == E3D_NEAREST) {
        v_storei(plan->near.top + i, texture_nearest_at(&view->levels[0], s, t));
        return;
    }
    if (filter == E3D_BILINEAR) {
        level_lanes level = texture_one_level(&plan->levels, 0);
        level.start = v_seti(0); /* a constant for the compiler */
        texture_place(&level, bits, s, t, &plan->near, i);
        return;
    }
    int last = view->level_count - 1;
    v_storei(plan->lod + i, lod);
    vi32 level = v_shr(lod, 8);
    int guess = plan->lod[i] >> 8;
    level_lanes near = texture_levels_of(&plan->levels, level, guess);
    texture_place(&near, bits, s, t, &plan->near, i);
    if (v_any(v_gti(v_andi(lod, v_seti(255)), v_seti(0)))) {
        level = v_mini(v_addi(level, v_seti(1)), v_seti(last));
        level_lanes far = texture_levels_of(&plan->levels, level, guess < last ? guess + 1 : last);
        texture_place(&far, bits, s, t, &plan->far, i);
    }
}

/* Where samples read a texture: their coordinates, and lod of R26. */
typedef struct texture_source {
    const float *u, *v;
    const int32_t *lod;
    int count;
} texture_source;

static ALWAYS_INLINE void texture_find_all(texture_plan *plan, int filter, int bits, const texture_source *from)
{
    for (int i = 0; i < from->count; i += V_LANES)
        texture_find(plan, filter, bits, i, v_loadf(from->u + i), v_loadf(from->v + i),
                     filter == E3D_TRILINEAR ? load_level(from->lod, i, plan->view->level_count) : v_seti(0));
}

static ALWAYS_INLINE void texture_ask(const texture_plan *plan, int filter, int bits, const texture_places *places, int i)
{
    const char *texels = plan->view->levels[0].texels;
    intptr_t size = bits / 2, top = places->top[i];
    __builtin_prefetch(texels + size * top);
    if (filter != E3D_NEAREST)
        __builtin_prefetch(texels + size * (bits == 8 ? top + plan->levels.stride[0] : places->bottom[i]));
}

/* Prefetches the texels of every fourth sample, since neighbours mostly share a cache line. Without it, a third of the time
 * of a textured model was spent waiting for texels. */
static ALWAYS_INLINE void texture_ask_all(const texture_plan *plan, int filter, int bits, int count)
{
    for (int i = 0; i < count; i += 4) {
        texture_ask(plan, filter, bits, &plan->near, i);
        if (filter == E3D_TRILINEAR && plan->lod[i] & 255)
            texture_ask(plan, filter, bits, &plan->far, i);
    }
}

/* Blends the texels of one vector. Textures of 8 bits have one level, whose stride all lanes share. */
static ALWAYS_INLINE texel_lanes texture_mix(const texture_plan *plan, int bits, const texture_places *places, int i)
{
    const void *texels = plan->view->levels[0].texels;
    vi32 across = v_loadi(places->across + i), down = v_loadi(places->down + i);
    return bits == 8 ? texture_mix8(texels, plan->levels.stride[0], places->top + i, across, down)
                     : texture_mix16(texels, places->top + i, places->bottom + i, across, down);
}

static ALWAYS_INLINE texel_lanes texture_read(const texture_plan *plan, int filter, int bits, int i)
{
    if (filter == E3D_NEAREST)
        return texture_take(plan->view->levels[0].texels, bits, v_loadi(plan->near.top + i));
    texel_lanes a = texture_mix(plan, bits, &plan->near, i);
    if (filter == E3D_BILINEAR)
        return a;
    vi32 between = v_andi(v_loadi(plan->lod + i), v_seti(255));
    if (v_any(v_gti(between, v_seti(0)))) { /* some samples are between two levels */
        texel_lanes b = texture_mix(plan, bits, &plan->far, i);
        vf32 weight = v_mul(v_float(between), v_setf(0x1p-8f));
        for (int k = 0; k < 3; k++)
            a.c[k] = v_add(a.c[k], v_mul(v_sub(b.c[k], a.c[k]), weight));
    }
    return a;
}

/* All three steps. */
static ALWAYS_INLINE void texture_filter(texture_plan *plan, int filter, int bits, e3d_batch *batch)
{
    const texture_source from = {batch->uv[0], batch->uv[1], batch->lod, batch->count};
    texture_find_all(plan, filter, bits, &from);
    texture_ask_all(plan, filter, bits, batch->count);
    for (int i = 0; i < batch->count; i += V_LANES) {
        texel_lanes texel = texture_read(plan, filter, bits, i);
        for (int k = 0; k < 3; k++)
            v_storef(batch->color[k] + i, v_mul(texel.c[k], v_setf(plan->scale[k])));
    }
}

/* The loops know filter and texels of the usual textures as constants: raw colours, and sRGB with mip levels. The latter
 * saves 3 % of the head. */
static ALWAYS_INLINE void texture_color(texture_plan *plan, e3d_batch *batch)
{
    const e3d_texture_view *view = plan->view;
    if (view->filter == E3D_BILINEAR && view->channel_bits == 8)
        texture_filter(plan, E3D_BILINEAR, 8, batch);
    else if (view->filter == E3D_TRILINEAR && view->channel_bits == 16)
        texture_filter(plan, E3D_TRILINEAR, 16, batch);
    else
        texture_filter(plan, view->filter, view->channel_bits, batch);
}
