/* What a frame may be written to. */
#ifndef E3D_API_TARGETS_H
#define E3D_API_TARGETS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Each may be NULL: what is not asked for is not computed. All (height, width[, channels]). */
typedef struct e3d_targets {
    uint8_t *color;          /* 4: RGBA */
    float *depth;            /* 1: metric, along the view axis; 0 = background */
    float *ndc_depth;        /* 1: +inf = background */
    int32_t *triangle_id;    /* 1: face index in its mesh, -1 = background, line or point */
    int32_t *object_id;      /* 1: node id, -1 = background */
    int32_t *instance_id;    /* 1: -1 = background */
    int32_t *material_id;    /* 1: -1 = background */
    float *albedo;           /* 3: working space; 0 = background, as below */
    float *normal;           /* 3: view space, unit, towards the viewer */
    float *position;         /* 3: view space */
    float *world_normal;     /* 3 */
    float *world_position;   /* 3 */
    float *uv;               /* 2 */
    float *barycentric;      /* 3 */
} e3d_targets;

#ifdef __cplusplus
}
#endif

#endif
