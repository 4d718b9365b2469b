/* Physical: light on physically based materials, as in glTF 2.0.
 * In: a surface with the values of its textures; the frame's lights, ambient light and environment. Out: its linear colour,
 * not yet clamped.
 * Rules: R49 and R193 (the material at a sample), R50 and R51 (lights), R52 (coat), R53 (sheen), R54 and R55 (light from all around),
 * R56 and R57 (sums), R168 (diffuse transmission), R211 (mirrors), R217 (wider lobes), R237 and R238 (area lights).
 * Sources: glTF 2.0, appendix B; Walter et al. 2007 (GGX); Heitz 2014 (Smith); Schlick 1994; Estevez and Kulla 2017 (sheen);
 * Fdez-Aguera 2019 (multiple scattering). */
#include "reference/area_light.h"
#include "reference/arithmetic.h"

/* A lobe of GGX about a normal. */
typedef struct lobe {
    float normal[3], facing; /* facing: n . v, of either sign */
    float nv, roughness, A, root;
    float own, more; /* R193: A without what was added to it, and twice that */
} lobe;

/* R49: everything that doesn't depend on the light. */
typedef struct sample {
    float view[3];
    lobe base, coat;
    float specular, top, diffuse[3], f0[3], f90;
    float sheen_power; /* 1 / alpha of the sheen */
    float film[3], film_top; /* R141: what a film reflects of each channel, and the greatest of that without metal */
} sample;

/* A light at a sample, by the half vector h = l + v. */
typedef struct half_vector {
    float h[3], square;
} half_vector;

/* The sums over lights. */
typedef struct sums {
    float direct[3], coat[3], fuzz[3];
} sums;

static int is_anisotropic(const ref_surface *s) { return s->piece->primitive.material->physical.anisotropy != 0.0f; }
static int is_iridescent(const ref_surface *s) { return s->piece->primitive.material->physical.iridescence != 0.0f; }

static int is_translucent(const ref_surface *s) { return s->piece->primitive.material->physical.diffuse_transmission != 0.0f; }

/* R49 and R193 */
static lobe make_lobe(const float normal[3], const float view[3], float roughness, float wide)
{
    lobe out = {.roughness = ref_clamp(roughness, E3D_LEAST_ROUGHNESS, 1.0f)};
    for (int c = 0; c < 3; c++)
        out.normal[c] = normal[c];
    float alpha = out.roughness * out.roughness;
    out.own = alpha * alpha;
    out.A = ref_min(out.own + wide, 1.0f);
    out.more = 2.0f * (out.A - out.own);
    if (wide > 0.0f)
        out.roughness = sqrtf(sqrtf(ref_min(out.own + wide * 0.25f, 1.0f)));
    out.facing = ref_dot3(normal, view);
    out.nv = ref_max(fabsf(out.facing), E3D_LEAST_COSINE);
    out.root = sqrtf(out.A + (1.0f - out.A) * (out.nv * out.nv));
    return out;
}

/* R50 and R217: D times V. */
static float reflect(const lobe *lobe, const half_vector *h, float nl)
{
    float k[3], nh = nl + lobe->facing;
    ref_cross(lobe->normal, h->h, k);
    float t = ref_dot3(k, k) + lobe->A * (nh * nh), q = (lobe->A * (nh * nh)) / t;
    float u = lobe->nv * sqrtf(lobe->A + (1.0f - lobe->A) * (nl * nl)) + nl * lobe->root;
    return nh > 0.0f ? (((lobe->own + lobe->more * q) * E3D_OVER_2PI) * (h->square * h->square)) / ((t * t) * u) : 0.0f;
}

static float fifth_power(float w)
{
    float w2 = w * w;
    return (w2 * w2) * w;
}

