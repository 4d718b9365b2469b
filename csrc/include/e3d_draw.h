/* What is drawn: a mesh, and where its instances are. */
#pragma once

#include <stdint.h>

#include "e3d_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum e3d_pose_kind {
    E3D_POSE_NONE = 0,      /* one instance, at the node's own pose */
    E3D_POSE_MATRIX,        /* (instances, 16) float32, node from instance, row-major */
    E3D_POSE_OFFSET_SCALE,  /* (instances, 4) float32: offset x y z, uniform scale */
    E3D_POSE_NODES          /* several nodes of one mesh: each has its own pose in the world and its own ID */
} e3d_pose_kind;

/* A mesh with its instances. The primitives of an instance are ordered: faces, then lines, then points. */
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
    /* Added to the numbers that instance_id outputs, where only some of many instances are drawn */
    int32_t first_instance;
    const int32_t *instance_ids;     /* (instances,) the numbers that instance_id outputs instead, or NULL */
    /* For E3D_POSE_NODES, in place of world_from_node, node_id and first_instance: */
    const double *node_worlds;       /* (instances, 12) world from node: three rows of four */
    const int32_t *node_ids;         /* (instances,) what object_id outputs */
    int32_t unshadowed;              /* not 0: no shadow falls on it */
    /* Bit n is set where the draw casts no shadow of the frame's n-th light with exact shadows */
    uint32_t spared_lights;
} e3d_draw;

#ifdef __cplusplus
}
#endif
