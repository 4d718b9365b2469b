/* Records to the tiles that they may cover. */
#ifndef E3D_BIN_H
#define E3D_BIN_H

#include "core/grow.h"
#include "core/limits.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;
typedef struct e3d_record_set e3d_record_set;

void e3d_records_free(e3d_record_set *set);
int e3d_records_reset(e3d_record_set *set, int32_t tiles);
/* Empties the bins of a thread's records or fragments. */
void e3d_bins_clear(e3d_array *bins, e3d_array *blocks, int32_t tiles);
/* Puts what they hold aside; 0 when memory is out. */
int e3d_bins_keep(e3d_array *bins, e3d_array *earlier, int32_t tiles);
/* Lists `count` records from `first` on in the bins of the tiles that they may touch; 0 when memory is out. */
int e3d_bin_records(const e3d_context *context, e3d_worker *worker, e3d_record_set *set, uint32_t first, const e3d_tile_span *spans,
                    int count);
static inline e3d_tile_span e3d_span_of(const e3d_box *box)
{
    return (e3d_tile_span){(uint32_t)(box->y0 >> E3D_TILE_SHIFT << 16 | box->x0 >> E3D_TILE_SHIFT),
                           (uint32_t)(box->y1 >> E3D_TILE_SHIFT << 16 | box->x1 >> E3D_TILE_SHIFT)};
}

/* Whether any thread has a record or a fragment for the tile. */
int e3d_has_bin(const e3d_context *context, int which, int64_t tile);
/* Whether that holds for either set. */
int e3d_has_bins(const e3d_context *context, int64_t tile);
/* How many a tile's bins of the scene hold. */
typedef struct e3d_entries {
    uint32_t records, fragments;
} e3d_entries;
e3d_entries e3d_count_entries(const e3d_context *context, int64_t tile);

/* After the records have their places: the tables that tell a record by its ID. */
void e3d_tables_set(e3d_context *context);

#endif
