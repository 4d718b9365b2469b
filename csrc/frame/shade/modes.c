/* shade, display modes: colours that show depths, normals or numbers (R32). */
#include <stdint.h>

#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "frame/pass/draws.h"
#include "frame/pass/view.h"
#include "frame/shade/modes.h"

static void set_bytes(e3d_batch *batch, int i, uint32_t bytes)
{
    for (int k = 0; k < 3; k++)
        batch->color[k][i] = (float)(bytes >> (8 * k) & 255u) * E3D_UNORM8;
}

static uint32_t random_bytes(uint32_t h)
{
    h ^= h >> 16;
    h *= 0x7FEB352Du;
    h ^= h >> 15;
    h *= 0x846CA68Bu;
    h ^= h >> 16;
    uint32_t bytes = 0;
    for (int k = 0; k < 3; k++)
        bytes |= (64 + (h >> (8 * k) & 255u) * 3 / 4) << (8 * k);
    return bytes;
}

static uint32_t number_bytes(int32_t id) { return ((uint32_t)id + 1) * 0x9E3779B1u & 0xFFFFFFu; }

static void show_numbers(e3d_mode mode, e3d_shade_memory *memory)
{
    const e3d_visible_primitive *primitives = memory->primitives.data;
    e3d_batch *batch = &memory->batch;
    for (int i = 0; i < batch->count; i++) {
        const e3d_visible_primitive *primitive = &primitives[memory->surfaces.primitive[batch->surface[i]]];
        int32_t id = mode == E3D_MODE_OBJECT_ID ? e3d_object_id(primitive->draw->draw, primitive->instance) : primitive->local;
        set_bytes(batch, i, mode == E3D_MODE_RANDOM ? random_bytes((uint32_t)id) : number_bytes(id));
    }
}

static void show_depth(const e3d_prepared *pass, e3d_batch *batch)
{
    const float *v = pass->view->rows + 8;
    float near = pass->frame->depth_near;
    float scale = 1.0f / (pass->frame->depth_far - near);
    for (int i = 0; i < batch->count; i++) {
        float z = ((v[0] * batch->position[0][i] + v[1] * batch->position[1][i]) + v[2] * batch->position[2][i]) + v[3];
        float t = ((0.0f - z) - near) * scale;
        t = t > 0.0f ? t : 0.0f;
        t = t < 1.0f ? t : 1.0f;
        for (int k = 0; k < 3; k++)
            batch->color[k][i] = 1.0f - t;
    }
}

static void show_normal(const e3d_prepared *pass, e3d_batch *batch)
{
    const float *v = pass->view->rows;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < batch->count; i++) {
            float n = (v[4 * k] * batch->normal[0][i] + v[4 * k + 1] * batch->normal[1][i]) + v[4 * k + 2] * batch->normal[2][i];
            batch->color[k][i] = n * 0.5f + 0.5f;
        }
}

void e3d_show_mode(const e3d_prepared *pass, e3d_shade_memory *memory)
{
    if (pass->frame->mode == E3D_MODE_DEPTH)
        show_depth(pass, &memory->batch);
    else if (pass->frame->mode == E3D_MODE_NORMAL)
        show_normal(pass, &memory->batch);
    else
        show_numbers(pass->frame->mode, memory);
}
