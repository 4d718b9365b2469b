/* What the stages of a frame share: the prepared frame, what geometry leaves (records in bins), and each
 * thread's own memory. Data flows one way: prepare -> geometry (cull, transform, clip, setup, bin) -> tiles
 * (raster, shade, resolve).
 */
#ifndef E3D_FRAME_H
#define E3D_FRAME_H

#include <stdatomic.h>
#include <time.h>

#include "core/grow.h"
#include "core/mesh.h"
#include "kernels/kernels.h"

enum { E3D_LINES_A_UNIT = 256 }; /* lines, points or edges in one unit of work */

/* Nanoseconds since some fixed moment. */
static inline int64_t e3d_now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

/* ---- prepared once a frame ---- */

/* One instance's matrices (R1, R2). */
typedef struct e3d_instance {
    double clip_exact[16]; /* for culling */
    float clip[16], world[12], normal[9];
    int32_t mirrored;
} e3d_instance;

/* A draw in the frame: where its instances, primitives and units of work start. */
typedef struct e3d_draw_state {
    const e3d_draw *draw;
    const e3d_mesh *mesh;
    int64_t order_base, unit_base;
    int32_t instance_base;
    int32_t primitives;  /* an instance */
    int32_t cluster_units, line_units, point_units, edge_units; /* an instance */
    int32_t units;       /* their sum */
    int32_t any_two_sided;
} e3d_draw_state;

/* ---- left by geometry ---- */

enum {
    E3D_RECORD_BACK = 1,     /* not front-facing */
    E3D_RECORD_SWAPPED = 2,  /* vertices 1 and 2 were exchanged (R9) */
    E3D_RECORD_CUT = 4,      /* has corner barycentrics, at meta >> 4 */
    E3D_RECORD_FACE = 8
};

/* One piece of a primitive, ready for any tile: a cache line. */
typedef struct e3d_record {
    int32_t x[3], y[3];
    float z0, gx, gy, zmin, zmax;
    float iw[3];
    uint32_t order;
    uint32_t meta;
} e3d_record;

_Static_assert(sizeof(e3d_record) == 64, "a record is a cache line");

/* Bins are chains of blocks of record numbers, in order of arrival. */
typedef struct e3d_bin_block {
    uint32_t next, count;
    uint32_t record[30];
} e3d_bin_block;

enum { E3D_NO_BLOCK = 0xFFFFFFFFu };

typedef struct e3d_bin {
    uint32_t first, last;
} e3d_bin;

/* One thread's records of one pass. */
typedef struct e3d_record_set {
    e3d_array records; /* e3d_record */
    e3d_array corners; /* float[9]: c[k][j] of the cut ones */
    e3d_array keys;    /* float: painter's algorithm only */
    e3d_array blocks;  /* e3d_bin_block */
    e3d_array bins;    /* e3d_bin, one a tile */
} e3d_record_set;

enum { E3D_PASS_SCENE = 0, E3D_PASS_WIRE, E3D_PASSES };

typedef struct e3d_counters {
    int64_t clusters_culled, triangles_culled, triangles_clipped, records, bin_entries, shaded;
    int64_t ns_raster, ns_shade, ns_resolve;
} e3d_counters;

/* ---- one tile at a time, a thread ---- */

/* Samples that are shaded by the same steps. */
typedef struct e3d_group {
    const e3d_material *material;
    int8_t face, flat, textured, by_vertex, by_instance;
    int32_t count, start, next; /* of its runs, while they are sorted */
} e3d_group;

typedef struct e3d_tile_memory {
    float z[E3D_TILE_SAMPLES + E3D_PAD];
    float bound[E3D_TILE_SAMPLES + E3D_PAD]; /* E3D_BEYOND_FAR everywhere */
    float edge_limit[E3D_TILE_SAMPLES + E3D_PAD]; /* wireframe: what an edge's depth must be less than */
    int32_t slot[E3D_TILE_SAMPLES + E3D_PAD];
    int32_t mark[E3D_TILE_SAMPLES + E3D_PAD];  /* overdraw counts, then wireframe marks */
    uint32_t rgba[E3D_TILE_SAMPLES + E3D_PAD]; /* supersampling: 1 where a sample has its own colour */
    float color[3][E3D_TILE_SAMPLES + E3D_PAD]; /* supersampling only */
    e3d_run runs[E3D_TILE_SAMPLES + 1];   /* what shows, row by row */
    e3d_run sorted[E3D_TILE_SAMPLES + 1]; /* by group and surface, which owns them now */
    e3d_batch batch;
    const e3d_run *batch_runs;          /* the batch's samples, as runs */
    int32_t batch_run_count;
    uint32_t encoded[E3D_BATCH + E3D_PAD];
} e3d_tile_memory;

typedef struct e3d_worker {
    e3d_record_set pass[E3D_PASSES];
    e3d_vertices vertices;
    e3d_survivors survivors;
    e3d_tile_memory *tile;
    e3d_array slots;        /* e3d_slot of the tile */
    e3d_array orders;       /* uint32_t of each slot */
    e3d_array surfaces;     /* e3d_surface of the tile's visible slots */
    e3d_array groups;       /* e3d_group of the tile */
    e3d_counters counters;
    int failed;             /* out of memory */
    char padding[128];      /* no false sharing between workers */
} e3d_worker;

