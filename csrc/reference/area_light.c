/* Area lights: the light of a rectangle, a disc or a tube at a sample, as integrals over polygons.
 * In: one of the frame's lights, a sample's position, normal and view. Out: the vector integral of the light's directions, and
 * the share that a lobe of GGX reflects of it.
 * Rules: R231 (reach), R232 (corners), R233 (frame), R234 (lobe), R235 (integral).
 * Sources: Lambert 1760 (the integral over a polygon); Heitz, Dupuy, Hill and Neubelt 2016 (linearly transformed cosines). */
#include "data/light_corners.h"
#include "reference/area_light.h"

/* R232 */
static void find_tube(const e3d_light *light, ref_area *out)
{
    float axis2 = ref_dot3(out->u, out->u), r2 = light->radius * light->radius;
    ref_cross(out->d, out->u, out->v);
    float away2 = ref_dot3(out->v, out->v) * (1.0f / ref_max(axis2, E3D_AREA_LEAST));
    float wide = light->radius / sqrtf(ref_max(axis2 * ref_max(away2 - r2, r2 * 0.25f), E3D_AREA_LEAST));
    for (int c = 0; c < 3; c++)
        out->v[c] = out->v[c] * wide;
}

/* R231 and R232 */
int ref_area_reach(const e3d_light *light, const float p[3], ref_area *out)
{
    const e3d_light_traits traits = e3d_light_traits_of(light->kind);
    float range2 = light->range * light->range;
    for (int c = 0; c < 3; c++) {
        out->d[c] = light->position[c] - p[c];
        out->u[c] = light->extent[0][c];
        out->v[c] = light->extent[1][c];
    }
    float d2 = ref_dot3(out->d, out->d), x = d2 * (1.0f / range2), t = 1.0f - x;
    if (d2 >= range2)
        return 0;
    if (traits.emission == E3D_EMITS_AHEAD && !(ref_dot3(out->d, light->to_light) > 0.0f))
        return 0;
    out->window = 1.0f;
    if (light->falloff == E3D_FALLOFF_WINDOW)
        out->window = t * t;
    if (light->falloff == E3D_FALLOFF_GLTF)
        out->window = ref_max(1.0f - x * x, 0.0f);
    if (traits.shape == E3D_SHAPE_TUBE)
        find_tube(light, out);
    out->corners = traits.shape == E3D_SHAPE_DISC ? E3D_DISC_CORNERS : E3D_RECTANGLE_CORNERS;
    out->corner = traits.shape == E3D_SHAPE_DISC ? E3D_DISC_CORNER : E3D_RECTANGLE_CORNER;
    return 1;
}

/* ---- R233 ---- */

void ref_find_area_frame(const float normal[3], const float view[3], ref_area_frame *out)
{
    float c = ref_dot3(normal, view), *t = out->axis[0];
    for (int k = 0; k < 3; k++) {
        out->axis[2][k] = normal[k];
        t[k] = normal[k] * c - view[k];
    }
    float sine2 = ref_dot3(t, t);
    out->sine = sqrtf(sine2);
    out->cosine = fabsf(c);
    for (int k = 0; k < 3; k++)
        t[k] = t[k] * (1.0f / out->sine);
    if (!(sine2 > E3D_AREA_LEAST_SINE2))
        ref_any_direction(normal, t);
    ref_cross(normal, t, out->axis[1]);
}

void ref_area_turn(const ref_area_frame *frame, ref_area *area)
{
    const ref_area from = *area;
    for (int k = 0; k < 3; k++) {
        area->d[k] = ref_dot3(frame->axis[k], from.d);
        area->u[k] = ref_dot3(frame->axis[k], from.u);
        area->v[k] = ref_dot3(frame->axis[k], from.v);
    }
}

/* ---- R234 ---- */

/* A number of a lobe. */
static float table_at(e3d_area_table table, float roughness, float cosine)
{
    const float last = (float)(E3D_AREA_SIZE - 1), *nodes = E3D_AREA_TABLE[table];
    float x = ref_clamp(roughness, 0.0f, 1.0f) * last, y = sqrtf(ref_clamp(cosine, 0.0f, 1.0f)) * last;
    int32_t i = (int32_t)x < E3D_AREA_SIZE - 2 ? (int32_t)x : E3D_AREA_SIZE - 2;
    int32_t j = (int32_t)y < E3D_AREA_SIZE - 2 ? (int32_t)y : E3D_AREA_SIZE - 2;
    const float *upper = nodes + i * E3D_AREA_SIZE + j, *lower = upper + E3D_AREA_SIZE;
    float a = upper[0] + (upper[1] - upper[0]) * (y - (float)j), b = lower[0] + (lower[1] - lower[0]) * (y - (float)j);
    return a + (b - a) * (x - (float)i);
}

static void through_lobe(const float lobe[5], float v[3])
{
    float x = lobe[1] * v[0] - lobe[0] * v[2], z = lobe[0] * v[0] + lobe[1] * v[2];
    v[0] = x * lobe[2] - z * lobe[4];
    v[1] = v[1] * lobe[3];
    v[2] = z;
}

