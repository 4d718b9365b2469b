/* plan: which ways a frame's tiles take, by a table of rules over what is asked for. */
#include <math.h>

#include "core/limits.h"
#include "core/mesh.h"
#include "core/shadows.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/transmits.h"

/* ---- what is asked for ---- */

static int has_local_light(const e3d_frame *frame)
{
    for (int32_t n = 0; n < frame->light_count; n++)
        if (frame->lights[n].kind != E3D_LIGHT_DIRECTIONAL)
            return 1;
    for (int32_t m = 0; m < frame->material_count; m++)
        if (e3d_adds(frame->materials[m].specular) || frame->materials[m].is_physical)
            return 1;
    return 0;
}

static int has_mapped_normals(const e3d_frame *frame)
{
    for (int32_t m = 0; m < frame->material_count; m++)
        if (frame->materials[m].normal_texture.texture)
            return 1;
    return 0;
}

static int has_alpha(const e3d_frame *frame)
{
    for (int32_t m = 0; m < frame->material_count; m++)
        if (e3d_is_seen_through(frame, &frame->materials[m]))
            return 1;
    return 0;
}

static int has_lines(const e3d_frame *frame)
{
    for (int32_t d = 0; d < frame->draw_count; d++)
        if (frame->draws[d].mesh->desc.lines_count || frame->draws[d].mesh->desc.points_count)
            return 1;
    return 0;
}

#define ASKED(name) (UINT64_C(1) << E3D_ASKED_##name)
#define PLAN(name) (UINT64_C(1) << E3D_PLAN_##name)

static e3d_plan asked_if(int is_asked, e3d_plan_item item) { return (e3d_plan)(is_asked != 0) << item; }

static e3d_plan asked_outputs(const e3d_targets *t)
{
    e3d_plan asked = 0;
#define ASK(output, name, type, channels, background, what) asked |= asked_if(t->name != NULL, E3D_ASKED_##what);
    E3D_EACH_OUTPUT(ASK)
    return asked;
}

static e3d_plan asked_mode(const e3d_frame *f)
{
    switch (f->mode) {
    case E3D_MODE_LIT:
        return ASKED(LIT) | asked_if(has_local_light(f), E3D_ASKED_LOCAL_LIGHT) | asked_if(e3d_has_shadows(f), E3D_ASKED_SHADOWS) |
               asked_if(e3d_has_exact_shadows(f), E3D_ASKED_EXACT_SHADOWS) |
               asked_if(f->light_count > E3D_FEW_LIGHTS, E3D_ASKED_MANY_LIGHTS);
    case E3D_MODE_UNLIT: return ASKED(UNLIT);
    case E3D_MODE_DEPTH: return ASKED(DEPTH_MODE);
    case E3D_MODE_NORMAL: return ASKED(NORMAL_MODE);
    case E3D_MODE_OVERDRAW: return ASKED(OVERDRAW_MODE);
    case E3D_MODE_RANDOM:
    case E3D_MODE_TRIANGLE_ID:
    case E3D_MODE_OBJECT_ID: break;
    }
    return 0;
}

static e3d_plan asked_wireframe(const e3d_frame *f)
{
    if (f->wireframe == E3D_WIRE_NONE)
        return 0;
    if (f->wireframe == E3D_WIRE_OVERLAY)
        return ASKED(WIREFRAME);
    return ASKED(WIREFRAME) | ASKED(WIRE_ONLY) | asked_if(f->remove_hidden_lines, E3D_ASKED_HIDDEN_LINES) |
           asked_if(has_lines(f), E3D_ASKED_LINES);
}

static e3d_plan asked_for(const e3d_frame *f, const e3d_targets *targets)
{
    int64_t a_pixel = f->msaa_samples ? f->msaa_samples : (int64_t)f->samples_axis * f->samples_axis, samples = a_pixel * f->width * f->height;
    return asked_outputs(targets) | asked_mode(f) | asked_wireframe(f) | asked_if(f->hidden == E3D_HIDDEN_ZBUFFER, E3D_ASKED_ZBUFFER) |
           asked_if(has_mapped_normals(f), E3D_ASKED_MAPPED_NORMALS) | asked_if(f->shading == E3D_SHADING_FORWARD, E3D_ASKED_FORWARD) |
           asked_if(f->encode_srgb, E3D_ASKED_SRGB) | asked_if(e3d_culls_parts(f), E3D_ASKED_OCCLUSION) |
           asked_if(has_alpha(f), E3D_ASKED_ALPHA) | asked_if(f->transparent_outputs, E3D_ASKED_TRANSPARENT_OUTPUTS) |
           asked_if(f->frozen_clip_from_world != NULL, E3D_ASKED_OTHER_FRUSTUM) |
           asked_if(e3d_shows_environment(f) || f->gradient.shows, E3D_ASKED_BACKDROP) |
           asked_if(e3d_has_light_or_color(f) && f->fog.kind != E3D_FOG_NONE, E3D_ASKED_FOG) | asked_if(samples > E3D_MOST_KEPT_SAMPLES, E3D_ASKED_HUGE) |
           asked_if(f->msaa_samples, E3D_ASKED_MULTISAMPLING);
}

