/* plan: chooses how a frame's tiles are drawn, by a table of conditions on what is asked for. */
#include <math.h>

#include "base/limits.h"
#include "data/mesh/mesh.h"
#include "data/shadow_maps/shadows.h"
#include "kernels/types/shading.h"
#include "frame/pass/plan.h"
#include "frame/pass/transmits.h"

/* ---- what is asked for ---- */

static int has_local_light(const e3d_frame *frame)
{
    for (int32_t n = 0; n < frame->light_count; n++)
        if (e3d_light_traits_of(frame->lights[n].kind).has_position)
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

static int has_mirrors(const e3d_frame *frame)
{
    for (int32_t m = 0; m < frame->material_count && frame->mirror_count > 0; m++)
        if (frame->materials[m].mirror > 0.0f)
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

/* A bit for each item that is asked for. */
typedef uint64_t asked_items;

static asked_items asked_if(int is_asked, e3d_asked_item item) { return (asked_items)(is_asked != 0) << item; }

static asked_items asked_outputs(const e3d_targets *t)
{
    asked_items asked = 0;
#define ASK(output, name, type, channels, background, what) asked |= asked_if(t->name != NULL, E3D_ASKED_##what);
    E3D_EACH_OUTPUT(ASK)
    return asked;
}

static asked_items asked_mode(const e3d_frame *f)
{
    switch (f->mode) {
    case E3D_MODE_LIT:
        return ASKED(LIT) | asked_if(has_local_light(f), E3D_ASKED_LOCAL_LIGHT) | asked_if(e3d_has_shadows(f), E3D_ASKED_SHADOWS) |
               asked_if(e3d_has_exact_shadows(f), E3D_ASKED_EXACT_SHADOWS) |
               asked_if(f->light_count > E3D_FEW_LIGHTS, E3D_ASKED_MANY_LIGHTS) |
               asked_if(e3d_has_area_lights(f), E3D_ASKED_AREA_LIGHTS) | asked_if(has_mirrors(f), E3D_ASKED_MIRRORS);
    case E3D_MODE_UNLIT: return ASKED(UNLIT);
    case E3D_MODE_DEPTH: return ASKED(DEPTH_MODE);
    case E3D_MODE_NORMAL: return ASKED(NORMAL_MODE);
    case E3D_MODE_OVERDRAW: return ASKED(OVERDRAW_MODE);
    case E3D_MODE_RANDOM:
    case E3D_MODE_FACE_ID:
    case E3D_MODE_OBJECT_ID: break;
    }
    return 0;
}

static asked_items asked_wireframe(const e3d_frame *f)
{
    if (f->wireframe == E3D_WIRE_NONE)
        return 0;
    if (f->wireframe == E3D_WIRE_OVERLAY)
        return ASKED(WIREFRAME);
    return ASKED(WIREFRAME) | ASKED(WIRE_ONLY) | asked_if(f->remove_hidden_lines, E3D_ASKED_HIDDEN_LINES) |
           asked_if(has_lines(f), E3D_ASKED_LINES);
}

static asked_items asked_for(const e3d_frame *f, const e3d_targets *targets)
{
    int64_t a_pixel = f->msaa_samples ? f->msaa_samples : (int64_t)f->samples_axis * f->samples_axis, samples = a_pixel * f->width * f->height;
    return asked_outputs(targets) | asked_mode(f) | asked_wireframe(f) | asked_if(f->hidden == E3D_HIDDEN_ZBUFFER, E3D_ASKED_ZBUFFER) |
           asked_if(has_mapped_normals(f), E3D_ASKED_MAPPED_NORMALS) | asked_if(f->shading == E3D_SHADING_FORWARD, E3D_ASKED_FORWARD) |
           asked_if(f->encode_srgb, E3D_ASKED_SRGB) | asked_if(e3d_culls_parts(f), E3D_ASKED_OCCLUSION) |
           asked_if(has_alpha(f), E3D_ASKED_ALPHA) | asked_if(f->transparent_outputs, E3D_ASKED_TRANSPARENT_OUTPUTS) |
           asked_if(f->frozen_clip_from_world != NULL, E3D_ASKED_OTHER_FRUSTUM) |
           asked_if(e3d_shows_environment(f) || f->gradient.shows, E3D_ASKED_BACKDROP) |
           asked_if(e3d_has_light_or_color(f) && f->fog.kind != E3D_FOG_NONE, E3D_ASKED_FOG) | asked_if(samples > E3D_MOST_KEPT_SAMPLES, E3D_ASKED_HUGE) |
           asked_if(f->msaa_samples, E3D_ASKED_MULTISAMPLING) | asked_if(f->opaque_only, E3D_ASKED_OPAQUE_ONLY) |
           asked_if(f->behind != NULL, E3D_ASKED_BEHIND);
}

/* ---- what is done about it ---- */

const e3d_plan_condition E3D_PLAN_CONDITIONS[] = {
    {E3D_PLAN_COLORS, .asked = ASKED(COLOR), .unless_asked = ASKED(OVERDRAW_MODE)},
    {E3D_PLAN_COLORS, .asked = ASKED(RADIANCE), .unless_asked = ASKED(OVERDRAW_MODE)},
    {E3D_PLAN_OUTPUTS, .asked = ASKED(POSITIONS)},
    {E3D_PLAN_OUTPUTS, .asked = ASKED(NORMALS)},
    {E3D_PLAN_OUTPUTS, .asked = ASKED(UVS)},
    {E3D_PLAN_OUTPUTS, .asked = ASKED(ALBEDO)},
    {E3D_PLAN_OUTPUTS, .asked = ASKED(IDENTITIES)},
    {E3D_PLAN_OUTPUTS, .asked = ASKED(BARYCENTRIC)},
    {E3D_PLAN_OUTPUTS, .asked = ASKED(MATERIALS)},
    {E3D_PLAN_OUTPUTS, .asked = ASKED(TANGENTS)},
    {E3D_PLAN_OUTPUTS, .asked = ASKED(RADIANCE)},
    {E3D_PLAN_IDENTIFIES, .asked = ASKED(IDENTITIES) | ASKED(ZBUFFER),
     .unless_asked = ASKED(COLOR) | ASKED(RADIANCE) | ASKED(POSITIONS) | ASKED(NORMALS) | ASKED(UVS) |
                     ASKED(ALBEDO) | ASKED(BARYCENTRIC) | ASKED(MATERIALS) | ASKED(TANGENTS) | ASKED(MULTISAMPLING)},
    {E3D_PLAN_SHADES, .planned = PLAN(COLORS)},
    {E3D_PLAN_SHADES, .planned = PLAN(OUTPUTS), .unless_planned = PLAN(IDENTIFIES)},
    {E3D_PLAN_POSITION, .asked = ASKED(LIT) | ASKED(LOCAL_LIGHT), .planned = PLAN(COLORS)},
    {E3D_PLAN_POSITION, .asked = ASKED(LIT) | ASKED(SHADOWS), .planned = PLAN(COLORS)},
    {E3D_PLAN_POSITION, .asked = ASKED(LIT) | ASKED(MIRRORS), .planned = PLAN(COLORS)},
    {E3D_PLAN_POSITION, .asked = ASKED(DEPTH_MODE), .planned = PLAN(COLORS)},
    {E3D_PLAN_POSITION, .asked = ASKED(FOG), .planned = PLAN(COLORS)},
    {E3D_PLAN_POSITION, .asked = ASKED(POSITIONS)},
    {E3D_PLAN_NORMAL, .asked = ASKED(LIT), .planned = PLAN(COLORS)},
    {E3D_PLAN_NORMAL, .asked = ASKED(NORMAL_MODE), .planned = PLAN(COLORS)},
    {E3D_PLAN_NORMAL, .asked = ASKED(NORMALS)},
    {E3D_PLAN_TANGENT, .asked = ASKED(TANGENTS)},
    {E3D_PLAN_NORMAL, .planned = PLAN(TANGENT)},
    {E3D_PLAN_POSITION, .planned = PLAN(TANGENT)}, /* a face's tangent is found by it */
    {E3D_PLAN_POSITION, .asked = ASKED(MAPPED_NORMALS), .planned = PLAN(NORMAL)},
    {E3D_PLAN_UV, .asked = ASKED(UVS)},
    {E3D_PLAN_WEIGHTS, .asked = ASKED(BARYCENTRIC)},
    {E3D_PLAN_BASE_COLOR, .asked = ASKED(LIT), .planned = PLAN(COLORS)},
    {E3D_PLAN_BASE_COLOR, .asked = ASKED(UNLIT), .planned = PLAN(COLORS)},
    {E3D_PLAN_BASE_COLOR, .asked = ASKED(ALBEDO)},
    {E3D_PLAN_MATERIAL_VALUES, .asked = ASKED(MATERIALS)},
    {E3D_PLAN_ADDS_FOG, .asked = ASKED(FOG), .planned = PLAN(COLORS)},
    {E3D_PLAN_KEEPS_RADIANCE, .asked = ASKED(RADIANCE), .planned = PLAN(COLORS)},
    {E3D_PLAN_FACES, .unless_asked = ASKED(WIRE_ONLY)},
    {E3D_PLAN_FACES, .asked = ASKED(HIDDEN_LINES)},
    {E3D_PLAN_FACES, .asked = ASKED(LINES)}, /* faces hide, whether they are drawn or not (R36) */
    {E3D_PLAN_FACES, .planned = PLAN(OUTPUTS)},
    {E3D_PLAN_FACES, .asked = ASKED(NDC_DEPTH)},
    {E3D_PLAN_SORTS, .unless_asked = ASKED(ZBUFFER)},
    {E3D_PLAN_ALPHA_BINS, .asked = ASKED(ALPHA)},
    {E3D_PLAN_BLENDS, .asked = ASKED(ALPHA) | ASKED(LIT), .planned = PLAN(COLORS), .unless_asked = ASKED(OPAQUE_ONLY)},
    {E3D_PLAN_BLENDS, .asked = ASKED(ALPHA) | ASKED(UNLIT), .planned = PLAN(COLORS), .unless_asked = ASKED(OPAQUE_ONLY)},
    {E3D_PLAN_BENDS, .asked = ASKED(BEHIND) | ASKED(LIT) | ASKED(ZBUFFER), .planned = PLAN(BLENDS), .unless_asked = ASKED(WIRE_ONLY)},
    {E3D_PLAN_SOLID, .asked = ASKED(ALPHA), .unless_asked = ASKED(LIT) | ASKED(UNLIT)},
    {E3D_PLAN_SOLID, .asked = ASKED(ALPHA) | ASKED(TRANSPARENT_OUTPUTS), .unless_planned = PLAN(COLORS),
     .unless_asked = ASKED(OPAQUE_ONLY)},
    {E3D_PLAN_FRONT, .asked = ASKED(TRANSPARENT_OUTPUTS), .planned = PLAN(BLENDS) | PLAN(OUTPUTS)},
    {E3D_PLAN_FRONT, .asked = ASKED(NDC_DEPTH) | ASKED(TRANSPARENT_OUTPUTS), .planned = PLAN(BLENDS)},
    /* alpha tests and blending come last */
    {E3D_PLAN_AT_ONCE, .asked = ASKED(FORWARD), .planned = PLAN(SHADES),
     .unless_asked = ASKED(ALPHA) | ASKED(MULTISAMPLING)},
    {E3D_PLAN_SLOTS, .planned = PLAN(SORTS)},
    {E3D_PLAN_SLOTS, .planned = PLAN(AT_ONCE)},
    {E3D_PLAN_DEPTHS, .asked = ASKED(NDC_DEPTH)},
    {E3D_PLAN_DEPTHS, .asked = ASKED(WIREFRAME)},
    {E3D_PLAN_FRAGMENTS, .unless_asked = ASKED(OVERDRAW_MODE) | ASKED(WIREFRAME) | ASKED(MULTISAMPLING),
     .unless_planned = PLAN(SLOTS)},
    {E3D_PLAN_SPANS, .planned = PLAN(SHADES), .unless_asked = ASKED(MULTISAMPLING),
     .unless_planned = PLAN(SLOTS) | PLAN(DEPTHS)},
    {E3D_PLAN_SPANS, .planned = PLAN(IDENTIFIES), .unless_planned = PLAN(DEPTHS)},
    {E3D_PLAN_LISTS, .planned = PLAN(SHADES), .unless_asked = ASKED(MULTISAMPLING),
     .unless_planned = PLAN(SLOTS)},
    {E3D_PLAN_REFLECTS, .asked = ASKED(LIT) | ASKED(MIRRORS), .planned = PLAN(COLORS)},
    {E3D_PLAN_FINDS_EXACT_SHADOWS, .asked = ASKED(EXACT_SHADOWS), .planned = PLAN(COLORS)},
    {E3D_PLAN_ADDS_AREA_LIGHTS, .asked = ASKED(LIT) | ASKED(AREA_LIGHTS), .planned = PLAN(COLORS)},
    {E3D_PLAN_PAINTS, .asked = ASKED(LIT), .planned = PLAN(COLORS), .unless_asked = ASKED(MANY_LIGHTS),
     .unless_planned = PLAN(OUTPUTS) | PLAN(FINDS_EXACT_SHADOWS) | PLAN(ADDS_AREA_LIGHTS)},
    {E3D_PLAN_PAINTS, .asked = ASKED(UNLIT), .planned = PLAN(COLORS), .unless_planned = PLAN(OUTPUTS)},
    {E3D_PLAN_ROUNDS, .asked = ASKED(OCCLUSION), .planned = PLAN(FACES),
     .unless_asked = ASKED(OVERDRAW_MODE) | ASKED(OTHER_FRUSTUM) | ASKED(HUGE), .unless_planned = PLAN(SLOTS)},
    {E3D_PLAN_FINISHES, .planned = PLAN(ROUNDS), .unless_asked = ASKED(WIREFRAME) | ASKED(ALPHA)},
    {E3D_PLAN_COUNTS_OVERDRAW, .asked = ASKED(COLOR) | ASKED(OVERDRAW_MODE), .unless_asked = ASKED(WIRE_ONLY)},
    {E3D_PLAN_EDGES, .asked = ASKED(COLOR) | ASKED(WIREFRAME)},
    {E3D_PLAN_EDGES_ALONE, .asked = ASKED(WIRE_ONLY)},
    {E3D_PLAN_EDGE_DEPTHS, .asked = ASKED(ZBUFFER), .planned = PLAN(EDGES), .unless_asked = ASKED(WIRE_ONLY)},
    {E3D_PLAN_EDGE_DEPTHS, .asked = ASKED(ZBUFFER) | ASKED(HIDDEN_LINES), .planned = PLAN(EDGES)},
    {E3D_PLAN_BACKDROP, .asked = ASKED(COLOR) | ASKED(BACKDROP)},
    {E3D_PLAN_ENCODES_SRGB, .asked = ASKED(SRGB) | ASKED(LIT), .planned = PLAN(COLORS)},
    {E3D_PLAN_ENCODES_SRGB, .asked = ASKED(SRGB) | ASKED(UNLIT), .planned = PLAN(COLORS)},
};
const int E3D_PLAN_CONDITION_COUNT = (int)(sizeof E3D_PLAN_CONDITIONS / sizeof *E3D_PLAN_CONDITIONS);

static int holds(const e3d_plan_condition *condition, asked_items asked, e3d_plan plan)
{
    return (asked & condition->asked) == condition->asked && (plan & condition->planned) == condition->planned && !(asked & condition->unless_asked) &&
           !(plan & condition->unless_planned);
}

e3d_plan e3d_plan_of(const e3d_frame *frame, const e3d_targets *targets)
{
    asked_items asked = asked_for(frame, targets);
    e3d_plan plan = 0;
    for (int r = 0; r < E3D_PLAN_CONDITION_COUNT; r++)
        if (holds(&E3D_PLAN_CONDITIONS[r], asked, plan))
            plan |= UINT64_C(1) << E3D_PLAN_CONDITIONS[r].item;
    return plan;
}

int e3d_plan_inputs(e3d_plan plan)
{
    return (e3d_plan_has(plan, E3D_PLAN_POSITION) ? E3D_WANT_POSITION : 0) |
           (e3d_plan_has(plan, E3D_PLAN_NORMAL) ? E3D_WANT_NORMAL : 0) | (e3d_plan_has(plan, E3D_PLAN_UV) ? E3D_WANT_UV : 0) |
           (e3d_plan_has(plan, E3D_PLAN_WEIGHTS) ? E3D_WANT_WEIGHTS : 0);
}

/* ---- what it is called ---- */

#define WORD(name, text) {#name, text},

const e3d_plan_word E3D_ASKED_WORDS[] = {E3D_ASKED_FOR(WORD)};
const e3d_plan_word E3D_PLAN_WORDS[] = {E3D_PLANNED(WORD)};

const char *e3d_plan_step(int32_t bit) { return bit < E3D_PLAN_ITEMS ? E3D_PLAN_WORDS[bit].name : NULL; }