float ref_area_shine(const ref_area *turned, const ref_area_frame *frame, float roughness)
{
    float alpha = roughness * roughness, rise = table_at(E3D_AREA_RISE, roughness, frame->cosine), sum[3];
    float zs = frame->sine * (1.0f - rise), zc = frame->cosine * (1.0f - rise) + rise, i = 1.0f / sqrtf(zs * zs + zc * zc);
    const float lobe[5] = {zs * i, zc * i, 1.0f / (table_at(E3D_AREA_ALONG, roughness, frame->cosine) * alpha),
                           1.0f / (table_at(E3D_AREA_ACROSS, roughness, frame->cosine) * alpha),
                           table_at(E3D_AREA_SKEW, roughness, frame->cosine) * frame->sine};
    ref_area seen = *turned;
    through_lobe(lobe, seen.d);
    through_lobe(lobe, seen.u);
    through_lobe(lobe, seen.v);
    ref_area_integral(&seen, sum);
    return ref_max(sum[2], 0.0f);
}

/* ---- R235 ---- */

/* An angle divided by its sine, from its cosine. */
static float over_sine(float x)
{
    static const float P[3] = {0x1.921fa6p+0f, 0x1.cfc68p-1f, 0x1.aa822ep-6f}, Q[2] = {0x1.3696bcp+0f, 0x1.285874p-2f};
    float y = fabsf(x), g = ((P[2] * y + P[1]) * y + P[0]) / ((Q[1] * y + Q[0]) * y + 1.0f);
    return x < 0.0f ? E3D_PI / sqrtf(ref_max(1.0f - x * x, E3D_AREA_LEAST_TURN)) - g : g;
}

static float over_length(const float v[3]) { return 1.0f / sqrtf(ref_max(ref_dot3(v, v), E3D_AREA_LEAST)); }

void ref_area_integral(const ref_area *seen, float sum[3])
{
    float a[3], b[3], leaves[3] = {0.0f, 0.0f, 0.0f}, enters[3] = {0.0f, 0.0f, 0.0f};
    for (int c = 0; c < 3; c++) {
        sum[c] = 0.0f;
        a[c] = (seen->d[c] + seen->u[c] * seen->corner[0][0]) + seen->v[c] * seen->corner[0][1];
    }
    for (int k = 0; k < seen->corners; k++) {
        const float *from = seen->corner[k], *to = seen->corner[k + 1];
        float e[3], n[3], cut[3], share = 1.0f;
        for (int c = 0; c < 3; c++) {
            b[c] = (seen->d[c] + seen->u[c] * to[0]) + seen->v[c] * to[1];
            e[c] = seen->u[c] * (to[0] - from[0]) + seen->v[c] * (to[1] - from[1]);
        }
        ref_cross(a, e, n);
        int begins = a[2] > 0.0f, ends = b[2] > 0.0f;
        float above = fabsf(a[2]), below = fabsf(b[2]);
        for (int c = 0; c < 3; c++)
            cut[c] = a[c] * below + b[c] * above;
        if (begins && !ends) {
            share = above;
            memcpy(leaves, cut, sizeof leaves);
        }
        if (!begins && ends) {
            share = below;
            memcpy(enters, cut, sizeof enters);
        }
        const float *p = begins ? a : cut, *q = ends ? b : cut;
        float i = over_length(p) * over_length(q), f = (over_sine(ref_dot3(p, q) * i) * share) * i;
        for (int c = 0; c < 3 && (begins || ends); c++)
            sum[c] = sum[c] + n[c] * f;
        memcpy(a, b, sizeof a);
    }
    float i = over_length(leaves) * over_length(enters);
    sum[2] = sum[2] + (leaves[0] * enters[1] - leaves[1] * enters[0]) * (over_sine(ref_dot3(leaves, enters) * i) * i);
}

/* ---- R236, R240 ---- */

int ref_area_light(const e3d_frame *frame, int32_t n, const ref_surface *s, const ref_area_frame *axes, ref_area_lit *out)
{
    const e3d_light *light = &frame->lights[n];
    float sum[3], l[3];
    if (!ref_area_reach(light, s->lit_position, &out->turned))
        return 0;
    ref_area_turn(axes, &out->turned);
    ref_area_integral(&out->turned, sum);
    for (int c = 0; c < 3; c++)
        out->l[c] = (axes->axis[0][c] * sum[0] + axes->axis[1][c] * sum[1]) + axes->axis[2][c] * sum[2];
    ref_normalize(out->l);
    out->share = out->turned.window;
    out->e = (out->share * 0.5f) * sum[2];
    if (!(out->e > 0.0f))
        return 0;
    if (light->shadow.kind == E3D_SHADOW_NONE)
        return 1;
    for (int c = 0; c < 3; c++)
        l[c] = light->position[c] - s->lit_position[c];
    float over = 1.0f / sqrtf(ref_max(ref_dot3(l, l), 0x1p-40f));
    for (int c = 0; c < 3; c++)
        l[c] = l[c] * over;
    if (!(ref_dot3(s->world_normal, l) > 0.0f))
        return 1;
    float reach = fabsf(out->turned.u[2]) + fabsf(out->turned.v[2]), hidden = 1.0f - ref_light_reached(frame, n, s, l);
    float reached = 1.0f - hidden * ref_clamp(out->turned.d[2] / reach, 0.0f, 1.0f);
    out->share = out->share * reached;
    out->e = out->e * reached;
    return reached > 0.0f;
}
