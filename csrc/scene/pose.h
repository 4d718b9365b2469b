/* Poses: quaternion, scale and offset to a matrix and back, products, boxes. In f64, in the order of engine/base/linalg, to
 * the bit. */
#pragma once

#include "e3d_scene.h"

/* Sets the 3x3 part of a pose; the offset stays. Returns 0 if the quaternion's length is zero or not finite. */
int e3d_pose_compose(const double rotation[4], const double scale[3], double pose[12]);
void e3d_pose_decompose(const double pose[12], double rotation[4], double scale[3]);
void e3d_pose_multiply(const double a[12], const double b[12], double out[12]);
/* Finds the AABB around an object's box at a pose. */
void e3d_pose_box(const double pose[12], const double box[E3D_OBJECT_BOX], double out[E3D_BOX]);

/* Finds node-from-instance of one of many instances; 0 if it is not finite. */
int e3d_instance_pose(const float *poses, e3d_pose_kind kind, int32_t instance, double out[12]);
