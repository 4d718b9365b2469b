/* The kernels: one table of functions per instruction set, and the plain structs they work on.
 *
 * Every kernel gives the bytes of docs/exactness.md; what a table adds is speed. Arrays that a kernel reads
 * or writes vector by vector have room for E3D_PAD elements past the end; what it leaves there means nothing.
 */
#ifndef E3D_KERNELS_H
#define E3D_KERNELS_H

#include "core/limits.h"
#include "core/mesh.h"
#include "e3d.h"

enum { E3D_PAD = 16 };

/* ---- cull ---- */

/* What tells which way an instance's clusters face. */
typedef struct e3d_facing {
    float eye[3];    /* object space */
    int32_t sign;    /* of the screen's area where n.(p - eye) is positive; 0: cannot be told */
    float length[4]; /* of the clip matrix's rows x, y, w, z, without translation */
    float scale;     /* of areas, over the first three lengths */
} e3d_facing;

/* ---- transform ---- */

/* Outcodes (R5), and what only the screen tells (R4, R8). */
enum {
    E3D_NEAR = 1,
    E3D_FAR = 2,
    E3D_LEFT = 4,
    E3D_RIGHT = 8,
    E3D_BOTTOM = 16,
    E3D_TOP = 32,
    E3D_OUTSIDE = 63,
    E3D_BEHIND = 64, /* WMIN */
    E3D_BEYOND_GUARD = 128,
    E3D_CLIP = E3D_NEAR | E3D_BEHIND | E3D_BEYOND_GUARD,
    E3D_NONFINITE = 256,   /* a clip coordinate is */
    E3D_BAD_SCREEN = 512   /* z/w is not finite */
};

/* The viewport in samples, and its guard factors (section 2 of the rules). */
typedef struct e3d_viewport {
    int32_t width, height;   /* samples */
    float scale_x, scale_y;  /* 128 * width, 128 * height */
    float guard_x, guard_y;
} e3d_viewport;

/* A cluster's vertices in clip space and on the screen. (All arrays are whole lines of the cache, where the struct is aligned to
 * one: vectors that lie across two take twice as long.) */
typedef struct e3d_vertices {
    float x[E3D_CLUSTER_VERTICES], y[E3D_CLUSTER_VERTICES], z[E3D_CLUSTER_VERTICES],
        w[E3D_CLUSTER_VERTICES];
    float iw[E3D_CLUSTER_VERTICES], zn[E3D_CLUSTER_VERTICES];
    int32_t sx[E3D_CLUSTER_VERTICES], sy[E3D_CLUSTER_VERTICES]; /* snapped, 1/256 sample */
    int32_t code[E3D_CLUSTER_VERTICES]; /* outcodes, where `special`; else all are in the frustum, and x, y, z, w may be missing */
    int32_t count, special;
    int32_t unused[14]; /* the next one begins with a line of the cache, too */
} e3d_vertices;

_Static_assert(sizeof(e3d_vertices) % 64 == 0, "vertices are whole lines of the cache");

/* ---- setup ---- */

/* Triangles of a cluster that may show, a bit each: `small` become fragments, where these are asked for, `draw` records, and
 * `clip` need clipping first. None that covers a sample is missing; of the others, those go that have no sample in their box,
 * or face the wrong way as far as 32 bits tell. */
typedef struct e3d_survivors {
    uint64_t draw, small, clip;
} e3d_survivors;

_Static_assert(E3D_CLUSTER_TRIANGLES == 64, "a bit for each triangle of a cluster");

/* Small are boxes of so many samples a side, and sides of so many steps at most: 32 bits hold their edge functions. */
enum { E3D_SMALL = 4, E3D_SMALL_REACH = 16383 };

/* What setup leaves of a piece of a primitive, ready for any tile: a cache line. */
typedef struct e3d_record {
    int32_t x[3], y[3]; /* snapped, counter-clockwise in R9's sense */
    float z0, gx, gy, zmin, zmax;
    float iw[3];
    uint32_t order;
    uint32_t meta; /* flags, and above E3D_RECORD_SHIFT the corners' number or the cover */
} e3d_record;

_Static_assert(sizeof(e3d_record) == 64, "a record is a cache line");

