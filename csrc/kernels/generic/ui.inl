/* ui: rows of a triangle or rectangle of the user interface, blended over the picture (R40-R42). */
#pragma once

#include "base/always_inline.h"
#include "e3d_canvas.h"
#include "e3d_ui.h"
#include "kernels/types/ui.h"

/* Channels of 16 bits: red and blue, green and alpha. */
typedef struct ui_pixels {
    vi32 rb, ga;
} ui_pixels;

/* The sources of a pixel's texel and colour. */
typedef enum ui_source {
    UI_FILL,     /* both constant, and opaque */
    UI_SOLID,    /* both constant, not opaque */
    UI_SHADED,   /* the texel constant */
    UI_TEXTURED, /* the colour constant */
    UI_BOTH,
    UI_COPY,     /* a texel a pixel, the colour constant */
    UI_GLYPH,    /* the same, of alphas alone */
    UI_SHOWN     /* the same, opaque, the colour white: the texels as they are */
} ui_source;

/* A vector of pixels: its first pixel, and the address of that. */
typedef struct ui_place {
    uint8_t *to;
    int32_t x, y;
} ui_place;

static inline ui_pixels ui_split(vi32 rgba)
{
    vi32 low = v_seti(0x00FF00FF);
    return (ui_pixels){v_andi(rgba, low), v_andi(v_shr(rgba, 8), low)};
}
static inline vi32 ui_join(ui_pixels p) { return v_ori(p.rb, v_shl(p.ga, 8)); }

/* over255 for numbers up to 255 * 255: (n + n / 256) / 256 with n + 128 for n. */
static inline vi32 ui_over255(vi32 n)
{
    n = v_add16(n, v_seti(0x00800080));
    return v_shr16(v_add16(n, v_shr16(n, 8)), 8);
}
static inline ui_pixels ui_product(ui_pixels a, ui_pixels b)
{
    return (ui_pixels){ui_over255(v_mul16(a.rb, b.rb)), ui_over255(v_mul16(a.ga, b.ga))};
}

/* The alpha in both halves. */
static inline vi32 ui_alpha(ui_pixels p) { return v_ori(v_shr(p.ga, 16), v_andi(p.ga, v_seti(0x00FF0000))); }

static inline vi32 ui_blend(ui_pixels over, vi32 alpha, vi32 under)
{
    ui_pixels d = ui_split(under);
    vi32 rest = v_sub16(v_seti(0x00FF00FF), alpha);
    vi32 opaque = v_ori(v_andi(over.ga, v_seti(0x0000FFFF)), v_seti(0x00FF0000));
    return ui_join((ui_pixels){
        ui_over255(v_add16(v_mul16(over.rb, alpha), v_mul16(d.rb, rest))),
        ui_over255(v_add16(v_mul16(opaque, alpha), v_mul16(d.ga, rest)))});
}

static inline vf32 ui_plane_at(const e3d_ui_plane *p, vf32 dx, vf32 dy)
{
    return v_add(v_add(v_setf(p->at_base), v_mul(dx, v_setf(p->gx))), v_mul(dy, v_setf(p->gy)));
}

static inline vf32 ui_clamp(vf32 v, float high) { return v_min(v_max(v, v_setf(0.0f)), v_setf(high)); }

static ALWAYS_INLINE ui_pixels ui_colors(const e3d_ui_shape *shape, vf32 dx, vf32 dy)
{
    vi32 c[4];
    for (int k = 0; k < 4; k++)
        c[k] = v_rint(ui_clamp(ui_plane_at(&shape->color[k], dx, dy), 255.0f));
    return (ui_pixels){v_ori(c[0], v_shl(c[2], 16)), v_ori(c[1], v_shl(c[3], 16))};
}

/* The alpha bits that replace alphas which are ignored. */
static inline vi32 ui_opaque(const e3d_ui_texture *t) { return v_seti(t->format == E3D_UI_RGBX8 ? (int32_t)E3D_UI_ALPHA : 0); }

/* Texels at these places; an A8 texel has one byte. */
static ALWAYS_INLINE vi32 ui_fetch(const e3d_ui_texture *texture, vi32 column, vi32 row)
{
    if (texture->format != E3D_UI_A8)
        return v_ori(v_gatheri(texture->pixels, v_addi(v_muli(row, v_seti(texture->stride / 4)), column)), ui_opaque(texture));
    int32_t at[V_LANES], alpha[V_LANES];
    v_storei(at, v_addi(v_muli(row, v_seti(texture->stride)), column));
    for (int i = 0; i < V_LANES; i++)
        alpha[i] = (int32_t)(0x00FFFFFFu | (uint32_t)texture->pixels[at[i]] << 24);
    return v_loadi(alpha);
}

