/* Transmission: surfaces that light passes through, blended over what is behind them.
 * In: a surface with the values of its textures, and the sample behind it. Out: the share of the light from behind that
 * passes, channel by channel; the sample with the surface in front of it.
 * Rules: R133 (which surfaces, and their alpha), R134 (transmittance), R135 (composition).
 * Sources: KHR_materials_transmission; KHR_materials_volume, whose absorption is that of Beer and Lambert. */
#include "reference/surface.h"

/* R133 */
int ref_transmits(const e3d_frame *frame, const ref_piece *piece)
{
    const e3d_material *m = piece->primitive.material;
    if (!m || piece->primitive.kind != REF_FACE || frame->mode != E3D_MODE_LIT)
        return 0;
    return m->is_physical && !m->is_unlit && m->physical.transmission != 0.0f;
}

/* R133 */
float ref_transmitting_alpha(const e3d_material *material, float alpha)
{
    if (material->alpha_mode == E3D_ALPHA_BLEND)
        return alpha;
    return material->alpha_mode == E3D_ALPHA_OPAQUE || alpha >= material->alpha_cutoff ? 1.0f : 0.0f;
}

/* R134 */
void ref_transmittance(const e3d_frame *frame, const ref_surface *surface, float out[3])
{
    const e3d_physical *p = &surface->piece->primitive.material->physical;
    float view[3], behind[3];
    ref_direction_to_eye(frame, surface, view);
    ref_light_behind(surface, view, behind);
    for (int c = 0; c < 3; c++) {
        if (ref_absorbs(p))
            behind[c] = behind[c] * ref_exp2(surface->physical.depth * p->absorption[c]);
        out[c] = ref_clamp(behind[c], 0.0f, 1.0f);
    }
}

/* R135 */
void ref_lay_transmitting(const float color[3], float alpha, const float transmittance[3], float under[3], float *under_alpha)
{
    float rest[3];
    for (int c = 0; c < 3; c++) {
        rest[c] = (1.0f - alpha) + alpha * transmittance[c];
        under[c] = ref_min(ref_clamp(color[c], 0.0f, 1.0f) * alpha + under[c] * rest[c], 1.0f);
    }
    float mean = ((rest[0] + rest[1]) + rest[2]) * E3D_THIRD, most = ref_max(ref_max(under[0], under[1]), under[2]);
    *under_alpha = (1.0f - mean) + *under_alpha * mean;
    if (most >= E3D_LEAST_ALPHA)
        *under_alpha = ref_max(*under_alpha, most);
}
