/* From draws to what shows at the samples: records of triangles, their layers, and the raster. */
#pragma once

#include "extras/mujoco/record.h"

/* ---- clip.c ---- */

/* A point of clip space, and its distance from the view's clipping plane. */
typedef struct muj_point {
    double p[4], distance;
} muj_point;

muj_point muj_place(const muj_view *view, const muj_draw *draw, const double local[3]);
/* Adds what is left of a triangle. facing: 1 for fronts, -1 for backs, 0 for both. */
void muj_clip_triangle(const muj_view *view, const muj_point corner[3], int32_t facing, int32_t number, int32_t triangle, e3d_array *out);
/* Adds a line as a rectangle, `width` pixels wide, at its depth. */
void muj_add_line(const muj_view *view, const muj_point end[2], double width, int32_t number, int32_t triangle, e3d_array *out);

/* ---- setup.c ---- */

/* What a thread sets draws up with: the vertices of one, and which of its triangles may show. */
typedef struct muj_worker {
    e3d_array records, numbers, chosen;
    muj_vertices vertices;          /* in `numbers` */
    int32_t failed;
} muj_worker;

/* Whether a draw's box surely shows nothing. */
int muj_is_outside(const muj_draw *draw, const muj_view *view);
/* Finds a draw's vertices, and lists its triangles that may show; 0 when memory is out. */
int muj_choose(const muj_kernels *kernels, const muj_draw *draw, const muj_view *view, int32_t facing, muj_worker *worker);
/* Adds the records of a triangle of the draw whose vertices a worker has. */
void muj_set_up(const muj_view *view, int32_t number, const muj_draw *draw, int32_t facing, int32_t triangle, muj_worker *worker);
void muj_free_worker(muj_worker *worker);
void muj_set_up_grid(const muj_view *view, int32_t number, const muj_draw *draw, int32_t facing, e3d_array *out);
void muj_set_up_lines(const muj_view *view, int32_t number, const muj_draw *draw, e3d_array *out);
void muj_set_up_wireframe(const muj_view *view, int32_t number, const muj_draw *draw, int32_t facing, double width, e3d_array *out);
void muj_find_corner(const muj_draw *draw, int32_t triangle, int corner, double out[3]);

/* Rows of samples that a thread draws. Samples lie in groups of four: the samples of a pixel, or four pixels of a row. */
typedef struct muj_target {
    const struct muj_picture *picture;
    int32_t top, end;               /* rows of the picture */
    float *depth;                   /* from row `top` on */
    int32_t *shown;                 /* numbers of records, or MUJ_NONE */
} muj_target;

/* ---- layer.c ---- */

/* Draws as one view shows them: their records, in order, and which of them each band needs. */
typedef struct muj_layer {
    const muj_view *view;
    muj_worker *workers;            /* of each thread */
    int32_t worker_count;
    e3d_array parts;                /* where the records of each draw are */
    e3d_array records;              /* of muj_record *, in the order of drawing */
    e3d_array starts, items;        /* for each band, where its numbers of records begin; the numbers */
} muj_layer;

/* Sets up draws of a picture, from number `first` on; 0 when memory is out. */
int muj_set_layer(muj_layer *layer, const muj_picture *picture, const muj_view *view, int32_t first, int32_t count, int32_t threads);
void muj_free_layer(muj_layer *layer);
static inline const muj_record *muj_record_of(const muj_layer *layer, int32_t number)
{
    return ((muj_record **)layer->records.data)[number];
}
/* The numbers of the records of a band. */
static inline const int32_t *muj_band_items(const muj_layer *layer, int32_t band, int32_t *count)
{
    const int32_t *starts = layer->starts.data;
    *count = starts[band + 1] - starts[band];
    return (const int32_t *)layer->items.data + starts[band];
}

/* ---- raster.c ---- */

/* Clears a target, and draws the records of a layer that reach a band: at each sample the nearest shows, and of equals the later. */
void muj_draw_records(const muj_target *target, const muj_layer *layer, int32_t band);

/* What a record covers in a group: the lanes in `mask` are not hidden. */
typedef struct muj_cover {
    int32_t x, y;                   /* of the group's first pixel */
    uint32_t mask;
} muj_cover;
/* Finds what a record covers of a row, without writing; returns how many groups. There is room for a row of them. */
int muj_cover_row(const muj_target *target, const muj_record *record, int32_t y, muj_cover *out);
