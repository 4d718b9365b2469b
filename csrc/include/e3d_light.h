/* Lights. */
#ifndef E3D_API_LIGHT_H
#define E3D_API_LIGHT_H

#include <stdint.h>

#include "e3d_options.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Which way a light shines from its place: every way alike, or into a cone. */
typedef enum e3d_emission { E3D_EMITS_EVENLY = 0, E3D_EMITS_CONE } e3d_emission;

/* How the maps of a light's shadow lie: one or several side by side, the finest first; six, the faces of a cube around the light, of which
 * all have the place of the first; or one, ahead of the light. */
#define E3D_EACH_MAP_LAYOUT(X) X(E3D_MAPS_CASCADES, cascades) X(E3D_MAPS_CUBE, cube) X(E3D_MAPS_AHEAD, ahead)
typedef enum e3d_texture_layout { E3D_EACH_MAP_LAYOUT(E3D_ENUMERATOR) } e3d_texture_layout;

/* The kinds of lights, and what is true of each: X(kind, name, whether it has a place, emission, layout of its maps). Those without a place
 * are infinitely far away. */
#define E3D_EACH_LIGHT_KIND(X)                                                    \
    X(E3D_LIGHT_DIRECTIONAL, directional, 0, E3D_EMITS_EVENLY, E3D_MAPS_CASCADES) \
    X(E3D_LIGHT_POINT, point, 1, E3D_EMITS_EVENLY, E3D_MAPS_CUBE)                 \
    X(E3D_LIGHT_SPOT, spot, 1, E3D_EMITS_CONE, E3D_MAPS_AHEAD)
typedef enum e3d_light_kind { E3D_EACH_LIGHT_KIND(E3D_ENUMERATOR) } e3d_light_kind;

typedef struct e3d_light_traits {
    int32_t has_position;
    e3d_emission emission;
    e3d_texture_layout maps;
} e3d_light_traits;

static inline e3d_light_traits e3d_light_traits_of(e3d_light_kind kind)
{
#define E3D_LIGHT_TRAITS(kind, name, ...) {__VA_ARGS__},
    static const e3d_light_traits OF_KINDS[] = {E3D_EACH_LIGHT_KIND(E3D_LIGHT_TRAITS)};
    return OF_KINDS[kind];
}

#define E3D_EACH_FALLOFF(X) \
    X(E3D_FALLOFF_INVERSE_SQUARE, inverse_square) X(E3D_FALLOFF_WINDOW, window) X(E3D_FALLOFF_GLTF, gltf)
typedef enum e3d_falloff { E3D_EACH_FALLOFF(E3D_ENUMERATOR) } e3d_falloff;

/* What keeps a light from a surface: nothing, what a map shows that was drawn from the light, or what is between both to the bit, of the
 * frame's casters. */
typedef enum e3d_shadow_kind { E3D_SHADOW_NONE = 0, E3D_SHADOW_MAP, E3D_SHADOW_EXACT } e3d_shadow_kind;

enum { E3D_MAX_EXACT_LIGHTS = 32 };

/* Where a map is: its column is x + scale times how far to the light's right a place is, its row y + scale times how far down, both
 * over how far ahead it is where the light has a position (R91). */
typedef struct e3d_shadow_map {
    float scale, x, y;
    float texel; /* 1 over scale: how wide a texel is, at distance 1 of a light that has a position */
} e3d_shadow_map;

/* The maps of a light, and how samples are looked up in them. */
typedef struct e3d_light_maps {
    int32_t first, count;    /* of e3d_frame.shadow_maps */
    int32_t size, taps;      /* texels and comparisons a side: 1, 3 or 5 */
    float bias;              /* is added to the depths that are compared */
    float normal_bias;       /* how far samples move along their normals, in the world */
    int32_t step;            /* 1/256 texel, from comparison to comparison */
    float margin;            /* texels at a map's sides where no sample is looked up, as the comparisons around it leave the map */
    float axes[3][3];        /* but of a cube: unit vectors to the right, down and ahead, as the light shines */
    float depth[2];          /* ndc depth of what is so far ahead: depth[0]*ahead + depth[1], or depth[0] + depth[1]/ahead */
    const float *depths;     /* (count, size, size) what the maps show: the output ndc_depth */
    const uint32_t *ranges;  /* of the same maps, by e3d_find_shadow_ranges; NULL: all samples are compared with depths */
} e3d_light_maps;

typedef struct e3d_light_shadow {
    e3d_shadow_kind kind;
    int32_t exact;       /* of kind E3D_SHADOW_EXACT: how many lights of this kind come before it */
    e3d_light_maps maps; /* of kind E3D_SHADOW_MAP */
} e3d_light_shadow;

/* How many words of `ranges` a map of that size takes a side. */
int32_t e3d_shadow_ranges_side(int32_t size);
/* Finds between which depths of a map, (size, size), lies what comparisons may touch: (side, side). Most samples are before or behind all
 * of that, and need no comparisons. */
e3d_status e3d_find_shadow_ranges(const float *depths, int32_t size, int32_t taps, int32_t step, uint32_t *ranges);

typedef struct e3d_light {
    e3d_light_kind kind;
    e3d_falloff falloff;
    float color[3];      /* colour times intensity, in the frame's working space */
    float to_light[3];   /* but of those that shine evenly from a place: unit vector against the way that the light shines, world space */
    float position[3];   /* of those that have one: world space */
    float range;         /* with a position: contributes exactly 0 at distance >= range; may be +inf
                          * (not with E3D_FALLOFF_WINDOW) */
    float lux[3];        /* what physically based materials take for color: lux, of the others candela */
    float cone[2];       /* E3D_EMITS_CONE: the cosine of the outer angle, and 1 over what the inner one's is more */
    e3d_light_shadow shadow; /* lit surfaces lie in it that receive shadows */
} e3d_light;

enum { E3D_AMBIENT_TERMS = 9 };

/* Light from all around that differs from direction to direction (R130): what white surfaces show by their normal (x, y, z) is a sum of
 * 1, x, y, z, xx - zz, yy - zz, xy, yz and zx, each times its term, and then no less than 0. */
typedef struct e3d_ambient_light {
    int32_t is_given;
    float terms[E3D_AMBIENT_TERMS][3];
} e3d_ambient_light;

#ifdef __cplusplus
}
#endif

#endif
