/* The whole C interface of the engine3d core: plain structs, opaque handles, status codes.
 *
 * In:  arrays that the caller owns and keeps alive and unchanged (meshes borrow them), matrices,
 *      materials, lights and what to write.
 * Out: the caller's own arrays, filled; nothing is written unless E3D_OK or E3D_CANCELLED is returned.
 * Always: any thread may call anything on different renderers at once; one renderer is one thread's
 *      at a time. Matrices are row-major and act on column vectors. Clip space is OpenGL's
 *      (-w <= z <= w). Images are top row first, without padding. docs/exactness.md has the formulas.
 */
#ifndef E3D_H
#define E3D_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum e3d_status {
    E3D_OK = 0,
    E3D_OUT_OF_MEMORY,
    E3D_INVALID_ARGUMENT,
    E3D_UNSUPPORTED_BACKEND,
    E3D_TOO_MANY_PRIMITIVES, /* a frame holds fewer than 2^31 */
    E3D_CANCELLED            /* the poll function asked to stop; the targets are partly written */
} e3d_status;

/* ---- Backends ----------------------------------------------------------------------------- */

typedef enum e3d_backend {
    E3D_BACKEND_SCALAR = 0, /* the reference: obvious loops, one thread */
    E3D_BACKEND_PORTABLE,   /* the kernels, one lane wide, any processor */
    E3D_BACKEND_SSE41,
    E3D_BACKEND_AVX2,
    E3D_BACKEND_AVX512,
    E3D_BACKEND_COUNT
} e3d_backend;

const char *e3d_status_text(e3d_status status);
const char *e3d_backend_name(e3d_backend backend);
/* 1 where this build has the backend and both CPU and operating system support it. */
int e3d_backend_available(e3d_backend backend);
/* The fastest available kernel backend; never E3D_BACKEND_SCALAR. */
e3d_backend e3d_backend_best(void);
/* CPUs of the affinity mask, capped by the cgroup's quota; at least 1. */
int e3d_thread_count(void);

/* ---- Meshes ------------------------------------------------------------------------------- */

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

/* ---- Textures ----------------------------------------------------------------------------- */

typedef struct e3d_texture e3d_texture;

typedef enum e3d_filter { E3D_NEAREST = 0, E3D_BILINEAR, E3D_TRILINEAR } e3d_filter;
typedef enum e3d_wrap { E3D_REPEAT = 0, E3D_CLAMP, E3D_MIRROR } e3d_wrap;

/* One mip level: linear RGBA texels, top row first, within a border of one texel: the other side's where the wrap is
 * E3D_REPEAT, else the nearest. */
typedef struct e3d_level {
    const void *texels; /* (height + 2, width + 2, 4), of channel_bits 16: int16, at least 0; of 8: int8, c - 128 */
    int32_t width, height;
} e3d_level;

enum { E3D_MAX_LEVELS = 16, E3D_MAX_TEXTURE_SIZE = 16384 };

typedef struct e3d_texture_view {
    e3d_level levels[E3D_MAX_LEVELS];
    int32_t level_count; /* 1 unless the filter is E3D_TRILINEAR */
    int32_t channel_bits;
    e3d_filter filter;
    e3d_wrap wrap;
} e3d_texture_view;

/* pixels: (height, width, 4) uint8, top row first, copied. decode_srgb: 0 takes 8-bit values as they are. */
e3d_status e3d_texture_create(const uint8_t *pixels, int32_t width, int32_t height, int decode_srgb,
                              e3d_filter filter, e3d_wrap wrap, e3d_texture **out);
void e3d_texture_destroy(e3d_texture *texture);
const e3d_texture_view *e3d_texture_get_view(const e3d_texture *texture);

/* ---- A frame ------------------------------------------------------------------------------ */

typedef struct e3d_material {
    float color[3];              /* in the frame's working space (linear, or raw 8-bit / 255) */
    float specular[3];           /* Blinn-Phong Ks; all zero: no highlight is computed */
    float shininess;             /* Blinn-Phong Ns, > 0 */
    float emissive[3];
    const e3d_texture *texture;  /* or NULL */
    int32_t id;                  /* what material_id outputs */
    int32_t two_sided;           /* not culled */
    int32_t flat;                /* face normals instead of vertex normals */
} e3d_material;

typedef enum e3d_light_kind { E3D_LIGHT_DIRECTIONAL = 0, E3D_LIGHT_POINT } e3d_light_kind;
typedef enum e3d_falloff { E3D_FALLOFF_INVERSE_SQUARE = 0, E3D_FALLOFF_WINDOW } e3d_falloff;

typedef struct e3d_light {
    e3d_light_kind kind;
    e3d_falloff falloff;
    float color[3];      /* colour times intensity, in the frame's working space */
    float to_light[3];   /* directional: unit vector towards the light, world space */
    float position[3];   /* point: world space */
    float range;         /* point: contributes exactly 0 at distance >= range; may be +inf
                          * (inverse square only) */
} e3d_light;

