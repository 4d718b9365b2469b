/* shade: finds which lights with exact shadows are hidden from samples (R100-R102, R194). */
#include <stdint.h>

#include "kernels/kernels.h"
#include "kernels/types/shading.h"
#include "frame/pass/draws.h"
#include "frame/pass/plan.h"
#include "frame/pass/view.h"
#include "frame/shade/receivers.h"

int e3d_receives_exact_shadows(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    return e3d_plans(pass, E3D_PLAN_FINDS_EXACT_SHADOWS) && bucket->lit && !bucket->unshadowed;
}

int e3d_has_smooth_normals(const e3d_bucket *bucket) { return bucket->face && !bucket->flat; }

void e3d_find_receivers(const e3d_steps *s, e3d_shade_memory *memory)
{
    const e3d_visible_primitive *primitives = memory->primitives.data;
    e3d_receivers *out = &memory->receivers;
    out->is_smooth = s->wanted & E3D_WANT_WEIGHTS && e3d_has_smooth_normals(s->bucket);
    for (int32_t n = 0; n < memory->surfaces.count && out->is_smooth; n++)
        out->mesh[n] = primitives[memory->surfaces.primitive[n]].draw->mesh;
    s->pass->kernels->receivers(&memory->surfaces, out);
}

void e3d_hide_lights(const e3d_steps *s)
{
    const e3d_prepared *pass = s->pass;
    e3d_shade_memory *memory = s->out->memory;
    pass->kernels->exact_shadows(&memory->batch, &pass->view->lighting, pass->casters, &memory->receivers);
    if (pass->casters->soft_lights)
        pass->kernels->soft_exact_shadows(&memory->batch, &pass->view->lighting, pass->casters, &memory->receivers);
}
