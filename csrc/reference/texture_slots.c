/* Texture slots: the values of a material's textures at one sample, besides its base colour.
 * In: a surface with its place, normal and albedo. Out: its emission, tangent and mapped normal; for physically based
 * materials everything that R49 reads.
 * Rules: R45 (coordinates), R46 (values), R47 (tangent), R48 (mapped normal). */
#include "reference/arithmetic.h"
#include "reference/surface.h"

static const float *coordinates_of(const e3d_texture_use *use, const ref_surface *s)
{
    return use->uv_set ? s->instance->mesh->uvs1 : s->instance->mesh->uvs;
}

int ref_slot_counts(const e3d_texture_use *use, const ref_surface *surface)
{
    return surface->piece->primitive.kind == REF_FACE && use->texture && coordinates_of(use, surface);
}

/* R45 */
void ref_slot_coordinates(const e3d_texture_use *use, const ref_surface *surface, ref_coordinates *out)
{
    const float *uvs = coordinates_of(use, surface), *m = use->matrix;
    for (int k = 0; k < 3; k++) {
        int32_t vertex = surface->piece->primitive.vertices[k];
        float u = uvs && vertex >= 0 ? uvs[2 * (size_t)vertex] : 0.0f;
        float v = uvs && vertex >= 0 ? uvs[2 * (size_t)vertex + 1] : 0.0f;
        out->corner[0][k] = use->is_moved ? (m[0] * u + m[1] * v) + m[2] : u;
        out->corner[1][k] = use->is_moved ? (m[3] * u + m[4] * v) + m[5] : v;
    }
    for (int c = 0; c < 2; c++)
        out->uv[c] = ref_interpolate(surface, out->corner[c]);
}

/* Returns the unit. */
float ref_slot_sample(const e3d_texture_use *use, const ref_surface *surface, float out[4])
{
    ref_coordinates at;
    ref_slot_coordinates(use, surface, &at);
    return ref_texture_sample(e3d_texture_get_view(use->texture), surface, &at, out);
}

/* R190 */
int32_t ref_slot_alpha_lod(const e3d_texture_use *use, const ref_surface *surface)
{
    ref_coordinates at;
    ref_slot_coordinates(use, surface, &at);
    return ref_texture_alpha_lod(e3d_texture_get_view(use->texture), surface, &at);
}

/* ---- values (R46) ---- */

static float multiplied(const e3d_texture_use *use, const ref_surface *s, int channel, float factor)
{
    float texel[4];
    if (!ref_slot_counts(use, s))
        return factor;
    float unit = ref_slot_sample(use, s, texel);
    return texel[channel] * (factor * unit);
}

static void multiply_three(const e3d_texture_use *use, const ref_surface *s, const float factor[3], float out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = multiplied(use, s, c, factor[c]);
}

static float find_occlusion(const e3d_material *m, const ref_surface *s)
{
    float texel[4];
    if (!ref_slot_counts(&m->occlusion_texture, s))
        return 1.0f;
    float unit = ref_slot_sample(&m->occlusion_texture, s, texel);
    return 1.0f + m->physical.occlusion_strength * (texel[0] * unit - 1.0f);
}

/* ---- tangent (R47) ---- */

/* The texture whose coordinates define the tangent: a normal texture, or none. */
static const e3d_texture_use *tangent_slot(const e3d_material *m)
{
    int by_coat = m->is_physical && !m->normal_texture.texture;
    return by_coat ? &m->clearcoat_normal_texture : &m->normal_texture;
}

static int is_flat(const ref_scene *scene, const ref_surface *s)
{
    return e3d_is_flat(scene->frame->normals, s->piece->primitive.material->flat) && s->instance->mesh->face_normals;
}

/* The sign of the bitangent on the side that the winding faces. */
static float turned_sign(const ref_surface *s, float sign) { return s->instance->turned_round ? 0.0f - sign : sign; }

static float vertex_tangents(const ref_surface *s, float corners[3][3])
{
    const float (*world)[4] = s->instance->world_from_object;
    const int32_t *vertices = s->piece->primitive.vertices;
    for (int k = 0; k < 3; k++)
        for (int r = 0; r < 3; r++)
            corners[k][r] = ref_dot3(world[r], s->instance->mesh->tangents + 4 * (size_t)vertices[k]);
    return turned_sign(s, s->instance->mesh->tangents[4 * (size_t)vertices[0] + 3]);
}

