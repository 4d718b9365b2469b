/* shade: writes the outputs other than colour, from the visible sample of each pixel (R21, R22, R35). Samples come in the order
 * of their surfaces. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/texture_slots.h"
#include "frame/pass/draws.h"
#include "frame/pass/view.h"
#include "frame/shade/values.h"
#include "frame/store/outputs.h"

/* The pixel that each sample of the batch stands for. */
static const int32_t *pixels_of(const e3d_batch *batch, int32_t axis, int32_t *room)
{
    int32_t middle = axis / 2;
    if (axis == 1)
        return batch->sample;
    for (int i = 0; i < batch->count; i++) {
        int32_t x = batch->sample[i] % E3D_TILE, y = batch->sample[i] / E3D_TILE;
        int stands = x % axis == middle && y % axis == middle;
        room[i] = stands ? y / axis * E3D_TILE + x / axis : E3D_NO_PIXEL;
    }
    return room;
}

static void make_finite(const float *values, int count, float *out)
{
    for (int i = 0; i < count; i++)
        out[i] = fabsf(values[i]) <= FLT_MAX ? values[i] : 0.0f;
}

/* The destination of a batch: the gathered outputs, in which each sample has its pixel. */
typedef struct batch_place {
    const e3d_store *store;
    const e3d_batch *batch;
    const int32_t *at;
    e3d_store_memory *out;
} batch_place;

/* Writes the values of one output, channel by channel. */
static void put(const batch_place *place, e3d_output_kind kind, const e3d_lane_array *values)
{
    float *pixels = e3d_outputs_gathered(place->store, place->out, kind);
    const int32_t *at = place->at;
    int count = place->batch->count, channels = e3d_output_channels(kind);
    e3d_lane_array finite[4];
    if (!pixels)
        return;
    for (int k = 0; k < channels; k++)
        make_finite(values[k], count, finite[k]);
    for (int i = 0; i < count && channels == 1; i++)
        pixels[at[i]] = finite[0][i];
    for (int k = 0; k < 2 && channels == 2; k++)
        for (int i = 0; i < count; i++)
            pixels[2 * at[i] + k] = finite[k][i];
    for (int i = 0; i < count && channels == 3; i++)
        for (int k = 0; k < 3; k++)
            pixels[3 * at[i] + k] = finite[k][i];
    for (int i = 0; i < count && channels == 4; i++)
        for (int k = 0; k < 4; k++)
            pixels[4 * at[i] + k] = finite[k][i];
}

/* Applies rows of view_from_world, from `row` on, to positions (w = 1) or directions (w = 0). */
static void to_view(const e3d_view *view, const e3d_batch *batch, const e3d_lane_array *v, int w, int row, e3d_lane_array out[3])
{
    for (; row < 3; row++) {
        const float *m = view->rows + 4 * row;
        for (int i = 0; i < batch->count; i++) {
            float sum = (m[0] * v[0][i] + m[1] * v[1][i]) + m[2] * v[2][i];
            out[row][i] = w ? sum + m[3] : sum;
        }
    }
}

/* R181 */
static void find_ranges(const e3d_lane_array position[3], int count, float *out)
{
    for (int i = 0; i < count; i++) {
        double x = position[0][i], y = position[1][i], z = position[2][i];
        out[i] = (float)sqrt((x * x + y * y) + z * z);
    }
}

static void put_view(const batch_place *place)
{
    const e3d_batch *batch = place->batch;
    const e3d_view *view = place->store->pass->view;
    const e3d_targets *t = place->store->pass->targets;
    e3d_lane_array v[3];
    if (t->normal) {
        to_view(view, batch, batch->normal, 0, 0, v);
        put(place, E3D_OUTPUT_NORMAL, v);
    }
    if (t->position || t->depth || t->range) {
        int in_perspective = place->store->pass->frame->eye[3] == 1.0f;
        e3d_lane_array range;
        to_view(view, batch, e3d_batch_places(batch), 1, t->position || t->range ? 0 : 2, v);
        put(place, E3D_OUTPUT_POSITION, v);
        if (t->range && in_perspective)
            find_ranges(v, batch->count, range);
        for (int i = 0; i < batch->count; i++)
            v[2][i] = 0.0f - v[2][i];
        put(place, E3D_OUTPUT_DEPTH, v + 2);
        put(place, E3D_OUTPUT_RANGE, in_perspective ? (const e3d_lane_array *)&range : v + 2);
    }
}

static void fill(float value, int count, float *out)
{
    for (int i = 0; i < count; i++)
        out[i] = value;
}

