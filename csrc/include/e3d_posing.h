/* Posing: meshes whose vertices morph targets and joints move.
 * In: a mesh at rest, the arrays that move its vertices, and for each pose the joints' matrices and the targets' weights.
 * Out: posed meshes with positions and normals of their own. They share faces, texture coordinates and clusters with the mesh at
 * rest. Their boxes are right for culling.
 * Always: rules R70 to R75 of docs/exactness; the same bytes on any number of threads. */
#pragma once

#include "e3d_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    E3D_JOINT_MATRIX = 16, /* floats: four columns of x y z 0 */
    E3D_POSED_BOX = 9      /* a box like E3D_OBJECT_BOX of e3d_scene.h */
};

/* The arrays that move the vertices of a mesh. They are borrowed. */
typedef struct e3d_pose_desc {
    const float *normals;         /* (vertices, 3) or NULL */
    const float *tangents;        /* (vertices, 4) or NULL */
    int32_t influences;           /* of each vertex; 0: no joints */
    const uint16_t *joints;       /* (vertices, influences) */
    const float *weights;         /* (vertices, influences), finite; each vertex has at least one that isn't 0 */
    int32_t targets;
    const float *target_positions, *target_normals, *target_tangents; /* (targets, vertices, 3) or NULL */
} e3d_pose_desc;

typedef struct e3d_rest e3d_rest;

/* The mesh must outlive the result. It has `movers` where clusters share vertices that do not move alike. */
e3d_status e3d_rest_create(const e3d_mesh *mesh, const e3d_pose_desc *desc, e3d_rest **out);
void e3d_rest_destroy(e3d_rest *rest);
/* The number of joints that the vertices refer to: the highest index and one. */
int32_t e3d_rest_joints(const e3d_rest *rest);
/* Makes a mesh to be posed, which borrows from the one at rest. With face_normals it has normals of its faces, too. */
e3d_status e3d_posed_create(const e3d_rest *rest, int face_normals, e3d_mesh **out);
const float *e3d_posed_positions(const e3d_mesh *posed);
const float *e3d_posed_normals(const e3d_mesh *posed);
const float *e3d_posed_tangents(const e3d_mesh *posed);

/* One mesh to pose. */
typedef struct e3d_pose_job {
    const e3d_rest *rest;
    const float *matrices; /* (joints, E3D_JOINT_MATRIX), node from rest; NULL: no joints */
    const float *weights;  /* (targets,); NULL: all 0 */
    e3d_mesh *out;
    double box[E3D_POSED_BOX]; /* found */
} e3d_pose_job;

/* Poses different meshes on up to `threads` threads. */
void e3d_pose_meshes(e3d_pose_job *jobs, int32_t count, int threads);
/* Poses one mesh's vertices one by one, as the rules are written: tests compare with it. normals and tangents may be NULL. */
void e3d_reference_pose(const e3d_mesh_desc *mesh, const e3d_pose_desc *desc, const float *matrices, const float *weights,
                        float *positions, float *normals, float *tangents);

/* A skin's joints: their matrices follow from the poses of the nodes between an anchor and the joints. */
typedef struct e3d_skeleton {
    int32_t links;         /* how many nodes lie on the ways from the anchor to the joints; parents come first */
    const int32_t *slots;  /* (links,) */
    const int32_t *above;  /* (links,) the number of each link's parent; -1: the anchor */
    int32_t joints;
    const int32_t *ends;   /* (joints,) the number of each joint's link */
    const double *inverse_binds; /* (joints, 12) joint from rest */
} e3d_skeleton;

/* Writes the joints' matrices (R70); ways: (links, 12), scratch. poses: (slots, 12), parent from node. */
void e3d_skeleton_matrices(const e3d_skeleton *skeleton, const double *poses, double *ways, float *matrices);

#ifdef __cplusplus
}
#endif
