/* The data of shading: surfaces, batches of their samples, and the destinations of colours. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/sample_patterns.h"
#include "e3d.h"
#include "kernels/types/fog.h"
#include "kernels/types/samples.h"

enum { E3D_BATCH = 256,
       E3D_BATCH_SURFACES = 128 };
/* So many directional lights look up their maps for a whole batch at once; others do it vector by vector */
enum { E3D_SUNS = 2 };

typedef float e3d_surface_floats[E3D_BATCH_SURFACES + E3D_PAD];
typedef int32_t e3d_surface_words[E3D_BATCH_SURFACES + E3D_PAD];

/* The surfaces of visible primitives: one element each, as structure of arrays. Every array of this struct and of e3d_batch
 * fills whole cache lines, since a vector that is split across two takes twice as long to load. */
typedef struct e3d_surfaces {
    e3d_surface_words project;     /* 0: it has a record; else kernel_project finds its corners: 1, or 3 if mirrored */
    e3d_surface_words x[3], y[3];  /* corners after R9 */
    e3d_surface_floats iw[3];
    e3d_surface_words swapped;     /* not 0: R9 exchanged vertices 1 and 2 */
    /* Index of its matrices. It rises by at most 1 from element to element, so that one vector's matrices are contiguous; the
     * last one is repeated over the padding */
    e3d_surface_words matrix;
    e3d_surface_floats clip[16], world[12], normals[9]; /* R1 and R2, one instance an element */
    e3d_surface_floats position[3][3]; /* [component][vertex]: in object space, then in world space */
    e3d_surface_floats normal[3][3];   /* likewise; negated if the face looks away; flat: vertex 0 has the face's normal */
    e3d_surface_floats uv[2][3];
    e3d_surface_floats color[3][3];    /* [component][vertex] */
    e3d_surface_floats instance_color[3];
    e3d_surface_floats alpha[3], instance_alpha; /* of the vertices */
    e3d_surface_words back;        /* not 0: the face looks away */
    e3d_surface_floats p[3], px[3], py[3]; /* barycentric planes, R18 */
    e3d_surface_floats base_x, base_y;     /* relative to the tile's first sample */
    e3d_surface_floats slope[2][3]; /* [coordinate]: along, down and turn of R25 */
    e3d_surface_words primitive, instance; /* its primitive and its instance; the kernels don't read these */
    int32_t count, matrices;
    int32_t irregular;             /* how many surfaces surface.c must finish: clipped ones, lines, points, clip-space meshes */
    int32_t projected;             /* how many surfaces have no record, so that `project` has work to do */
    float texels[2];               /* the counted size of the texture, for E3D_WANT_LEVEL */
    int32_t reach;                 /* of the viewport */
} e3d_surfaces;

/* The planes of surfaces, if lights have exact shadows (R100). */
typedef struct e3d_receivers {
    e3d_surface_floats normal[3], slack[3], limit;
    int32_t is_smooth;                        /* not 0: normals are those of the corners, so that R194 holds for */
    const e3d_surfaces *surfaces;             /* these surfaces, */
    e3d_surface_floats corner_normal[3][3];   /* with unit normals: [component][vertex] */
    const void *mesh[E3D_BATCH_SURFACES + E3D_PAD]; /* of each surface */
} e3d_receivers;

/* R30: the unit of texels. */
static inline float e3d_texture_unit(const e3d_texture_view *view)
{
    if (view->filter == E3D_NEAREST)
        return view->channel_bits == 16 ? E3D_UNORM15 : E3D_UNORM8;
    return view->channel_bits == 16 ? E3D_UNORM15_BLENDED : E3D_UNORM8_BLENDED;
}

/* R110: a side of the texture, as R25 counts it. */
static inline float e3d_counted_size(const e3d_texture_view *view, int32_t side) { return (float)side * view->level_scale; }

typedef float e3d_lane_array[E3D_BATCH + E3D_PAD];

/* Samples of one material that become colours, in the order of their surfaces: each sample is of the same surface as the one
 * before, or of the next surface. Whole vectors are read, so `sample` and `surface` repeat their last element up to a
 * multiple of E3D_PAD. */
