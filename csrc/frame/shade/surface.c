/* shade, first half: finds the primitives that show in a tile, and the attributes of their surfaces (R3, R18, R20-R24). */
#include <stddef.h>
#include <string.h>

#include "base/always_inline.h"
#include "base/grow.h"
#include "base/limits.h"
#include "frame/pass/draws.h"
#include "frame/pass/transmits.h"
#include "frame/shade/mirrors.h"
#include "frame/shade/surface.h"
#include "frame/shade/texture_slots.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"

/* ---- which primitive a primitive is of ---- */

static const float *corners_of(const e3d_shade_in *in, uint32_t id, const e3d_record *record)
{
    if (!(record->meta & E3D_RECORD_CUT))
        return NULL;
    return in->corners[id & ((1u << in->table->bits) - 1)] + 9 * (size_t)(record->meta >> E3D_RECORD_SHIFT);
}

/* How many vertices the primitive has. */
static int corners_count(const e3d_visible_primitive *primitive)
{
    const e3d_mesh_desc *mesh = &primitive->draw->mesh->desc;
    int32_t line = primitive->local - mesh->faces_count;
    if (line < 0)
        return 3;
    return line < mesh->lines_count ? 2 : 1;
}

static ALWAYS_INLINE void find_vertices(e3d_visible_primitive *primitive)
{
    const e3d_mesh_desc *mesh = &primitive->draw->mesh->desc;
    int32_t line = primitive->local - mesh->faces_count;
    if (line < 0)
        memcpy(primitive->vertex, mesh->faces + 3 * (size_t)primitive->local, 3 * sizeof *primitive->vertex);
    else if (line < mesh->lines_count)
        memcpy(primitive->vertex, mesh->lines + 2 * (size_t)line, 2 * sizeof *primitive->vertex);
    else
        primitive->vertex[0] = mesh->points[line - mesh->lines_count];
}

/* ---- buckets ---- */

/* The material and the kind of a primitive; with the draw they decide its bucket. */
static int32_t bucket_id_of(const e3d_visible_primitive *primitive)
{
    int32_t face = e3d_face_of(primitive->draw, primitive->local);
    return face < 0 ? -1 : e3d_material_of(primitive->draw, face);
}

static e3d_bucket bucket_of(const e3d_prepared *pass, const e3d_draw_state *state, int32_t id)
{
    const e3d_frame *frame = pass->frame;
    const e3d_draw *draw = state->draw;
    const e3d_mesh_desc *mesh = &state->mesh->desc;
    e3d_bucket g;
    memset(&g, 0, sizeof g); /* the padding between members, too, since same_bucket compares bytes */
    g.material = &frame->materials[draw->material_base + (id < 0 ? 0 : id)];
    g.first = g.last = -1;
    g.face = id >= 0;
    g.flat = g.face && e3d_is_flat(frame->normals, g.material->flat) && mesh->face_normals;
    g.mapped = g.face && e3d_needs_textures(pass, g.material);
    g.textured = g.face && g.material->texture.texture && mesh->uvs;
    g.has_uvs = g.mapped && mesh->uvs;
    g.has_uvs1 = g.mapped && mesh->uvs1;
    g.has_tangents = g.mapped && mesh->tangents;
    g.unshadowed = draw->unshadowed != 0;
    g.transmits = g.face && e3d_transmits(frame, g.material);
    g.bends = g.transmits && e3d_plans(pass, E3D_PLAN_BENDS) && e3d_bends(g.material);
    g.lit = g.face && frame->mode == E3D_MODE_LIT && !g.material->is_unlit;
    g.translucent = g.lit && g.material->is_physical && g.material->physical.diffuse_transmission != 0.0f;
    g.mirrors = g.lit && e3d_may_mirror(pass, g.material);
    g.hidden = g.face && frame->wireframe == E3D_WIRE_ONLY;
    g.by_vertex = mesh->colors_u8 || mesh->colors_f32;
    g.by_instance = draw->instance_colors_u8 || draw->instance_colors_f32;
    return g;
}

