/* draws: from slots to the draws of a frame, in the order in which the nodes were added. */
#include <string.h>

#include "e3d_scene.h"

int32_t e3d_graph_draws(int32_t count, const uint8_t *flags, const int32_t *object, const int32_t *id,
                        const double *world, const uint64_t *selection, const e3d_draw *objects,
                        int32_t object_count, e3d_draw *draws)
{
    static const double LAST_ROW[4] = {0, 0, 0, 1};
    int32_t drawn = 0;
    for (int32_t slot = 0; slot < count; slot++) {
        if (selection && !(selection[slot >> 6] >> (slot & 63) & 1)) {
            if (!(selection[slot >> 6] >> (slot & 63)))
                slot |= 63; /* none are left in this word */
            continue;
        }
        int32_t number = object[slot];
        if (!(flags[slot] & E3D_NODE_SHOWN) || number < 0 || number >= object_count ||
            !objects[number].mesh)
            continue;
        e3d_draw *draw = &draws[drawn++];
        *draw = objects[number];
        memcpy(draw->world_from_node, world + 12 * (size_t)slot, 12 * sizeof *world);
        memcpy(draw->world_from_node + 12, LAST_ROW, sizeof LAST_ROW);
        draw->node_id = id[slot];
    }
    return drawn;
}
