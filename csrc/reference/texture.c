/* Texture: filters the texels at a place, with 8-bit fixed-point weights.
 * In: a texture's levels (linear RGBA, top row first), uv, and their change over the piece. Out: red, green, blue and alpha
 * of the texture there, and their unit.
 * Rules: R25 and R26 (level of detail), R29 (wrap), R30 (filters), R110 to R113 (bias, anisotropy). The levels themselves are
 * R28. */
#include <math.h>
#include <string.h>

#include "reference/arithmetic.h"
#include "reference/surface.h"

enum { CHANNELS = 4 };

static float sum_of(const float v[3]) { return (v[0] + v[1]) + v[2]; }

/* R25: the texels that one coordinate passes from a sample to the next, along the row and down the column, before the
 * division. */
static void find_slopes(const ref_surface *s, const float corners[3], float size, float *along, float *down)
{
    const ref_piece *piece = s->piece;
    float a0 = ref_dot3(piece->bary0, corners), s0 = sum_of(piece->bary0);
    float ax = ref_dot3(piece->bary_dx, corners), sx = sum_of(piece->bary_dx);
    float ay = ref_dot3(piece->bary_dy, corners), sy = sum_of(piece->bary_dy);
    float turn = (ax * sy - ay * sx) * size;
    *along = (ax * s0 - a0 * sx) * size + s->dy * turn;
    *down = (ay * s0 - a0 * sy) * size - s->dx * turn;
}

/* R110: the texture's size as R25 counts it. */
static float counted_size(const e3d_texture_view *texture, int32_t side) { return (float)side * texture->level_scale; }

/* R25 and R110 */
static void find_changes(const e3d_texture_view *texture, const ref_surface *s, const ref_coordinates *at, float along[2], float down[2])
{
    find_slopes(s, at->corner[0], counted_size(texture, texture->levels[0].width), &along[0], &down[0]);
    find_slopes(s, at->corner[1], counted_size(texture, texture->levels[0].height), &along[1], &down[1]);
}

/* R26: the level in 1/256, from a squared length in texels that is at least 1. */
static int32_t level_of_length(float squared)
{
    int32_t bits;
    memcpy(&bits, &squared, sizeof bits);
    return (bits - 0x3F800000) / 65536;
}

/* R26: before it is limited to the levels that there are. */
static int32_t level_of_detail(const e3d_texture_view *texture, const ref_surface *s, const ref_coordinates *at)
{
    float along[2], down[2];
    find_changes(texture, s, at, along, down);
    float longest = ref_max(along[0] * along[0] + along[1] * along[1], down[0] * down[0] + down[1] * down[1]);
    return level_of_length(ref_max((longest * (s->r * s->r)) * (s->r * s->r), 1.0f));
}

static int32_t limited(const e3d_texture_view *texture, int32_t lod)
{
    int32_t coarsest = (texture->level_count - 1) * 256;
    return lod < coarsest ? lod : coarsest;
}

/* R190 */
int32_t ref_texture_alpha_lod(const e3d_texture_view *texture, const ref_surface *surface, const ref_coordinates *at)
{
    return texture->filter == E3D_TRILINEAR && !texture->is_opaque ? level_of_detail(texture, surface, at) : 0;
}

/* The probes of an anisotropic filter: how many, how far apart in u and v, and at which level. */
typedef struct probes {
    float count, step[2];
    int32_t lod;
} probes;

/* R111: the axes of the footprint; the minor one is at least a texel. */
typedef struct ellipse {
    float longest2, longest, shortest; /* longest2: the square of longest */
    float direction[2];                /* of the major axis, in texels */
} ellipse;

/* R111 */
static ellipse find_ellipse(const float along[2], const float down[2])
{
    ellipse out;
    float a = along[0] * along[0] + down[0] * down[0], c = along[1] * along[1] + down[1] * down[1];
    float b = along[0] * along[1] + down[0] * down[1], d = a - c;
    float root = sqrtf(d * d + (b * b) * 4.0f), axis = fabsf(d) + root;
    out.longest2 = ref_max(((a + c) + root) * 0.5f, 1.0f);
    out.longest = sqrtf(out.longest2);
    out.shortest = ref_max(fabsf(along[0] * down[1] - along[1] * down[0]) / out.longest, 1.0f);
    float x = d >= 0.0f ? axis : b + b, y = d >= 0.0f ? b + b : axis;
    float inverse = 1.0f / ref_max(sqrtf(x * x + y * y), E3D_LEAST_AXIS);
    out.direction[0] = x * inverse;
    out.direction[1] = y * inverse;
    return out;
}