typedef enum e3d_pose_kind {
    E3D_POSE_NONE = 0,      /* one instance, at the node's own pose */
    E3D_POSE_MATRIX,        /* (instances, 16) float32, node from instance, row-major */
    E3D_POSE_OFFSET_SCALE,  /* (instances, 4) float32: offset x y z, uniform scale */
    E3D_POSE_NODES          /* nodes that share a mesh: each has a pose in the world and an id of its own */
} e3d_pose_kind;

/* One node's mesh. Primitives of an instance are ordered: faces, then lines, then points. */
typedef struct e3d_draw {
    const e3d_mesh *mesh;
    double world_from_node[16];
    e3d_pose_kind pose_kind;
    const float *poses;
    int32_t instances;               /* 1 where pose_kind is E3D_POSE_NONE */
    const uint8_t *instance_colors_u8;  /* (instances, 4) or NULL; at most one of the two */
    const float *instance_colors_f32;   /* (instances, 4) or NULL */
    int32_t node_id;                 /* what object_id outputs */
    int32_t material_base;           /* frame material = material_base + mesh material id */
    int32_t first_instance;          /* added to what instance_id outputs: of many, some may be drawn */
    const int32_t *instance_ids;     /* (instances,) what instance_id outputs instead, or NULL */
    /* E3D_POSE_NODES, in place of world_from_node, node_id and first_instance: */
    const double *node_worlds;       /* (instances, 12) world from node: three rows of four */
    const int32_t *node_ids;         /* (instances,) what object_id outputs */
} e3d_draw;

typedef enum e3d_mode {
    E3D_MODE_LIT = 0,
    E3D_MODE_UNLIT,
    E3D_MODE_RANDOM,
    E3D_MODE_DEPTH,
    E3D_MODE_NORMAL,
    E3D_MODE_TRIANGLE_ID,
    E3D_MODE_OBJECT_ID,
    E3D_MODE_OVERDRAW
} e3d_mode;

typedef enum e3d_cull { E3D_CULL_NONE = 0, E3D_CULL_BACK, E3D_CULL_FRONT } e3d_cull;
typedef enum e3d_wireframe { E3D_WIRE_NONE = 0, E3D_WIRE_OVERLAY, E3D_WIRE_ONLY } e3d_wireframe;
typedef enum e3d_hidden { E3D_HIDDEN_ZBUFFER = 0, E3D_HIDDEN_PAINTER, E3D_HIDDEN_NONE } e3d_hidden;
typedef enum e3d_shading { E3D_SHADING_DEFERRED = 0, E3D_SHADING_FORWARD } e3d_shading;
typedef enum e3d_normals { E3D_NORMALS_AUTO = 0, E3D_NORMALS_SMOOTH, E3D_NORMALS_FLAT } e3d_normals;

/* What is left out before it is drawn; the picture is the same. */
typedef enum e3d_culling {
    E3D_CULLING_ALL = 0, /* outside the frustum, or behind what is drawn already */
    E3D_CULLING_FRUSTUM,
    E3D_CULLING_NONE,
    E3D_CULLING_ALWAYS /* as ALL, and what is drawn already is tried against even where that cannot pay */
} e3d_culling;

enum { E3D_MAX_SIZE = 16384 };

typedef struct e3d_frame {
    int32_t width, height;       /* 1 .. E3D_MAX_SIZE output pixels */
    int32_t samples_axis;        /* 1, 2 or 4: samples a pixel along each axis */
    double clip_from_world[16];
    double view_from_world[16];
    float eye[4];                /* world: w = 1 the camera's position, w = 0 the unit direction
                                  * towards the viewer (orthographic) */
    e3d_mode mode;
    e3d_cull cull;
    e3d_wireframe wireframe;
    e3d_hidden hidden;
    e3d_shading shading;
    e3d_normals normals;
    int32_t remove_hidden_lines; /* with E3D_WIRE_ONLY: faces hide the edges behind them */
    float line_width, point_size; /* output pixels, 0 < size <= 256 */
    float line_color[3];         /* display-ready: goes through the frame's encoder like any colour */
    float background[4];         /* rgb through the encoder; a is 0 or 1 */
    int32_t encode_srgb;         /* lit and unlit only: encoder is sRGB, else floor(255 v + 1/2) */
    int32_t decode_srgb;         /* 8-bit vertex and instance colours are decoded from sRGB */
    int64_t view;                /* any number that tells this eye from others: the renderer remembers what each saw last */
    float depth_near, depth_far; /* metric depths that mode depth shows white and black; near < far */
    float ambient[3];
    float light_clamp[2];        /* {0, +inf}: no clamp */
    const e3d_material *materials;
    int32_t material_count;
    const e3d_light *lights;
    int32_t light_count;
    const e3d_draw *draws;
    int32_t draw_count;
    /* Numbers of draws, in the order of drawing: each once, but one of E3D_POSE_NODES once for each of its nodes.
     * NULL: the draws as given, none of which is of E3D_POSE_NODES. */
    const int32_t *order;
    int32_t order_count;
    e3d_culling culling;
    const double *frozen_clip_from_world; /* or NULL: draw what this camera's frustum holds, nothing else */
} e3d_frame;

