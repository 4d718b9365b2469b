/* The list of a frame's draws: one for each node that shows, or for all nodes of a mesh together. */
#pragma once

#include <stdint.h>

#include "e3d_draw.h"
#include "e3d_scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An object as nodes draw it. If it has a tree of e3d_instance_boxes, its instances outside the view are left out. */
typedef struct e3d_placed {
    e3d_draw draw;
    const e3d_tree *instances;
    int32_t encloses;        /* not 0: it encloses a volume, but for holes, with its fronts outside */
    int32_t holes;
    const int32_t *rim_ends; /* (holes,) */
    /* (rim_ends[holes - 1], 3) the points around each hole, one hole after the other, in the direction of its triangles */
    const double *rims;
} e3d_placed;

typedef struct e3d_node_rows {
    int32_t count;
    const uint8_t *flags;
    const int32_t *object, *id;
    const double *world;
    const int32_t *anchor; /* as in e3d_graph */
    const uint8_t *unshadowed; /* E3D_NODE_CASTS_NONE, E3D_NODE_RECEIVES_NONE; NULL: neither of any */
    int32_t casting;       /* not 0: only objects that cast shadows are drawn */
    const uint32_t *spared_lights; /* as in e3d_draw; NULL: none */
} e3d_node_rows;

/* The draw that merges one object's nodes: those that receive shadows, or those that don't. */
typedef struct e3d_merged_draw {
    int32_t nodes;      /* that are drawn */
    int32_t draw;       /* the draw of all of them; -1: none yet */
    int32_t first, end; /* the rows of those placed so far */
} e3d_merged_draw;

/* Zeroed at first; kept from frame to frame. */
typedef struct e3d_draw_list {
    e3d_draw *draws;
    int32_t count, room;
    int32_t *order;   /* as in e3d_frame; as many as draws if none were merged */
    int32_t order_count, order_room;
    int32_t nodes;    /* that are drawn */
    double *worlds;   /* (nodes, 12) and (nodes,): of merged nodes, one draw after the other */
    int32_t *ids, *slots;
    int32_t node_room;
    e3d_merged_draw *merged; /* two of each object: receivers of shadows, the others */
    int32_t merged_room;
    uint64_t *bits;   /* scratch */
    int32_t words;
    int64_t boxes_tested; /* of instances, and of the branches of their trees */
    int64_t calls;        /* draws, where all runs of one node's instances are one */
    int64_t node_calls;   /* likewise, if no nodes had been merged */
} e3d_draw_list;

void e3d_draw_list_free(e3d_draw_list *list);

/* All nodes that are shown and draw anything, in view or not, and what they draw. */
typedef struct e3d_totals {
    int64_t nodes, instances, clusters, triangles; /* instances: plain meshes count as one each */
} e3d_totals;
e3d_totals e3d_graph_totals(const e3d_node_rows *rows, const e3d_placed *objects, int32_t object_count);

/* Lists the nodes that show and cast shadows, with rows->casting: slot, object and version of each, (count, 3). They are equal as
 * long as the same nodes cast shadows from the same places. selection: as below; versions: of the world poses. Returns how many. */
int32_t e3d_graph_casters(const e3d_node_rows *rows, const uint64_t *selection, const uint32_t *versions, int32_t *found);

/* Lists the draws of the nodes that show, in the order of slots: objects[number] with the node's ID and world pose. selection: a
 * bit a slot, or NULL for all; view: NULL draws all instances; merge: the nodes of one mesh share a draw. Returns 0 when memory
 * is out. */
int e3d_graph_draws(e3d_draw_list *list, const e3d_node_rows *rows, const uint64_t *selection,
                    const e3d_view_volume *view, const e3d_placed *objects, int32_t object_count, int merge);

#ifdef __cplusplus
}
#endif
