/* Triangles of a user interface: two-dimensional, textured, blended, clipped by scissor rectangles.
 * In: a picture, and lists as Dear ImGui makes them (ImDrawVert, 16- or 32-bit indices, commands).
 * Out: the picture's pixels, with the triangles blended over them in the order of the list. docs/exactness, section 11, has the
 * rules.
 * Always: every backend gives the same bytes. Any position, uv and colour is legal: triangles are clipped, and one with a NaN in
 * a position draws nothing. One thread, no allocation; nobody else may use the picture during the call. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_backends.h"
#include "e3d_canvas.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The longest side of a picture and of a texture: up to it, texel coordinates in 1/256 are exact in float32. */
#define E3D_UI_MAX_SIDE 16384

typedef struct e3d_ui_vertex {
    float x, y;      /* pixels, y down */
    float u, v;      /* (0, 0) is the texture's top left corner, (1, 1) the other one */
    uint8_t rgba[4]; /* straight alpha; the texture is multiplied by it */
} e3d_ui_vertex;

typedef enum e3d_ui_format {
    E3D_UI_RGBA8 = 0,
    E3D_UI_A8 = 1,    /* white, with that alpha */
    E3D_UI_RGBX8 = 2, /* opaque: the fourth byte is ignored */
} e3d_ui_format;

typedef enum e3d_ui_filter {
    E3D_UI_BILINEAR = 0,
    E3D_UI_NEAREST = 1,
} e3d_ui_filter;

/* Coordinates beyond a side read the texels at that side. */
typedef struct e3d_ui_texture {
    const uint8_t *pixels; /* top row first; aligned to 4 bytes unless A8; no byte is shared with the picture */
    int32_t width;         /* 1 ... E3D_UI_MAX_SIDE */
    int32_t height;
    int32_t stride; /* bytes from a row to the one below it: a multiple of a texel's; height * stride is below 2^31 */
    e3d_ui_format format;
    e3d_ui_filter filter;
} e3d_ui_texture;

/* Triangles of three indices each; `first_vertex` is added to the indices. Pixels in [left, right) x [top, bottom) may change. */
typedef struct e3d_ui_command {
    int32_t left, top, right, bottom;
    uint32_t first_index;
    uint32_t index_count; /* a multiple of 3 */
    uint32_t first_vertex;
    uint32_t texture; /* the number of its texture in the list */
} e3d_ui_command;

typedef struct e3d_ui_list {
    const e3d_ui_vertex *vertices;
    const void *indices; /* uint16_t or uint32_t, as `index_bytes` says */
    const e3d_ui_command *commands;
    const e3d_ui_texture *textures;
    uint32_t vertex_count;
    uint32_t index_count;
    uint32_t command_count;
    uint32_t texture_count;
    uint32_t index_bytes; /* 2 or 4 */
} e3d_ui_list;

/* Draws all commands. Returns E3D_INVALID_ARGUMENT, and draws nothing, if a count, a size, an index or a texture is out of
 * range. */
e3d_status e3d_ui_draw(e3d_backend backend, const e3d_canvas *picture, const e3d_ui_list *list);

#ifdef __cplusplus
}
#endif
