/* From what shows to colours: faces, their light, fragments. */
#pragma once

#include "extras/mujoco/geometry.h"

/* Fragments of one face: what it shows in pixels that follow each other. */
typedef struct muj_run {
    int32_t pixel, count;           /* the first one, of the picture */
    int32_t first;                  /* the number of its fragment */
    int32_t face, next;             /* next: the run with the same texture */
    uint8_t x, y;                   /* in column and band */
    uint8_t mask, adds, is_unlit;   /* their samples; whether they are added to the reflection; whether no shadow light matters */
} muj_run;

/* The fragments of a band, and what is found of each. */
typedef struct muj_fragments {
    e3d_array runs, codes, places, shadowed; /* shadowed: a bit for each light with shadows that adds nothing */
    int32_t count, passes;
} muj_fragments;

/* The codes of all fragments in a pass: red, green, blue, alpha. */
static inline uint32_t *muj_codes_of(const muj_fragments *fragments, int pass)
{
    return (uint32_t *)fragments->codes.data + (size_t)pass * (size_t)fragments->count;
}
/* A coordinate of all fragments, where lights have shadows. */
static inline float *muj_places_of(const muj_fragments *fragments, int axis)
{
    return (float *)fragments->places.data + (size_t)axis * (size_t)fragments->count;
}
void muj_free_fragments(muj_fragments *fragments);

/* A plane as a whole: the weights of three of its corners over the picture, and their places on it; cells for each length. */
typedef struct muj_grid {
    double row[3][3], at[3][2], per_length[2];
} muj_grid;

/* A draw as a view shows it. */
typedef struct muj_seen {
    int32_t number;                 /* of the draw */
    double rows[3][4];              /* X, Y, W of a place on it */
    muj_grid grid;                  /* of planes */
} muj_seen;

enum { MUJ_FACES = 2048,
       MUJ_LIT = MUJ_CORNERS / 3 };

/* A face that was found, by the triangle and the column to which it belongs. */
typedef struct muj_known {
    uint32_t serial;                /* of the band */
    int32_t number, triangle, column, face;
} muj_known;

/* What a thread shades the fragments of a band with. */
typedef struct muj_shader {
    const muj_picture *picture;
    const muj_view *view;
    int32_t is_blending;            /* colours have alpha, and all lights are in one pass */
    int32_t top, stride;            /* the band's first row; numbers of a face */
    uint32_t serial;
    muj_lamps lamps;
    muj_fog fog;
    muj_seen seen;
    e3d_array faces, chains;        /* chains: for each texture, and none, the first and last run */
    muj_corners corners;            /* of faces that are not lit yet, whose numbers follow */
    int32_t lit[MUJ_LIT];
    muj_batch batch;
    muj_known known[MUJ_FACES];
} muj_shader;

/* ---- faces.c ---- */

/* The number of a face of a triangle for pixels of a column; MUJ_NONE when memory is out. */
int32_t muj_find_face(muj_shader *shader, const muj_draw *draw, int32_t number, int32_t triangle, int32_t column);
/* Sets shader->seen. */
void muj_see(muj_shader *shader, const muj_draw *draw, int32_t number);
/* The number of the triangle of a plane's cells at a point of the picture. */
int32_t muj_cell_at(const muj_draw *draw, const muj_grid *grid, double x, double y);

/* ---- light.c ---- */

void muj_set_lamps(const muj_picture *picture, const muj_view *view, int all_lights, muj_lamps *out);
/* Adds the three corners of a face to those that are to be lit. */
void muj_add_corners(muj_shader *shader, const muj_draw *draw, int32_t face, const float place[3][3], const float normal[3][3]);
/* Lights all corners that wait. */
void muj_light_faces(muj_shader *shader);

/* ---- shade.c ---- */

/* is_blending: of transparent geoms. The mirrored ones, too, get all lights in one pass. */
void muj_begin_shading(muj_shader *shader, const muj_picture *picture, const muj_view *view, int all_lights, int is_blending);
int muj_begin_band(muj_shader *shader, int32_t top, muj_fragments *fragments);
/* Adds fragments of a record in pixels x .. end - 1 of a row; 0 when memory is out. */
int muj_add_run(muj_shader *shader, const muj_record *record, int32_t x, int32_t end, int32_t y, uint32_t mask, muj_fragments *fragments);
/* Shades all fragments of a band; 0 when memory is out. */
int muj_shade_all(muj_shader *shader, muj_fragments *fragments);
void muj_free_shader(muj_shader *shader);
