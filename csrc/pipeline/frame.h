/* What the stages of a frame share: the prepared frame, what geometry leaves (records in bins), and each
 * thread's own memory. Data flows one way: prepare -> geometry (cull, transform, clip, setup, bin) -> tiles
 * (raster, shade, resolve).
 */
#ifndef E3D_FRAME_H
#define E3D_FRAME_H

#include <stdatomic.h>

#include "core/clock.h"
#include "core/grow.h"
#include "core/mesh.h"
#include "kernels/coverage.h"
#include "kernels/kernels.h"

enum { E3D_LINES_A_UNIT = 256 }; /* lines, points or edges in one unit of work */

/* ---- prepared once a frame ---- */

/* One instance's matrices (R1, R2). What is found of all of them comes first: few of those that are many are seen. */
typedef struct e3d_instance {
    float clip[16];
    int32_t draw;
    int32_t shows; /* its mesh's box may be in view */
    int32_t ready; /* not only its clip matrix is known */
    uint32_t order; /* of its first primitive */
    int32_t mirrored;
    float world[12], normal[9];
    e3d_facing facing;
    float frozen[16]; /* clip matrix of the camera that culls, where another one draws */
} e3d_instance;

/* A draw in the frame: where its instances and units of work start. */
typedef struct e3d_draw_state {
    const e3d_draw *draw;
    const e3d_mesh *mesh;
    int64_t instance_base, unit_base, group_base;
    int32_t primitives;  /* an instance */
    int32_t placed;      /* instances that have their place in the order */
    uint32_t order;      /* of the first primitive; of several nodes, each instance has its own */
    int32_t line_units, point_units, edge_units; /* an instance */
    int32_t units;       /* their sum */
    int32_t any_two_sided;
} e3d_draw_state;

/* Whose turn it is in the order of drawing: all instances of a draw, or one node of several. */
typedef struct e3d_turn {
    uint32_t order; /* of the first primitive */
    int32_t draw, instance;
} e3d_turn;

/* ---- left by geometry ---- */

/* Bins are chains of blocks of record IDs, in order of arrival. */
typedef struct e3d_bin_block {
    uint32_t next, count;
    uint32_t id[30];
} e3d_bin_block;

/* One thread's records of one pass. */
typedef struct e3d_record_set {
    e3d_array records; /* e3d_record */
    e3d_array corners; /* float[9]: c[k][j] of the cut ones */
    e3d_array keys;    /* float: painter's algorithm only */
    e3d_array blocks;  /* e3d_bin_block */
    e3d_array bins;    /* e3d_bin, one a tile */
    e3d_array earlier; /* the same, of the round that finished the tiles */
    size_t earlier_records; /* how many there were then */
} e3d_record_set;

enum { E3D_PASS_SCENE = 0, E3D_PASS_WIRE, E3D_PASSES };

/* One thread's fragments: what small triangles cover, sample by sample. */
typedef struct e3d_fragment_set {
    e3d_array blocks; /* e3d_fragment_block */
    e3d_array bins;   /* e3d_bin, one a tile */
    e3d_array earlier; /* the same, of the round that finished the tiles */
    e3d_array drawn;  /* e3d_drawn_cluster: of the whole frame, since IDs tell of them */
    size_t earlier_drawn; /* how many there were when the tiles were finished */
    _Alignas(64) e3d_small_triangles triangles; /* that are fragments soon */
} e3d_fragment_set;

/* A box as the camera sees it. */
enum { E3D_BOX_OUTSIDE = 0, E3D_BOX_CROSSES, E3D_BOX_INSIDE };
typedef struct e3d_box_view {
    int32_t state;
    float near;    /* no z_ndc in the box is less */
    e3d_box samples; /* that it may cover, inclusive */
} e3d_box_view;
#define E3D_DEPTH_UNBOUNDED (-2.0f) /* the nearest depth of a box that reaches the eye: less than any */
static inline e3d_box e3d_blocks_of(const e3d_box *samples)
{
    return (e3d_box){samples->x0 / E3D_BLOCK, samples->y0 / E3D_BLOCK, samples->x1 / E3D_BLOCK, samples->y1 / E3D_BLOCK};
}

