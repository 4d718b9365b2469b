/* Fuzzes the tree of a scene's nodes: a byte an operation, then what it needs.
 *
 * Claims: links are those of a tree; what an update finds piece by piece is, to the bit, what it finds when nothing
 * is known; the tree of boxes finds what a look at every box finds; draws and rays speak of nodes that show.
 */
#include "e3d_draw_list.h"
#include "e3d_scene.h"

#include <math.h>

#include "check/fuzz/input.h"

enum { ROOM = 24,
       OBJECTS = 3,
       VERTICES = 6,
       FACES = 4,
       INSTANCES = 5 };

typedef struct columns {
    int32_t parent[ROOM], first_child[ROOM], last_child[ROOM], next[ROOM], previous[ROOM], object[ROOM], id[ROOM];
    uint8_t flags[ROOM];
    double pose[12 * ROOM], rotation[4 * ROOM], scale[3 * ROOM], world[12 * ROOM], bounds[E3D_BOX * ROOM];
    uint32_t pose_version[ROOM], world_version[ROOM];
    int32_t changed[ROOM], stack[ROOM];
} columns;

typedef struct world {
    e3d_graph graph;
    columns columns;
    e3d_tree *tree, *triangles[OBJECTS], *instances;
    double boxes[OBJECTS * E3D_OBJECT_BOX], mesh_box[E3D_OBJECT_BOX];
    float positions[OBJECTS][3 * VERTICES], poses[4 * INSTANCES];
    int32_t faces[OBJECTS][3 * FACES];
    e3d_shape shapes[OBJECTS];
    e3d_placed placed[OBJECTS];
    e3d_draw_list list;
    int updated;
} world;

static void use_columns(e3d_graph *g, columns *c)
{
    g->parent = c->parent, g->first_child = c->first_child, g->last_child = c->last_child;
    g->next = c->next, g->previous = c->previous, g->object = c->object, g->id = c->id;
    g->flags = c->flags, g->pose = c->pose, g->rotation = c->rotation, g->scale = c->scale;
    g->world = c->world, g->bounds = c->bounds, g->changed = c->changed, g->stack = c->stack;
    g->pose_version = c->pose_version, g->world_version = c->world_version;
}

static void take_object(world *w, input *in, int k)
{
    double triangle_boxes[FACES * E3D_BOX], instance_boxes[INSTANCES * E3D_BOX];
    double *own = w->boxes + k * E3D_OBJECT_BOX;
    for (int i = 0; i < 3 * VERTICES; i++)
        w->positions[k][i] = (float)take_number(in);
    for (int i = 0; i < 3 * FACES; i++)
        w->faces[k][i] = take_below(in, VERTICES);
    e3d_triangle_boxes(w->positions[k], w->faces[k], FACES, triangle_boxes);
    e3d_boxes_union(triangle_boxes, FACES, own);
    e3d_shape *shape = &w->shapes[k];
    *shape = (e3d_shape){.known = 1,
                         .face_count = FACES,
                         .positions = w->positions[k],
                         .faces = w->faces[k],
                         .pose_kind = E3D_POSE_NONE,
                         .instances = 1};
    e3d_draw *draw = &w->placed[k].draw;
    draw->mesh = (const e3d_mesh *)(const void *)w; /* not looked into */
    draw->instances = 1;
    if (k == 0) {
        memcpy(w->mesh_box, own, sizeof w->mesh_box);
        e3d_instance_boxes(w->poses, E3D_POSE_OFFSET_SCALE, INSTANCES, w->mesh_box, instance_boxes);
        e3d_boxes_union(instance_boxes, INSTANCES, own);
        shape->pose_kind = draw->pose_kind = E3D_POSE_OFFSET_SCALE;
        shape->poses = draw->poses = w->poses;
        shape->instances = draw->instances = INSTANCES;
    }
}

static e3d_tree *tree_of(const double *boxes, int32_t count)
{
    e3d_tree *tree = e3d_tree_create();
    CLAIM(tree && e3d_tree_build(tree, boxes, count, 1));
    return tree;
}

/* Trees take long to build: only for those who look at them. */
static void need_trees(world *w)
{
    double boxes[(FACES + INSTANCES) * E3D_BOX];
    if (w->instances)
        return;
    for (int k = 0; k < OBJECTS; k++) {
        e3d_triangle_boxes(w->positions[k], w->faces[k], FACES, boxes);
        w->shapes[k].triangles = w->triangles[k] = tree_of(boxes, FACES);
    }
    e3d_instance_boxes(w->poses, E3D_POSE_OFFSET_SCALE, INSTANCES, w->mesh_box, boxes);
    w->shapes[0].instance_tree = w->placed[0].instances = w->instances = tree_of(boxes, INSTANCES);
}

static int is_below(const e3d_graph *g, int32_t slot, int32_t top)
{
    for (; slot >= 0; slot = g->parent[slot])
        if (slot == top)
            return 1;
    return 0;
}

