/* Light: the Blinn-Phong sum over the lights, in their order.
 * In: a surface, the frame's lights. Out: its linear colour, not yet clamped.
 * Rules: R31, R54, R90, R130, R154, R169, and the attenuations there; R239 (area lights). A light that is out of range adds
 * nothing at all. */
#include "reference/area_light.h"
#include "reference/arithmetic.h"

/* R31, R43, R51: `x` is the squared distance over the squared range, `i` is 1 over the distance. */
static float falloff(const e3d_light *light, float d2, float x, float i, int by_product)
{
    float t = 1.0f - x;
    if (light->falloff == E3D_FALLOFF_WINDOW)
        return t * t;
    float window = light->falloff == E3D_FALLOFF_GLTF ? ref_max(1.0f - x * x, 0.0f) : 1.0f;
    return by_product ? window * (i * i) : window / d2;
}

/* R43: the factor of a spot light's cone along l. */
static float cone(const e3d_light *light, const float l[3])
{
    float t = ref_clamp((ref_dot3(l, light->to_light) - light->cone[0]) * light->cone[1], 0.0f, 1.0f);
    return t * t;
}

/* Finds the unit vector to the light, and the attenuation; returns 0 if the light is out of range. */
int ref_light_reach(const e3d_light *light, const float p[3], int by_product, float l[3], float *attenuation)
{
    if (!e3d_light_traits_of(light->kind).has_position) {
        for (int c = 0; c < 3; c++)
            l[c] = light->to_light[c];
        *attenuation = 1.0f;
        return 1;
    }
    float range2 = light->range * light->range;
    float d[3] = {light->position[0] - p[0], light->position[1] - p[1], light->position[2] - p[2]};
    float d2 = ref_dot3(d, d);
    if (d2 >= range2)
        return 0;
    d2 = ref_max(d2, 0x1p-40f);
    float i = 1.0f / sqrtf(d2);
    for (int c = 0; c < 3; c++)
        l[c] = d[c] * i;
    *attenuation = falloff(light, d2, d2 * (1.0f / range2), i, by_product);
    if (e3d_light_traits_of(light->kind).emission == E3D_EMITS_CONE)
        *attenuation = *attenuation * cone(light, l);
    return 1;
}

void ref_direction_to_eye(const e3d_frame *frame, const ref_surface *surface, float out[3])
{
    int perspective = frame->eye[3] == 1.0f;
    for (int c = 0; c < 3; c++)
        out[c] = perspective ? frame->eye[c] - surface->lit_position[c] : frame->eye[c];
    if (perspective)
        ref_normalize(out);
}

/* The highlight: the cosine between the normal and the half vector, raised to the shininess. */
static float highlight(const e3d_frame *frame, const ref_surface *surface, const float l[3], float shininess)
{
    float h[3];
    ref_direction_to_eye(frame, surface, h);
    for (int c = 0; c < 3; c++)
        h[c] = l[c] + h[c];
    ref_normalize(h);
    float k = ref_dot3(surface->world_normal, h);
    return ref_pow(k > 0.0f ? k : 0.0f, shininess);
}

void ref_ambient(const e3d_frame *frame, const float normal[3], float out[3])
{
    float x = normal[0], y = normal[1], z = normal[2];
    const float factors[E3D_AMBIENT_TERMS] = {1.0f, x, y, z, x * x - z * z, y * y - z * z, x * y, y * z, z * x};
    for (int c = 0; c < 3; c++) {
        out[c] = frame->ambient[c];
        for (int t = 0; t < E3D_AMBIENT_TERMS && frame->ambient_light.is_given; t++)
            out[c] = out[c] + frame->ambient_light.terms[t][c] * factors[t];
        out[c] = frame->ambient_light.is_given ? ref_max(out[c], 0.0f) : out[c];
    }
}

void ref_irradiance(const e3d_frame *frame, const float normal[3], float out[3])
{
    float more[3];
    ref_ambient(frame, normal, out);
    if (!frame->environment.environment)
        return;
    ref_environment_irradiance(&frame->environment, normal, more);
    for (int c = 0; c < 3; c++)
        out[c] = out[c] + more[c];
}