/* ---- what is done about it ---- */

const e3d_plan_rule E3D_PLAN_RULES[] = {
    {E3D_PLAN_COLORS, ASKED(COLOR), ASKED(OVERDRAW_MODE)},
    {E3D_PLAN_COLORS, ASKED(RADIANCE), ASKED(OVERDRAW_MODE)},
    {E3D_PLAN_OUTPUTS, ASKED(POSITIONS), 0},
    {E3D_PLAN_OUTPUTS, ASKED(NORMALS), 0},
    {E3D_PLAN_OUTPUTS, ASKED(UVS), 0},
    {E3D_PLAN_OUTPUTS, ASKED(ALBEDO), 0},
    {E3D_PLAN_OUTPUTS, ASKED(IDENTITIES), 0},
    {E3D_PLAN_OUTPUTS, ASKED(BARYCENTRIC), 0},
    {E3D_PLAN_OUTPUTS, ASKED(MATERIALS), 0},
    {E3D_PLAN_OUTPUTS, ASKED(TANGENTS), 0},
    {E3D_PLAN_OUTPUTS, ASKED(RADIANCE), 0},
    {E3D_PLAN_IDENTIFIES, ASKED(IDENTITIES) | ASKED(ZBUFFER),
     ASKED(COLOR) | ASKED(RADIANCE) | ASKED(POSITIONS) | ASKED(NORMALS) | ASKED(UVS) | ASKED(ALBEDO) | ASKED(BARYCENTRIC) |
         ASKED(MATERIALS) | ASKED(TANGENTS) | ASKED(MULTISAMPLING)},
    {E3D_PLAN_SHADES, PLAN(COLORS), 0},
    {E3D_PLAN_SHADES, PLAN(OUTPUTS), PLAN(IDENTIFIES)},
    {E3D_PLAN_POSITION, PLAN(COLORS) | ASKED(LIT) | ASKED(LOCAL_LIGHT), 0},
    {E3D_PLAN_POSITION, PLAN(COLORS) | ASKED(LIT) | ASKED(SHADOWS), 0},
    {E3D_PLAN_POSITION, PLAN(COLORS) | ASKED(DEPTH_MODE), 0},
    {E3D_PLAN_POSITION, PLAN(COLORS) | ASKED(FOG), 0},
    {E3D_PLAN_POSITION, ASKED(POSITIONS), 0},
    {E3D_PLAN_NORMAL, PLAN(COLORS) | ASKED(LIT), 0},
    {E3D_PLAN_NORMAL, PLAN(COLORS) | ASKED(NORMAL_MODE), 0},
    {E3D_PLAN_NORMAL, ASKED(NORMALS), 0},
    {E3D_PLAN_NORMAL, ASKED(TANGENTS), 0},
    {E3D_PLAN_POSITION, ASKED(TANGENTS), 0}, /* by which a face's tangent is found */
    {E3D_PLAN_POSITION, PLAN(NORMAL) | ASKED(MAPPED_NORMALS), 0},
    {E3D_PLAN_UV, ASKED(UVS), 0},
    {E3D_PLAN_BASE_COLOR, PLAN(COLORS) | ASKED(LIT), 0},
    {E3D_PLAN_BASE_COLOR, PLAN(COLORS) | ASKED(UNLIT), 0},
    {E3D_PLAN_BASE_COLOR, ASKED(ALBEDO), 0},
    {E3D_PLAN_FACES, 0, ASKED(WIRE_ONLY)},
    {E3D_PLAN_FACES, ASKED(HIDDEN_LINES), 0},
    {E3D_PLAN_FACES, ASKED(LINES), 0}, /* which faces hide, drawn or not (R36) */
    {E3D_PLAN_FACES, PLAN(OUTPUTS), 0},
    {E3D_PLAN_FACES, ASKED(NDC_DEPTH), 0},
    {E3D_PLAN_SORTS, 0, ASKED(ZBUFFER)},
    {E3D_PLAN_BLENDS, PLAN(COLORS) | ASKED(ALPHA) | ASKED(LIT), 0},
    {E3D_PLAN_BLENDS, PLAN(COLORS) | ASKED(ALPHA) | ASKED(UNLIT), 0},
    {E3D_PLAN_SOLID, ASKED(ALPHA), ASKED(LIT) | ASKED(UNLIT)},
    {E3D_PLAN_SOLID, ASKED(ALPHA) | ASKED(TRANSPARENT_OUTPUTS), PLAN(COLORS)},
    {E3D_PLAN_FRONT, PLAN(BLENDS) | PLAN(OUTPUTS) | ASKED(TRANSPARENT_OUTPUTS), 0},
    {E3D_PLAN_FRONT, PLAN(BLENDS) | ASKED(NDC_DEPTH) | ASKED(TRANSPARENT_OUTPUTS), 0},
    {E3D_PLAN_AT_ONCE, PLAN(SHADES) | ASKED(FORWARD), ASKED(ALPHA) | ASKED(MULTISAMPLING)}, /* what is cut out or laid over is known last */
    {E3D_PLAN_SLOTS, PLAN(SORTS), 0},
    {E3D_PLAN_SLOTS, PLAN(AT_ONCE), 0},
    {E3D_PLAN_DEPTHS, ASKED(NDC_DEPTH), 0},
    {E3D_PLAN_DEPTHS, ASKED(WIREFRAME), 0},
    {E3D_PLAN_FRAGMENTS, 0, PLAN(SLOTS) | ASKED(OVERDRAW_MODE) | ASKED(WIREFRAME) | ASKED(MULTISAMPLING)},
    {E3D_PLAN_SPANS, PLAN(SHADES), PLAN(SLOTS) | PLAN(DEPTHS) | ASKED(MULTISAMPLING)},
    {E3D_PLAN_SPANS, PLAN(IDENTIFIES), PLAN(DEPTHS)},
    {E3D_PLAN_LISTS, PLAN(SHADES), PLAN(SLOTS) | ASKED(MULTISAMPLING)},
    {E3D_PLAN_HIDES, PLAN(COLORS) | ASKED(EXACT_SHADOWS), 0},
    {E3D_PLAN_PAINTS, PLAN(COLORS) | ASKED(LIT), PLAN(OUTPUTS) | ASKED(MANY_LIGHTS) | PLAN(HIDES)},
    {E3D_PLAN_PAINTS, PLAN(COLORS) | ASKED(UNLIT), PLAN(OUTPUTS)},
    {E3D_PLAN_ROUNDS, PLAN(FACES) | ASKED(OCCLUSION),
     PLAN(SLOTS) | ASKED(OVERDRAW_MODE) | ASKED(OTHER_FRUSTUM) | ASKED(HUGE)},
    {E3D_PLAN_FINISHES, PLAN(ROUNDS), ASKED(WIREFRAME) | ASKED(ALPHA)},
    {E3D_PLAN_COUNTS_OVERDRAW, ASKED(COLOR) | ASKED(OVERDRAW_MODE), ASKED(WIRE_ONLY)},
    {E3D_PLAN_EDGES, ASKED(COLOR) | ASKED(WIREFRAME), 0},
    {E3D_PLAN_EDGE_DEPTHS, PLAN(EDGES) | ASKED(ZBUFFER), ASKED(WIRE_ONLY)},
    {E3D_PLAN_EDGE_DEPTHS, PLAN(EDGES) | ASKED(ZBUFFER) | ASKED(HIDDEN_LINES), 0},
    {E3D_PLAN_BACKDROP, ASKED(COLOR) | ASKED(BACKDROP), 0},
    {E3D_PLAN_ENCODES_SRGB, PLAN(COLORS) | ASKED(SRGB) | ASKED(LIT), 0},
    {E3D_PLAN_ENCODES_SRGB, PLAN(COLORS) | ASKED(SRGB) | ASKED(UNLIT), 0},
};
const int E3D_PLAN_RULE_COUNT = (int)(sizeof E3D_PLAN_RULES / sizeof *E3D_PLAN_RULES);