/* R141 */
static void find_iridescence(const ref_surface *s, sample *out)
{
    const ref_physical *p = &s->physical;
    const e3d_physical *m = &s->piece->primitive.material->physical;
    float other[3], metal[3], cosine = ref_min(out->base.nv, 1.0f);
    ref_iridescence(cosine, m->iridescence_ior, p->film_thickness, p->reflectance, other);
    ref_iridescence(cosine, m->iridescence_ior, p->film_thickness, s->albedo, metal);
    for (int c = 0; c < 3; c++)
        out->film[c] = other[c] + (metal[c] - other[c]) * p->metallic;
    out->film_top = ref_max(ref_max(other[0], other[1]), other[2]);
}

/* R49 */
static sample find_sample(const e3d_frame *frame, const ref_surface *s)
{
    const ref_physical *p = &s->physical;
    sample out = {.specular = p->specular};
    float m = p->metallic;
    ref_direction_to_eye(frame, s, out.view);
    out.base = make_lobe(s->world_normal, out.view, p->roughness, p->wide);
    out.coat = make_lobe(p->coat_normal, out.view, p->coat_roughness, p->coat_wide);
    for (int c = 0; c < 3; c++) {
        out.f0[c] = p->reflectance[c] + (s->albedo[c] - p->reflectance[c]) * m;
        out.diffuse[c] = (s->albedo[c] * (1.0f - m)) * E3D_OVER_PI;
        if (is_translucent(s)) /* R168 */
            out.diffuse[c] = out.diffuse[c] * (1.0f - p->diffuse_transmission);
        if (s->piece->primitive.material->physical.transmission != 0.0f) /* R134 */
            out.diffuse[c] = out.diffuse[c] * (1.0f - p->transmission);
    }
    out.f90 = p->specular + (1.0f - p->specular) * m;
    out.top = ref_max(ref_max(p->reflectance[0], p->reflectance[1]), p->reflectance[2]);
    float rough = ref_clamp(p->sheen_roughness, E3D_LEAST_SHEEN_ROUGHNESS, 1.0f);
    out.sheen_power = 1.0f / (rough * rough);
    if (is_iridescent(s))
        find_iridescence(s, &out);
    return out;
}

/* R53: D times V of the sheen. */
static float reflect_fuzz(const sample *at, const half_vector *h, float nl)
{
    float k[3], nv = ref_min(at->base.nv, 1.0f), i = at->sheen_power;
    ref_cross(at->base.normal, h->h, k);
    float x = ref_dot3(k, k) / h->square;
    float d = ((2.0f + i) * E3D_OVER_2PI) * ref_pow(x, i * 0.5f);
    return d * (1.0f / (4.0f * ((nl + nv) - nl * nv)));
}

static int has_sheen(const e3d_material *m) { return m->physical.sheen_color[0] != 0.0f || m->physical.sheen_color[1] != 0.0f ||
                                                     m->physical.sheen_color[2] != 0.0f; }

/* R50 or R137 */
static float reflect_base(const ref_surface *s, const sample *at, const half_vector *h, const float l[3], float nl)
{
    const lobe *base = &at->base;
    if (!is_anisotropic(s))
        return reflect(base, h, nl);
    return ref_reflect_stretched(&s->physical.stretch, base->roughness * base->roughness, at->view, base->nv, l, nl, h->h, h->square,
                                 nl + base->facing);
}

