/* Apertures (R9): boxes of pixels around holes of objects that enclose a volume. Through them a picture may show the objects'
 * backs. */
#pragma once

#include <stdint.h>

#include "e3d_frame.h"
#include "e3d_draw_list.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The eye that may look into holes, and the size of its picture. */
typedef struct e3d_looking {
    double clip_from_world[16], view_from_world[16];
    int32_t width, height;
} e3d_looking;

/* Finds the apertures of a frame that draws a list. Returns how many there are, or -1 if the near plane may cut an object that
 * encloses a volume, for then its inside shows anywhere. bounds: of the nodes, as in e3d_graph. */
int32_t e3d_find_apertures(const e3d_draw_list *list, const e3d_node_rows *rows, const double *bounds, const e3d_placed *objects,
                           const e3d_looking *looking, e3d_aperture apertures[E3D_MAX_APERTURES]);

#ifdef __cplusplus
}
#endif
