/* Lines, points and edges, which become records. */
#pragma once

#include <stdint.h>

#include "e3d.h"
#include "frame/geometry/records.h"
#include "frame/pass/draws.h"
#include "frame/pass/prepared.h"

/* The widths of lines and points, in 1/256 sample. */
typedef struct e3d_line_style {
    int32_t half, point_half;
    int32_t reach; /* how far any line reaches along its minor axis, at least half a sample */
    int wide;      /* lines have their full width at any angle */
    int round_lines, round_points; /* lines have round ends (R114); points are discs (R115) */
} e3d_line_style;

/* Draws one unit of an instance. Units hold E3D_LINES_A_UNIT lines, then points, then edges each. */
void e3d_draw_unit(const e3d_prepared *pass, e3d_geometry_memory *state, const e3d_draw_state *draw, int32_t instance, int32_t unit);

e3d_line_style e3d_line_style_of(const e3d_frame *frame);