/* R112 */
static probes find_probes(const e3d_texture_view *texture, const ref_surface *s, const ref_coordinates *at)
{
    float along[2], down[2], r2 = s->r * s->r;
    find_changes(texture, s, at, along, down);
    for (int c = 0; c < 2; c++) {
        along[c] = ref_clamp(along[c] * r2, -E3D_MOST_TEXELS, E3D_MOST_TEXELS);
        down[c] = ref_clamp(down[c] * r2, -E3D_MOST_TEXELS, E3D_MOST_TEXELS);
    }
    ellipse e = find_ellipse(along, down);
    probes out = {.count = (float)ref_rint(ref_min(e.longest / e.shortest, (float)texture->anisotropy))};
    float share = 1.0f / out.count, reach = e.longest * share;
    const int32_t size[2] = {texture->levels[0].width, texture->levels[0].height};
    for (int c = 0; c < 2; c++)
        out.step[c] = (e.direction[c] * reach) * (1.0f / counted_size(texture, size[c]));
    out.lod = limited(texture, level_of_length(ref_max(e.longest2 * (share * share), e.shortest * e.shortest)));
    return out;
}

/* R29: into [0, 1]. */
static float wrap_coordinate(float s, e3d_wrap wrap)
{
    if (wrap == E3D_REPEAT)
        return ref_max(s - floorf(s), 0.0f);
    s = ref_clamp(s, -0x1p22f, 0x1p22f);
    if (wrap == E3D_CLAMP)
        return ref_clamp(s, 0.0f, 1.0f);
    float half = s * 0.5f;
    float m = (half - ref_floor(half)) * 2.0f;
    return m > 1.0f ? 2.0f - m : m;
}

/* A channel of a texel: 15 bits, or 8, which are stored signed. Levels have a border, which isn't used here. */
static int32_t texel(const e3d_texture_view *texture, const e3d_level *level, int32_t column, int32_t row, int c)
{
    size_t at = 4 * ((size_t)(row + 1) * ((size_t)level->width + 2) + (size_t)(column + 1)) + (size_t)c;
    if (texture->channel_bits == 8)
        return ((const int8_t *)level->texels)[at] + 128;
    return ((const int16_t *)level->texels)[at];
}

/* R30 */
static void sample_nearest(const e3d_texture_view *texture, const e3d_level *level, float s, float t, float out[CHANNELS])
{
    int32_t column = (int32_t)(s * (float)level->width), row = (int32_t)(t * (float)level->height);
    column = column < level->width ? column : level->width - 1;
    row = row < level->height ? row : level->height - 1;
    for (int c = 0; c < CHANNELS; c++)
        out[c] = (float)texel(texture, level, column, row, c);
}

/* The two neighbours along one axis, and the weight of the second one. */
typedef struct neighbours {
    int32_t first, second, weight;
} neighbours;

/* R30 */
static neighbours find_neighbours(float s, int32_t size, e3d_wrap wrap)
{
    int32_t p = ref_rint(s * (float)(256 * size)) - 128;
    int32_t first = ref_floor_256(p), second = first + 1;
    int32_t weight = p - 256 * first;
    if (wrap == E3D_REPEAT) {
        first = first < 0 ? first + size : first;
        second = second >= size ? second - size : second;
    } else {
        first = first < 0 ? 0 : first;
        second = second >= size ? size - 1 : second;
    }
    return (neighbours){first, second, weight};
}

/* Blends t[row][column] of 8 bits: exact, with weights of 255. */
static int32_t blend8(const int32_t t[2][2], int32_t fx, int32_t fy)
{
    int32_t upper = t[0][0] * (255 - fx) + t[0][1] * fx, lower = t[1][0] * (255 - fx) + t[1][1] * fx;
    return upper * (255 - fy) + lower * fy;
}

/* Blends 15 bits: each column to 15 bits, then the two results. */
static int32_t blend15(const int32_t t[2][2], int32_t fx, int32_t fy)
{
    int32_t column[2];
    for (int k = 0; k < 2; k++)
        column[k] = t[0][k] + ref_floor_256((t[1][k] - t[0][k]) * fy + 128);
    return column[0] * (256 - fx) + column[1] * fx;
}

