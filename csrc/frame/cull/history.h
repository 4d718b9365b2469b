/* What a view's last frames showed. The next frame shows nearly the same, and draws that first. */
#pragma once

#include "base/grow.h"
#include "data/mesh/mesh.h"
#include "e3d.h"
#include "frame/pass/draws.h"

/* An entry of a frame's order, kept so that the next frame finds it again. */
typedef struct e3d_history_row {
    const e3d_mesh *mesh;
    int64_t base; /* of its groups */
    int32_t node, first, instances, groups;
} e3d_history_row;

/* Rounds did not pay: for so many frames they are left out, unless the candidates or the blocks that these cover grow by half. */
typedef struct e3d_backoff {
    int32_t frames_left;
    int64_t covered, candidates; /* how many there were when rounds were last tried */
} e3d_backoff;

typedef struct e3d_history {
    int64_t view;  /* e3d_frame.view */
    int is_of_light; /* not 0: the view is that of a shadow map (e3d_frame.faces_only) */
    uint64_t used; /* e3d_histories.frames at its last use; 0: never used */
    e3d_array rows, rows_before; /* e3d_history_row: the entries that `seen` and `seen_before` belong to */
    e3d_array seen_before;
    e3d_array seen;  /* a byte for each group of the frame: bit k is set if cluster k showed when it was last tested */
    uint32_t trials; /* the number of frames that remembered; it chooses which seen clusters are tested */
    int remembers;   /* not 0: the last frame remembered */
    /* Not 0: the last frame remembered nothing, so it counts as seen all that it drew before it knew what hides it. This frame
     * tests all of that again, not just a part */
    int doubts;
    e3d_backoff backoff;
    int64_t tiles_changed; /* how many tiles show what the frame before did not show */
} e3d_history;

/* The histories of the views that a renderer drew last. */
enum { E3D_HISTORIES = 16 }; /* shadow maps are views, too */
typedef struct e3d_histories {
    e3d_history of[E3D_HISTORIES];
    uint64_t frames;
} e3d_histories;

void e3d_histories_free(e3d_histories *histories);
/* Returns the history of a frame's view. A new view replaces the one that has not been used for longest. It begins with what the
 * last view saw, if both are cameras' views. */
e3d_history *e3d_history_of(e3d_histories *histories, const e3d_frame *frame);

/* Finds what the view's last frame of several rounds showed. Returns 1 if it knows of most groups, -1 when memory is out. */
int e3d_history_remember(e3d_history *history, const e3d_draws *draws);
/* Whether this frame goes without rounds, since they did not pay. */
int e3d_history_backs_off(e3d_history *history, int64_t covered, int64_t candidates);
/* Called after a frame of several rounds: if little was hidden, the next frames go without rounds. */
void e3d_history_judge(e3d_history *history, const e3d_stats *stats);
