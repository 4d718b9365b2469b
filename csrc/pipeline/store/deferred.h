/* Rows of the picture that wait to be written while samples are shaded. */
#ifndef E3D_DEFERRED_H
#define E3D_DEFERRED_H

#include "kernels/types/shading.h"

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;
typedef struct e3d_tile e3d_tile;

/* What is left to write, by a thread: of the tile that it drew last, and of one that nothing is in. */
typedef struct e3d_deferred_state {
    e3d_pixel_rows drawn, blank;
} e3d_deferred_state;

/* The colours of a tile that is done; those of the one before are written now, if they aren't yet. */
void e3d_deferred_add(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
/* Rows for a kernel to write some of, or NULL. */
e3d_pixel_rows *e3d_deferred_rows(const e3d_context *context, e3d_worker *worker);
/* Writes some where it can't. */
void e3d_deferred_some(const e3d_context *context, e3d_pixel_rows *rows);
/* All that wait, when no more samples are shaded. */
void e3d_deferred_rest(const e3d_context *context, e3d_worker *worker);

#endif
