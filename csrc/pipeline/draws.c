/* Whose a number of the frame is: instances, units of work, groups of clusters and places in the order are counted draw after
 * draw. */
#include "core/always_inline.h"
#include "pipeline/draws.h"
#include "pipeline/frame.h"

/* Where number k of a table starts. */
typedef int64_t (*start_of)(const e3d_context *context, int32_t k);

/* The last of `count` that starts at or before a number; the first one does. */
static ALWAYS_INLINE int32_t find_by_start(const e3d_context *context, start_of start, int32_t count, int64_t number)
{
    int32_t low = 0, high = count - 1;
    while (low < high) {
        int32_t middle = low + (high - low + 1) / 2;
        if (start(context, middle) <= number)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

static int64_t first_instance(const e3d_context *context, int32_t k) { return context->draws[k].instance_base; }
static int64_t first_unit(const e3d_context *context, int32_t k) { return context->draws[k].unit_base; }
static int64_t first_group(const e3d_context *context, int32_t k) { return context->draws[k].group_base; }
static int64_t first_order(const e3d_context *context, int32_t k) { return context->turns[k].order; }

const e3d_draw_state *e3d_draw_of_instance(const e3d_context *context, int64_t instance)
{
    return &context->draws[find_by_start(context, first_instance, context->frame->draw_count, instance)];
}

const e3d_draw_state *e3d_draw_of_unit(const e3d_context *context, int64_t unit)
{
    return &context->draws[find_by_start(context, first_unit, context->frame->draw_count, unit)];
}

const e3d_draw_state *e3d_draw_of_group(const e3d_context *context, int64_t group)
{
    return &context->draws[find_by_start(context, first_group, context->frame->draw_count, group)];
}

const e3d_turn *e3d_find_turn(const e3d_context *context, uint32_t order)
{
    return &context->turns[find_by_start(context, first_order, context->turn_count, order)];
}