/* Compares everything that decides the steps of a bucket: the bytes before the chain of its primitives. */
static int same_bucket(const e3d_bucket *a, const e3d_bucket *b) { return !memcmp(a, b, offsetof(e3d_bucket, first)); }

/* The number of a bucket, which is added if it is new; -1 when memory is out. */
static int32_t number_bucket(e3d_shade_memory *memory, const e3d_bucket *bucket)
{
    e3d_bucket *buckets = memory->buckets.data;
    for (size_t g = memory->buckets.count; g-- > 0;)
        if (same_bucket(&buckets[g], bucket))
            return (int32_t)g;
    if (!e3d_array_reserve(&memory->buckets, memory->buckets.count + 1, sizeof *bucket))
        return -1;
    ((e3d_bucket *)memory->buckets.data)[memory->buckets.count] = *bucket;
    return (int32_t)memory->buckets.count++;
}

/* ---- the primitives of a tile ---- */

/* The bucket that was found last. Mostly the next primitive belongs to it, too. */
typedef struct bucket_finder {
    const e3d_draw_state *draw;
    int32_t id; /* numbered as by bucket_id_of */
    int32_t bucket;
} bucket_finder;

/* Finds the bucket of a primitive, and appends the primitive to it; 0 when memory is out. */
static ALWAYS_INLINE int join_bucket(const e3d_prepared *pass, e3d_shade_memory *memory, int32_t number, bucket_finder *finder)
{
    e3d_visible_primitive *primitives = memory->primitives.data, *primitive = &primitives[number];
    int32_t id = bucket_id_of(primitive);
    if (primitive->draw != finder->draw || id != finder->id) {
        e3d_bucket bucket = bucket_of(pass, primitive->draw, id);
        *finder = (bucket_finder){primitive->draw, id, number_bucket(memory, &bucket)};
        if (finder->bucket < 0)
            return 0;
    }
    e3d_bucket *bucket = (e3d_bucket *)memory->buckets.data + finder->bucket;
    if (bucket->last < 0)
        bucket->first = number;
    else
        primitives[bucket->last].next = number;
    bucket->last = number;
    primitive->bucket = finder->bucket;
    return 1;
}

/* Some primitives of a tile, first to end - 1. */
typedef struct primitive_range {
    int32_t first, end;
} primitive_range;

/* Finds what IDs stand for: records, or triangles of clusters. */
static void find_named(const e3d_record_table *table, const e3d_shown_primitive *of, primitive_range range,
                       e3d_visible_primitive *primitives)
{
    for (int32_t n = range.first; n < range.end; n++) {
        primitives[n] = (e3d_visible_primitive){.next = -1, .first = of[n].first, .end = of[n + 1].first};
        if (of[n].id & E3D_FRAGMENT_ID) {
            primitives[n].drawn = e3d_drawn_at(table, of[n].id, &primitives[n].local);
            __builtin_prefetch(primitives[n].drawn->faces + primitives[n].local);
        } else {
            primitives[n].record = e3d_record_at(table, of[n].id);
            __builtin_prefetch(primitives[n].record);
        }
    }
}

/* Finds the primitives, and prefetches their vertices. (Most are faces; the prefetch does no harm to others.) */
static void find_primitives(const e3d_shade_in *in, const e3d_shown_primitive *of, primitive_range range,
                            e3d_instance_finder *finder,
                            e3d_visible_primitive *primitives)
{
    const e3d_draws *draws = in->pass->draws;
    for (int32_t n = range.first; n < range.end; n++) {
        if (primitives[n].drawn) {
            primitives[n].local = e3d_find_face(draws, primitives[n].drawn, primitives[n].local, finder);
        } else {
            primitives[n].local = e3d_find_primitive(draws, primitives[n].record->order, finder);
            primitives[n].corners = corners_of(in, of[n].id, primitives[n].record);
        }
        primitives[n].draw = finder->draw;
        primitives[n].instance = finder->instance;
        __builtin_prefetch((const void *)((uintptr_t)finder->draw->mesh->desc.faces + 12 * (uintptr_t)primitives[n].local));
    }
}

