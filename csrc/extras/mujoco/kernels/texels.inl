/* Texels on vectors (R263). What is rare is done lane by lane: colours of sRGB, and texels across the edges of cubes. */
#include "extras/mujoco/kernels/texel.h"

typedef struct texels {
    vi32 texel[4], across, down;    /* as in muj_around */
} texels;

/* ---- levels ---- */

static ALWAYS_INLINE vf32 size_of(vf32 v) { return v_max(v, v_sub(v_setf(0), v)); }

/* The level of each lane, and the share of the next one in 1/256. */
static ALWAYS_INLINE void find_level(const e3d_muj_texture *texture, vf32 detail, vi32 *number, vf32 *share)
{
    vmask enlarged = v_mnot(v_gt(detail, v_setf(1)));
    *number = v_seti(0), *share = v_setf(0);
    if (!v_any(v_mnot(enlarged)))
        return;
    vf32 lod = log2_of(v_self(v_lt(detail, v_setf(MUJ_FAR_OUT)), detail, v_setf(MUJ_FAR_OUT)));
    lod = v_self(enlarged, v_setf(0), lod);
    *number = v_trunc(lod);
    vmask last = v_mnot(v_gti(v_seti(texture->levels - 1), *number));
    *share = v_self(last, v_setf(0), v_sub(lod, v_float(*number)));
    *number = v_seli(last, v_seti(texture->levels - 1), *number);
}

/* ---- places ---- */

/* The sizes of levels, and where they begin, in texels. */
typedef struct level_table {
    float width[E3D_MUJ_LEVELS], height[E3D_MUJ_LEVELS];
    int32_t first[E3D_MUJ_LEVELS];
} level_table;

/* 0 if texels can't be numbered: the texture is too large, its levels lie too far from each other, or its faces aren't square. */
static inline int set_table(const e3d_muj_texture *texture, level_table *out)
{
    if (texture->width > 8192 || texture->height > 8192 || (texture->faces == 6 && texture->width != texture->height))
        return 0;
    for (int32_t k = 0; k < texture->levels; k++) {
        int64_t away = (int64_t)((uintptr_t)texture->level[k] - (uintptr_t)texture->level[0]);
        if (away % 4 || away / 4 < INT32_MIN / 2 || away / 4 > INT32_MAX / 2)
            return 0;
        out->first[k] = (int32_t)(away / 4);
        out->width[k] = (float)muj_level_size(texture->width, k), out->height[k] = (float)muj_level_size(texture->height, k);
    }
    return 1;
}

/* A place on a level, 0 .. 1, in 1/256 texel from the first one's centre. */
static ALWAYS_INLINE vi32 scaled(vf32 place, vf32 size)
{
    vf32 p = v_mul(v_mul(place, size), v_setf(256));
    vmask usual = v_mand(v_gt(p, v_setf(0)), v_lt(p, v_setf(0x1p30f)));
    return v_subi(v_rint(v_self(usual, p, v_setf(0))), v_seti(128));
}

static ALWAYS_INLINE void find_pair(vi32 at, vi32 size, vi32 *low, vi32 *high)
{
    vi32 first = v_sra(at, 8), next = v_addi(first, v_seti(1)), last = v_subi(size, v_seti(1));
    vi32 wrapped = v_seli(v_gti(first, last), v_subi(first, size), first);
    *low = v_seli(v_negi(first), last, wrapped);
    *high = v_seli(v_gti(next, last), v_seti(0), next);
}

static ALWAYS_INLINE void take_texels(const uint8_t *texture, vi32 first, vi32 width, const vi32 x[2], const vi32 y[2], texels *out)
{
    vi32 upper = v_addi(first, v_muli(y[0], width)), lower = v_addi(first, v_muli(y[1], width));
    out->texel[0] = v_gatheri(texture, v_addi(upper, x[0]));
    out->texel[1] = v_gatheri(texture, v_addi(upper, x[1]));
    out->texel[2] = v_gatheri(texture, v_addi(lower, x[0]));
    out->texel[3] = v_gatheri(texture, v_addi(lower, x[1]));
}

static ALWAYS_INLINE vf32 fraction_of(vf32 v) { return v_sub(v, v_floor(v)); }

