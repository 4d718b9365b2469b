/* Finds what shows of few records without depths. */
#pragma once

#include <stdint.h>

#include "kernels/kernels.h"
#include "kernels/types/shown.h"
#include "frame/geometry/bin.h"
#include "frame/pass/view.h"
#include "frame/tile/memory.h"

/* Lists what shows of few records; 0 if they are too large, or meet too much. */
int e3d_show_spans(const e3d_kernels *kernels, const e3d_bins *bins, const e3d_tile *tile, int64_t number, e3d_tile_memory *out);
/* Whether the records left no gap. */
int e3d_spans_cover_all(const e3d_cover *cover);