/* 0 when memory is out. */
static int find_buckets(const e3d_prepared *pass, e3d_shade_memory *memory, primitive_range range, bucket_finder *finder)
{
    e3d_visible_primitive *primitives = memory->primitives.data;
    for (int32_t n = range.first; n < range.end; n++)
        find_vertices(&primitives[n]);
    for (int32_t n = range.first; n < range.end; n++)
        if (!join_bucket(pass, memory, n, finder))
            return 0;
    return 1;
}

static primitive_range range_of(int32_t first, int32_t count, int32_t all)
{
    return (primitive_range){first < 0 ? 0 : first, first + count < all ? first + count : all};
}

/* A software pipeline over ranges of primitives: each stage prefetches, from anywhere in memory, what the next stage reads a
 * range later. The stages' loops are short, so that an out-of-order processor overlaps several primitives. */
int e3d_find_visible(const e3d_shade_in *in, e3d_shade_memory *memory)
{
    enum { SOME = 32 };
    const e3d_record_table *table = in->table;
    e3d_shown *shown = &memory->shown;
    e3d_instance_finder instance = {0};
    bucket_finder bucket = {0};
    int32_t all = shown->primitives;
    shown->primitive[all].first = shown->count;
    memory->buckets.count = 0;
    if (!e3d_array_reserve(&memory->primitives, (size_t)all, sizeof(e3d_visible_primitive)))
        return 0;
    e3d_visible_primitive *primitives = memory->primitives.data;
    for (int32_t n = 0; n < all + 2 * SOME; n += SOME) {
        find_named(table, shown->primitive, range_of(n, SOME, all), primitives);
        find_primitives(in, shown->primitive, range_of(n - SOME, SOME, all), &instance, primitives);
        if (!find_buckets(in->pass, memory, range_of(n - 2 * SOME, SOME, all), &bucket))
            return 0;
    }
    memory->primitives.count = (size_t)all;
    return 1;
}

/* ---- what a primitive brings, for the surface kernel to work on ---- */

static void add_matrices(const e3d_prepared *pass, e3d_surfaces *s, int32_t n, int32_t instance)
{
    int again = n > 0 && s->instance[n - 1] == instance;
    s->instance[n] = instance;
    if (again) {
        s->matrix[n] = s->matrix[n - 1];
        return;
    }
    int32_t m = s->matrix[n] = s->matrices++;
    for (int k = 0; k < 16; k++)
        s->clip[k][m] = pass->view->instances[instance].clip[k];
    for (int k = 0; k < 12; k++)
        s->world[k][m] = pass->draws->instances[instance].world[k];
    for (int k = 0; k < 9; k++)
        s->normals[k][m] = pass->draws->instances[instance].normal[k];
}

/* Fills `out`, [component][vertex], with 0 for vertices that don't exist. */
static ALWAYS_INLINE void add_vectors(const float *from, size_t components, const int32_t vertex[3], int count,
                                      e3d_surface_floats out[][3], int32_t n)
{
    for (size_t c = 0; c < components && count == 3; c++) {
        out[c][0][n] = from[components * (size_t)vertex[0] + c];
        out[c][1][n] = from[components * (size_t)vertex[1] + c];
        out[c][2][n] = from[components * (size_t)vertex[2] + c];
    }
    for (int v = 0; v < 3 && count < 3; v++)
        for (size_t c = 0; c < components; c++)
            out[c][v][n] = v < count ? from[components * (size_t)vertex[v] + c] : 0.0f;
}

