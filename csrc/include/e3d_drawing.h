/* Line drawings without hidden lines: which parts of lines lie behind triangles, on a drawing of vectors.
 * In: triangles and lines, each corner with its place in the world and on the drawing. Out: the pieces of lines, hidden or not.
 * Always: any double is legal, and what is not finite hides nothing and has no pieces. All is the same for any number of threads.
 * The method is that of docs/drawings.md: on the drawing, a triangle hides a stretch of a line that is found in closed form. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_status.h"

/* A place on the drawing: right and down, the inverse of w (1 in parallel projections), and a depth that is linear on the drawing
 * and less for what is nearer. */
enum { E3D_SHEET_X,
       E3D_SHEET_Y,
       E3D_SHEET_INVERSE_W,
       E3D_SHEET_DEPTH,
       E3D_SHEET };

typedef struct e3d_hiders {
    const double *places; /* (vertices, 3): in the world */
    const double *sheet;  /* (vertices, E3D_SHEET) */
    const int32_t *faces; /* (count, 3), in range */
    size_t count;         /* below 2^31 */
    double eye[4];        /* the viewer, or the direction to him and 0 */
    double thickness;     /* a line so near a triangle's plane lies on it, in the world's units */
    double reach;         /* triangles reach so far beyond their sides, in the drawing's units */
    const uint8_t *needless; /* (count,): those that others hide lines for; NULL: none */
} e3d_hiders;

typedef struct e3d_lines {
    const double *places; /* (count, 2, 3) */
    const double *sheet;  /* (count, 2, E3D_SHEET) */
    size_t count;         /* below 2^31 */
    double least;         /* shorter pieces belong to their neighbours, in the drawing's units */
    const uint8_t *behind; /* (count,): those that are known to be hidden; NULL: none */
} e3d_lines;

/* A stretch of a line, from 0 to 1 on the drawing. */
typedef struct e3d_piece {
    int32_t line, is_hidden;
    double from, to;
} e3d_piece;

/* The pieces of lines, line by line, each from its beginning to its end; lines that are points on the drawing have none.
 * *pieces is to be freed with free(). */
e3d_status e3d_hide_lines(const e3d_hiders *hiders, const e3d_lines *lines, int threads, e3d_piece **pieces, size_t *count);

/* The pieces of segments (count, 2, 2) on the drawing; those are hidden along which an earlier segment lies within `tolerance`. */
e3d_status e3d_hide_repeated(const double *segments, size_t count, double tolerance, int threads, e3d_piece **pieces, size_t *found);

/* An edge of triangles. */
typedef struct e3d_side {
    int32_t low, high; /* its vertices */
    int32_t first, second; /* 3 f + k: side k of face f; the second is -1 at a border */
    int32_t uses;          /* how many triangles have it */
} e3d_side;

/* The edges of triangles (count, 3) of `vertices` vertices, each once, by their vertices in ascending order. Sides from a vertex
 * to itself are none. *sides is to be freed with free(). */
e3d_status e3d_find_sides(const int32_t *faces, size_t count, size_t vertices, e3d_side **sides, size_t *found);

/* Of sides: their vertices and triangles, ends and beside (count, 2), the second triangle -1 for a border, and whether two triangles
 * run along it in the same direction, so that they have opposite winding. */
void e3d_unfold_sides(const int32_t *faces, const e3d_side *sides, size_t count, int32_t *ends, int32_t *beside, uint8_t *turned);

/* The cosines of the angles between the triangles at edges, by their normals, as if all were wound alike; 1 where one is missing. */
void e3d_find_cosines(const double *normals, const int32_t *beside, const uint8_t *turned, size_t count, double *cosines);

/* For each of `count` triangles, whose sides are given, 1 if it belongs to a body that encloses a volume with its fronts outside, -1
 * if with its backs, else 0. */
e3d_status e3d_find_enclosing(const double *places, size_t vertices, const int32_t *faces, size_t count, const e3d_side *sides, size_t side_count,
                              int8_t *enclosing);

/* The unit normals (count, 3) of triangles; 0 for those whose height is at most `lowest`, or that are not finite. */
void e3d_find_normals(const double *places, const int32_t *faces, size_t count, double lowest, double *normals);

/* For each of `count` triangles the least vertex of its body: of all triangles that hang together by vertices.
 * above[vertices]: room to work in. */
void e3d_number_bodies(const int32_t *faces, size_t count, size_t vertices, int32_t *above, int32_t *bodies);

/* Segments in which triangles of different parts cross. */
typedef struct e3d_crossing {
    int32_t faces[2];
    double ends[6];
} e3d_crossing;

/* The segments in which triangles whose parts differ cross, by their faces in ascending order. A corner within `thickness` of the
 * other triangle's plane lies on it. *crossings is to be freed with free(). */
e3d_status e3d_cross_surfaces(const double *places, const int32_t *faces, const int32_t *parts, size_t count, double thickness,
                              int threads, e3d_crossing **crossings, size_t *found);

/* Triangles in the world. */
typedef struct e3d_surface {
    const double *places; /* (vertex_count, 3) */
    const int32_t *faces; /* (face_count, 3) */
    size_t vertex_count, face_count;
} e3d_surface;

/* The edges of triangles, and the triangles at their sides. */
typedef struct e3d_edges {
    e3d_surface of;
    const double *normals;        /* (face_count, 3): unit normals, or 0 */
    const int32_t *parts;         /* (face_count,) */
    const int8_t *enclosing;      /* (face_count,): as of e3d_find_enclosing */
    const int32_t *ends, *beside; /* (count, 2): vertices, and triangles, the second of which may be -1 for none */
    const uint8_t *turned;        /* (count,): whether the two triangles have opposite winding */
    const int8_t *kinds;          /* (count,): what an edge is even if it is no outline, -1 for nothing */
    size_t count;
} e3d_edges;

/* Lines that are no edges. */
typedef struct e3d_other_lines {
    const double *ends; /* (count, 2, 3) in the world */
    const int8_t *kinds;
    const int32_t *parts;
    size_t count, cut; /* the first plane of the view cuts only the first `cut` */
} e3d_other_lines;

enum { E3D_VIEW_PLANES = 4 };

typedef struct e3d_view {
    double clip_from_world[16], size[2]; /* of the frame, in millimetres */
    double eye[4];                       /* the viewer, or the direction to him and 0 */
    double planes[E3D_VIEW_PLANES][4];   /* what is drawn has a x + b y + c z + d >= 0 */
    size_t plane_count;
    double thickness; /* as that of e3d_hiders */
    double nearness;  /* millimetres: lines so near each other are one stroke */
    int32_t is_parallel;
    int32_t is_outside; /* whether the viewer is outside of all bodies; the planes cut none of these */
    int8_t outline; /* the kind of outlines; kinds are at least 0, the most important first */
} e3d_view;

/* A straight piece of a line on paper: x right, y down, from the frame's upper left corner, in millimetres. */
typedef struct e3d_stroke {
    double ends[4];
    int32_t part;
    int8_t kind, is_hidden;
} e3d_stroke;

/* The strokes of a view: visible ones first, by their kinds; each place once. *strokes is to be freed with free(). */
e3d_status e3d_draw_view(const e3d_edges *edges, const e3d_other_lines *others, const e3d_surface *hiders, const e3d_view *view,
                         int threads, e3d_stroke **strokes, size_t *count);
