/* What geometry reads and writes: the candidates of a round, and what is drawn of them. */
#pragma once

#include <stdint.h>

#include "frame/cull/cull.h"
#include "frame/cull/depths.h"
#include "frame/cull/history.h"
#include "frame/geometry/bin.h"
#include "frame/pass/draws.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"

/* What is known of an instance: one of its clusters was not occluded; one was drawn. */
enum { E3D_MARK_UNOCCLUDED = 1,
       E3D_MARK_DRAWN = 2 };

/* Which candidates are drawn now. */
typedef enum e3d_choice {
    E3D_ALL_CANDIDATES = 0,
    E3D_SEEN_CANDIDATES,   /* the clusters that showed when they were last tested */
    E3D_UNSEEN_CANDIDATES, /* the others */
} e3d_choice;

typedef struct e3d_round {
    e3d_choice choice;
    int64_t first, end; /* candidates */
    int tested;         /* tested against the tiles' depths */
    int last;           /* not 0: the last round, which also draws lines, points and edges */
} e3d_round;

typedef struct e3d_geometry_in {
    const e3d_prepared *pass;
    const e3d_candidate *candidates;
    e3d_round round;
    const e3d_tile_depths *depths; /* the depths of kept tiles */
    const e3d_history *history;    /* of what was seen */
} e3d_geometry_in;

typedef struct e3d_geometry_out {
    e3d_bins *bins;
    e3d_view *view;   /* geometry finishes the instances here that aren't ready */
    e3d_draws *draws; /* and here */
    uint8_t *marks;   /* of each instance */
    uint8_t *seen;    /* for each e3d_candidate.number a byte, a bit for each cluster that shows; NULL: there is one round */
} e3d_geometry_out;
