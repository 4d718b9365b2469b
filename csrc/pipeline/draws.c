/* Whose a number of the frame is: instances, units of work, groups of clusters and places in the order are counted draw after draw. */
#include "pipeline/frame.h"

const e3d_draw_state *e3d_find_draw(const e3d_context *context, size_t base, int64_t number)
{
    int32_t low = 0, high = context->frame->draw_count - 1;
    while (low < high) {
        int32_t middle = low + (high - low + 1) / 2;
        if (*(const int64_t *)((const char *)&context->draws[middle] + base) <= number)
            low = middle;
        else
            high = middle - 1;
    }
    return &context->draws[low];
}

const e3d_turn *e3d_find_turn(const e3d_context *context, uint32_t order)
{
    int32_t low = 0, high = context->turn_count - 1;
    while (low < high) {
        int32_t middle = low + (high - low + 1) / 2;
        if (context->turns[middle].order <= order)
            low = middle;
        else
            high = middle - 1;
    }
    return &context->turns[low];
}
