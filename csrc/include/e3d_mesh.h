/* Meshes: handles that borrow the arrays of vertices, faces, lines and points. */
#ifndef E3D_API_MESH_H
#define E3D_API_MESH_H

#include <stddef.h>
#include <stdint.h>

#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct e3d_mesh e3d_mesh;

/* Borrowed arrays; a NULL optional array means "none". Indices must be in range (checked). */
typedef struct e3d_mesh_desc {
    const float *positions;       /* (vertices, components) object space, or clip space if 4 */
    int32_t components;           /* 3, or 4 for positions that already are clip space */
    int32_t vertices;
    const int32_t *faces;         /* (faces_count, 3) */
    int32_t faces_count;
    const float *normals;         /* (vertices, 3) or NULL */
    const float *face_normals;    /* (faces_count, 3) or NULL: needed only for flat shading */
    const float *uvs;             /* (vertices, 2) or NULL, origin bottom-left */
    const uint8_t *colors_u8;     /* (vertices, 4) or NULL; at most one of u8 and f32 */
    const float *colors_f32;      /* (vertices, 4) or NULL, linear */
    const int32_t *material_ids;  /* (faces_count,) or NULL: all 0 */
    const int32_t *lines;         /* (lines_count, 2) */
    int32_t lines_count;
    const int32_t *points;        /* (points_count,) */
    int32_t points_count;
    const int32_t *edges;         /* (edges_count, 2) unique visible edges, for wireframe */
    int32_t edges_count;
} e3d_mesh_desc;

/* On up to `threads` threads (0 is e3d_thread_count()), which change nothing of the mesh. */
e3d_status e3d_mesh_create(const e3d_mesh_desc *desc, int32_t threads, e3d_mesh **out);
void e3d_mesh_destroy(e3d_mesh *mesh);
/* Arrays that are made only when a picture needs them. */
void e3d_mesh_set_normals(e3d_mesh *mesh, const float *normals);
void e3d_mesh_set_face_normals(e3d_mesh *mesh, const float *face_normals);
e3d_status e3d_mesh_set_edges(e3d_mesh *mesh, const int32_t *edges, int32_t count);
const e3d_mesh_desc *e3d_mesh_view(const e3d_mesh *mesh);
/* The box of the points, (count, 3), that are finite, and whether there are any; else it is all zero. */
int e3d_bound_points(const float *points, int64_t count, float lo[3], float hi[3]);

#ifdef __cplusplus
}
#endif

#endif
