/* The data of the user interface's kernel: rows of pixels, and the shape that is drawn over them (docs/exactness, section 11). */
#pragma once

#include "e3d_canvas.h"
#include "e3d_ui.h"

/* Portable kernels draw pictures that are narrower than any vector. */
enum { E3D_UI_LEAST_WIDTH = 16,
       E3D_UI_ROWS = 64 };

/* The alpha of a pixel or texel in a register. */
#define E3D_UI_ALPHA 0xFF000000u

/* R40: a value at the base, and its change from column to column and from row to row. */
typedef struct e3d_ui_plane {
    float at_base, gx, gy;
} e3d_ui_plane;

typedef struct e3d_ui_shape {
    const e3d_ui_texture *texture;
    int32_t base_x, base_y;
    e3d_ui_plane u, v, color[4]; /* u and v in 1/256 texel */
    int texel_is_constant;       /* not 0: the texel is `texel` everywhere */
    int color_is_constant;       /* not 0: the colour is `rgba` everywhere */
    int is_opaque;               /* alphas are 255 everywhere */
    int is_copy;                 /* a pixel has the texel at (x + copy_x, y + copy_y), which is on the texture; the colour is constant */
    int32_t copy_x, copy_y;
    uint32_t texel, rgba;
} e3d_ui_shape;

/* Rows first ... first + count - 1 of the picture. Each has columns left ... right - 1, or none if left isn't below right. */
typedef struct e3d_ui_rows {
    int32_t first, count;
    int32_t left[E3D_UI_ROWS], right[E3D_UI_ROWS];
} e3d_ui_rows;
