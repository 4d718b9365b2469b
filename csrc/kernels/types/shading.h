/* What shading works on: surfaces, batches of their samples, and where the colours go. */
#ifndef E3D_KERNELS_SHADING_H
#define E3D_KERNELS_SHADING_H

#include <stdint.h>

#include "base/limits.h"
#include "data/sample_patterns.h"
#include "e3d.h"
#include "kernels/types/fog.h"
#include "kernels/types/samples.h"

enum { E3D_BATCH = 256, E3D_BATCH_SURFACES = 128 };
enum { E3D_SUNS = 2 }; /* directional lights whose maps are looked up for a whole batch at once; of others, vector by vector */

typedef float e3d_surface_floats[E3D_BATCH_SURFACES + E3D_PAD];
typedef int32_t e3d_surface_words[E3D_BATCH_SURFACES + E3D_PAD];

/* What visible pieces bring to their samples: one element each, as structure of arrays. Every array of this struct and of e3d_batch
 * fills whole cache lines, since a vector that is split across two takes twice as long to load. */
typedef struct e3d_surfaces {
    e3d_surface_words project;     /* 0: it has a record; else kernel_project finds its corners: 1, mirrored 3 */
    e3d_surface_words x[3], y[3];  /* corners after R9 */
    e3d_surface_floats iw[3];
    e3d_surface_words swapped;     /* not 0: R9 exchanged vertices 1 and 2 */
    e3d_surface_words matrix;      /* number of its matrices; rises by at most 1 from element to element, so that a
                                    * vector's lie side by side; the last is repeated over the pad */
    e3d_surface_floats clip[16], world[12], normals[9]; /* of R1 and R2, one instance an element */
    e3d_surface_floats position[3][3]; /* [component][vertex]: in object space, then in world space */
    e3d_surface_floats normal[3][3];   /* likewise, then negated where the face looks away; flat: vertex 0 has the face's normal */
    e3d_surface_floats uv[2][3];
    e3d_surface_floats color[3][3];    /* [component][vertex] */
    e3d_surface_floats instance_color[3];
    e3d_surface_floats alpha[3], instance_alpha; /* of the vertices */
    e3d_surface_words back;        /* not 0: the face looks away */
    e3d_surface_floats p[3], px[3], py[3]; /* barycentric planes, R18 */
    e3d_surface_floats base_x, base_y;     /* relative to the tile's first sample */
    e3d_surface_floats slope[2][3]; /* [coordinate]: along, down and turn of R25 */
    e3d_surface_words primitive, instance; /* which primitive and which instance it is of; the kernels don't read these */
    int32_t count, matrices;
    int32_t irregular;             /* how many surface.c must finish: clipped pieces, lines, points, clip-space meshes */
    int32_t projected;             /* how many have no record, so that `project` has work to do */
    float texels[2];               /* the counted size of the texture, for E3D_WANT_LEVEL */
    int32_t reach;                 /* of the viewport */
} e3d_surfaces;

/* The planes of surfaces, where lights have exact shadows (R100). */
typedef struct e3d_receivers {
    e3d_surface_floats normal[3], slack[3], limit;
} e3d_receivers;

/* R30: what texels are counted in. */
static inline float e3d_texture_unit(const e3d_texture_view *view)
{
    if (view->filter == E3D_NEAREST)
        return view->channel_bits == 16 ? E3D_UNORM15 : E3D_UNORM8;
    return view->channel_bits == 16 ? E3D_UNORM15_BLENDED : E3D_UNORM8_BLENDED;
}

/* R110: a side of the texture as R25 counts it. */
static inline float e3d_counted_size(const e3d_texture_view *view, int32_t side) { return (float)side * view->level_scale; }

typedef float e3d_lane_array[E3D_BATCH + E3D_PAD];

/* Samples of one material on their way to a colour, in the order of their surfaces: each is of the same surface as the one before,
 * or of the next surface. Whole vectors are read, so `sample` and `surface` repeat their last up to a multiple of E3D_PAD. */
