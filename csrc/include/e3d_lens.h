/* Pictures through a lens, looked up in the pinhole pictures around it (docs/exactness, section 31).
 * In: the pinhole pictures one after the other, and for each pixel of the lens where it looks into which of them.
 * Out: the lens's picture, or for each pixel the face that its ray meets.
 * Always: whole numbers, or f64 in one order of operations: the number of threads changes nothing. */
#pragma once

#include <stdint.h>

#include "e3d_backends.h"
#include "e3d_scene.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A pinhole picture: its pixels stand from `start` on, row after row. */
typedef struct e3d_lens_face {
    int64_t start;
    int32_t width, height;
    double axes[3][3]; /* camera space: right, up and back, each along an axis */
} e3d_lens_face;

/* Where a pixel of the lens looks: 1/256 pixel of a face, its top left corner is 0; and half the widths of its filter, at least
 * 256. Face -1: it sees nothing. */
typedef struct e3d_lens_pixel {
    int32_t x, y, face;
    uint16_t across, down;
} e3d_lens_pixel;

/* How bytes become light and back: 16-bit light of each byte, and the byte of each light. */
typedef struct e3d_lens_codes {
    uint16_t light[256];
    uint8_t code[65536];
} e3d_lens_codes;

/* Fills the codes of sRGB, or of bytes that are proportional to light. */
void e3d_lens_codes_fill(e3d_lens_codes *codes, int is_srgb);

typedef struct e3d_lens_colors {
    const e3d_lens_face *faces;
    const e3d_lens_pixel *pixels; /* (height, width) */
    const e3d_lens_codes *codes;
    const uint8_t *from;          /* RGBA of all faces, `total` pixels */
    uint16_t *light;              /* scratch: (total, 4) */
    int64_t total;
    const uint8_t *behind;        /* NULL, or the opaque picture that shows where `from` is transparent (height, width, 4) */
    uint8_t outside[4];           /* of pixels that see nothing */
    int32_t width, height;
    uint8_t *to;                  /* (height, width, 4) */
} e3d_lens_colors;

/* threads: at least 1; their number doesn't change the bytes. */
e3d_status e3d_lens_draw(const e3d_lens_colors *colors, e3d_backend backend, int threads);

/* What the faces show: arrays over their pixels, as frames have them. */
typedef struct e3d_lens_shown {
    const int32_t *object_id, *instance_id, *face_id;
    const float *depth;
} e3d_lens_shown;

typedef struct e3d_lens_scene {
    const e3d_graph *graph;
    const e3d_tree *tree;
    const e3d_shape *shapes;
    int32_t shape_count;
    const int32_t *ids, *slots; /* (id_count,) ids in rising order, and their slots */
    int32_t id_count;
    const uint8_t *solid;       /* by slot: 1 where every part of every face shows */
    int any_side;               /* 0: faces are culled */
} e3d_lens_scene;

/* What the rays meet, (height, width) each; NULL: not asked for. */
typedef struct e3d_lens_found {
    int32_t *source; /* the pixel of the faces whose values it takes; -1: none */
    int32_t *object_id, *instance_id, *face_id; /* -1: none */
    float *depth, *range;  /* the distance along the ray, in camera space; 0: none */
    int is_along_axis;     /* depth is measured along the lens's axis */
    double *distance;      /* range before it is rounded */
    float *barycentric;    /* (height, width, 3) of exact hits */
    uint8_t *exact;        /* 1 where barycentric has values; NULL only with it */
} e3d_lens_found;

/* Finds for each pixel the face that its ray meets first. rays: (height, width, 3) unit, camera space. near, far: of the faces'
 * clip planes, along their axes. Returns how many rays were cast into the scene. */
int64_t e3d_lens_find(const e3d_lens_scene *scene, const e3d_lens_face *faces, const e3d_lens_pixel *pixels,
                      const double *rays, int32_t width, int32_t height, const double world_from_view[16],
                      double near, double far, const e3d_lens_shown *shown, const e3d_lens_found *found,
                      int threads);

enum { E3D_LENS_FACES = 6 };

/* Values of the faces' pixels, those of the sources of a lens's pixels (R208). */
typedef struct e3d_lens_values {
    const e3d_lens_face *faces;
    int32_t face_count;           /* at most E3D_LENS_FACES */
    const e3d_lens_pixel *pixels; /* (height, width) */
    const int32_t *source;        /* (height, width) */
    const uint8_t *from;          /* a row of `bytes` a pixel of the faces */
    int32_t bytes;                /* at least 12 if turned */
    int is_turned;                /* the first three numbers, f32, are of a vector in the axes of the face */
    uint8_t none;                 /* each byte where there is no source */
    int32_t width, height;
    uint8_t *to;                  /* (height, width, bytes) */
} e3d_lens_values;

void e3d_lens_take(const e3d_lens_values *values, int threads);

#ifdef __cplusplus
}
#endif
