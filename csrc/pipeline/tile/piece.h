/* A record as it lies in one tile. */
#ifndef E3D_TILE_PIECE_H
#define E3D_TILE_PIECE_H

#include <stdint.h>

#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"
#include "pipeline/pass/view.h"

/* 0 if an edge rejects the whole tile. */
static inline int e3d_piece_in_tile(const e3d_viewport *viewport, const e3d_record *record, const e3d_tile *tile, uint32_t slot,
                                    e3d_piece *piece)
{
    for (int k = 0; k < 3; k++)
        if (!e3d_piece_edge(record, k, tile->x, tile->y, piece))
            return 0;
    e3d_box box = e3d_sample_box(record->x, record->y, viewport);
    piece->base_x = box.x0 - tile->x;
    piece->base_y = box.y0 - tile->y;
    piece->x0 = e3d_in_tile(box.x0 - tile->x);
    piece->y0 = e3d_in_tile(box.y0 - tile->y);
    piece->x1 = e3d_in_tile(box.x1 - tile->x);
    piece->y1 = e3d_in_tile(box.y1 - tile->y);
    piece->z0 = record->z0;
    piece->gx = record->gx;
    piece->gy = record->gy;
    piece->zmin = record->zmin;
    piece->zmax = record->zmax;
    piece->slot = slot;
    piece->order = record->order;
    return 1;
}

#endif