static void add_normals(const e3d_mesh_desc *mesh, int32_t face, int flat, const int32_t vertex[3], e3d_surfaces *s,
                        int32_t n)
{
    if (!flat)
        add_vectors(mesh->normals, 3, vertex, face < 0 || !mesh->normals ? 0 : 3, s->normal, n);
    else
        for (int c = 0; c < 3; c++)
            s->normal[c][0][n] = mesh->face_normals[3 * (size_t)face + c];
}

/* R23 */
static void value_of(const float unorm8[256], const uint8_t *u8, const float *f32, size_t index, float out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = f32 ? f32[4 * index + c] : unorm8[u8[4 * index + c]];
}

static void add_colors(const float unorm8[256], const e3d_visible_primitive *primitive, const e3d_bucket *bucket,
                       const int32_t vertex[3], int count, e3d_surfaces *s, int32_t n)
{
    const e3d_mesh_desc *mesh = &primitive->draw->mesh->desc;
    const e3d_draw *draw = primitive->draw->draw;
    for (int v = 0; v < 3 && bucket->by_vertex; v++) {
        float value[3] = {0.0f, 0.0f, 0.0f};
        if (v < count)
            value_of(unorm8, mesh->colors_u8, mesh->colors_f32, (size_t)vertex[v], value);
        for (int c = 0; c < 3; c++)
            s->color[c][v][n] = value[c];
    }
    if (bucket->by_instance) {
        float value[3];
        value_of(unorm8, draw->instance_colors_u8, draw->instance_colors_f32, (size_t)primitive->instance, value);
        for (int c = 0; c < 3; c++)
            s->instance_color[c][n] = value[c];
    }
}

/* R80: an alpha, of 8 bits or as it is. */
static float alpha_value(const uint8_t *u8, const float *f32, size_t index)
{
    return f32 ? f32[4 * index + 3] : (float)(u8[4 * index + 3] * 257) * E3D_UNORM16;
}

static void add_alphas(const e3d_visible_primitive *primitive, const e3d_bucket *bucket, int count, e3d_surfaces *s, int32_t n)
{
    const e3d_mesh_desc *mesh = &primitive->draw->mesh->desc;
    const e3d_draw *draw = primitive->draw->draw;
    for (int v = 0; v < 3 && bucket->by_vertex; v++)
        s->alpha[v][n] = v < count ? alpha_value(mesh->colors_u8, mesh->colors_f32, (size_t)primitive->vertex[v]) : 0.0f;
    if (bucket->by_instance)
        s->instance_alpha[n] = alpha_value(draw->instance_colors_u8, draw->instance_colors_f32, (size_t)primitive->instance);
}

static void add_record(const e3d_record *record, int32_t face, e3d_surfaces *s, int32_t n)
{
    for (int k = 0; k < 3; k++) {
        s->x[k][n] = record->x[k];
        s->y[k][n] = record->y[k];
        s->iw[k][n] = record->iw[k];
    }
    s->swapped[n] = (record->meta & E3D_RECORD_SWAPPED) != 0;
    s->back[n] = (record->meta & E3D_RECORD_BACK) != 0 && face >= 0;
}

/* Adds the surface of a primitive, without what e3d_find_surfaces adds. */
static void add_surface(const e3d_shade_in *in, const e3d_visible_primitive *primitive, const e3d_bucket *bucket, int wanted,
                        e3d_surfaces *s)
{
    const e3d_mesh_desc *mesh = &primitive->draw->mesh->desc;
    const int32_t *vertex = primitive->vertex;
    int32_t n = s->count++, face = e3d_face_of(primitive->draw, primitive->local);
    int count = corners_count(primitive);
    s->irregular += primitive->corners || face < 0 || mesh->components == 4;
    add_matrices(in->pass, s, n, (int32_t)primitive->draw->instance_base + primitive->instance);
    s->project[n] = primitive->drawn ? primitive->drawn->mirrored ? 3 : 1 : 0;
    s->projected += primitive->drawn != NULL;
    if (!primitive->drawn)
        add_record(primitive->record, face, s, n);
    if (wanted & E3D_WANT_POSITION || primitive->drawn)
        add_vectors(mesh->positions, 3, vertex, mesh->components == 3 ? count : 0, s->position, n);
    if (wanted & E3D_WANT_NORMAL)
        add_normals(mesh, face, bucket->flat, vertex, s, n);
    if (wanted & E3D_WANT_UV)
        add_vectors(mesh->uvs, 2, vertex, mesh->uvs ? count : 0, s->uv, n);
    if (e3d_plans(in->pass, E3D_PLAN_BASE_COLOR))
        add_colors(in->unorm8, primitive, bucket, vertex, count, s, n);
    if (wanted & E3D_WANT_ALPHA)
        add_alphas(primitive, bucket, count, s, n);
}

