/* graph: the tree of nodes: adding, linking, removing and walking, and marking what is out of date.
 * In: slots. Out: links, flags and the list of changed nodes.
 * Always: everything below a STALE node is STALE and LISTED; a node is LISTED at most once, so that the list has room for
 * all. */
#include <string.h>

#include "e3d_scene.h"

static const double IDENTITY[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

int32_t e3d_graph_walk(const e3d_graph *g, int32_t slot, int32_t top)
{
    if (g->first_child[slot] >= 0)
        return g->first_child[slot];
    while (slot != top && g->next[slot] < 0)
        slot = g->parent[slot];
    return slot == top ? -1 : g->next[slot];
}

/* Returns the node that follows everything below `slot`. */
static int32_t walk_past(const e3d_graph *g, int32_t slot, int32_t top)
{
    while (slot != top && g->next[slot] < 0)
        slot = g->parent[slot];
    return slot == top ? -1 : g->next[slot];
}

void e3d_graph_touch(e3d_graph *g, int32_t slot)
{
    for (int32_t at = slot; at >= 0;) {
        if (g->flags[at] & E3D_NODE_STALE) {
            at = walk_past(g, at, slot);
            continue;
        }
        if (!(g->flags[at] & E3D_NODE_LISTED))
            g->changed[g->changed_count++] = at;
        g->flags[at] |= E3D_NODE_STALE | E3D_NODE_LISTED;
        at = e3d_graph_walk(g, at, slot);
    }
}

/* Inserts a node before `before`, a child of the parent; -1 is the end. */
static void put_in(e3d_graph *g, int32_t slot, int32_t parent, int32_t before)
{
    g->parent[slot] = parent;
    g->next[slot] = -1;
    g->previous[slot] = -1;
    if (parent < 0)
        return;
    int32_t after = before < 0 ? g->last_child[parent] : g->previous[before];
    g->previous[slot] = after;
    g->next[slot] = before;
    if (after < 0)
        g->first_child[parent] = slot;
    else
        g->next[after] = slot;
    if (before < 0)
        g->last_child[parent] = slot;
    else
        g->previous[before] = slot;
}

static void take_out(e3d_graph *g, int32_t slot)
{
    int32_t parent = g->parent[slot], previous = g->previous[slot], next = g->next[slot];
    if (parent >= 0 && previous < 0)
        g->first_child[parent] = next;
    if (parent >= 0 && next < 0)
        g->last_child[parent] = previous;
    if (previous >= 0)
        g->next[previous] = next;
    if (next >= 0)
        g->previous[next] = previous;
    g->parent[slot] = g->previous[slot] = g->next[slot] = -1;
}

int32_t e3d_graph_add(e3d_graph *g, int32_t parent, int32_t object, int32_t id)
{
    int32_t slot = g->count++;
    g->first_child[slot] = g->last_child[slot] = -1;
    g->object[slot] = object;
    g->id[slot] = id;
    if (g->anchor)
        g->anchor[slot] = -1;
    g->flags[slot] = E3D_NODE_ALIVE | E3D_NODE_VISIBLE;
    g->pose_version[slot] = g->world_version[slot] = 0;
    memcpy(g->pose + 12 * (size_t)slot, IDENTITY, sizeof IDENTITY);
    put_in(g, slot, parent, -1);
    e3d_graph_touch(g, slot);
    return slot;
}

int e3d_graph_link(e3d_graph *g, int32_t slot, int32_t parent, int32_t before)
{
    for (int32_t above = parent; above >= 0; above = g->parent[above])
        if (above == slot)
            return 0;
    take_out(g, slot);
    put_in(g, slot, parent, before);
    e3d_graph_touch(g, slot);
    return 1;
}

void e3d_graph_remove(e3d_graph *g, int32_t slot)
{
    take_out(g, slot);
    e3d_graph_touch(g, slot);
    for (int32_t at = slot; at >= 0; at = e3d_graph_walk(g, at, slot))
        g->flags[at] &= ~E3D_NODE_ALIVE;
}

void e3d_graph_restore(e3d_graph *g, int32_t slot)
{
    for (int32_t at = slot; at >= 0; at = e3d_graph_walk(g, at, slot))
        g->flags[at] |= E3D_NODE_ALIVE;
    e3d_graph_touch(g, slot);
}

void e3d_graph_set_flag(e3d_graph *g, int32_t slot, int flag, int on)
{
    g->flags[slot] = (uint8_t)(on ? g->flags[slot] | flag : g->flags[slot] & ~flag);
    e3d_graph_touch(g, slot);
}

void e3d_graph_follow(e3d_graph *g, const int32_t *slots, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        int32_t anchor = g->anchor[slots[i]];
        if (anchor >= 0 && g->flags[anchor] & (E3D_NODE_STALE | E3D_NODE_LISTED))
            e3d_graph_touch(g, slots[i]);
    }
}

const double *e3d_placing_pose(const double *world, const int32_t *anchor, int32_t slot)
{
    int32_t by = anchor && anchor[slot] >= 0 ? anchor[slot] : slot;
    return anchor && anchor[slot] == slot ? IDENTITY : world + 12 * (size_t)by;
}

void e3d_graph_touch_objects(e3d_graph *g, const uint8_t *dirty, int32_t objects)
{
    for (int32_t slot = 0; slot < g->count; slot++)
        if (g->object[slot] >= 0 && g->object[slot] < objects && dirty[g->object[slot]])
            e3d_graph_touch(g, slot);
}

void e3d_graph_adopt(e3d_graph *g, int32_t count)
{
    g->count = count;
    g->changed_count = 0;
    for (int32_t slot = 0; slot < count; slot++)
        g->flags[slot] &= ~(E3D_NODE_STALE | E3D_NODE_LISTED);
    for (int32_t slot = 0; slot < count; slot++)
        e3d_graph_touch(g, slot);
}
