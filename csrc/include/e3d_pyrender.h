/* Pictures lit as the package pyrender lights them (docs/exactness, section 24).
 * In: draws, lights, a camera, and for opaque triangles the IDs of those that show, as e3d_render wrote them.
 * Out: colours and metric depths.
 * Always: the same bytes for any number of threads, since no pixel depends on what is written for another. */
#pragma once

#include <stdint.h>

#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum e3d_pyr_mode { E3D_PYR_TRIANGLES = 0,
                            E3D_PYR_LINES,
                            E3D_PYR_POINTS } e3d_pyr_mode;

/* LIT: by lights. FLAT: the surface's own colour. PLAIN: the draw's colour. DEPTH: no colours. */
typedef enum e3d_pyr_shading { E3D_PYR_LIT = 0,
                               E3D_PYR_FLAT,
                               E3D_PYR_PLAIN,
                               E3D_PYR_DEPTH } e3d_pyr_shading;

typedef enum e3d_pyr_wrap { E3D_PYR_REPEAT = 0,
                            E3D_PYR_CLAMP,
                            E3D_PYR_MIRROR } e3d_pyr_wrap;

enum { E3D_PYR_LEVELS = 15,
       E3D_PYR_SAMPLES = 4,                 /* a pixel has this many samples, or one */
       E3D_PYR_CENTRE = E3D_PYR_SAMPLES,
       E3D_PYR_PLACES = E3D_PYR_SAMPLES + 1 /* the places where visibility is known: the samples, and the pixel's centre */ };

/* 8-bit texels, row 0 at the bottom; level k is max(1, size >> k) texels a side. */
typedef struct e3d_pyr_texture {
    const uint8_t *level[E3D_PYR_LEVELS];
    int32_t width, height, channels, levels;
    int32_t wrap[2];                       /* e3d_pyr_wrap, along u and v */
    int32_t linear_near, linear_far;       /* whether texels are blended: where the texture is magnified; where it is minified */
    int32_t blends_levels;
} e3d_pyr_texture;

/* The textures of a material; each is read at the first set of coordinates. */
typedef enum e3d_pyr_slot { E3D_PYR_BASE_COLOR = 0,
                            E3D_PYR_ROUGHNESS_METALLIC,
                            E3D_PYR_NORMAL,
                            E3D_PYR_OCCLUSION,
                            E3D_PYR_EMISSIVE,
                            E3D_PYR_SLOTS } e3d_pyr_slot;

/* A primitive at one place. Indices are in range; the mode says whether they are (count, 3), (count, 2) or (count,). */
typedef struct e3d_pyr_draw {
    int32_t mode, count, vertices;
    const int32_t *indices;
    const float *positions;                /* (vertices, 3) */
    const float *normals, *uvs, *colors;   /* (vertices, 3), (vertices, 2), (vertices, 4), or NULL */
    const uint8_t *calm;                   /* (count,) for triangles, by e3d_pyr_find_calm */
    double world[16];                      /* world_from_object */
    int32_t culls_backs, is_wireframe, blends;
    float color[4];                        /* the base colour's factor; PLAIN: the colour */
    float metallic, roughness, emissive[3];
    const e3d_pyr_texture *textures[E3D_PYR_SLOTS]; /* or NULL */
    int32_t first_light, light_count;      /* the draw's range in e3d_pyr_frame.light_numbers */
} e3d_pyr_draw;

typedef enum e3d_pyr_light_kind { E3D_PYR_DIRECTIONAL = 0,
                                  E3D_PYR_POINT,
                                  E3D_PYR_SPOT } e3d_pyr_light_kind;

typedef struct e3d_pyr_light {
    int32_t kind;
    float color[3];                        /* times the intensity */
    float position[3], direction[3];       /* the direction is where it shines, of unit length */
    float cone_scale, cone_offset;
    const float *shadow_map;               /* ndc depths, row 0 at the top, or NULL: no shadows */
    int32_t shadow_size;
    double shadow_from_world[16];          /* clip space of the map */
} e3d_pyr_light;

/* A step of the picture; steps are drawn one after the other.
 * With face_id, a step is opaque triangles whose visibility is known: at each place the draw is draw_of_object[object_id] +
 * instance_id, or none where face_id is negative. object_id is NULL if all IDs are of object 0, instance_id if there are no
 * instances.
 * Without it, a step is draws that are rasterised here, one after the other. */
typedef struct e3d_pyr_step {
    const int32_t *object_id[E3D_PYR_PLACES], *face_id[E3D_PYR_PLACES], *instance_id[E3D_PYR_PLACES];
    const int32_t *draw_of_object;
    int32_t first_draw, draw_count;
} e3d_pyr_step;

typedef struct e3d_pyr_frame {
    int32_t width, height, samples;        /* samples: E3D_PYR_SAMPLES, or 1: then a pixel's colour is found where its depth is */
    int32_t shading;
    double clip_from_world[16];
    float eye[3], ambient[3], background[4], point_size;
    double depth_near, depth_far;          /* depth_far: infinity for none */
    int32_t depth_place;                   /* where depths are found: E3D_PYR_CENTRE, or the number of a sample */
    int32_t depth_is_straight;             /* depth is linear in z_ndc, as it is without perspective */
    const e3d_pyr_draw *draws;
    int32_t draw_count;
    const e3d_pyr_light *lights;
    const int32_t *light_numbers;
    const e3d_pyr_step *steps;
    int32_t step_count;
    uint8_t *color;                        /* (height, width, channels), or NULL */
    int32_t channels;                      /* 3 or 4 */
    float *depth;                          /* (height, width) */
} e3d_pyr_frame;

/* Finds the calm triangles of a draw: they differ so little from corner to corner that neighbouring samples may be lit together
 * (R152). */
void e3d_pyr_find_calm(const e3d_pyr_draw *draw, uint8_t *out);

/* Memory that pictures use again. e3d_pyr_memory_new returns NULL when memory is out. */
typedef struct e3d_pyr_memory e3d_pyr_memory;
e3d_pyr_memory *e3d_pyr_memory_new(void);
void e3d_pyr_memory_free(e3d_pyr_memory *memory);

/* Draws on up to `threads` threads (0: all). A memory serves one picture at a time. */
e3d_status e3d_pyr_render(const e3d_pyr_frame *frame, int32_t threads, e3d_pyr_memory *memory);

#ifdef __cplusplus
}
#endif
