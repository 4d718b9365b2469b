/* A frame while it is drawn, the renderer that draws it, and its threads: sums of what the stages keep. Data flows one way: prepare ->
 * geometry (cull, transform, clip, setup, bin) -> tiles (raster, shade, resolve).
 */
#ifndef E3D_FRAME_H
#define E3D_FRAME_H

#include <stdatomic.h>

#include "core/clock.h"
#include "core/grow.h"
#include "core/limits.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "pipeline/blank.h"
#include "pipeline/counts.h"
#include "pipeline/cull.h"
#include "pipeline/depths.h"
#include "pipeline/draws.h"
#include "pipeline/fragments.h"
#include "pipeline/geometry.h"
#include "pipeline/history.h"
#include "pipeline/late.h"
#include "pipeline/lines.h"
#include "pipeline/outputs.h"
#include "pipeline/plan.h"
#include "pipeline/records.h"
#include "pipeline/resolve.h"
#include "pipeline/rounds.h"
#include "pipeline/share.h"
#include "pipeline/slots.h"
#include "pipeline/spans.h"
#include "pipeline/surface.h"
#include "pipeline/tile_state.h"
#include "pipeline/view.h"

typedef struct e3d_tile_memory e3d_tile_memory;

/* Records are of the scene, or of the edges of a wireframe. */
enum { E3D_PASS_SCENE = 0, E3D_PASS_WIRE, E3D_PASSES };

/* A thread: the memory of each stage, kept from frame to frame. */
typedef struct e3d_worker {
    e3d_record_set pass[E3D_PASSES];
    e3d_fragment_set fragments;
    e3d_geometry_state geometry;
    e3d_tile_memory *tile;
    e3d_visible_tile *visible; /* of the tile that is being drawn */
    uint32_t number;           /* of this worker */
    e3d_slots_state slots;
    e3d_cull_state cull;
    e3d_surface_state surface;
    e3d_outputs_state outputs;
    e3d_counters counters;
    e3d_spans_state spans;
    e3d_late_state late;
    e3d_blank_state blank;
    int64_t lap; /* when the last stage of a tile ended (e3d_lap) */
    int failed;  /* out of memory */
    e3d_share_state share;
} e3d_worker;

struct e3d_renderer {
    e3d_backend backend;
    int32_t threads;
    const e3d_kernels *kernels;
    e3d_worker **workers;
    e3d_draws draws;
    e3d_view view;
    e3d_cull_memory cull;
    e3d_histories histories;
    e3d_kept_memory kept;
    e3d_array marks;         /* uint8_t of each instance: E3D_MARK_ */
    e3d_array tile_progress; /* e3d_tile_progress */
    int (*poll)(void *);
    void *poll_user;
};

/* Which items are drawn now. */
typedef enum e3d_choice {
    E3D_ALL_ITEMS = 0,
    E3D_SEEN_ITEMS,   /* what showed when it was last tried */
    E3D_UNSEEN_ITEMS, /* the others */
} e3d_choice;

typedef struct e3d_round {
    e3d_choice choice;
    int64_t first, end; /* items */
    int tested;         /* against the kept tiles' depths */
    int finishes;       /* its tiles are shaded and resolved; the last round's only where more has come */
    int last;           /* lines, points and edges are drawn, too */
} e3d_round;

typedef struct e3d_context {
    e3d_renderer *renderer;
    const e3d_kernels *kernels;
    const e3d_frame *frame;
    const e3d_targets *targets;
    e3d_plan plan;
    e3d_draws *draws;
    e3d_view *view;
    uint8_t *marks;          /* of each instance */
    const e3d_item *items;
    int64_t item_count;
    uint8_t *seen;           /* the history's, by e3d_item.unit */
    e3d_tile_progress *tiles;
    e3d_visible_tile *kept;  /* NULL: one round */
    e3d_tile_depths *depths; /* of the tiles */
    e3d_round round;
    const e3d_record *records[E3D_PASSES][E3D_MAX_THREADS];
    const e3d_drawn_cluster *drawn[E3D_MAX_THREADS];
    e3d_record_table tables[E3D_PASSES];
    float unorm8[256]; /* values of 8-bit vertex and instance colours (R23) */
    e3d_output outputs[E3D_OUTPUTS]; /* by kind */
    e3d_line_style lines;
    e3d_background background;
    e3d_ink line;
    atomic_llong next; /* instance, task or item */
    atomic_llong next_unit;
    atomic_int stop;   /* cancelled or out of memory */
    int cancelled;
    int64_t last_poll;
} e3d_context;

/* Whether memory was out for any thread. */
static inline int e3d_any_failed(const e3d_renderer *renderer)
{
    for (int32_t w = 0; w < renderer->threads; w++)
        if (renderer->workers[w]->failed)
            return 1;
    return 0;
}

/* Adds to a stage's time what has passed since the thread's last lap. */
static inline void e3d_lap(e3d_worker *worker, int64_t *stage_ns)
{
    int64_t now = e3d_now_ns();
    *stage_ns += now - worker->lap;
    worker->lap = now;
}

static inline int e3d_plans(const e3d_context *context, e3d_plan_item item) { return e3d_plan_has(context->plan, item); }

#endif
