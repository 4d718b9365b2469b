/* texture: samples of one texture, filtered in 16-bit linear light with 8-bit weights (R28-R30). */

static inline vf32 floor_lanes(vf32 v)
{
    vf32 whole = v_float(v_trunc(v));
    return v_sub(whole, v_self(v_gt(whole, v), v_setf(1.0f), v_setf(0.0f)));
}

/* R29: a texture coordinate in [0, 1]. */
static inline vf32 texture_wrap(vf32 s, int wrap)
{
    vf32 one = v_setf(1.0f);
    s = v_min(v_max(s, v_setf(-0x1p22f)), v_setf(0x1p22f));
    if (wrap == E3D_REPEAT)
        return v_sub(s, floor_lanes(s));
    if (wrap == E3D_CLAMP)
        return v_min(v_max(s, v_setf(0.0f)), one);
    vf32 half = v_mul(s, v_setf(0.5f));
    vf32 m = v_mul(v_sub(half, floor_lanes(half)), v_setf(2.0f));
    return v_self(v_gt(m, one), v_sub(v_setf(2.0f), m), m);
}

/* The two columns (rows) of one coordinate, and the weight of the second, of each lane's level. */
typedef struct texture_taps {
    vi32 first, second, weight;
} texture_taps;

static inline texture_taps texture_linear(vf32 s, vi32 size, int wrap)
{
    texture_taps taps;
    vi32 zero = v_seti(0), one = v_seti(1);
    vi32 p = v_subi(v_rint(v_mul(s, v_float(v_shl(size, 8)))), v_seti(128));
    vi32 low = v_sra(p, 8), high = v_addi(low, one), last = v_subi(size, one);
    taps.weight = v_andi(p, v_seti(255));
    if (wrap == E3D_REPEAT) {
        taps.first = v_seli(v_negi(low), v_addi(low, size), low);
        taps.second = v_seli(v_gti(high, last), v_subi(high, size), high);
    } else {
        taps.first = v_mini(v_maxi(low, zero), last);
        taps.second = v_mini(v_maxi(high, zero), last);
    }
    return taps;
}

/* Channels of one vector of texels, 16 bits each in 32. */
typedef struct texel_lanes {
    vi32 c[3];
} texel_lanes;

static inline texel_lanes texture_fetch(const uint16_t *texels, vi32 index)
{
    texel_lanes t;
    vi32 word = v_shl(index, 1);
    vi32 red_green = v_gatheri(texels, word);
    vi32 blue_alpha = v_gatheri(texels, v_addi(word, v_seti(1)));
    t.c[0] = v_andi(red_green, v_seti(0xFFFF));
    t.c[1] = v_shr(red_green, 16);
    t.c[2] = v_andi(blue_alpha, v_seti(0xFFFF));
    return t;
}

static inline vi32 texture_blend(vi32 a, vi32 b, vi32 weight)
{
    return v_addi(v_muli(a, v_subi(v_seti(256), weight)), v_muli(b, weight));
}

#ifdef V_QUADS

/* Texel numbers and weights of one vector of samples. */
typedef struct texture_footprint {
    int32_t corner[4][V_LANES]; /* upper left, upper right, lower left, lower right */
    int32_t across[V_LANES], down[V_LANES];
} texture_footprint;

static inline __m128i texture_mix(const uint16_t *texels, const texture_footprint *f, int lane)
{
    __m128i upper = quad_blend(texels, f->corner[0][lane], f->corner[1][lane], f->across[lane]);
    __m128i lower = quad_blend(texels, f->corner[2][lane], f->corner[3][lane], f->across[lane]);
    return quad_mix(upper, lower, f->down[lane]);
}

static inline texel_lanes texture_filter(const uint16_t *texels, vi32 top, vi32 bottom, texture_taps x,
                                         vi32 weight)
{
    texture_footprint f;
    int32_t planes[3][V_LANES];
    v_storei(f.corner[0], v_addi(top, x.first));
    v_storei(f.corner[1], v_addi(top, x.second));
    v_storei(f.corner[2], v_addi(bottom, x.first));
    v_storei(f.corner[3], v_addi(bottom, x.second));
    v_storei(f.across, v_ori(v_subi(v_seti(256), x.weight), v_shl(x.weight, 16)));
    v_storei(f.down, weight);
    for (int lane = 0; lane < V_LANES; lane += 4) {
        __m128i q[4];
        for (int i = 0; i < 4; i++)
            q[i] = texture_mix(texels, &f, lane + i);
        quad_store(q, planes[0] + lane, planes[1] + lane, planes[2] + lane);
    }
    return (texel_lanes){{v_loadi(planes[0]), v_loadi(planes[1]), v_loadi(planes[2])}};
}

#else

static inline texel_lanes texture_filter(const uint16_t *texels, vi32 top, vi32 bottom, texture_taps x,
                                         vi32 weight)
{
    texel_lanes a = texture_fetch(texels, v_addi(top, x.first));
    texel_lanes b = texture_fetch(texels, v_addi(top, x.second));
    texel_lanes c = texture_fetch(texels, v_addi(bottom, x.first));
    texel_lanes d = texture_fetch(texels, v_addi(bottom, x.second));
    for (int k = 0; k < 3; k++) {
        vi32 upper = texture_blend(a.c[k], b.c[k], x.weight);
        vi32 lower = texture_blend(c.c[k], d.c[k], x.weight);
        vi32 sum = v_addi(texture_blend(upper, lower, weight), v_seti(32768));
        a.c[k] = v_shr(sum, 16);
    }
    return a;
}

