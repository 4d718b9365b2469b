/* What shading works on: surfaces, batches of their samples, and where the colours go. */
#ifndef E3D_KERNELS_SHADING_H
#define E3D_KERNELS_SHADING_H

#include <stddef.h>
#include <stdint.h>

#include "core/limits.h"
#include "e3d.h"

enum { E3D_BATCH = 256, E3D_BATCH_SURFACES = 128 };

typedef float e3d_surface_floats[E3D_BATCH_SURFACES + E3D_PAD];
typedef int32_t e3d_surface_words[E3D_BATCH_SURFACES + E3D_PAD];

/* What visible pieces bring to their samples, one an element. (All arrays of this and of e3d_batch are whole lines of the
 * cache, where the structs are aligned to one: vectors that lie across two take twice as long.) */
typedef struct e3d_surfaces {
    e3d_surface_words project;     /* 0: from a record; else `project` finds x, y, iw, swapped and back; 1, or 3 in a mirrored instance */
    e3d_surface_words x[3], y[3];  /* corners after R9 */
    e3d_surface_floats iw[3];
    e3d_surface_words swapped;     /* not 0: R9 exchanged vertices 1 and 2 */
    e3d_surface_words matrix;      /* number of its matrices: ascends by 1 at most; its last is repeated over the pad */
    e3d_surface_floats clip[16], world[12], normals[9]; /* matrices of R1 and R2, one an element */
    e3d_surface_floats position[3][3]; /* [component][vertex]: object space, then world */
    e3d_surface_floats normal[3][3];   /* likewise, then turned where the face looks away; flat: vertex 0 has the face's */
    e3d_surface_floats uv[2][3];
    e3d_surface_floats color[3][3];    /* [component][vertex] */
    e3d_surface_floats instance_color[3];
    e3d_surface_words back;        /* not 0: the face looks away */
    e3d_surface_floats p[3], px[3], py[3]; /* barycentric planes, R18 */
    e3d_surface_floats base_x, base_y;     /* relative to the tile's first sample */
    e3d_surface_floats slope[2][3]; /* [coordinate]: along, down and turn of R25 */
    e3d_surface_words piece, instance; /* whose they are; the kernels don't read it */
    int32_t count, matrices;
    int32_t irregular;             /* how many are clipped, or not of a face of three-component vertices */
    int32_t projected;             /* how many have no record */
    float texels[2];               /* of E3D_WANT_LEVEL: the size of their texture */
} e3d_surfaces;

typedef float e3d_lane_array[E3D_BATCH + E3D_PAD];

/* Samples of one material on their way to a colour. Each but the first is of the same surface as the one before it or of
 * the next. Up to a multiple of E3D_PAD `sample` and `surface` repeat the last: whole vectors read them. */
typedef struct e3d_batch {
    int32_t sample[E3D_BATCH + E3D_PAD];  /* y * E3D_TILE + x in the tile */
    int32_t surface[E3D_BATCH + E3D_PAD]; /* its element of e3d_surfaces */
    int32_t steps[E3D_BATCH + E3D_PAD];   /* take_runs's: 0 before and after */
    e3d_lane_array weight[3], r; /* of R19 */
    e3d_lane_array position[3], normal[3], uv[2], color[3];
    int32_t lod[E3D_BATCH + E3D_PAD];
    e3d_lane_array energy[3], shine[3];
    int count;
} e3d_batch;

/* What interpolation fills. */
enum {
    E3D_WANT_POSITION = 1,
    E3D_WANT_NORMAL = 2,
    E3D_WANT_UV = 4,
    E3D_WANT_FLAT = 8, /* with E3D_WANT_NORMAL: of the face */
    E3D_WANT_LEVEL = 16, /* lod of R26, of as many levels as there could be */
    E3D_WANT_SURFACE = 32, /* any of these */
    E3D_WANT_WEIGHTS = 64  /* and r */
};

/* `reach`: of each light, and E3D_PAD more, its position, the square of its range (a NaN where nothing is out of it) and 1
 * over that square. */
typedef struct e3d_lighting {
    const e3d_light *lights;
    int light_count;
    const float *reach[5];
    float ambient[3], clamp[2], eye[4];
} e3d_lighting;

/* A tile's samples, where there are several a pixel. */
typedef struct e3d_samples {
    float color[3][E3D_TILE_SAMPLES + E3D_PAD]; /* clamped, or 0 where one doesn't count */
    float counts[E3D_TILE_SAMPLES + E3D_PAD];   /* 1, or 0 where a transparent background shows */
} e3d_samples;

/* Rows of pixels: `count`, of so many bytes, and how far one begins from the other. */
typedef struct e3d_pixel_rows {
    char *to;
    const char *from;
    size_t bytes, pitch, step;
    int count;
} e3d_pixel_rows;

/* How the samples of a batch become pixels. */
typedef struct e3d_paint {
    int wanted;                      /* E3D_WANT_* */
    const e3d_texture_view *texture; /* may be NULL */
    const float *base;               /* colour of the material */
    int by_vertex, by_instance;      /* colours to multiply with */
    const e3d_lighting *lighting;    /* NULL: unlit */
    float shininess;
    const float *specular, *emissive; /* of lit samples; NULL where all are 0 */
    int srgb;
    int looks_ahead;      /* what e3d_cpu_looks_ahead says */
    e3d_samples *samples; /* NULL: one sample a pixel; else colours go there */
    e3d_pixel_rows *meanwhile; /* NULL, or rows to stream as far as that goes: what is left of them stays */
} e3d_paint;

#endif