static void sample_bilinear(const e3d_texture_view *texture, const e3d_level *level, float s, float t,
                            float out[CHANNELS])
{
    neighbours x = find_neighbours(s, level->width, texture->wrap[0]);
    neighbours y = find_neighbours(t, level->height, texture->wrap[1]);
    for (int c = 0; c < CHANNELS; c++) {
        const int32_t t[2][2] = {
            {texel(texture, level, x.first, y.first, c), texel(texture, level, x.second, y.first, c)},
            {texel(texture, level, x.first, y.second, c), texel(texture, level, x.second, y.second, c)}};
        out[c] = (float)(texture->channel_bits == 8 ? blend8(t, x.weight, y.weight) : blend15(t, x.weight, y.weight));
    }
}

/* R30 */
static void sample_trilinear(const e3d_texture_view *texture, int32_t lod, float s, float t, float out[CHANNELS])
{
    int32_t fine = lod / 256, coarse = fine + 1 < texture->level_count ? fine + 1 : fine;
    float f = (float)(lod % 256) * 0x1p-8f, coarser[CHANNELS];
    sample_bilinear(texture, &texture->levels[fine], s, t, out);
    sample_bilinear(texture, &texture->levels[coarse], s, t, coarser);
    for (int c = 0; c < CHANNELS; c++)
        out[c] = out[c] + (coarser[c] - out[c]) * f;
}

/* R113 */
static void sample_probes(const e3d_texture_view *texture, const probes *probes, const float uv[2], float out[CHANNELS])
{
    float middle = (probes->count - 1.0f) * 0.5f, texel[CHANNELS];
    for (float k = 0.0f; k < probes->count; k++) {
        float u = uv[0] + (k - middle) * probes->step[0], v = uv[1] + (k - middle) * probes->step[1];
        float s = wrap_coordinate(u, texture->wrap[0]), t = wrap_coordinate(1.0f - v, texture->wrap[1]);
        sample_trilinear(texture, probes->lod, s, t, texel);
        for (int c = 0; c < CHANNELS; c++)
            out[c] = k > 0.0f ? out[c] + texel[c] : texel[c];
    }
    for (int c = 0; c < CHANNELS; c++)
        out[c] = out[c] / probes->count;
}

/* R30 */
static float unit_of(const e3d_texture_view *texture)
{
    int nearest = texture->filter == E3D_NEAREST;
    if (texture->channel_bits == 16)
        return nearest ? E3D_UNORM15 : E3D_UNORM15_BLENDED;
    return nearest ? E3D_UNORM8 : E3D_UNORM8_BLENDED;
}

float ref_texture_alpha(const e3d_texture_view *texture, const float uv[2], float *out)
{
    float s = wrap_coordinate(uv[0], texture->wrap[0]), t = wrap_coordinate(1.0f - uv[1], texture->wrap[1]), texel_at[CHANNELS];
    if (texture->filter == E3D_NEAREST)
        sample_nearest(texture, &texture->levels[0], s, t, texel_at);
    else
        sample_bilinear(texture, &texture->levels[0], s, t, texel_at);
    *out = texel_at[3];
    return unit_of(texture);
}

float ref_texture_sample(const e3d_texture_view *texture, const ref_surface *surface, const ref_coordinates *at,
                         float out[CHANNELS])
{
    if (texture->anisotropy > 1 && !surface->is_finest) {
        probes probes = find_probes(texture, surface, at);
        sample_probes(texture, &probes, at->uv, out);
        return E3D_UNORM15_BLENDED;
    }
    float s = wrap_coordinate(at->uv[0], texture->wrap[0]);
    float t = wrap_coordinate(1.0f - at->uv[1], texture->wrap[1]);
    if (texture->filter == E3D_NEAREST)
        sample_nearest(texture, &texture->levels[0], s, t, out);
    else if (texture->filter == E3D_BILINEAR)
        sample_bilinear(texture, &texture->levels[0], s, t, out);
    else
        sample_trilinear(texture, surface->is_finest ? 0 : limited(texture, level_of_detail(texture, surface, at)), s, t, out);
    return unit_of(texture);
}
