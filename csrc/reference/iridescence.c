/* Iridescence: the reflectance of a thin film on a surface, by colour.
 * In: the cosine of the angle of view, the film's index of refraction and thickness, the reflectance of the surface below.
 * Out: the reflectance of each channel.
 * Rules: R139 (sensitivity), R140 (reflectance).
 * Source: KHR_materials_iridescence, after Belcour and Barla 2017. */
#include "data/iridescence_tables.h"
#include "reference/surface.h"

/* R139: one wave's response after a path. */
static float wave(int number, float path)
{
    float turns = path * E3D_FILM_TURNS[number];
    float rest = turns - ref_floor(turns + 0.5f), square = rest * rest, cosine = E3D_FILM_COSINES[E3D_FILM_COSINE - 1];
    for (int k = E3D_FILM_COSINE - 2; k >= 0; k--)
        cosine = cosine * square + E3D_FILM_COSINES[k];
    return (E3D_FILM_AMPLITUDE[number] * cosine) * ref_exp2((E3D_FILM_FADE[number] * path) * path);
}

/* R139 */
static void sensitivity(float path, const float sign[3], float out[3])
{
    float xyz[3] = {sign[0] * (wave(0, path) + wave(3, path)), sign[1] * wave(1, path), sign[2] * wave(2, path)};
    for (int c = 0; c < 3; c++)
        out[c] = ref_dot3(E3D_FILM_RGB[c], xyz);
}

/* R140 */
static float schlick(float f0, float cosine)
{
    float w = 1.0f - cosine, w2 = w * w;
    return f0 + (1.0f - f0) * ((w2 * w2) * w);
}

/* R140 */
void ref_iridescence(float cosine, float ior, float thickness, const float f0[3], float out[3])
{
    static const float ALWAYS[3] = {1.0f, 1.0f, 1.0f};
    float outer = (ior - 1.0f) / (ior + 1.0f), r12 = schlick(outer * outer, cosine), t = 1.0f - r12;
    float square = 1.0f - (1.0f / (ior * ior)) * (1.0f - cosine * cosine), below = sqrtf(ref_max(square, 0.0f));
    float path = ((2.0f * ior) * thickness) * below, sign[3], once[3], twice[3], r23[3];
    for (int c = 0; c < 3; c++) {
        float root = sqrtf(ref_clamp(f0[c], 0.0f, E3D_MOST_IRIDESCENCE_F0)), base = (1.0f + root) / (1.0f - root);
        float inner = (base - ior) / (base + ior);
        sign[c] = base < ior ? 1.0f : -1.0f;
        r23[c] = schlick(inner * inner, below);
    }
    sensitivity(path, sign, once);
    sensitivity(path + path, ALWAYS, twice);
    for (int c = 0; c < 3; c++) {
        float both = ref_clamp(r12 * r23[c], E3D_LEAST_IRIDESCENCE_PRODUCT, E3D_MOST_IRIDESCENCE_F0), root = sqrtf(both);
        float rs = ((t * t) * r23[c]) / (1.0f - both), first = (rs - t) * root, second = first * root;
        float sum = ((r12 + rs) + first * (once[c] + once[c])) + second * (twice[c] + twice[c]);
        out[c] = square < 0.0f ? 1.0f : ref_clamp(sum, 0.0f, 1.0f);
    }
}

void ref_iridescence_f0(float cosine, const float film[3], float out[3])
{
    float w = 1.0f - cosine, w2 = w * w, w5 = ref_min((w2 * w2) * w, E3D_MOST_IRIDESCENCE_F0);
    for (int c = 0; c < 3; c++)
        out[c] = ref_clamp((film[c] - w5) / (1.0f - w5), 0.0f, 1.0f);
}
