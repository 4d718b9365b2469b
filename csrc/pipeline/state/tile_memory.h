/* What a thread has at hand while it draws a tile: the sum of what the stages keep for that long. */
#ifndef E3D_TILE_MEMORY_H
#define E3D_TILE_MEMORY_H

#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/shade/runs.h"
#include "pipeline/store/resolve.h"
#include "pipeline/tile/slots.h"
#include "pipeline/tile/spans.h"

typedef struct e3d_tile_memory {
    e3d_visible_tile visible; /* where tiles aren't kept over several rounds */
    e3d_marks_memory marks;
    e3d_pixels_memory pixels;
    e3d_runs_memory runs;
    e3d_spans_memory spans;
    _Alignas(64) e3d_shown shown;
    _Alignas(64) e3d_batch batch;
    _Alignas(64) e3d_surfaces surfaces;       /* of the batch and its neighbours */
} e3d_tile_memory;

#endif
