/* draws: turns slots into the draws of a frame, and keeps the order in which the nodes were added. Nodes of the same mesh
 * become one draw, whose nodes take their turns in that order. Of many instances only those that may show are drawn, as runs
 * of neighbours; the order stays instance, then face, and first_instance keeps the instances' numbers. */
#include <stdlib.h>
#include <string.h>

#include "base/fpenv.h"
#include "data/mesh/mesh.h"
#include "e3d_draw_list.h"

/* A run continues over so many instances that do not show, since another draw would cost more. */
enum { GAP = 3 };

void e3d_draw_list_free(e3d_draw_list *list)
{
    free(list->draws);
    free(list->order);
    free(list->worlds);
    free(list->ids);
    free(list->slots);
    free(list->merged);
    free(list->bits);
    memset(list, 0, sizeof *list);
}

/* Makes room for `count` elements behind the pointer that `array` points to; 0 when memory is out. */
static int reserve(void *array, int32_t count, size_t size)
{
    void *data;
    memcpy(&data, array, sizeof data);
    data = realloc(data, (size_t)count * size);
    if (data)
        memcpy(array, &data, sizeof data);
    return data != NULL;
}

/* Gives a draw a place in the order. */
static int take_turn(e3d_draw_list *list, int32_t draw)
{
    if (list->order_count == list->order_room) {
        int32_t room = list->order_room ? 2 * list->order_room : 64;
        if (!reserve(&list->order, room, sizeof *list->order))
            return 0;
        list->order_room = room;
    }
    list->order[list->order_count++] = draw;
    return 1;
}

/* Adds a draw without a place in the order. */
static e3d_draw *append(e3d_draw_list *list)
{
    if (list->count == list->room) {
        int32_t room = list->room ? 2 * list->room : 64;
        if (!reserve(&list->draws, room, sizeof *list->draws))
            return NULL;
        list->room = room;
    }
    return &list->draws[list->count++];
}

static int append_run(e3d_draw_list *list, const e3d_draw *whole, int32_t first, int32_t end)
{
    e3d_draw *draw = append(list);
    if (!draw)
        return 0;
    *draw = *whole;
    draw->poses += (size_t)first * (whole->pose_kind == E3D_POSE_MATRIX ? 16 : 4);
    draw->instances = end - first;
    draw->first_instance = first;
    if (draw->instance_ids)
        draw->instance_ids += first;
    if (draw->instance_colors_u8)
        draw->instance_colors_u8 += 4 * (size_t)first;
    if (draw->instance_colors_f32)
        draw->instance_colors_f32 += 4 * (size_t)first;
    return take_turn(list, list->count - 1);
}

static int append_runs(e3d_draw_list *list, const e3d_draw *whole)
{
    int32_t first = -1, end = 0;
    for (int32_t word = 0; word <= (whole->instances - 1) / 64; word++)
        for (uint64_t bits = list->bits[word]; bits; bits &= bits - 1) {
            int32_t instance = 64 * word + __builtin_ctzll(bits);
            if (first >= 0 && instance - end > GAP) {
                if (!append_run(list, whole, first, end))
                    return 0;
                first = -1;
            }
            first = first < 0 ? instance : first;
            end = instance + 1;
        }
    return first < 0 || append_run(list, whole, first, end);
}

/* Lists the instances that may show, by planes that are transformed into the node's space. */
static int select_instances(e3d_draw_list *list, const e3d_view_volume *view, const e3d_placed *object,
                            const double world[16])
{
    e3d_view_volume from_node = *view;
    int32_t words = (object->draw.instances + 63) / 64;
    if (words > list->words) {
        uint64_t *bits = realloc(list->bits, (size_t)words * sizeof *bits);
        if (!bits)
            return 0;
        list->bits = bits;
        list->words = words;
    }
    memset(list->bits, 0, (size_t)words * sizeof *list->bits);
    e3d_fpenv saved = e3d_fpenv_enter();
    for (int r = 0; r < 4; r++)
        for (int c = 0; c < 4; c++) {
            const double *m = view->clip_from_world + 4 * r;
            from_node.clip_from_world[4 * r + c] =
                ((m[0] * world[c] + m[1] * world[4 + c]) + m[2] * world[8 + c]) + m[3] * world[12 + c];
        }
    e3d_fpenv_leave(saved);
    list->boxes_tested += e3d_tree_select(object->instances, NULL, &from_node, list->bits);
    return 1;
}