/* R51 */
static void add_light(const e3d_frame *frame, int32_t n, const ref_surface *s, const sample *at, sums *out)
{
    const e3d_light *light = &frame->lights[n];
    const e3d_material *material = s->piece->primitive.material;
    float l[3], attenuation;
    if (e3d_is_area_light(light->kind) || !ref_light_reach(light, s->lit_position, 1, l, &attenuation))
        return;
    float nl = ref_dot3(at->base.normal, l);
    if (!(nl > 0.0f))
        return;
    if (light->shadow.kind != E3D_SHADOW_NONE) {
        float reached = ref_light_reached(frame, n, s, l);
        if (!(reached > 0.0f))
            return;
        attenuation = attenuation * reached;
    }
    half_vector h;
    for (int c = 0; c < 3; c++)
        h.h[c] = l[c] + at->view[c];
    h.square = ref_dot3(h.h, h.h);
    float w5 = fifth_power(ref_max(1.0f - sqrtf(h.square) * 0.5f, 0.0f)), e = attenuation * nl;
    float top = at->top + (at->specular - at->top) * w5, d = reflect_base(s, at, &h, l, nl) * e;
    if (is_iridescent(s))
        top = top + (at->film_top - top) * s->physical.iridescence;
    float keep = (1.0f - top) * e;
    for (int c = 0; c < 3; c++) {
        float fresnel = at->f0[c] + (at->f90 - at->f0[c]) * w5;
        if (is_iridescent(s))
            fresnel = fresnel + (at->film[c] - fresnel) * s->physical.iridescence;
        out->direct[c] = out->direct[c] + light->color[c] * (at->diffuse[c] * keep + d * fresnel);
    }
    float coat_nl = ref_dot3(at->coat.normal, l);
    if (material->physical.clearcoat != 0.0f && coat_nl > 0.0f) {
        float coat = reflect(&at->coat, &h, coat_nl) * (attenuation * coat_nl);
        for (int c = 0; c < 3; c++)
            out->coat[c] = out->coat[c] + light->color[c] * coat;
    }
    if (has_sheen(material)) {
        float fuzz = reflect_fuzz(at, &h, nl) * e;
        for (int c = 0; c < 3; c++)
            out->fuzz[c] = out->fuzz[c] + light->color[c] * fuzz;
    }
}

/* ---- area lights (R237, R238) ---- */

/* R237: the share of an area light that a lobe reflects, before F. */
static float shine_of(const ref_area *turned, const ref_area_frame *axes, const lobe *lobe)
{
    return ref_area_shine(turned, axes, lobe->roughness) * E3D_OVER_2PI;
}

/* R237, with R138's normal if the lobe is anisotropic. */
static float shine_of_base(const e3d_light *light, const ref_surface *s, const sample *at, const ref_area_frame *axes,
                           const ref_area_lit *lit)
{
    ref_area_frame bent;
    ref_area area;
    float normal[3];
    if (!is_anisotropic(s))
        return shine_of(&lit->turned, axes, &at->base);
    ref_bend_normal(&s->physical.stretch, at->base.normal, at->view, at->base.roughness, normal);
    ref_find_area_frame(normal, at->view, &bent);
    ref_area_reach(light, s->lit_position, &area);
    ref_area_turn(&bent, &area);
    return shine_of(&area, &bent, &at->base);
}

/* R238 */
static void add_area_to_coat(const e3d_light *light, const ref_surface *s, const sample *at, const ref_area_lit *lit, sums *out)
{
    ref_area_frame axes;
    ref_area area;
    float a = ref_albedo(E3D_DFG_A, at->coat.roughness, at->coat.nv), b = ref_albedo(E3D_DFG_B, at->coat.roughness, at->coat.nv);
    ref_find_area_frame(at->coat.normal, at->view, &axes);
    ref_area_reach(light, s->lit_position, &area);
    ref_area_turn(&axes, &area);
    float coat = (shine_of(&area, &axes, &at->coat) * (a + b)) * lit->share;
    for (int c = 0; c < 3; c++)
        out->coat[c] = out->coat[c] + light->color[c] * coat;
}

