/* Rows of a tile to their place in a picture, and back. */
#ifndef E3D_PICTURE_H
#define E3D_PICTURE_H

#include "kernels/types/shading.h"

typedef struct e3d_context e3d_context;
typedef struct e3d_tile e3d_tile;

/* Writes `rows`, `step` bytes apart, of pixels of so many bytes, to the tile's place in a picture. */
void e3d_write_tile(const e3d_context *context, const e3d_tile *tile, void *picture, size_t pixel, const void *rows, size_t step);
/* Finds the rows that e3d_write_tile writes; returns whether it streams them. */
int e3d_tile_rows(const e3d_context *context, const e3d_tile *tile, void *picture, size_t pixel, const void *from, size_t step,
                  e3d_pixel_rows *out);
/* Reads them back. */
void e3d_read_tile(const e3d_context *context, const e3d_tile *tile, const void *picture, size_t pixel, void *rows, size_t step);

#endif
