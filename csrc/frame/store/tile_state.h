/* The state of each tile of a frame. docs/rasteriser.md has a table of what may happen in which state. */
#pragma once

#include <stdatomic.h>
#include <stdint.h>

typedef enum e3d_tile_state {
    E3D_TILE_UNTOUCHED = 0, /* nothing is drawn there */
    E3D_TILE_KEPT,          /* earlier rounds drew there: its depths and IDs are kept for the next round */
    E3D_TILE_DRAWN,         /* its pixels are written */
    E3D_TILE_CLEARED,       /* its pixels are written, and all of them are background */
} e3d_tile_state;

/* One thread at a time changes a tile's state; others may look whether it is untouched. */
typedef struct e3d_tile_progress {
    _Atomic(int32_t) state; /* e3d_tile_state */
    int32_t shaded;         /* how many samples were shaded when it was drawn */
} e3d_tile_progress;

static inline e3d_tile_state e3d_tile_state_of(const e3d_tile_progress *tile)
{
    return (e3d_tile_state)atomic_load_explicit(&tile->state, memory_order_relaxed);
}

static inline void e3d_tile_set_state(e3d_tile_progress *tile, e3d_tile_state state)
{
    atomic_store_explicit(&tile->state, (int32_t)state, memory_order_relaxed);
}