e3d_plan e3d_plan_of(const e3d_frame *frame, const e3d_targets *targets)
{
    e3d_plan plan = asked_for(frame, targets);
    for (int r = 0; r < E3D_PLAN_RULE_COUNT; r++) {
        const e3d_plan_rule *rule = &E3D_PLAN_RULES[r];
        if ((plan & rule->all) == rule->all && !(plan & rule->none))
            plan |= UINT64_C(1) << rule->item;
    }
    return plan;
}

int e3d_plan_inputs(e3d_plan plan)
{
    return (e3d_plan_has(plan, E3D_PLAN_POSITION) ? E3D_WANT_POSITION : 0) |
           (e3d_plan_has(plan, E3D_PLAN_NORMAL) ? E3D_WANT_NORMAL : 0) | (e3d_plan_has(plan, E3D_PLAN_UV) ? E3D_WANT_UV : 0);
}

/* ---- what it is called ---- */

#define NAME(name, text) #name,
#define TEXT(name, text) text,

const char *e3d_plan_name(e3d_plan_item item)
{
    static const char *const NAMES[E3D_PLAN_ITEMS] = {E3D_ASKED_FOR(NAME) E3D_PLANNED(NAME)};
    return NAMES[item];
}

const char *e3d_plan_step(int32_t bit)
{
    return bit < E3D_PLAN_ITEMS - E3D_PLAN_FIRST ? e3d_plan_name((e3d_plan_item)(E3D_PLAN_FIRST + bit)) : NULL;
}

const char *e3d_plan_text(e3d_plan_item item)
{
    static const char *const TEXTS[E3D_PLAN_ITEMS] = {E3D_ASKED_FOR(TEXT) E3D_PLANNED(TEXT)};
    return TEXTS[item];
}