typedef struct e3d_batch {
    int32_t sample[E3D_BATCH + E3D_PAD];  /* y * E3D_TILE + x in the tile */
    int32_t surface[E3D_BATCH + E3D_PAD]; /* its element in e3d_surfaces */
    int32_t steps[E3D_BATCH + E3D_PAD];   /* scratch of take_runs: all 0 before and after */
    e3d_lane_array weight[3], r; /* P_k and r of R19 */
    e3d_lane_array position[3], normal[3], uv[2], color[3];
    e3d_lane_array place[3]; /* with `facets`: where the samples are; `position` is where they are lit */
    int32_t lod[E3D_BATCH + E3D_PAD];
    e3d_lane_array energy[3], shine[3], alpha;
    uint32_t shadowed_lights[E3D_BATCH + E3D_PAD]; /* a bit for each light with exact shadows, set if the light is hidden */
    e3d_lane_array visibility; /* R129, if the frame has it */
    e3d_lane_array curvature;  /* R191 */
    /* `reached` of R93 for the lights whose numbers are in `sun`; the kernels that light the batch find it */
    e3d_lane_array reached[E3D_SUNS];
    e3d_lane_array soft_reached[E3D_MAX_EXACT_LIGHTS]; /* `reached` of R196 for soft lights with exact shadows, by their number among these */
    int32_t sun[E3D_SUNS];
    int count, facets;
    const e3d_lane_array *unmapped_normal; /* the normals before they were mapped; NULL: `normal` isn't mapped */
    /* NULL: values are those at samples' centres; else R105 decides where they are found: */
    const e3d_sample_pattern *pattern;
    int32_t number[E3D_BATCH + E3D_PAD];   /* the sample of the pattern that replaces the centre, if that can't be used */
    e3d_lane_array shift[2];               /* the offset from the centre in samples */
    int at_samples;                        /* not 0: the centre is never used (R195) */
    float beside[2];                       /* how much is added to that (R190) */
    int finest;                            /* not 0: textures are read at level 0, once (R190) */
} e3d_batch;

/* The length of a batch in whole vectors; beyond its end the last sample is repeated. */
static inline int e3d_padded_count(const e3d_batch *batch) { return (batch->count + E3D_PAD - 1) / E3D_PAD * E3D_PAD; }

/* The samples of a batch in mirrors. */
typedef struct e3d_mirror_batch {
    e3d_lane_array share, rest;  /* m of R210, and 1 - m */
    e3d_lane_array light[3];     /* what the pictures show */
    e3d_lane_array reflected[3]; /* of physically based materials: the share of that, by channel (R211) */
    e3d_lane_array haze[3];      /* of these: what fog makes of black */
} e3d_mirror_batch;

/* The samples' positions in world space, wherever they are lit. */
static inline const e3d_lane_array *e3d_batch_places(const e3d_batch *batch) { return batch->facets ? batch->place : batch->position; }

/* The inputs that shading needs of a bucket's samples, and that interpolation fills. */
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
    /* All textures of a material with more than a base colour; without it, only those that alpha needs */
    E3D_WANT_TEXTURES = 256,
    E3D_WANT_CURVATURE = 1024 /* with E3D_WANT_NORMAL */
};

/* The lights of a frame. `reach` has five rows of a number a light, and E3D_PAD more: x, y and z of its position, the square
 * of its range (NaN for directional lights, which reach everything), and 1 over that square. `shown` has what a white matt
 * surface shows of each light that it faces, by channel (R154). */
typedef struct e3d_lighting {
    const e3d_light *lights;
    int light_count;
    const float *reach[5];
    const float (*shown)[3];
    float ambient[3], clamp[2], eye[4], exposure;
    const e3d_environment_light *environment; /* NULL: there is none */
    const e3d_shadow_map *shadows; /* NULL: no light has a shadow, or the lit surfaces receive none */
    const float (*ambient_terms)[3];          /* R130, or NULL */
    int has_visibility;                       /* the batch's */
    int has_area_lights;                      /* not 0: other kernels have begun the sums with their light */
} e3d_lighting;

/* How the kernel `paint` turns the samples of a batch into pixels, or finds their colours. */
typedef struct e3d_paint {
    int wanted;                      /* E3D_WANT_* */
    const e3d_texture_view *texture; /* may be NULL */
    const float *base;               /* the colour of the material */
    int by_vertex, by_instance;      /* not 0: multiply by the colours of vertices, of instances */
    const e3d_lighting *lighting;    /* NULL: unlit */
    float shininess;
    const float *specular, *emissive; /* for lit samples; NULL: all are 0 */
    int srgb;
    e3d_samples *samples; /* NULL: one sample a pixel; else colours go there. Without pixels and samples they stay in the batch */
    const e3d_fog_view *fog; /* may be NULL */
    e3d_tone_mapping tone;
} e3d_paint;
