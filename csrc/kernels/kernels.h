/* The kernels: one table of functions per instruction set. The plain structs that they work on are in kernels/types/.
 *
 * Every kernel gives the bytes of docs/exactness.md; what a table adds is speed. Arrays that a kernel reads
 * or writes vector by vector have room for E3D_PAD elements past the end; what it leaves there means nothing.
 */
#ifndef E3D_KERNELS_H
#define E3D_KERNELS_H

#include "core/limits.h"
#include "core/mesh.h"
#include "e3d.h"
#include "kernels/types/fragments.h"
#include "kernels/types/records.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"

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
#define E3D_DECLARE_KERNELS(backend, name, ...) extern const e3d_kernels e3d_kernels_##name;
E3D_EACH_X86_BACKEND(E3D_DECLARE_KERNELS)
#endif

#endif
