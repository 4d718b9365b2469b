/* Shadow: the share of a light that reaches a surface, by the shadow maps that were drawn from the light.
 * In: a surface, one of the frame's lights, the depths of its maps. Out: the share, from 0 to 1.
 * Rules: R90 (where it counts), R91 (the sample moves towards the light), R92 (its place in the maps), R93 (comparisons),
 * R225 (the size of soft lights).
 * Sources: Williams 1978; Reeves, Salesin and Cook 1987. */
#include "reference/arithmetic.h"
#include "reference/shadows/soft_shadow.h"
#include "reference/surface.h"

/* The place of a sample in the maps of its light; map: -1 if it is in none. `ahead` is its distance from the light along the
 * map's axis, 1 if the light has no position; `spread` is the map's. */
typedef struct place {
    float x, y, depth, ahead, spread;
    int32_t map;
} place;

/* R91 */
static float shift_of(const e3d_light_maps *shadow, float texel, float sine)
{
    float reach = ((float)(shadow->step * (shadow->taps - 1)) * (1.0f / 512.0f) + 1.0f) * E3D_SHADOW_CORNER;
    return shadow->normal_bias + (reach * texel) * (sine + E3D_SHADOW_SLACK);
}

/* R91 */
static float sine_of(float c) { return sqrtf(ref_max(1.0f - c * c, 0.0f)); }

/* x before y before z */
static int greatest_of(const float v[3])
{
    float a = fabsf(v[0]), b = fabsf(v[1]), c = fabsf(v[2]);
    if (a >= b && a >= c)
        return 0;
    return b >= c ? 1 : 2;
}

static int is_inside(const e3d_light_maps *shadow, float x, float y)
{
    float low = shadow->margin, high = (float)shadow->size - shadow->margin;
    return x >= low && high >= x && y >= low && high >= y;
}

static void turn(const e3d_light_maps *shadow, const float v[3], float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = ref_dot3(v, shadow->axes[k]);
}

/* ---- R92 ---- */

/* R92 */
static place place_cascades(const e3d_light_maps *shadow, const e3d_shadow_map *maps, const float p[3], const float normal[3], float sine)
{
    float at[3], along[3];
    turn(shadow, p, at);
    turn(shadow, normal, along);
    for (int32_t k = 0; k < shadow->count; k++) {
        const e3d_shadow_map *map = &maps[k];
        float x = at[0] * map->scale + map->x, y = at[1] * map->scale + map->y;
        if (!is_inside(shadow, x, y))
            continue;
        float shift = shift_of(shadow, map->texel, sine);
        x = x + (along[0] * shift) * map->scale;
        y = y + (along[1] * shift) * map->scale;
        float ahead = at[2] + along[2] * shift;
        return (place){x, y, (ahead * shadow->depth[0] + shadow->depth[1]) + shadow->bias, 1.0f, map->spread, k};
    }
    return (place){.map = -1};
}

static place project(const e3d_light_maps *shadow, const e3d_shadow_map *map, const float at[3], int32_t number)
{
    float near = 1.0f / ref_max(at[2], 0x1p-100f);
    float x = (at[0] * near) * map->scale + map->x, y = (at[1] * near) * map->scale + map->y;
    if (!(at[2] > 0.0f) || !is_inside(shadow, x, y))
        return (place){.map = -1};
    return (place){x, y, (shadow->depth[0] + shadow->depth[1] * near) + shadow->bias, at[2], map->spread, number};
}

/* R92 */
static place place_ahead(const e3d_light_maps *shadow, const e3d_shadow_map *map, const float p[3], const float normal[3], float sine)
{
    float at[3], along[3];
    turn(shadow, p, at);
    turn(shadow, normal, along);
    float shift = shift_of(shadow, at[2] * map->texel, ref_max(sine, sine_of(along[2])));
    for (int k = 0; k < 3; k++)
        at[k] = at[k] + along[k] * shift;
    return project(shadow, map, at, 0);
}

/* The directions to the right of each face of the cube and down it, as axes and their signs: +x, -x, +y, -y, +z, -z. */
static const int FACE_AXES[6][2] = {{2, 1}, {2, 1}, {0, 2}, {0, 2}, {0, 1}, {0, 1}};
static const int FACE_SIGNS[6][2] = {{1, -1}, {-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, -1}};

