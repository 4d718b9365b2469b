/* The plan of a frame: it says what a frame asks for, and derives once how its tiles are drawn. */
#pragma once

#include <stdint.h>

#include "e3d.h"

/* Tiles are not kept over rounds if the frame has more samples: keeping takes 8 bytes a sample. */
#define E3D_MOST_KEPT_SAMPLES (1 << 25)

/* What a frame may ask for: X(name, description). */
#define E3D_ASKED_FOR(X) \
    X(COLOR, "the colour output") \
    X(NDC_DEPTH, "the output ndc_depth") \
    X(POSITIONS, "an output of positions or metric depths") \
    X(NORMALS, "an output of normals") \
    X(UVS, "the output uv") \
    X(ALBEDO, "the output albedo") \
    X(IDENTITIES, "an output of IDs") \
    X(BARYCENTRIC, "the output barycentric") \
    X(MATERIALS, "the outputs metallic_roughness or emissive") \
    X(TANGENTS, "the output tangent") \
    X(LIT, "mode lit") \
    X(UNLIT, "mode unlit") \
    X(DEPTH_MODE, "mode depth") \
    X(NORMAL_MODE, "mode normal") \
    X(OVERDRAW_MODE, "mode overdraw") \
    X(LOCAL_LIGHT, "light that depends on the position: point lights or highlights") \
    X(MAPPED_NORMALS, "a texture of normals") \
    X(MANY_LIGHTS, "more than 4 lights") \
    X(AREA_LIGHTS, "lights with a surface: rectangles, discs, tubes") \
    X(WIREFRAME, "a wireframe, with or without the faces") \
    X(WIRE_ONLY, "a wireframe without the faces") \
    X(HIDDEN_LINES, "that faces hide the edges behind them in a wireframe without them") \
    X(LINES, "lines or points in a wireframe without the faces") \
    X(ZBUFFER, "that the nearest surface shows") \
    X(FORWARD, "forward shading") \
    X(SRGB, "the sRGB encoder") \
    X(OCCLUSION, "that what is hidden is left out") \
    X(ALPHA, "materials that are masked or blended, or that light passes through") \
    X(TRANSPARENT_OUTPUTS, "other outputs of the nearest surface, blended or not") \
    X(OTHER_FRUSTUM, "what the frustum of another camera holds") \
    X(BACKDROP, "an environment, where there is light or plain colour, or a gradient as the background") \
    X(FOG, "fog") \
    X(RADIANCE, "the output radiance") \
    X(HUGE, "more samples than tiles are kept for") \
    X(SHADOWS, "lights that have shadows") \
    X(EXACT_SHADOWS, "lights that have exact shadows") \
    X(MULTISAMPLING, "several samples a pixel, of which each surface is shaded once") \
    X(MIRRORS, "mirrors, and materials that show them") \
    X(OPAQUE_ONLY, "that what is blended is left out") \
    X(BEHIND, "that glass bends or blurs a picture of what is behind it")

/* What is done for it: X(name, description). */
#define E3D_PLANNED(X) \
    X(COLORS, "visible samples get colours") \
    X(OUTPUTS, "visible samples get other outputs") \
    X(IDENTIFIES, "IDs are found straight from the visible samples, since depths are all else that is asked for") \
    X(SHADES, "visible samples are shaded at all") \
    X(POSITION, "shading needs the position") \
    X(NORMAL, "shading needs the normal") \
    X(UV, "shading needs the texture coordinates") \
    X(WEIGHTS, "shading needs the barycentric weights") \
    X(TANGENT, "shading needs the tangent") \
    X(BASE_COLOR, "shading needs the surface's own colour") \
    X(MATERIAL_VALUES, "shading finds what materials are made of at each sample") \
    X(ADDS_FOG, "fog lies over what shows") \
    X(KEEPS_RADIANCE, "the light of samples is stored beside their colours") \
    X(FACES, "faces are drawn, not only counted") \
    X(SORTS, "records are sorted before they are binned, and the last one shows") \
    X(ALPHA_BINS, "records with alpha go to bins of their own") \
    X(BLENDS, "blended layers are laid over what is behind them") \
    X(BENDS, "layers of glass are added up before they are blended, since they bend what is behind all of them") \
    X(SOLID, "blended faces show wherever their alpha isn't 0, as masked ones do") \
    X(FRONT, "outputs are those of the nearest blended layer, where there is one") \
    X(AT_ONCE, "each record is shaded at once, where it is the nearest so far") \
    X(SLOTS, "a tile draws record after record; its samples keep slots instead of IDs") \
    X(DEPTHS, "the depth of every sample is needed, not only the ID") \
    X(FRAGMENTS, "micro-triangles go to the tiles as samples") \
    X(SPANS, "tiles of few records may be drawn without depths") \
    X(LISTS, "tiles may list visible samples by record instead of by row") \
    X(REFLECTS, "mirrors show their pictures") \
    X(FINDS_EXACT_SHADOWS, "exact shadows are found on visible samples, light by light") \
    X(ADDS_AREA_LIGHTS, "the light of rectangles, discs and tubes is found before that of other lights") \
    X(PAINTS, "one kernel takes samples from the surface to the encoded pixel") \
    X(ROUNDS, "the frame may be drawn in rounds that test against the ones before") \
    X(FINISHES, "tiles may be finished in the first of two rounds") \
    X(COUNTS_OVERDRAW, "faces are counted, sample by sample") \
    X(EDGES, "the edges of faces are drawn") \
    X(EDGES_ALONE, "nothing but edges is drawn to the colours") \
    X(EDGE_DEPTHS, "edges are tested against the depths of faces") \
    X(BACKDROP, "the background is found pixel by pixel") \
    X(ENCODES_SRGB, "colours go through the sRGB encoder")

