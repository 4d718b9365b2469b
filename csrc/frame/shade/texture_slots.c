/* shade: materials with more textures than a base colour (R45-R49). Which textures count is found once for each bucket. */
#include <math.h>
#include <string.h>

#include "base/limits.h"
#include "kernels/types/shading.h"
#include "frame/pass/draws.h"
#include "frame/pass/plan.h"
#include "frame/pass/view.h"
#include "frame/shade/texture_slots.h"

int e3d_needs_textures(const e3d_prepared *pass, const e3d_material *material)
{
    const e3d_texture_use *base = &material->texture;
    int is_placed = base->texture && (base->uv_set || base->is_moved);
    return material->is_physical || material->normal_texture.texture || is_placed || e3d_plans(pass, E3D_PLAN_TANGENT);
}

int e3d_texture_counts(const e3d_bucket *bucket, const e3d_texture_use *use)
{
    return bucket->face && use->texture && (use->uv_set ? bucket->has_uvs1 : bucket->has_uvs);
}

/* ---- the textures of a bucket ---- */

/* Whether a bucket is lit; then the textures are read that light needs. */
static int finds_light(const e3d_prepared *pass, const e3d_bucket *bucket) { return e3d_plans(pass, E3D_PLAN_COLORS) && bucket->lit; }

static int widens_lobes(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    return pass->frame->specular_antialiasing && bucket->material->is_physical && finds_light(pass, bucket);
}

static int is_coated(const e3d_physical *p) { return p->clearcoat != 0.0f; }
static int has_sheen(const e3d_physical *p) { return e3d_adds(p->sheen_color); }
static int absorbs(const e3d_physical *p) { return p->thickness != 0.0f && e3d_adds(p->absorption); }
static int is_anisotropic(const e3d_physical *p) { return p->anisotropy != 0.0f; }
static int is_iridescent(const e3d_physical *p) { return p->iridescence != 0.0f; }

int e3d_is_translucent_body(const e3d_bucket *bucket) { return bucket->translucent && bucket->material->physical.thickness != 0.0f; }

int e3d_wants_curvature(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    const e3d_material *m = bucket->material;
    int base = !e3d_texture_counts(bucket, &m->normal_texture);
    int coat = is_coated(&m->physical) && !e3d_texture_counts(bucket, &m->clearcoat_normal_texture);
    return widens_lobes(pass, bucket) && (base || coat);
}

/* Whether a slot's texture tells how far normals spread, and lobes want to know. */
static int reads_spread(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_texture_slot slot, const e3d_texture_use *use)
{
    int holds_normals = slot == E3D_SLOT_NORMAL || slot == E3D_SLOT_CLEARCOAT_NORMAL;
    return holds_normals && e3d_texture_get_view(use->texture)->has_spread && widens_lobes(pass, bucket);
}

/* Whether the fourth channel of a slot is read. */
static int reads_fourth(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_texture_slot slot, const e3d_texture_use *use)
{
#define FOURTH(slot, channel, name, factor) | ((channel) == 3) << slot
    enum { ALWAYS = 0 E3D_EACH_VARYING(FOURTH) };
    return ((ALWAYS >> slot) & 1) || (slot == E3D_SLOT_TEXTURE && bucket->material->alpha_mode != E3D_ALPHA_OPAQUE) ||
           reads_spread(pass, bucket, slot, use);
}

/* Whether a slot is read for what the frame asks for. */
static int is_read(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_texture_slot slot)
{
    const e3d_material *m = bucket->material;
    const e3d_physical *p = &m->physical;
    int lit = m->is_physical && finds_light(pass, bucket), listed = m->is_physical && e3d_plans(pass, E3D_PLAN_MATERIAL_VALUES);
    switch (slot) {
    case E3D_SLOT_TEXTURE: return e3d_plans(pass, E3D_PLAN_BASE_COLOR) || m->alpha_mode != E3D_ALPHA_OPAQUE;
    case E3D_SLOT_NORMAL: return e3d_plans(pass, E3D_PLAN_NORMAL);
    case E3D_SLOT_METALLIC_ROUGHNESS:
    case E3D_SLOT_EMISSIVE: return lit || listed;
    case E3D_SLOT_CLEARCOAT:
    case E3D_SLOT_CLEARCOAT_ROUGHNESS:
    case E3D_SLOT_CLEARCOAT_NORMAL: return lit && is_coated(p);
    case E3D_SLOT_SHEEN_COLOR:
    case E3D_SLOT_SHEEN_ROUGHNESS: return lit && has_sheen(p);
    case E3D_SLOT_TRANSMISSION: return lit && bucket->transmits;
    case E3D_SLOT_THICKNESS: return lit && ((bucket->transmits && (absorbs(p) || bucket->bends)) || e3d_is_translucent_body(bucket));
    case E3D_SLOT_DIFFUSE_TRANSMISSION:
    case E3D_SLOT_DIFFUSE_TRANSMISSION_COLOR: return lit && bucket->translucent;
    case E3D_SLOT_ANISOTROPY: return lit && is_anisotropic(p);
    case E3D_SLOT_IRIDESCENCE:
    case E3D_SLOT_IRIDESCENCE_THICKNESS: return lit && is_iridescent(p);
    default: return lit;
    }
}

