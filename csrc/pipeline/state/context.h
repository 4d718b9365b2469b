/* A pass while it is drawn: what is drawn, from where, by which plan, where to, and how far it is. */
#ifndef E3D_CONTEXT_H
#define E3D_CONTEXT_H

#include <stdatomic.h>

#include "core/limits.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "pipeline/cull/cull.h"
#include "pipeline/cull/depths.h"
#include "pipeline/geometry/lines.h"
#include "pipeline/pass/draws.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/view.h"
#include "pipeline/state/renderer.h"
#include "pipeline/state/tile_state.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/outputs.h"
#include "pipeline/store/resolve.h"

/* Which candidates are drawn now. */
typedef enum e3d_choice {
    E3D_ALL_CANDIDATES = 0,
    E3D_SEEN_CANDIDATES,   /* what showed when it was last tried */
    E3D_UNSEEN_CANDIDATES, /* the others */
} e3d_choice;

typedef struct e3d_round {
    e3d_choice choice;
    int64_t first, end; /* candidates */
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
    const e3d_candidate *candidates;
    int64_t candidate_count;
    uint8_t *seen;           /* the history's, by e3d_candidate.number */
    e3d_tile_progress *tiles;
    e3d_visible_tile *kept;  /* NULL: one round */
    e3d_tile_depths *depths; /* of the tiles */
    e3d_round round;
    const e3d_record *records[E3D_SETS][E3D_MAX_THREADS];
    const e3d_drawn_cluster *drawn[E3D_MAX_THREADS];
    e3d_record_table tables[E3D_SETS];
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

static inline int e3d_plans(const e3d_context *context, e3d_plan_item item) { return e3d_plan_has(context->plan, item); }

#endif