/* A group of clusters of one instance, in view. */
typedef struct e3d_item {
    uint32_t instance, group;
    int32_t draw, unit; /* whose instance it is; its number in the frame: there are fewer than triangles */
    e3d_box_view view;
} e3d_item;

/* The farthest depths of a kept tile: of all, of its blocks, and of the columns of those that aren't noted. */
typedef struct e3d_tile_depths {
    float most;
    int32_t shaded; /* samples, when the tile was finished */
    uint64_t noted;
    float zmax[E3D_TILE_BLOCKS], columns[E3D_TILE_BLOCKS][E3D_BLOCK];
} e3d_tile_depths;
#define E3D_NOTHING_KEPT 4.0f /* greater than any depth: nothing was drawn there */

/* What becomes of a cluster: it is transformed and drawn, or left out. */
typedef enum e3d_fate { E3D_FATE_DRAWN = 0, E3D_FATE_OUTSIDE, E3D_FATE_AWAY, E3D_FATE_OCCLUDED, E3D_FATES } e3d_fate;

/* Of an instance: a cluster was not occluded; one was drawn. */
enum { E3D_MARK_UNOCCLUDED = 1, E3D_MARK_DRAWN = 2 };

typedef struct e3d_counters {
    int64_t blocks; /* that the boxes of the items in view may touch */
    int64_t clusters[E3D_FATES], triangles[E3D_FATES]; /* by what became of their cluster */
    int64_t triangles_rejected, triangles_drawn; /* of clusters that show */
    int64_t triangles_clipped, records, bin_entries, shaded;
    int64_t ns_raster, ns_shade, ns_resolve;
} e3d_counters;

/* ---- one tile at a time, a thread ---- */

typedef struct e3d_tile {
    int32_t x, y;          /* first sample */
    int32_t width, height; /* samples inside the viewport */
} e3d_tile;

/* Samples that are shaded by the same steps. */
typedef struct e3d_group {
    const e3d_material *material;
    int8_t face, flat, textured, by_vertex, by_instance;
    int32_t first, last; /* of its visible pieces */
} e3d_group;

/* A piece that shows in a tile, and its samples, or its runs (e3d_shown). */
typedef struct e3d_visible_piece {
    const e3d_record *record;       /* or NULL: */
    const e3d_drawn_cluster *drawn; /* the piece is of fragments */
    const float *corners;           /* c[k][j] of a cut record, or NULL */
    const e3d_draw_state *draw;
    int32_t instance, local; /* in its draw, in its instance */
    int32_t vertex[3];       /* of the mesh; as many as there are */
    int32_t group, next;     /* the next of the same group, or -1 */
    int32_t first, end;
} e3d_visible_piece;

typedef struct e3d_tile_memory {
    e3d_visible_tile visible; /* where tiles aren't kept over several rounds */
    float bound[E3D_TILE_SAMPLES + E3D_PAD]; /* E3D_BEYOND_FAR everywhere */
    float edge_limit[E3D_TILE_SAMPLES + E3D_PAD]; /* wireframe: what an edge's depth must be less than */
    int32_t mark[E3D_TILE_SAMPLES + E3D_PAD];  /* overdraw counts, then wireframe marks */
    uint32_t pixels[2][E3D_TILE_SAMPLES + E3D_PAD]; /* of one sample a pixel: this tile's, and the last one's; */
    uint32_t *rgba;                                 /* the former */
    e3d_samples samples;                       /* of several */
    e3d_run runs[E3D_TILE_SAMPLES + 1];   /* what shows, row by row */
    e3d_run blocks[E3D_TILE_SAMPLES + 1]; /* the same, cut at blocks and in their order */
    char apart[2048]; /* at a like place in its page, a store holds up loads: sorting reads one and writes the other */
    e3d_run spare[E3D_TILE_SAMPLES]; /* while runs are sorted */
    _Alignas(64) e3d_cover cover;
    _Alignas(64) e3d_layers layers;
    _Alignas(64) e3d_shown shown;
    _Alignas(64) e3d_batch batch;
    _Alignas(64) e3d_surfaces surfaces;       /* of the batch and its neighbours */
} e3d_tile_memory;

