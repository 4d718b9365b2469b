/* A frame: what is drawn, from where, and how. */
#ifndef E3D_API_FRAME_H
#define E3D_API_FRAME_H

#include <stdint.h>

#include "e3d_draw.h"
#include "e3d_light.h"
#include "e3d_material.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum e3d_mode {
    E3D_MODE_LIT = 0,
    E3D_MODE_UNLIT,
    E3D_MODE_RANDOM,
    E3D_MODE_DEPTH,
    E3D_MODE_NORMAL,
    E3D_MODE_TRIANGLE_ID,
    E3D_MODE_OBJECT_ID,
    E3D_MODE_OVERDRAW
} e3d_mode;

typedef enum e3d_cull { E3D_CULL_NONE = 0, E3D_CULL_BACK, E3D_CULL_FRONT } e3d_cull;
typedef enum e3d_wireframe { E3D_WIRE_NONE = 0, E3D_WIRE_OVERLAY, E3D_WIRE_ONLY } e3d_wireframe;
typedef enum e3d_hidden { E3D_HIDDEN_ZBUFFER = 0, E3D_HIDDEN_PAINTER, E3D_HIDDEN_NONE } e3d_hidden;
typedef enum e3d_shading { E3D_SHADING_DEFERRED = 0, E3D_SHADING_FORWARD } e3d_shading;
typedef enum e3d_normals { E3D_NORMALS_AUTO = 0, E3D_NORMALS_SMOOTH, E3D_NORMALS_FLAT } e3d_normals;

/* What is left out before it is drawn; the picture is the same. */
typedef enum e3d_culling {
    E3D_CULLING_ALL = 0, /* outside the frustum, or behind what is drawn already */
    E3D_CULLING_FRUSTUM,
    E3D_CULLING_NONE,
    E3D_CULLING_ALWAYS /* as ALL, and what is drawn already is tried against even where that cannot pay */
} e3d_culling;

enum { E3D_MAX_SIZE = 16384 };

typedef struct e3d_frame {
    int32_t width, height;       /* 1 .. E3D_MAX_SIZE output pixels */
    int32_t samples_axis;        /* 1, 2 or 4: samples a pixel along each axis */
    double clip_from_world[16];
    double view_from_world[16];
    float eye[4];                /* world: w = 1 the camera's position, w = 0 the unit direction
                                  * towards the viewer (orthographic) */
    e3d_mode mode;
    e3d_cull cull;
    e3d_wireframe wireframe;
    e3d_hidden hidden;
    e3d_shading shading;
    e3d_normals normals;
    int32_t remove_hidden_lines; /* with E3D_WIRE_ONLY: faces hide the edges behind them */
    float line_width, point_size; /* output pixels, 0 < size <= 256 */
    float line_color[3];         /* display-ready: goes through the frame's encoder like any colour */
    float background[4];         /* rgb through the encoder; a is 0 or 1 */
    int32_t encode_srgb;         /* lit and unlit only: encoder is sRGB, else floor(255 v + 1/2) */
    int32_t decode_srgb;         /* 8-bit vertex and instance colours are decoded from sRGB */
    int64_t view;                /* any number that tells this eye from others: the renderer remembers what each saw last */
    float depth_near, depth_far; /* metric depths that mode depth shows white and black; near < far */
    float ambient[3];
    float light_clamp[2];        /* {0, +inf}: no clamp */
    const e3d_material *materials;
    int32_t material_count;
    const e3d_light *lights;
    int32_t light_count;
    const e3d_draw *draws;
    int32_t draw_count;
    /* Numbers of draws, in the order of drawing: each once, but one of E3D_POSE_NODES once for each of its nodes.
     * NULL: the draws as given, none of which is of E3D_POSE_NODES. */
    const int32_t *order;
    int32_t order_count;
    e3d_culling culling;
    const double *frozen_clip_from_world; /* or NULL: draw what this camera's frustum holds, nothing else */
} e3d_frame;

#ifdef __cplusplus
}
#endif

#endif
