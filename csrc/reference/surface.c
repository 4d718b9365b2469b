/* Surface: everything about the surface at one sample: place, normal, texture coordinates, albedo.
 * In: a piece and a sample that it covers; everything is computed again from the mesh. Out: ref_surface, in world and view
 * space.
 * Rules: R19 and R20 (interpolation), R21 (position), R22 (normal), R23 and R24 (colours), R25 (uv). texture_slots.c adds
 * what textures say, mirror.c what mirrors show. */
#include "data/srgb_tables.h"
#include "reference/surface.h"

/* R19, before the weights are clamped. */
static void find_planes(ref_surface *s, float dx, float dy)
{
    const ref_piece *piece = s->piece;
    s->dx = dx;
    s->dy = dy;
    for (int k = 0; k < 3; k++)
        s->weight[k] = (piece->bary0[k] + dx * piece->bary_dx[k]) + dy * piece->bary_dy[k];
}

/* R19, R105, R190 and R195 */
static void find_weights(const ref_scene *scene, ref_surface *s, const ref_place *at, const float beside[2])
{
    float dx = (float)(at->x - s->piece->left), dy = (float)(at->y - s->piece->top);
    int is_beside = beside[0] != 0.0f || beside[1] != 0.0f;
    find_planes(s, dx, dy);
    if (scene->pattern && (at->is_alone || !(s->weight[0] >= 0.0f && s->weight[1] >= 0.0f && s->weight[2] >= 0.0f)))
        find_planes(s, dx + (float)scene->pattern->x[at->number] * (1.0f / 256.0f),
                    dy + (float)scene->pattern->y[at->number] * (1.0f / 256.0f));
    if (is_beside)
        find_planes(s, s->dx + beside[0], s->dy + beside[1]);
    for (int k = 0; k < 3 && !is_beside; k++)
        s->weight[k] = ref_max(s->weight[k], k == 0 ? E3D_LEAST_WEIGHT : 0.0f);
    s->r = 1.0f / ((s->weight[0] + s->weight[1]) + s->weight[2]);
    for (int k = 0; k < 3; k++)
        s->barycentric[k] = ref_min(s->weight[k] * s->r, 1.0f);
}

/* Interpolates one component of a vertex attribute; a vertex that the primitive lacks counts as 0. */
static float interpolate_attribute(const ref_surface *s, const float *values, int components, int c)
{
    float v[3];
    for (int k = 0; k < 3; k++) {
        int32_t vertex = s->piece->primitive.vertices[k];
        v[k] = vertex < 0 ? 0.0f : values[(size_t)vertex * (size_t)components + (size_t)c];
    }
    return ref_interpolate(s, v);
}

/* R181 */
static float range_of(const float position[3])
{
    double x = position[0], y = position[1], z = position[2];
    return (float)sqrt((x * x + y * y) + z * z);
}

/* R21 */
static void find_position(const ref_scene *scene, ref_surface *s)
{
    const e3d_mesh_desc *mesh = s->instance->mesh;
    for (int k = 0; k < 3; k++) {
        int32_t vertex = s->piece->primitive.vertices[k];
        float *corner = s->corner_position[k];
        corner[0] = corner[1] = corner[2] = 0.0f;
        if (vertex >= 0 && mesh->components == 3)
            ref_transform_point(s->instance->world_from_object, mesh->positions + 3 * (size_t)vertex, corner);
    }
    for (int c = 0; c < 3; c++) {
        float v[3] = {s->corner_position[0][c], s->corner_position[1][c], s->corner_position[2][c]};
        s->world_position[c] = ref_interpolate(s, v);
    }
    ref_transform_point(scene->view_from_world, s->world_position, s->view_position);
    s->metric_depth = 0.0f - s->view_position[2];
    s->range = scene->frame->eye[3] == 1.0f ? range_of(s->view_position) : s->metric_depth;
}

/* R153 */
static void find_lit_position(const ref_scene *scene, ref_surface *s)
{
    int middle = scene->frame->normals == E3D_NORMALS_FACET && s->piece->primitive.kind == REF_FACE;
    for (int c = 0; c < 3; c++) {
        float sum = (s->corner_position[0][c] + s->corner_position[1][c]) + s->corner_position[2][c];
        s->lit_position[c] = middle ? sum * (1.0f / 3.0f) : s->world_position[c];
    }
}

/* Turns a normal towards the viewer's side, in world space. */
static void turned_normal(const ref_surface *s, const float normal[3], float out[3])
{
    ref_transform_normal(s->instance, normal, out);
    for (int c = 0; c < 3; c++)
        out[c] = s->piece->front ? 0.0f + out[c] : 0.0f - out[c];
}

/* R191: the square of how far the unit normal turns along an axis of the picture, over that of 1 / length. */
static float turned_square(float corners[3][3], const float planes[3], const float n[3])
{
    float change[3], turned[3];
    for (int c = 0; c < 3; c++) {
        float v[3] = {corners[0][c], corners[1][c], corners[2][c]};
        change[c] = ref_dot3(planes, v);
    }
    float along = ref_dot3(n, change);
    for (int c = 0; c < 3; c++)
        turned[c] = change[c] - n[c] * along;
    return ref_dot3(turned, turned);
}

