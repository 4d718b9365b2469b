/* Environment: light from a direction, and the share of light from all directions that rough surfaces reflect.
 * In: an environment as a frame uses it, directions in world space. Out: red, green and blue.
 * Rules: R60 (faces), R61 (texels), R62 (levels), R63 (background), R64 (albedos). */
#include <math.h>

#include "reference/arithmetic.h"
#include "reference/surface.h"

enum { CHANNELS = 3,
       LAST = E3D_ENVIRONMENT_LEVELS - 1 };

/* A place on the cube: its face, and coordinates in [-1, 1]. */
typedef struct cube_place {
    int face;
    float p, q;
} cube_place;

static float opposite(float v) { return 0.0f - v; }

/* R60 for a direction in the environment's space. */
static cube_place find_place(float x, float y, float z)
{
    float a = fabsf(x), b = fabsf(y), m = fabsf(z);
    cube_place place;
    if (a >= b && a >= m) {
        place = (cube_place){x < 0.0f, x < 0.0f ? z : opposite(z), opposite(y)};
        m = a;
    } else if (b >= m) {
        place = (cube_place){2 + (y < 0.0f), x, y < 0.0f ? opposite(z) : z};
        m = b;
    } else {
        place = (cube_place){4 + (z < 0.0f), z < 0.0f ? opposite(x) : x, opposite(y)};
    }
    float i = 1.0f / ref_max(m, 0x1p-100f);
    place.p = place.p * i;
    place.q = place.q * i;
    return place;
}

static float mix(float a, float b, float weight) { return a + (b - a) * weight; }

/* R61 */
static void sample_level(const e3d_environment_level *level, const cube_place *place, float out[CHANNELS])
{
    float size = (float)level->size, half = size / 2.0f;
    float u = ref_clamp(place->p * half + (half + 0.5f), 0.5f, size + 0.5f);
    float v = ref_clamp(place->q * half + (half + 0.5f), 0.5f, size + 0.5f);
    size_t column = (size_t)u, row = (size_t)v, pitch = (size_t)level->size + 2;
    float f = u - (float)column, g = v - (float)row;
    const float *upper = level->texels + 4 * (((size_t)place->face * pitch + row) * pitch + column);
    const float *lower = upper + 4 * pitch;
    for (int c = 0; c < CHANNELS; c++)
        out[c] = mix(mix(upper[c], upper[4 + c], f), mix(lower[c], lower[4 + c], f), g);
}

static cube_place turned_place(const e3d_environment_light *light, const float d[3])
{
    return find_place(light->cosine * d[0] - light->sine * d[2], d[1], light->sine * d[0] + light->cosine * d[2]);
}

/* R62 */
void ref_environment(const e3d_environment_light *light, const float direction[3], float level, float out[CHANNELS])
{
    const e3d_environment_view *view = e3d_environment_get_view(light->environment);
    cube_place place = turned_place(light, direction);
    float l = ref_clamp(level, 0.0f, (float)LAST), coarser[CHANNELS];
    int fine = (int)l < LAST - 1 ? (int)l : LAST - 1;
    sample_level(&view->levels[fine], &place, out);
    sample_level(&view->levels[fine + 1], &place, coarser);
    for (int c = 0; c < CHANNELS; c++)
        out[c] = mix(out[c], coarser[c], l - (float)fine) * light->intensity;
}

/* R62 */
void ref_environment_specular(const e3d_environment_light *light, const float direction[3], float roughness, float out[CHANNELS])
{
    ref_environment(light, direction, roughness * (float)LAST, out);
}

/* R62 */
void ref_environment_irradiance(const e3d_environment_light *light, const float normal[3], float out[CHANNELS])
{
    cube_place place = turned_place(light, normal);
    sample_level(&e3d_environment_get_view(light->environment)->levels[LAST], &place, out);
    for (int c = 0; c < CHANNELS; c++)
        out[c] = out[c] * light->intensity;
}

/* R63 */
void ref_backdrop(const e3d_backdrop *backdrop, int32_t x, int32_t y, float out[CHANNELS])
{
    float direction[3];
    for (int c = 0; c < 3; c++)
        direction[c] = (backdrop->ray[c] + ((float)x + 0.5f) * backdrop->across[c]) + ((float)y + 0.5f) * backdrop->down[c];
    ref_environment(&backdrop->light, direction, backdrop->level, out);
}

/* R64: a node, and the weight of the next one. */
typedef struct node {
    size_t number;
    float weight;
} node;

static node find_node(float x)
{
    float at = x * (float)(E3D_DFG_SIZE - 1);
    size_t number = (size_t)at < E3D_DFG_SIZE - 2 ? (size_t)at : E3D_DFG_SIZE - 2;
    return (node){number, at - (float)number};
}

/* R64 */
float ref_albedo(e3d_dfg kind, float roughness, float cosine)
{
    node i = find_node(ref_clamp(roughness, 0.0f, 1.0f));
    node j = find_node(sqrtf(ref_clamp(cosine, 0.0f, 1.0f)));
    const float *upper = &E3D_DFG_TABLE[kind][i.number * E3D_DFG_SIZE + j.number], *lower = upper + E3D_DFG_SIZE;
    return mix(mix(upper[0], upper[1], j.weight), mix(lower[0], lower[1], j.weight), i.weight);
}