static void add_area_light(const e3d_frame *frame, int32_t n, const ref_surface *s, const sample *at, const ref_area_frame *axes,
                           sums *out)
{
    const e3d_light *light = &frame->lights[n];
    const e3d_material *material = s->piece->primitive.material;
    float a = ref_albedo(E3D_DFG_A, at->base.roughness, at->base.nv), b = ref_albedo(E3D_DFG_B, at->base.roughness, at->base.nv);
    ref_area_lit lit;
    half_vector h;
    if (!ref_area_light(frame, n, s, axes, &lit))
        return;
    for (int c = 0; c < 3; c++)
        h.h[c] = lit.l[c] + at->view[c];
    h.square = ref_dot3(h.h, h.h);
    float w5 = fifth_power(ref_max(1.0f - sqrtf(h.square) * 0.5f, 0.0f)), top = at->top + (at->specular - at->top) * w5;
    if (is_iridescent(s))
        top = top + (at->film_top - top) * s->physical.iridescence;
    float keep = (1.0f - top) * lit.e, shine = shine_of_base(light, s, at, axes, &lit) * lit.share;
    for (int c = 0; c < 3; c++) {
        float albedo = at->f0[c] * (a + b) + (at->f90 - at->f0[c]) * b;
        if (is_iridescent(s))
            albedo = albedo + (at->film[c] * (a + b) - albedo) * s->physical.iridescence;
        out->direct[c] = out->direct[c] + light->color[c] * (at->diffuse[c] * keep + shine * albedo);
    }
    if (material->physical.clearcoat != 0.0f)
        add_area_to_coat(light, s, at, &lit, out);
    if (has_sheen(material)) {
        float fuzz = reflect_fuzz(at, &h, ref_dot3(at->base.normal, lit.l)) * lit.e;
        for (int c = 0; c < 3; c++)
            out->fuzz[c] = out->fuzz[c] + light->color[c] * fuzz;
    }
}

/* ---- light from all around ---- */

/* R141: F0 of the part that isn't metal, and of metal, under a film. */
static void find_f0(const ref_surface *s, float nv, float other[3], float metal[3])
{
    const ref_physical *p = &s->physical;
    const e3d_physical *m = &s->piece->primitive.material->physical;
    float film[3], f0[3], cosine = ref_min(nv, 1.0f);
    for (int c = 0; c < 3; c++) {
        other[c] = p->reflectance[c];
        metal[c] = s->albedo[c];
    }
    if (!is_iridescent(s))
        return;
    ref_iridescence(cosine, m->iridescence_ior, p->film_thickness, p->reflectance, film);
    ref_iridescence_f0(cosine, film, f0);
    for (int c = 0; c < 3; c++)
        other[c] = other[c] + (f0[c] - other[c]) * p->iridescence;
    ref_iridescence(cosine, m->iridescence_ior, p->film_thickness, s->albedo, film);
    ref_iridescence_f0(cosine, film, f0);
    for (int c = 0; c < 3; c++)
        metal[c] = metal[c] + (f0[c] - metal[c]) * p->iridescence;
}

/* R54: the radiance that a lobe mirrors. */
static void find_radiance(const e3d_frame *frame, const lobe *lobe, const float view[3], float out[3])
{
    float mirrored[3], more[3];
    for (int c = 0; c < 3; c++)
        mirrored[c] = lobe->normal[c] * (lobe->facing + lobe->facing) - view[c];
    ref_ambient(frame, mirrored, out);
    if (!frame->environment.environment)
        return;
    ref_environment_specular(&frame->environment, mirrored, lobe->roughness, more);
    for (int c = 0; c < 3; c++)
        out[c] = out[c] + more[c];
}

/* R55: a lobe under light that is 1 all around. once: the share that it reflects once; twice: a factor for light reflected
 * more often. */
typedef struct scattering {
    float once, twice, q;
} scattering;

/* R55 */
static scattering scatter(float f0, float f90, float a, float b)
{
    float y = f0 + (f90 - f0) * E3D_OVER_21, rest = 1.0f - (a + b), x = f0 * a + f90 * b;
    return (scattering){x, x * y, 1.0f - rest * y};
}

