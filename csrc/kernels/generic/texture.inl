/* texture: samples of one texture, filtered in 16-bit linear light with 8-bit weights (R28-R30).
 *
 * Texels have a border (core/texture.c): the second of two neighbours always is the next in memory.
 */

/* R29: a texture coordinate in [0, 1]. */
static inline vf32 texture_wrap(vf32 s, int wrap)
{
    vf32 one = v_setf(1.0f);
    s = v_min(v_max(s, v_setf(-0x1p22f)), v_setf(0x1p22f));
    if (wrap == E3D_REPEAT)
        return v_sub(s, v_floor(s));
    if (wrap == E3D_CLAMP)
        return v_min(v_max(s, v_setf(0.0f)), one);
    vf32 half = v_mul(s, v_setf(0.5f));
    vf32 m = v_mul(v_sub(half, v_floor(half)), v_setf(2.0f));
    return v_self(v_gt(m, one), v_sub(v_setf(2.0f), m), m);
}

/* The first of the two columns (rows) of one coordinate, of each lane's level, and the weight of the second. The border
 * counts: column -1 is 0. */
typedef struct texture_taps {
    vi32 first, weight;
} texture_taps;

/* `scale`: 256 times the level's size. */
static inline texture_taps texture_linear(vf32 s, vf32 scale)
{
    vi32 p = v_addi(v_rint(v_mul(s, scale)), v_seti(128));
    return (texture_taps){v_sra(p, 8), v_andi(p, v_seti(255))};
}

/* Where a batch's samples fall: numbers of the left texels, above and below, and the weights of the right and the lower
 * ones. Each row's weight is below 256: where only the upper counts, both are it. All are found, and fetched, before any
 * texel is read: processors don't look far enough ahead to do both at a time. */
typedef struct texture_places {
    int32_t top[E3D_BATCH + E3D_PAD], bottom[E3D_BATCH + E3D_PAD];
    int32_t across[E3D_BATCH + E3D_PAD], down[E3D_BATCH + E3D_PAD];
    uint32_t quads[E3D_BATCH + E3D_PAD][4]; /* texels of 8-bit channels: upper left, upper right, lower left, lower right */
} texture_places;

/* The levels of one vector's lanes: texels before it, from row to row, and its size times 256. */
typedef struct level_lanes {
    vi32 start, stride;
    vf32 scale[2];
} level_lanes;

static ALWAYS_INLINE void texture_place(const level_lanes *level, vf32 s, vf32 t, texture_places *places, int i)
{
    texture_taps x = texture_linear(s, level->scale[0]), y = texture_linear(t, level->scale[1]);
    vi32 top = v_addi(v_addi(level->start, x.first), v_madd16(y.first, level->stride)); /* of 16 bits each: E3D_MAX_TEXTURE_SIZE */
    v_storei(places->top + i, top);
    v_storei(places->bottom + i, v_seli(v_gti(y.weight, v_seti(0)), v_addi(top, level->stride), top));
    v_storei(places->across + i, x.weight);
    v_storei(places->down + i, v_maxi(y.weight, v_seti(1)));
}

/* Channels of one vector of texels, 16 bits each in 32. */
typedef struct texel_lanes {
    vi32 c[3];
} texel_lanes;

/* 256 - weight in the low half, weight in the high one. */
static inline vi32 texture_weights(vi32 weight)
{
    return v_addi(v_subi(v_shl(weight, 16), weight), v_seti(256));
}

/* The products of v_madd16 are of signed 16 bits: channels are shifted down by 32768 before, the sum up by 256 * 32768. */
static inline vi32 texture_signed(vi32 pair) { return v_xori(pair, v_seti((int32_t)0x80008000)); }

enum { TEXTURE_BIAS = 256 * 32768 };

