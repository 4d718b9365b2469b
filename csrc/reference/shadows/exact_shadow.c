/* Exact shadow: how much of a light casters leave to a sample.
 * In: a surface, a light, and all casters of the scene: each one is tested. Out: 0 or 1; of a soft light also between.
 * Rules: R98 (the plane of the light), R99 (which casters the ray goes through), R100 (the plane of the sample), R101 (hits), R194
 * (rays from the body that normals tell of), R196-R198 (soft lights).
 * Sources: of R99 Woop, Benthin and Wald 2013 ("Watertight ray/triangle intersection"), of R194 Hanika 2021 ("Hacking the shadow
 * terminator"). */
#include "data/light_points.h"
#include "reference/arithmetic.h"
#include "reference/surface.h"

/* R98: the light's axes. */
typedef struct eye {
    const e3d_light *light;
    int is_point;
    int axis, is_negative; /* of z */
    float slope[2];
    float x, y, z; /* of the sample; for a point light only z */
} eye;

/* R100 */
typedef struct plane {
    float normal[3], slack[3], limit;
    float towards[3]; /* the light, from the sample */
} plane;

/* A caster as the light sees it. */
typedef struct seen {
    float x[3], y[3], z[3];
} seen;

static int longest(const float v[3])
{
    float a = fabsf(v[0]), b = fabsf(v[1]), c = fabsf(v[2]);
    if (a >= b && a >= c)
        return 0;
    return b >= c ? 1 : 2;
}

/* ---- R98 ---- */

/* Projects a point into the light's axes; for a point light, its position is subtracted already. */
static void look(const eye *e, const float p[3], float *x, float *y, float *z)
{
    *x = p[(e->axis + 1) % 3];
    *y = p[(e->axis + 2) % 3];
    *z = e->is_negative ? 0.0f - p[e->axis] : p[e->axis];
    if (!e->is_point) {
        *x = *x - e->slope[0] * p[e->axis];
        *y = *y - e->slope[1] * p[e->axis];
    }
}

static eye open_eye(const e3d_light *light, const float p[3])
{
    eye out = {.light = light, .is_point = e3d_light_traits_of(light->kind).has_position};
    float d[3];
    for (int c = 0; c < 3; c++)
        d[c] = out.is_point ? p[c] - light->position[c] : light->to_light[c];
    out.axis = longest(d);
    out.is_negative = out.is_point ? d[out.axis] < 0.0f : d[out.axis] > 0.0f;
    float along = out.is_point && out.is_negative ? 0.0f - d[out.axis] : d[out.axis];
    for (int c = 0; c < 2; c++)
        out.slope[c] = d[(out.axis + 1 + c) % 3] / along;
    look(&out, out.is_point ? d : p, &out.x, &out.y, &out.z);
    return out;
}

/* R98 */
static void see(const eye *e, const ref_caster *caster, seen *out)
{
    for (int k = 0; k < 3; k++) {
        float v[3];
        for (int c = 0; c < 3; c++)
            v[c] = e->is_point ? caster->corner[k][c] - e->light->position[c] : caster->corner[k][c];
        look(e, v, &out->x[k], &out->y[k], &out->z[k]);
    }
}

/* ---- R99 ---- */

static int spans_zero(const float v[3])
{
    return ref_min(ref_min(v[0], v[1]), v[2]) <= 0.0f && ref_max(ref_max(v[0], v[1]), v[2]) >= 0.0f;
}

/* R99, from where the corners are around the ray. */
static int is_around(const float a[3], const float b[3], float weight[3])
{
    if (!spans_zero(a) || !spans_zero(b))
        return 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 2) % 3, j = (k + 1) % 3;
        weight[k] = a[i] * b[j] - b[i] * a[j];
    }
    return (weight[0] >= 0.0f && weight[1] >= 0.0f && weight[2] >= 0.0f) || (weight[0] <= 0.0f && weight[1] <= 0.0f && weight[2] <= 0.0f);
}

static int is_before(const float z[3], float end) { return ref_min(ref_min(z[0], z[1]), z[2]) < end; }

/* R99 */
static int goes_through(const eye *e, const seen *s, float weight[3])
{
    float a[3], b[3];
    if (!is_before(s->z, e->z))
        return 0;
    for (int k = 0; k < 3; k++) {
        a[k] = s->x[k] - (e->is_point ? e->slope[0] * s->z[k] : e->x);
        b[k] = s->y[k] - (e->is_point ? e->slope[1] * s->z[k] : e->y);
    }
    return is_around(a, b, weight);
}

/* ---- R100 ---- */

