/* Anisotropy: a lobe that is rougher along one direction than across it, as that of brushed metal.
 * In: a surface with its tangent, its mapped normal and its texel; the half vector of a light.
 * Out: the directions of the lobe; D times V; the normal that mirrors light from all around.
 * Rules: R136 (directions), R137 (lights), R138 (light from all around).
 * Sources: KHR_materials_anisotropy; Burley 2012; Heitz 2014; the bent normal is that of Khronos's sample viewer. */
#include "reference/surface.h"

void ref_any_direction(const float n[3], float out[3])
{
    const float axis[3] = {fabsf(n[0]) < 0.5f ? 1.0f : 0.0f, fabsf(n[0]) < 0.5f ? 0.0f : 1.0f, 0.0f};
    ref_cross(n, axis, out);
    ref_normalize(out);
}

/* R136 */
void ref_find_stretch(const e3d_physical *material, const float texel[4], float unit, const ref_surface *s, ref_stretch *out)
{
    const float *turn = material->anisotropy_turn, *n = s->world_normal;
    float x = 1.0f, y = 0.0f, b[3];
    out->strength = material->anisotropy;
    if (texel) {
        x = texel[0] * unit * 2.0f - 1.0f;
        y = texel[1] * unit * 2.0f - 1.0f;
        out->strength = texel[2] * (material->anisotropy * unit);
    }
    float along = turn[0] * x - turn[1] * y, across = turn[1] * x + turn[0] * y;
    ref_cross(s->shading_normal, s->tangent, b);
    for (int c = 0; c < 3; c++)
        out->t[c] = s->tangent[c] * along + (b[c] * s->tangent[3]) * across;
    float over = ref_dot3(n, out->t);
    for (int c = 0; c < 3; c++)
        out->t[c] = out->t[c] - n[c] * over;
    ref_normalize(out->t);
    out->strength = ref_clamp(out->strength, 0.0f, 1.0f);
    if (!(ref_dot3(out->t, out->t) > 0.5f)) {
        ref_any_direction(n, out->t);
        out->strength = 0.0f;
    }
    ref_cross(n, out->t, out->b);
}

/* The root in Smith's term of a direction. */
static float smith(const ref_stretch *stretch, float at, float ab, const float direction[3], float cosine)
{
    float x = at * ref_dot3(stretch->t, direction), y = ab * ref_dot3(stretch->b, direction);
    return sqrtf((x * x + y * y) + cosine * cosine);
}

float ref_reflect_stretched(const ref_stretch *stretch, float alpha, const float view[3], float nv, const float l[3], float nl,
                            const float h[3], float square, float nh)
{
    float at = alpha + (1.0f - alpha) * (stretch->strength * stretch->strength), product = at * alpha;
    float x = alpha * ref_dot3(stretch->t, h), y = at * ref_dot3(stretch->b, h), z = product * nh;
    float f = (x * x + y * y) + z * z;
    float u = nl * smith(stretch, at, alpha, view, nv) + nv * smith(stretch, at, alpha, l, nl);
    return nh > 0.0f ? ((((product * product) * product) * E3D_OVER_2PI) * (square * square)) / ((f * f) * u) : 0.0f;
}

/* R138 */
void ref_bend_normal(const ref_stretch *stretch, const float normal[3], const float view[3], float roughness, float out[3])
{
    float e[3], p[3], k = 1.0f - stretch->strength * (1.0f - roughness), k2 = k * k, k4 = k2 * k2;
    ref_cross(stretch->b, view, e);
    ref_cross(e, stretch->b, p);
    ref_normalize(p);
    for (int c = 0; c < 3; c++)
        out[c] = p[c] + (normal[c] - p[c]) * k4;
    ref_normalize(out);
}
