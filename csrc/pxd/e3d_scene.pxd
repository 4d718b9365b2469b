# Mirrors csrc/include/e3d_scene.h, which explains every name.

from libc.stdint cimport int32_t, int64_t, uint8_t, uint32_t, uint64_t

from e3d cimport e3d_cull, e3d_draw, e3d_pose_kind, e3d_window


cdef extern from "e3d_scene.h" nogil:
    enum:
        E3D_NODE_ALIVE
        E3D_NODE_VISIBLE
        E3D_NODE_SHOWN
        E3D_NODE_STATIC
        E3D_BOX
        E3D_OBJECT_BOX

    ctypedef struct e3d_graph:
        int32_t count
        int32_t *parent
        int32_t *first_child
        int32_t *last_child
        int32_t *next
        int32_t *previous
        int32_t *object
        int32_t *id
        uint8_t *flags
        double *pose
        double *rotation
        double *scale
        double *world
        double *bounds
        uint32_t *pose_version
        uint32_t *world_version
        int32_t *changed
        int32_t changed_count
        int32_t *stack
        int32_t *anchor

    int32_t e3d_graph_add(e3d_graph *graph, int32_t parent, int32_t object, int32_t id)
    void e3d_graph_adopt(e3d_graph *graph, int32_t count)
    bint e3d_graph_link(
        e3d_graph *graph, int32_t slot, int32_t parent, int32_t before
    )
    void e3d_graph_remove(e3d_graph *graph, int32_t slot)
    void e3d_graph_restore(e3d_graph *graph, int32_t slot)
    int32_t e3d_graph_walk(const e3d_graph *graph, int32_t slot, int32_t top)
    void e3d_graph_set_flag(e3d_graph *graph, int32_t slot, int flag, bint on)
    void e3d_graph_set_pose(e3d_graph *graph, int32_t slot, const double *pose)
    void e3d_graph_set_translation(e3d_graph *graph, int32_t slot, const double *translation)
    bint e3d_graph_set_parts(
        e3d_graph *graph, int32_t slot, const double *rotation, const double *scale
    )
    void e3d_graph_find_parts(e3d_graph *graph, int32_t slot)
    void e3d_graph_find_world(e3d_graph *graph, int32_t slot)
    void e3d_graph_update(e3d_graph *graph, const double *boxes, int32_t objects, int threads)
    void e3d_graph_touch(e3d_graph *graph, int32_t slot)
    void e3d_graph_follow(e3d_graph *graph, const int32_t *slots, int32_t count)
    void e3d_graph_touch_objects(e3d_graph *graph, const uint8_t *dirty, int32_t objects)

    void e3d_instance_boxes(
        const float *poses, e3d_pose_kind kind, int32_t count, const double *box, double *boxes
    )
    void e3d_triangle_boxes(
        const float *positions, const int32_t *faces, int32_t count, double *boxes
    )
    bint e3d_boxes_union(const double *boxes, int32_t count, double *box)

    ctypedef struct e3d_tree:
        pass

    e3d_tree *e3d_tree_create()
    void e3d_tree_destroy(e3d_tree *tree)
    bint e3d_tree_build(e3d_tree *tree, const double *boxes, int32_t count, int threads)
    bint e3d_tree_refit(
        e3d_tree *tree, const double *boxes, int32_t count, const int32_t *moved, int32_t moves,
        int threads,
    )

    ctypedef struct e3d_view_volume:
        double clip_from_world[16]
        double widen
        bint flat

    int64_t e3d_tree_select(
        const e3d_tree *tree, const double *boxes, const e3d_view_volume *view, uint64_t *bits
    )

    int e3d_tree_levels(const e3d_tree *tree)
    int32_t e3d_tree_level_boxes(const e3d_tree *tree, int level, float *boxes)

    void e3d_tree_overlaps(
        const e3d_tree *tree, const double *low, const double *high, uint64_t *bits
    )

    void e3d_tree_ray(
        const e3d_tree *tree, const double *origin, const double *direction, double farthest,
        uint64_t *bits,
    )

    ctypedef struct e3d_shape:
        int32_t known
        int32_t face_count
        const float *positions
        const int32_t *faces
        const e3d_tree *triangles
        e3d_pose_kind pose_kind
        int32_t instances
        const float *poses
        const e3d_tree *instance_tree

    ctypedef struct e3d_hit:
        double distance
        double position[3]
        double normal[3]
        double barycentric[3]
        int32_t slot
        int32_t instance
        int32_t face

    int32_t e3d_graph_ray(
        const e3d_graph *graph, const e3d_tree *tree, const e3d_shape *shapes,
        int32_t shape_count, const double *origin, const double *direction, double farthest,
        e3d_cull cull, e3d_hit *hit,
    )
    void e3d_shape_ray(
        const e3d_shape *shape, const double *world, const double *origin,
        const double *direction, double farthest, e3d_cull cull, e3d_hit *hit,
    )

    ctypedef struct e3d_placed:
        e3d_draw draw
        e3d_tree *instances
        int32_t encloses
        int32_t holes
        const int32_t *rim_ends
        const double *rims

    ctypedef struct e3d_node_rows:
        int32_t count
        const uint8_t *flags
        const int32_t *object
        const int32_t *id
        const double *world
        const int32_t *anchor
        const uint8_t *unshadowed
        int32_t casting
        const uint32_t *spared_lights

    ctypedef struct e3d_draw_list:
        e3d_draw *draws
        int32_t count
        int32_t *order
        int32_t order_count
        int32_t nodes
        int64_t boxes_tested

    ctypedef struct e3d_totals:
        int64_t clusters
        int64_t triangles

    e3d_totals e3d_graph_totals(
        const e3d_node_rows *rows, const e3d_placed *objects, int32_t object_count
    )
    void e3d_draw_list_free(e3d_draw_list *list)
    bint e3d_graph_draws(
        e3d_draw_list *list, const e3d_node_rows *rows, const uint64_t *selection,
        const e3d_view_volume *view, const e3d_placed *objects, int32_t object_count, bint batch,
    )

    ctypedef struct e3d_camera:
        double view_from_world[16]
        double clip_from_world[16]
        double towards_viewer[3]
        double eye[4]

    bint e3d_invert(const double *m, double *out)
    bint e3d_camera_view(
        const double *clip_from_view, const double *world_from_view, e3d_camera *out
    )


cdef extern from "e3d_windows.h" nogil:
    ctypedef struct e3d_looking:
        double clip_from_world[16]
        double view_from_world[16]
        int32_t width
        int32_t height

    int32_t e3d_find_windows(
        const e3d_draw_list *list, const e3d_node_rows *rows, const double *bounds,
        const e3d_placed *objects, const e3d_looking *looking, e3d_window *windows,
    )