static int same_place(const e3d_texture_place *a, const e3d_texture_place *b)
{
    return a->uv_set == b->uv_set && a->is_moved == b->is_moved && !memcmp(a->matrix, b->matrix, sizeof a->matrix) &&
           a->texels[0] == b->texels[0] && a->texels[1] == b->texels[1];
}

/* The number of the place at which a slot is read, with its texture or, for tangents, without. */
static int32_t find_place(e3d_read_textures *textures, const e3d_texture_use *use, const e3d_texture_view *view)
{
    e3d_texture_place place = {.uv_set = use->uv_set, .is_moved = use->is_moved};
    int32_t number = 0;
    if (use->is_moved)
        memcpy(place.matrix, use->matrix, sizeof place.matrix);
    if (view) {
        place.texels[0] = e3d_counted_size(view, view->levels[0].width);
        place.texels[1] = e3d_counted_size(view, view->levels[0].height);
    }
    while (number < textures->place_count && !same_place(&textures->places[number], &place))
        number++;
    if (number == textures->place_count)
        textures->places[textures->place_count++] = place;
    textures->places[number].has_level |= view && view->filter == E3D_TRILINEAR;
    return number;
}

static int32_t find_texture(e3d_read_textures *textures, const e3d_texture_use *use, int has_alpha)
{
    const e3d_texture_view *view = e3d_texture_get_view(use->texture);
    e3d_read_texture texture = {.view = view, .place = find_place(textures, use, view)};
    int32_t number = 0;
    while (number < textures->count && (textures->read[number].view != view || textures->read[number].place != texture.place))
        number++;
    if (number == textures->count)
        textures->read[textures->count++] = texture;
    textures->read[number].has_alpha |= has_alpha;
    return number;
}

/* R47: finds the place whose coordinates define the tangent. */
static void find_tangent_place(const e3d_bucket *bucket, e3d_read_textures *out)
{
    const e3d_material *m = bucket->material;
    int by_coat = m->is_physical && !m->normal_texture.texture;
    const e3d_texture_use *slot = by_coat ? &m->clearcoat_normal_texture : &m->normal_texture;
    out->vertex_tangents = bucket->has_tangents && !bucket->flat;
    if (out->vertex_tangents)
        out->tangent_place = 0;
    else if (slot->uv_set ? bucket->has_uvs1 : bucket->has_uvs)
        out->tangent_place = find_place(out, slot, slot->texture ? e3d_texture_get_view(slot->texture) : NULL);
}

void e3d_find_textures(const e3d_prepared *pass, const e3d_bucket *bucket, int wanted, e3d_read_textures *out)
{
    const e3d_material *m = bucket->material;
    int all = wanted & E3D_WANT_TEXTURES;
    out->place_count = out->count = 0;
    out->tangent_place = -1;
#define FIND(slot, name) \
    out->of_slot[slot] = -1; \
    if ((slot == E3D_SLOT_TEXTURE || all) && is_read(pass, bucket, slot) && e3d_texture_counts(bucket, &m->name)) \
        out->of_slot[slot] = find_texture(out, &m->name, reads_fourth(pass, bucket, slot, &m->name));
    E3D_EACH_TEXTURE_SLOT(FIND)
    int stretched = m->is_physical && is_anisotropic(&m->physical) && finds_light(pass, bucket);
    if (out->of_slot[E3D_SLOT_NORMAL] >= 0 || out->of_slot[E3D_SLOT_CLEARCOAT_NORMAL] >= 0 ||
        (all && (e3d_plans(pass, E3D_PLAN_TANGENT) || stretched)))
        find_tangent_place(bucket, out);
}