/* R22 and R191: the normal between those of the corners, and its curvature. */
static void find_smooth_normal(ref_surface *s)
{
    const float *normals = s->instance->mesh->normals;
    float (*corners)[3] = s->corner_normal, *n = s->world_normal;
    for (int k = 0; k < 3; k++)
        turned_normal(s, normals + 3 * (size_t)s->piece->primitive.vertices[k], corners[k]);
    for (int c = 0; c < 3; c++) {
        float v[3] = {corners[0][c], corners[1][c], corners[2][c]};
        n[c] = ref_dot3(s->weight, v); /* weights replace barycentrics, since the normal's length doesn't matter */
    }
    float inverse = ref_normalize(n);
    float across = turned_square(corners, s->piece->bary_dx, n), down = turned_square(corners, s->piece->bary_dy, n);
    s->curvature = ref_min(((across + down) * E3D_OVER_2PI) * (inverse * inverse), E3D_MOST_CURVATURE);
}

/* R22 */
static void find_normal(const ref_scene *scene, ref_surface *s)
{
    const e3d_mesh_desc *mesh = s->instance->mesh;
    const ref_primitive *primitive = &s->piece->primitive;
    int flat = e3d_is_flat(scene->frame->normals, primitive->material->flat) && mesh->face_normals;
    float *n = s->world_normal;
    n[0] = n[1] = n[2] = s->curvature = 0.0f;
    s->is_smooth = primitive->kind == REF_FACE && !flat && mesh->normals;
    if (s->is_smooth) {
        find_smooth_normal(s);
        return;
    }
    if (primitive->kind == REF_FACE && flat)
        turned_normal(s, mesh->face_normals + 3 * (size_t)primitive->index, n);
    ref_normalize(n);
}

/* R25 */
static void find_uv(ref_surface *s)
{
    static const e3d_texture_use PLAIN = {.uv_set = 0};
    ref_coordinates at;
    ref_slot_coordinates(&PLAIN, s, &at);
    for (int c = 0; c < 2; c++)
        s->uv[c] = at.uv[c];
}

/* R23, R80 */
void ref_decode_color(const e3d_frame *frame, const uint8_t color[4], float out[4])
{
    out[3] = (float)(color[3] * 257) * E3D_UNORM16;
    for (int c = 0; c < 3; c++) {
        int32_t linear = frame->decode_srgb ? SRGB_TO_LINEAR16[color[c]] : color[c] * 257;
        out[c] = (float)linear * E3D_UNORM16;
    }
}

static void vertex_color(const ref_scene *scene, const ref_surface *s, float out[4])
{
    const e3d_mesh_desc *mesh = s->instance->mesh;
    float corners[3][4] = {{0}};
    for (int k = 0; k < 3; k++) {
        int32_t vertex = s->piece->primitive.vertices[k];
        if (vertex >= 0 && mesh->colors_u8)
            ref_decode_color(scene->frame, mesh->colors_u8 + 4 * (size_t)vertex, corners[k]);
    }
    for (int c = 0; c < 4; c++) {
        float v[3] = {corners[0][c], corners[1][c], corners[2][c]};
        out[c] = mesh->colors_f32 ? interpolate_attribute(s, mesh->colors_f32, 4, c) : ref_interpolate(s, v);
    }
}

static void multiply_color(ref_surface *s, const float factor[4])
{
    for (int c = 0; c < 3; c++)
        s->albedo[c] = s->albedo[c] * factor[c];
    s->alpha = s->alpha * factor[3];
}

/* R24, and R80 before it is clamped: material, texture, vertex and instance, in this order. */
static void find_albedo(const ref_scene *scene, ref_surface *s)
{
    const ref_primitive *primitive = &s->piece->primitive;
    const e3d_draw *draw = s->instance->draw;
    const e3d_mesh_desc *mesh = s->instance->mesh;
    size_t number = (size_t)s->instance->number;
    float factor[4];
    for (int c = 0; c < 3; c++)
        s->albedo[c] = primitive->material->color[c];
    s->alpha = primitive->material->alpha;
    s->alpha_lod = 0;
    if (ref_slot_counts(&primitive->material->texture, s)) {
        float unit = ref_slot_sample(&primitive->material->texture, s, factor);
        s->alpha_lod = ref_slot_alpha_lod(&primitive->material->texture, s);
        for (int c = 0; c < 3; c++)
            s->albedo[c] = factor[c] * (s->albedo[c] * unit);
        s->alpha = factor[3] * (s->alpha * unit);
    }
    if (mesh->colors_u8 || mesh->colors_f32) {
        vertex_color(scene, s, factor);
        multiply_color(s, factor);
    }
    if (draw->instance_colors_u8) {
        ref_decode_color(scene->frame, draw->instance_colors_u8 + 4 * number, factor);
        multiply_color(s, factor);
    } else if (draw->instance_colors_f32) {
        multiply_color(s, draw->instance_colors_f32 + 4 * number);
    }
}

void ref_surface_other(const ref_scene *scene, const ref_piece *piece, const ref_place *at, const ref_other_way *way, ref_surface *out)
{
    out->is_finest = way->is_finest;
    out->piece = piece;
    out->casters = &scene->casters;
    out->instance = &scene->instances[piece->primitive.instance];
    find_weights(scene, out, at, way->beside);
    find_position(scene, out);
    find_lit_position(scene, out);
    find_normal(scene, out);
    find_uv(out);
    find_albedo(scene, out);
    ref_find_textures(scene, out);
    out->alpha = ref_clamp(out->alpha, 0.0f, 1.0f);
    ref_find_mirror(scene->frame, at, out);
    out->visibility = 1.0f; /* resolve.c sets it for surfaces that aren't blended */
}

void ref_surface_at(const ref_scene *scene, const ref_piece *piece, const ref_place *at, ref_surface *out)
{
    static const ref_other_way USUAL = {{0.0f, 0.0f}, 0};
    ref_surface_other(scene, piece, at, &USUAL, out);
}
