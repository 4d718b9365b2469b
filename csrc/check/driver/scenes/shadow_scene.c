/* Random shadows, exact ones of what is drawn, and maps: patches of depths near and far, none and no numbers, seen from anywhere and at any scale. */
#include "check/driver/scenes/shadow_scene.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_SIDE = 40,
       CUBE = 6,
       MOST_CASTERS = 300 };

static const float ODD[] = {0.0f, -0.0f, 1e-30f, 1e20f, -3e38f, INFINITY, -INFINITY, NAN};

/* Mostly within limits. */
static float number(random_stream *r, float low, float high)
{
    return random_once_in(r, 24) ? ODD[random_below(r, sizeof ODD / sizeof *ODD)] : random_float(r, low, high);
}

static void *kept_array(scene *s, size_t count, size_t size)
{
    void *array = calloc(count, size);
    if (!array || s->array_count == SCENE_MAX_ARRAYS)
        abort();
    s->arrays[s->array_count++] = array;
    return array;
}

/* Patches of a depth each, as far as possible side by side. */
static void fill_depths(float *depths, int32_t count, random_stream *r)
{
    for (int32_t i = 0; i < count;) {
        int32_t end = i + 1 + random_below(r, 30);
        float depth = random_once_in(r, 5) ? INFINITY : number(r, -1.2f, 1.2f);
        for (; i < end && i < count; i++)
            depths[i] = depth;
    }
}

/* The ranges of a light's maps, as of maps that are kept. */
static const uint32_t *ranges_of(scene *s, const e3d_light_maps *shadow)
{
    size_t side = (size_t)e3d_shadow_ranges_side(shadow->size), texels = (size_t)shadow->size * (size_t)shadow->size;
    uint32_t *ranges = kept_array(s, (size_t)shadow->count * side * side, sizeof *ranges);
    for (size_t k = 0; k < (size_t)shadow->count; k++)
        if (e3d_find_shadow_ranges(shadow->depths + k * texels, shadow->size, shadow->taps, shadow->step, ranges + k * side * side) != E3D_OK)
            abort();
    return ranges;
}

/* Sometimes all samples are compared at one depth, which is that of a patch: neither is the greater. */
static void level_depths(e3d_light_maps *shadow, random_stream *r)
{
    shadow->depth[0] = shadow->depth[1] = 0.0f;
    shadow->bias = shadow->depths[random_below(r, shadow->size * shadow->size)];
}

/* The same of a soft light. */
static const uint32_t *soft_ranges_of(scene *s, const e3d_light_maps *shadow)
{
    size_t side = (size_t)e3d_shadow_ranges_side(shadow->size), texels = (size_t)shadow->size * (size_t)shadow->size;
    uint32_t *ranges = kept_array(s, 2 * (size_t)shadow->count * side * side, sizeof *ranges);
    for (size_t k = 0; k < (size_t)shadow->count; k++)
        if (e3d_find_soft_ranges(shadow->depths + k * texels, shadow->size, shadow->taps, shadow->step, shadow->widest,
                                 ranges + 2 * k * side * side) != E3D_OK)
            abort();
    return ranges;
}

/* Makes a light soft, from hardly at all to so wide that all lookups are as wide as may be. */
static void soften(scene *s, e3d_light_maps *shadow, random_stream *r)
{
    int32_t exponent = random_below(r, 16) - 10;
    shadow->soft = ldexpf(random_float(r, 0.5f, 1.0f), exponent);
    shadow->widest = random_once_in(r, 2) ? random_float(r, 1.0f, 12.0f) : random_float(r, 1.0f, 64.0f);
    shadow->nearest = number(r, -1.2f, 0.0f);
    shadow->ranges = shadow->ranges ? soft_ranges_of(s, shadow) : NULL;
}