typedef struct e3d_batch {
    int32_t sample[E3D_BATCH + E3D_PAD];  /* y * E3D_TILE + x in the tile */
    int32_t surface[E3D_BATCH + E3D_PAD]; /* its element of e3d_surfaces */
    int32_t steps[E3D_BATCH + E3D_PAD];   /* scratch of take_runs: all 0 before and after */
    e3d_lane_array weight[3], r; /* P_k and r of R19 */
    e3d_lane_array position[3], normal[3], uv[2], color[3];
    e3d_lane_array place[3]; /* where `facets`: where the samples are, and `position` is where light is found */
    int32_t lod[E3D_BATCH + E3D_PAD];
    e3d_lane_array energy[3], shine[3], alpha;
    uint32_t shadowed_lights[E3D_BATCH + E3D_PAD]; /* where lights have exact shadows: a bit for each of them, set where it is hidden */
    e3d_lane_array visibility; /* R129, where the frame has it */
    e3d_lane_array reached[E3D_SUNS]; /* `reached` of R93 of the lights whose numbers are in `sun`, found by the kernels that light the batch */
    int32_t sun[E3D_SUNS];
    int count, facets;
    const e3d_lane_array *unmapped_normal; /* where `normal` is mapped: what it was before; else NULL */
    const e3d_sample_pattern *pattern;     /* NULL: values are those of samples' centres; else R105 tells where they are found: */
    int32_t number[E3D_BATCH + E3D_PAD];   /* which sample of the pattern takes the place of the centre, where that won't do */
    e3d_lane_array shift[2];               /* from the centre, in samples: where they are found */
} e3d_batch;

/* Where samples are, in world space, whatever the place is where they are lit. */
static inline const e3d_lane_array *e3d_batch_places(const e3d_batch *batch) { return batch->facets ? batch->place : batch->position; }

/* What shading needs of a bucket's samples, and so what interpolation fills. */
enum {
    E3D_WANT_POSITION = 1,
    E3D_WANT_NORMAL = 2,
    E3D_WANT_UV = 4,
    E3D_WANT_FLAT = 8, /* with E3D_WANT_NORMAL: the face's normal, not the vertices' */
    E3D_WANT_LEVEL = 16, /* lod of R26, not yet limited to the levels of the texture */
    E3D_WANT_SURFACE = 32, /* anything of the surface at all */
    E3D_WANT_WEIGHTS = 64, /* weight and r */
    E3D_WANT_ALPHA = 128,  /* the alphas of vertices and instances, if these have colours */
    E3D_WANT_FACET = 512,  /* with E3D_WANT_POSITION: light is found in the middle of the face (R153) */
    E3D_WANT_TEXTURES = 256    /* all textures that count, of materials of more than a base colour; else of these only what alpha needs */
};

/* `reach` has five rows of a number a light, and E3D_PAD more: x, y and z of its position, the square of its range (a NaN for
 * directional lights, which reach everything), and 1 over that square. */
typedef struct e3d_lighting {
    const e3d_light *lights;
    int light_count;
    const float *reach[5];
    float ambient[3], clamp[2], eye[4], exposure;
    const e3d_environment_light *environment; /* NULL where there is none */
    const e3d_shadow_map *shadows; /* NULL: no light has a shadow, or none falls on what is lit */
    const float (*ambient_terms)[3];          /* R130, or NULL */
    int has_visibility;                       /* the batch's */
} e3d_lighting;

/* How the kernel `paint` turns the samples of a batch into pixels, or finds their colours. */
typedef struct e3d_paint {
    int wanted;                      /* E3D_WANT_* */
    const e3d_texture_view *texture; /* may be NULL */
    const float *base;               /* colour of the material */
    int by_vertex, by_instance;      /* colours to multiply with */
    const e3d_lighting *lighting;    /* NULL: unlit */
    float shininess;
    const float *specular, *emissive; /* of lit samples; NULL where all are 0 */
    int srgb;
    e3d_samples *samples; /* NULL: one sample a pixel; else colours go there. Without either, they stay in the batch */
    const e3d_fog_view *fog; /* may be NULL */
    e3d_tone_mapping tone;
} e3d_paint;

#endif