/* ---- what a primitive brings ---- */

static void add_place(const e3d_texture_place *place, const e3d_mesh_desc *mesh, const int32_t vertex[3],
                      e3d_surface_floats uv[2][3], int32_t n)
{
    const float *uvs = place->uv_set ? mesh->uvs1 : mesh->uvs, *m = place->matrix;
    for (int k = 0; k < 3; k++) {
        float u = uvs[2 * (size_t)vertex[k]], v = uvs[2 * (size_t)vertex[k] + 1];
        uv[0][k][n] = place->is_moved ? (m[0] * u + m[1] * v) + m[2] : u;
        uv[1][k][n] = place->is_moved ? (m[3] * u + m[4] * v) + m[5] : v;
    }
}

void e3d_add_texture_surface(const e3d_prepared *pass, const e3d_visible_primitive *primitive, const e3d_read_textures *textures,
                             e3d_texture_surfaces *out, int32_t n)
{
    const e3d_mesh_desc *mesh = &primitive->draw->mesh->desc;
    for (int p = 0; p < textures->place_count; p++)
        add_place(&textures->places[p], mesh, primitive->vertex, out->uv[p], n);
    if (textures->tangent_place < 0)
        return;
    int32_t instance = (int32_t)primitive->draw->instance_base + primitive->instance;
    out->turned_round[n] = pass->view->instances[instance].mirrored != pass->view->mirrors;
    if (!textures->vertex_tangents)
        return;
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            out->tangent[c][k][n] = mesh->tangents[4 * (size_t)primitive->vertex[k] + c];
    out->sign[n] = mesh->tangents[4 * (size_t)primitive->vertex[0] + 3];
}

/* ---- what textures say of a batch ---- */

e3d_varying e3d_varying_of(const e3d_texture_memory *memory, e3d_texture_slot slot, int channel, float factor)
{
    int32_t texture = memory->read.of_slot[slot];
    if (texture < 0)
        return (e3d_varying){NULL, factor};
    return (e3d_varying){memory->batch.texel[texture][channel], factor * e3d_texture_unit(memory->read.read[texture].view)};
}

static e3d_normal_texture normals_of(const e3d_texture_memory *memory, e3d_texture_slot slot, float scale)
{
    int32_t texture = memory->read.of_slot[slot];
    if (texture < 0)
        return (e3d_normal_texture){NULL, 0.0f, 0.0f};
    return (e3d_normal_texture){memory->batch.texel[texture], e3d_texture_unit(memory->read.read[texture].view), scale};
}

e3d_varying e3d_mapped_alpha(const e3d_bucket *bucket, const e3d_texture_memory *textures)
{
    return e3d_varying_of(textures, E3D_SLOT_TEXTURE, 3, bucket->material->alpha);
}

static void find_base(const e3d_kernels *kernels, const e3d_bucket *bucket, const e3d_surfaces *surfaces,
                      const e3d_texture_memory *textures,
                      e3d_batch *batch)
{
    for (int k = 0; k < 3; k++) {
        e3d_varying base = e3d_varying_of(textures, E3D_SLOT_TEXTURE, k, bucket->material->color[k]);
        kernels->varying(&base, batch->count, batch->color[k]);
    }
    if (bucket->by_vertex || bucket->by_instance)
        kernels->tint(batch, surfaces, bucket->by_vertex, bucket->by_instance);
}

/* R58 */
static void find_listed(const e3d_kernels *kernels, const e3d_bucket *bucket, int count, e3d_texture_memory *textures)
{
    const e3d_material *m = bucket->material;
    e3d_varying metallic = e3d_varying_of(textures, E3D_SLOT_METALLIC_ROUGHNESS, 2, m->is_physical ? m->physical.metallic : 0.0f);
    e3d_varying roughness = e3d_varying_of(textures, E3D_SLOT_METALLIC_ROUGHNESS, 1, m->is_physical ? m->physical.roughness : 1.0f);
    kernels->varying(&metallic, count, textures->batch.metallic_roughness[0]);
    kernels->varying(&roughness, count, textures->batch.metallic_roughness[1]);
    for (int k = 0; k < 3; k++) {
        e3d_varying emissive = e3d_varying_of(textures, E3D_SLOT_EMISSIVE, k, m->emissive[k]);
        kernels->varying(&emissive, count, textures->batch.emissive[k]);
    }
}

