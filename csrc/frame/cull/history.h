/* What the last frames of a view showed: the next one shows nearly the same, and draws it first. */
#ifndef E3D_HISTORY_H
#define E3D_HISTORY_H

#include "base/grow.h"
#include "data/mesh/mesh.h"
#include "e3d.h"
#include "frame/pass/draws.h"

/* An entry of a frame's order, as the next frame finds it again. */
typedef struct e3d_history_row {
    const e3d_mesh *mesh;
    int64_t base; /* of its groups */
    int32_t node, first, instances, groups;
} e3d_history_row;

/* Rounds did not pay: so many frames still go without, unless candidates or the blocks that they cover are half as many again. */
typedef struct e3d_backoff {
    int32_t frames_left;
    int64_t covered, candidates; /* when they were last tried */
} e3d_backoff;

typedef struct e3d_history {
    int64_t view;  /* e3d_frame.view */
    int is_of_light; /* the view is that of a map of shadows (e3d_frame.faces_only) */
    uint64_t used; /* e3d_histories.frames when it was, or 0: never */
    e3d_array rows, rows_before; /* e3d_history_row of each entry: what `seen` and `seen_before` are of */
    e3d_array seen_before;
    e3d_array seen;  /* uint8_t for each group of the frame: bit k tells whether cluster k showed when it was last tried */
    uint32_t trials; /* of what was seen; grows with each frame that remembers */
    int remembers;   /* the last frame did */
    int doubts;      /* the last frame remembered nothing, so that it counts as seen what it drew before it knew what hides it: this
                      * frame tests all of that again, not a part */
    e3d_backoff backoff;
    int64_t tiles_changed; /* by what the frame before had not shown */
} e3d_history;

/* The histories of the views that a renderer drew last. */
enum { E3D_HISTORIES = 16 }; /* maps of shadows are views, too */
typedef struct e3d_histories {
    e3d_history of[E3D_HISTORIES];
    uint64_t frames;
} e3d_histories;

void e3d_histories_free(e3d_histories *histories);
/* The history of a frame's view. A new view begins with what the one drawn last saw, if both are those of cameras, and replaces the
 * one that waits longest. */
e3d_history *e3d_history_of(e3d_histories *histories, const e3d_frame *frame);

/* Finds what the view's last frame of several rounds showed: 1 if it knows of most groups, -1 when memory is out. */
int e3d_history_remember(e3d_history *history, const e3d_draws *draws);
/* Whether this frame goes without rounds since they did not pay. */
int e3d_history_backs_off(e3d_history *history, int64_t covered, int64_t candidates);
/* After a frame of several rounds: the next ones go without where little was hidden. */
void e3d_history_judge(e3d_history *history, const e3d_stats *stats);

#endif
