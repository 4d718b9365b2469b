/* Tiles that nothing is drawn in. */
#ifndef E3D_BLANK_H
#define E3D_BLANK_H

#include "pipeline/pass/view.h"

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;

/* A thread's memory: what is left of the tile that it is clearing, and whether there may be more. */
typedef struct e3d_blank_state {
    e3d_tile tile;
    int more;
} e3d_blank_state;

/* Clears such tiles: a few rows at a time, and at last what is left of all. */
void e3d_blank_begin(e3d_worker *worker);
void e3d_blank_some(const e3d_context *context, e3d_worker *worker);
void e3d_blank_rest(const e3d_context *context, e3d_worker *worker);

#endif
