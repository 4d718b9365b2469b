/* Lights. */
#pragma once

#include <stdint.h>

#include "e3d_options.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The directions into which a light shines from its place: all of them, a cone, or those ahead of it. */
typedef enum e3d_emission { E3D_EMITS_EVENLY = 0,
                            E3D_EMITS_CONE,
                            E3D_EMITS_AHEAD } e3d_emission;

/* What shines: a point (or what is as far away), or the surface of an area light (R231). */
typedef enum e3d_light_shape { E3D_SHAPE_POINT = 0,
                               E3D_SHAPE_RECTANGLE,
                               E3D_SHAPE_DISC,
                               E3D_SHAPE_TUBE } e3d_light_shape;

/* The layout of a light's shadow maps. CASCADES: one or several side by side, the finest first. CUBE: six, the faces of a cube
 * around the light, all with the x and y of the first. Else one map, ahead of the light. */
#define E3D_EACH_MAP_LAYOUT(X) X(E3D_MAPS_CASCADES, cascades) X(E3D_MAPS_CUBE, cube) X(E3D_MAPS_AHEAD, ahead)
typedef enum e3d_map_layout { E3D_EACH_MAP_LAYOUT(E3D_ENUMERATOR) } e3d_map_layout;

/* The kinds of lights and their traits: X(kind, name, whether it has a place, emission, layout of its maps, shape). A light
 * without a place is infinitely far away. */
#define E3D_EACH_LIGHT_KIND(X) \
    X(E3D_LIGHT_DIRECTIONAL, directional, 0, E3D_EMITS_EVENLY, E3D_MAPS_CASCADES, E3D_SHAPE_POINT) \
    X(E3D_LIGHT_POINT, point, 1, E3D_EMITS_EVENLY, E3D_MAPS_CUBE, E3D_SHAPE_POINT) \
    X(E3D_LIGHT_SPOT, spot, 1, E3D_EMITS_CONE, E3D_MAPS_AHEAD, E3D_SHAPE_POINT) \
    X(E3D_LIGHT_RECTANGLE, rectangle, 1, E3D_EMITS_AHEAD, E3D_MAPS_AHEAD, E3D_SHAPE_RECTANGLE) \
    X(E3D_LIGHT_DISC, disc, 1, E3D_EMITS_AHEAD, E3D_MAPS_AHEAD, E3D_SHAPE_DISC) \
    X(E3D_LIGHT_TUBE, tube, 1, E3D_EMITS_EVENLY, E3D_MAPS_CUBE, E3D_SHAPE_TUBE)
typedef enum e3d_light_kind { E3D_EACH_LIGHT_KIND(E3D_ENUMERATOR) } e3d_light_kind;

typedef struct e3d_light_traits {
    int32_t has_position;
    e3d_emission emission;
    e3d_map_layout maps;
    e3d_light_shape shape;
} e3d_light_traits;

static inline e3d_light_traits e3d_light_traits_of(e3d_light_kind kind)
{
#define E3D_LIGHT_TRAITS(kind, name, ...) {__VA_ARGS__},
    static const e3d_light_traits OF_KINDS[] = {E3D_EACH_LIGHT_KIND(E3D_LIGHT_TRAITS)};
    return OF_KINDS[kind];
}

static inline int e3d_is_area_light(e3d_light_kind kind) { return e3d_light_traits_of(kind).shape != E3D_SHAPE_POINT; }

#define E3D_EACH_FALLOFF(X) \
    X(E3D_FALLOFF_INVERSE_SQUARE, inverse_square) \
    X(E3D_FALLOFF_WINDOW, window) \
    X(E3D_FALLOFF_GLTF, gltf)
typedef enum e3d_falloff { E3D_EACH_FALLOFF(E3D_ENUMERATOR) } e3d_falloff;

/* How a light's shadow is found. MAP: by depths that were drawn from the light. EXACT: by tracing the ray between the sample and
 * the light through the frame's casters. */
typedef enum e3d_shadow_kind { E3D_SHADOW_NONE = 0,
                               E3D_SHADOW_MAP,
                               E3D_SHADOW_EXACT } e3d_shadow_kind;

enum { E3D_MAX_EXACT_LIGHTS = 32 };

/* Where a map lies: a point's column is x + scale * right, its row y + scale * down; both are its distances from the light along
 * the map's axes, divided by its distance ahead if the light has a position (R91). */
typedef struct e3d_shadow_map {
    float scale, x, y;
    float texel; /* 1 / scale: the width of a texel, at distance 1 if the light has a position */
    float spread; /* soft lights: scale / |depth[0]|, or scale / |depth[1]| if the light has a position (R225) */
} e3d_shadow_map;

