/* geometry: cull, transform, clip, setup and bin, in one walk over units of work.
 *
 * A unit is a cluster of triangles, or up to 256 lines, points or edges, of one instance. Threads take
 * blocks of units from a counter; each keeps its records and bins to itself.
 */
#include "core/pool.h"
#include "pipeline/frame.h"

enum { UNITS_A_TASK = 8 };

/* Where a thread stands: one instance of one draw. */
typedef struct walker {
    e3d_context *context;
    e3d_worker *worker;
    const e3d_draw_state *draw;
    const e3d_instance *instance;
    int64_t instance_number; /* in the frame; -1: none yet */
    uint32_t order;          /* of the instance's first primitive */
    e3d_planes planes;
    int shows;
} walker;

static void position_of(const walker *w, int32_t vertex, float out[4])
{
    const e3d_mesh_desc *desc = &w->draw->mesh->desc;
    const float *p = desc->positions + (size_t)vertex * desc->components;
    const float *m = w->instance->clip;
    for (int r = 0; r < 4; r++)
        out[r] = desc->components == 4
                     ? p[r]
                     : ((m[4 * r] * p[0] + m[4 * r + 1] * p[1]) + m[4 * r + 2] * p[2]) + m[4 * r + 3];
}

/* ---- triangles ---- */

static e3d_cull cull_of(const walker *w, int32_t face)
{
    const e3d_frame *frame = w->context->frame;
    if (!w->draw->any_two_sided)
        return frame->cull;
    const e3d_mesh_desc *desc = &w->draw->mesh->desc;
    int32_t material = w->draw->draw->material_base + (desc->material_ids ? desc->material_ids[face] : 0);
    return frame->materials[material].two_sided ? E3D_CULL_NONE : frame->cull;
}

/* The sign of the area (screen, Y down) that setup may drop: front faces have a negative one. */
static int drop_sign(const walker *w)
{
    e3d_cull cull = w->context->frame->cull;
    if (cull == E3D_CULL_NONE || w->draw->any_two_sided)
        return 0;
    int sign = cull == E3D_CULL_BACK ? 1 : -1;
    return w->instance->mirrored ? -sign : sign;
}

static e3d_primitive face_primitive(const walker *w, int32_t face)
{
    return (e3d_primitive){.order = w->order + (uint32_t)face,
                           .pass = E3D_PASS_SCENE,
                           .face = 1,
                           .cull = cull_of(w, face),
                           .mirrored = w->instance->mirrored};
}

static void draw_triangle(walker *w, const e3d_cluster *cluster, const uint8_t *indices, int triangle)
{
    const e3d_vertices *v = &w->worker->vertices;
    e3d_corner corner[3];
    for (int k = 0; k < 3; k++) {
        int i = indices[k * E3D_CLUSTER_TRIANGLES + triangle];
        corner[k] = (e3d_corner){v->sx[i], v->sy[i], v->zn[i], v->iw[i], {0, 0, 0}};
    }
    e3d_primitive primitive = face_primitive(w, cluster->first_face + triangle);
    e3d_emit(w->context, w->worker, corner, &primitive);
}

static void draw_clipped(walker *w, const e3d_cluster *cluster, const uint8_t *indices, int triangle)
{
    const e3d_vertices *v = &w->worker->vertices;
    const e3d_viewport *viewport = &w->context->viewport;
    float corner[3][4];
    e3d_clip_vertex polygon[E3D_CLIP_MAX];
    e3d_corner projected[E3D_CLIP_MAX];
    int good[E3D_CLIP_MAX];
    for (int k = 0; k < 3; k++) {
        int i = indices[k * E3D_CLUSTER_TRIANGLES + triangle];
        corner[k][0] = v->x[i];
        corner[k][1] = v->y[i];
        corner[k][2] = v->z[i];
        corner[k][3] = v->w[i];
    }
    int count = e3d_clip_triangle(corner, viewport, polygon);
    w->worker->counters.triangles_clipped++;
    for (int i = 0; i < count; i++) {
        good[i] = e3d_project(polygon[i].v, 1, viewport, &projected[i]);
        for (int k = 0; k < 3; k++)
            projected[i].c[k] = polygon[i].c[k];
    }
    e3d_primitive primitive = face_primitive(w, cluster->first_face + triangle);
    primitive.cut = 1;
    for (int i = 1; i + 1 < count; i++)
        if (good[0] && good[i] && good[i + 1]) {
            const e3d_corner piece[3] = {projected[0], projected[i], projected[i + 1]};
            e3d_emit(w->context, w->worker, piece, &primitive);
        }
}