/* R41: blends two texels; the second has the weight `weight` of 256. */
static inline ui_pixels ui_mix(ui_pixels a, ui_pixels b, vi32 weight)
{
    vi32 to = v_ori(weight, v_shl(weight, 16)), from = v_sub16(v_seti(0x01000100), to), half = v_seti(0x00800080);
    return (ui_pixels){
        v_shr16(v_add16(v_add16(v_mul16(a.rb, from), v_mul16(b.rb, to)), half), 8),
        v_shr16(v_add16(v_add16(v_mul16(a.ga, from), v_mul16(b.ga, to)), half), 8)};
}

/* The two texels of a coordinate along an axis of `count` texels, and the weight of the second one. */
static inline void ui_neighbours(vf32 t, int32_t count, vi32 *first, vi32 *second, vi32 *weight)
{
    vi32 p = v_subi(v_rint(t), v_seti(128)), i = v_sra(p, 8);
    *weight = v_andi(p, v_seti(255));
    *first = v_maxi(i, v_seti(0));
    *second = v_mini(v_addi(i, v_seti(1)), v_seti(count - 1));
}

static ALWAYS_INLINE ui_pixels ui_texels(const e3d_ui_shape *shape, vf32 dx, vf32 dy)
{
    const e3d_ui_texture *t = shape->texture;
    vf32 u = ui_clamp(ui_plane_at(&shape->u, dx, dy), 256.0f * (float)t->width);
    vf32 v = ui_clamp(ui_plane_at(&shape->v, dx, dy), 256.0f * (float)t->height);
    if (t->filter == E3D_UI_NEAREST)
        return ui_split(ui_fetch(t, v_mini(v_sra(v_trunc(u), 8), v_seti(t->width - 1)),
                                 v_mini(v_sra(v_trunc(v), 8), v_seti(t->height - 1))));
    vi32 left, right, top, bottom, fx, fy;
    ui_neighbours(u, t->width, &left, &right, &fx);
    ui_neighbours(v, t->height, &top, &bottom, &fy);
    ui_pixels upper = ui_mix(ui_split(ui_fetch(t, left, top)), ui_split(ui_fetch(t, right, top)), fx);
    ui_pixels lower = ui_mix(ui_split(ui_fetch(t, left, bottom)), ui_split(ui_fetch(t, right, bottom)), fx);
    return ui_mix(upper, lower, fy);
}

/* Reads a texel a pixel, or a glyph's alpha. Lanes of the last vector that lie beside the texture read the texels at its side. */
static ALWAYS_INLINE vi32 ui_copied(const e3d_ui_shape *shape, ui_source kind, ui_place at)
{
    const e3d_ui_texture *t = shape->texture;
    int32_t column = at.x + shape->copy_x, row = at.y + shape->copy_y;
    const uint8_t *texels = t->pixels + (size_t)row * (size_t)t->stride;
    if (column < 0 || column + V_LANES > t->width) {
        vi32 beside = v_mini(v_maxi(v_addi(v_seti(column), v_iota()), v_seti(0)), v_seti(t->width - 1));
        vi32 texel = ui_fetch(t, beside, v_seti(row));
        return kind == UI_GLYPH ? v_shr(texel, 24) : texel;
    }
    if (kind == UI_GLYPH)
        return v_loadu8(texels + column);
    return v_ori(v_loadi(texels + 4 * (size_t)column), ui_opaque(t));
}

/* The products of texels and colours. */
static ALWAYS_INLINE ui_pixels ui_sources(const e3d_ui_shape *shape, ui_source kind, ui_place at)
{
    vf32 dx = v_float(v_addi(v_seti(at.x - shape->base_x), v_iota())), dy = v_setf((float)(at.y - shape->base_y));
    ui_pixels color = ui_split(v_seti((int32_t)shape->rgba)), texel = ui_split(v_seti((int32_t)shape->texel));
    if (kind == UI_SHADED || kind == UI_BOTH)
        color = ui_colors(shape, dx, dy);
    if (kind == UI_TEXTURED || kind == UI_BOTH)
        texel = ui_texels(shape, dx, dy);
    if (kind == UI_COPY)
        texel = ui_split(ui_copied(shape, kind, at));
    return ui_product(texel, color);
}