/* Turns a plane to what lies in a direction. */
static plane turn_to(const plane *from, const float towards[3])
{
    plane out = *from;
    int away = ref_dot3(out.normal, towards) < 0.0f;
    for (int c = 0; c < 3 && away; c++)
        out.normal[c] = 0.0f - out.normal[c];
    return out;
}

/* R100 */
static plane plane_of(const ref_surface *s, const e3d_light *light)
{
    float e[3], f[3], most[3], sum[3], m[3], share[3];
    plane out;
    for (int c = 0; c < 3; c++) {
        const float v[3] = {s->corner_position[0][c], s->corner_position[1][c], s->corner_position[2][c]};
        e[c] = v[1] - v[0];
        f[c] = v[2] - v[0];
        most[c] = ref_max(ref_max(fabsf(v[0]), fabsf(v[1])), fabsf(v[2]));
        sum[c] = fabsf(e[c]) + fabsf(f[c]);
    }
    ref_cross(e, f, m);
    float i = 1.0f / ref_max(ref_max(fabsf(m[0]), fabsf(m[1])), fabsf(m[2]));
    for (int c = 0; c < 3; c++) {
        int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        out.normal[c] = m[c] * i;
        out.slack[c] = ((most[c1] * sum[c2] + most[c2] * sum[c1]) * i) * E3D_PLANE_SLACK;
        share[c] = fabsf(out.normal[c]) * most[c];
        out.towards[c] = e3d_light_traits_of(light->kind).has_position ? light->position[c] - s->lit_position[c] : light->to_light[c];
    }
    out.limit = ((share[0] + share[1]) + share[2]) * E3D_PLANE_SLACK;
    return turn_to(&out, out.towards);
}

/* ---- R101 ---- */

static float between(const float weight[3], const float corner[3]) { return ref_dot3(weight, corner); }

static float texture_alpha(const e3d_material *material, const e3d_mesh_desc *mesh, const int32_t *face, const float weight[3])
{
    const e3d_texture_use *use = &material->texture;
    const float *uvs = use->uv_set ? mesh->uvs1 : mesh->uvs, *m = use->matrix;
    float corner[2][3], uv[2], texel;
    if (!use->texture || !uvs)
        return material->alpha;
    for (int k = 0; k < 3; k++) {
        float u = uvs[2 * (size_t)face[k]], v = uvs[2 * (size_t)face[k] + 1];
        corner[0][k] = use->is_moved ? (m[0] * u + m[1] * v) + m[2] : u;
        corner[1][k] = use->is_moved ? (m[3] * u + m[4] * v) + m[5] : v;
    }
    for (int c = 0; c < 2; c++)
        uv[c] = between(weight, corner[c]);
    float unit = ref_texture_alpha(e3d_texture_get_view(use->texture), uv, &texel);
    return texel * (material->alpha * unit);
}

static float color_alpha(const e3d_frame *frame, const uint8_t *u8, const float *f32, size_t index)
{
    float color[4];
    if (f32)
        return f32[4 * index + 3];
    ref_decode_color(frame, u8 + 4 * index, color);
    return color[3];
}

static int has_hole(const ref_casters *casters, const ref_caster *caster, const float weight[3])
{
    const ref_instance *instance = &casters->instances[caster->instance];
    const e3d_mesh_desc *mesh = instance->mesh;
    const e3d_draw *draw = instance->draw;
    int32_t id = draw->material_base + (mesh->material_ids ? mesh->material_ids[caster->face] : 0);
    const e3d_material *material = &casters->source->materials[id];
    const int32_t *face = mesh->faces + 3 * (size_t)caster->face;
    if (material->alpha_mode == E3D_ALPHA_OPAQUE)
        return 0;
    float alpha = texture_alpha(material, mesh, face, weight), corner[3];
    if (mesh->colors_u8 || mesh->colors_f32) {
        for (int k = 0; k < 3; k++)
            corner[k] = color_alpha(casters->frame, mesh->colors_u8, mesh->colors_f32, (size_t)face[k]);
        alpha = alpha * between(weight, corner);
    }
    if (draw->instance_colors_u8 || draw->instance_colors_f32)
        alpha = alpha * color_alpha(casters->frame, draw->instance_colors_u8, draw->instance_colors_f32, (size_t)instance->number);
    alpha = ref_clamp(alpha, 0.0f, 1.0f);
    return !(alpha >= (material->alpha_mode == E3D_ALPHA_MASK ? material->alpha_cutoff : E3D_BLENDED_CASTER));
}