#define E3D_ASKED_NAME(name, text) E3D_ASKED_##name,
#define E3D_PLAN_NAME(name, text) E3D_PLAN_##name,
typedef enum e3d_asked_item { E3D_ASKED_FOR(E3D_ASKED_NAME) E3D_ASKED_ITEMS } e3d_asked_item;
typedef enum e3d_plan_item { E3D_PLANNED(E3D_PLAN_NAME) E3D_PLAN_ITEMS } e3d_plan_item;
_Static_assert(E3D_ASKED_ITEMS <= 64 && E3D_PLAN_ITEMS <= 64, "each item has a bit of its word");

/* The planned items, a bit each. The asked items stay in plan.c: stages do what is planned, whatever the reason. */
typedef uint64_t e3d_plan;

static inline int e3d_plan_has(e3d_plan plan, e3d_plan_item item) { return (int)(plan >> item & 1); }

/* A condition plans an item if the frame asks for all of `asked` and none of `unless_asked`, and all of `planned` and none of
 * `unless_planned` is planned already. Conditions are tested in order; an item may have several. */
typedef struct e3d_plan_condition {
    e3d_plan_item item;
    uint64_t asked, planned, unless_asked, unless_planned;
} e3d_plan_condition;

extern const e3d_plan_condition E3D_PLAN_CONDITIONS[];
extern const int E3D_PLAN_CONDITION_COUNT;

/* The name of an item, and its description. */
typedef struct e3d_plan_word {
    const char *name, *text;
} e3d_plan_word;

extern const e3d_plan_word E3D_ASKED_WORDS[E3D_ASKED_ITEMS], E3D_PLAN_WORDS[E3D_PLAN_ITEMS];

e3d_plan e3d_plan_of(const e3d_frame *frame, const e3d_targets *targets);
/* The inputs of shading that each surface needs: E3D_WANT_POSITION, E3D_WANT_NORMAL, E3D_WANT_UV, E3D_WANT_WEIGHTS. */
int e3d_plan_inputs(e3d_plan plan);

/* Whether parts of meshes are left out that are outside the frustum, face away, or are hidden. */
static inline int e3d_culls_parts(const e3d_frame *frame)
{
    return frame->culling == E3D_CULLING_ALL || frame->culling == E3D_CULLING_ALWAYS;
}

/* Whether colours are those of surfaces, lit or unlit. */
static inline int e3d_has_light_or_color(const e3d_frame *frame) { return frame->mode == E3D_MODE_LIT || frame->mode == E3D_MODE_UNLIT; }

static inline int e3d_has_area_lights(const e3d_frame *frame)
{
    for (int32_t n = 0; n < frame->light_count; n++)
        if (e3d_is_area_light(frame->lights[n].kind))
            return 1;
    return 0;
}

static inline int e3d_shows_environment(const e3d_frame *frame)
{
    return frame->backdrop.light.environment != NULL && e3d_has_light_or_color(frame);
}

/* Whether a material's specular or emissive colour adds anything. */
static inline int e3d_adds(const float color[3]) { return color[0] != 0.0f || color[1] != 0.0f || color[2] != 0.0f; }
