/* What shows in a tile, as runs or samples, and how that is found of few records. */
#ifndef E3D_KERNELS_SHOWN_H
#define E3D_KERNELS_SHOWN_H

#include <stdint.h>

#include "core/limits.h"
#include "kernels/types/records.h"

/* Neighbouring samples of one row of a tile that show the same: a slot or an ID; when they are sorted, a piece. */
typedef struct e3d_run {
    int32_t owner;
    uint16_t sample, length;
} e3d_run;

/* A piece that shows in a tile: its ID, and its first sample in the list, or its first run. */
typedef struct e3d_shown_piece {
    uint32_t id;
    int32_t first;
} e3d_shown_piece;

/* What shows in a tile, piece after piece: samples, or runs. */
typedef struct e3d_shown {
    int32_t sample[E3D_TILE_SAMPLES + 2 * E3D_PAD]; /* y * E3D_TILE + x; of a run the first, and its length << E3D_RUN_LENGTH */
    int32_t of[E3D_TILE_SAMPLES + 2 * E3D_PAD];     /* whose: the piece's number */
    e3d_shown_piece piece[E3D_TILE_SAMPLES + 1];
    int32_t count, pieces; /* of samples or runs, and of pieces */
    int runs;              /* not samples */
} e3d_shown;

enum { E3D_RUN_LENGTH = 16 };

/* A record of a tile, the rows of its box there, and the place of the first one's span. */
typedef struct e3d_covering {
    const e3d_record *record;
    uint32_t id;
    int32_t y0, y1, at;
} e3d_covering;

/* What the records of a tile cover, hidden or not. */
enum { E3D_MOST_COVERING = 256, E3D_COVER_ROWS = 8192 };
typedef struct e3d_cover {
    int32_t x, y, width, height;                             /* of the tile: its first sample, and samples inside the viewport */
    int32_t count, used;                                     /* of the records, and of the spans */
    uint64_t once[E3D_TILE + E3D_PAD], twice[E3D_TILE + E3D_PAD]; /* samples of each row that one covers, and more than one */
    e3d_covering record[E3D_MOST_COVERING];
    int32_t span[E3D_COVER_ROWS + E3D_PAD]; /* of each row of each record a run, perhaps of length 0 */
} e3d_cover;

/* Of records that meet, some after the other, the samples that are left to each. */
typedef struct e3d_layers {
    uint64_t covered[E3D_TILE + E3D_PAD], hidden[E3D_TILE + E3D_PAD]; /* by those so far; by those that aren't open */
    uint64_t left[E3D_COVER_ROWS + E3D_PAD];                          /* of each span */
    struct {
        float zmax;
        int32_t number;
    } open[E3D_MOST_COVERING]; /* records that may reach behind the nearest depths of the next ones */
    int32_t opened;            /* how many */
    int32_t contested, taken;         /* samples whose depths were compared; whether a later one was nearer */
} e3d_layers;

/* Begins a list of what shows, of runs or of samples. */
static inline void e3d_shown_begin(e3d_shown *shown, int runs)
{
    shown->runs = runs;
    shown->count = shown->pieces = 0;
}

#endif