static inline texel_lanes texture_mix16(const void *texels, const int32_t *top, const int32_t *bottom,
                                        vi32 across, vi32 down)
{
    texel_lanes t;
    vi32 upper[3], lower[3], weights = texture_weights(across);
    v_pairs16(texels, top, upper);
    v_pairs16(texels, bottom, lower);
    for (int k = 0; k < 3; k++) { /* h0 (256 - f) + h1 f = 256 h0 + (h1 - h0) f, and the bias stays in h0 */
        vi32 h0 = v_madd16(texture_signed(upper[k]), weights);
        vi32 h1 = v_madd16(texture_signed(lower[k]), weights);
        vi32 sum = v_addi(v_shl(h0, 8), v_muli(v_subi(h1, h0), down));
        t.c[k] = v_shr(v_addi(sum, v_seti((int32_t)(256u * TEXTURE_BIAS + 32768u))), 16);
    }
    return t;
}

/* 256 - weight and weight, which is not 0, in the bytes of both halves. */
static inline vi32 texture_weights8(vi32 weight)
{
    vi32 both = v_addi(v_subi(v_shl(weight, 8), weight), v_seti(256));
    return v_ori(both, v_shl(both, 16));
}

/* Of 8-bit channels, which stand for c * 257: blended in 8 bits, a factor of 257 at the end. Channels are shifted down by 128
 * before, for v_madd8 and v_madd16 are of signed bytes and halves; the sum up by 65536 * 128. */
static ALWAYS_INLINE vi32 texture_blend8(vi32 four, vi32 across, vi32 down)
{
    vi32 sum = v_madd16(v_madd8(down, v_xori(four, v_seti((int32_t)0x80808080))), across);
    const uint32_t bias = 257u * TEXTURE_BIAS + 32768u;
    return v_shr(v_addi(v_addi(v_shl(sum, 8), sum), v_seti((int32_t)bias)), 16);
}

static ALWAYS_INLINE texel_lanes texture_mix8(const void *quads, vi32 across, vi32 down)
{
    vi32 four[3];
    texel_lanes t;
    v_quads8(quads, four);
    vi32 weights = texture_weights(across), weights_down = texture_weights8(down);
    for (int k = 0; k < 3; k++)
        t.c[k] = texture_blend8(four[k], weights, weights_down);
    return t;
}

static ALWAYS_INLINE texel_lanes texture_mix(const void *texels, int texel_bytes, const texture_places *places, int i)
{
    vi32 across = v_loadi(places->across + i), down = v_loadi(places->down + i);
    return texel_bytes == 4
               ? texture_mix8(places->quads + i, across, down)
               : texture_mix16(texels, places->top + i, places->bottom + i, across, down);
}

static inline vi32 texture_blend(vi32 a, vi32 b, vi32 weight)
{
    return v_addi(v_muli(a, v_subi(v_seti(256), weight)), v_muli(b, weight));
}

/* All levels, to look up by lane. */
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
    return (level_lanes){v_seti(levels->start[l]), v_seti(levels->stride[l]),
                         {v_setf(levels->scale[0][l]), v_setf(levels->scale[1][l])}};
}

/* Each lane at its own level; mostly all are at `guess`, and looking up is slow. */
static inline level_lanes texture_levels_of(const texture_levels *levels, vi32 level, int guess)
{
    if (!v_any(v_mnot(v_eqi(level, v_seti(guess)))))
        return texture_one_level(levels, guess);
    return (level_lanes){v_gatheri(levels->start, level), v_gatheri(levels->stride, level),
                         {v_gatherf(levels->scale[0], level), v_gatherf(levels->scale[1], level)}};
}

static inline vi32 texture_nearest_at(const e3d_level *level, vf32 s, vf32 t)
{
    vi32 x = v_mini(v_trunc(v_mul(s, v_setf((float)level->width))), v_seti(level->width - 1));
    vi32 y = v_mini(v_trunc(v_mul(t, v_setf((float)level->height))), v_seti(level->height - 1));
    vi32 one = v_seti(1), stride = v_seti(level->width + 2);
    return v_addi(v_addi(x, one), v_muli(v_addi(y, one), stride));
}