/* What is done with tiles: those that something is in are drawn, the others cleared. */
typedef enum e3d_to_do { E3D_TO_DRAW = 0, E3D_TO_CLEAR, E3D_TO_DO } e3d_to_do;

/* Of the tiles, by their numbers: a worker's share, and what one has taken. */
typedef struct e3d_share {
    atomic_llong next;
    int64_t end;
} e3d_share;
typedef struct e3d_places {
    int64_t next, end;
} e3d_places;

/* How many tiles go without spans since these did not pay, and how many of these are left. */
typedef struct e3d_spans_trial {
    int32_t without, left;
} e3d_spans_trial;

typedef struct e3d_worker {
    e3d_record_set pass[E3D_PASSES];
    e3d_fragment_set fragments;
    _Alignas(64) e3d_vertices vertices[2]; /* of the cluster that is drawn, and of the next */
    e3d_survivors survivors;
    e3d_tile_memory *tile;
    e3d_visible_tile *visible; /* of the tile that is being drawn */
    uint32_t number;           /* of this worker */
    e3d_array slots, orders; /* uint32_t, where samples keep slots: the record ID of each, and its order */
    e3d_array items;        /* e3d_item, as the groups come */
    e3d_array pieces;       /* e3d_visible_piece of the tile */
    e3d_array groups;       /* e3d_group of the tile */
    e3d_array outputs;      /* int32_t or float: the tile's, one output after the other */
    e3d_counters counters;
    e3d_spans_trial trial;
    e3d_places taken[E3D_TO_DO];
    e3d_pixel_rows late_drawn, late_blank; /* what is left to write of tiles: the last one, and one that nothing is in */
    e3d_tile blank;         /* what is left of the one that is being cleared */
    int blanks;             /* whether there may be more */
    int64_t lap;            /* when the last stage of a tile ended (e3d_lap) */
    int failed;             /* out of memory */
    char padding[128];      /* no false sharing between workers, */
    e3d_share share[E3D_TO_DO]; /* others take from it, too */
    char more_padding[128];
} e3d_worker;

enum { E3D_NEED_COLOR = 256, E3D_NEED_ALBEDO = 512, E3D_NEED_OUTPUTS = 1024 };

/* A turn of a frame, as the next frame finds it again. */
typedef struct e3d_memory_row {
    const e3d_mesh *mesh;
    int64_t base; /* of its groups */
    int32_t node, first, instances, groups;
} e3d_memory_row;

struct e3d_renderer {
    e3d_backend backend;
    int32_t threads;
    const e3d_kernels *kernels;
    e3d_worker **workers;
    e3d_array draws, instances, turns;
    e3d_array marks;            /* uint8_t of each instance: E3D_MARK_ */
    e3d_array reach;            /* float, of e3d_lighting */
    e3d_array tasks, items;     /* e3d_item, near ones first */
    e3d_array rows, rows_before; /* e3d_memory_row of each turn: what `seen` and `seen_before` are of */
    e3d_array seen_before;
    e3d_array seen;             /* uint8_t for each group of the frame: bit k tells whether cluster k showed when it was last tried */
    e3d_array tile_depths;      /* e3d_tile_depths */
    e3d_visible_tile *kept;     /* over the rounds of a frame */
    size_t kept_room;
    uint32_t trials;                /* of what was seen; grows with each frame that remembers */
    int remembers;                  /* this frame */
    int doubts;                     /* that what the last frame saw still shows: it drew it before it knew what hides it */
    int32_t frames_without_rounds; /* still to come: lately rounds did not pay, */
    int64_t covered_at_trial;      /* with so many blocks covered */
    int64_t items_at_trial;        /* by so many items; where either are many more, rounds may pay */
    int64_t tiles_changed;         /* by what the frame before had not shown */
    int (*poll)(void *);
    void *poll_user;
};

