/* What shows of few records, found without depths. */
#ifndef E3D_SPANS_H
#define E3D_SPANS_H

#include "kernels/types/shown.h"

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;
typedef struct e3d_tile e3d_tile;

/* How many tiles go without spans since these did not pay, and how many of these are left. */
typedef struct e3d_spans_state {
    int32_t without, left;
} e3d_spans_state;

/* A thread's memory, of one tile. */
typedef struct e3d_spans_memory {
    _Alignas(64) e3d_cover cover;
    _Alignas(64) e3d_layers layers;
} e3d_spans_memory;

/* Makes the list of what shows of few records; 0 where they are too large for that, or meet too much. */
int e3d_show_spans(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int64_t number);
/* Whether they left no gap. */
int e3d_spans_cover_all(const e3d_cover *cover);

#endif