static ALWAYS_INLINE void find_on_plane(const uint8_t *texture, const vf32 at[2], vf32 width, vf32 height, vi32 first, texels *out)
{
    vi32 x[2], y[2], sx = scaled(fraction_of(at[0]), width), sy = scaled(fraction_of(at[1]), height);
    find_pair(sx, v_trunc(width), &x[0], &x[1]);
    find_pair(sy, v_trunc(height), &y[0], &y[1]);
    out->across = v_andi(sx, v_seti(255)), out->down = v_andi(sy, v_seti(255));
    take_texels(texture, first, v_trunc(width), x, y, out);
}

/* ---- cubes ---- */

/* A direction's face, and its place there. */
typedef struct on_cube {
    vi32 face;
    vmask by_z, by_y;
    vf32 sign;
} on_cube;

static ALWAYS_INLINE on_cube cube_face(const vf32 d[3])
{
    vf32 x = size_of(d[0]), y = size_of(d[1]), z = size_of(d[2]), zero = v_setf(0);
    on_cube out = {.by_z = v_mand(v_ge(z, x), v_ge(z, y))};
    out.by_y = v_mandnot(v_ge(y, x), out.by_z);
    vf32 along = v_self(out.by_z, d[2], v_self(out.by_y, d[1], d[0]));
    vmask back = v_lt(along, zero);
    out.sign = v_self(back, v_setf(-1), v_setf(1));
    out.face = v_seli(out.by_z, v_seti(4), v_seli(out.by_y, v_seti(2), v_seti(0)));
    out.face = v_addi(out.face, v_seli(back, v_seti(1), v_seti(0)));
    return out;
}

/* The place of a direction on a face, 0 .. 1. Columns: of X -sign*z, of Y x, of Z sign*x; rows: of X and Z -y, of Y sign*z. */
static ALWAYS_INLINE void cube_place(const on_cube *on, const vf32 d[3], vf32 out[2])
{
    vf32 along = v_self(on->by_z, d[2], v_self(on->by_y, d[1], d[0]));
    vf32 half = v_div(v_setf(0.5f), v_mul(along, on->sign)), minus = v_setf(-1);
    vf32 column = v_self(on->by_z, v_mul(d[0], on->sign), v_self(on->by_y, d[0], v_mul(d[2], v_mul(on->sign, minus))));
    vf32 row = v_self(on->by_y, v_mul(d[2], on->sign), v_mul(d[1], minus));
    out[0] = v_add(v_mul(column, half), v_setf(0.5f));
    out[1] = v_add(v_mul(row, half), v_setf(0.5f));
}

static ALWAYS_INLINE vi32 clamp_index(vi32 v, vi32 most) { return v_maxi(v_mini(v, most), v_seti(0)); }

static ALWAYS_INLINE void find_on_cube(const e3d_muj_texture *texture, const on_cube *on, const vf32 place[2], vi32 level, vf32 size,
                                       vi32 first, texels *out)
{
    vi32 side = v_trunc(size), last = v_subi(side, v_seti(1)), sx = scaled(place[0], size), sy = scaled(place[1], size);
    vi32 x0 = v_sra(sx, 8), y0 = v_sra(sy, 8), x[2], y[2];
    out->across = v_andi(sx, v_seti(255)), out->down = v_andi(sy, v_seti(255));
    vmask crosses = v_mor(v_mor(v_negi(x0), v_negi(y0)), v_mnot(v_mand(v_gti(last, x0), v_gti(last, y0))));
    for (int k = 0; k < 2; k++) {
        x[k] = clamp_index(v_addi(x0, v_seti(k)), last);
        y[k] = clamp_index(v_addi(y0, v_seti(k)), last);
    }
    take_texels(texture->level[0], v_addi(first, v_muli(on->face, v_muli(side, side))), side, x, y, out);
    uint32_t bits = v_bits(crosses);
    if (!bits)
        return;
    int32_t levels[V_LANES], faces[V_LANES], left[V_LANES], top[V_LANES];
    uint32_t texel[4][V_LANES];
    v_storei(levels, level), v_storei(faces, on->face), v_storei(left, sx), v_storei(top, sy);
    for (int k = 0; k < 4; k++)
        v_storei(texel[k], out->texel[k]);
    for (int l = 0; l < V_LANES; l++)
        if (bits >> l & 1) {
            muj_around around;
            muj_cube_around(texture, levels[l], faces[l], left[l], top[l], &around);
            for (int k = 0; k < 4; k++)
                texel[k][l] = around.texel[k];
        }
    for (int k = 0; k < 4; k++)
        out->texel[k] = v_loadi(texel[k]);
}