/* R168: turns the light on the other side into what of it shows on this side; reflected: x + z. */
static void let_through(const ref_surface *s, int c, float reflected, float light[3])
{
    const ref_physical *p = &s->physical;
    const e3d_physical *m = &s->piece->primitive.material->physical;
    float rest = m->transmission != 0.0f ? 1.0f - p->transmission : 1.0f;
    light[c] = ((light[c] * (p->passing[c] * (1.0f - reflected))) * (p->diffuse_transmission * rest)) * (1.0f - p->metallic);
    if (ref_absorbs(m))
        light[c] = light[c] * ref_exp2(p->body * m->absorption[c]);
}

/* R55; through: in, H of R169, and out, B of R168; used if the surface is translucent. */
static void find_indirect(const e3d_frame *frame, const ref_surface *s, const sample *at, const float irradiance[3], float through[3],
                          float out[3])
{
    const ref_physical *p = &s->physical;
    float radiance[3], a = ref_albedo(E3D_DFG_A, at->base.roughness, at->base.nv), b = ref_albedo(E3D_DFG_B, at->base.roughness, at->base.nv);
    float rest = 1.0f - (a + b), other_f0[3], metal_f0[3];
    lobe mirror = at->base;
    if (is_anisotropic(s)) {
        ref_bend_normal(&p->stretch, at->base.normal, at->view, at->base.roughness, mirror.normal);
        mirror.facing = ref_dot3(mirror.normal, at->view);
    }
    find_radiance(frame, &mirror, at->view, radiance);
    for (int c = 0; c < 3 && s->mirror > 0.0f; c++) /* R211 */
        radiance[c] = radiance[c] * (1.0f - s->mirror);
    find_f0(s, at->base.nv, other_f0, metal_f0);
    for (int c = 0; c < 3; c++) {
        float albedo = s->albedo[c];
        scattering metal = scatter(metal_f0[c], 1.0f, a, b), other = scatter(other_f0[c], p->specular, a, b);
        float r = 1.0f / (metal.q * other.q), zt = (metal.twice * (r * other.q)) * rest, zd = (other.twice * (r * metal.q)) * rest;
        float t = radiance[c] * metal.once + irradiance[c] * zt, below = albedo * (1.0f - (other.once + zd));
        if (is_translucent(s)) {
            below = below * (1.0f - p->diffuse_transmission);
            let_through(s, c, other.once + zd, through);
        }
        if (s->piece->primitive.material->physical.transmission != 0.0f) /* R134 */
            below = below * (1.0f - p->transmission);
        float d = (radiance[c] * other.once + irradiance[c] * zd) + irradiance[c] * below;
        out[c] = d + (t - d) * p->metallic;
    }
}

/* ---- all of it ---- */

/* R129 */
static float occlusion_of(const ref_surface *s) { return s->physical.occlusion * s->visibility; }

/* R56 */
static void add_sheen(const ref_surface *s, const sample *at, const float irradiance[3], const sums *lights, float color[3])
{
    const ref_physical *p = &s->physical;
    float rough = ref_clamp(p->sheen_roughness, E3D_LEAST_SHEEN_ROUGHNESS, 1.0f);
    float e = ref_albedo(E3D_DFG_SHEEN, rough, at->base.nv), most = ref_max(ref_max(p->sheen[0], p->sheen[1]), p->sheen[2]);
    for (int c = 0; c < 3; c++)
        color[c] = color[c] * (1.0f - most * e) + p->sheen[c] * (lights->fuzz[c] + (irradiance[c] * e) * occlusion_of(s));
}

/* R52 */
static float coat_share(const ref_surface *s, const lobe *coat)
{
    return s->physical.coat * (0.04f + 0.96f * fifth_power(1.0f - ref_min(coat->nv, 1.0f)));
}

/* R57 */
static void add_coat(const e3d_frame *frame, const ref_surface *s, const sample *at, const sums *lights, float color[3])
{
    float radiance[3], fc = coat_share(s, &at->coat);
    find_radiance(frame, &at->coat, at->view, radiance);
    for (int c = 0; c < 3; c++)
        color[c] = color[c] * (1.0f - fc) + fc * (lights->coat[c] + radiance[c] * occlusion_of(s));
}

