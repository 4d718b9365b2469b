/* From what shows to colours: faces, light, texels. */
#pragma once

#include "extras/mujoco/geometry.h"

/* A triangle's corners: their weights over the picture, and what is interpolated. */
typedef struct muj_face {
    int32_t draw, triangle;
    uint32_t picture;               /* the shader's number of the picture that it is of */
    double row[3][3];               /* the weight of corner k at (x, y) in pixels is row[k] . (x, y, 1), over the three's sum */
    float color[MUJ_PASSES][3][3];  /* pass, corner, channel */
    float alpha[3], ahead[3];
    float coordinates[3][3], place[3][3];
} muj_face;

/* ---- faces.c ---- */

/* Finds the face of a triangle. Passes: 1 for all lights at once, or one more for each shadow light. */
void muj_set_face(const muj_picture *picture, const muj_view *view, const muj_draw *draw, int32_t number, int32_t triangle, int all_lights,
                  muj_face *out);
/* A plane as a whole: the weights of three of its corners over the picture, and their places on it. */
typedef struct muj_grid {
    int32_t draw;
    double row[3][3], at[3][2];
} muj_grid;

void muj_set_grid(const muj_view *view, const muj_draw *draw, muj_grid *out);
/* The number of the triangle of a plane's cells at a point of the picture. */
int32_t muj_cell_at(const muj_draw *draw, const muj_grid *grid, double x, double y);
/* ---- light.c ---- */

/* Finds the light on a vertex, clamped to 0 .. 1, for each pass. */
void muj_light_vertex(const muj_picture *picture, const muj_view *view, const muj_draw *draw, const double place[3], const float normal[3],
                      int all_lights, float out[MUJ_PASSES][3]);

/* ---- texels.c ---- */

/* A level of a texture, and the share of the next one. */
typedef struct muj_level {
    int32_t number;
    float share;
} muj_level;

/* The coordinates of four pixels, and of those above or below them, the lower row first: the levels of the two blocks. */
void muj_find_levels(const e3d_muj_texture *texture, const float4 lower[3], const float4 upper[3], muj_level out[2]);
void muj_sample(const e3d_muj_texture *texture, const float at[3], muj_level level, float out[4]);

/* ---- shade.c ---- */

enum { MUJ_FACES = 1024 };

/* Faces that were lit last. */
typedef struct muj_shader {
    const muj_picture *picture;
    const muj_view *view;
    int32_t all_lights;
    uint32_t number;                /* counts pictures: faces of earlier ones are not used */
    muj_grid grid;                  /* of the plane that was lit last */
    muj_face face[MUJ_FACES];
} muj_shader;

/* Of four pixels. */
typedef struct muj_colors {
    float4 rgb[MUJ_PASSES][3];      /* 0 .. 1 */
    float4 alpha;
    float4 place[3];                /* if there are lights with shadows */
} muj_colors;

void muj_begin_shading(muj_shader *shader, const muj_picture *picture, const muj_view *view, int all_lights);
/* Finds the colours of a record at the centres of pixels x + 0 .. 3, those in `lanes`; x is a multiple of 4. */
void muj_shade(muj_shader *shader, const muj_record *record, int32_t x, int32_t y, uint32_t lanes, muj_colors *out);