/* A node as it is drawn. */
typedef struct drawn_node {
    const double *world; /* three rows of four */
    int32_t id, unshadowed;
    uint32_t spared_lights;
} drawn_node;

static int append_node(e3d_draw_list *list, const e3d_placed *object, const drawn_node *node, const e3d_view_volume *view)
{
    static const double LAST_ROW[4] = {0, 0, 0, 1};
    e3d_draw draw = object->draw;
    memcpy(draw.world_from_node, node->world, 12 * sizeof *node->world);
    memcpy(draw.world_from_node + 12, LAST_ROW, sizeof LAST_ROW);
    draw.node_id = node->id;
    draw.unshadowed = node->unshadowed;
    draw.spared_lights = node->spared_lights;
    if (view && object->instances)
        return select_instances(list, view, object, draw.world_from_node) && append_runs(list, &draw);
    e3d_draw *to = append(list);
    if (to)
        *to = draw;
    return to && take_turn(list, list->count - 1);
}

/* ---- merged draws ---- */

/* Finds the one draw for all nodes of a mesh; it is made when the first of them is met. */
static int begin_merged_draw(e3d_draw_list *list, const e3d_placed *object, e3d_merged_draw *merged, int32_t unshadowed)
{
    e3d_draw *draw = append(list);
    if (!draw)
        return 0;
    *draw = object->draw;
    draw->pose_kind = E3D_POSE_NODES;
    draw->instances = merged->nodes;
    draw->node_worlds = list->worlds + 12 * (size_t)merged->first;
    draw->node_ids = list->ids + merged->first;
    draw->unshadowed = unshadowed;
    merged->draw = list->count - 1;
    return 1;
}

static int append_member(e3d_draw_list *list, const e3d_placed *object, e3d_merged_draw *merged, const drawn_node *node)
{
    if (merged->draw < 0 && !begin_merged_draw(list, object, merged, node->unshadowed))
        return 0;
    memcpy(list->worlds + 12 * (size_t)merged->end, node->world, 12 * sizeof *node->world);
    list->ids[merged->end++] = node->id;
    return take_turn(list, merged->draw);
}

/* Finds where the rows of each merged draw's nodes begin. */
static void lay_out_merged_draws(e3d_draw_list *list, int32_t count)
{
    int32_t first = 0;
    for (int32_t i = 0; i < count; i++) {
        list->merged[i].first = list->merged[i].end = first;
        first += list->merged[i].nodes;
    }
}

/* ---- nodes ---- */

static int reserve_all(e3d_draw_list *list, int32_t slots, int32_t count)
{
    if (count > list->merged_room) {
        if (!reserve(&list->merged, count, sizeof *list->merged))
            return 0;
        list->merged_room = count;
    }
    if (slots > list->node_room) {
        if (!reserve(&list->worlds, slots, 12 * sizeof *list->worlds) ||
            !reserve(&list->ids, slots, sizeof *list->ids) || !reserve(&list->slots, slots, sizeof *list->slots))
            return 0;
        list->node_room = slots;
    }
    return 1;
}

/* Whether a slot draws anything, wherever it is. */
static int draws_at(const e3d_node_rows *rows, int32_t slot, const e3d_placed *objects, int32_t object_count)
{
    int32_t number = rows->object[slot];
    return (rows->flags[slot] & E3D_NODE_SHOWN) && number >= 0 && number < object_count &&
           objects[number].draw.mesh;
}

e3d_totals e3d_graph_totals(const e3d_node_rows *rows, const e3d_placed *objects, int32_t object_count)
{
    e3d_totals totals = {0};
    for (int32_t slot = 0; slot < rows->count; slot++)
        if (draws_at(rows, slot, objects, object_count)) {
            const e3d_draw *draw = &objects[rows->object[slot]].draw;
            totals.nodes++;
            totals.instances += draw->instances;
            totals.clusters += (int64_t)draw->mesh->cluster_count * draw->instances;
            totals.triangles += (int64_t)draw->mesh->desc.faces_count * draw->instances;
        }
    return totals;
}