static void run_cluster(walker *w, int32_t number)
{
    const e3d_mesh *mesh = w->draw->mesh;
    const e3d_cluster *cluster = &mesh->clusters[number];
    const e3d_kernels *kernels = w->context->kernels;
    const e3d_viewport *viewport = &w->context->viewport;
    e3d_worker *worker = w->worker;
    const float *positions = mesh->positions + cluster->positions;
    if (!w->shows || (mesh->desc.components == 3 &&
                      (!cluster->any_finite || !e3d_box_shows(&w->planes, cluster->lo, cluster->hi)))) {
        worker->counters.clusters_culled++;
        worker->counters.triangles_culled += cluster->triangles;
        return;
    }
    if (mesh->desc.components == 4)
        kernels->take_clip(positions, cluster->stride, cluster->vertices, viewport, &worker->vertices);
    else
        kernels->transform(positions, cluster->stride, cluster->vertices, w->instance->clip, viewport,
                           &worker->vertices);
    const uint8_t *indices = mesh->indices + cluster->indices;
    e3d_survivors *s = &worker->survivors;
    kernels->setup(&worker->vertices, indices, cluster->triangles, drop_sign(w), viewport, s);
    worker->counters.triangles_culled += cluster->triangles - s->draws - s->clips;
    for (int i = 0; i < s->draws; i++)
        draw_triangle(w, cluster, indices, s->draw[i]);
    for (int i = 0; i < s->clips; i++)
        draw_clipped(w, cluster, indices, s->clip[i]);
}

/* ---- lines and points ---- */

static void emit_quad(walker *w, const e3d_corner q[4], uint32_t order, int pass)
{
    e3d_primitive primitive = {.order = order, .pass = pass, .cut = 1, .cull = E3D_CULL_NONE};
    const e3d_corner first[3] = {q[0], q[1], q[2]}, second[3] = {q[0], q[2], q[3]};
    e3d_emit(w->context, w->worker, first, &primitive);
    e3d_emit(w->context, w->worker, second, &primitive);
}

static e3d_corner moved(e3d_corner c, int32_t x, int32_t y)
{
    c.x += x;
    c.y += y;
    return c;
}

static int32_t distance(int32_t a, int32_t b) { return a < b ? b - a : a - b; }

/* R11 */
static void draw_line(walker *w, const int32_t *ends, uint32_t order, int pass)
{
    const e3d_viewport *viewport = &w->context->viewport;
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
        if (pass == E3D_PASS_WIRE)
            end[i].zn = end[i].zn - E3D_WIRE_PULL;
    }
    int steep = distance(end[1].x, end[0].x) < distance(end[1].y, end[0].y);
    int32_t h = w->context->line_half, dx = steep ? h : 0, dy = steep ? 0 : h;
    const e3d_corner quad[4] = {moved(end[0], -dx, -dy), moved(end[1], -dx, -dy),
                                moved(end[1], dx, dy), moved(end[0], dx, dy)};
    emit_quad(w, quad, order, pass);
}

static void draw_point(walker *w, int32_t vertex, uint32_t order)
{
    const e3d_viewport *viewport = &w->context->viewport;
    float v[4];
    e3d_corner c;
    position_of(w, vertex, v);
    if (e3d_outcode(v, viewport) & (E3D_NEAR | E3D_FAR | E3D_BEHIND | E3D_BEYOND_GUARD | E3D_NONFINITE))
        return;
    if (!e3d_project(v, 0, viewport, &c))
        return;
    c.c[0] = 1;
    c.c[1] = c.c[2] = 0;
    int32_t h = w->context->point_half;
    const e3d_corner quad[4] = {moved(c, -h, -h), moved(c, h, -h), moved(c, h, h), moved(c, -h, h)};
    emit_quad(w, quad, order, E3D_PASS_SCENE);
}

