/* prepare: numbers a frame's draws, instances and units of work, draw after draw, and gives them their places in the order
 * (R16). */
#include "frame/pass/draws.h"
#include "frame/pass/transmits.h"

/* ---- the table ---- */

static int32_t units_of(int32_t count) { return (count + E3D_LINES_A_UNIT - 1) / E3D_LINES_A_UNIT; }

/* Counts a draw's two-sided materials. */
static int32_t count_two_sided(const e3d_frame *frame, const e3d_draw *draw)
{
    int32_t count = 0;
    for (int32_t m = 0; m <= draw->mesh->material_most; m++)
        count += frame->materials[draw->material_base + m].two_sided != 0;
    return count;
}

/* Whether any material of a draw is masked, is blended, or lets light pass. */
static int has_alpha(const e3d_frame *frame, const e3d_draw *draw)
{
    for (int32_t m = 0; m <= draw->mesh->material_most; m++)
        if (e3d_is_seen_through(frame, &frame->materials[draw->material_base + m]))
            return 1;
    return 0;
}

static int has_transmission(const e3d_frame *frame, const e3d_draw *draw)
{
    for (int32_t m = 0; m <= draw->mesh->material_most; m++)
        if (e3d_transmits(frame, &frame->materials[draw->material_base + m]))
            return 1;
    return 0;
}

static int64_t primitives_of(const e3d_mesh_desc *desc)
{
    return (int64_t)desc->faces_count + desc->lines_count + desc->points_count;
}

static e3d_draw_state state_of(const e3d_draw *draw, int edges, int faces_only)
{
    const e3d_mesh_desc *desc = &draw->mesh->desc;
    e3d_draw_state s = {.draw = draw, .mesh = draw->mesh};
    s.line_units = faces_only ? 0 : units_of(desc->lines_count);
    s.point_units = faces_only ? 0 : units_of(desc->points_count);
    s.edge_units = edges ? units_of(desc->edges_count) : 0;
    s.units = s.line_units + s.point_units + s.edge_units;
    s.primitives = (int32_t)primitives_of(desc);
    return s;
}

static e3d_status count_draws(e3d_draws *draws, const e3d_frame *frame, int edges, int alpha)
{
    int64_t primitives = 0, instances = 0;
    draws->units = draws->groups = 0;
    draws->any_transmits = 0;
    for (int32_t d = 0; d < frame->draw_count; d++) {
        const e3d_draw *draw = &frame->draws[d];
        int64_t all = primitives_of(&draw->mesh->desc);
        if (all > INT32_MAX || primitives + all * draw->instances > INT32_MAX || instances + draw->instances > INT32_MAX)
            return E3D_TOO_MANY_PRIMITIVES;
        e3d_draw_state *s = &draws->states[d];
        *s = state_of(draw, edges, frame->faces_only);
        const int32_t two_sided = frame->cull == E3D_CULL_NONE ? 0 : count_two_sided(frame, draw);
        s->any_two_sided = two_sided > 0;
        s->all_two_sided = two_sided > draw->mesh->material_most;
        s->any_alpha = alpha && has_alpha(frame, draw);
        draws->any_transmits |= s->any_alpha && has_transmission(frame, draw);
        s->instance_base = instances;
        s->unit_base = draws->units;
        s->group_base = draws->groups;
        primitives += all * draw->instances;
        instances += draw->instances;
        draws->units += (int64_t)s->units * draw->instances;
        draws->groups += (int64_t)draw->mesh->group_count * draw->instances;
    }
    draws->count = frame->draw_count;
    draws->instance_count = (int32_t)instances;
    return E3D_OK;
}

/* ---- the order ---- */

/* Gives a draw's next instances their place in the order; 0 if it has no more. */
static int place_instances(e3d_draws *draws, e3d_draw_state *state, uint32_t order, int32_t count)
{
    if (state->placed + count > state->draw->instances)
        return 0;
    if (state->draw->pose_kind == E3D_POSE_NODES)
        draws->instances[state->instance_base + state->placed].order = order;
    state->order = order;
    state->placed += count;
    return 1;
}