static void claim_links(const e3d_graph *g)
{
    for (int32_t slot = 0; slot < g->count; slot++) {
        int32_t above = slot, steps = 0, last = -1;
        while (g->parent[above] >= 0 && steps++ <= g->count)
            above = g->parent[above];
        CLAIM(steps <= g->count);
        for (int32_t child = g->first_child[slot]; child >= 0; child = g->next[child]) {
            CLAIM(g->parent[child] == slot && g->previous[child] == last);
            last = child;
        }
        CLAIM(g->last_child[slot] == last);
    }
}

/* Everything derived again, from nothing. */
static void claim_update(const world *w)
{
    columns again = w->columns;
    e3d_graph fresh = w->graph;
    use_columns(&fresh, &again);
    e3d_graph_adopt(&fresh, w->graph.count);
    e3d_graph_update(&fresh, w->boxes, OBJECTS, 1);
    for (int32_t slot = 0; slot < fresh.count; slot++) {
        CLAIM(memcmp(again.world + 12 * slot, w->columns.world + 12 * slot, 12 * sizeof(double)) == 0);
        CLAIM(memcmp(again.bounds + E3D_BOX * slot, w->columns.bounds + E3D_BOX * slot, E3D_BOX * sizeof(double)) == 0);
        CLAIM(((again.flags[slot] ^ w->columns.flags[slot]) & E3D_NODE_SHOWN) == 0);
        CLAIM(!(w->columns.flags[slot] & E3D_NODE_STALE));
    }
}

static void update(world *w)
{
    e3d_graph *g = &w->graph;
    e3d_graph_update(g, w->boxes, OBJECTS, 1);
    claim_update(w);
    const int32_t moved = g->changed_count;
    g->changed_count = 0;
    if (w->tree)
        CLAIM(e3d_tree_refit(w->tree, g->bounds, g->count, g->changed, moved, 1));
    else
        w->tree = tree_of(g->bounds, g->count);
    w->updated = 1;
}

static void take_matrix(input *in, double *m, int count)
{
    for (int k = 0; k < count; k++)
        m[k] = k % 5 ? 0.0 : 1.0;
    for (int some = take_below(in, count + 1); some > 0; some--) {
        const int place = take_below(in, count);
        m[place] = take_number(in);
    }
}

static void claim_shown(const e3d_graph *g, int32_t id)
{
    CLAIM(id >= 0 && id < g->count && (g->flags[id] & E3D_NODE_SHOWN)); /* slots are their nodes' ids */
}

/* Each node that shows has one turn a draw, in the order of slots. */
static void claim_draws(const world *w)
{
    int32_t next[ROOM * INSTANCES] = {0}, last = -1;
    CLAIM(w->list.count <= ROOM * INSTANCES);
    for (int32_t k = 0; k < w->list.order_count; k++) {
        const int32_t number = w->list.order[k];
        CLAIM(number >= 0 && number < w->list.count);
        const e3d_draw *draw = &w->list.draws[number];
        const int is_batch = draw->pose_kind == E3D_POSE_NODES;
        CLAIM(next[number] < (is_batch ? draw->instances : 1));
        const int32_t id = is_batch ? draw->node_ids[next[number]] : draw->node_id;
        next[number]++;
        claim_shown(&w->graph, id);
        CLAIM(id >= last);
        last = id;
        CLAIM(draw->instances > 0 && draw->first_instance >= 0);
        CLAIM(is_batch || draw->first_instance + draw->instances <= INSTANCES);
    }
}

/* No box that the planes let pass is lost, and none comes that is no box. */
static void select_and_draw(world *w, input *in)
{
    e3d_graph *g = &w->graph;
    uint64_t bits[1] = {0}, fresh_bits[1] = {0}, flat_bits[1] = {0};
    e3d_view_volume view = {.widen = 1.0 + take_below(in, 3) * 0.5};
    take_matrix(in, view.clip_from_world, 16);
    need_trees(w);
    e3d_tree_select(w->tree, g->bounds, &view, bits);
    e3d_tree *fresh = tree_of(g->bounds, g->count);
    e3d_tree_select(fresh, g->bounds, &view, fresh_bits);
    view.flat = 1;
    CLAIM(e3d_tree_select(fresh, g->bounds, &view, flat_bits) <= g->count);
    view.flat = take_below(in, 2);
    e3d_tree_destroy(fresh);
    CLAIM(bits[0] == fresh_bits[0] && bits[0] == flat_bits[0] && bits[0] >> g->count == 0);
    const e3d_node_rows rows = {g->count, g->flags, g->object, g->id, g->world, NULL, NULL, 0, NULL};
    CLAIM(e3d_graph_draws(&w->list, &rows, take_below(in, 2) ? bits : NULL, take_below(in, 2) ? &view : NULL,
                          w->placed, OBJECTS, take_below(in, 2)));
    claim_draws(w);
}