enum {
    E3D_RECORD_BACK = 1,    /* not front-facing */
    E3D_RECORD_SWAPPED = 2, /* vertices 1 and 2 were exchanged (R9) */
    E3D_RECORD_CUT = 4,     /* has corner barycentrics */
    E3D_RECORD_FACE = 8,
    E3D_RECORD_TINY = 16,   /* a box of at most 2 x 2 samples: bit 2 * row + column tells which are covered */
    E3D_RECORD_SHIFT = 5
};

/* Triangles of a cluster, to become records. */
typedef struct e3d_record_request {
    const e3d_vertices *vertices;
    const uint8_t *indices;   /* three planes of E3D_CLUSTER_TRIANGLES */
    const uint8_t *triangles; /* `count` of the cluster; E3D_PAD more are read and must be less than 64 */
    int count;
    int tiny;                 /* those of at most 2 x 2 samples are told from the others: without cover, they are left out */
    int cull, mirrored;       /* sign of the area to drop, as for setup; front faces are the mirrored ones */
    uint32_t order;           /* of the mesh's first face */
    const int32_t *faces;     /* of the cluster's triangles */
    const e3d_viewport *viewport;
} e3d_record_request;

/* Tiles that a record's box touches: row << 16 | column, inclusive. */
typedef struct e3d_tile_span {
    uint32_t first, last;
} e3d_tile_span;

/* ---- fragments ---- */

enum { E3D_SMALLS = 4 * E3D_CLUSTER_TRIANGLES, E3D_MOST_FRAGMENTS = E3D_SMALLS * E3D_SMALL * E3D_SMALL };

/* Small triangles of some clusters, with area and a sample in their boxes: snapped corners, and the ID of the fragments. (Arrays
 * are whole lines of the cache, as those of e3d_vertices.) */
typedef int32_t e3d_small_words[E3D_SMALLS + E3D_PAD];
typedef struct e3d_small_triangles {
    e3d_small_words x[3], y[3], id;
    float zn[3][E3D_SMALLS + E3D_PAD];
    int32_t count;
} e3d_small_triangles;

/* A chain of blocks; without any, both are E3D_NO_BLOCK. */
enum { E3D_NO_BLOCK = 0xFFFFFFFFu };
typedef struct e3d_bin {
    uint32_t first, last;
} e3d_bin;

/* What they cover, sample by sample: fragments of one tile, in order of arrival. A whole vector is written, so that the last
 * block of a bin takes none where there is less room than that. */
enum { E3D_BLOCK_FRAGMENTS = 127 };
typedef struct e3d_fragment_block {
    uint32_t next, count;
    float z[E3D_BLOCK_FRAGMENTS];
    int32_t id[E3D_BLOCK_FRAGMENTS];
    uint16_t sample[E3D_BLOCK_FRAGMENTS];
} e3d_fragment_block;

_Static_assert(sizeof(e3d_fragment_block) % 64 == 0, "blocks are whole cache lines");

/* Blocks in use, and one bin for each tile. There is room for as many blocks more as fragments of E3D_SMALLS triangles take. */
typedef struct e3d_fragment_bins {
    e3d_fragment_block *blocks;
    e3d_bin *bins;
    uint32_t count;
    int32_t fragments, triangles; /* made; triangles that they are of */
} e3d_fragment_bins;

static inline size_t e3d_fragment_blocks_most(size_t tiles)
{
    return (tiles < E3D_MOST_FRAGMENTS ? tiles : E3D_MOST_FRAGMENTS) + E3D_MOST_FRAGMENTS / (E3D_BLOCK_FRAGMENTS - E3D_PAD);
}

/* ---- raster ---- */

/* A piece in one tile: edge functions at the tile's first sample, floor(E / 256) with the top-left rule
 * inside; an edge that the whole tile satisfies is all zero. */
typedef struct e3d_piece {
    int32_t e[3], a[3], b[3];
    int32_t x0, y0, x1, y1;  /* box in the tile, inclusive */
    float z0, gx, gy, zmin, zmax;
    int32_t base_x, base_y;  /* of the depth plane, relative to the tile's first sample */
    uint32_t slot, order;
} e3d_piece;

enum { E3D_NO_SLOT = -1 };

/* What an empty sample's depth is: z < this exactly when z <= 1 (R15). */
#define E3D_BEYOND_FAR 0x1.000002p0f