static e3d_status place_draws(e3d_draws *draws, const e3d_frame *frame)
{
    uint32_t order = 0;
    for (int32_t t = 0; t < draws->order_count; t++) {
        int32_t d = frame->order ? frame->order[t] : t;
        if (d < 0 || d >= frame->draw_count)
            return E3D_INVALID_ARGUMENT;
        e3d_draw_state *state = &draws->states[d];
        int32_t instances = state->draw->pose_kind == E3D_POSE_NODES ? 1 : state->draw->instances;
        draws->order[t] = (e3d_order_entry){order, d, state->placed};
        if (!place_instances(draws, state, order, instances))
            return E3D_INVALID_ARGUMENT;
        order += (uint32_t)instances * (uint32_t)state->primitives;
    }
    for (int32_t d = 0; d < frame->draw_count; d++)
        if (draws->states[d].placed != draws->states[d].draw->instances)
            return E3D_INVALID_ARGUMENT;
    return E3D_OK;
}

e3d_status e3d_draws_prepare(e3d_draws *draws, const e3d_frame *frame, int edges, int alpha)
{
    draws->order_count = frame->order ? frame->order_count : frame->draw_count;
    if (!e3d_array_reserve(&draws->state_memory, (size_t)frame->draw_count + 1, sizeof(e3d_draw_state)) ||
        !e3d_array_reserve(&draws->order_memory, (size_t)draws->order_count + 1, sizeof(e3d_order_entry)))
        return E3D_OUT_OF_MEMORY;
    draws->states = draws->state_memory.data;
    draws->order = draws->order_memory.data;
    e3d_status status = count_draws(draws, frame, edges, alpha);
    if (status != E3D_OK)
        return status;
    if (!e3d_array_reserve(&draws->instance_memory, (size_t)draws->instance_count + 1, sizeof(e3d_instance)))
        return E3D_OUT_OF_MEMORY;
    draws->instances = draws->instance_memory.data;
    return place_draws(draws, frame);
}

void e3d_draws_free(e3d_draws *draws)
{
    e3d_array_free(&draws->state_memory);
    e3d_array_free(&draws->instance_memory);
    e3d_array_free(&draws->order_memory);
}

/* ---- refraction ---- */

static int refracts(const e3d_frame *frame, int32_t material)
{
    return e3d_transmits(frame, &frame->materials[material]) && e3d_bends(&frame->materials[material]);
}

int e3d_refracts(const e3d_frame *frame)
{
    int32_t first = 0;
    while (first < frame->material_count && !refracts(frame, first))
        first++;
    for (int32_t d = 0; d < frame->draw_count && first < frame->material_count; d++)
        for (int32_t m = 0; m <= frame->draws[d].mesh->material_most; m++)
            if (refracts(frame, frame->draws[d].material_base + m))
                return 1;
    return 0;
}

/* ---- whose a number is ---- */

/* The function that tells where element k of a table starts. */
typedef int64_t (*start_of)(const e3d_draws *draws, int32_t k);

/* The last of `count` elements that starts at or before a number; the first one always does. */
static ALWAYS_INLINE int32_t find_by_start(const e3d_draws *draws, start_of start, int32_t count, int64_t number)
{
    int32_t low = 0, high = count - 1;
    while (low < high) {
        int32_t middle = low + (high - low + 1) / 2;
        if (start(draws, middle) <= number)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

static int64_t first_instance(const e3d_draws *draws, int32_t k) { return draws->states[k].instance_base; }
static int64_t first_unit(const e3d_draws *draws, int32_t k) { return draws->states[k].unit_base; }
static int64_t first_group(const e3d_draws *draws, int32_t k) { return draws->states[k].group_base; }
static int64_t first_order(const e3d_draws *draws, int32_t k) { return draws->order[k].order; }

const e3d_draw_state *e3d_draw_of_instance(const e3d_draws *draws, int64_t instance)
{
    return &draws->states[find_by_start(draws, first_instance, draws->count, instance)];
}

const e3d_draw_state *e3d_draw_of_unit(const e3d_draws *draws, int64_t unit)
{
    return &draws->states[find_by_start(draws, first_unit, draws->count, unit)];
}

const e3d_draw_state *e3d_draw_of_group(const e3d_draws *draws, int64_t group)
{
    return &draws->states[find_by_start(draws, first_group, draws->count, group)];
}

const e3d_order_entry *e3d_find_order_entry(const e3d_draws *draws, uint32_t order)
{
    return &draws->order[find_by_start(draws, first_order, draws->order_count, order)];
}

void e3d_find_instance(const e3d_draws *draws, uint32_t order, e3d_instance_finder *finder)
{
    const e3d_order_entry *entry = e3d_find_order_entry(draws, order);
    const e3d_draw_state *draw = &draws->states[entry->draw];
    uint32_t primitives = (uint32_t)draw->primitives, instances = (order - entry->order) / primitives;
    finder->draw = draw;
    finder->instance = entry->instance + (int32_t)instances;
    finder->first = entry->order + instances * primitives;
}
