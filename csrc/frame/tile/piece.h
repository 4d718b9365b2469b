/* A piece: a record in one tile. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"

/* Finds the box of a record, and the base of its planes. */
static inline void e3d_piece_box(const e3d_viewport *viewport, const e3d_record *record, const e3d_tile *tile, e3d_piece *piece)
{
    e3d_box box = e3d_sample_box(record->x, record->y, viewport);
    piece->base_x = box.x0 - tile->x;
    piece->base_y = box.y0 - tile->y;
    piece->x0 = e3d_in_tile(box.x0 - tile->x);
    piece->y0 = e3d_in_tile(box.y0 - tile->y);
    piece->x1 = e3d_in_tile(box.x1 - tile->x);
    piece->y1 = e3d_in_tile(box.y1 - tile->y);
}

static inline void e3d_piece_rest(const e3d_record *record, uint32_t slot, e3d_piece *piece)
{
    piece->z0 = record->z0;
    piece->gx = record->gx;
    piece->gy = record->gy;
    piece->zmin = record->zmin;
    piece->zmax = record->zmax;
    piece->slot = slot;
    piece->order = record->order;
}

/* Finds a record's piece in a tile; 0 if an edge rejects the whole tile. */
static inline int e3d_piece_in_tile(const e3d_viewport *viewport, const e3d_record *record, const e3d_tile *tile, uint32_t slot,
                                    e3d_piece *piece)
{
    for (int k = 0; k < 3; k++)
        if (!e3d_piece_edge(record, k, tile->x, tile->y, piece))
            return 0;
    e3d_piece_box(viewport, record, tile, piece);
    e3d_piece_rest(record, slot, piece);
    return 1;
}

/* R14: the depth at a sample of the tile. */
static inline float e3d_piece_depth(const e3d_piece *p, int32_t x, int32_t y)
{
    float z = (p->z0 + (float)(x - p->base_x) * p->gx) + (float)(y - p->base_y) * p->gy;
    z = z > p->zmin ? z : p->zmin;
    return z < p->zmax ? z : p->zmax;
}

/* The same with multisampling, in the plane of a sample (R104). The box is found in any case. */
static inline int e3d_piece_in_plane(const e3d_prepared *pass, int sample, const e3d_record *record, const e3d_tile *tile, uint32_t slot,
                                     e3d_piece *piece)
{
    int32_t x = pass->pattern->x[sample], y = pass->pattern->y[sample];
    float u = (float)x * (1.0f / E3D_SUBPIXEL), v = (float)y * (1.0f / E3D_SUBPIXEL);
    e3d_piece_box(&pass->view->viewport, record, tile, piece);
    e3d_piece_rest(record, slot, piece);
    piece->z0 = (record->z0 + u * record->gx) + v * record->gy;
    for (int k = 0; k < 3; k++)
        if (!e3d_keep_edge(e3d_edge_beside(record, k, tile->x, tile->y, x, y), k, piece))
            return 0;
    return 1;
}
