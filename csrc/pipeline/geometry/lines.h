/* Lines, points and edges, which become records. */
#ifndef E3D_LINES_H
#define E3D_LINES_H

#include <stdint.h>

#include "e3d.h"

/* How wide lines and points are, in 1/256 sample. */
typedef struct e3d_line_style {
    int32_t half, point_half;
    int32_t reach; /* of any line along its minor axis: no less than half, where */
    int wide;      /* lines are as wide across as they say */
} e3d_line_style;

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;
typedef struct e3d_draw_state e3d_draw_state;

/* Units of E3D_LINES_A_UNIT lines, then of points, then of edges of an instance. */
void e3d_draw_unit(e3d_context *context, e3d_worker *worker, const e3d_draw_state *draw, int32_t instance,
                   int32_t unit);

e3d_line_style e3d_line_style_of(const e3d_frame *frame);

#endif