void ref_light_physical(const e3d_frame *frame, const ref_surface *surface, float out[3])
{
    const e3d_material *material = surface->piece->primitive.material;
    sample at = find_sample(frame, surface);
    sums lights = {.direct = {0.0f}};
    float irradiance[3], indirect[3], through[3];
    ref_area_frame axes;
    ref_find_area_frame(surface->world_normal, at.view, &axes);
    for (int32_t n = 0; n < frame->light_count; n++)
        if (e3d_is_area_light(frame->lights[n].kind))
            add_area_light(frame, n, surface, &at, &axes, &lights);
    for (int32_t n = 0; n < frame->light_count; n++)
        add_light(frame, n, surface, &at, &lights);
    ref_irradiance(frame, surface->world_normal, irradiance);
    if (is_translucent(surface))
        ref_backlight(frame, surface, through);
    find_indirect(frame, surface, &at, irradiance, through, indirect);
    for (int c = 0; c < 3; c++) {
        out[c] = lights.direct[c] + indirect[c] * occlusion_of(surface);
        if (is_translucent(surface))
            out[c] = out[c] + through[c];
    }
    if (has_sheen(material))
        add_sheen(surface, &at, irradiance, &lights, out);
    for (int c = 0; c < 3; c++)
        out[c] = out[c] + surface->emissive[c];
    if (material->physical.clearcoat != 0.0f)
        add_coat(frame, surface, &at, &lights, out);
    for (int c = 0; c < 3; c++)
        out[c] = out[c] * frame->exposure;
}

/* ---- mirrors ---- */

/* R211 */
void ref_mirror_share(const e3d_frame *frame, const ref_surface *surface, float out[3])
{
    const sample at = find_sample(frame, surface);
    float w5 = fifth_power(1.0f - ref_min(at.base.nv, 1.0f));
    for (int c = 0; c < 3; c++) {
        out[c] = surface->mirror * (at.f0[c] + (at.f90 - at.f0[c]) * w5);
        if (surface->piece->primitive.material->physical.clearcoat != 0.0f)
            out[c] = out[c] * (1.0f - coat_share(surface, &at.coat));
    }
}

/* ---- what passes (R134) ---- */

void ref_light_behind(const ref_surface *s, const float view[3], float out[3])
{
    const ref_physical *p = &s->physical;
    const e3d_material *material = s->piece->primitive.material;
    lobe base = make_lobe(s->world_normal, view, p->roughness, p->wide), coat = make_lobe(p->coat_normal, view, p->coat_roughness, p->coat_wide);
    float a = ref_albedo(E3D_DFG_A, base.roughness, base.nv), b = ref_albedo(E3D_DFG_B, base.roughness, base.nv), rest = 1.0f - (a + b);
    float rough = ref_clamp(p->sheen_roughness, E3D_LEAST_SHEEN_ROUGHNESS, 1.0f), e = ref_albedo(E3D_DFG_SHEEN, rough, base.nv);
    float most = ref_max(ref_max(p->sheen[0], p->sheen[1]), p->sheen[2]);
    float fc = coat_share(s, &coat), other_f0[3], metal_f0[3];
    find_f0(s, base.nv, other_f0, metal_f0);
    for (int c = 0; c < 3; c++) {
        float albedo = s->albedo[c];
        scattering metal = scatter(metal_f0[c], 1.0f, a, b), other = scatter(other_f0[c], p->specular, a, b);
        float zd = (other.twice * ((1.0f / (metal.q * other.q)) * metal.q)) * rest, below = albedo * (1.0f - (other.once + zd));
        out[c] = (below * p->transmission) * (1.0f - p->metallic);
        if (has_sheen(material))
            out[c] = out[c] * (1.0f - most * e);
        if (material->physical.clearcoat != 0.0f)
            out[c] = out[c] * (1.0f - fc);
    }
}
