/* Casters: all faces that may hide a light, in the world.
 * In: the frame's casters. Out: a list of their faces; its order does not matter.
 * Rules: R97; the corners are R3's. */
#include <math.h>
#include <stdlib.h>

#include "reference/stages.h"

static int64_t faces_of(const e3d_draw *draw)
{
    const e3d_mesh_desc *mesh = e3d_mesh_view(draw->mesh);
    return mesh->components == 3 ? mesh->faces_count : 0;
}

/* R97 */
static void add_faces(ref_casters *casters, int32_t number)
{
    const ref_instance *instance = &casters->instances[number];
    const e3d_mesh_desc *mesh = instance->mesh;
    for (int32_t face = 0; face < faces_of(instance->draw); face++) {
        ref_caster *caster = &casters->items[casters->count];
        int finite = 1;
        caster->instance = number;
        caster->face = face;
        for (int k = 0; k < 3; k++) {
            float *p = caster->corner[k];
            ref_transform_point(instance->world_from_object, mesh->positions + 3 * (size_t)mesh->faces[3 * (size_t)face + (size_t)k], p);
            finite = finite && isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
        }
        casters->count += finite;
    }
}

/* R97 */
e3d_status ref_find_casters(const e3d_frame *frame, ref_casters *out)
{
    const e3d_casters *source = frame->casters;
    int64_t instances = 0, faces = 0;
    *out = (ref_casters){.source = source, .frame = frame};
    for (int32_t d = 0; source && d < source->draw_count; d++) {
        if (source->draws[d].instances < 0)
            return E3D_INVALID_ARGUMENT;
        instances += source->draws[d].instances;
        faces += faces_of(&source->draws[d]) * source->draws[d].instances;
    }
    if (faces > INT32_MAX)
        return E3D_TOO_MANY_PRIMITIVES;
    out->instances = malloc(((size_t)instances + 1) * sizeof *out->instances);
    out->items = malloc(((size_t)faces + 1) * sizeof *out->items);
    if (!out->instances || !out->items)
        return E3D_OUT_OF_MEMORY;
    int32_t number = 0;
    for (int32_t d = 0; source && d < source->draw_count; d++)
        for (int32_t i = 0; i < source->draws[d].instances; i++) {
            ref_instance_init(&out->instances[number], frame, &source->draws[d], i);
            add_faces(out, number++);
        }
    return E3D_OK;
}

void ref_free_casters(ref_casters *casters)
{
    free(casters->instances);
    free(casters->items);
}
