/* Refraction: how far surfaces that light passes through bend it and blur what is behind them, and what then shows behind the
 * fragments of a sample.
 * In: surfaces with the values of their textures; the frame's picture behind, with its levels. Out: shifts and blurs; the
 * colour, alpha and radiance that blending begins with.
 * Rules: R160 (which frames and surfaces), R163 (levels), R164 (shift), R165 (blur), R166 (sums, beginning), R167 (beyond the
 * picture), R273 (parts of pictures).
 * Sources: KHR_materials_transmission, _volume and _dispersion; Khronos's sample viewer for the projected end of the ray and for
 * the blur. */
#include <math.h>

#include "data/behind_levels.h"
#include "data/views/whole_picture.h"
#include "reference/surface.h"

/* The picture behind: its levels. */
typedef struct behind {
    e3d_behind_level level[E3D_BEHIND_LEVELS];
    int count;
    const float *texels;
} behind;

/* R160 */
int ref_frame_bends(const e3d_frame *frame)
{
    return frame->behind && frame->mode == E3D_MODE_LIT && frame->hidden == E3D_HIDDEN_ZBUFFER && frame->wireframe != E3D_WIRE_ONLY;
}

/* R160 */
static int bends(const e3d_frame *frame, const ref_piece *piece)
{
    if (!ref_transmits(frame, piece))
        return 0;
    const e3d_physical *p = &piece->primitive.material->physical;
    return p->ior != 1.0f && (p->thickness != 0.0f || p->roughness != 0.0f);
}

/* ---- one fragment ---- */

static float pixel_place(const e3d_frame *frame, int32_t sample) { return ((float)sample + 0.5f) * (1.0f / (float)frame->samples_axis); }

/* R164: the index of refraction of a channel. */
static float index_of(const e3d_physical *p, int channel)
{
    float half = ((p->ior - 1.0f) * 0.025f) * p->dispersion;
    const float indices[3] = {p->ior - half, p->ior, p->ior + half};
    return ref_max(indices[channel], 1.0f);
}

/* R164: the refracted ray down to the thickness. */
static void refract(const ref_surface *s, const float v[3], float index, float out[3])
{
    float c = ref_dot3(s->world_normal, v), a = fabsf(c), e = 1.0f / index;
    float k = ref_max(1.0f - (e * e) * (1.0f - a * a), 0.0f), g = e * a - sqrtf(k);
    g = c < 0.0f ? 0.0f - g : g;
    for (int r = 0; r < 3; r++)
        out[r] = (s->world_normal[r] * g - v[r] * e) * s->physical.depth;
}

static int32_t whole_shift(float shift) { return shift > -0x1p20f && shift < 0x1p20f ? ref_rint(shift) : 0; }

/* R164 */
static void find_shift(const e3d_frame *frame, const ref_surface *s, const float v[3], const ref_place *at, int channel, uint32_t out[2])
{
    float m[4][4], q[3], width = (float)frame->width, height = (float)frame->height;
    for (int k = 0; k < 16; k++)
        m[k / 4][k % 4] = (float)frame->clip_from_world[k];
    refract(s, v, index_of(&s->piece->primitive.material->physical, channel), q);
    float x = ref_dot3(m[0], q), y = ref_dot3(m[1], q), z = ref_dot3(m[3], q);
    float w = ref_dot3(m[3], s->world_position) + m[3][3], h = ref_max(w + z, w * 0.25f);
    float across = pixel_place(frame, at->x) * (2.0f / width) - 1.0f, down = 1.0f - pixel_place(frame, at->y) * (2.0f / height);
    out[0] = (uint32_t)whole_shift(((x - across * z) / h) * (128.0f * width));
    out[1] = (uint32_t)whole_shift(((down * z - y) / h) * (128.0f * height));
}

/* R165 */
static uint32_t find_blur(const e3d_frame *frame, const ref_surface *s)
{
    const e3d_physical *p = &s->piece->primitive.material->physical;
    const e3d_whole whole = e3d_whole_of(frame);
    float most = ref_log2((float)whole.width) * ref_clamp(p->ior * 2.0f - 2.0f, 0.0f, 1.0f);
    float level = ref_clamp(s->physical.roughness, 0.0f, 1.0f) * most;
    if (p->thickness != 0.0f && s->physical.scale == 0.0f)
        return 0;
    return (uint32_t)ref_rint(ref_min((ref_exp2(level + level) - 1.0f) * (whole.fineness * whole.fineness), 0x1p20f) * 256.0f);
}

/* ---- the fragments of a sample ---- */