/* Prefetches vertices, which lie anywhere in memory. It does so only for a primitive of this draw, whose face was prefetched
 * when it was found. */
static ALWAYS_INLINE void fetch_vertices(const e3d_visible_primitive *primitive, const e3d_draw_state *draw, int wanted)
{
    const e3d_mesh_desc *mesh = &draw->mesh->desc;
    if (primitive->draw != draw)
        return;
    const int32_t *vertex = primitive->vertex;
    const float *normals = wanted & E3D_WANT_NORMAL ? mesh->normals : NULL, *tangents = wanted & E3D_WANT_TEXTURES ? mesh->tangents : NULL;
    const float *uvs = wanted & (E3D_WANT_UV | E3D_WANT_TEXTURES) ? mesh->uvs : NULL;
    for (int v = 0; v < 3; v++)
        __builtin_prefetch(mesh->positions + 3 * (size_t)vertex[v]);
    for (int v = 0; v < 3 && normals; v++)
        __builtin_prefetch(normals + 3 * (size_t)vertex[v]);
    for (int v = 0; v < 3 && uvs; v++)
        __builtin_prefetch(uvs + 2 * (size_t)vertex[v]);
    for (int v = 0; v < 3 && tangents; v++)
        __builtin_prefetch(tangents + 4 * (size_t)vertex[v]);
    for (int v = 0; v < 3 && mesh->colors_u8; v++)
        __builtin_prefetch(mesh->colors_u8 + 4 * (size_t)vertex[v]);
}

static void set_texels(const e3d_bucket *bucket, e3d_surfaces *s)
{
    const e3d_texture_view *view = e3d_texture_get_view(bucket->material->texture.texture);
    s->texels[0] = e3d_counted_size(view, view->levels[0].width);
    s->texels[1] = e3d_counted_size(view, view->levels[0].height);
}

int e3d_texture_wanted(const e3d_texture_view *view)
{
    int level = view->filter == E3D_TRILINEAR ? E3D_WANT_LEVEL : 0;
    return E3D_WANT_UV | level | (view->anisotropy > 1 ? E3D_WANT_WEIGHTS : 0);
}

int32_t e3d_add_surfaces(const e3d_shade_in *in, const e3d_bucket *bucket, int32_t first, int wanted, e3d_shade_memory *memory)
{
    enum { AHEAD = 24 };
    const e3d_visible_primitive *primitives = memory->primitives.data;
    e3d_surfaces *s = &memory->surfaces;
    int32_t p = first, last = (int32_t)memory->primitives.count - 1 - AHEAD;
    for (int32_t i = first; i < first + AHEAD && i <= last && wanted & E3D_WANT_SURFACE; i++)
        fetch_vertices(&primitives[i], primitives[first].draw, wanted);
    s->count = s->matrices = s->irregular = s->projected = 0;
    if (wanted & E3D_WANT_LEVEL)
        set_texels(bucket, s);
    if (bucket->mapped)
        e3d_find_textures(in->pass, bucket, wanted, &memory->textures.read);
    for (; p >= 0 && s->count < E3D_BATCH_SURFACES; p = primitives[p].next) {
        s->primitive[s->count] = p;
        if (!(wanted & E3D_WANT_SURFACE)) {
            s->count++;
            continue;
        }
        if (p <= last)
            fetch_vertices(&primitives[p + AHEAD], primitives[p].draw, wanted);
        if (bucket->mapped)
            e3d_add_texture_surface(in->pass, &primitives[p], &memory->textures.read, &memory->textures.surfaces, s->count);
        add_surface(in, &primitives[p], bucket, wanted, s);
    }
    return p;
}

