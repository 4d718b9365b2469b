/* shade: finds the primitive of an ID by its place in the order of drawing (R16). */
#include "frame/shade/primitive.h"

void e3d_find_instance(const e3d_draws *draws, uint32_t order, e3d_instance_finder *finder)
{
    const e3d_order_entry *entry = e3d_find_order_entry(draws, order);
    const e3d_draw_state *draw = &draws->states[entry->draw];
    uint32_t primitives = (uint32_t)draw->primitives, instances = (order - entry->order) / primitives;
    finder->draw = draw;
    finder->instance = entry->instance + (int32_t)instances;
    finder->first = entry->order + instances * primitives;
}