/* Blends a glyph: white with an alpha, times a colour, is that colour with another alpha. */
static ALWAYS_INLINE vi32 ui_glyph_over(const e3d_ui_shape *shape, ui_place at)
{
    ui_pixels color = ui_split(v_seti((int32_t)shape->rgba));
    vi32 texel = ui_copied(shape, UI_GLYPH, at);
    vi32 alpha = ui_over255(v_mul16(v_ori(texel, v_shl(texel, 16)), ui_alpha(color)));
    return ui_blend(color, alpha, v_loadi(at.to));
}

/* Blends pixels. If all alphas of a vector are 255, as in most, no blending is needed; for UI_SOLID they never are, or it
 * would be UI_FILL. */
static ALWAYS_INLINE vi32 ui_over(const e3d_ui_shape *shape, ui_source kind, ui_place at)
{
    if (kind == UI_SHOWN)
        return ui_copied(shape, kind, at);
    if (kind == UI_GLYPH)
        return ui_glyph_over(shape, at);
    ui_pixels over = ui_sources(shape, kind, at);
    vi32 alpha = ui_alpha(over);
    if (kind == UI_FILL || (kind != UI_SOLID && !v_any(v_gti(v_seti(0x00FF00FF), alpha))))
        return ui_join(over);
    return ui_blend(over, alpha, v_loadi(at.to));
}

/* Draws the last pixels of a row, or a row of few: it writes a vector inside the picture's row that holds them, and leaves
 * the other pixels as they are. */
static ALWAYS_INLINE void ui_rest(const e3d_ui_shape *shape, ui_source kind, ui_place at, int count, int32_t width)
{
    int32_t back = at.x + V_LANES > width ? at.x + V_LANES - width : 0;
    at.x -= back;
    at.to -= 4 * back;
    vi32 lane = v_iota();
    vmask inside = v_mand(v_gti(lane, v_seti(back - 1)), v_gti(v_seti(back + count), lane));
    v_storei(at.to, v_seli(inside, ui_over(shape, kind, at), v_loadi(at.to)));
}

/* The number of pixels before the first aligned one. In long rows, vectors that each lie across two cache lines would take
 * twice as long. */
static inline int ui_unaligned(ui_place at, int32_t right)
{
    size_t beyond = (uintptr_t)at.to % sizeof(vi32) / 4;
    return right - at.x > 8 * V_LANES && beyond != 0 ? V_LANES - (int)beyond : 0;
}

/* Draws with copies of shape and texture, which no store to the picture can change, so that their constants stay in registers. */
static ALWAYS_INLINE void ui_draw(const e3d_canvas *picture, const e3d_ui_shape *given, const e3d_ui_rows *rows, ui_source kind)
{
    const e3d_ui_texture texture = *given->texture;
    e3d_ui_shape shape = *given;
    shape.texture = &texture;
    for (int32_t i = 0; i < rows->count; i++) {
        int32_t x = rows->left[i], right = rows->right[i], y = rows->first + i;
        ui_place at = {picture->pixels + y * picture->stride + 4 * (ptrdiff_t)x, x, y};
        int first = ui_unaligned(at, right);
        if (first > 0)
            ui_rest(&shape, kind, at, first, picture->width);
        at.x += first, at.to += 4 * first;
        for (; at.x + V_LANES <= right; at.x += V_LANES, at.to += 4 * V_LANES)
            v_storei(at.to, ui_over(&shape, kind, at));
        if (at.x < right)
            ui_rest(&shape, kind, at, right - at.x, picture->width);
    }
}

static void kernel_ui(const e3d_canvas *picture, const e3d_ui_shape *shape, const e3d_ui_rows *rows)
{
    if (shape->is_copy && shape->texture->format == E3D_UI_A8)
        ui_draw(picture, shape, rows, UI_GLYPH);
    else if (shape->is_copy && shape->is_opaque && shape->rgba == 0xFFFFFFFFu)
        ui_draw(picture, shape, rows, UI_SHOWN);
    else if (shape->is_copy)
        ui_draw(picture, shape, rows, UI_COPY);
    else if (shape->texel_is_constant && shape->color_is_constant && shape->is_opaque)
        ui_draw(picture, shape, rows, UI_FILL);
    else if (shape->texel_is_constant && shape->color_is_constant)
        ui_draw(picture, shape, rows, UI_SOLID);
    else if (shape->texel_is_constant)
        ui_draw(picture, shape, rows, UI_SHADED);
    else if (shape->color_is_constant)
        ui_draw(picture, shape, rows, UI_TEXTURED);
    else
        ui_draw(picture, shape, rows, UI_BOTH);
}
