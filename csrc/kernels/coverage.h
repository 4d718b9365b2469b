/* The place of a piece: its box of sample centres (R10) and its edge functions (R12). */
#pragma once

#include "base/limits.h"
#include "kernels/types/records.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"

/* A box of samples, inclusive; it is empty where x0 > x1 or y0 > y1. */
typedef struct e3d_box {
    int32_t x0, y0, x1, y1;
} e3d_box;

/* The samples whose centres lie in the corners' rectangle, within the viewport (R10); with multisampling, the pixels that
 * have samples in it (R104). */
static inline e3d_box e3d_sample_box(const int32_t x[3], const int32_t y[3], const e3d_viewport *viewport)
{
    int32_t xlo = x[0], xhi = x[0], ylo = y[0], yhi = y[0];
    for (int k = 1; k < 3; k++) {
        xlo = xlo < x[k] ? xlo : x[k];
        xhi = xhi > x[k] ? xhi : x[k];
        ylo = ylo < y[k] ? ylo : y[k];
        yhi = yhi > y[k] ? yhi : y[k];
    }
    int32_t before = 127 - viewport->reach, behind = 128 - viewport->reach;
    e3d_box box = {(xlo + before) >> 8, (ylo + before) >> 8, (xhi - behind) >> 8, (yhi - behind) >> 8};
    box.x0 = box.x0 > 0 ? box.x0 : 0;
    box.y0 = box.y0 > 0 ? box.y0 : 0;
    box.x1 = box.x1 < viewport->width - 1 ? box.x1 : viewport->width - 1;
    box.y1 = box.y1 < viewport->height - 1 ? box.y1 : viewport->height - 1;
    return box;
}

/* Twice the area, in 1/256 sample squared (R9). */
static inline int64_t e3d_doubled_area(const int32_t x[3], const int32_t y[3])
{
    return (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
}

/* An edge function at a sample, floor(E / 256) with the top-left rule included, and its steps to the right and down. */
typedef struct e3d_edge {
    int64_t e;
    int32_t a, b;
} e3d_edge;

/* The edge function at an offset (u, v) from the centre of sample (x, y), in 1/256 sample. */
static inline e3d_edge e3d_edge_beside(const e3d_record *r, int k, int32_t x, int32_t y, int32_t u, int32_t v)
{
    int i = (k + 1) % 3, j = (k + 2) % 3;
    e3d_edge edge = {0, r->y[i] - r->y[j], r->x[j] - r->x[i]};
    int64_t value = (int64_t)edge.a * (256 * (int64_t)x + 128 + u - r->x[i]) +
                    (int64_t)edge.b * (256 * (int64_t)y + 128 + v - r->y[i]);
    int top_left = edge.a > 0 || (edge.a == 0 && edge.b > 0);
    edge.e = (value - !top_left) >> 8;
    return edge;
}

static inline e3d_edge e3d_edge_at(const e3d_record *r, int k, int32_t x, int32_t y) { return e3d_edge_beside(r, k, x, y, 0, 0); }

/* Keeps an edge function at the first sample of a tile for a piece; 0 if the whole tile lies outside it. An edge with the
 * whole tile inside is left out, so that the edges that cross the tile fit 32 bits. */
static inline int e3d_keep_edge(e3d_edge edge, int k, e3d_piece *piece)
{
    const int64_t span = E3D_TILE - 1;
    int64_t a = edge.a * span, b = edge.b * span;
    if (edge.e + (a > 0 ? a : 0) + (b > 0 ? b : 0) < 0)
        return 0;
    int crosses = edge.e + (a < 0 ? a : 0) + (b < 0 ? b : 0) < 0;
    piece->e[k] = crosses ? (int32_t)edge.e : 0;
    piece->a[k] = crosses ? edge.a : 0;
    piece->b[k] = crosses ? edge.b : 0;
    return 1;
}

/* Edge k of a piece (R12) at the first sample (x, y) of a tile. */
static inline int e3d_piece_edge(const e3d_record *r, int k, int32_t x, int32_t y, e3d_piece *piece)
{
    return e3d_keep_edge(e3d_edge_at(r, k, x, y), k, piece);
}

static inline int32_t e3d_in_tile(int32_t v)
{
    if (v < 0)
        return 0;
    return v < E3D_TILE ? v : E3D_TILE - 1;
}
