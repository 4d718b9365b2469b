/* Visible samples to colours and outputs. */
#ifndef E3D_SHADE_H
#define E3D_SHADE_H

#include <stdint.h>

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;
typedef struct e3d_tile e3d_tile;

/* Shades the first `count` of the tile memory's runs, which are owned by IDs; 0 when memory is out. */
int e3d_shade_runs(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int32_t count);
/* Shades the list of what shows; 0 when memory is out. */
int e3d_shade_shown(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);

#endif