/* Each may be NULL: what is not asked for is not computed. All (height, width[, channels]). */
typedef struct e3d_targets {
    uint8_t *color;          /* 4: RGBA */
    float *depth;            /* 1: metric, along the view axis; 0 = background */
    float *ndc_depth;        /* 1: +inf = background */
    int32_t *triangle_id;    /* 1: face index in its mesh, -1 = background, line or point */
    int32_t *object_id;      /* 1: node id, -1 = background */
    int32_t *instance_id;    /* 1: -1 = background */
    int32_t *material_id;    /* 1: -1 = background */
    float *albedo;           /* 3: working space; 0 = background, as below */
    float *normal;           /* 3: view space, unit, towards the viewer */
    float *position;         /* 3: view space */
    float *world_normal;     /* 3 */
    float *world_position;   /* 3 */
    float *uv;               /* 2 */
    float *barycentric;      /* 3 */
} e3d_targets;

typedef struct e3d_stats {
    int64_t draws, instances;
    int64_t clusters, triangles; /* submitted */
    /* Each of these is at most the one before it. Of a group of clusters that is occluded as a whole, all count as in
     * the frustum; clusters that face away are unoccluded, but not drawn. */
    int64_t clusters_in_frustum, clusters_unoccluded, clusters_drawn;
    int64_t triangles_in_frustum, triangles_unoccluded, triangles_drawn; /* drawn: by a record of the raster, or by edges alone */
    int64_t nodes_unoccluded, nodes_drawn; /* with such a cluster, or with lines or points */
    int64_t clusters_culled;    /* outside the frustum, or facing away */
    int64_t clusters_occluded;  /* behind what was drawn before */
    int64_t triangles_occluded; /* with an occluded cluster */
    int64_t triangles_culled;   /* with a culled cluster, or rejected before setup */
    int64_t triangles_clipped;
    int64_t triangles_setup;    /* records binned, lines and points included */
    int64_t bin_entries;
    int64_t pixels_shaded;      /* samples that were shaded */
    double ms_geometry;         /* cull, transform, clip, setup, bin: wall clock */
    double ms_raster, ms_shade, ms_resolve; /* summed over threads, divided by the threads used */
    double ms_total;            /* wall clock */
    int32_t threads, tiles, rounds;
    uint64_t plan;              /* which ways the tiles took: a bit for each, with a name of e3d_plan_step() */
    e3d_backend backend;
} e3d_stats;

/* What a bit of e3d_stats.plan says; NULL behind the last. docs/plan.md has the rules. */
const char *e3d_plan_step(int32_t bit);

typedef struct e3d_renderer e3d_renderer;

/* threads: 0 is e3d_thread_count(). */
e3d_status e3d_renderer_create(e3d_backend backend, int32_t threads, e3d_renderer **out);
void e3d_renderer_destroy(e3d_renderer *renderer);
/* Has the memory ready, with all its pages, that frames of so many samples take where one thing hides another. */
e3d_status e3d_renderer_prepare(e3d_renderer *renderer, int32_t width, int32_t height);
/* Called by the calling thread now and then; non-zero stops the frame between tiles. */
void e3d_renderer_set_poll(e3d_renderer *renderer, int (*poll)(void *), void *user);
/* stats may be NULL. */
e3d_status e3d_render(e3d_renderer *renderer, const e3d_frame *frame, const e3d_targets *targets,
                      e3d_stats *stats);

/* A picture of one view: what is drawn, where to, and what became of it (or NULL). */
typedef struct e3d_pass {
    const e3d_frame *frame;
    const e3d_targets *targets;
    e3d_stats *stats;
} e3d_pass;

/* Draws passes one after the other; what one wrote, the next may read, as a texture for instance. Nothing is drawn where one of them is
 * invalid; the first that fails is the last. Views that differ have different numbers (e3d_frame.view). */
e3d_status e3d_render_passes(e3d_renderer *renderer, const e3d_pass *passes, int32_t count);

/* The low-level door: clip-space vertices in; triangle_id, ndc depth (smaller is nearer, +inf where empty) and
 * perspective-correct barycentrics out. */
e3d_status e3d_rasterize(const float *clip, int32_t vertices, const int32_t *faces, int32_t faces_count,
                         int32_t width, int32_t height, e3d_cull cull, e3d_backend backend, int32_t threads,
                         int32_t *triangle_id, float *depth, float *barycentric);

#ifdef __cplusplus
}
#endif

#endif
