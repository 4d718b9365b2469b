/* cast: the casters that are kept from frame to frame, and which lights' grids have to be made again; soft lights share a tree. */
#include "frame/cast/casters.h"

#include <string.h>

#include "base/grow.h"
#include "frame/cast/holes.h"

/* ---- what is kept ---- */

static int is_soft(const e3d_light *light) { return light->shadow.soft > 0.0f; }

static int is_same_light(const e3d_light *a, const e3d_light *b)
{
    return a->kind == b->kind && is_soft(a) == is_soft(b) && a->range == b->range && !memcmp(a->to_light, b->to_light, sizeof a->to_light) &&
           !memcmp(a->position, b->position, sizeof a->position);
}

static e3d_status find_lights(e3d_caster_memory *memory, const e3d_frame *frame, int32_t threads)
{
    int32_t count = 0;
    memory->index.soft_lights = 0;
    for (int32_t n = 0; n < frame->light_count; n++) {
        const e3d_light *light = &frame->lights[n];
        if (light->shadow.kind != E3D_SHADOW_EXACT)
            continue;
        if (count == E3D_MAX_EXACT_LIGHTS)
            return E3D_INVALID_ARGUMENT;
        e3d_caster_light *out = &memory->lights[count];
        if (count >= memory->kept_lights || !is_same_light(light, &memory->made_for[count])) {
            memory->kept_lights = count < memory->kept_lights ? count : memory->kept_lights;
            if (!is_soft(light) && !e3d_find_grids(&memory->faces, light, &memory->of_light[count], out, threads))
                return E3D_OUT_OF_MEMORY;
            memory->made_for[count] = *light;
            memory->kept_lights = count + 1;
        }
        out->number = n;
        memory->index.soft_lights += is_soft(light);
        count++;
    }
    memory->index.light_count = count;
    return E3D_OK;
}

static e3d_status find_tree(e3d_caster_memory *memory)
{
    if (!memory->index.soft_lights || memory->has_tree)
        return E3D_OK;
    memory->has_tree = e3d_find_caster_tree(&memory->faces, &memory->tree, &memory->index.tree);
    return memory->has_tree ? E3D_OK : E3D_OUT_OF_MEMORY;
}

e3d_status e3d_casters_prepare(e3d_caster_memory *memory, const e3d_frame *frame, int32_t threads)
{
    const e3d_casters none = {NULL, 0, NULL, 0, 0}, *casters = frame->casters ? frame->casters : &none;
    if (!e3d_casters_are_valid(casters))
        return E3D_INVALID_ARGUMENT;
    int same = casters->version && casters->version == memory->faces.casters.version;
    memory->faces.casters = *casters;
    if (!same) {
        memory->kept_lights = memory->has_tree = 0;
        memory->faces.casters.version = 0; /* until all is well */
        e3d_status status = e3d_place_casters(&memory->faces, threads);
        if (status != E3D_OK)
            return status;
        memory->faces.casters.version = casters->version;
    }
    memory->index.lights = memory->lights;
    memory->index.world = memory->faces.world.data;
    memory->index.may_be_open = memory->faces.may_be_open.data;
    memory->index.is_mirrored = memory->faces.is_mirrored.data;
    memory->index.is_open = e3d_caster_is_open;
    memory->index.any_spared = e3d_any_caster_is_spared(casters);
    memory->index.is_spared = e3d_caster_is_spared;
    memory->index.mesh_of = e3d_caster_mesh_of;
    memory->index.source = &memory->faces;
    e3d_status status = find_lights(memory, frame, threads);
    return status == E3D_OK ? find_tree(memory) : status;
}

void e3d_casters_free(e3d_caster_memory *memory)
{
    e3d_array_free(&memory->faces.instances);
    e3d_array_free(&memory->faces.world);
    e3d_array_free(&memory->faces.may_be_open);
    e3d_array_free(&memory->faces.is_mirrored);
    e3d_array_free(&memory->tree.nodes);
    e3d_array_free(&memory->tree.casters);
    for (int n = 0; n < E3D_MAX_EXACT_LIGHTS; n++) {
        e3d_array_free(&memory->of_light[n].corners);
        for (int face = 0; face < E3D_CASTER_FACES; face++) {
            e3d_array_free(&memory->of_light[n].starts[face]);
            e3d_array_free(&memory->of_light[n].boxes[face]);
        }
    }
}