/* ---- what the kernel leaves to do ---- */

/* R18 for a clipped primitive, a line or a point. */
static void cut_planes(const e3d_viewport *viewport, const e3d_visible_primitive *primitive, e3d_surfaces *s, int32_t n)
{
    const e3d_record *r = primitive->record;
    const float *c = primitive->corners;
    e3d_box box = e3d_sample_box(r->x, r->y, viewport);
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
    e3d_surface_floats *const rows[3] = {s->p, s->px, s->py};
    for (int row = 0; row < 3; row++)
        for (int j = 0; j < 3; j++)
            rows[row][j][n] = (float)((plane[row][0] * c[j] + plane[row][1] * c[3 + j]) + plane[row][2] * c[6 + j]);
}

/* R25 for planes that the kernel did not find. */
static void cut_slopes(e3d_surfaces *s, int32_t n)
{
    const e3d_surface_floats *const plane[3] = {s->p, s->px, s->py};
    for (int k = 0; k < 2; k++) {
        float a[3], sum[3];
        for (int row = 0; row < 3; row++) {
            const float w[3] = {plane[row][0][n], plane[row][1][n], plane[row][2][n]};
            sum[row] = (w[0] + w[1]) + w[2];
            a[row] = (w[0] * s->uv[k][0][n] + w[1] * s->uv[k][1][n]) + w[2] * s->uv[k][2][n];
        }
        s->slope[k][0][n] = (a[1] * sum[0] - a[0] * sum[1]) * s->texels[k];
        s->slope[k][1][n] = (a[2] * sum[0] - a[0] * sum[2]) * s->texels[k];
        s->slope[k][2][n] = (a[1] * sum[2] - a[2] * sum[1]) * s->texels[k];
    }
}

/* Sets positions that don't exist to 0, wherever the matrix would move them. */
static void clear_positions(e3d_surfaces *s, int32_t n, int first)
{
    for (int c = 0; c < 3; c++)
        for (int v = first; v < 3; v++)
            s->position[c][v][n] = 0.0f;
}

void e3d_find_surfaces(const e3d_prepared *pass, const e3d_tile *tile, const e3d_bucket *bucket, int wanted, e3d_shade_memory *memory)
{
    const e3d_visible_primitive *primitives = memory->primitives.data;
    e3d_surfaces *s = &memory->surfaces;
    for (int32_t n = s->count; n < s->count + E3D_PAD; n++)
        s->matrix[n] = s->matrix[s->count - 1];
    s->reach = pass->view->viewport.reach;
    if (s->projected)
        pass->kernels->project(s, &pass->view->viewport);
    pass->kernels->surface(s, tile->x, tile->y, wanted);
    for (int32_t n = 0; n < s->count && s->irregular; n++) {
        const e3d_visible_primitive *primitive = &primitives[s->primitive[n]];
        const e3d_mesh_desc *mesh = &primitive->draw->mesh->desc;
        if (primitive->corners)
            cut_planes(&pass->view->viewport, primitive, s, n);
        if (primitive->corners && wanted & E3D_WANT_LEVEL)
            cut_slopes(s, n);
        if (mesh->components == 4)
            clear_positions(s, n, 0);
        else if (e3d_face_of(primitive->draw, primitive->local) < 0)
            clear_positions(s, n, corners_count(primitive));
    }
    if (bucket->mapped)
        pass->kernels->texture_surfaces(s, &memory->textures.read, &memory->textures.surfaces);
}
