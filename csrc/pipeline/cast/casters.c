/* cast: the corners of all casters in the world (R97), and which lights' grids have to be made anew. */
#include "pipeline/cast/casters.h"

#include <string.h>

#include "core/grow.h"
#include "core/mesh.h"
#include "core/pool.h"
#include "e3d.h"
#include "pipeline/cast/grids.h"
#include "pipeline/cast/holes.h"
#include "pipeline/pass/matrices.h"

enum { CASTERS_A_TASK = 4096 };

/* ---- instances ---- */

static int casters_are_valid(const e3d_casters *casters)
{
    if (casters->draw_count < 0)
        return 0;
    for (int32_t d = 0; d < casters->draw_count; d++) {
        const e3d_draw *draw = &casters->draws[d];
        if (!draw->mesh || draw->instances < 0 || draw->material_base < 0 ||
            (int64_t)draw->material_base + draw->mesh->material_most >= casters->material_count)
            return 0;
    }
    return 1;
}

static e3d_status list_instances(e3d_caster_memory *memory)
{
    const e3d_casters *casters = &memory->casters;
    int64_t instances = 0, first = 0;
    for (int32_t d = 0; d < casters->draw_count; d++)
        instances += casters->draws[d].instances;
    if (!e3d_array_reserve(&memory->instances, (size_t)instances + 1, sizeof(e3d_caster_instance)))
        return E3D_OUT_OF_MEMORY;
    e3d_caster_instance *out = memory->instances.data;
    for (int32_t d = 0; d < casters->draw_count; d++) {
        const e3d_draw *draw = &casters->draws[d];
        int32_t faces = draw->mesh->desc.components == 3 ? draw->mesh->desc.faces_count : 0;
        for (int32_t i = 0; i < draw->instances && faces; i++, first += faces)
            *out++ = (e3d_caster_instance){first, d, i};
    }
    *out = (e3d_caster_instance){first, -1, 0};
    memory->instances.count = (size_t)(out - (e3d_caster_instance *)memory->instances.data);
    memory->count = first;
    return first > INT32_MAX ? E3D_TOO_MANY_PRIMITIVES : E3D_OK;
}

const e3d_caster_instance *e3d_caster_instance_of(const e3d_caster_memory *memory, uint32_t caster)
{
    const e3d_caster_instance *instances = memory->instances.data;
    size_t low = 0, high = memory->instances.count - 1;
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        if (instances[middle].first <= (int64_t)caster)
            low = middle;
        else
            high = middle - 1;
    }
    return &instances[low];
}

/* ---- corners ---- */

static void place_faces(const e3d_caster_memory *memory, const e3d_caster_instance *instance, int32_t first, int32_t end)
{
    const e3d_draw *draw = &memory->casters.draws[instance->draw];
    const e3d_mesh_desc *mesh = &draw->mesh->desc;
    const e3d_material *materials = memory->casters.materials + draw->material_base;
    float (*world)[9] = (float (*)[9])memory->world.data + instance->first, m[12];
    uint8_t *may_be_open = (uint8_t *)memory->may_be_open.data + instance->first;
    double matrix[16];
    e3d_world_matrix(draw, instance->number, matrix);
    for (int k = 0; k < 12; k++)
        m[k] = (float)matrix[k];
    for (int32_t f = first; f < end; f++) {
        for (int k = 0; k < 3; k++) {
            const float *p = mesh->positions + 3 * (size_t)mesh->faces[3 * (size_t)f + (size_t)k];
            for (int c = 0; c < 3; c++)
                world[f][3 * k + c] = ((m[4 * c] * p[0] + m[4 * c + 1] * p[1]) + m[4 * c + 2] * p[2]) + m[4 * c + 3];
        }
        may_be_open[f] = materials[mesh->material_ids ? mesh->material_ids[f] : 0].alpha_mode != E3D_ALPHA_OPAQUE;
    }
}