static int is_nothing(const ref_bend *bend)
{
    uint32_t any = bend->blur;
    for (int k = 0; k < 6; k++)
        any |= bend->shift[k / 2][k % 2];
    return !any;
}

void ref_no_bend(ref_bend *out) { *out = (ref_bend){.depth = INFINITY}; }

/* R166 */
void ref_add_bend(const e3d_frame *frame, const ref_surface *surface, const ref_place *at, ref_bend *sum)
{
    ref_bend bend = {.depth = surface->metric_depth};
    float view[3];
    if (!bends(frame, surface->piece))
        return;
    ref_direction_to_eye(frame, surface, view);
    for (int c = 0; c < 3; c++)
        find_shift(frame, surface, view, at, c, bend.shift[c]);
    bend.blur = find_blur(frame, surface);
    if (is_nothing(&bend))
        return;
    for (int k = 0; k < 6; k++)
        sum->shift[k / 2][k % 2] += bend.shift[k / 2][k % 2];
    sum->blur += bend.blur;
    sum->depth = ref_min(bend.depth, sum->depth);
}

/* ---- the picture behind ---- */

static behind behind_of(const e3d_frame *frame)
{
    behind out = {.texels = frame->behind};
    out.count = e3d_behind_levels(frame->width, frame->height, out.level);
    return out;
}

static float texel(const behind *b, int level, int32_t x, int32_t y, int channel)
{
    const e3d_behind_level *l = &b->level[level];
    x = ref_within(x, l->width);
    y = ref_within(y, l->height);
    return b->texels[l->first + 4 * ((size_t)y * (size_t)l->width + (size_t)x) + (size_t)channel];
}

static float mix(float a, float b, float weight) { return a + (b - a) * weight; }

/* R163 */
static float sharp(const behind *b, float x, float y, int channel)
{
    float u = ref_clamp(x, 0.0f, (float)(b->level[0].width - 1)), v = ref_clamp(y, 0.0f, (float)(b->level[0].height - 1));
    int32_t i = (int32_t)u, j = (int32_t)v;
    float f = u - (float)i, g = v - (float)j;
    return mix(mix(texel(b, 0, i, j, channel), texel(b, 0, i + 1, j, channel), f),
               mix(texel(b, 0, i, j + 1, channel), texel(b, 0, i + 1, j + 1, channel), f), g);
}

/* R163: the texel nearest to a coordinate, and the weights of its neighbour, of itself, and of its other neighbour. */
static int32_t spline(float x, int level, int32_t side, float weight[3])
{
    float u = ref_clamp((x + 0.5f) * (1.0f / (float)(1 << level)) - 0.5f, 0.0f, (float)(side - 1));
    int32_t i = (int32_t)(u + 0.5f);
    float d = u - (float)i, a = 0.5f - d, c = 0.5f + d;
    weight[0] = (a * a) * 0.5f;
    weight[1] = 0.75f - d * d;
    weight[2] = (c * c) * 0.5f;
    return i;
}

/* R163 */
static float smooth(const behind *b, int level, float x, float y, int channel)
{
    float across[3], down[3], row[3];
    int32_t i = spline(x, level, b->level[level].width, across), j = spline(y, level, b->level[level].height, down);
    for (int32_t r = 0; r < 3; r++) {
        float t[3];
        for (int32_t k = 0; k < 3; k++)
            t[k] = texel(b, level, i - 1 + k, j - 1 + r, channel);
        row[r] = ref_dot3(t, across);
    }
    return ref_dot3(row, down);
}

static float at_level(const behind *b, int level, float x, float y, int channel)
{
    return level ? smooth(b, level, x, y, channel) : sharp(b, x, y, channel);
}

/* R163 */
static float look_up(const behind *b, float x, float y, float level, int channel)
{
    int l = (int)level;
    float f = level - (float)l, fine = at_level(b, l, x, y, channel);
    return f == 0.0f ? fine : mix(fine, at_level(b, l + 1, x, y, channel), f);
}

/* ---- what blending begins with ---- */

/* The places that a sample shows (R166). */
typedef struct bent_places {
    float x[3], y[3], level;
    float blur; /* in pixels of the frame, squared */
} bent_places;

/* R166: whether something before the glass shows at a place. */
static int is_before(const e3d_frame *frame, float x, float y, float depth)
{
    int32_t column = ref_rint(ref_clamp(x, 0.0f, (float)(frame->width - 1))), row = ref_rint(ref_clamp(y, 0.0f, (float)(frame->height - 1)));
    float d = frame->behind_depth[(size_t)row * (size_t)frame->width + (size_t)column];
    return d > 0.0f && d < depth;
}

