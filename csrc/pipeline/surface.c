/* shade, first half: what a visible piece brings to its samples (R3, R18, R20-R24), made once a tile. */
#include <string.h>

#include "core/srgb_tables.h"
#include "pipeline/frame.h"

/* Which primitive an order number is. */
typedef struct primitive {
    const e3d_draw_state *draw;
    const e3d_mesh_desc *mesh;
    const e3d_instance *instance;
    int32_t instance_number, local, face;
    int32_t vertex[3]; /* -1: none (lines have two, points one) */
} primitive;

static const e3d_draw_state *draw_of_order(const e3d_context *context, uint32_t order)
{
    int32_t low = 0, high = context->frame->draw_count - 1;
    while (low < high) {
        int32_t middle = low + (high - low + 1) / 2;
        if (context->draws[middle].order_base <= order)
            low = middle;
        else
            high = middle - 1;
    }
    return &context->draws[low];
}

static primitive find_primitive(const e3d_context *context, uint32_t order)
{
    primitive p = {.draw = draw_of_order(context, order), .face = -1, .vertex = {-1, -1, -1}};
    uint32_t within = order - (uint32_t)p.draw->order_base;
    p.mesh = &p.draw->mesh->desc;
    p.instance_number = (int32_t)(within / (uint32_t)p.draw->primitives);
    p.local = (int32_t)(within % (uint32_t)p.draw->primitives);
    p.instance = &context->instances[p.draw->instance_base + p.instance_number];
    int32_t line = p.local - p.mesh->faces_count;
    if (line < 0) {
        p.face = p.local;
        for (int k = 0; k < 3; k++)
            p.vertex[k] = p.mesh->faces[3 * (size_t)p.face + k];
    } else if (line < p.mesh->lines_count) {
        p.vertex[0] = p.mesh->lines[2 * (size_t)line];
        p.vertex[1] = p.mesh->lines[2 * (size_t)line + 1];
    } else {
        p.vertex[0] = p.mesh->points[line - p.mesh->lines_count];
    }
    return p;
}

/* R18 */
static void barycentric_planes(const e3d_context *context, const e3d_slot *slot, const e3d_tile *tile,
                               e3d_surface *out)
{
    const e3d_record *r = slot->record;
    e3d_box box = e3d_sample_box(r->x, r->y, &context->viewport);
    out->base_x = box.x0 - tile->x;
    out->base_y = box.y0 - tile->y;
    double ra = 1.0 / (double)e3d_doubled_area(r->x, r->y), m = r->iw[0], plane[3][3];
    m = r->iw[1] > m ? r->iw[1] : m;
    m = r->iw[2] > m ? r->iw[2] : m;
    double rm = 1.0 / m;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        int64_t a = r->y[i] - r->y[j], b = r->x[j] - r->x[i];
        int64_t e = a * (256 * (int64_t)box.x0 + 128 - r->x[i]) +
                    b * (256 * (int64_t)box.y0 + 128 - r->y[i]);
        double q = r->iw[k] * rm;
        plane[0][k] = ((double)e * ra) * q;
        plane[1][k] = ((256.0 * (double)a) * ra) * q;
        plane[2][k] = ((256.0 * (double)b) * ra) * q;
    }
    float *planes[3] = {out->p, out->px, out->py};
    int swapped = (r->meta & E3D_RECORD_SWAPPED) != 0;
    const float *c = slot->corners;
    for (int row = 0; row < 3; row++)
        for (int j = 0; j < 3; j++) {
            const double *p = plane[row];
            planes[row][j] = (float)(c ? (p[0] * c[j] + p[1] * c[3 + j]) + p[2] * c[6 + j]
                                       : p[swapped && j ? 3 - j : j]);
        }
}

static void positions(const primitive *p, e3d_surface *out)
{
    const float *m = p->instance->world;
    for (int v = 0; v < 3; v++) {
        int exists = p->vertex[v] >= 0 && p->mesh->components == 3;
        const float *x = exists ? p->mesh->positions + 3 * (size_t)p->vertex[v] : NULL;
        for (int r = 0; r < 3; r++)
            out->position[r][v] =
                x ? ((m[4 * r] * x[0] + m[4 * r + 1] * x[1]) + m[4 * r + 2] * x[2]) + m[4 * r + 3]
                  : 0.0f;
    }
}

static void transform_normal(const float *m, const float *n, e3d_surface *out, int v)
{
    for (int r = 0; r < 3; r++)
        out->normal[r][v] = n ? (m[3 * r] * n[0] + m[3 * r + 1] * n[1]) + m[3 * r + 2] * n[2] : 0.0f;
}

