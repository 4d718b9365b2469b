/* geometry: lines, points and the edges of wireframes. Each is a parallelogram of two triangles (R6-R8, R11), or has round ends
 * (R114, R115). */
#include <math.h>

#include "base/limits.h"
#include "kernels/types/vertices.h"
#include "frame/geometry/arc.h"
#include "frame/geometry/clip.h"
#include "frame/geometry/lines.h"
#include "frame/geometry/setup.h"
#include "frame/pass/view.h"

/* The instance of a draw whose units a thread draws. */
typedef struct unit_walk {
    const e3d_prepared *pass;
    e3d_geometry_memory *state;
    e3d_line_style lines;
    const e3d_draw_state *draw;
    const e3d_view_instance *instance;
    uint32_t order; /* the order of the instance's first primitive */
    int alpha;      /* the list for lines and points (e3d_alpha_kind) */
} unit_walk;

/* R11 */
e3d_line_style e3d_line_style_of(const e3d_frame *frame)
{
    float axis = (float)frame->samples_axis;
    int32_t line = (int32_t)lrintf(frame->line_width * axis * 128.0f);
    int32_t point = (int32_t)lrintf(frame->point_size * axis * 128.0f);
    e3d_line_style style = {.half = line > 1 ? line : 1, .point_half = point > 1 ? point : 1, .wide = frame->line_width > 1.0f};
    style.round_lines = frame->line_shape == E3D_LINES_ROUND;
    style.round_points = frame->point_shape == E3D_POINTS_ROUND && style.point_half > E3D_LEAST_DISC;
    style.reach = style.wide && !style.round_lines ? (int32_t)lrint((double)style.half * sqrt(2.0)) : style.half;
    return style;
}

static void position_of(const unit_walk *w, int32_t vertex, float out[4])
{
    const e3d_mesh_desc *desc = &w->draw->mesh->desc;
    const float *p = desc->positions + (size_t)vertex * desc->components;
    const float *m = w->instance->clip;
    for (int r = 0; r < 4; r++)
        out[r] = desc->components == 4
                     ? p[r]
                     : ((m[4 * r] * p[0] + m[4 * r + 1] * p[1]) + m[4 * r + 2] * p[2]) + m[4 * r + 3];
}

static e3d_primitive primitive_of(const unit_walk *w, uint32_t order, int which)
{
    int alpha = which == E3D_SET_SCENE ? w->alpha : E3D_ALPHA_NONE;
    return (e3d_primitive){.order = order, .set = which, .cut = 1, .cull = E3D_CULL_NONE, .alpha = alpha};
}

static void emit_quad(unit_walk *w, const e3d_corner q[4], uint32_t order, int which)
{
    const e3d_primitive primitive = primitive_of(w, order, which);
    const e3d_corner first[3] = {q[0], q[1], q[2]}, second[3] = {q[0], q[2], q[3]};
    e3d_emit(w->pass, w->state, first, &primitive);
    e3d_emit(w->pass, w->state, second, &primitive);
}

static e3d_corner moved(e3d_corner c, int32_t x, int32_t y)
{
    c.x += x;
    c.y += y;
    return c;
}

static int32_t distance(int32_t a, int32_t b) { return a < b ? b - a : a - b; }

/* The distance that a line of such extents reaches from its centre along its minor axis (R11). */
static int32_t offset_of(const e3d_line_style *lines, double dx, double dy)
{
    if (!lines->wide)
        return lines->half;
    return (int32_t)lrint((double)lines->half * sqrt(dx * dx + dy * dy) / (dx > dy ? dx : dy));
}

/* Draws the half disc on one side of an arc around a point on the screen; sign -1 is the other side. */
static void draw_half_disc(unit_walk *w, const e3d_corner *middle, const e3d_arc *arc, int sign, const e3d_primitive *primitive)
{
    for (int j = 1; j < arc->steps; j++) {
        const e3d_corner corner[3] = {moved(*middle, sign * arc->x[0], sign * arc->y[0]), moved(*middle, sign * arc->x[j], sign * arc->y[j]),
                                      moved(*middle, sign * arc->x[j + 1], sign * arc->y[j + 1])};
        e3d_emit(w->pass, w->state, corner, primitive);
    }
}

/* R114 */
static void draw_round_line(unit_walk *w, const e3d_corner end[2], uint32_t order, int which)
{
    const e3d_primitive primitive = primitive_of(w, order, which);
    e3d_arc arc;
    e3d_arc_of(w->lines.half, (double)end[1].x - end[0].x, (double)end[1].y - end[0].y, &arc);
    int32_t x = arc.x[0], y = arc.y[0];
    const e3d_corner band[4] = {moved(end[0], x, y), moved(end[1], x, y), moved(end[1], -x, -y), moved(end[0], -x, -y)};
    emit_quad(w, band, order, which);
    draw_half_disc(w, &end[1], &arc, 1, &primitive);
    draw_half_disc(w, &end[0], &arc, -1, &primitive);
}

/* R115: the two halves of a disc. */
static void draw_disc(unit_walk *w, const e3d_corner *middle, uint32_t order)
{
    const e3d_primitive primitive = primitive_of(w, order, E3D_SET_SCENE);
    e3d_arc arc;
    e3d_arc_of(w->lines.point_half, 0.0, 0.0, &arc);
    draw_half_disc(w, middle, &arc, 1, &primitive);
    draw_half_disc(w, middle, &arc, -1, &primitive);
}

