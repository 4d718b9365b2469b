/* update: poses in, world poses, visibility and bounds out, for what was touched and what is below it.
 *
 * Method: a node is found from its parent. First come the nodes that others hang from: if a child was listed
 * before its parent, the walk climbs to the topmost stale ancestor. Then come the others, on all threads; anchors have
 * nodes below them, and so are found before what they place.
 * Every node is found once.
 */
#include <math.h>
#include <string.h>

#include "base/fpenv.h"
#include "base/pool.h"
#include "e3d_scene.h"
#include "scene/pose.h"

static void pose_changed(e3d_graph *g, int32_t slot)
{
    g->pose_version[slot]++;
    e3d_graph_touch(g, slot);
}

void e3d_graph_set_pose(e3d_graph *g, int32_t slot, const double pose[12])
{
    memcpy(g->pose + 12 * (size_t)slot, pose, 12 * sizeof *pose);
    g->flags[slot] &= ~E3D_NODE_PARTS;
    pose_changed(g, slot);
}

void e3d_graph_set_translation(e3d_graph *g, int32_t slot, const double translation[3])
{
    double *pose = g->pose + 12 * (size_t)slot;
    for (int k = 0; k < 3; k++)
        pose[4 * k + 3] = translation[k];
    pose_changed(g, slot);
}

void e3d_graph_find_parts(e3d_graph *g, int32_t slot)
{
    size_t at = (size_t)slot;
    if (g->flags[slot] & E3D_NODE_PARTS)
        return;
    e3d_fpenv saved = e3d_fpenv_enter();
    e3d_pose_decompose(g->pose + 12 * at, g->rotation + 4 * at, g->scale + 3 * at);
    e3d_fpenv_leave(saved);
    g->flags[slot] |= E3D_NODE_PARTS;
}

int e3d_graph_set_parts(e3d_graph *g, int32_t slot, const double *rotation, const double *scale)
{
    size_t at = (size_t)slot;
    e3d_graph_find_parts(g, slot);
    const double *new_rotation = rotation ? rotation : g->rotation + 4 * at;
    const double *new_scale = scale ? scale : g->scale + 3 * at;
    e3d_fpenv saved = e3d_fpenv_enter();
    int done = e3d_pose_compose(new_rotation, new_scale, g->pose + 12 * at);
    e3d_fpenv_leave(saved);
    if (!done)
        return 0;
    memmove(g->rotation + 4 * at, new_rotation, 4 * sizeof *new_rotation);
    memmove(g->scale + 3 * at, new_scale, 3 * sizeof *new_scale);
    pose_changed(g, slot);
    return 1;
}

static void find_from_parent(e3d_graph *g, int32_t slot)
{
    size_t at = (size_t)slot;
    int32_t parent = g->parent[slot];
    int above = parent < 0 ? E3D_NODE_SHOWN : g->flags[parent];
    int own = E3D_NODE_ALIVE | E3D_NODE_VISIBLE;
    int shown = (above & E3D_NODE_SHOWN) && (g->flags[slot] & own) == own;
    if (parent < 0)
        memcpy(g->world + 12 * at, g->pose + 12 * at, 12 * sizeof(double));
    else
        e3d_pose_multiply(g->world + 12 * (size_t)parent, g->pose + 12 * at, g->world + 12 * at);
    g->flags[slot] &= ~(E3D_NODE_STALE | E3D_NODE_SHOWN);
    g->flags[slot] |= shown ? E3D_NODE_SHOWN : 0;
    g->world_version[slot]++;
}

void e3d_graph_find_world(e3d_graph *g, int32_t slot)
{
    int32_t depth = 0;
    for (int32_t at = slot; at >= 0 && (g->flags[at] & E3D_NODE_STALE); at = g->parent[at])
        g->stack[depth++] = at;
    if (!depth)
        return;
    e3d_fpenv saved = e3d_fpenv_enter();
    while (depth)
        find_from_parent(g, g->stack[--depth]);
    e3d_fpenv_leave(saved);
}

static void find_bounds(e3d_graph *g, int32_t slot, const double *boxes, int32_t objects)
{
    double *bounds = g->bounds + E3D_BOX * (size_t)slot;
    int32_t object = g->object[slot];
    if ((g->flags[slot] & E3D_NODE_SHOWN) && object >= 0 && object < objects) {
        const double *box = boxes + E3D_OBJECT_BOX * (size_t)object;
        if (box[0] <= box[3]) {
            e3d_pose_box(e3d_placing_pose(g->world, g->anchor, slot), box, bounds);
            return;
        }
    }
    for (int k = 0; k < 3; k++) {
        bounds[k] = INFINITY;
        bounds[3 + k] = -INFINITY;
    }
    bounds[6] = 0;
}

enum { NODES_A_TASK = 1024 };

typedef struct update_job {
    e3d_graph *graph;
    const double *boxes;
    int32_t objects, count; /* of the list */
} update_job;

/* The nodes above have their world poses and keep their flags: a task writes the rows of its own nodes alone. */
static void update_some(void *argument, int task)
{
    const update_job *job = argument;
    e3d_graph *g = job->graph;
    int32_t first = NODES_A_TASK * task, end = job->count - first < NODES_A_TASK ? job->count : first + NODES_A_TASK;
    for (int32_t i = first; i < end; i++) {
        int32_t slot = g->changed[i];
        if (g->flags[slot] & E3D_NODE_STALE)
            find_from_parent(g, slot);
        find_bounds(g, slot, job->boxes, job->objects);
    }
}

void e3d_graph_update(e3d_graph *g, const double *boxes, int32_t objects, int threads)
{
    update_job job = {g, boxes, objects, g->changed_count};
    int32_t tasks = (g->changed_count + NODES_A_TASK - 1) / NODES_A_TASK;
    e3d_fpenv saved = e3d_fpenv_enter();
    for (int32_t i = 0; i < g->changed_count; i++) {
        int32_t slot = g->changed[i];
        g->flags[slot] &= ~E3D_NODE_LISTED;
        if (g->first_child[slot] >= 0)
            e3d_graph_find_world(g, slot);
    }
    e3d_pool_share(threads, tasks, update_some, &job);
    e3d_fpenv_leave(saved);
}
