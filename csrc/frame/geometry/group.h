/* Groups of clusters that may show. */
#pragma once

#include "data/mesh/mesh.h"
#include "frame/cull/cull.h"
#include "frame/geometry/fetch.h"
#include "frame/geometry/round.h"
#include "frame/geometry/records.h"
#include "frame/pass/draws.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"

/* A candidate, and the thread that visits it. */
typedef struct e3d_visit {
    const e3d_geometry_in *in;
    const e3d_geometry_out *out;
    const e3d_prepared *pass;
    e3d_geometry_memory *state;
    e3d_next_clusters *next;
    const e3d_candidate *candidate;
    const e3d_draw_state *draw;
    const e3d_view_instance *instance;
    const e3d_group_box *group;
} e3d_visit;

/* Draws the clusters of a group that are in `wanted` and may show. Returns those of `asked` that may show. Bit k is cluster k. */
unsigned e3d_draw_group(const e3d_visit *v, unsigned asked, unsigned wanted);