/* The shadow maps of a light, and the parameters of a lookup in them. */
typedef struct e3d_light_maps {
    int32_t first, count;    /* the light's maps in e3d_frame.shadow_maps */
    int32_t size, taps;      /* texels a side; comparisons a side: 1, 3 or 5 */
    float bias;              /* added to the depths that are compared */
    float normal_bias;       /* how far a sample is moved along its normal, in world units */
    int32_t step;            /* the distance from comparison to comparison, in 1/256 texel */
    /* Texels at a map's sides in which no sample is looked up, since its comparisons would leave the map */
    float margin;
    float axes[3][3];        /* unit vectors to the map's right, down it and ahead, as the light shines; not of a cube */
    float depth[2];          /* the ndc depth at a distance ahead: depth[0] * ahead + depth[1], or depth[0] + depth[1] / ahead */
    /* The size of a soft light: the tangent of half its angle, or its radius if it has a position; 0: shadows are hard (R225) */
    float soft;
    float widest;            /* soft lights: the greatest radius of a lookup in texels, 1 to 64 */
    float nearest;           /* soft lights: the least of all depths */
    const float *depths;     /* (count, size, size) ndc depths of what the maps show */
    /* Their ranges, by e3d_find_shadow_ranges, or e3d_find_soft_ranges if the light is soft; NULL: all samples are compared with
     * depths */
    const uint32_t *ranges;
} e3d_light_maps;

typedef struct e3d_light_shadow {
    e3d_shadow_kind kind;
    int32_t exact;       /* E3D_SHADOW_EXACT: how many lights of this kind come before this one */
    /* E3D_SHADOW_EXACT: the size of the light: the tangent of half its angle, or its radius if it has a position; 0: shadows are hard
     * (R196) */
    float soft;
    e3d_light_maps maps; /* E3D_SHADOW_MAP */
} e3d_light_shadow;

/* The number of words a side that the ranges of a map of that size have. */
int32_t e3d_shadow_ranges_side(int32_t size);
/* Finds the ranges of a map, (size, size): for each block the least and the greatest depth that comparisons may read, (side,
 * side). Most samples are before or behind the whole range, and need no comparisons. */
e3d_status e3d_find_shadow_ranges(const float *depths, int32_t size, int32_t taps, int32_t step, uint32_t *ranges);
/* The same for a soft light, (2, side, side): the least depths near and far around each block. */
e3d_status e3d_find_soft_ranges(const float *depths, int32_t size, int32_t taps, int32_t step, float widest, uint32_t *ranges);

typedef struct e3d_light {
    e3d_light_kind kind;
    e3d_falloff falloff;
    /* Colour times intensity, in the frame's working space: lux without a position, candela with one, nits of area lights */
    float color[3];
    float to_light[3];   /* unit vector to the light along its axis, in the world; not of lights that shine evenly from a place */
    float position[3];   /* the position in the world, if the light has one */
    /* If it has a position: the light is exactly 0 from this distance on; may be +inf (not with E3D_FALLOFF_WINDOW) */
    float range;
    float cone[2];       /* E3D_EMITS_CONE: the cosine of the outer angle, and 1 over (cosine of the inner angle - that) */
    /* Area lights: half the sides of a rectangle, two radii of a disc, whose cross product points along to_light; half a tube's
     * axis, and nothing */
    float extent[2][3];
    float radius;        /* of a tube */
    e3d_light_shadow shadow; /* falls on lit surfaces that receive shadows */
} e3d_light;

/* The transformed cosines that stand for GGX under area lights (R234). Node (i, j) of 32 x 32 is for roughness i / 31 and a
 * cosine between normal and viewer of (j / 31)^2. */
enum { E3D_AREA_SIZE = 32 };
typedef enum e3d_area_table { E3D_AREA_ALONG,
                              E3D_AREA_ACROSS,
                              E3D_AREA_SKEW,
                              E3D_AREA_RISE,
                              E3D_AREA_TABLES } e3d_area_table;
extern const float E3D_AREA_TABLE[E3D_AREA_TABLES][E3D_AREA_SIZE * E3D_AREA_SIZE];

enum { E3D_AMBIENT_TERMS = 9 };

/* Ambient light that depends on the direction (R130). On a white surface of normal (x, y, z) it is the sum of 1, x, y, z, xx -
 * zz, yy - zz, xy, yz and zx, each times its term, and at least 0. */
typedef struct e3d_ambient_light {
    int32_t is_given;
    float terms[E3D_AMBIENT_TERMS][3];
} e3d_ambient_light;

#ifdef __cplusplus
}
#endif
