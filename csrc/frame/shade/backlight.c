/* shade: finds the light that falls on the other side of translucent surfaces (R169).
 * In: a batch of such surfaces. Out: its `energy`, and `body` of its textures; all else is as before, but what is found again for
 * each light. */
#include <math.h>
#include <string.h>

#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/shading.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/shade/backlight.h"
#include "frame/shade/receivers.h"
#include "frame/shade/texture_slots.h"

static void negate(float *lanes, int count)
{
    for (int i = 0; i < count; i++)
        lanes[i] = -lanes[i];
}

/* Turns the surfaces of a batch round, or back: their normals, and with exact shadows those of their corners. */
static void turn(e3d_shade_memory *memory, int is_exact)
{
    int count = e3d_padded_count(&memory->batch);
    for (int c = 0; c < 3; c++) {
        negate(memory->batch.normal[c], count);
        negate(memory->textures.batch.shading_normal[c], count);
        for (int k = 0; k < 3 && is_exact && memory->receivers.is_smooth; k++)
            negate(memory->receivers.corner_normal[c][k], memory->surfaces.count);
    }
}

/* Moves samples to where light enters their bodies. The surfaces are turned round, so that their normals lead there. */
static void enter(e3d_shade_memory *memory)
{
    e3d_batch *batch = &memory->batch;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < e3d_padded_count(batch); i++)
            batch->position[c][i] = batch->position[c][i] + memory->textures.batch.shading_normal[c][i] * memory->textures.batch.body[i];
}

void e3d_find_backlight(const e3d_steps *s)
{
    const e3d_prepared *pass = s->pass;
    e3d_shade_memory *memory = s->out->memory;
    e3d_batch *batch = &memory->batch;
    int is_exact = e3d_receives_exact_shadows(pass, s->bucket), is_body = e3d_is_translucent_body(s->bucket);
    e3d_lighting lighting = *e3d_lighting_of(pass->view, s->bucket->unshadowed);
    e3d_lane_array position[3];
    lighting.has_visibility = 0;
    lighting.clamp[0] = 0.0f;
    lighting.clamp[1] = INFINITY;
    turn(memory, is_exact);
    if (is_body) {
        e3d_find_bodies(pass, s->bucket, memory);
        memcpy(position, batch->position, sizeof position);
        enter(memory);
    }
    if (is_exact)
        e3d_hide_lights(s);
    if (e3d_plans(pass, E3D_PLAN_ADDS_AREA_LIGHTS))
        pass->kernels->area_light(batch, &lighting, 0.0f);
    pass->kernels->light(batch, &lighting, 0.0f);
    if (is_body)
        memcpy(batch->position, position, sizeof position);
    turn(memory, is_exact);
}