void e3d_find_texture_batch(const e3d_prepared *pass, const e3d_bucket *bucket, int wanted, e3d_shade_memory *memory)
{
    const e3d_kernels *kernels = pass->kernels;
    const e3d_material *m = bucket->material;
    e3d_texture_memory *textures = &memory->textures;
    e3d_batch *batch = &memory->batch;
    if (textures->read.tangent_place < 0)
        memset(textures->batch.tangent, 0, sizeof textures->batch.tangent);
    kernels->read_textures(batch, &memory->surfaces, &textures->read, &textures->surfaces, &textures->batch);
    if (!(wanted & E3D_WANT_TEXTURES))
        return;
    if (e3d_plans(pass, E3D_PLAN_NORMAL)) {
        e3d_normal_texture surface = normals_of(textures, E3D_SLOT_NORMAL, m->normal_scale);
        e3d_normal_texture coat = normals_of(textures, E3D_SLOT_CLEARCOAT_NORMAL, m->physical.clearcoat_normal_scale);
        kernels->map_normals(batch, &surface, &coat, &textures->batch);
    }
    if (e3d_plans(pass, E3D_PLAN_BASE_COLOR))
        find_base(kernels, bucket, &memory->surfaces, textures, batch);
    if (e3d_plans(pass, E3D_PLAN_MATERIAL_VALUES))
        find_listed(kernels, bucket, batch->count, textures);
}

/* ---- light ---- */

/* The root mean square of the lengths that the axes have in world space. */
static float scale_of(const e3d_prepared *pass, const e3d_visible_primitive *primitive)
{
    const float *w = pass->draws->instances[primitive->draw->instance_base + primitive->instance].world;
    float square[3];
    for (int r = 0; r < 3; r++)
        square[r] = (w[4 * r] * w[4 * r] + w[4 * r + 1] * w[4 * r + 1]) + w[4 * r + 2] * w[4 * r + 2];
    return sqrtf(((square[0] + square[1]) + square[2]) * E3D_THIRD);
}

/* R134: finds how many world units a thickness of 1 has at each sample; spared: 0 at back faces. */
static void find_depths(const e3d_prepared *pass, const e3d_shade_memory *memory, int spared, float *out)
{
    const e3d_visible_primitive *primitives = memory->primitives.data;
    const e3d_batch *batch = &memory->batch;
    float depth = 0.0f;
    for (int i = 0; i < e3d_padded_count(batch); i++) {
        int32_t n = batch->surface[i];
        if (!i || n != batch->surface[i - 1])
            depth = spared && memory->surfaces.back[n] ? 0.0f : scale_of(pass, &primitives[memory->surfaces.primitive[n]]);
        out[i] = depth;
    }
}

void e3d_find_bodies(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_shade_memory *memory)
{
    const e3d_varying thickness = e3d_varying_of(&memory->textures, E3D_SLOT_THICKNESS, 1, bucket->material->physical.thickness);
    float *body = memory->textures.batch.body;
    e3d_lane_array scale;
    find_depths(pass, memory, 0, scale);
    pass->kernels->varying(&thickness, memory->batch.count, body);
    for (int i = 0; i < e3d_padded_count(&memory->batch); i++)
        body[i] = body[i] * scale[i];
}

static e3d_anisotropy_texture stretch_of(const e3d_texture_memory *memory, const e3d_physical *p)
{
    e3d_normal_texture directions = normals_of(memory, E3D_SLOT_ANISOTROPY, 1.0f);
    return (e3d_anisotropy_texture){directions.texels, directions.unit, p->anisotropy, {p->anisotropy_turn[0], p->anisotropy_turn[1]}};
}

