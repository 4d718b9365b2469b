/* Where what a picture shows is at another moment, and whether it shows there (R182 ... R184).
 * In: the identities and barycentric coordinates of the pixels of a picture; things at a moment, as a camera has them.
 * Out: points in the camera's space, their places in its picture, and marks.
 * Always: f64, one written order of operations. The number of threads doesn't change the result. */
#pragma once

#include <stdint.h>

#include "e3d_scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a picture shows at each pixel (R35). */
typedef struct e3d_seen {
    int32_t pixels;
    const int32_t *object_id, *instance_id, *face_id; /* (pixels,) */
    const float *barycentric;                         /* (pixels, 3) */
} e3d_seen;

/* Triangles at a moment. */
typedef struct e3d_thing {
    const float *positions; /* (vertices, 3), as bent */
    const int32_t *faces;   /* (face_count, 3) */
    int32_t face_count;
    double view_from_thing[12];
    e3d_pose_kind pose_kind;
    int32_t instances;
    const float *poses;
} e3d_thing;

/* The things of a moment; thing_of: (ids,), the row of the thing that an object_id names, -1: none. */
typedef struct e3d_things {
    const e3d_thing *rows;
    const int32_t *thing_of;
    int32_t ids;
} e3d_things;

/* R182: points (pixels, 3) in the camera's space; NaN where a pixel shows no triangle that is there at the moment. */
void e3d_seen_points(const e3d_seen *seen, const e3d_things *things, double *points, int threads);
/* R183: places (count, 2) in pixels of points (count, 3), by rows of x, y and w; NaN unless w > 0. */
void e3d_points_to_pixels(const double screen_from_view[12], const double *points, int32_t count, double *pixels, int threads);

/* What is compared: points that a picture shows, at another moment, in whose own picture they have places. */
typedef struct e3d_seen_again {
    const e3d_seen *first, *second;
    const e3d_things *things; /* of the second picture */
    const double *points;     /* (first.pixels, 3), in the second camera's space */
    const int32_t *at;        /* (first.pixels,): the pixel of the second picture that each lies in; -1: none */
    int32_t width, height;    /* of the second picture */
    int in_perspective;       /* the second camera's eye is at the origin; else it looks along -z from infinity */
} e3d_seen_again;

/* R184: visible (first.pixels,): 1 where the second picture shows the point. */
void e3d_find_seen_again(const e3d_seen_again *job, uint8_t *visible, int threads);

#ifdef __cplusplus
}
#endif
