/* Checks the shadows of a frame's lights before anything is drawn. */
#include "data/shadow_maps/shadows.h"

#include "base/limits.h"

int e3d_has_exact_shadows(const e3d_frame *frame)
{
    for (int32_t n = 0; n < frame->light_count; n++)
        if (frame->lights[n].shadow.kind == E3D_SHADOW_EXACT)
            return 1;
    return 0;
}

int e3d_has_shadows(const e3d_frame *frame)
{
    for (int32_t n = 0; n < frame->light_count; n++)
        if (frame->lights[n].shadow.kind != E3D_SHADOW_NONE)
            return 1;
    return 0;
}

/* Whether the maps have the number and layout for such a light. */
static int has_maps(const e3d_light *light)
{
    int32_t count = light->shadow.maps.count;
    switch (e3d_light_traits_of(light->kind).maps) {
    case E3D_MAPS_CASCADES: return count >= 1;
    case E3D_MAPS_CUBE: return count == 6;
    case E3D_MAPS_AHEAD: break;
    }
    return count == 1;
}

static int map_is_valid(const e3d_frame *frame, const e3d_light *light)
{
    const e3d_light_maps *s = &light->shadow.maps;
    if (!s->depths || !has_maps(light) || s->first < 0 || s->count > frame->shadow_map_count - s->first || !frame->shadow_maps)
        return 0;
    if ((s->taps != 1 && s->taps != 3 && s->taps != 5) || s->size < 1 || s->size > E3D_MAX_SIZE || s->step < 0)
        return 0;
    if (s->soft > 0.0f && !(s->widest >= 1.0f && s->widest <= E3D_SOFT_WIDEST))
        return 0;
    /* Numbers of texels fit 32 bits, and all comparisons fit between the sides. */
    return (int64_t)s->count * s->size * s->size <= INT32_MAX && (int64_t)s->step * (s->taps - 1) <= 256 * (int64_t)s->size - 512;
}

/* Exact lights must be numbered one after the other. */
static int exact_lights_are_valid(const e3d_frame *frame)
{
    int32_t count = 0;
    for (int32_t n = 0; n < frame->light_count; n++)
        if (frame->lights[n].shadow.kind == E3D_SHADOW_EXACT && frame->lights[n].shadow.exact != count++)
            return 0;
    return count <= E3D_MAX_EXACT_LIGHTS;
}

int e3d_shadows_are_valid(const e3d_frame *frame)
{
    if (!exact_lights_are_valid(frame))
        return 0;
    for (int32_t n = 0; n < frame->light_count; n++)
        if (frame->lights[n].shadow.kind == E3D_SHADOW_MAP && !map_is_valid(frame, &frame->lights[n]))
            return 0;
    return 1;
}