/* A cluster that has fragments, of one instance. */
typedef struct e3d_drawn_cluster {
    const int32_t *faces; /* of its triangles */
    uint32_t order;       /* of the instance's first face */
    int32_t instance, draw; /* in the frame */
    int32_t mirrored;
} e3d_drawn_cluster;

/* The records of a frame: those of worker w at records[w], under the IDs number << bits | w; and the clusters of the fragments,
 * whose triangles have the IDs E3D_FRAGMENT_ID | (64 * number + triangle) << bits | w. */
typedef struct e3d_record_table {
    const e3d_record *const *records;
    const e3d_drawn_cluster *const *drawn;
    int32_t bits;
} e3d_record_table;

enum { E3D_FRAGMENT_ID = 1 << 30 };

static inline const e3d_record *e3d_record_at(const e3d_record_table *table, uint32_t id)
{
    return table->records[id & ((1u << table->bits) - 1)] + (id >> table->bits);
}

static inline const e3d_drawn_cluster *e3d_drawn_at(const e3d_record_table *table, uint32_t id, int32_t *triangle)
{
    uint32_t number = (id & (E3D_FRAGMENT_ID - 1)) >> table->bits;
    *triangle = (int32_t)(number % E3D_CLUSTER_TRIANGLES);
    return table->drawn[id & ((1u << table->bits) - 1)] + number / E3D_CLUSTER_TRIANGLES;
}

/* The order of the primitive that an ID is of. */
static inline uint32_t e3d_order_at(const e3d_record_table *table, uint32_t id)
{
    if (!(id & E3D_FRAGMENT_ID))
        return e3d_record_at(table, id)->order;
    int32_t triangle;
    const e3d_drawn_cluster *drawn = e3d_drawn_at(table, id, &triangle);
    return drawn->order + (uint32_t)drawn->faces[triangle];
}

enum { E3D_TILE_BLOCKS = E3D_TILE_SAMPLES / 64 };

/* The visible surface of a tile, and of its blocks of 8 x 8 samples, row by row. A noted block is covered whole by one
 * record (or none: ID -1), and its samples are not written yet. zmin and zmax bound a block's depths; the zmax of a
 * stale one is too large. */
typedef struct e3d_visible_tile {
    float z[E3D_TILE_SAMPLES + E3D_PAD];
    int32_t id[E3D_TILE_SAMPLES + E3D_PAD];
    float zmin[E3D_TILE_BLOCKS], zmax[E3D_TILE_BLOCKS];
    int32_t noted_id[E3D_TILE_BLOCKS];
    uint64_t noted, stale;
    int32_t x, y; /* first sample */
} e3d_visible_tile;

typedef struct e3d_tile_buffers {
    float *z;               /* E3D_TILE_SAMPLES, 64-byte aligned */
    int32_t *slot;          /* or counts, or marks */
    const uint32_t *orders; /* order of each slot: ties of depth */
} e3d_tile_buffers;

/* ---- shade ---- */

/* Neighbouring samples of one row of a tile that show the same: a slot or an ID; when they are sorted, a piece. */
typedef struct e3d_run {
    int32_t owner;
    uint16_t sample, length;
} e3d_run;

/* A piece that shows in a tile: its ID, and its first sample in the list, or its first run. */
typedef struct e3d_shown_piece {
    uint32_t id;
    int32_t first;
} e3d_shown_piece;

/* What shows in a tile, piece after piece: samples, or runs. */
typedef struct e3d_shown {
    int32_t sample[E3D_TILE_SAMPLES + 2 * E3D_PAD]; /* y * E3D_TILE + x; of a run the first, and its length << E3D_RUN_LENGTH */
    int32_t of[E3D_TILE_SAMPLES + 2 * E3D_PAD];     /* whose: the piece's number */
    e3d_shown_piece piece[E3D_TILE_SAMPLES + 1];
    int32_t count, pieces; /* of samples or runs, and of pieces */
    int runs;              /* not samples */
} e3d_shown;

enum { E3D_RUN_LENGTH = 16 };

/* A record of a tile, the rows of its box there, and the place of the first one's span. */
typedef struct e3d_covering {
    const e3d_record *record;
    uint32_t id;
    int32_t y0, y1, at;
} e3d_covering;