/* Which items are drawn now. */
typedef enum e3d_choice {
    E3D_ALL_ITEMS = 0,
    E3D_SEEN_ITEMS,   /* what showed when it was last tried */
    E3D_UNSEEN_ITEMS, /* the others */
} e3d_choice;

typedef struct e3d_round {
    e3d_choice choice;
    int64_t first, end; /* items */
    int tested;         /* against the kept tiles' depths */
    int finished;       /* its tiles are shaded and resolved; the last round's only where more has come */
    int last;           /* lines, points and edges are drawn, too */
} e3d_round;

/* What is asked for beside colour. */
typedef enum e3d_output_kind {
    E3D_OUTPUT_NDC_DEPTH = 0,
    E3D_OUTPUT_DEPTH,
    E3D_OUTPUT_TRIANGLE_ID,
    E3D_OUTPUT_OBJECT_ID,
    E3D_OUTPUT_INSTANCE_ID,
    E3D_OUTPUT_MATERIAL_ID,
    E3D_OUTPUT_ALBEDO,
    E3D_OUTPUT_NORMAL,
    E3D_OUTPUT_POSITION,
    E3D_OUTPUT_WORLD_NORMAL,
    E3D_OUTPUT_WORLD_POSITION,
    E3D_OUTPUT_UV,
    E3D_OUTPUT_BARYCENTRIC,
    E3D_OUTPUTS
} e3d_output_kind;
typedef struct e3d_output {
    void *target; /* or NULL */
    size_t first; /* word in e3d_worker.outputs */
} e3d_output;

typedef struct e3d_context {
    e3d_renderer *renderer;
    const e3d_kernels *kernels;
    const e3d_frame *frame;
    const e3d_targets *targets;
    e3d_viewport viewport;
    e3d_draw_state *draws;
    e3d_instance *instances;
    uint8_t *marks;
    int32_t instance_count, turn_count;
    const e3d_turn *turns;
    int64_t units, groups;
    const e3d_item *items;
    int64_t item_count;
    uint8_t *seen;           /* by e3d_item.unit */
    int finished;            /* all tiles are, but those that the last round's bins change */
    e3d_visible_tile *kept;  /* NULL: one round */
    e3d_tile_depths *depths; /* of the tiles */
    e3d_round round;
    const e3d_record *records[E3D_PASSES][E3D_MAX_THREADS];
    const e3d_drawn_cluster *drawn[E3D_MAX_THREADS];
    e3d_record_table tables[E3D_PASSES];
    float view[12]; /* rows of view_from_world, f32 */
    float unorm8[256]; /* values of 8-bit vertex and instance colours (R23) */
    e3d_lighting lighting;
    e3d_output outputs[E3D_OUTPUTS]; /* by kind */
    int32_t tiles_x, tiles_y;
    int by_fragments;  /* small triangles become fragments at once */
    int sorted;        /* painter or none: bins are made after sorting */
    int srgb;          /* the encoder of this frame (R34) */
    int blockwise;     /* samples are shaded in blocks, which few of the lights reach */
    int draw_faces;    /* faces are needed at all, not only counted */
    int wants;         /* E3D_WANT_* and E3D_NEED_* of the visible samples; 0: no shading */
    int32_t line_half, point_half; /* 1/256 sample */
    int32_t line_reach; /* of any line along its minor axis: no less than half, where */
    int wide_lines;     /* they are as wide across as they say */
    int mirrors;        /* the camera does: R2 */
    float background[3];                        /* clamped */
    float background_sample[4], line_sample[4]; /* colour, and whether it counts (e3d_samples) */
    uint32_t background_rgba, line_rgba;        /* of a pixel of nothing else */
    uint32_t background_row[E3D_TILE];
    atomic_llong next; /* instance, task or item */
    atomic_llong next_unit;
    atomic_int stop;   /* cancelled or out of memory */
    int cancelled;
    int64_t last_poll;
} e3d_context;

