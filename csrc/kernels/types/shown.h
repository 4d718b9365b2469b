/* The list of what shows in a tile; and the data for finding it without depths if records are few. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/sample_patterns.h"
#include "kernels/types/records.h"

/* Neighbouring samples of one row of a tile that show the same owner, a slot or an ID. */
typedef struct e3d_run {
    int32_t owner;
    uint16_t sample, length;
} e3d_run;

/* A primitive that shows in a tile: its ID, and where its samples or runs begin in the list. */
typedef struct e3d_shown_primitive {
    uint32_t id;
    int32_t first;
} e3d_shown_primitive;

/* The room of a list: the samples of a tile, and a row more. So a list of whole rows is full only if samples repeat. */
enum { E3D_SHOWN_ROOM = E3D_TILE_SAMPLES + E3D_TILE };

/* The list of what shows in a tile, primitive after primitive, as samples or as runs. */
typedef struct e3d_shown {
    int32_t sample[E3D_SHOWN_ROOM + 2 * E3D_PAD]; /* y * E3D_TILE + x; a run: its first sample | its length << E3D_RUN_LENGTH */
    int32_t of[E3D_SHOWN_ROOM + 2 * E3D_PAD];     /* the number of its primitive */
    e3d_shown_primitive primitive[E3D_SHOWN_ROOM + 1];
    int32_t count, primitives; /* how many samples or runs there are, and how many primitives */
    int runs;              /* not 0: `sample` has runs */
    /* Not NULL: an entry is pixel | number of a sample of the pattern << E3D_SHOWN_NUMBER (R105) */
    const e3d_sample_pattern *pattern;
    int at_samples;  /* with a pattern: not 0: values are found at samples, never at pixels' centres (R195) */
    int finest;      /* not 0: textures are read at level 0 (R190) */
    float beside[2]; /* with a pattern: how many pixels to the right of entries and below them values are found (R190) */
} e3d_shown;

enum { E3D_RUN_LENGTH = 16,
       E3D_SHOWN_NUMBER = 2 * E3D_TILE_SHIFT };

/* A record in a tile: the rows of its box, and where their spans begin in e3d_cover.span. */
typedef struct e3d_covering {
    const e3d_record *record;
    uint32_t id;
    int32_t y0, y1, at;
} e3d_covering;

/* The samples that the records of a tile cover, hidden or not, row by row (spans.inl). */
enum { E3D_MOST_COVERING = 256,
       E3D_COVER_ROWS = 8192 };
typedef struct e3d_cover {
    int32_t x, y, width, height;                             /* the tile's first sample, and its size inside the viewport */
    int32_t count, used;                                     /* how many records there are, and spans in use */
    uint64_t once[E3D_TILE + E3D_PAD], twice[E3D_TILE + E3D_PAD]; /* a bit a sample: set if a record covers it; if several do */
    e3d_covering record[E3D_MOST_COVERING];
    int32_t span[E3D_COVER_ROWS + E3D_PAD]; /* for each row of each record a run, perhaps of length 0 */
} e3d_cover;

/* Overlapping records from near to far: for each row, the samples that nearer records leave to each (layers.inl). */
typedef struct e3d_layers {
    /* The samples that any record covers so far; that closed ones cover */
    uint64_t covered[E3D_TILE + E3D_PAD], hidden[E3D_TILE + E3D_PAD];
    uint64_t left[E3D_COVER_ROWS + E3D_PAD];                          /* for each span the samples that are left to its record */
    struct {
        float zmax;
        int32_t number;
    } open[E3D_MOST_COVERING]; /* the active set: records that may reach behind the nearest depth of the next one */
    int32_t opened;            /* how many are open */
    int32_t contested, taken;         /* how many samples were compared by depth; not 0 if a later record won any */
} e3d_layers;

/* Begins a list of what shows, of runs or of samples. */
static inline void e3d_shown_begin(e3d_shown *shown, int runs)
{
    shown->runs = runs;
    shown->pattern = NULL;
    shown->at_samples = shown->finest = 0;
    shown->beside[0] = shown->beside[1] = 0.0f;
    shown->count = shown->primitives = 0;
}