/* R58 for a material without textures. */
static void fill_listed(const e3d_material *material, int count, e3d_texture_batch *out)
{
    fill(0.0f, count, out->metallic_roughness[0]);
    fill(1.0f, count, out->metallic_roughness[1]);
    for (int k = 0; k < 3; k++)
        fill(material->emissive[k], count, out->emissive[k]);
    for (int k = 0; k < 4; k++)
        fill(0.0f, count, out->tangent[k]);
}

/* R58 */
static void put_textures(const batch_place *place, const e3d_bucket *bucket, e3d_texture_batch *textures)
{
    const e3d_targets *t = place->store->pass->targets;
    int count = place->batch->count;
    if (!t->metallic_roughness && !t->emissive && !t->tangent)
        return;
    if (!bucket->mapped)
        fill_listed(bucket->material, count, textures);
    put(place, E3D_OUTPUT_METALLIC_ROUGHNESS, textures->metallic_roughness);
    put(place, E3D_OUTPUT_EMISSIVE, textures->emissive);
    if (t->tangent) {
        e3d_lane_array v[4];
        to_view(place->store->pass->view, place->batch, textures->tangent, 0, 0, v);
        memcpy(v[3], textures->tangent[3], sizeof v[3]);
        put(place, E3D_OUTPUT_TANGENT, v);
    }
}

/* R19 */
static void put_barycentric(const batch_place *place)
{
    const e3d_batch *batch = place->batch;
    e3d_lane_array b[3];
    for (int k = 0; k < 3 && place->store->pass->targets->barycentric; k++)
        for (int i = 0; i < batch->count; i++) {
            float v = batch->weight[k][i] * batch->r[i];
            b[k][i] = v < 1.0f ? v : 1.0f;
        }
    put(place, E3D_OUTPUT_BARYCENTRIC, b);
}

/* What IDs say of a surface. */
static int32_t id_of(const e3d_shade_memory *memory, e3d_output_kind kind, int32_t surface)
{
    const e3d_visible_primitive *primitive = (const e3d_visible_primitive *)memory->primitives.data + memory->surfaces.primitive[surface];
    const e3d_draw *draw = primitive->draw->draw;
    switch (kind) {
    case E3D_OUTPUT_FACE_ID: return e3d_face_of(primitive->draw, primitive->local);
    case E3D_OUTPUT_OBJECT_ID: return e3d_object_id(draw, primitive->instance);
    case E3D_OUTPUT_INSTANCE_ID: return e3d_instance_id(draw, primitive->instance);
    default: return ((const e3d_bucket *)memory->buckets.data)[primitive->bucket].material->id;
    }
}

/* Writes IDs, found once a surface; going from surface to surface here, too, would cost a wrong guess at the end of each. */
static void put_ids(const batch_place *place, const e3d_shade_memory *memory)
{
    const e3d_output_kind kinds[] = {E3D_OUTPUT_FACE_ID, E3D_OUTPUT_OBJECT_ID, E3D_OUTPUT_INSTANCE_ID, E3D_OUTPUT_MATERIAL_ID};
    const e3d_batch *batch = place->batch;
    int32_t ids[E3D_BATCH_SURFACES];
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        int32_t *pixels = e3d_outputs_gathered(place->store, place->out, kinds[k]);
        for (int32_t n = 0; n < memory->surfaces.count && pixels; n++)
            ids[n] = id_of(memory, kinds[k], n);
        for (int i = 0; i < batch->count && pixels; i++)
            pixels[place->at[i]] = ids[batch->surface[i]];
    }
}

void e3d_outputs_batch(const e3d_store *store, const e3d_bucket *bucket, e3d_shade_memory *memory, e3d_store_memory *out)
{
    const e3d_batch *batch = &memory->batch;
    int32_t room[E3D_BATCH];
    const batch_place place = {store, batch, pixels_of(batch, store->pass->frame->samples_axis, room), out};
    put_ids(&place, memory);
    put_view(&place);
    put(&place, E3D_OUTPUT_ALBEDO, batch->color);
    put(&place, E3D_OUTPUT_WORLD_NORMAL, batch->normal);
    put(&place, E3D_OUTPUT_WORLD_POSITION, e3d_batch_places(batch));
    put(&place, E3D_OUTPUT_UV, batch->uv);
    put_barycentric(&place);
    put_textures(&place, bucket, &memory->textures.batch);
}

void e3d_outputs_radiance(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *out)
{
    int32_t room[E3D_BATCH];
    const batch_place place = {store, batch, pixels_of(batch, store->pass->frame->samples_axis, room), out};
    put(&place, E3D_OUTPUT_RADIANCE, batch->color);
}
