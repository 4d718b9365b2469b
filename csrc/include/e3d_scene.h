/* Scenes: trees of nodes in arrays, their poses and boxes, and the rays that meet them.
 * In: arrays that the caller owns, one element or row a slot. A node keeps its slot until the caller packs the arrays; slots
 * stand in the order in which the nodes were added.
 * Out: the same arrays, up to date after e3d_graph_update; e3d_draw_list.h makes draws of them.
 * Always: f64, one written order of operations (docs/exactness, section 1), so that a node's numbers do not depend on how many
 * others move with it. Only one thread at a time may use a graph. Affine matrices are three rows of four. */
#pragma once

#include <stdint.h>

#include "e3d.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A box: lowest x y z, highest x y z, and its reach. The reach bounds the absolute value of every coordinate in the box and of
 * every intermediate sum that made it: the margin for rounding is proportional to it. */
enum { E3D_BOX = 7 };

/* A box of an object, in its own space: lowest, highest, and the reach along each axis. */
enum { E3D_OBJECT_BOX = 9 };

enum {
    E3D_NODE_ALIVE = 1,   /* not removed */
    E3D_NODE_VISIBLE = 2, /* the node's own switch */
    E3D_NODE_SHOWN = 4,   /* it and all above it are alive and visible; valid once the node is not stale */
    E3D_NODE_STALE = 8,   /* its world pose and SHOWN are out of date; so are those of all below */
    E3D_NODE_LISTED = 16, /* it stands in the list of nodes that changed since the last update */
    E3D_NODE_PARTS = 32,  /* rotation and scale are those of the pose */
    E3D_NODE_STATIC = 64  /* the caller says that it stays where it is */
};

/* Shadows that a node has no part in: it casts none, or receives none. */
enum { E3D_NODE_CASTS_NONE = 1,
       E3D_NODE_RECEIVES_NONE = 2 };

typedef struct e3d_graph {
    int32_t count;             /* slots in use, removed nodes included */
    int32_t *parent;           /* slots; -1: none */
    int32_t *first_child, *last_child, *next, *previous; /* children in the order of linking */
    int32_t *object;           /* number of what the node draws; -1: nothing */
    int32_t *id;               /* what object_id shows */
    uint8_t *flags;
    double *pose;              /* (slots, 12) parent from node */
    double *rotation, *scale;  /* (slots, 4) quaternion x y z w as given; (slots, 3) */
    double *world;             /* (slots, 12) world from node */
    double *bounds;            /* (slots, E3D_BOX) in the world; lowest > highest where nothing shows */
    /* NULL, or for each slot the node whose world pose places what is drawn; -1: the node itself; its own slot: what is drawn is
     * in world space already */
    int32_t *anchor;
    uint32_t *pose_version, *world_version; /* grow when pose or world change */
    int32_t *changed;          /* the slots that are LISTED */
    int32_t changed_count;
    int32_t *stack;            /* scratch */
} e3d_graph;

/* ---- The tree ---- */

/* Makes a node at the identity in slot `count`, for which there must be room; returns its slot. */
int32_t e3d_graph_add(e3d_graph *graph, int32_t parent, int32_t object, int32_t id);
/* Takes over arrays whose first slots hold nodes; nothing derived is known of them. */
void e3d_graph_adopt(e3d_graph *graph, int32_t count);
/* Makes a node a child of another (-1: a root), before another child, or as the last one (-1). Returns 0 if the parent is the
 * node itself or below it. */
int e3d_graph_link(e3d_graph *graph, int32_t slot, int32_t parent, int32_t before);
/* Unlinks a node from its parent, and marks it and all nodes below as not alive. */
void e3d_graph_remove(e3d_graph *graph, int32_t slot);
/* Makes a removed node, which has no parent, and all nodes below it alive again. */
void e3d_graph_restore(e3d_graph *graph, int32_t slot);
/* The next node of the walk over all nodes below `top`, parents first; -1 at the end. */
int32_t e3d_graph_walk(const e3d_graph *graph, int32_t slot, int32_t top);
/* Switches flags (VISIBLE or STATIC). */
void e3d_graph_set_flag(e3d_graph *graph, int32_t slot, int flag, int on);