/* What the records of a tile cover, hidden or not. */
enum { E3D_MOST_COVERING = 256, E3D_COVER_ROWS = 8192 };
typedef struct e3d_cover {
    int32_t x, y, width, height;                             /* of the tile: its first sample, and samples inside the viewport */
    int32_t count, used;                                     /* of the records, and of the spans */
    uint64_t once[E3D_TILE + E3D_PAD], twice[E3D_TILE + E3D_PAD]; /* samples of each row that one covers, and more than one */
    e3d_covering record[E3D_MOST_COVERING];
    int32_t span[E3D_COVER_ROWS + E3D_PAD]; /* of each row of each record a run, perhaps of length 0 */
} e3d_cover;

/* Of records that meet, some after the other, the samples that are left to each. */
typedef struct e3d_layers {
    uint64_t covered[E3D_TILE + E3D_PAD], hidden[E3D_TILE + E3D_PAD]; /* by those so far; by those that aren't open */
    uint64_t left[E3D_COVER_ROWS + E3D_PAD];                          /* of each span */
    struct {
        float zmax;
        int32_t number;
    } open[E3D_MOST_COVERING]; /* records that may reach behind the nearest depths of the next ones */
    int32_t opened;            /* how many */
    int32_t contested, taken;         /* samples whose depths were compared; whether a later one was nearer */
} e3d_layers;

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

/* ---- the table ---- */