static void place_some(void *argument, int task)
{
    const e3d_caster_memory *memory = argument;
    int64_t first = (int64_t)task * CASTERS_A_TASK, end = first + CASTERS_A_TASK;
    const e3d_caster_instance *instance = e3d_caster_instance_of(memory, (uint32_t)first);
    for (; instance->draw >= 0 && instance->first < end; instance++) {
        int64_t from = first > instance->first ? first - instance->first : 0;
        int64_t to = (end < instance[1].first ? end : instance[1].first) - instance->first;
        place_faces(memory, instance, (int32_t)from, (int32_t)to);
    }
}

static e3d_status place_casters(e3d_caster_memory *memory, int32_t threads)
{
    e3d_status status = list_instances(memory);
    if (status != E3D_OK)
        return status;
    if (!e3d_array_reserve(&memory->world, (size_t)memory->count + 1, sizeof(float[9])) ||
        !e3d_array_reserve(&memory->may_be_open, (size_t)memory->count + 1, 1))
        return E3D_OUT_OF_MEMORY;
    e3d_pool_share(threads, (int)((memory->count + CASTERS_A_TASK - 1) / CASTERS_A_TASK), place_some, memory);
    return E3D_OK;
}

/* ---- what is kept ---- */

static int is_same_light(const e3d_light *a, const e3d_light *b)
{
    return a->kind == b->kind && a->range == b->range && !memcmp(a->to_light, b->to_light, sizeof a->to_light) &&
           !memcmp(a->position, b->position, sizeof a->position);
}

static e3d_status find_lights(e3d_caster_memory *memory, const e3d_frame *frame, int32_t threads)
{
    int32_t count = 0;
    for (int32_t n = 0; n < frame->light_count; n++) {
        const e3d_light *light = &frame->lights[n];
        if (light->shadow.kind != E3D_SHADOW_EXACT)
            continue;
        if (count == E3D_MAX_EXACT_LIGHTS)
            return E3D_INVALID_ARGUMENT;
        e3d_caster_light *out = &memory->lights[count];
        if (count >= memory->kept_lights || !is_same_light(light, &memory->made_for[count])) {
            memory->kept_lights = count < memory->kept_lights ? count : memory->kept_lights;
            if (!e3d_find_grids(memory, light, &memory->of_light[count], out, threads))
                return E3D_OUT_OF_MEMORY;
            memory->made_for[count] = *light;
            memory->kept_lights = count + 1;
        }
        out->number = n;
        count++;
    }
    memory->index.light_count = count;
    return E3D_OK;
}

e3d_status e3d_casters_prepare(e3d_caster_memory *memory, const e3d_frame *frame, int32_t threads)
{
    const e3d_casters none = {NULL, 0, NULL, 0, 0}, *casters = frame->casters ? frame->casters : &none;
    if (!casters_are_valid(casters))
        return E3D_INVALID_ARGUMENT;
    int same = casters->version && casters->version == memory->casters.version;
    memory->casters = *casters;
    if (!same) {
        memory->kept_lights = 0;
        memory->casters.version = 0; /* until all is well */
        e3d_status status = place_casters(memory, threads);
        if (status != E3D_OK)
            return status;
        memory->casters.version = casters->version;
    }
    memory->index.lights = memory->lights;
    memory->index.world = memory->world.data;
    memory->index.may_be_open = memory->may_be_open.data;
    memory->index.is_open = e3d_caster_is_open;
    memory->index.source = memory;
    return find_lights(memory, frame, threads);
}

void e3d_casters_free(e3d_caster_memory *memory)
{
    e3d_array_free(&memory->instances);
    e3d_array_free(&memory->world);
    e3d_array_free(&memory->may_be_open);
    for (int n = 0; n < E3D_MAX_EXACT_LIGHTS; n++) {
        e3d_array_free(&memory->of_light[n].corners);
        for (int face = 0; face < E3D_CASTER_FACES; face++) {
            e3d_array_free(&memory->of_light[n].starts[face]);
            e3d_array_free(&memory->of_light[n].boxes[face]);
        }
    }
}