static float face_tangent(const ref_surface *s, const ref_coordinates *at, float corners[3][3])
{
    const float (*p)[3] = s->corner_position, *u = at->corner[0], *v = at->corner[1];
    float a = u[1] - u[0], b = v[1] - v[0], c = u[2] - u[0], d = v[2] - v[0], det = a * d - c * b;
    for (int r = 0; r < 3; r++) {
        float e = p[1][r] - p[0][r], f = p[2][r] - p[0][r], t = e * d - f * b;
        for (int k = 0; k < 3; k++)
            corners[k][r] = det < 0.0f ? 0.0f - t : t;
    }
    return turned_sign(s, det < 0.0f ? -1.0f : 1.0f);
}

/* Finds the tangent of a face; all 0 if nothing defines one. */
static void find_tangent(const ref_scene *scene, ref_surface *s)
{
    const e3d_texture_use *slot = tangent_slot(s->piece->primitive.material);
    const float *n = s->shading_normal;
    float corners[3][3], sign, *t = s->tangent;
    ref_coordinates at;
    ref_slot_coordinates(slot, s, &at);
    if (s->instance->mesh->tangents && !is_flat(scene, s))
        sign = vertex_tangents(s, corners);
    else if (coordinates_of(slot, s))
        sign = face_tangent(s, &at, corners);
    else
        return;
    for (int r = 0; r < 3; r++) {
        float v[3];
        for (int k = 0; k < 3; k++)
            v[k] = s->piece->front ? 0.0f + corners[k][r] : 0.0f - corners[k][r];
        t[r] = ref_dot3(s->weight, v);
    }
    float along = ref_dot3(n, t);
    for (int r = 0; r < 3; r++)
        t[r] = t[r] - n[r] * along;
    ref_normalize(t);
    t[3] = s->piece->front ? sign : 0.0f - sign;
}

/* ---- normals (R48) ---- */

static void map_normal(const e3d_texture_use *use, float scale, const ref_surface *s, float out[3])
{
    const float *n = s->shading_normal, *t = s->tangent;
    float texel[4], b[3], mapped[3];
    for (int c = 0; c < 3; c++)
        out[c] = n[c];
    if (!ref_slot_counts(use, s))
        return;
    float unit = ref_slot_sample(use, s, texel);
    float x = (texel[0] * unit * 2.0f - 1.0f) * scale, y = (texel[1] * unit * 2.0f - 1.0f) * scale;
    float z = texel[2] * unit * 2.0f - 1.0f;
    ref_cross(n, t, b);
    for (int c = 0; c < 3; c++)
        mapped[c] = (t[c] * x + (b[c] * t[3]) * y) + n[c] * z;
    ref_normalize(mapped);
    for (int c = 0; c < 3; c++)
        out[c] = mapped[c];
}

/* ---- all of it ---- */

/* R193: how much wider normals make a lobe: those of a texture, or of vertices. */
static float wide_of(const ref_scene *scene, const ref_surface *s, const e3d_texture_use *normals, float scale)
{
    if (!scene->frame->specular_antialiasing)
        return 0.0f;
    if (!ref_slot_counts(normals, s))
        return s->curvature;
    return e3d_texture_get_view(normals->texture)->has_spread ? multiplied(normals, s, 3, 2.0f * (scale * scale)) : 0.0f;
}

/* R141 */
static void find_iridescence(const e3d_material *m, const ref_surface *s, ref_physical *out)
{
    const float *range = m->physical.iridescence_thickness;
    out->film_thickness = range[1];
    if (ref_slot_counts(&m->iridescence_thickness_texture, s))
        out->film_thickness = range[0] + multiplied(&m->iridescence_thickness_texture, s, 1, range[1] - range[0]);
    out->iridescence = multiplied(&m->iridescence_texture, s, 0, m->physical.iridescence);
    out->iridescence = out->film_thickness > 0.0f ? out->iridescence : 0.0f;
}

