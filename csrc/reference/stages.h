/* What flows from stage to stage of the reference, and the stages in their order.
 *
 *     transform → clip → setup → raster → surface, texture, light, shade → resolve
 *
 * Geometry runs once: every triangle, line and point becomes *pieces* (triangles on the screen, R7,
 * R11), kept in the order of R16. Then the picture is made in horizontal bands of samples, so that
 * memory does not grow with its height.
 */
#pragma once

#include "base/limits.h"
#include "data/sample_patterns.h"
#include "e3d.h"

typedef enum ref_kind { REF_FACE,
                        REF_LINE,
                        REF_POINT,
                        REF_EDGE } ref_kind;

/* One instance of a draw: the f32 matrices of R1 and R2. */
typedef struct ref_instance {
    const e3d_draw *draw;
    const e3d_mesh_desc *mesh;
    int32_t number; /* in its draw */
    int32_t object_id, instance_id;
    int mirrored;     /* either its own matrix or the camera's mirrors, not both */
    int turned_round; /* by its own matrix */
    float clip_from_object[4][4];
    float world_from_object[3][4];
    float normal_matrix[3][3];
} ref_instance;

/* The primitive that a piece comes from. */
typedef struct ref_primitive {
    ref_kind kind;
    int64_t instance;            /* index into ref_scene.instances */
    int32_t index;               /* in the mesh's faces, lines, points or edges */
    uint32_t local;              /* the number in its instance: faces, then lines, then points */
    int32_t vertices[3];         /* -1 for vertices that a line or a point lacks */
    const e3d_material *material; /* NULL for a wireframe edge */
} ref_primitive;

/* A corner in clip space, with its barycentrics in the original primitive. */
typedef struct ref_corner {
    float position[4];
    float barycentric[3];
} ref_corner;

/* A triangle on the screen: vertices in 1/256 sample, Y down, positive area. */
typedef struct ref_piece {
    ref_primitive primitive;
    int front;                   /* front-facing */
    int64_t order;               /* position in the order of R16 */
    float painter_key;           /* R16 */
    int32_t x[3], y[3];
    int64_t a[3], b[3];          /* edge functions, R12 */
    int32_t left, top, right, bottom; /* the sample box, inclusive; (left, top) is the base */
    float z0, z_dx, z_dy, z_min, z_max;                     /* depth plane, R13 and R14 */
    float bary0[3], bary_dx[3], bary_dy[3];                 /* barycentric planes, R18 */
} ref_piece;

typedef struct ref_piece_list {
    ref_piece *items;
    int64_t count, capacity;
} ref_piece_list;

/* A face that may hide lights (R97): its corners in the world, and the data for its alpha. */
typedef struct ref_caster {
    float corner[3][3];
    int32_t instance, face; /* instance: its number in ref_casters */
} ref_caster;

typedef struct ref_casters {
    const e3d_casters *source; /* or NULL */
    const e3d_frame *frame;
    ref_instance *instances;
    ref_caster *items;
    int64_t count;
} ref_casters;

/* Everything that geometry makes and the bands read. */
typedef struct ref_scene {
    const e3d_frame *frame;
    int32_t width, height;       /* of the viewport, in samples */
    const e3d_sample_pattern *pattern; /* NULL: no multisampling */
    int32_t pixel_samples;       /* of the pattern, or 1 */
    float guard_x, guard_y;      /* guard factors, powers of two */
    float view_from_world[3][4];
    ref_instance *instances;
    int64_t instance_count, instance_capacity;
    ref_piece_list pieces;       /* faces, lines and points */
    ref_piece_list edges;        /* of the wireframe */
    ref_casters casters;
    e3d_stats stats;
} ref_scene;

/* The layer of a blended piece at a sample. */
typedef struct ref_fragment {
    size_t sample; /* of the band */
    float depth;
    int64_t piece;
} ref_fragment;

/* One band of samples: full rows of the viewport. With multisampling, the samples of a pixel follow each other
 * (ref_sample_at). */