static void add_map(scene *s, e3d_light *light, const float *depths, e3d_shadow_map *maps, int32_t *count, random_stream *r)
{
    e3d_light_maps *shadow = &light->shadow.maps;
    e3d_map_layout layout = e3d_light_traits_of(light->kind).maps;
    int32_t taps = 1 + 2 * random_below(r, 3);
    light->shadow.kind = E3D_SHADOW_MAP;
    shadow->first = *count;
    shadow->count = layout == E3D_MAPS_CUBE ? CUBE : 1;
    if (layout == E3D_MAPS_CASCADES)
        shadow->count += random_below(r, 3);
    shadow->size = 24 + random_below(r, MOST_SIDE - 24 + 1);
    shadow->taps = taps;
    shadow->step = random_once_in(r, 2) ? 256 : random_below(r, 1000);
    shadow->bias = number(r, -0.1f, 0.1f);
    shadow->normal_bias = number(r, -0.1f, 0.1f);
    shadow->margin = number(r, 0.0f, 6.0f);
    for (int k = 0; k < 9; k++)
        shadow->axes[k / 3][k % 3] = number(r, -1.0f, 1.0f);
    for (int k = 0; k < 2; k++)
        shadow->depth[k] = number(r, -0.5f, 0.5f);
    shadow->depths = depths;
    if (random_once_in(r, 4))
        level_depths(shadow, r);
    if (!random_once_in(r, 3))
        shadow->ranges = ranges_of(s, shadow);
    if (random_once_in(r, 2))
        soften(s, shadow, r);
    for (int32_t k = 0; k < shadow->count; k++) {
        float scale = number(r, 1.0f, 20.0f), middle = 0.5f * (float)shadow->size;
        maps[(*count)++] = (e3d_shadow_map){scale, middle + number(r, -3.0f, 3.0f), middle + number(r, -3.0f, 3.0f), 1.0f / scale,
                                            number(r, 1.0f, 60.0f)};
    }
}

/* As many of the scene's draws as the reference, which tries all of them at every sample, has time for. */
static const e3d_casters *casters_of(scene *s, random_stream *r)
{
    e3d_casters *casters = kept_array(s, 1, sizeof *casters);
    int64_t faces = 0;
    int32_t first = s->frame.draw_count ? random_below(r, s->frame.draw_count) : 0, end = first;
    for (; end < s->frame.draw_count; end++) {
        faces += (int64_t)e3d_mesh_view(s->draws[end].mesh)->faces_count * s->draws[end].instances;
        if (faces > MOST_CASTERS)
            break;
    }
    *casters = (e3d_casters){s->draws + first, end - first, s->materials, s->frame.material_count, 0};
    return casters;
}

/* Some are soft. */
static void add_exact(e3d_light *light, int32_t *count, random_stream *r)
{
    light->shadow.kind = E3D_SHADOW_EXACT;
    light->shadow.exact = (*count)++;
    light->shadow.soft = 0.0f;
    if (random_once_in(r, 2)) {
        int32_t exponent = random_below(r, 16) - 10;
        light->shadow.soft = ldexpf(number(r, 0.5f, 1.0f), exponent);
    }
}

void scene_add_shadows(scene *s, random_stream *r)
{
    float *depths = kept_array(s, CUBE * MOST_SIDE * MOST_SIDE, sizeof *depths);
    e3d_shadow_map *maps = kept_array(s, SCENE_MAX_LIGHTS * CUBE, sizeof *maps);
    int32_t count = 0, exact = 0;
    fill_depths(depths, CUBE * MOST_SIDE * MOST_SIDE, r);
    for (int32_t n = 0; n < s->frame.light_count; n++)
        if (random_once_in(r, 3))
            add_exact(&s->lights[n], &exact, r);
        else if (!random_once_in(r, 4))
            add_map(s, &s->lights[n], depths, maps, &count, r);
    s->frame.shadow_maps = maps;
    s->frame.shadow_map_count = count;
    s->frame.casters = casters_of(s, r);
    for (int32_t d = 0; d < s->frame.draw_count; d++)
        s->draws[d].unshadowed = random_once_in(r, 4);
    s->frame.mode = E3D_MODE_LIT;
}