static void cast_ray(world *w, input *in)
{
    double origin[3], direction[3], length = 0.0;
    for (int k = 0; k < 3; k++) {
        origin[k] = take_number(in);
        direction[k] = take_number(in);
        length += direction[k] * direction[k];
    }
    if (!isfinite(length) || length == 0.0 || !isfinite(origin[0] + origin[1] + origin[2]))
        return; /* Python refuses it */
    for (int k = 0; k < 3; k++)
        direction[k] /= sqrt(length);
    need_trees(w);
    e3d_hit hit;
    CLAIM(e3d_graph_ray(&w->graph, w->tree, w->shapes, OBJECTS, origin, direction, INFINITY, (e3d_cull)take_below(in, 3),
                        &hit) == -1);
    if (hit.slot < 0)
        return;
    CLAIM(hit.slot < w->graph.count && (w->graph.flags[hit.slot] & E3D_NODE_SHOWN));
    CLAIM(hit.face >= 0 && hit.face < FACES && hit.instance >= 0 && hit.instance < INSTANCES);
    CLAIM(hit.distance >= 0.0);
}

static void overlap(world *w, input *in)
{
    double low[3], high[3];
    uint64_t bits[1] = {0}, expected = 0;
    for (int k = 0; k < 3; k++) {
        low[k] = take_number(in);
        high[k] = take_number(in);
    }
    e3d_tree *fresh = tree_of(w->graph.bounds, w->graph.count);
    e3d_tree_overlaps(fresh, low, high, bits);
    e3d_tree_destroy(fresh);
    for (int32_t slot = 0; slot < w->graph.count; slot++) {
        const double *box = w->graph.bounds + E3D_BOX * slot;
        int meets = box[0] <= box[3];
        for (int k = 0; k < 3; k++)
            meets &= box[k] <= high[k] && box[3 + k] >= low[k] && low[k] <= high[k];
        expected |= (uint64_t)meets << slot;
    }
    CLAIM((expected & ~bits[0]) == 0); /* a box may be a little wider there */
    CLAIM(bits[0] >> w->graph.count == 0);
}

static void set_pose(world *w, input *in, int32_t slot)
{
    double numbers[16];
    switch (take_below(in, 4)) {
    case 0:
        take_matrix(in, numbers, 12);
        e3d_graph_set_pose(&w->graph, slot, numbers);
        break;
    case 1:
        take_matrix(in, numbers, 3);
        e3d_graph_set_translation(&w->graph, slot, numbers);
        break;
    case 2:
        take_matrix(in, numbers, 7);
        e3d_graph_set_parts(&w->graph, slot, take_below(in, 2) ? numbers : NULL, take_below(in, 2) ? numbers + 4 : NULL);
        break;
    default: e3d_graph_find_parts(&w->graph, slot);
    }
}

static void operate(world *w, input *in)
{
    e3d_graph *g = &w->graph;
    const uint32_t operation = take_byte(in);
    const int32_t slot = g->count ? take_below(in, g->count) : -1;
    if (operation % 8 == 0 || slot < 0) {
        if (g->count < ROOM)
            e3d_graph_add(g, slot, take_below(in, OBJECTS + 2) - 1, g->count);
        return;
    }
    const int is_alive = g->flags[slot] & E3D_NODE_ALIVE;
    switch (operation % 8) {
    case 1:
        if (is_alive) {
            const int32_t parent = take_below(in, g->count + 1) - 1;
            const int wrong = parent >= 0 && is_below(g, parent, slot);
            int32_t before = parent < 0 || take_below(in, 2) ? -1 : g->first_child[parent];
            before = before == slot ? g->next[before] : before;
            CLAIM(e3d_graph_link(g, slot, parent, before) == !wrong);
        }
        break;
    case 2:
        if (is_alive && take_below(in, 3) == 0)
            e3d_graph_remove(g, slot);
        else if (!is_alive && g->parent[slot] < 0)
            e3d_graph_restore(g, slot);
        break;
    case 3: e3d_graph_set_flag(g, slot, take_below(in, 2) ? E3D_NODE_VISIBLE : E3D_NODE_STATIC, take_below(in, 2)); break;
    case 4: set_pose(w, in, slot); return;
    case 5: e3d_graph_find_world(g, slot); return;
    case 6: update(w); return;
    default:
        if (!w->updated || g->changed_count)
            update(w);
        switch (take_below(in, 3)) {
        case 0: select_and_draw(w, in); break;
        case 1: cast_ray(w, in); break;
        default: overlap(w, in);
        }
        return;
    }
    claim_links(g);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static world w;
    input in = {bytes, size};
    memset(&w, 0, sizeof w);
    use_columns(&w.graph, &w.columns);
    for (int k = 0; k < 4 * INSTANCES; k++)
        w.poses[k] = (float)take_number(&in);
    for (int k = 0; k < OBJECTS; k++)
        take_object(&w, &in, k);
    for (int k = 0; k < 200 && in.left; k++)
        operate(&w, &in);
    e3d_draw_list_free(&w.list);
    e3d_tree_destroy(w.tree);
    e3d_tree_destroy(w.instances);
    for (int k = 0; k < OBJECTS; k++)
        e3d_tree_destroy(w.triangles[k]);
    return 0;
}