/* R92 */
static place place_cube(const e3d_light_maps *shadow, const e3d_shadow_map *map, const float p[3], const float normal[3], float sine)
{
    float most = ref_max(ref_max(fabsf(p[0]), fabsf(p[1])), fabsf(p[2])), moved[3], at[3];
    float shift = shift_of(shadow, most * map->texel, ref_max(sine, sine_of(normal[greatest_of(p)])));
    for (int k = 0; k < 3; k++)
        moved[k] = p[k] + normal[k] * shift;
    int axis = greatest_of(moved);
    int face = 2 * axis + (moved[axis] < 0.0f);
    for (int k = 0; k < 2; k++) {
        float v = moved[FACE_AXES[face][k]];
        at[k] = FACE_SIGNS[face][k] < 0 ? 0.0f - v : v;
    }
    at[2] = fabsf(moved[axis]);
    return project(shadow, map, at, face);
}

static place place_of(const e3d_light *light, const e3d_shadow_map *maps, const float p[3], const float normal[3], float sine)
{
    switch (e3d_light_traits_of(light->kind).maps) {
    case E3D_MAPS_CASCADES: return place_cascades(&light->shadow.maps, maps, p, normal, sine);
    case E3D_MAPS_CUBE: return place_cube(&light->shadow.maps, maps, p, normal, sine);
    case E3D_MAPS_AHEAD: break;
    }
    return place_ahead(&light->shadow.maps, maps, p, normal, sine);
}

/* ---- R93 ---- */

static int32_t within(int32_t a, int32_t most)
{
    if (a < 0)
        return 0;
    return a > most ? most : a;
}

/* Four comparisons around a place in 1/256 texel, which share a weight of 65536. */
static int32_t tap(const e3d_light_maps *shadow, const float *map, int32_t x, int32_t y, float depth)
{
    int32_t sum = 0, fx = x & 255, fy = y & 255;
    for (int32_t down = 0; down < 2; down++)
        for (int32_t right = 0; right < 2; right++) {
            float shown = map[(size_t)((y >> 8) + down) * (size_t)shadow->size + (size_t)((x >> 8) + right)];
            int32_t weight = (right ? fx : 256 - fx) * (down ? fy : 256 - fy);
            sum += shown >= depth ? weight : 0;
        }
    return sum;
}

/* R225, R229 */
static ref_soft_place soft_place_of(const e3d_light_maps *shadow, const place *at, float c)
{
    float size = ref_min(shadow->soft, (0.5f * c) * at->ahead);
    return (ref_soft_place){at->x, at->y, at->depth, ref_max(size * at->spread, 0.0f),
                            ref_max(((0.75f * c) * at->ahead) * at->spread, 0.0f)};
}

/* R93 */
static float compare(const e3d_light_maps *shadow, const place *at)
{
    int32_t across = shadow->step * (shadow->taps - 1), most = 256 * shadow->size - 257 - across, sum = 0;
    float size = (float)shadow->size;
    int32_t x = within(ref_rint(ref_clamp(at->x, 0.0f, size) * 256.0f) - (128 + across / 2), most);
    int32_t y = within(ref_rint(ref_clamp(at->y, 0.0f, size) * 256.0f) - (128 + across / 2), most);
    const float *map = shadow->depths + (size_t)at->map * (size_t)shadow->size * (size_t)shadow->size;
    for (int32_t j = 0; j < shadow->taps; j++)
        for (int32_t i = 0; i < shadow->taps; i++)
            sum += tap(shadow, map, x + i * shadow->step, y + j * shadow->step, at->depth);
    return (float)sum / (float)(65536 * shadow->taps * shadow->taps);
}

/* R90 */
float ref_light_reached(const e3d_frame *frame, int32_t n, const ref_surface *surface, const float l[3])
{
    const e3d_light *light = &frame->lights[n];
    const float *normal = surface->shading_normal;
    float p[3], sine = sine_of(ref_dot3(normal, l));
    if (surface->instance->draw->unshadowed)
        return 1.0f;
    if (light->shadow.kind == E3D_SHADOW_EXACT)
        return ref_exact_share(light, surface, l);
    for (int k = 0; k < 3; k++)
        p[k] = e3d_light_traits_of(light->kind).has_position ? surface->lit_position[k] - light->position[k] : surface->lit_position[k];
    const e3d_light_maps *shadow = &light->shadow.maps;
    place at = place_of(light, frame->shadow_maps + shadow->first, p, normal, sine);
    if (at.map < 0 || !(shadow->soft > 0.0f))
        return at.map < 0 ? 1.0f : compare(shadow, &at);
    const float *map = shadow->depths + (size_t)at.map * (size_t)shadow->size * (size_t)shadow->size;
    ref_soft_place soft = soft_place_of(shadow, &at, ref_dot3(normal, l));
    return ref_soft_share(shadow, map, &soft);
}