static int32_t receives_none(const e3d_node_rows *rows, int32_t slot)
{
    return rows->unshadowed && rows->unshadowed[slot] & E3D_NODE_RECEIVES_NONE ? 1 : 0;
}

static int casts_none(const e3d_node_rows *rows, int32_t slot)
{
    return rows->casting && rows->unshadowed && rows->unshadowed[slot] & E3D_NODE_CASTS_NONE;
}

static uint32_t spared_lights(const e3d_node_rows *rows, int32_t slot) { return rows->spared_lights ? rows->spared_lights[slot] : 0; }

static e3d_merged_draw *merged_draw_of(const e3d_draw_list *list, const e3d_node_rows *rows, int32_t slot)
{
    return &list->merged[2 * (size_t)rows->object[slot] + (size_t)receives_none(rows, slot)];
}

/* The next slot whose bit is set, from `slot` on; `count` if there is none. */
static int32_t next_selected(const uint64_t *selection, int32_t slot, int32_t count)
{
    while (selection && slot < count) {
        uint64_t left = selection[slot >> 6] >> (slot & 63);
        if (left)
            return slot + __builtin_ctzll(left) < count ? slot + __builtin_ctzll(left) : count;
        slot = (slot | 63) + 1;
    }
    return slot;
}

int32_t e3d_graph_casters(const e3d_node_rows *rows, const uint64_t *selection, const uint32_t *versions, int32_t *found)
{
    int32_t count = 0;
    for (int32_t slot = next_selected(selection, 0, rows->count); slot < rows->count;
         slot = next_selected(selection, slot + 1, rows->count)) {
        if (!(rows->flags[slot] & E3D_NODE_SHOWN) || rows->object[slot] < 0 || casts_none(rows, slot))
            continue;
        const int32_t state[3] = {slot, rows->object[slot], (int32_t)versions[slot]};
        memcpy(found + 3 * (size_t)count++, state, sizeof state);
    }
    return count;
}

/* Lists the slots that draw anything, and counts them for each merged draw. */
static void list_slots(e3d_draw_list *list, const e3d_node_rows *rows, const uint64_t *selection,
                       const e3d_placed *objects, int32_t object_count)
{
    for (int32_t slot = next_selected(selection, 0, rows->count); slot < rows->count;
         slot = next_selected(selection, slot + 1, rows->count))
        if (draws_at(rows, slot, objects, object_count) && !casts_none(rows, slot)) {
            list->slots[list->nodes++] = slot;
            merged_draw_of(list, rows, slot)->nodes += !spared_lights(rows, slot);
        }
}

int e3d_graph_draws(e3d_draw_list *list, const e3d_node_rows *rows, const uint64_t *selection,
                    const e3d_view_volume *view, const e3d_placed *objects, int32_t object_count, int merge)
{
    list->count = list->order_count = list->nodes = 0;
    list->boxes_tested = list->calls = list->node_calls = 0;
    if (object_count > INT32_MAX / 2 || !reserve_all(list, rows->count, 2 * object_count))
        return 0;
    for (int32_t i = 0; i < 2 * object_count; i++)
        list->merged[i] = (e3d_merged_draw){.draw = -1};
    list_slots(list, rows, selection, objects, object_count);
    lay_out_merged_draws(list, 2 * object_count);
    for (int32_t i = 0; i < list->nodes; i++) {
        int32_t slot = list->slots[i];
        const e3d_placed *object = &objects[rows->object[slot]];
        const drawn_node node = {e3d_placing_pose(rows->world, rows->anchor, slot), rows->id[slot], receives_none(rows, slot), spared_lights(rows, slot)};
        e3d_merged_draw *of = merged_draw_of(list, rows, slot);
        int together = merge && of->nodes > 1 && !node.spared_lights && object->draw.pose_kind == E3D_POSE_NONE;
        int32_t draws = list->count, turns = list->order_count;
        if (!(together ? append_member(list, object, of, &node) : append_node(list, object, &node, view)))
            return 0;
        list->calls += list->count > draws;
        list->node_calls += list->order_count > turns;
    }
    return 1;
}