/* ---- blends ---- */

/* Blends two channels, each in 16 bits. part: of b, in 1/256, for both. */
static ALWAYS_INLINE vi32 between(vi32 a, vi32 b, vi32 part)
{
    vi32 sum = v_add16(v_mul16(a, v_sub16(v_seti(0x01000100), part)), v_mul16(b, part));
    return v_shr16(v_add16(sum, v_seti(0x00800080)), 8);
}

/* A share of 0 .. 255 for two channels: its upper half counts for one more, so that 255 gives all of b. */
static ALWAYS_INLINE vi32 part_of(vi32 share)
{
    vi32 part = v_addi(share, v_shr(share, 7));
    return v_ori(part, v_shl(part, 16));
}

/* The blended channels: red and blue, green and alpha. */
static ALWAYS_INLINE void blend_texels(const texels *in, vi32 out[2])
{
    vi32 across = part_of(in->across), down = part_of(in->down), mask = v_seti(0x00FF00FF);
    for (int h = 0; h < 2; h++) {
        vi32 t[4];
        for (int k = 0; k < 4; k++)
            t[k] = v_andi(h ? v_shr(in->texel[k], 8) : in->texel[k], mask);
        out[h] = between(between(t[0], t[1], across), between(t[2], t[3], across), down);
    }
}

static ALWAYS_INLINE void sample_level(const e3d_muj_texture *texture, const level_table *table, const on_cube *on, const vf32 place[2],
                                       vi32 level, vi32 out[2])
{
    texels found;
    int32_t numbers[V_LANES];
    v_storei(numbers, level);
    vf32 width = v_setf(table->width[numbers[0]]), height = v_setf(table->height[numbers[0]]);
    vi32 first = v_seti(table->first[numbers[0]]);
    if (v_any(v_mnot(v_eqi(level, v_seti(numbers[0]))))) {
        width = v_asf(v_gatheri(table->width, level)), height = v_asf(v_gatheri(table->height, level));
        first = v_gatheri(table->first, level);
    }
    if (texture->faces == 6)
        find_on_cube(texture, on, place, level, width, first, &found);
    else
        find_on_plane(texture->level[0], place, width, height, first, &found);
    blend_texels(&found, out);
}

/* Lane by lane, as the reference does it. */
static inline void sample_lanes(const e3d_muj_texture *texture, const vf32 at[3], vi32 number, vf32 share, vf32 out[4])
{
    float place[3][V_LANES], shares[V_LANES], color[4][V_LANES];
    int32_t numbers[V_LANES];
    for (int c = 0; c < 3; c++)
        v_storef(place[c], at[c]);
    v_storef(shares, share), v_storei(numbers, number);
    for (int l = 0; l < V_LANES; l++) {
        float one[4];
        muj_sample(texture, (const float[3]){place[0][l], place[1][l], place[2][l]}, (muj_level){numbers[l], shares[l]}, one);
        for (int c = 0; c < 4; c++)
            color[c][l] = one[c];
    }
    for (int c = 0; c < 4; c++)
        out[c] = v_loadf(color[c]);
}

/* at: texture coordinates; number and share: the level. table: NULL to go lane by lane. */
static ALWAYS_INLINE void sample_texture(const e3d_muj_texture *texture, const level_table *table, const vf32 at[3], vi32 number,
                                         vf32 share, vf32 out[4])
{
    vi32 codes[2], next[2], part = v_trunc(v_mul(share, v_setf(256)));
    on_cube on = cube_face(at);
    vf32 place[2] = {at[0], at[1]};
    if (!table) {
        sample_lanes(texture, at, number, share, out);
        return;
    }
    if (texture->faces == 6)
        cube_place(&on, at, place);
    sample_level(texture, table, &on, place, number, codes);
    vmask mixed = v_gti(part, v_seti(0));
    if (v_any(mixed)) {
        sample_level(texture, table, &on, place, v_seli(mixed, v_addi(number, v_seti(1)), number), next);
        for (int h = 0; h < 2; h++)
            codes[h] = v_seli(mixed, between(codes[h], next[h], part_of(part)), codes[h]);
    }
    for (int c = 0; c < 4; c++) {
        vi32 code = c < 2 ? codes[c] : v_shr(codes[c - 2], 16);
        out[c] = v_mul(v_float(v_andi(code, v_seti(255))), v_setf(1.0f / 255));
    }
}