typedef struct ref_band {
    int32_t first_row, rows, width, pixel_samples;
    float *depth;                /* z_ndc of the visible piece (R16), +inf where there is none */
    int64_t *piece;              /* index of the visible piece, -1 where there is none */
    uint8_t *overdraw;           /* R17: saturates at 255 */
    uint8_t *edge;               /* 1 where a wireframe edge shows, R36 */
    ref_fragment *fragments;     /* blended fragments in front of the visible piece: by sample, the farthest first (R83) */
    int64_t fragment_count, fragment_capacity;
    int64_t *first_fragment;     /* where each sample's fragments begin, and where the last one's end */
} ref_band;

/* A sample: its column and row in the viewport, and with multisampling its number in the pixel. */
typedef struct ref_place {
    int32_t x, y, number;
    int32_t is_alone; /* R195 */
} ref_place;

static inline size_t ref_sample_at(const ref_band *band, const ref_place *at)
{
    size_t pixel = (size_t)(at->y - band->first_row) * (size_t)band->width + (size_t)at->x;
    return pixel * (size_t)band->pixel_samples + (size_t)at->number;
}

/* transform.c */
void ref_instance_init(ref_instance *out, const e3d_frame *frame, const e3d_draw *draw, int32_t number);
void ref_round_rows(float out[][4], const double *matrix, int rows);
void ref_transform_clip(const ref_instance *instance, int32_t vertex, float out[4]);
void ref_transform_point(const float rows[3][4], const float point[3], float out[3]);
void ref_transform_normal(const ref_instance *instance, const float normal[3], float out[3]);

/* clip.c */
enum { REF_MAX_CORNERS = 32 }; /* R7: 3 corners become 28 at most */
typedef enum ref_verdict { REF_REJECTED,
                           REF_ACCEPTED,
                           REF_NEEDS_CLIPPING } ref_verdict;
float ref_guard_factor(int32_t samples);
ref_verdict ref_test_primitive(const ref_scene *scene, ref_kind kind, const ref_corner *corners);
int ref_clip_triangle(const ref_scene *scene, const ref_corner in[3], ref_corner out[REF_MAX_CORNERS]);
int ref_clip_line(const ref_scene *scene, const ref_corner in[2], ref_corner out[2]);

/* setup.c */
e3d_status ref_setup_triangle(ref_scene *scene, const ref_primitive *primitive, const ref_corner corners[3],
                              int clipped);
int32_t ref_half_size(const ref_scene *scene, float size);
/* The greatest distance that any line reaches from its centre along its minor axis, in 1/256 sample. */
int32_t ref_greatest_offset(const ref_scene *scene);
e3d_status ref_setup_line(ref_scene *scene, const ref_primitive *primitive, const ref_corner ends[2],
                          int clipped);
e3d_status ref_setup_point(ref_scene *scene, const ref_primitive *primitive, const ref_corner *corner);

/* geometry.c */
e3d_status ref_build_geometry(ref_scene *scene, int with_edges);

/* casters.c */
e3d_status ref_find_casters(const e3d_frame *frame, ref_casters *out);
void ref_free_casters(ref_casters *casters);

/* raster.c */
void ref_sort_for_painter(ref_piece_list *pieces);
e3d_status ref_raster_band(const ref_scene *scene, ref_band *band);

/* alpha.c */
/* R81 and R108: of the samples that a piece covers in a pixel by R12 and R15, those that its alpha leaves, a bit each. */
uint32_t ref_alpha_covers(const ref_scene *scene, const ref_piece *piece, int32_t x, int32_t y, uint32_t covered);
/* R82: whether a piece is blended over the visible one, and doesn't become visible itself. */
int ref_is_blended(const e3d_frame *frame, const ref_piece *piece);
e3d_status ref_add_fragment(ref_band *band, size_t sample, float depth, int64_t piece);
/* R83: drops the hidden fragments, and sorts the others. */
void ref_sort_fragments(const ref_scene *scene, ref_band *band);
/* R84: blends the fragments of a sample over its colour, which is multiplied by its alpha. */
void ref_blend_sample(ref_scene *scene, const ref_band *band, const ref_place *at, float color[3], float *alpha);
/* R123: blends their radiance over the sample's. */
void ref_blend_radiance(const ref_scene *scene, const ref_band *band, const ref_place *at, float radiance[3]);

/* resolve.c */
/* R34 for a clamped value. */
uint8_t ref_encode(float v, int is_srgb);
void ref_resolve_band(ref_scene *scene, const ref_band *band, const e3d_targets *targets);
