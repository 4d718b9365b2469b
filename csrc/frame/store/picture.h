/* Copies rows of a tile to their place in a picture, and back. */
#pragma once

#include <stddef.h>

#include "frame/pass/prepared.h"
#include "frame/pass/view.h"

/* Writes rows of pixels of so many bytes, `step` bytes apart, to the tile's place in a picture. */
void e3d_write_tile(const e3d_prepared *pass, const e3d_tile *tile, void *picture, size_t pixel, const void *rows, size_t step);
/* Reads them back. */
void e3d_read_tile(const e3d_prepared *pass, const e3d_tile *tile, const void *picture, size_t pixel, void *rows, size_t step);