static inline texel_lanes texture_take(const void *texels, int texel_bytes, vi32 at)
{
    if (texel_bytes == 4) {
        vi32 texel = v_gatheri(texels, at), byte = v_seti(255), scale = v_seti(257);
        return (texel_lanes){{v_muli(v_andi(texel, byte), scale), v_muli(v_andi(v_shr(texel, 8), byte), scale),
                              v_muli(v_andi(v_shr(texel, 16), byte), scale)}};
    }
    vi32 red_green = v_gatheri(texels, v_shl(at, 1));
    vi32 blue_alpha = v_gatheri(texels, v_addi(v_shl(at, 1), v_seti(1))), low = v_seti(0xFFFF);
    return (texel_lanes){{v_andi(red_green, low), v_shr(red_green, 16), v_andi(blue_alpha, low)}};
}

static inline void texture_color(const texel_lanes *texel, const float base[3], vf32 color[3])
{
    for (int k = 0; k < 3; k++)
        color[k] = v_mul(v_setf(base[k]), v_mul(v_float(texel->c[k]), v_setf(E3D_UNORM16)));
}

/* Lanes after the last sample hold levels of an earlier batch, perhaps of a texture with more of them:
 * unlike coordinates, which are wrapped, those would index beyond the table of levels. */
static inline vi32 load_level(const e3d_batch *batch, int i, int level_count)
{
    vi32 last = v_seti((level_count - 1) * 256);
    return v_mini(v_maxi(v_loadi(batch->lod + i), v_seti(0)), last);
}

static inline void texture_store(e3d_batch *batch, int i, const float base[3], const texel_lanes *texel)
{
    vf32 color[3];
    texture_color(texel, base, color);
    for (int k = 0; k < 3; k++)
        v_storef(batch->color[k] + i, color[k]);
}

/* ---- every filter in three steps: find all places, fetch their texels, then read them ---- */

/* What the later steps need. */
typedef struct texture_plan {
    const e3d_texture_view *view;
    texture_levels levels;
    _Alignas(64) texture_places near, far; /* far only where its weight isn't 0: (256 a + 128) >> 8 = a */
    _Alignas(64) int32_t lod[E3D_BATCH + E3D_PAD]; /* trilinear */
} texture_plan;

static inline void texture_begin(texture_plan *plan, const e3d_texture_view *view)
{
    plan->view = view;
    texture_tabulate(view, &plan->levels);
}

/* Of one vector; lod: trilinear only. `filter` is the view's, known when compiled where it matters. */
static ALWAYS_INLINE void texture_find(texture_plan *plan, int filter, int i, vf32 u, vf32 v, vi32 lod)
{
    const e3d_texture_view *view = plan->view;
    vf32 s = texture_wrap(u, view->wrap), t = texture_wrap(v_sub(v_setf(1.0f), v), view->wrap);
    if (filter == E3D_NEAREST) {
        v_storei(plan->near.top + i, texture_nearest_at(&view->levels[0], s, t));
        return;
    }
    if (filter == E3D_BILINEAR) {
        level_lanes level = texture_one_level(&plan->levels, 0);
        texture_place(&level, s, t, &plan->near, i);
        return;
    }
    int last = view->level_count - 1;
    v_storei(plan->lod + i, lod);
    vi32 level = v_shr(lod, 8);
    int guess = plan->lod[i] >> 8;
    level_lanes near = texture_levels_of(&plan->levels, level, guess);
    texture_place(&near, s, t, &plan->near, i);
    if (v_any(v_gti(v_andi(lod, v_seti(255)), v_seti(0)))) {
        level = v_mini(v_addi(level, v_seti(1)), v_seti(last));
        level_lanes far = texture_levels_of(&plan->levels, level, guess < last ? guess + 1 : last);
        texture_place(&far, s, t, &plan->far, i);
    }
}

/* Whether some of a vector's samples are between two levels. */
static ALWAYS_INLINE int texture_is_between(const texture_plan *plan, int i)
{
    return v_any(v_gti(v_andi(v_loadi(plan->lod + i), v_seti(255)), v_seti(0)));
}