/* Adds the numbers that few materials have; code of their own shades these. */
static void add_rare(const e3d_texture_memory *textures, const e3d_physical *p, e3d_brdf *brdf)
{
    int varies = textures->read.of_slot[E3D_SLOT_IRIDESCENCE_THICKNESS] >= 0;
    float least = p->iridescence_thickness[0], most = p->iridescence_thickness[1];
    brdf->anisotropic = is_anisotropic(p);
    brdf->iridescent = is_iridescent(p);
    brdf->stretch = stretch_of(textures, p);
    brdf->iridescence_thickness = e3d_varying_of(textures, E3D_SLOT_IRIDESCENCE_THICKNESS, 1, varies ? most - least : most);
    brdf->iridescence_thickness_least = least;
    brdf->iridescence_ior = p->iridescence_ior;
    brdf->is_rare = brdf->transmits || brdf->translucent || brdf->anisotropic || brdf->iridescent;
}

/* R193: how much wider normals make a lobe: those of a texture, or of vertices. */
static e3d_varying wide_of(const e3d_shade_memory *memory, e3d_texture_slot slot, float scale)
{
    const e3d_texture_memory *textures = &memory->textures;
    int32_t texture = textures->read.of_slot[slot];
    if (texture < 0)
        return (e3d_varying){memory->batch.curvature, 1.0f};
    if (!textures->read.read[texture].view->has_spread)
        return (e3d_varying){NULL, 0.0f};
    return e3d_varying_of(textures, slot, 3, 2.0f * (scale * scale));
}

static void add_mirrors(const e3d_bucket *bucket, const e3d_shade_memory *memory, e3d_brdf *brdf)
{
    if (!bucket->mirrors)
        return;
    brdf->unmirrored = memory->mirrors.rest;
    brdf->is_rare = 1;
}

static e3d_brdf brdf_of(const e3d_prepared *pass, const e3d_bucket *bucket, const e3d_shade_memory *memory)
{
    const e3d_texture_memory *textures = &memory->textures;
    const e3d_material *m = bucket->material;
    const e3d_physical *p = &m->physical;
    e3d_brdf brdf = {
        .is_widened = widens_lobes(pass, bucket),
        .wide = wide_of(memory, E3D_SLOT_NORMAL, m->normal_scale),
        .coat_wide = wide_of(memory, E3D_SLOT_CLEARCOAT_NORMAL, p->clearcoat_normal_scale),
        .occlusion_strength = p->occlusion_strength,
        .transmits = bucket->transmits,
        .translucent = bucket->translucent,
        .absorbs = (bucket->transmits || bucket->translucent) && absorbs(p),
        .has_coat = is_coated(p),
        .has_sheen = has_sheen(p),
        .is_grey = textures->read.of_slot[E3D_SLOT_SPECULAR_COLOR] < 0 && p->reflectance[0] == p->reflectance[1] &&
                   p->reflectance[1] == p->reflectance[2],
        .coat_is_mapped = textures->read.of_slot[E3D_SLOT_CLEARCOAT_NORMAL] >= 0,
    };
#define VARYING(slot, channel, name, factor) brdf.name = e3d_varying_of(textures, slot, channel, factor);
    E3D_EACH_VARYING(VARYING)
    for (int k = 0; k < 3; k++) {
#define VARYING_COLOR(slot, name, factors) brdf.name[k] = e3d_varying_of(textures, slot, k, factors[k]);
        E3D_EACH_VARYING_COLOR(VARYING_COLOR)
        brdf.absorption[k] = p->absorption[k];
    }
    add_rare(textures, p, &brdf);
    add_mirrors(bucket, memory, &brdf);
    return brdf;
}

void e3d_share_mirrors(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_shade_memory *memory)
{
    const e3d_brdf brdf = brdf_of(pass, bucket, memory);
    pass->kernels->mirror_shares(&memory->batch, &memory->textures.batch, &brdf, e3d_lighting_of(pass->view, bucket->unshadowed),
                                 &memory->mirrors);
}

void e3d_light_physical(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_shade_memory *memory)
{
    const e3d_brdf brdf = brdf_of(pass, bucket, memory);
    if (bucket->transmits && (brdf.absorbs || bucket->bends))
        find_depths(pass, memory, 1, memory->textures.batch.depth);
    if (e3d_plans(pass, E3D_PLAN_ADDS_AREA_LIGHTS))
        pass->kernels->area_physical(&memory->batch, &brdf, e3d_lighting_of(pass->view, bucket->unshadowed), &memory->textures.batch);
    pass->kernels->physical(&memory->batch, &brdf, e3d_lighting_of(pass->view, bucket->unshadowed), &memory->textures.batch);
}