/* counts.c */
/* Counts what the frame submits, and takes it all for drawn. */
void e3d_count_submitted(const e3d_frame *frame, e3d_stats *stats);
void e3d_count(const e3d_context *context, e3d_stats *stats);
/* prepare.c */
e3d_status e3d_prepare(e3d_context *context);
/* Finds what an instance is drawn with besides its clip matrix. */
void e3d_prepare_surface(const e3d_context *context, e3d_instance *instance);
/* geometry.c */
void e3d_geometry(e3d_context *context);
/* cull.c */
int e3d_box_state(const float clip[16], const float lo[3], const float hi[3]);
/* Only the state is set of a box that is outside. */
void e3d_view_box(const e3d_viewport *viewport, const float clip[16], const float lo[3], const float hi[3],
                  e3d_box_view *out);
/* Of vertices that are all in the frustum, four or more, around a sample; 0 if they are not. */
int e3d_view_vertices(const e3d_viewport *viewport, const e3d_vertices *vertices, e3d_box_view *out);
/* Lists the frame's items; 0 when memory is out. */
int e3d_find_items(e3d_context *context);
const float *e3d_culling_matrix(const e3d_frame *frame, const e3d_instance *instance);
/* draws.c */
/* Whose an instance, a unit of work or a group of clusters is, by its number in the frame: there must be one. */
const e3d_draw_state *e3d_draw_of_instance(const e3d_context *context, int64_t instance);
const e3d_draw_state *e3d_draw_of_unit(const e3d_context *context, int64_t unit);
const e3d_draw_state *e3d_draw_of_group(const e3d_context *context, int64_t group);
/* The last turn that starts at or before an order. */
const e3d_turn *e3d_find_turn(const e3d_context *context, uint32_t order);

/* facing.c */
void e3d_facing_prepare(const e3d_viewport *viewport, const float clip[16], e3d_facing *out);

/* occlusion.c */
int e3d_occlusion_pays(const e3d_context *context);
/* After a frame of several rounds: the next ones go without where little was occluded. */
void e3d_occlusion_judge(e3d_context *context, const e3d_stats *stats);
int e3d_occlusion_begin(e3d_context *context);
/* Finds what the last frame of several rounds showed: 1 if it knows of most groups, -1 when memory is out. */
int e3d_remember(e3d_context *context);
/* Draws a round's tiles, and keeps what the next one needs of them; 0 when memory is out. */
int e3d_draw_kept_tiles(e3d_context *context);
/* Whether most tiles can be finished with what the last frames showed. */
int e3d_finishes_early(const e3d_context *context);
/* After the last round's geometry. */
void e3d_count_changed_tiles(e3d_context *context);

/* depths.c */
int e3d_is_hidden(const e3d_context *context, const e3d_box_view *view);
/* The same of what a record covers. */
int e3d_record_is_hidden(const e3d_context *context, const e3d_record *record);
/* Asks for what that reads first. */
void e3d_fetch_kept(const e3d_context *context, const e3d_box_view *view);
/* Notes a tile's farthest depths. */
void e3d_note_depths(e3d_context *context, e3d_visible_tile *visible, int64_t tile);

/* lines.c: units of 256 lines, then points, then edges of an instance */
void e3d_draw_unit(e3d_context *context, e3d_worker *worker, const e3d_draw_state *draw, int32_t instance,
                   int32_t unit);

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
int e3d_records_reset(e3d_record_set *set, int32_t tiles);
/* Of records or of fragments. */
void e3d_bins_clear(e3d_array *bins, e3d_array *blocks, int32_t tiles);
/* Puts what they hold aside; 0 when memory is out. */
int e3d_bins_keep(e3d_array *bins, e3d_array *earlier, int32_t tiles);
/* Of so many records from one on, to the tiles of their spans; 0 when memory is out. */
int e3d_bin_records(const e3d_context *context, e3d_worker *worker, e3d_record_set *set, uint32_t first, const e3d_tile_span *spans,
                    int count);
