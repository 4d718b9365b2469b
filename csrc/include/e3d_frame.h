/* A frame: what is drawn, from where, and how. */
#pragma once

#include <stdint.h>

#include "e3d_options.h"
#include "e3d_casters.h"
#include "e3d_draw.h"
#include "e3d_environment.h"
#include "e3d_light.h"
#include "e3d_material.h"
#include "e3d_mirror.h"
#include "e3d_tone.h"

#ifdef __cplusplus
extern "C" {
#endif

#define E3D_EACH_MODE(X) \
    X(E3D_MODE_LIT, lit) \
    X(E3D_MODE_UNLIT, unlit) \
    X(E3D_MODE_RANDOM, random) \
    X(E3D_MODE_DEPTH, depth) \
    X(E3D_MODE_NORMAL, normal) \
    X(E3D_MODE_FACE_ID, face_id) \
    X(E3D_MODE_OBJECT_ID, object_id) \
    X(E3D_MODE_OVERDRAW, overdraw)
typedef enum e3d_mode { E3D_EACH_MODE(E3D_ENUMERATOR) } e3d_mode;

#define E3D_EACH_CULL(X) X(E3D_CULL_NONE, none) X(E3D_CULL_BACK, back) X(E3D_CULL_FRONT, front)
typedef enum e3d_cull { E3D_EACH_CULL(E3D_ENUMERATOR) } e3d_cull;

#define E3D_EACH_WIREFRAME(X) X(E3D_WIRE_NONE, none) X(E3D_WIRE_OVERLAY, overlay) X(E3D_WIRE_ONLY, only)
typedef enum e3d_wireframe { E3D_EACH_WIREFRAME(E3D_ENUMERATOR) } e3d_wireframe;

#define E3D_EACH_HIDDEN(X) X(E3D_HIDDEN_ZBUFFER, zbuffer) X(E3D_HIDDEN_PAINTER, painter) X(E3D_HIDDEN_NONE, none)
typedef enum e3d_hidden { E3D_EACH_HIDDEN(E3D_ENUMERATOR) } e3d_hidden;

#define E3D_EACH_SHADING(X) X(E3D_SHADING_DEFERRED, deferred) X(E3D_SHADING_FORWARD, forward)
typedef enum e3d_shading { E3D_EACH_SHADING(E3D_ENUMERATOR) } e3d_shading;

/* FACET: like FLAT, but a whole face has the light of its middle. */
#define E3D_EACH_NORMALS(X) \
    X(E3D_NORMALS_AUTO, auto) \
    X(E3D_NORMALS_SMOOTH, smooth) \
    X(E3D_NORMALS_FLAT, flat) \
    X(E3D_NORMALS_FACET, facet)
typedef enum e3d_normals { E3D_EACH_NORMALS(E3D_ENUMERATOR) } e3d_normals;

/* Whether faces of a material, flat or not, have one normal. */
static inline int e3d_is_flat(e3d_normals normals, int flat)
{
    return normals == E3D_NORMALS_FLAT || normals == E3D_NORMALS_FACET || (normals == E3D_NORMALS_AUTO && flat);
}

/* Which objects and clusters are left out before they are drawn; the picture is the same. ALL: those outside the frustum, facing
 * away, or behind what is drawn already. ALWAYS: like ALL, but it also tests against drawn depths where that cannot pay. NONE:
 * none. TREE, FRUSTUM: none here; the caller has left out the nodes outside the frustum by e3d_tree_select, which walks the
 * tree's branches or tests one node after the other. */
#define E3D_EACH_CULLING(X) \
    X(E3D_CULLING_ALL, all) \
    X(E3D_CULLING_TREE, tree) \
    X(E3D_CULLING_FRUSTUM, frustum) \
    X(E3D_CULLING_NONE, none) \
    X(E3D_CULLING_ALWAYS, always)
typedef enum e3d_culling { E3D_EACH_CULLING(E3D_ENUMERATOR) } e3d_culling;

/* PLAIN: parallelograms with slanted ends (R11). ROUND: the full width at any angle, with half a disc at each end (R114). */
#define E3D_EACH_LINE_SHAPE(X) X(E3D_LINES_PLAIN, plain) X(E3D_LINES_ROUND, round)
typedef enum e3d_line_shape { E3D_EACH_LINE_SHAPE(E3D_ENUMERATOR) } e3d_line_shape;

#define E3D_EACH_POINT_SHAPE(X) X(E3D_POINTS_SQUARE, square) X(E3D_POINTS_ROUND, round)
typedef enum e3d_point_shape { E3D_EACH_POINT_SHAPE(E3D_ENUMERATOR) } e3d_point_shape;

enum { E3D_MAX_SIZE = 16384,
       E3D_MAX_APERTURES = 16 };

/* Pixels of a picture, inclusive. */
typedef struct e3d_aperture {
    int32_t x0, y0, x1, y1;
} e3d_aperture;

typedef struct e3d_frame {
    int32_t width, height;       /* 1 .. E3D_MAX_SIZE output pixels */
    int32_t samples_axis;        /* 1, 2 or 4: samples a pixel along each axis */
    double clip_from_world[16];
    double view_from_world[16];
    /* Perspective: the camera's position, w = 1; orthographic: the unit direction to the viewer, w = 0 (world) */
    float eye[4];
    e3d_mode mode;
    e3d_cull cull;
    const e3d_aperture *apertures;   /* with E3D_CULL_BACK, backs that reach into one are drawn (R9) */
    int32_t aperture_count;        /* at most E3D_MAX_APERTURES */
    e3d_wireframe wireframe;
    e3d_hidden hidden;
    e3d_shading shading;
    e3d_normals normals;
    int32_t remove_hidden_lines; /* with E3D_WIRE_ONLY: faces that aren't drawn hide the edges behind them */
    float line_width, point_size; /* output pixels, 0 < size <= 256 */
    float line_color[3];         /* display-ready: goes through the frame's encoder like any colour */
    float background[4];         /* rgb through the encoder; a is 0 or 1 */
    e3d_backdrop backdrop;       /* the background where it is an environment; modes lit and unlit only */
    e3d_environment_light environment; /* lights physically based materials */
    int32_t encode_srgb;         /* modes lit and unlit: the encoder is sRGB; else it is floor(255 v + 1/2) */
    int32_t decode_srgb;         /* 8-bit vertex and instance colours are decoded from sRGB */
    int64_t view;                /* the number of this eye, any; the renderer remembers for each eye what it showed last */
    float depth_near, depth_far; /* metric depths that mode depth shows as white and as black; near < far */
    float ambient[3];
    float light_clamp[2];        /* {0, +inf}: no clamp */
    float exposure;              /* multiplies what lit surfaces show; > 0 */
    const e3d_material *materials;
    int32_t material_count;
    const e3d_light *lights;
    int32_t light_count;
    const e3d_draw *draws;
    int32_t draw_count;
    /* Numbers of draws in the order of drawing. Each stands once, but a draw of E3D_POSE_NODES stands once for each of its
     * nodes. NULL: the draws as given; none of them is of E3D_POSE_NODES. */
    const int32_t *order;
    int32_t order_count;
    /* Outputs other than colour show the nearest surface even if it is blended; else the nearest that isn't */
    int32_t transparent_outputs;
    e3d_culling culling;
    const double *frozen_clip_from_world; /* NULL, or another camera: only what its frustum holds is drawn */
    const e3d_shadow_map *shadow_maps; /* of all lights */
    int32_t shadow_map_count;
    int32_t faces_only;          /* neither lines nor points are drawn */
    e3d_tone_mapping tone_mapping; /* for lit surfaces and the backdrop, in mode lit */
    e3d_fog fog;                   /* lit and unlit only */
    e3d_gradient gradient;
    const e3d_casters *casters;  /* the casters of exact shadows; NULL: none */
    e3d_line_shape line_shape;            /* the shape of lines and of a wireframe's edges */
    e3d_point_shape point_shape;
    int32_t msaa_samples; /* multisampling: 2, 4, 8 or 16, with samples_axis 1; else 0 */
    /* With multisampling: the alpha of E3D_ALPHA_MASK decides how many of a pixel's samples are covered */
    int32_t alpha_to_coverage;
    /* With multisampling: each sample of a pixel gets a colour of its own, found where it lies (R195) */
    int32_t sample_shading;
    /* Lobes of physically based materials are as wide as the normals in a pixel ask for (R193) */
    int32_t specular_antialiasing;
    e3d_ambient_light ambient_light;      /* beside ambient */
    /* (height, width) or NULL: the share of ambient light that reaches the opaque surfaces in a pixel (R129) */
    const float *ambient_visibility;
    const e3d_mirror *mirrors; /* what faces of materials with a mirror show */
    int32_t mirror_count;      /* at most E3D_MAX_MIRRORS */
    int32_t opaque_only;         /* what is blended over the visible surface is left out (R161) */
    /* NULL, or what glass bends and blurs: all levels that e3d_find_behind found, and (height, width), the output depth, of the same
     * frame with opaque_only */
    const float *behind, *behind_depth;
    /* Of a part of a picture, as what a mirror shows or a face of a lens: the size of the whole, and how many pixels of the part are
     * side by side in one of it, above 0 (R273); zeros: the frame is whole */
    int32_t whole_width, whole_height;
    float fineness;
} e3d_frame;

/* These set a member by its name: one that options decide, or one that a scene's surroundings decide. They return 0 if no member
 * has that name and count. */
int e3d_frame_set(e3d_frame *frame, const char *name, const double *values, int32_t count);

#ifdef __cplusplus
}
#endif
