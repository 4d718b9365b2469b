/* What is computed of the triangles and polygons of a file: normals, edges, triangles of polygons. */
#ifndef E3D_SURFACES_H
#define E3D_SURFACES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum e3d_sums_problem {
    E3D_SUMS_DONE,
    E3D_SUMS_NO_MEMORY,
    E3D_SUMS_OUT_OF_RANGE, /* an index of a position or of a group */
} e3d_sums_problem;

/* Triangles whose corners are in groups. */
typedef struct e3d_surface {
    const void *positions; /* [3 * position_count] doubles or floats */
    bool are_doubles;
    const int32_t *faces, *groups; /* [3 * face_count] of each corner its position and its group */
    size_t position_count, face_count, group_count;
} e3d_surface;

/* Adds to sums[3 * group_count] the unit normals of all triangles, times the angle at the corner that is in
 * the group; `block_faces` triangles are added up at a time, and their sums to the others. */
e3d_sums_problem e3d_smooth_sums(const e3d_surface *surface, size_t block_faces, double *sums);

/* A surface that is smooth but for its creases. */
typedef struct e3d_creased_surface {
    const float *positions;  /* [3 * position_count] */
    const int32_t *faces;    /* [3 * face_count] in range, fewer than 2^31 */
    const int32_t *places;   /* of each vertex the place where it is, less than place_count; NULL: each has its own */
    const uint8_t *visible;  /* [3 * face_count] 0 for the side behind a corner that is the diagonal of a polygon; NULL: none is */
    size_t position_count, face_count, place_count;
    double cosine; /* of the angle between two triangles' normals beyond which their edge is a crease */
} e3d_creased_surface;

/* Its corners and normals; freed by e3d_free_creases. */
typedef struct e3d_creases {
    int32_t *faces;   /* [3 * face_count] */
    int32_t *sources; /* [added] the vertex that each further one is at */
    float *normals;   /* [3 * (position_count + added)] */
    size_t added;
    bool is_smooth; /* whether all corners at a place have one normal */
} e3d_creases;

/* Finds them; false if memory is out. */
bool e3d_find_creases(const e3d_creased_surface *surface, e3d_creases *made);
void e3d_free_creases(e3d_creases *made);

/* Finds whether the triangles enclose a volume, their fronts outside; the angle and what is visible do not matter.
 * -1 if memory is out. */
int e3d_encloses(const e3d_creased_surface *surface);

/* Finds the sides that one triangle alone has: sides[2 * room], the places that it runs along from and to. Returns how many; -1
 * if memory is out, -2 if they are more than `room`, or a side is run along more often one way than the other by several. */
int64_t e3d_find_open_sides(const e3d_creased_surface *surface, int32_t *sides, size_t room);

/* Triangles that wear an image: (vertices, 3) positions and normals, (vertices, 2) coordinates whose origin is at the bottom left,
 * and a number for each vertex, the same for those that are equal in all of these. */
typedef struct e3d_mapped_surface {
    const float *positions, *normals, *uvs;
    const int32_t *faces, *points; /* in range */
    size_t face_count;             /* below 2^30 */
} e3d_mapped_surface;

/* Finds which corners share a tangent, (faces, 3), and the tangents: (groups, 4), for which there is room for three a face. False
 * if memory is out. */
bool e3d_find_tangents(const e3d_mapped_surface *surface, int32_t *groups, float *tangents, size_t *group_count);

/* The sides of triangles: side k of a face is from its vertex k to the next one. */
typedef struct e3d_sides {
    const int32_t *faces;  /* [3 * face_count] */
    const int32_t *points; /* of each vertex the point that it is, less than point_count; NULL: each is its own */
    const uint8_t *wanted; /* [3 * face_count]; NULL: all are */
    size_t face_count, point_count;
} e3d_sides;

/* Marks each side that is the first between its two points, of those that are wanted and join two. first[3 * face_count] is
 * zeros to begin with. False if memory is out; fewer than 2^32 sides. */
bool e3d_find_edges(const e3d_sides *sides, uint8_t *first);

typedef enum e3d_cut_problem {
    E3D_CUT_DONE,
    E3D_CUT_NO_MEMORY,
    E3D_CUT_OUT_OF_RANGE, /* an index of a position, a size, or the number of all corners */
} e3d_cut_problem;

/* Polygons, whose corners stand one behind another. */
typedef struct e3d_polygons {
    const int32_t *sizes;   /* [count] corners of each; those of fewer than three give no triangle */
    const int32_t *indices; /* [corner_count] of each corner its position; NULL if it has the corner's number */
    const void *positions;  /* [3 * position_count] doubles or floats */
    bool are_doubles;
    size_t count, corner_count, position_count;
} e3d_polygons;

/* n - 2 triangles for a polygon of n corners. */
typedef struct e3d_cut {
    int32_t *corners;  /* [3 * triangles] corner numbers, counted over all polygons */
    int32_t *polygons; /* [triangles] the polygon that each is part of */
    uint8_t *visible;  /* [3 * triangles] whether the edge behind a corner is the polygon's */
    bool all_visible;
    bool is_complete;  /* false if concave polygons were cut as fans, since no tests were left or they are too large */
} e3d_cut;

/* Cuts polygons into triangles; what is tested to find the ears of concave ones is taken from *tests. */
e3d_cut_problem e3d_cut_polygons(const e3d_polygons *polygons, int64_t *tests, e3d_cut *made);

#endif
