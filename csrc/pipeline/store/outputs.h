/* The outputs beside colour (the G-buffer). */
#ifndef E3D_OUTPUTS_H
#define E3D_OUTPUTS_H

#include <stddef.h>

#include "core/grow.h"
#include "core/limits.h"
#include "e3d_targets.h"

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;
typedef struct e3d_tile e3d_tile;

typedef struct e3d_output {
    void *target; /* or NULL */
    size_t first; /* word in e3d_worker.outputs */
} e3d_output;

/* A thread's memory, of one tile. */
typedef struct e3d_outputs_state {
    e3d_array words; /* int32_t or float: one output after the other */
} e3d_outputs_state;

/* A tile's pixels are E3D_TILE apart from row to row; the last place is of samples that stand for none. */
enum { E3D_NO_PIXEL = E3D_TILE_SAMPLES };

int e3d_output_channels(e3d_output_kind kind);
/* Returns where a worker gathers an output, or NULL if nobody asked for it. */
void *e3d_outputs_gathered(const e3d_context *context, const e3d_worker *worker, e3d_output_kind kind);
int e3d_outputs_prepare(e3d_context *context); /* 0 when memory is out */
void e3d_outputs_begin(const e3d_context *context, e3d_worker *worker);
void e3d_outputs_again(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
void e3d_outputs_end(const e3d_context *context, const e3d_worker *worker, const e3d_tile *tile);
/* The whole tile is background. */
void e3d_outputs_blank(const e3d_context *context, const e3d_tile *tile);

#endif