typedef struct e3d_kernels {
    /* Bit k: every triangle of cluster k surely has an area of the sign `drop` on the screen, or none; at most 32 clusters. */
    uint32_t (*face_away)(const e3d_cluster *clusters, int count, const e3d_facing *facing, int drop, const float clip[16],
                          const e3d_viewport *viewport);
    /* positions: planes `stride` apart, 3 or 4 of them; count vertices. inside: those that are finite are surely in the frustum,
     * in spite of rounding. */
    void (*transform)(const float *positions, int stride, int count, const float matrix[16],
                      const e3d_viewport *viewport, int inside, e3d_vertices *out);
    void (*take_clip)(const float *positions, int stride, int count, const e3d_viewport *viewport,
                      e3d_vertices *out);
    /* indices: three planes of E3D_CLUSTER_TRIANGLES. cull: sign of the area (screen, Y down) to drop: -1, +1, 0 = neither.
     * fragments: small triangles are to become some. How many survive. */
    int (*setup)(const e3d_vertices *vertices, const uint8_t *indices, int triangles, int cull, int fragments,
                 const e3d_viewport *viewport, e3d_survivors *out);
    /* Records and their tiles; how many. Room for those of a whole cluster. */
    int (*record)(const e3d_record_request *request, e3d_record *out, e3d_tile_span *spans);
    /* Adds triangles of a cluster, a bit each; the IDs of triangle t are first + (t << bits). There is room for all. */
    void (*add_small)(const e3d_vertices *vertices, const uint8_t *indices, uint64_t triangles, int32_t first, int bits,
                      e3d_small_triangles *to);
    /* The fragments of small triangles, which are consumed, to their tiles; tiles in a row of them. */
    void (*fragments)(e3d_small_triangles *triangles, const e3d_viewport *viewport, int tiles_x, e3d_fragment_bins *out);
    void (*raster_depth)(const e3d_piece *piece, const e3d_tile_buffers *tile);
    void (*raster_overwrite)(const e3d_piece *piece, const e3d_tile_buffers *tile);
    void (*raster_count)(const e3d_piece *piece, const e3d_tile_buffers *tile);
    void (*raster_mark)(const e3d_piece *piece, const e3d_tile_buffers *tile);
    /* Draws records into the tile. */
    void (*raster_visible)(e3d_visible_tile *tile, const e3d_record_table *table, const uint32_t *ids, int count);
    void (*raster_fragments)(e3d_visible_tile *tile, const e3d_record_table *table, const e3d_fragment_block *block);
    /* Writes the samples of all noted blocks: the IDs, and the depths where these are needed, else they stay noted. */
    void (*raster_settle)(e3d_visible_tile *tile, const e3d_record_table *table, int depths);
    /* Finds, of each block that isn't noted, zmax and the farthest depth of each column. */
    void (*raster_measure)(e3d_visible_tile *tile, float columns[E3D_TILE_BLOCKS][E3D_BLOCK]);
    /* The runs of the first width x height samples of a tile that show something, those of a row in order; their number. `gaps`:
     * whether some samples show nothing. Of noted blocks, which stay noted, IDs are written where that helps. */
    int (*find_runs)(e3d_visible_tile *tile, int width, int height, e3d_run *out, int *gaps);
    /* Adds the samples that bear the IDs of records to the list; records, in this order, are pieces. */
    void (*show_records)(const e3d_visible_tile *tile, const e3d_record_table *table, const uint32_t *ids, int count, e3d_shown *out);
    /* The same of fragments; those of one triangle that follow each other are a piece. */
    void (*show_fragments)(const e3d_visible_tile *tile, const e3d_fragment_block *block, e3d_shown *out);
    /* Adds what records cover to the rest of the tile's, and their runs to the list; records, in this order, are pieces. 0 where one is
     * too large, or may be beyond the far plane, or there are too many. */
    int (*cover_records)(e3d_cover *cover, const e3d_record_table *table, const uint32_t *ids, int count, e3d_shown *out);
    /* Adds the runs of the records that others don't meet. Lists the numbers of the rest; how many. */
    int (*show_alone)(const e3d_cover *cover, e3d_shown *out, uint16_t *rest);
    /* Adds what shows of these, the nearest first. 0 where to find depths of all samples takes less. */
    int (*show_layers)(const e3d_cover *cover, const e3d_record_table *table, const uint16_t *numbers, int count, e3d_layers *layers,
                       e3d_shown *out);
    /* Adds as many runs or samples from `first` on as the batch has room for; how many. A batch of none takes one at least. Piece
     * `piece` is surface 0, the others follow. */
    int (*take_runs)(const e3d_shown *shown, int first, int count, int32_t piece, e3d_batch *batch);
    int (*take_shown)(const e3d_shown *shown, int first, int count, int32_t piece, e3d_batch *batch);
    /* The corners on the screen (R3, R8, R9) of pieces that have no record. */
    void (*project)(e3d_surfaces *surfaces, const e3d_viewport *viewport);
    /* The planes of R18 of pieces that weren't clipped, and what is wanted of the vertices; the tile's first sample. */
    void (*surface)(e3d_surfaces *surfaces, int tile_x, int tile_y, int wanted);
    void (*interpolate)(e3d_batch *batch, const e3d_surfaces *surfaces, int wanted);
    /* color = base * texture */
    void (*texture)(e3d_batch *batch, const e3d_texture_view *texture, const float base[3]);
    /* color *= vertex colour, color *= instance colour */
    void (*tint)(e3d_batch *batch, const e3d_surfaces *surfaces, int by_vertex, int by_instance);
    /* energy, and shine where shininess > 0 */
    void (*light)(e3d_batch *batch, const e3d_lighting *lighting, float shininess);
    /* color = (color * energy + specular * shine) + emissive; specular may be NULL */
    void (*combine)(e3d_batch *batch, const float specular[3], const float emissive[3]);
    /* Planes of colours, which are clamped to [0, 1], to RGBA8 with alpha 255. */
    void (*encode)(const float *red, const float *green, const float *blue, int count, int srgb,
                   uint32_t *rgba);
    /* The colours of a batch, likewise, each to its sample's place in rgba. */
    void (*put)(const e3d_batch *batch, int srgb, uint32_t *rgba);
    /* Keeps a batch's colours, clamped: its samples count. */
    void (*keep)(const e3d_batch *batch, e3d_samples *samples);
    /* `width` pixels of axis x axis samples each, the first in that row of samples: their mean colours, encoded, and alpha; the
     * background's colour, which is clamped, where none counts. */
    void (*average)(const e3d_samples *samples, int axis, int row, int width, const float background[3], int srgb, uint32_t *rgba);
    /* All of these from interpolate on: the pixels of a batch, each at its sample's place in rgba. There are few lights. */
    void (*paint)(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint, uint32_t *rgba);
    /* Copies what this core won't read again: e3d_stream_end before other threads are told. */
    void (*stream)(const e3d_pixel_rows *rows);
} e3d_kernels;

/* NULL for E3D_BACKEND_SCALAR and for what this build or CPU lacks. */
const e3d_kernels *e3d_kernels_for(e3d_backend backend);

extern const e3d_kernels e3d_kernels_portable;
#ifdef E3D_HAVE_X86
extern const e3d_kernels e3d_kernels_sse41;
extern const e3d_kernels e3d_kernels_avx2;
extern const e3d_kernels e3d_kernels_avx512;
#endif

#endif