/* ---- Poses ---- */

/* Marks the world poses of a node and of all nodes below as out of date. */
void e3d_graph_touch(e3d_graph *graph, int32_t slot);
void e3d_graph_set_pose(e3d_graph *graph, int32_t slot, const double pose[12]);
void e3d_graph_set_translation(e3d_graph *graph, int32_t slot, const double translation[3]);
/* A part that is NULL stays as it is. Returns 0, and changes nothing, if the quaternion's length is zero or not finite. */
int e3d_graph_set_parts(e3d_graph *graph, int32_t slot, const double *rotation, const double *scale);
/* Finds rotation and scale of a pose that was set as a matrix; shear is lost. */
void e3d_graph_find_parts(e3d_graph *graph, int32_t slot);

/* ---- Once a frame ---- */

/* Brings one node's world pose up to date, and those of the nodes above it. */
void e3d_graph_find_world(e3d_graph *graph, int32_t slot);
/* Brings all world poses, SHOWN and bounds up to date. `changed` still lists the nodes that were touched, for callers that
 * follow changes; the caller empties it. boxes: (objects, E3D_OBJECT_BOX); lowest > highest for none. The number of threads
 * doesn't change the result. */
void e3d_graph_update(e3d_graph *graph, const double *boxes, int32_t objects, int threads);
/* Touches those of the nodes whose anchors were touched, since they are drawn elsewhere now. */
void e3d_graph_follow(e3d_graph *graph, const int32_t *slots, int32_t count);
/* The world pose that places what a node draws; anchor may be NULL. */
const double *e3d_placing_pose(const double *world, const int32_t *anchor, int32_t slot);
/* Touches the nodes of objects whose box changed. dirty: (objects,). */
void e3d_graph_touch_objects(e3d_graph *graph, const uint8_t *dirty, int32_t objects);
/* ---- Boxes ---- */

/* The boxes of a mesh's instances in the space of their node: (count, E3D_BOX). An instance whose pose is not finite has none. */
void e3d_instance_boxes(const float *poses, e3d_pose_kind kind, int32_t count,
                        const double box[E3D_OBJECT_BOX], double *boxes);
/* The boxes of triangles in the space of their mesh. A triangle with a vertex that is not finite has none. */
void e3d_triangle_boxes(const float *positions, const int32_t *faces, int32_t count, double *boxes);
/* The box around boxes; 0 if there are none. */
int e3d_boxes_union(const double *boxes, int32_t count, double box[E3D_OBJECT_BOX]);

/* ---- Trees of boxes ---- */

typedef struct e3d_tree e3d_tree;

/* NULL when memory is out. */
e3d_tree *e3d_tree_create(void);
void e3d_tree_destroy(e3d_tree *tree);
/* Builds a tree over the rows of boxes, (count, E3D_BOX); an item's number is its row. Rows without a box are left out. Returns
 * 0 when memory is out; the tree is then empty. The number of threads doesn't change the tree. */
int e3d_tree_build(e3d_tree *tree, const double *boxes, int32_t count, int threads);
/* Brings a tree up to date after the listed rows changed or new ones came; builds it again where that is better. Results as
 * above. */
int e3d_tree_refit(e3d_tree *tree, const double *boxes, int32_t count, const int32_t *moved, int32_t moves, int threads);

typedef struct e3d_view_volume {
    double clip_from_world[16];
    double widen; /* a factor, 1 or more, by which the side planes move outwards, for what is drawn wider than its box */
    int flat;     /* all items' boxes are tested one by one, and the tree's branches never */
} e3d_view_volume;

/* Sets the bits of the items that may show, by the planes of the clip volume. The bits do not depend on `flat`. Returns how many
 * boxes were tested: those of items and of branches. */
int64_t e3d_tree_select(const e3d_tree *tree, const double *boxes, const e3d_view_volume *view, uint64_t *bits);