static void find_stretch(const e3d_material *m, const ref_surface *s, ref_physical *out)
{
    float texel[4], unit = 0.0f;
    int counts = ref_slot_counts(&m->anisotropy_texture, s);
    if (counts)
        unit = ref_slot_sample(&m->anisotropy_texture, s, texel);
    ref_find_stretch(&m->physical, counts ? texel : NULL, unit, s, &out->stretch);
}

/* R134: the world units of a thickness of 1. */
static float scale_below(const ref_surface *surface)
{
    const float (*w)[4] = surface->instance->world_from_object;
    float square[3];
    for (int r = 0; r < 3; r++)
        square[r] = (w[r][0] * w[r][0] + w[r][1] * w[r][1]) + w[r][2] * w[r][2];
    return sqrtf(((square[0] + square[1]) + square[2]) * E3D_THIRD);
}

static void find_physical(const ref_scene *scene, const e3d_material *m, ref_surface *s)
{
    const e3d_physical *physical = &m->physical;
    ref_physical *out = &s->physical;
    float tint[3];
    out->metallic = multiplied(&m->metallic_roughness_texture, s, 2, physical->metallic);
    out->roughness = multiplied(&m->metallic_roughness_texture, s, 1, physical->roughness);
    out->occlusion = find_occlusion(m, s);
    out->wide = wide_of(scene, s, &m->normal_texture, m->normal_scale);
    out->coat_wide = wide_of(scene, s, &m->clearcoat_normal_texture, physical->clearcoat_normal_scale);
    out->specular = multiplied(&m->specular_texture, s, 3, physical->specular_intensity);
    multiply_three(&m->specular_color_texture, s, physical->reflectance, tint);
    for (int c = 0; c < 3; c++)
        out->reflectance[c] = ref_min(tint[c], 1.0f) * out->specular;
    out->coat = multiplied(&m->clearcoat_texture, s, 0, physical->clearcoat);
    out->coat_roughness = multiplied(&m->clearcoat_roughness_texture, s, 1, physical->clearcoat_roughness);
    map_normal(&m->clearcoat_normal_texture, physical->clearcoat_normal_scale, s, out->coat_normal);
    multiply_three(&m->sheen_color_texture, s, physical->sheen_color, out->sheen);
    out->sheen_roughness = multiplied(&m->sheen_roughness_texture, s, 3, physical->sheen_roughness);
    out->transmission = multiplied(&m->transmission_texture, s, 0, physical->transmission);
    find_iridescence(m, s, out);
    if (physical->anisotropy != 0.0f)
        find_stretch(m, s, out);
    float scale = scale_below(s), thickness = multiplied(&m->thickness_texture, s, 1, physical->thickness);
    out->scale = s->piece->front ? scale : 0.0f;
    out->depth = thickness * out->scale;
    out->diffuse_transmission = multiplied(&m->diffuse_transmission_texture, s, 3, physical->diffuse_transmission);
    multiply_three(&m->diffuse_transmission_color_texture, s, physical->diffuse_transmission_color, out->passing);
    out->body = thickness * scale;
}

void ref_find_textures(const ref_scene *scene, ref_surface *surface)
{
    const ref_primitive *primitive = &surface->piece->primitive;
    const e3d_material *m = primitive->material;
    for (int c = 0; c < 4; c++)
        surface->tangent[c] = surface->view_tangent[c] = 0.0f;
    for (int c = 0; c < 3; c++) {
        surface->emissive[c] = m->emissive[c];
        surface->shading_normal[c] = surface->world_normal[c];
    }
    if (primitive->kind == REF_FACE) {
        find_tangent(scene, surface);
        map_normal(&m->normal_texture, m->normal_scale, surface, surface->world_normal);
    }
    if (primitive->kind == REF_FACE && m->is_physical) {
        find_physical(scene, m, surface);
        multiply_three(&m->emissive_texture, surface, m->emissive, surface->emissive);
    }
    for (int r = 0; r < 3; r++) {
        surface->view_normal[r] = ref_dot3(scene->view_from_world[r], surface->world_normal);
        surface->view_tangent[r] = ref_dot3(scene->view_from_world[r], surface->tangent);
    }
    surface->view_tangent[3] = surface->tangent[3];
}