static void normals(const primitive *p, int flat, e3d_surface *out)
{
    const float *m = p->instance->normal;
    for (int v = 0; v < 3; v++) {
        const float *n = NULL;
        if (p->face >= 0 && flat)
            n = p->mesh->face_normals + 3 * (size_t)p->face;
        else if (p->face >= 0 && p->mesh->normals)
            n = p->mesh->normals + 3 * (size_t)p->vertex[v];
        transform_normal(m, n, out, v);
    }
}

static void uvs(const primitive *p, e3d_surface *out)
{
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 2; k++)
            out->uv[k][v] =
                p->mesh->uvs && p->vertex[v] >= 0 ? p->mesh->uvs[2 * (size_t)p->vertex[v] + k] : 0.0f;
}

/* R23 */
static float color_of(const uint8_t *u8, const float *f32, size_t index, int channel, int decode_srgb)
{
    if (f32)
        return f32[4 * index + channel];
    int c = u8[4 * index + channel];
    return (float)(decode_srgb ? SRGB_TO_LINEAR16[c] : c * 257) * E3D_UNORM16;
}

static void colors(const e3d_context *context, const primitive *p, const e3d_group *group,
                   e3d_surface *out)
{
    int decode_srgb = context->frame->decode_srgb;
    const e3d_draw *draw = p->draw->draw;
    for (int k = 0; k < 3; k++) {
        for (int v = 0; v < 3; v++)
            out->color[k][v] = group->by_vertex && p->vertex[v] >= 0
                                   ? color_of(p->mesh->colors_u8, p->mesh->colors_f32,
                                              (size_t)p->vertex[v], k, decode_srgb)
                                   : 0.0f;
        if (group->by_instance)
            out->instance_color[k] = color_of(draw->instance_colors_u8, draw->instance_colors_f32,
                                              (size_t)p->instance_number, k, decode_srgb);
    }
}

static e3d_group group_of(const e3d_context *context, const primitive *p)
{
    const e3d_frame *frame = context->frame;
    const e3d_draw *draw = p->draw->draw;
    int32_t own = p->face >= 0 && p->mesh->material_ids ? p->mesh->material_ids[p->face] : 0;
    e3d_group g = {.material = &frame->materials[draw->material_base + own], .face = p->face >= 0};
    int flat = frame->normals == E3D_NORMALS_FLAT ||
               (frame->normals == E3D_NORMALS_AUTO && g.material->flat);
    g.flat = g.face && flat && p->mesh->face_normals;
    g.textured = g.face && g.material->texture && p->mesh->uvs;
    g.by_vertex = p->mesh->colors_u8 || p->mesh->colors_f32;
    g.by_instance = draw->instance_colors_u8 || draw->instance_colors_f32;
    return g;
}

static int same_group(const e3d_group *a, const e3d_group *b)
{
    return a->material == b->material && a->face == b->face && a->flat == b->flat &&
           a->textured == b->textured && a->by_vertex == b->by_vertex &&
           a->by_instance == b->by_instance;
}

/* The group's number in the tile, newest first; -1 when memory is out. */
static int32_t number_group(e3d_worker *worker, const e3d_group *group)
{
    e3d_group *groups = worker->groups.data;
    for (size_t g = worker->groups.count; g-- > 0;)
        if (same_group(&groups[g], group))
            return (int32_t)g;
    if (!e3d_array_reserve(&worker->groups, worker->groups.count + 1, sizeof *group))
        return -1;
    ((e3d_group *)worker->groups.data)[worker->groups.count] = *group;
    return (int32_t)worker->groups.count++;
}

/* Index of the slot's surface, or -1 when memory is out. */
int e3d_surface_of(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int32_t number)
{
    e3d_slot *slot = (e3d_slot *)worker->slots.data + number;
    if (slot->surface >= 0)
        return slot->surface;
    primitive p = find_primitive(context, slot->record->order);
    e3d_group group = group_of(context, &p);
    int32_t group_number = number_group(worker, &group);
    if (group_number < 0 ||
        !e3d_array_reserve(&worker->surfaces, worker->surfaces.count + 1, sizeof(e3d_surface)))
        return -1;
    e3d_surface *s = (e3d_surface *)worker->surfaces.data + worker->surfaces.count;
    barycentric_planes(context, slot, tile, s);
    if (context->wants & E3D_WANT_POSITION)
        positions(&p, s);
    if (context->wants & E3D_WANT_NORMAL)
        normals(&p, group.flat, s);
    if (group.textured || (context->wants & E3D_WANT_UV))
        uvs(&p, s);
    if ((context->wants & E3D_NEED_ALBEDO) && (group.by_vertex || group.by_instance))
        colors(context, &p, &group, s);
    s->back = (slot->record->meta & E3D_RECORD_BACK) != 0 && p.face >= 0;
    s->local = p.local;
    s->face = p.face;
    s->node = p.draw->draw->node_id;
    s->instance = p.instance_number;
    s->group = group_number;
    slot->surface = (int32_t)worker->surfaces.count++;
    return slot->surface;
}