enum { E3D_NEED_COLOR = 32, E3D_NEED_ALBEDO = 64, E3D_NEED_OUTPUTS = 128 };

typedef struct e3d_slot {
    const e3d_record *record;
    const float *corners; /* c[k][j], or NULL */
    int32_t surface;      /* or -1 */
} e3d_slot;

struct e3d_renderer {
    e3d_backend backend;
    int32_t threads;
    const e3d_kernels *kernels;
    e3d_worker **workers;
    e3d_array draws, instances;
    int (*poll)(void *);
    void *poll_user;
};

typedef struct e3d_context {
    e3d_renderer *renderer;
    const e3d_kernels *kernels;
    const e3d_frame *frame;
    const e3d_targets *targets;
    e3d_viewport viewport;
    e3d_draw_state *draws;
    e3d_instance *instances;
    int32_t instance_count;
    int64_t units;
    float view[12]; /* rows of view_from_world, f32 */
    e3d_lighting lighting;
    int32_t tiles_x, tiles_y;
    int sorted;        /* painter or none: bins are made after sorting */
    int srgb;          /* the encoder of this frame (R34) */
    int draw_faces;    /* faces are needed at all */
    int wants;         /* E3D_WANT_* and E3D_NEED_* of the visible samples; 0: no shading */
    int32_t line_half, point_half; /* 1/256 sample */
    uint32_t background_rgba, line_rgba;
    atomic_llong next; /* unit, instance or tile */
    atomic_int stop;   /* cancelled or out of memory */
    int cancelled;
    int64_t last_poll;
} e3d_context;

/* prepare.c */
e3d_status e3d_prepare(e3d_context *context);
/* geometry.c */
void e3d_geometry(e3d_context *context);
/* cull.c: a box of object space, against the six planes of a clip matrix; 0 only if nothing of it can show */
typedef struct e3d_planes {
    double p[6][4];
} e3d_planes;
void e3d_planes_from(const double clip_from_object[16], e3d_planes *planes);
int e3d_box_shows(const e3d_planes *planes, const float lo[3], const float hi[3]);

/* clip.c */
typedef struct e3d_clip_vertex {
    float v[4];
    float c[3];
} e3d_clip_vertex;
enum { E3D_CLIP_MAX = 40 }; /* 3 vertices, at most half as many again at each of 6 planes */
int e3d_clip_triangle(const float corner[3][4], const e3d_viewport *viewport,
                      e3d_clip_vertex out[E3D_CLIP_MAX]);
int e3d_clip_line(const float end[2][4], const e3d_viewport *viewport, e3d_clip_vertex out[2]);
int e3d_outcode(const float v[4], const e3d_viewport *viewport);

/* setup.c */
typedef struct e3d_corner {
    int32_t x, y;
    float zn, iw;
    float c[3];
} e3d_corner;
typedef struct e3d_primitive {
    uint32_t order;
    int pass, face, cut;
    e3d_cull cull;
    int mirrored;
} e3d_primitive;
int e3d_project(const float v[4], int clipped, const e3d_viewport *viewport, e3d_corner *out);
void e3d_emit(const e3d_context *context, e3d_worker *worker, const e3d_corner corner[3],
              const e3d_primitive *primitive);

/* bin.c */
int e3d_bins_reset(e3d_record_set *set, int32_t tiles);
/* Samples, inclusive; empty where x0 > x1 or y0 > y1. */
typedef struct e3d_box {
    int32_t x0, y0, x1, y1;
} e3d_box;
int e3d_bin_record(const e3d_context *context, e3d_worker *worker, e3d_record_set *set, uint32_t record,
                   const e3d_box *box);

/* order.c */
int e3d_sort_records(e3d_context *context);

/* tile.c, shade.c, resolve.c */
typedef struct e3d_tile {
    int32_t x, y;          /* first sample */
    int32_t width, height; /* samples inside the viewport */
} e3d_tile;
void e3d_tiles(e3d_context *context);
/* Shades the first `count` of the tile memory's runs; 0 when memory is out. */
int e3d_shade_runs(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int32_t count);
int e3d_surface_of(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int32_t slot);
void e3d_resolve_begin(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
/* batch->color, clamped, is that of its samples. */
void e3d_resolve_batch(const e3d_context *context, e3d_worker *worker);
/* The batch's samples show the background again: forward shading may have drawn there before. */
void e3d_resolve_hidden(const e3d_context *context, e3d_worker *worker);
void e3d_resolve_overdraw(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
void e3d_resolve_wire(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
/* The whole tile is background, without supersampling. */
void e3d_resolve_empty(const e3d_context *context, const e3d_tile *tile);
void e3d_resolve(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
/* outputs.c: the G-buffer */
void e3d_outputs_begin(const e3d_context *context, const e3d_tile *tile);
void e3d_outputs_batch(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
/* ndc_depth of a tile without anything in it. */
void e3d_outputs_no_depth(const e3d_context *context, const e3d_tile *tile);
void e3d_outputs_depth(const e3d_context *context, const e3d_worker *worker, const e3d_tile *tile);

static inline int64_t e3d_tile_count(const e3d_context *c) { return (int64_t)c->tiles_x * c->tiles_y; }

#endif