/* Neighbours mostly share a line of the cache: every fourth will do. */
static ALWAYS_INLINE void texture_prefetch(const texture_plan *plan, int count)
{
    const char *texels = plan->view->levels[0].texels;
    intptr_t bytes = plan->view->texel_bytes;
    int filter = plan->view->filter;
    for (int i = 0; i < count; i += 4) {
        __builtin_prefetch(texels + bytes * plan->near.top[i]);
        if (filter != E3D_NEAREST)
            __builtin_prefetch(texels + bytes * plan->near.bottom[i]);
        if (filter == E3D_TRILINEAR && plan->lod[i] & 255) {
            __builtin_prefetch(texels + bytes * plan->far.top[i]);
            __builtin_prefetch(texels + bytes * plan->far.bottom[i]);
        }
    }
}

/* Of one vector, to where v_quads8 expects them. */
static ALWAYS_INLINE void texture_copy(const char *texels, texture_places *places, int i)
{
    for (int lane = 0; lane < V_LANES; lane++) {
        uint32_t *quad = places->quads[i + lane % 4 * (V_LANES / 4) + lane / 4];
        memcpy(quad, texels + 4 * (intptr_t)places->top[i + lane], 8);
        memcpy(quad + 2, texels + 4 * (intptr_t)places->bottom[i + lane], 8);
    }
}

/* Of a whole batch: texels are asked for before any is needed. What limits blending are the units that put vectors together, so
 * small ones are copied then, by loads and stores alone. */
static ALWAYS_INLINE void texture_fetch(texture_plan *plan, int filter, int texel_bytes, int count)
{
    texture_prefetch(plan, count);
    if (filter == E3D_NEAREST || texel_bytes != 4)
        return;
    const char *texels = plan->view->levels[0].texels;
    for (int i = 0; i < count; i += V_LANES) {
        texture_copy(texels, &plan->near, i);
        if (filter == E3D_TRILINEAR && texture_is_between(plan, i))
            texture_copy(texels, &plan->far, i);
    }
}

/* Of one vector. `filter` and `texel_bytes` are the view's, too. */
static ALWAYS_INLINE texel_lanes texture_read(const texture_plan *plan, int filter, int texel_bytes, int i)
{
    const void *texels = plan->view->levels[0].texels;
    if (filter == E3D_NEAREST)
        return texture_take(texels, texel_bytes, v_loadi(plan->near.top + i));
    texel_lanes a = texture_mix(texels, texel_bytes, &plan->near, i);
    if (filter == E3D_BILINEAR)
        return a;
    if (texture_is_between(plan, i)) {
        vi32 weight = v_andi(v_loadi(plan->lod + i), v_seti(255));
        texel_lanes b = texture_mix(texels, texel_bytes, &plan->far, i);
        for (int k = 0; k < 3; k++)
            a.c[k] = v_shr(v_addi(texture_blend(a.c[k], b.c[k], weight), v_seti(128)), 8);
    }
    return a;
}

static ALWAYS_INLINE void texture_find_all(texture_plan *plan, int filter, const e3d_batch *batch)
{
    for (int i = 0; i < batch->count; i += V_LANES)
        texture_find(plan, filter, i, v_loadf(batch->uv[0] + i), v_loadf(batch->uv[1] + i),
                     filter == E3D_BILINEAR ? v_seti(0) : load_level(batch, i, plan->view->level_count));
}

static ALWAYS_INLINE void texture_read_all(const texture_plan *plan, int filter, int texel_bytes, const float base[3],
                                           e3d_batch *batch)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        texel_lanes texel = texture_read(plan, filter, texel_bytes, i);
        texture_store(batch, i, base, &texel);
    }
}

static void kernel_texture(e3d_batch *batch, const e3d_texture_view *view, const float base[3])
{
    texture_plan plan;
    texture_begin(&plan, view);
    if (view->filter == E3D_BILINEAR)
        texture_find_all(&plan, E3D_BILINEAR, batch);
    else
        texture_find_all(&plan, view->filter, batch);
    if (view->filter == E3D_BILINEAR && view->texel_bytes == 4) {
        texture_fetch(&plan, E3D_BILINEAR, 4, batch->count);
        texture_read_all(&plan, E3D_BILINEAR, 4, base, batch);
    } else {
        texture_fetch(&plan, view->filter, view->texel_bytes, batch->count);
        texture_read_all(&plan, view->filter, view->texel_bytes, base, batch);
    }
}