#endif

/* Bilinear, of levels that start at `start` texels and are width x height, per lane. */
static inline texel_lanes texture_bilinear(const uint16_t *texels, vi32 start, vi32 width, vi32 height,
                                           vf32 s, vf32 t, int wrap)
{
    texture_taps x = texture_linear(s, width, wrap), y = texture_linear(t, height, wrap);
    vi32 top = v_addi(start, v_muli(y.first, width)), bottom = v_addi(start, v_muli(y.second, width));
    return texture_filter(texels, top, bottom, x, y.weight);
}

/* Sizes and starts of all levels, to look up by lane. */
typedef struct texture_levels {
    int32_t width[E3D_MAX_LEVELS], height[E3D_MAX_LEVELS], start[E3D_MAX_LEVELS];
} texture_levels;

static inline texture_levels texture_tabulate(const e3d_texture_view *view)
{
    texture_levels t;
    for (int l = 0; l < view->level_count; l++) {
        t.width[l] = view->levels[l].width;
        t.height[l] = view->levels[l].height;
        t.start[l] = (int32_t)((view->levels[l].texels - view->levels[0].texels) / 4);
    }
    return t;
}

static inline texel_lanes texture_at_one(const e3d_texture_view *view, const texture_levels *levels,
                                         int level, vf32 s, vf32 t)
{
    return texture_bilinear(view->levels[0].texels, v_seti(levels->start[level]),
                            v_seti(levels->width[level]), v_seti(levels->height[level]), s, t,
                            view->wrap);
}

/* Each lane at its own level; mostly all are at `guess`, and looking up is slow. */
static inline texel_lanes texture_at_level(const e3d_texture_view *view, const texture_levels *levels,
                                           vi32 level, int guess, vf32 s, vf32 t)
{
    if (!v_any(v_mnot(v_eqi(level, v_seti(guess)))))
        return texture_at_one(view, levels, guess, s, t);
    return texture_bilinear(view->levels[0].texels, v_gatheri(levels->start, level),
                            v_gatheri(levels->width, level), v_gatheri(levels->height, level), s, t,
                            view->wrap);
}

static inline texel_lanes texture_trilinear(const e3d_texture_view *view, const texture_levels *levels,
                                            vi32 lod, int guess, vf32 s, vf32 t)
{
    int last = view->level_count - 1, next = guess < last ? guess + 1 : last;
    vi32 near = v_shr(lod, 8), weight = v_andi(lod, v_seti(255));
    vi32 far = v_mini(v_addi(near, v_seti(1)), v_seti(last));
    texel_lanes a = texture_at_level(view, levels, near, guess, s, t);
    if (!v_any(v_gti(weight, v_seti(0)))) /* (256 a + 128) >> 8 = a */
        return a;
    texel_lanes b = texture_at_level(view, levels, far, next, s, t);
    for (int k = 0; k < 3; k++)
        a.c[k] = v_shr(v_addi(texture_blend(a.c[k], b.c[k], weight), v_seti(128)), 8);
    return a;
}

static inline texel_lanes texture_nearest(const e3d_level *level, vf32 s, vf32 t)
{
    vi32 x = v_mini(v_trunc(v_mul(s, v_setf((float)level->width))), v_seti(level->width - 1));
    vi32 y = v_mini(v_trunc(v_mul(t, v_setf((float)level->height))), v_seti(level->height - 1));
    return texture_fetch(level->texels, v_addi(v_muli(y, v_seti(level->width)), x));
}

/* Lanes after the last sample hold levels of an earlier batch, perhaps of a texture with more of them:
 * unlike coordinates, which are wrapped, those would index beyond the table of levels. */
static inline vi32 load_level(const e3d_batch *batch, int i, int level_count)
{
    vi32 last = v_seti((level_count - 1) * 256);
    return v_mini(v_maxi(v_loadi(batch->lod + i), v_seti(0)), last);
}

static void kernel_texture(e3d_batch *batch, const e3d_texture_view *view)
{
    texture_levels levels = texture_tabulate(view);
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 s = texture_wrap(v_loadf(batch->uv[0] + i), view->wrap);
        vf32 t = texture_wrap(v_sub(v_setf(1.0f), v_loadf(batch->uv[1] + i)), view->wrap);
        texel_lanes texel;
        if (view->filter == E3D_NEAREST)
            texel = texture_nearest(&view->levels[0], s, t);
        else if (view->filter == E3D_BILINEAR)
            texel = texture_at_one(view, &levels, 0, s, t);
        else
            texel = texture_trilinear(view, &levels, load_level(batch, i, view->level_count),
                                      batch->lod[i] >> 8, s, t);
        for (int k = 0; k < 3; k++) {
            vf32 value = v_mul(v_float(texel.c[k]), v_setf(E3D_UNORM16));
            float *color = batch->color[k] + i;
            v_storef(color, v_mul(v_loadf(color), value));
        }
    }
}