/* R101: whether a hit is above the sample's plane; turns the weights into shares. */
static int is_above(const plane *plane, const float p[3], const ref_caster *caster, float weight[3])
{
    float det = (weight[0] + weight[1]) + weight[2], height[3];
    if (det == 0.0f)
        return 0;
    float r = 1.0f / det;
    for (int k = 0; k < 3; k++) {
        float d[3], size[3];
        for (int c = 0; c < 3; c++) {
            d[c] = caster->corner[k][c] - p[c];
            size[c] = fabsf(d[c]);
        }
        height[k] = ref_dot3(plane->normal, d) - ref_dot3(plane->slack, size);
        weight[k] = weight[k] * r;
    }
    return between(weight, height) > plane->limit;
}

/* ---- R194 ---- */

/* Whether a face turns away from a light that its normals look to. */
static int turns_away(const ref_surface *s, const plane *plane)
{
    return s->is_smooth && ref_dot3(s->shading_normal, plane->towards) > 0.0f && ref_dot3(plane->normal, s->shading_normal) < 0.0f;
}

/* Whether a caster is one through which a ray towards a light leaves the sample's own body. */
static int is_left(const ref_surface *s, const ref_caster *caster, const float towards[3])
{
    const ref_instance *instance = &s->casters->instances[caster->instance];
    const float (*v)[3] = caster->corner;
    float e[3], f[3], m[3];
    if (instance->mesh != s->instance->mesh)
        return 0;
    for (int c = 0; c < 3; c++) {
        e[c] = v[1][c] - v[0][c];
        f[c] = v[2][c] - v[0][c];
    }
    ref_cross(e, f, m);
    for (int c = 0; c < 3 && instance->turned_round; c++)
        m[c] = 0.0f - m[c];
    return ref_dot3(m, towards) > 0.0f;
}

/* The place on the smooth body over a sample. */
static void find_body(const ref_surface *s, const float p[3], float out[3])
{
    float normal[3][3], rise[3];
    for (int k = 0; k < 3; k++) {
        float d[3];
        for (int c = 0; c < 3; c++) {
            normal[k][c] = s->corner_normal[k][c];
            d[c] = s->corner_position[k][c] - p[c];
        }
        ref_normalize(normal[k]);
        rise[k] = s->barycentric[k] * ref_max(ref_dot3(normal[k], d), 0.0f);
    }
    for (int c = 0; c < 3; c++)
        out[c] = p[c] + ((rise[0] * normal[0][c] + rise[1] * normal[1][c]) + rise[2] * normal[2][c]);
}

static int is_spared(const ref_casters *casters, const ref_caster *caster, const e3d_light *light)
{
    return casters->instances[caster->instance].draw->spared_lights >> light->shadow.exact & 1;
}

/* R98 to R102: whether a caster hides the light from a place; `leaves`: whether the ray may leave the sample's own body. */
static int is_hidden_from(const e3d_light *light, const ref_surface *surface, const plane *plane, const float p[3], int leaves)
{
    const ref_casters *casters = surface->casters;
    eye e = open_eye(light, p);
    for (int64_t n = 0; n < casters->count; n++) {
        const ref_caster *caster = &casters->items[n];
        seen s;
        float weight[3];
        if (is_spared(casters, caster, light))
            continue;
        see(&e, caster, &s);
        if (goes_through(&e, &s, weight) && is_above(plane, p, caster, weight) && (!e.is_point || between(weight, s.z) > 0.0f) && !has_hole(casters, caster, weight) &&
            !(leaves && is_left(surface, caster, plane->towards)))
            return 1;
    }
    return 0;
}

/* R102 and R194 */
static int is_hidden(const e3d_light *light, const ref_surface *surface, const plane *plane, int away)
{
    float body[3];
    if (is_hidden_from(light, surface, plane, surface->lit_position, away))
        return 1;
    if (!away)
        return 0;
    find_body(surface, surface->lit_position, body);
    return is_hidden_from(light, surface, plane, body, 0);
}

/* ---- soft lights ---- */

/* R197: the light's disc as a sample sees it. */
typedef struct disc {
    const e3d_light *light;
    int axis, is_negative; /* k, and of z along it */
    float e[3], f[3];
} disc;

static void find_towards(const e3d_light *light, const float p[3], float out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = e3d_light_traits_of(light->kind).has_position ? light->position[c] - p[c] : light->to_light[c];
}

/* R196 and R197 */
static disc find_disc(const e3d_light *light, const ref_surface *surface, const float t[3], const float l[3])
{
    disc out = {.light = light, .axis = longest(t)};
    int k = out.axis, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    float cosine = ref_dot3(surface->shading_normal, l), length = sqrtf(ref_dot3(t, t));
    float size = ref_max(ref_min(light->shadow.soft, (0.5f * cosine) * length), 0.0f);
    float square = t[k] * t[k] + t[k1] * t[k1], s = size / sqrtf(square);
    out.is_negative = t[k] > 0.0f;
    out.e[k] = (0.0f - t[k1]) * s;
    out.e[k1] = t[k] * s;
    out.e[k2] = 0.0f;
    s = s / length;
    out.f[k] = (0.0f - t[k2] * t[k]) * s;
    out.f[k1] = (0.0f - t[k2] * t[k1]) * s;
    out.f[k2] = square * s;
    return out;
}

