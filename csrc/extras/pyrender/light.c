/* Light: finds the light on a batch of fragments, four at a time (R149).
 * In: surfaces and lights. Out: colours, linear, not clamped.
 * The model is pyrender's: GGX's distribution, Schlick's approximations of Fresnel's and of Smith's terms, with pyrender's
 * limits (Karis 2013). */
#include "base/vectors.h"
#include "extras/pyrender/picture.h"

#define LEAST_ROUGHNESS 0.04f
#define OVER_PI 0.31830988618f
#define PI 3.14159265359f

/* Four fragments. */
typedef struct four {
    float4 p[3], n[3], v[3];
    float4 diffuse[3], f0[3];
    float4 squared, k; /* of the roughness: its square for the distribution, k for the masking */
    float4 nv;
    float4 sum[3];
} four;

static inline float4 dot4(const float4 a[3], const float4 b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

static inline float4 clamp4(float4 x, float low, float high) { return less_of(more_of(x, splat(low)), splat(high)); }

/* Normalises; vectors without length stay 0. */
static inline float4 scale_to_unit(const float4 a[3]) { return splat(1) / root_of(more_of(dot4(a, a), splat(0x1p-120f))); }

static inline void make_unit4(float4 a[3])
{
    float4 scale = scale_to_unit(a);
    for (int c = 0; c < 3; c++)
        a[c] *= scale;
}

static void take_surface(const e3d_pyr_frame *frame, const pyr_batch *batch, int i, four *out)
{
    float4 metallic = clamp4(load4(batch->metallic + i), 0, 1), dielectric = splat(1) - metallic;
    float4 roughness = clamp4(load4(batch->roughness + i), LEAST_ROUGHNESS, 1);
    float4 alpha = roughness * roughness, r = roughness + splat(1);
    for (int c = 0; c < 3; c++) {
        float4 base = load4(batch->base[c] + i);
        out->p[c] = load4(batch->world[c] + i);
        out->n[c] = load4(batch->normal[c] + i);
        out->v[c] = splat(frame->eye[c]) - out->p[c];
        out->diffuse[c] = (base * splat(1 - LEAST_ROUGHNESS)) * dielectric;
        out->f0[c] = splat(LEAST_ROUGHNESS) * dielectric + base * metallic;
        out->sum[c] = splat(0);
    }
    make_unit4(out->n);
    make_unit4(out->v);
    out->squared = alpha * alpha;
    out->k = (r * r) * splat(0.125f);
    out->nv = clamp4(size_of(dot4(out->n, out->v)), 0.001f, 1);
}

/* Adds the light from direction l that goes to the viewer. */
static inline void add_light(four *f, const float4 l[3], const float color[3], float4 strength)
{
    float4 h[3] = {l[0] + f->v[0], l[1] + f->v[1], l[2] + f->v[2]};
    make_unit4(h);
    float4 nl = clamp4(dot4(f->n, l), 0.001f, 1), nh = clamp4(dot4(f->n, h), 0, 1), vh = clamp4(dot4(f->v, h), 0, 1);
    float4 away = splat(1) - vh, away2 = away * away, fresnel = (away2 * away2) * away;
    float4 free_k = splat(1) - f->k;
    float4 masking = (f->nv / (f->nv * free_k + f->k)) * (nl / (nl * free_k + f->k));
    float4 around = (nh * nh) * (f->squared - splat(1)) + splat(1);
    float4 distribution = f->squared / ((splat(PI) * around) * around);
    float4 mirrored = (masking * distribution) / ((splat(4) * nl) * f->nv + splat(0.001f));
    for (int c = 0; c < 3; c++) {
        float4 reflected = f->f0[c] + (splat(1) - f->f0[c]) * fresnel;
        float4 scattered = ((splat(1) - reflected) * f->diffuse[c]) * splat(OVER_PI);
        f->sum[c] += (nl * (strength * splat(color[c]))) * (scattered + reflected * mirrored);
    }
}

static inline void add_lamp(four *f, const e3d_pyr_light *light, float4 strength)
{
    float4 l[3], d[3];
    for (int c = 0; c < 3; c++)
        l[c] = splat(light->position[c]) - f->p[c];
    strength /= more_of(dot4(l, l), splat(0x1p-120f));
    make_unit4(l);
    if (light->kind == E3D_PYR_SPOT) {
        for (int c = 0; c < 3; c++)
            d[c] = splat(0 - light->direction[c]);
        float4 inside = clamp4(clamp4(dot4(d, l), 0, 1) * splat(light->cone_scale) + splat(light->cone_offset), 0, 1);
        strength *= inside * inside;
    }
    add_light(f, l, light->color, strength);
}

static void add_from(four *f, const e3d_pyr_light *light, float4 strength)
{
    float4 l[3];
    if (light->kind != E3D_PYR_DIRECTIONAL) {
        add_lamp(f, light, strength);
        return;
    }
    for (int c = 0; c < 3; c++)
        l[c] = splat(0 - light->direction[c]);
    add_light(f, l, light->color, strength);
}

static void finish(const e3d_pyr_frame *frame, pyr_batch *batch, int i, const float4 sum[3])
{
    for (int c = 0; c < 3; c++) {
        float4 lit = sum[c] + load4(batch->base[c] + i) * splat(frame->ambient[c]);
        lit = lit * load4(batch->occlusion + i) + load4(batch->emissive[c] + i);
        store4(batch->color[c] + i, lit * load4(batch->vertex_color[c] + i));
    }
}

void pyr_light(const e3d_pyr_frame *frame, pyr_batch *batch)
{
    const int32_t *numbers = frame->light_numbers + batch->draw->first_light;
    four fours[PYR_BATCH / 4];
    for (int i = 0; i < batch->count; i += 4)
        take_surface(frame, batch, i, &fours[i / 4]);
    for (int k = 0; k < batch->draw->light_count; k++) {
        const e3d_pyr_light *light = &frame->lights[numbers[k]];
        if (light->shadow_map)
            pyr_find_unshadowed(light, batch);
        for (int i = 0; i < batch->count; i += 4)
            add_from(&fours[i / 4], light, light->shadow_map ? load4(batch->unshadowed + i) : splat(1));
    }
    for (int i = 0; i < batch->count; i += 4)
        finish(frame, batch, i, fours[i / 4].sum);
}
