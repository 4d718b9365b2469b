/* Meshes: handles that borrow arrays of vertices, faces, lines and points. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_options.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct e3d_mesh e3d_mesh;

/* The attributes of vertices besides the position: X(ENUMERATOR, name, type of a channel, channels). All are optional; colours
 * have one of the two types. */
#define E3D_EACH_VERTEX_ATTRIBUTE(X) \
    X(E3D_VERTEX_NORMALS, normals, float, 3) \
    X(E3D_VERTEX_UVS, uvs, float, 2) /* origin bottom-left */ \
    X(E3D_VERTEX_UVS1, uvs1, float, 2) /* a second set */ \
    X(E3D_VERTEX_TANGENTS, tangents, float, 4) /* w times cross(normal, tangent) is the bitangent */ \
    X(E3D_VERTEX_COLORS_U8, colors_u8, uint8_t, 4) \
    X(E3D_VERTEX_COLORS_F32, colors_f32, float, 4) /* linear */

typedef enum e3d_vertex_attribute { E3D_EACH_VERTEX_ATTRIBUTE(E3D_ENUMERATOR) E3D_VERTEX_ATTRIBUTES } e3d_vertex_attribute;

extern const e3d_array_format E3D_VERTEX_FORMATS[E3D_VERTEX_ATTRIBUTES];

/* Borrowed arrays; an optional array may be NULL. Indices must be in range; this is checked. */
typedef struct e3d_mesh_desc {
    const float *positions;       /* (vertices, components) object space, or clip space if 4 */
    int32_t components;           /* 3, or 4 for positions that already are clip space */
    int32_t vertices;
    const int32_t *faces;         /* (faces_count, 3) */
    int32_t faces_count;
#define E3D_VERTEX_ARRAY(enumerator, name, type, ...) const type *name;
    E3D_EACH_VERTEX_ATTRIBUTE(E3D_VERTEX_ARRAY) /* (vertices, channels) or NULL */
    const float *face_normals;    /* (faces_count, 3) or NULL; only flat shading needs them */
    const int32_t *material_ids;  /* (faces_count,) or NULL: all 0 */
    const int32_t *lines;         /* (lines_count, 2) */
    int32_t lines_count;
    const int32_t *points;        /* (points_count,) */
    int32_t points_count;
    const int32_t *edges;         /* (edges_count, 2) unique visible edges, for wireframe */
    int32_t edges_count;
    /* (vertices,) or NULL: vertices at one place share a cluster's vertex only if these numbers are equal */
    const int32_t *movers;
} e3d_mesh_desc;

/* threads: at most so many; 0 means e3d_thread_count(). Their number doesn't change the mesh. */
e3d_status e3d_mesh_create(const e3d_mesh_desc *desc, int32_t threads, e3d_mesh **out);
void e3d_mesh_destroy(e3d_mesh *mesh);
void e3d_mesh_desc_set(e3d_mesh_desc *desc, e3d_vertex_attribute attribute, const void *array);
/* Sets arrays that are made only when a picture needs them. */
void e3d_mesh_set_attribute(e3d_mesh *mesh, e3d_vertex_attribute attribute, const void *array);
void e3d_mesh_set_face_normals(e3d_mesh *mesh, const float *face_normals);
e3d_status e3d_mesh_set_edges(e3d_mesh *mesh, const int32_t *edges, int32_t count);
const e3d_mesh_desc *e3d_mesh_view(const e3d_mesh *mesh);
/* Finds the box of the finite ones among points, (count, 3). Returns 0, and a box of zeros, if there are none. */
int e3d_bound_points(const float *points, int64_t count, float lo[3], float hi[3]);

#ifdef __cplusplus
}
#endif