/* The number of levels of a tree. Level 0 holds the boxes of items; a box of any other level encloses up to four of the level
 * below. */
int e3d_tree_levels(const e3d_tree *tree);
/* Writes the boxes of a level, (boxes, 6): lowest x y z, highest x y z; NULL: none. Returns how many there are. */
int32_t e3d_tree_level_boxes(const e3d_tree *tree, int level, float *boxes);

/* Sets the bits of the items whose boxes meet or touch a box. */
void e3d_tree_overlaps(const e3d_tree *tree, const double low[3], const double high[3], uint64_t *bits);
/* Sets the bits of the items whose boxes a ray (unit direction) may meet within `farthest`. */
void e3d_tree_ray(const e3d_tree *tree, const double origin[3], const double direction[3], double farthest,
                  uint64_t *bits);

/* ---- Rays ---- */

/* An object as rays meet it: triangles, perhaps at many poses. Arrays and trees are borrowed. */
typedef struct e3d_shape {
    int32_t known;               /* 0: ask for it */
    int32_t face_count;
    const float *positions;      /* (vertices, 3) */
    const int32_t *faces;        /* (face_count, 3) */
    const e3d_tree *triangles;   /* of e3d_triangle_boxes */
    e3d_pose_kind pose_kind;
    int32_t instances;
    const float *poses;
    const e3d_tree *instance_tree; /* of e3d_instance_boxes */
} e3d_shape;

typedef struct e3d_hit {
    double distance;
    double position[3], normal[3]; /* in the world; the normal has length 1 and is that of the face's front */
    double barycentric[3];
    int32_t slot, instance, face;  /* slot: -1 where nothing was met */
} e3d_hit;

/* Finds the nearest hit of a ray (world, unit direction) on the faces of what shows, within `farthest`. At equal distances the
 * first in the order of drawing counts. Returns the number of an object whose shape is still missing, or else -1. */
int32_t e3d_graph_ray(const e3d_graph *graph, const e3d_tree *tree, const e3d_shape *shapes,
                      int32_t shape_count, const double origin[3], const double direction[3],
                      double farthest, e3d_cull cull, e3d_hit *hit);
/* Many rays. `lacks`: (count,), for each ray -1 once it is cast, else the number of an object whose shape is missing; 0 or more
 * to begin with. `ids`: (count, 3) slot, instance, face; `values`: (count, 10) distance, position, normal, barycentric. */
typedef struct e3d_rays {
    int32_t count;
    const double *origins, *directions; /* (count, 3) */
    double farthest;
    e3d_cull cull;
    int32_t *ids, *lacks;
    double *values;
} e3d_rays;

/* Casts those that are not cast yet; returns whether all are now. The number of threads doesn't change the result. */
int e3d_graph_rays(const e3d_graph *graph, const e3d_tree *tree, const e3d_shape *shapes, int32_t shape_count,
                   const e3d_rays *rays, int threads);
/* The same for what one node shows; nothing where its shape is missing. */
void e3d_node_ray(const e3d_graph *graph, const e3d_shape *shapes, int32_t shape_count, int32_t slot,
                  const double origin[3], const double direction[3], double farthest, e3d_hit *hit);
/* The same for one shape without instances, at the pose `world`; its slot is 0. */
void e3d_shape_ray(const e3d_shape *shape, const double world[12], const double origin[3],
                   const double direction[3], double farthest, e3d_cull cull, e3d_hit *hit);

/* ---- Cameras ---- */

/* What a frame needs of a camera at a pose. */
typedef struct e3d_camera {
    double view_from_world[16], clip_from_world[16];
    double towards_viewer[3]; /* unit, in the world */
    double eye[4];            /* position and 1; without perspective towards_viewer and 0 */
} e3d_camera;

/* The inverse of a 4x4 matrix; 0 if it has none. */
int e3d_invert(const double m[16], double out[16]);

/* 0 if the pose has no inverse. */
int e3d_camera_view(const double clip_from_view[16], const double world_from_view[16], e3d_camera *out);

#ifdef __cplusplus
}
#endif