static inline e3d_tile_span e3d_span_of(const e3d_box *box)
{
    return (e3d_tile_span){(uint32_t)(box->y0 >> E3D_TILE_SHIFT << 16 | box->x0 >> E3D_TILE_SHIFT),
                           (uint32_t)(box->y1 >> E3D_TILE_SHIFT << 16 | box->x1 >> E3D_TILE_SHIFT)};
}
/* Whether `more` records have IDs and memory. */
int e3d_records_fit(const e3d_context *context, e3d_record_set *set, size_t more);
/* Whether any thread has a record or a fragment for the tile. */
int e3d_has_bin(const e3d_context *context, int pass, int64_t tile);
/* How many a tile's bins of the scene hold. */
typedef struct e3d_entries {
    uint32_t records, fragments;
} e3d_entries;
e3d_entries e3d_count_entries(const e3d_context *context, int64_t tile);
/* The first block of a tile's chain, of records or of fragments. */
static inline uint32_t e3d_first_block(const e3d_array *bins, int64_t tile) { return ((const e3d_bin *)bins->data)[tile].first; }
/* The blocks of a chain, one after the other; NULL behind the last. The bins are the set's own, or its earlier ones. */
static inline const e3d_bin_block *e3d_bin_block_at(const e3d_record_set *set, uint32_t number)
{
    return number == E3D_NO_BLOCK ? NULL : (const e3d_bin_block *)set->blocks.data + number;
}
static inline const e3d_bin_block *e3d_first_records(const e3d_record_set *set, const e3d_array *bins, int64_t tile)
{
    return e3d_bin_block_at(set, e3d_first_block(bins, tile));
}
static inline const e3d_bin_block *e3d_next_records(const e3d_record_set *set, const e3d_bin_block *block)
{
    return e3d_bin_block_at(set, block->next);
}
static inline const e3d_fragment_block *e3d_fragment_block_at(const e3d_fragment_set *set, uint32_t number)
{
    return number == E3D_NO_BLOCK ? NULL : (const e3d_fragment_block *)set->blocks.data + number;
}
static inline const e3d_fragment_block *e3d_first_fragments(const e3d_fragment_set *set, const e3d_array *bins, int64_t tile)
{
    return e3d_fragment_block_at(set, e3d_first_block(bins, tile));
}
static inline const e3d_fragment_block *e3d_next_fragments(const e3d_fragment_set *set, const e3d_fragment_block *block)
{
    return e3d_fragment_block_at(set, block->next);
}
/* After the records have their places: the tables that tell a record by its ID. */
void e3d_tables_set(e3d_context *context);
/* fragments.c */
int e3d_fragments_reset(e3d_fragment_set *set, int32_t tiles);
/* Whether a cluster more can have IDs. */
int e3d_fragments_fit(const e3d_context *context, const e3d_worker *worker);
/* Another cluster that has fragments, to be filled in; NULL when memory is out. */
e3d_drawn_cluster *e3d_fragments_cluster(e3d_worker *worker);
/* Takes small triangles of that cluster, a bit each, which become fragments now or later. */
void e3d_fragments_add(const e3d_context *context, e3d_worker *worker, const e3d_vertices *vertices, const uint8_t *indices,
                       uint64_t triangles);
/* All that were taken become fragments. */
void e3d_fragments_flush(const e3d_context *context, e3d_worker *worker);
/* Draws a tile's fragments, or those of the round that finished it. */
void e3d_fragments_draw(const e3d_context *context, const e3d_fragment_set *set, e3d_visible_tile *visible, int64_t tile_number,
                        int earlier);