/* Draws a line between two points on the screen as a parallelogram. */
static void draw_band(unit_walk *w, const e3d_corner end[2], uint32_t order, int which)
{
    int32_t across = distance(end[1].x, end[0].x), down = distance(end[1].y, end[0].y);
    if (!across && !down)
        return;
    int32_t offset = offset_of(&w->lines, across, down), dx = across < down ? offset : 0, dy = across < down ? 0 : offset;
    const e3d_corner quad[4] = {moved(end[0], -dx, -dy), moved(end[1], -dx, -dy),
                                moved(end[1], dx, dy), moved(end[0], dx, dy)};
    emit_quad(w, quad, order, which);
}

static void draw_line(unit_walk *w, const int32_t *ends, uint32_t order, int which)
{
    const e3d_viewport *viewport = &w->pass->view->viewport;
    float v[2][4];
    e3d_clip_vertex cut[2] = {{{0}, {1, 0, 0}}, {{0}, {0, 1, 0}}};
    e3d_corner end[2];
    position_of(w, ends[0], v[0]);
    position_of(w, ends[1], v[1]);
    int a = e3d_outcode(v[0], viewport), b = e3d_outcode(v[1], viewport);
    if (((a | b) & E3D_NONFINITE) || (a & b & (E3D_NEAR | E3D_FAR)))
        return;
    for (int k = 0; k < 4; k++) {
        cut[0].v[k] = v[0][k];
        cut[1].v[k] = v[1][k];
    }
    int clipped = ((a | b) & E3D_CLIP) != 0;
    if (clipped && !e3d_clip_line(v, viewport, cut))
        return;
    for (int i = 0; i < 2; i++) {
        if (!e3d_project(cut[i].v, clipped, viewport, &end[i]))
            return;
        for (int k = 0; k < 3; k++)
            end[i].c[k] = cut[i].c[k];
        if (which == E3D_SET_EDGES)
            end[i].zn = end[i].zn - E3D_WIRE_PULL;
    }
    if (w->lines.round_lines)
        draw_round_line(w, end, order, which);
    else
        draw_band(w, end, order, which);
}

static void draw_point(unit_walk *w, int32_t vertex, uint32_t order)
{
    const e3d_viewport *viewport = &w->pass->view->viewport;
    float v[4];
    e3d_corner c;
    position_of(w, vertex, v);
    if (e3d_outcode(v, viewport) & (E3D_NEAR | E3D_FAR | E3D_BEHIND | E3D_BEYOND_GUARD | E3D_NONFINITE))
        return;
    if (!e3d_project(v, 0, viewport, &c))
        return;
    c.c[0] = 1;
    c.c[1] = c.c[2] = 0;
    if (w->lines.round_points) {
        draw_disc(w, &c, order);
        return;
    }
    int32_t h = w->lines.point_half;
    const e3d_corner quad[4] = {moved(c, -h, -h), moved(c, h, -h), moved(c, h, h), moved(c, -h, h)};
    emit_quad(w, quad, order, E3D_SET_SCENE);
}

static int32_t unit_end(int32_t unit, int32_t count)
{
    int32_t first = unit * E3D_LINES_A_UNIT;
    return count - first < E3D_LINES_A_UNIT ? count : first + E3D_LINES_A_UNIT;
}

static void run_lines(unit_walk *w, int32_t unit)
{
    const e3d_mesh_desc *d = &w->draw->mesh->desc;
    for (int32_t i = unit * E3D_LINES_A_UNIT; i < unit_end(unit, d->lines_count); i++)
        draw_line(w, d->lines + 2 * (size_t)i, w->order + (uint32_t)(d->faces_count + i),
                  E3D_SET_SCENE);
}

static void run_points(unit_walk *w, int32_t unit)
{
    const e3d_mesh_desc *d = &w->draw->mesh->desc;
    for (int32_t i = unit * E3D_LINES_A_UNIT; i < unit_end(unit, d->points_count); i++)
        draw_point(w, d->points[i], w->order + (uint32_t)(d->faces_count + d->lines_count + i));
}

static void run_edges(unit_walk *w, int32_t unit)
{
    const e3d_mesh_desc *d = &w->draw->mesh->desc;
    for (int32_t i = unit * E3D_LINES_A_UNIT; i < unit_end(unit, d->edges_count); i++)
        draw_line(w, d->edges + 2 * (size_t)i, 0, E3D_SET_EDGES);
}

void e3d_draw_unit(const e3d_prepared *pass, e3d_geometry_memory *state, const e3d_draw_state *draw, int32_t instance, int32_t unit)
{
    int64_t number = draw->instance_base + instance;
    unit_walk w = {pass, state, e3d_line_style_of(pass->frame), draw, &pass->view->instances[number],
                   pass->draws->instances[number].order, e3d_alpha_kind_of(pass, draw, draw->mesh->desc.faces_count)};
    if (unit < draw->line_units)
        run_lines(&w, unit);
    else if ((unit -= draw->line_units) < draw->point_units)
        run_points(&w, unit);
    else
        run_edges(&w, unit - draw->point_units);
}