/* R239: the light of all area lights; returns 0 if there are none. */
static int add_area_lights(const e3d_frame *frame, const ref_surface *surface, float diffuse_sum[3], float specular_sum[3])
{
    int count = 0;
    float view[3], shininess = surface->piece->primitive.material->shininess;
    float roughness = ref_clamp(sqrtf(sqrtf(2.0f / (shininess + 2.0f))), E3D_LEAST_ROUGHNESS, 1.0f);
    ref_area_frame axes;
    ref_direction_to_eye(frame, surface, view);
    ref_find_area_frame(surface->world_normal, view, &axes);
    for (int32_t n = 0; n < frame->light_count; n++) {
        ref_area_lit lit;
        if (!e3d_is_area_light(frame->lights[n].kind))
            continue;
        count++;
        if (!ref_area_light(frame, n, surface, &axes, &lit))
            continue;
        float k = (axes.cosine * ref_area_shine(&lit.turned, &axes, roughness)) * (4.0f / (shininess + 2.0f));
        for (int c = 0; c < 3; c++) {
            float shown = frame->lights[n].color[c] * E3D_OVER_PI; /* R154 */
            diffuse_sum[c] = diffuse_sum[c] + shown * lit.e;
            specular_sum[c] = specular_sum[c] + shown * (lit.share * k);
        }
    }
    return count > 0;
}

/* R31: E before it is clamped, and S; specular_sum: NULL where nothing shines. */
static void add_lights(const e3d_frame *frame, const ref_surface *surface, float diffuse_sum[3], float *specular_sum)
{
    const e3d_material *material = surface->piece->primitive.material;
    float area_sum[3] = {0.0f, 0.0f, 0.0f}, area_shine[3] = {0.0f, 0.0f, 0.0f};
    ref_irradiance(frame, surface->world_normal, diffuse_sum);
    for (int c = 0; c < 3; c++)
        diffuse_sum[c] = diffuse_sum[c] * surface->visibility;
    int has_areas = add_area_lights(frame, surface, area_sum, area_shine);
    for (int c = 0; c < 3 && has_areas; c++) {
        diffuse_sum[c] = diffuse_sum[c] + area_sum[c];
        if (specular_sum)
            specular_sum[c] = specular_sum[c] + area_shine[c];
    }
    for (int32_t n = 0; n < frame->light_count; n++) {
        const e3d_light *light = &frame->lights[n];
        float l[3], attenuation;
        if (e3d_is_area_light(light->kind) || !ref_light_reach(light, surface->lit_position, 0, l, &attenuation))
            continue;
        float cosine = ref_dot3(surface->world_normal, l);
        cosine = cosine > 0.0f ? cosine : 0.0f;
        if (cosine > 0.0f && light->shadow.kind != E3D_SHADOW_NONE)
            attenuation = attenuation * ref_light_reached(frame, n, surface, l);
        float e = attenuation * cosine;
        float k = specular_sum && cosine > 0.0f ? highlight(frame, surface, l, material->shininess) : 0.0f;
        for (int c = 0; c < 3; c++) {
            float shown = light->color[c] * E3D_OVER_PI; /* R154 */
            diffuse_sum[c] = diffuse_sum[c] + shown * e;
            if (specular_sum)
                specular_sum[c] = specular_sum[c] + shown * (attenuation * k);
        }
    }
}

void ref_light(const e3d_frame *frame, const ref_surface *surface, float out[3])
{
    const float *specular = surface->piece->primitive.material->specular;
    int shiny = specular[0] != 0.0f || specular[1] != 0.0f || specular[2] != 0.0f;
    float diffuse_sum[3], specular_sum[3] = {0.0f, 0.0f, 0.0f};
    add_lights(frame, surface, diffuse_sum, shiny ? specular_sum : NULL);
    for (int c = 0; c < 3; c++) {
        float lit = surface->albedo[c] * ref_clamp(diffuse_sum[c], frame->light_clamp[0], frame->light_clamp[1]);
        out[c] = shiny ? (lit + specular[c] * specular_sum[c]) + surface->emissive[c]
                       : lit + surface->emissive[c];
        out[c] = out[c] * frame->exposure;
    }
}

void ref_backlight(const e3d_frame *frame, const ref_surface *surface, float out[3])
{
    ref_surface turned = *surface;
    turned.visibility = 1.0f;
    for (int c = 0; c < 3; c++) {
        turned.world_normal[c] = -surface->world_normal[c];
        turned.shading_normal[c] = -surface->shading_normal[c];
        for (int k = 0; k < 3; k++)
            turned.corner_normal[k][c] = -surface->corner_normal[k][c];
        if (surface->piece->primitive.material->physical.thickness != 0.0f)
            turned.lit_position[c] = surface->lit_position[c] - surface->shading_normal[c] * surface->physical.body;
    }
    add_lights(frame, &turned, out, NULL);
    for (int c = 0; c < 3; c++)
        out[c] = ref_clamp(out[c], 0.0f, INFINITY);
}
