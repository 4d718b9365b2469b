/* cast: the faces that cast exact shadows, instance by instance, and their corners in the world (R97). */
#include "frame/cast/faces.h"

#include <string.h>

#include "data/mesh/mesh.h"
#include "base/pool.h"
#include "frame/pass/matrices.h"

enum { CASTERS_A_TASK = 4096 };

/* ---- instances ---- */

int e3d_casters_are_valid(const e3d_casters *casters)
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

static e3d_status list_instances(e3d_caster_faces *faces)
{
    const e3d_casters *casters = &faces->casters;
    int64_t instances = 0, first = 0;
    for (int32_t d = 0; d < casters->draw_count; d++)
        instances += casters->draws[d].instances;
    if (!e3d_array_reserve(&faces->instances, (size_t)instances + 1, sizeof(e3d_caster_instance)))
        return E3D_OUT_OF_MEMORY;
    e3d_caster_instance *out = faces->instances.data;
    for (int32_t d = 0; d < casters->draw_count; d++) {
        const e3d_draw *draw = &casters->draws[d];
        int32_t count = draw->mesh->desc.components == 3 ? draw->mesh->desc.faces_count : 0;
        for (int32_t i = 0; i < draw->instances && count; i++, first += count)
            *out++ = (e3d_caster_instance){first, d, i};
    }
    *out = (e3d_caster_instance){first, -1, 0};
    faces->instances.count = (size_t)(out - (e3d_caster_instance *)faces->instances.data);
    faces->count = first;
    return first > INT32_MAX ? E3D_TOO_MANY_PRIMITIVES : E3D_OK;
}

const e3d_caster_instance *e3d_caster_instance_of(const e3d_caster_faces *faces, uint32_t caster)
{
    const e3d_caster_instance *instances = faces->instances.data;
    size_t low = 0, high = faces->instances.count - 1;
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        if (instances[middle].first <= (int64_t)caster)
            low = middle;
        else
            high = middle - 1;
    }
    return &instances[low];
}

const void *e3d_caster_mesh_of(const e3d_caster_index *index, uint32_t caster)
{
    const e3d_caster_faces *faces = index->source;
    return faces->casters.draws[e3d_caster_instance_of(faces, caster)->draw].mesh;
}

int e3d_caster_is_spared(const e3d_caster_index *index, uint32_t caster, int32_t exact)
{
    const e3d_caster_faces *faces = index->source;
    return (int)(faces->casters.draws[e3d_caster_instance_of(faces, caster)->draw].spared_lights >> exact & 1);
}

int e3d_any_caster_is_spared(const e3d_casters *casters)
{
    for (int32_t d = 0; d < casters->draw_count; d++)
        if (casters->draws[d].spared_lights)
            return 1;
    return 0;
}

/* ---- corners ---- */

static void place_faces(const e3d_caster_faces *faces, const e3d_caster_instance *instance, int32_t first, int32_t end)
{
    const e3d_draw *draw = &faces->casters.draws[instance->draw];
    const e3d_mesh_desc *mesh = &draw->mesh->desc;
    const e3d_material *materials = faces->casters.materials + draw->material_base;
    float (*world)[9] = (float (*)[9])faces->world.data + instance->first, m[12];
    uint8_t *may_be_open = (uint8_t *)faces->may_be_open.data + instance->first;
    float normals[9];
    double matrix[16];
    e3d_world_matrix(draw, instance->number, matrix);
    memset((uint8_t *)faces->is_mirrored.data + instance->first + first, e3d_normal_matrix(matrix, normals) != 0, (size_t)(end - first));
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
    const e3d_caster_faces *faces = argument;
    int64_t first = (int64_t)task * CASTERS_A_TASK, end = first + CASTERS_A_TASK;
    const e3d_caster_instance *instance = e3d_caster_instance_of(faces, (uint32_t)first);
    for (; instance->draw >= 0 && instance->first < end; instance++) {
        int64_t from = first > instance->first ? first - instance->first : 0;
        int64_t to = (end < instance[1].first ? end : instance[1].first) - instance->first;
        place_faces(faces, instance, (int32_t)from, (int32_t)to);
    }
}

e3d_status e3d_place_casters(e3d_caster_faces *faces, int32_t threads)
{
    e3d_status status = list_instances(faces);
    if (status != E3D_OK)
        return status;
    if (!e3d_array_reserve(&faces->world, (size_t)faces->count + 1, sizeof(float[9])) ||
        !e3d_array_reserve(&faces->may_be_open, (size_t)faces->count + 1, 1) ||
        !e3d_array_reserve(&faces->is_mirrored, (size_t)faces->count + 1, 1))
        return E3D_OUT_OF_MEMORY;
    e3d_pool_share(threads, (int)((faces->count + CASTERS_A_TASK - 1) / CASTERS_A_TASK), place_some, faces);
    return E3D_OK;
}