static int32_t unit_end(int32_t unit, int32_t count)
{
    int32_t first = unit * E3D_LINES_A_UNIT;
    return count - first < E3D_LINES_A_UNIT ? count : first + E3D_LINES_A_UNIT;
}

static void run_lines(walker *w, int32_t unit)
{
    const e3d_mesh_desc *d = &w->draw->mesh->desc;
    for (int32_t i = unit * E3D_LINES_A_UNIT; i < unit_end(unit, d->lines_count); i++)
        draw_line(w, d->lines + 2 * (size_t)i, w->order + (uint32_t)(d->faces_count + i),
                  E3D_PASS_SCENE);
}

static void run_points(walker *w, int32_t unit)
{
    const e3d_mesh_desc *d = &w->draw->mesh->desc;
    for (int32_t i = unit * E3D_LINES_A_UNIT; i < unit_end(unit, d->points_count); i++)
        draw_point(w, d->points[i], w->order + (uint32_t)(d->faces_count + d->lines_count + i));
}

static void run_edges(walker *w, int32_t unit)
{
    const e3d_mesh_desc *d = &w->draw->mesh->desc;
    for (int32_t i = unit * E3D_LINES_A_UNIT; i < unit_end(unit, d->edges_count); i++)
        draw_line(w, d->edges + 2 * (size_t)i, 0, E3D_PASS_WIRE);
}

/* ---- the walk ---- */

static void enter_instance(walker *w, const e3d_draw_state *draw, int32_t instance)
{
    w->draw = draw;
    w->instance_number = (int64_t)draw->instance_base + instance;
    w->instance = &w->context->instances[w->instance_number];
    w->order = (uint32_t)(draw->order_base + (int64_t)instance * draw->primitives);
    e3d_planes_from(w->instance->clip_exact, &w->planes);
    const e3d_mesh *mesh = draw->mesh;
    w->shows = mesh->desc.components == 4 ||
               (mesh->any_finite && e3d_box_shows(&w->planes, mesh->lo, mesh->hi));
}

static void run_unit(walker *w, int32_t unit)
{
    const e3d_draw_state *d = w->draw;
    if (unit < d->cluster_units)
        run_cluster(w, unit);
    else if ((unit -= d->cluster_units) < d->line_units)
        run_lines(w, unit);
    else if ((unit -= d->line_units) < d->point_units)
        run_points(w, unit);
    else
        run_edges(w, unit - d->point_units);
}

static const e3d_draw_state *draw_of_unit(const e3d_context *context, int64_t unit)
{
    int32_t low = 0, high = context->frame->draw_count - 1;
    while (low < high) { /* the last draw that starts at or before it */
        int32_t middle = low + (high - low + 1) / 2;
        if (context->draws[middle].unit_base <= unit)
            low = middle;
        else
            high = middle - 1;
    }
    return &context->draws[low];
}

static void run_task(walker *w, int64_t first, int64_t end)
{
    for (int64_t unit = first; unit < end && !w->worker->failed; unit++) {
        const e3d_draw_state *draw = draw_of_unit(w->context, unit);
        int32_t instance = (int32_t)((unit - draw->unit_base) / draw->units);
        if (w->instance_number != draw->instance_base + instance)
            enter_instance(w, draw, instance);
        run_unit(w, (int32_t)((unit - draw->unit_base) % draw->units));
    }
}

static void geometry_work(void *argument, int number)
{
    e3d_context *context = argument;
    walker w = {.context = context,
                .worker = context->renderer->workers[number],
                .instance_number = -1};
    while (!atomic_load(&context->stop)) {
        int64_t first = atomic_fetch_add(&context->next, UNITS_A_TASK);
        if (first >= context->units)
            return;
        int64_t end = first + UNITS_A_TASK;
        run_task(&w, first, end < context->units ? end : context->units);
        if (w.worker->failed)
            atomic_store(&context->stop, 1);
    }
}

void e3d_geometry(e3d_context *context)
{
    atomic_store(&context->next, 0);
    e3d_pool_run(context->units > 4 * UNITS_A_TASK ? context->renderer->threads : 1, geometry_work,
                 context);
}