/* What they show of the tile, to the end of the list. */
void e3d_fragments_show(const e3d_context *context, const e3d_fragment_set *set, e3d_worker *worker, int64_t tile_number);

/* order.c */
int e3d_sort_records(e3d_context *context);

/* share.c: all tiles are to be done, each by one worker. */
void e3d_share_tiles(e3d_context *context);

/* The next tile that a worker may do this with; -1 when none is left. */
int64_t e3d_take_tile(const e3d_context *context, e3d_worker *worker, e3d_to_do what);

/* blank.c: whether nothing is drawn in a tile, or nothing more. */
int e3d_is_blank(const e3d_context *context, int64_t tile);

/* Clears such tiles: some rows at a time, and at last what is left of all. */
void e3d_blank_begin(const e3d_context *context, e3d_worker *worker);
enum { E3D_SOME_ROWS = 8 }; /* that are written at once between batches */
/* The one that is being cleared now, perhaps with no rows left. */
e3d_tile *e3d_blank_now(const e3d_context *context, e3d_worker *worker);
void e3d_blank_some(const e3d_context *context, e3d_worker *worker);
void e3d_blank_rest(const e3d_context *context, e3d_worker *worker);

/* late.c: rows of the picture that wait to be written while samples are shaded */
/* The colours of a tile that is done; those of the one before are written now, if they aren't yet. */
void e3d_late_add(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
/* Rows for a kernel to write some of, or NULL. */
e3d_pixel_rows *e3d_late_rows(const e3d_context *context, e3d_worker *worker);
/* Writes some where it can't. */
void e3d_late_some(const e3d_context *context, e3d_pixel_rows *rows);
/* All that wait, when no more samples are shaded. */
void e3d_late_rest(const e3d_context *context, e3d_worker *worker);

/* tile.c, shade.c, resolve.c */
/* Adds to a stage's time what has passed since the thread's last lap. */
static inline void e3d_lap(e3d_worker *worker, int64_t *stage_ns)
{
    int64_t now = e3d_now_ns();
    *stage_ns += now - worker->lap;
    worker->lap = now;
}
void e3d_tiles(e3d_context *context);
/* visible.c: the visible surface by record ID, for whatever shades it afterwards */
void e3d_visible_clear(e3d_visible_tile *visible, const e3d_tile *tile);
void e3d_visible_draw(const e3d_context *context, e3d_visible_tile *visible, int64_t tile_number);
/* Makes the list of what shows, where the tile's bins hold all of it. */
void e3d_visible_show(const e3d_context *context, e3d_worker *worker, int64_t tile_number);
/* Shades the first `count` of the tile memory's runs, which are owned by IDs; 0 when memory is out. */
int e3d_shade_runs(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int32_t count);
/* Shades the list of what shows; 0 when memory is out. */
int e3d_shade_shown(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
/* Begins a list of what shows, of runs or of samples. */
static inline void e3d_shown_begin(e3d_shown *shown, int runs)
{
    shown->runs = runs;
    shown->count = shown->pieces = 0;
}
/* spans.c */
/* Makes the list of what shows of few records; 0 where they are too large for that, or meet too much. */
int e3d_show_spans(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int64_t number);
/* Whether they left no gap. */
int e3d_spans_cover_all(const e3d_cover *cover);
/* runs.c */
/* Sorts runs by owner; where they are afterwards. */
e3d_run *e3d_sort_runs(e3d_run *runs, e3d_run *spare, int32_t count);
/* Makes the list of what shows of sorted runs, as pieces. */
void e3d_show_runs(const e3d_run *runs, int32_t count, e3d_shown *out);
/* surface.c */
/* The pieces of what shows, chained by group; 0 when memory is out. */
int e3d_find_pieces(const e3d_context *context, e3d_worker *worker);
/* The surfaces of pieces of a group from `first` on, without what e3d_find_surfaces adds; the first piece that is left, or -1. */
int32_t e3d_add_surfaces(const e3d_context *context, e3d_worker *worker, const e3d_group *group, int32_t first, int wanted);
void e3d_find_surfaces(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int wanted);
int32_t e3d_face_of(const e3d_visible_piece *piece);
void e3d_resolve_begin(const e3d_context *context, e3d_worker *worker);
/* Of a tile that is finished already, and of which some samples are to be shaded anew. */
void e3d_resolve_again(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
/* batch->color is that of its samples. */
void e3d_resolve_batch(const e3d_context *context, e3d_worker *worker);
/* The batch's samples show the background again: forward shading may have drawn there before. */
void e3d_resolve_hidden(const e3d_context *context, e3d_worker *worker);
void e3d_resolve_overdraw(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
void e3d_resolve_wire(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
void e3d_resolve(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
/* picture.c: `rows`, `step` bytes apart, of pixels of so many bytes, to the tile's place in a picture. */
void e3d_write_tile(const e3d_context *context, const e3d_tile *tile, void *picture, size_t pixel, const void *rows, size_t step);
/* What that writes; whether it would stream it. */
int e3d_tile_rows(const e3d_context *context, const e3d_tile *tile, void *picture, size_t pixel, const void *from, size_t step,
                  e3d_pixel_rows *out);
/* The same back. */
void e3d_read_tile(const e3d_context *context, const e3d_tile *tile, const void *picture, size_t pixel, void *rows, size_t step);
/* outputs.c: the G-buffer */
int e3d_outputs_prepare(e3d_context *context); /* 0 when memory is out */
void e3d_outputs_begin(const e3d_context *context, e3d_worker *worker);
void e3d_outputs_again(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
void e3d_outputs_batch(const e3d_context *context, e3d_worker *worker);
void e3d_outputs_end(const e3d_context *context, const e3d_worker *worker, const e3d_tile *tile);
/* The whole tile is background. */
void e3d_outputs_blank(const e3d_context *context, const e3d_tile *tile);

/* Whether a material's specular or emissive colour adds anything. */
static inline int e3d_adds(const float color[3]) { return color[0] != 0.0f || color[1] != 0.0f || color[2] != 0.0f; }

/* What object_id and instance_id output. */
static inline int32_t e3d_object_id(const e3d_draw *draw, int32_t instance)
{
    return draw->pose_kind == E3D_POSE_NODES ? draw->node_ids[instance] : draw->node_id;
}
static inline int32_t e3d_instance_id(const e3d_draw *draw, int32_t instance)
{
    if (draw->instance_ids)
        return draw->instance_ids[instance];
    return draw->pose_kind == E3D_POSE_NODES ? 0 : draw->first_instance + instance;
}

static inline int64_t e3d_tile_count(const e3d_context *c) { return (int64_t)c->tiles_x * c->tiles_y; }

static inline e3d_tile e3d_tile_at(const e3d_context *context, int64_t number)
{
    e3d_tile tile = {.x = (int32_t)(number % context->tiles_x) * E3D_TILE,
                     .y = (int32_t)(number / context->tiles_x) * E3D_TILE};
    int32_t width = context->viewport.width - tile.x, height = context->viewport.height - tile.y;
    tile.width = width < E3D_TILE ? width : E3D_TILE;
    tile.height = height < E3D_TILE ? height : E3D_TILE;
    return tile;
}

/* Whether each piece is shaded at once. */
static inline int e3d_is_forward(const e3d_context *context)
{
    return context->wants && context->frame->shading == E3D_SHADING_FORWARD;
}

/* Whether samples keep slots rather than record IDs. */
static inline int e3d_keeps_slots(const e3d_context *context) { return context->sorted || e3d_is_forward(context); }

/* Whether earlier rounds drew something in a tile, which this one draws upon. */
static inline int e3d_is_kept(const e3d_context *c, int64_t tile)
{
    return c->kept && !c->finished && c->depths[tile].most != E3D_NOTHING_KEPT;
}

#endif
