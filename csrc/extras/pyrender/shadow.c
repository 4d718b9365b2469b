/* Shadows: the share of a light that its map lets through, blended over 4x4 texels of 24 bits; the map repeats (R150). Maps
 * of frames hold f32, and end at their sides (R93). */
#include <math.h>

#include "extras/pyrender/picture.h"

#define DEPTHS 16777215.0 /* the number of steps in a map of 24 bits */

/* Finds the weights of four texels, from one before to one behind: the mean of three blends of two texels each. */
static void set_shares(float fraction, float out[4])
{
    out[0] = 1 - fraction;
    out[1] = out[2] = 1;
    out[3] = fraction;
}

/* Whether something in the map is nearer than a depth; maps repeat beyond their sides. */
static float hides(const e3d_pyr_light *light, int64_t column, int64_t row, float depth)
{
    int64_t size = light->shadow_size;
    int64_t x = ((column % size) + size) % size, y = ((row % size) + size) % size;
    double z = light->shadow_map[(size - 1 - y) * size + x] * 0.5 + 0.5;
    return depth > (float)(floor((z < 1 ? z : 1) * DEPTHS) / DEPTHS) ? 1 : 0;
}

static float shadow_at(const e3d_pyr_light *light, float u, float v, float depth)
{
    float size = (float)light->shadow_size, x = u * size + 0.5f, y = v * size + 0.5f;
    if (!(fabsf(x) < 0x1p40f && fabsf(y) < 0x1p40f))
        return 0;
    int64_t column = (int64_t)floorf(x), row = (int64_t)floorf(y);
    float across[4], down[4], sum = 0;
    set_shares(x - floorf(x), across);
    set_shares(y - floorf(y), down);
    for (int r = 0; r < 4; r++)
        for (int c = 0; c < 4; c++)
            sum += (across[c] * down[r]) * hides(light, column + c - 1, row + r - 1, depth);
    return sum * (1.0f / 9);
}

/* The cosine between a fragment's normal and the light, not less than 0. */
static float cosine_to(const e3d_pyr_light *light, const pyr_batch *batch, int i)
{
    float nl = 0, nn = 0, ll = 0;
    for (int c = 0; c < 3; c++) {
        float l = light->kind == E3D_PYR_DIRECTIONAL ? 0 - light->direction[c] : light->position[c] - batch->world[c][i];
        float n = batch->normal[c][i];
        nl += n * l;
        nn += n * n;
        ll += l * l;
    }
    float cosine = nl / sqrtf(nn * ll);
    return cosine > 0 ? cosine < 1 ? cosine : 1 : 0;
}

void pyr_find_unshadowed(const e3d_pyr_light *light, pyr_batch *batch)
{
    for (int i = 0; i < batch->count; i++) {
        const double *m = light->shadow_from_world;
        double x = batch->world[0][i], y = batch->world[1][i], z = batch->world[2][i], clip[4];
        for (int r = 0; r < 4; r++)
            clip[r] = ((m[4 * r] * x + m[4 * r + 1] * y) + m[4 * r + 2] * z) + m[4 * r + 3];
        float bias = 0.001f * (1 - cosine_to(light, batch, i));
        bias = (bias > 0.0001f ? bias : 0.0001f) / (float)clip[3];
        double depth = clip[2] / clip[3] * 0.5 + 0.5;
        float u = (float)(clip[0] / clip[3] * 0.5 + 0.5), v = (float)(clip[1] / clip[3] * 0.5 + 0.5);
        batch->unshadowed[i] = depth > 1 ? 1 : 1 - shadow_at(light, u, v, (float)depth - bias);
    }
}
