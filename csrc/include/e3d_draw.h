/* What is drawn: a mesh, and where its instances are. */
#ifndef E3D_API_DRAW_H
#define E3D_API_DRAW_H

#include <stdint.h>

#include "e3d_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum e3d_pose_kind {
    E3D_POSE_NONE = 0,      /* one instance, at the node's own pose */
    E3D_POSE_MATRIX,        /* (instances, 16) float32, node from instance, row-major */
    E3D_POSE_OFFSET_SCALE,  /* (instances, 4) float32: offset x y z, uniform scale */
    E3D_POSE_NODES          /* nodes that share a mesh: each has a pose in the world and an id of its own */
} e3d_pose_kind;

/* One node's mesh. Primitives of an instance are ordered: faces, then lines, then points. */
typedef struct e3d_draw {
    const e3d_mesh *mesh;
    double world_from_node[16];
    e3d_pose_kind pose_kind;
    const float *poses;
    int32_t instances;               /* 1 where pose_kind is E3D_POSE_NONE */
    const uint8_t *instance_colors_u8;  /* (instances, 4) or NULL; at most one of the two */
    const float *instance_colors_f32;   /* (instances, 4) or NULL */
    int32_t node_id;                 /* what object_id outputs */
    int32_t material_base;           /* frame material = material_base + mesh material id */
    int32_t first_instance;          /* added to what instance_id outputs: of many, some may be drawn */
    const int32_t *instance_ids;     /* (instances,) what instance_id outputs instead, or NULL */
    /* E3D_POSE_NODES, in place of world_from_node, node_id and first_instance: */
    const double *node_worlds;       /* (instances, 12) world from node: three rows of four */
    const int32_t *node_ids;         /* (instances,) what object_id outputs */
    int32_t unshadowed;              /* not 0: no shadow falls on it */
    uint32_t spared_lights;          /* of what casts exact shadows: bit n is set where it does not hide the light that n such lights come before */
} e3d_draw;

#ifdef __cplusplus
}
#endif

#endif