/* R198: a ray to a point of the disc. */
typedef struct disc_ray {
    int axis, is_negative;
    float x, y, z, slope[2]; /* of the sample; towards the light */
    float towards[3];        /* the point, from the sample */
    int ends;                /* whether the light has a position: */
    float end;               /* z of the point */
} disc_ray;

static float height(float along, int is_negative) { return is_negative ? 0.0f - along : along; }

static int is_finite(float v) { return v - v == 0.0f; }

/* Returns 0 if the ray is none. */
static int find_ray(const disc *d, int point, const float p[3], disc_ray *out)
{
    float x = E3D_LIGHT_POINT_X[point] * 0x1p-10f, y = E3D_LIGHT_POINT_Y[point] * 0x1p-10f, t[3], o[3];
    int k = d->axis, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    find_towards(d->light, p, t);
    for (int c = 0; c < 3; c++) {
        o[c] = x * d->e[c] + y * d->f[c];
        t[c] = t[c] + o[c];
    }
    *out = (disc_ray){k, d->is_negative, p[k1], p[k2], height(p[k], d->is_negative), {t[k1] / fabsf(t[k]), t[k2] / fabsf(t[k])}, {t[0], t[1], t[2]}, 0, 0.0f};
    out->ends = e3d_light_traits_of(d->light->kind).has_position;
    out->end = height(d->light->position[k] + o[k], d->is_negative);
    return is_finite(out->x) && is_finite(out->y) && is_finite(out->z) && is_finite(out->slope[0]) && is_finite(out->slope[1]);
}

/* R198 */
static int meets(const disc_ray *r, const plane *plane, const float p[3], const ref_casters *casters, const ref_caster *caster)
{
    float a[3], b[3], z[3], weight[3];
    for (int j = 0; j < 3; j++) {
        const float *v = caster->corner[j];
        z[j] = height(v[r->axis], r->is_negative);
        a[j] = v[(r->axis + 1) % 3] - (r->x + (r->z - z[j]) * r->slope[0]);
        b[j] = v[(r->axis + 2) % 3] - (r->y + (r->z - z[j]) * r->slope[1]);
    }
    return is_before(z, r->z) && is_around(a, b, weight) && is_above(plane, p, caster, weight) && (!r->ends || between(weight, z) > r->end) &&
           !has_hole(casters, caster, weight);
}

static int is_ray_hidden(const disc *d, const disc_ray *r, const ref_surface *surface, const plane *plane, const float p[3], int leaves)
{
    const ref_casters *casters = surface->casters;
    for (int64_t n = 0; n < casters->count; n++) {
        const ref_caster *caster = &casters->items[n];
        if (!is_spared(casters, caster, d->light) && meets(r, plane, p, casters, caster) && !(leaves && is_left(surface, caster, r->towards)))
            return 1;
    }
    return 0;
}

/* R198: R100 and R194 for one point of the disc. */
static int is_point_hidden(const disc *d, int point, const ref_surface *surface, const plane *to_middle)
{
    const float *p = surface->lit_position;
    float body[3];
    disc_ray r;
    int is_ray = find_ray(d, point, p, &r);
    const plane plane = turn_to(to_middle, r.towards);
    int away = turns_away(surface, &plane);
    if (is_ray && is_ray_hidden(d, &r, surface, &plane, p, away))
        return 1;
    if (!away)
        return 0;
    find_body(surface, p, body);
    return find_ray(d, point, body, &r) && is_ray_hidden(d, &r, surface, &plane, body, 0);
}

/* R196 */
static float soft_share(const e3d_light *light, const ref_surface *surface, const plane *plane, const float l[3])
{
    const disc d = find_disc(light, surface, plane->towards, l);
    int hidden = 0;
    for (int i = 0; i < E3D_LIGHT_POINTS; i++)
        hidden += is_point_hidden(&d, i, surface, plane);
    return (float)(E3D_LIGHT_POINTS - hidden) * (1.0f / E3D_LIGHT_POINTS);
}

float ref_exact_share(const e3d_light *light, const ref_surface *surface, const float l[3])
{
    const plane plane = plane_of(surface, light);
    if (light->shadow.soft > 0.0f)
        return soft_share(light, surface, &plane, l);
    return is_hidden(light, surface, &plane, turns_away(surface, &plane)) ? 0.0f : 1.0f;
}
