/* What is computed from the triangles and polygons of a file: normals, edges, triangulations. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum e3d_sums_problem {
    E3D_SUMS_DONE,
    E3D_SUMS_NO_MEMORY,
    E3D_SUMS_OUT_OF_RANGE, /* an index of a position or of a group is out of range */
} e3d_sums_problem;

/* Triangles whose corners are in groups. */
typedef struct e3d_surface {
    const void *positions; /* [3 * position_count] doubles or floats */
    bool are_doubles;
    const int32_t *faces, *groups; /* [3 * face_count] the position and the group of each corner */
    size_t position_count, face_count, group_count;
} e3d_surface;

/* Adds to sums[3 * group_count] the unit normals of all triangles, each times its angle at the corner in that group. The sums of
 * `block_faces` triangles are added up first, and then added to the others. */
e3d_sums_problem e3d_smooth_sums(const e3d_surface *surface, size_t block_faces, double *sums);

/* A surface that is smooth but for its creases. */
typedef struct e3d_creased_surface {
    const float *positions;  /* [3 * position_count] positions */
    const int32_t *faces;    /* [3 * face_count] in range, fewer than 2^31 */
    const int32_t *places;   /* of each vertex the number of its place, below place_count; NULL: each has a place of its own */
    const uint8_t *visible;  /* [3 * face_count] 0 where the side behind a corner is a diagonal of a polygon; NULL: no side is */
    size_t position_count, face_count, place_count;
    double cosine; /* an edge is a crease where the angle between its triangles' normals has a smaller cosine */
} e3d_creased_surface;

/* The vertices and normals of a creased surface; e3d_free_creases frees them. */
typedef struct e3d_creases {
    int32_t *faces;   /* [3 * face_count] */
    int32_t *sources; /* [added] the vertex that each added one copies */
    float *normals;   /* [3 * (position_count + added)] */
    size_t added;
    bool is_smooth; /* true if all corners at a place share one normal */
} e3d_creases;

/* Finds the creases of a surface; false if memory is out. */
bool e3d_find_creases(const e3d_creased_surface *surface, e3d_creases *made);
void e3d_free_creases(e3d_creases *made);

/* Finds whether the triangles enclose a volume, with their fronts outside; `cosine` and `visible` are not used. -1 if memory is
 * out. */
int e3d_encloses(const e3d_creased_surface *surface);

/* Finds the sides that only one triangle has: sides[2 * room], from place to place. Returns how many there are; -1 if memory is
 * out; -2 if there are more than `room`, or if triangles run along a side at least twice more in one direction than in the
 * other. */
int64_t e3d_find_open_sides(const e3d_creased_surface *surface, int32_t *sides, size_t room);

/* Textured triangles: (vertices, 3) positions and normals, (vertices, 2) coordinates from the bottom left, and a number for each
 * vertex, which equal vertices share. */
typedef struct e3d_mapped_surface {
    const float *positions, *normals, *uvs;
    const int32_t *faces, *points; /* in range */
    size_t face_count;             /* below 2^30 */
} e3d_mapped_surface;

/* Finds the tangents, (groups, 4), and the number of each corner's tangent, (faces, 3). There is room for three groups a face.
 * False if memory is out. */
bool e3d_find_tangents(const e3d_mapped_surface *surface, int32_t *groups, float *tangents, size_t *group_count);

/* The sides of triangles: side k of a face is from its vertex k to the next one. */
typedef struct e3d_sides {
    const int32_t *faces;  /* [3 * face_count] */
    const int32_t *points; /* of each vertex the number of its point, below point_count; NULL: each has a point of its own */
    const uint8_t *wanted; /* [3 * face_count] not 0 where the side is wanted; NULL: all are */
    size_t face_count, point_count;
} e3d_sides;

/* Sets first[3 * face_count], zeros at first, to 1 at each wanted side that joins two points and is the first one between them.
 * There are fewer than 2^32 sides. False if memory is out. */
bool e3d_find_edges(const e3d_sides *sides, uint8_t *first);

typedef enum e3d_cut_problem {
    E3D_CUT_DONE,
    E3D_CUT_NO_MEMORY,
    E3D_CUT_OUT_OF_RANGE, /* an index of a position, a size, or the count of corners is out of range */
} e3d_cut_problem;

/* Polygons; their corners follow each other. */
typedef struct e3d_polygons {
    const int32_t *sizes;   /* [count] the number of corners; a polygon of fewer than three gives no triangle */
    const int32_t *indices; /* [corner_count] the position of each corner; NULL: a corner has the position of its own number */
    const void *positions;  /* [3 * position_count] doubles or floats */
    bool are_doubles;
    size_t count, corner_count, position_count;
} e3d_polygons;

/* The triangles of polygons: n - 2 for n corners. */
typedef struct e3d_cut {
    int32_t *corners;  /* [3 * triangles] numbers of corners, counted over all polygons */
    int32_t *polygons; /* [triangles] the polygon of each triangle */
    uint8_t *visible;  /* [3 * triangles] whether the side behind a corner is a side of the polygon */
    bool all_visible;
    bool is_complete;  /* false if concave polygons were cut as fans: they are too large, or no tests were left */
} e3d_cut;

/* Triangulates polygons. Each search for an ear of a concave polygon takes its tests from *tests. */
e3d_cut_problem e3d_cut_polygons(const e3d_polygons *polygons, int64_t *tests, e3d_cut *made);