/* R166; returns whether anything is bent or blurred. */
static int find_places(const e3d_frame *frame, const behind *b, const ref_bend *sum, const ref_place *at, bent_places *out)
{
    float x = pixel_place(frame, at->x) - 0.5f, y = pixel_place(frame, at->y) - 0.5f;
    int some = sum->blur != 0;
    out->blur = ref_max((float)(int32_t)sum->blur, 0.0f) * 0x1p-8f;
    out->level = ref_min(ref_log2(1.0f + out->blur) * 0.5f, (float)(b->count - 1));
    for (int c = 0; c < 3; c++) {
        out->x[c] = x + (float)(int32_t)sum->shift[c][0] * 0x1p-8f;
        out->y[c] = y + (float)(int32_t)sum->shift[c][1] * 0x1p-8f;
        if (is_before(frame, out->x[c], out->y[c], sum->depth)) {
            out->x[c] = x;
            out->y[c] = y;
        }
        some |= out->x[c] != x || out->y[c] != y;
    }
    return some;
}

/* R167 */
static float beyond(const e3d_frame *frame, float x, float y)
{
    return ref_max(ref_max(0.0f - x, x - (float)(frame->width - 1)), ref_max(0.0f - y, y - (float)(frame->height - 1)));
}

/* R167: the level of an environment for a blur. */
static float environment_level(const e3d_whole *whole, float blur)
{
    e3d_behind_level levels[E3D_BEHIND_LEVELS];
    float last = (float)(e3d_behind_levels(whole->width, whole->height, levels) - 1);
    float level = ref_min(ref_log2(1.0f + blur * (1.0f / (whole->fineness * whole->fineness))) * 0.5f, last);
    return level * (8.0f / ref_max(last, 1.0f));
}

/* R167: changes channel c of what shows at a place, or its share (c = 3), which is green's. */
static float fade(const e3d_frame *frame, const bent_places *places, int c, float shown)
{
    const e3d_whole whole = e3d_whole_of(frame);
    int at = c < 3 ? c : 1;
    float x = places->x[at], y = places->y[at], o = beyond(frame, x, y), direction[3], light[4];
    if (!frame->backdrop.light.environment || !(o > 0.0f))
        return shown;
    for (int k = 0; k < 3; k++)
        direction[k] = (frame->backdrop.ray[k] + (x + 0.5f) * frame->backdrop.across[k]) + (y + 0.5f) * frame->backdrop.down[k];
    float level = environment_level(&whole, places->blur);
    ref_environment(&frame->backdrop.light, direction, ref_max(frame->backdrop.level, level), light);
    light[3] = 1.0f;
    return mix(shown, light[c], ref_min(o * (16.0f / ((float)whole.height * whole.fineness)), 1.0f));
}

/* R166: red, green, blue, and the share; returns 0 if nothing is bent. */
static int find_behind(const e3d_frame *frame, const ref_bend *sum, const ref_place *at, float out[4])
{
    behind b = behind_of(frame);
    bent_places places;
    if (is_nothing(sum) || !find_places(frame, &b, sum, at, &places))
        return 0;
    for (int c = 0; c < 4; c++)
        out[c] = fade(frame, &places, c, look_up(&b, places.x[c < 3 ? c : 1], places.y[c < 3 ? c : 1], places.level, c));
    return 1;
}

static int is_opaque(const e3d_frame *frame) { return frame->backdrop.light.environment || frame->background[3] != 0.0f; }

/* R166 */
void ref_begin_behind(const e3d_frame *frame, const ref_bend *sum, const ref_place *at, float color[3], float *alpha)
{
    float light[4], shown[3];
    if (!find_behind(frame, sum, at, light))
        return;
    int opaque = is_opaque(frame);
    float inverse = light[3] > 0.0f ? 1.0f / light[3] : 0.0f;
    for (int c = 0; c < 3; c++) {
        float covered = light[3] > 0.0f ? light[c] * inverse : 0.0f;
        shown[c] = opaque ? light[c] : covered;
    }
    ref_map_tone(frame->tone_mapping, shown);
    for (int c = 0; c < 3; c++) {
        float plain = ref_clamp(light[c], 0.0f, 1.0f);
        shown[c] = ref_clamp(shown[c], 0.0f, 1.0f);
        color[c] = opaque ? plain + (shown[c] - plain) * light[3] : shown[c] * light[3];
    }
    *alpha = opaque ? 1.0f : light[3];
}

/* R166 */
void ref_begin_radiance(const e3d_frame *frame, const ref_bend *sum, const ref_place *at, float radiance[3])
{
    float light[4];
    if (!find_behind(frame, sum, at, light))
        return;
    for (int c = 0; c < 3; c++)
        radiance[c] = light[c];
}
