/* The kernels: one table of functions per instruction set. The plain structs that they work on are in kernels/types/.
 *
 * Every kernel gives the bytes of docs/exactness; what a table adds is speed. Arrays that a kernel reads
 * or writes vector by vector have room for E3D_PAD elements past the end; what it leaves there means nothing.
 */
#ifndef E3D_KERNELS_H
#define E3D_KERNELS_H

#include "core/built_backends.h"
#include "core/limits.h"
#include "core/mesh.h"
#include "core/sample_patterns.h"
#include "e3d.h"
#include "e3d_canvas.h"
#include "kernels/types/alpha.h"
#include "kernels/types/casters.h"
#include "kernels/types/fog.h"
#include "kernels/types/fragments.h"
#include "kernels/types/lobe.h"
#include "kernels/types/maps.h"
#include "kernels/types/mixed.h"
#include "kernels/types/occlusion.h"
#include "kernels/types/records.h"
#include "kernels/types/samples.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "kernels/types/ui.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"

typedef struct e3d_kernels {
    /* Returns a bit for each of up to 32 clusters: its triangles surely all have an area of the sign `drop` on the screen, or
     * none. */
    uint32_t (*face_away)(const e3d_cluster *clusters, int count, const e3d_facing *facing, int drop, const float clip[16],
                          const e3d_viewport *viewport);
    /* Transform `count` vertices, whose positions are 3 (take_clip: 4) planes `stride` apart. inside: whatever is finite is surely
     * in the frustum, in spite of rounding. */
    void (*transform)(const float *positions, int stride, int count, const float matrix[16],
                      const e3d_viewport *viewport, int inside, e3d_vertices *out);
    void (*take_clip)(const float *positions, int stride, int count, const e3d_viewport *viewport,
                      e3d_vertices *out);
    /* Finds the triangles of a cluster that may show; returns how many. indices: three planes of E3D_CLUSTER_TRIANGLES. cull: the
     * sign of the area (screen, Y down) to drop, or 0. fragments: micro-triangles are to become fragments. */
    int (*setup)(const e3d_vertices *vertices, const uint8_t *indices, int triangles, int cull, int fragments,
                 const e3d_viewport *viewport, e3d_survivors *out);
    /* Makes records, and finds their tiles; returns how many. There is room for those of a whole cluster. */
    int (*record)(const e3d_record_request *request, e3d_record *out, e3d_tile_span *spans);
    /* Adds micro-triangles of a cluster, a bit each, for which there is room; triangle t has the ID first + (t << bits). */
    void (*add_small)(const e3d_vertices *vertices, const uint8_t *indices, uint64_t triangles, int32_t first, int bits,
                      e3d_small_triangles *to);
    /* Turns all micro-triangles into fragments in the bins of their tiles, tiles_x in a row, and empties the list. */
    void (*fragments)(e3d_small_triangles *triangles, const e3d_viewport *viewport, int tiles_x, e3d_fragment_bins *out);
    /* Draw a piece into a tile: the nearest shows; the last shows; count the pieces over each sample; mark samples. */
    void (*raster_depth)(const e3d_piece *piece, const e3d_tile_buffers *tile);
    void (*raster_overwrite)(const e3d_piece *piece, const e3d_tile_buffers *tile);
    void (*raster_count)(const e3d_piece *piece, const e3d_tile_buffers *tile);
    void (*raster_mark)(const e3d_piece *piece, const e3d_tile_buffers *tile);
    /* Draw records, or a block of fragments, into the tile: the nearest shows (R16). */
    void (*raster_visible)(e3d_visible_tile *tile, const e3d_record_table *table, const uint32_t *ids, int count);
    void (*raster_fragments)(e3d_visible_tile *tile, const e3d_record_table *table, const e3d_fragment_block *block);
    /* Writes the samples of all noted blocks: with depths, else the IDs alone, and the blocks stay noted. */
    void (*raster_settle)(e3d_visible_tile *tile, const e3d_record_table *table, int depths);
    /* Measures each block that isn't noted: its zmax, and the farthest depth of each column. */
    void (*raster_measure)(e3d_visible_tile *tile, float columns[E3D_TILE_BLOCKS][E3D_BLOCK]);
    /* Multisampling: a plane of a tile for each sample of its pixels, in which `noted`, `stale`, `zmin` and `zmax` of the first one stand for
     * all. Draws records; writes all noted blocks; measures the others for all planes (see raster_measure). */
    void (*raster_planes)(e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table, const uint32_t *ids,
                          int count);
    void (*planes_settle)(e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table);
    void (*planes_measure)(e3d_visible_tile *planes, int count, float columns[E3D_TILE_BLOCKS][E3D_BLOCK]);
    /* Finds the pixels whose samples don't all show the same, a bit each, row by row. `shared` gets the IDs of the others, and
     * E3D_NO_SLOT for these. Returns whether some of the others, of the first width x height, show nothing. */
    int (*planes_split)(const e3d_visible_tile *planes, int count, int width, int height, uint64_t mixed[E3D_TILE], e3d_visible_tile *shared);
    /* Lists the colours that are to be shaded of the list's pixels from `first` on, as far as there is room; returns the pixel that comes next. */
    int (*list_mixed)(const e3d_visible_tile *planes, int samples, int first, e3d_run *runs, e3d_mixed_list *list);
    /* Adds the samples that a piece, whose slot is its ID, covers in front of what shows: row by row from y0 on, while there is room
     * for a whole one. Returns the row that comes next. */
    int32_t (*raster_alpha)(const e3d_piece *piece, const e3d_record_table *table, e3d_alpha_list *out);
    /* Adds the pixels of rows y to last that pieces of one record, one in each plane that is `live` (a bit each), cover in front of what
     * shows there. Returns the row that comes next. */
    int32_t (*cover_planes)(const e3d_piece *pieces, uint32_t live, int32_t y, int32_t last, const e3d_record_table *table,
                            e3d_planes_list *out);
    /* Finds the runs of the first width x height samples that show something, row by row; returns how many. `gaps`: whether some
     * samples show nothing. It writes the IDs of noted blocks where it must look at samples; the blocks stay noted. */
    int (*find_runs)(e3d_visible_tile *tile, int width, int height, e3d_run *out, int *gaps);
    /* Adds the samples that show records to the list: a piece for each record, in this order. */
    void (*show_records)(const e3d_visible_tile *tile, const e3d_record_table *table, const uint32_t *ids, int count, e3d_shown *out);
    /* Likewise for fragments: a piece for those of one triangle, which follow each other. */
    void (*show_fragments)(const e3d_visible_tile *tile, const e3d_fragment_block *block, e3d_shown *out);
    /* Adds what records cover, row by row, to the tile's cover, and their runs to the list, a piece for each record. 0 if one is
     * too large or may reach beyond the far plane, or if there are too many. */
    int (*cover_records)(e3d_cover *cover, const e3d_record_table *table, const uint32_t *ids, int count, e3d_shown *out);
    /* Adds the runs of the records that share no sample with others. Lists the numbers of the rest, and returns how many
     * they are. */
    int (*show_alone)(const e3d_cover *cover, e3d_shown *out, uint16_t *rest);
    /* Adds what shows of these records, which come sorted by their nearest depth. 0 if a depth buffer would take less. */
    int (*show_layers)(const e3d_cover *cover, const e3d_record_table *table, const uint16_t *numbers, int count, e3d_layers *layers,
                       e3d_shown *out);
    /* Add as many runs or samples from `first` on as the batch has room for, at least one to an empty batch; return how many.
     * Piece `piece` is surface 0, and the next ones follow. */
    int (*take_runs)(const e3d_shown *shown, int first, int count, int32_t piece, e3d_batch *batch);
    int (*take_shown)(const e3d_shown *shown, int first, int count, int32_t piece, e3d_batch *batch);
    int (*take_placed)(const e3d_shown *shown, int first, int count, int32_t piece, e3d_batch *batch); /* where it has a pattern */
    /* Finds the corners on the screen (R3, R8, R9) of the pieces that have no record. */
    void (*project)(e3d_surfaces *surfaces, const e3d_viewport *viewport);
    /* Finds the planes of R18 of pieces that weren't clipped, and what is wanted of their vertices. (tile_x, tile_y) is the tile's
     * first sample. */
    void (*surface)(e3d_surfaces *surfaces, int tile_x, int tile_y, int wanted);
    /* Fills the wanted attributes of a batch (R19-R26). */
    void (*interpolate)(e3d_batch *batch, const e3d_surfaces *surfaces, int wanted);
    /* color = base * texture; of an anisotropic one the batch's weights and the slopes of its surfaces are there. */
    void (*texture)(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_texture_view *texture, const float base[3]);
    /* color *= vertex colour, color *= instance colour */
    void (*tint)(e3d_batch *batch, const e3d_surfaces *surfaces, int by_vertex, int by_instance);
    /* Finds the planes of surfaces in the world. */
    void (*receivers)(const e3d_surfaces *surfaces, e3d_receivers *out);
    /* hidden_lights: which lights with exact shadows something hides from samples that they would light. */
    void (*hide)(e3d_batch *batch, const e3d_lighting *lighting, const e3d_caster_index *casters, const e3d_receivers *receivers);
    /* energy, and shine where shininess > 0 */
    void (*light)(e3d_batch *batch, const e3d_lighting *lighting, float shininess);
    /* color = ((color * energy + specular * shine) + emissive) * exposure; specular may be NULL */
    void (*combine)(e3d_batch *batch, const float specular[3], const float emissive[3], float exposure);
    /* Finds what maps need of surfaces that `surface` has worked on (R25, R47). */
    void (*map_surfaces)(const e3d_surfaces *surfaces, const e3d_maps *maps, e3d_map_surfaces *out);
    /* Finds coordinates, tangents and texels of a batch, whose weights are there, and its normals where there are tangents. */
    void (*maps)(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_maps *maps, const e3d_map_surfaces *map_surfaces,
                 e3d_map_batch *out);
    /* Keeps the normals of a batch, and maps them: those of the surface in place, the coat's to their own. */
    void (*map_normals)(e3d_batch *batch, const e3d_normal_map *surface, const e3d_normal_map *coat, e3d_map_batch *maps);
    /* Finds the numbers of a batch that a texture multiplies. */
    void (*varying)(const e3d_varying *varying, int count, float *out);
    /* color: what a physically based material shows, whose base colour it is. */
    void (*physical)(e3d_batch *batch, const e3d_surface_model *model, const e3d_lighting *lighting, e3d_map_batch *maps);
    /* Finds the light of an environment along directions, at a level each. */
    void (*environment)(const e3d_environment_light *light, const float *const direction[3], const float *level, int count,
                        float *const color[3]);
    /* Finds irradiance / pi at normals. */
    void (*irradiance)(const e3d_environment_light *light, const float *const normal[3], int count, float *const color[3]);
    /* Finds what surfaces reflect of light that is 1 all around. */
    void (*albedo)(e3d_dfg kind, const float *roughness, const float *cosine, int count, float *out);
    /* Adds what a block of texels gathers of the light of cells. */
    void (*lobe)(const e3d_cell_group *group, e3d_lobe_block *block);
    /* Finds nearness of depths: where all that lies on a plane is affine. */
    void (*nearness)(const float *depth, int count, int is_perspective, float *out);
    /* Ambient occlusion of the row of pixels in the middle: the shares of light that are hidden; their means over pixels to the left and
     * right, then over those above and below, which is visibility. */
    void (*occlusion)(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out);
    void (*occlusion_across)(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out);
    void (*occlusion_down)(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out);
    /* Finds the colours of an environment behind `count` pixels of a row, from (x, y) on; they are neither tone mapped nor clamped. */
    void (*backdrop)(const e3d_backdrop *backdrop, int x, int y, int count, float *const color[3]);
    /* Lays fog over colours that are at these positions. */
    void (*fog)(const e3d_fog_view *fog, const float *const position[3], int count, float *const color[3]);
    /* Maps planes of colours to [0, 1]. */
    void (*tone)(e3d_tone_mapping mapping, float *const color[3], int count);
    /* alpha (R80): base, times the texture's (NULL: base has it already), the vertices' and the instance's. */
    void (*alpha)(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_texture_view *texture, const e3d_varying *base, int by_vertex,
                  int by_instance);
    /* Lays the colours of a batch over the samples, each of which it has once (R84). */
    void (*lay)(const e3d_batch *batch, e3d_samples *samples);
    /* Likewise of what light passes through, as the maps say (R135). */
    void (*lay_through)(const e3d_batch *batch, const e3d_map_batch *maps, e3d_samples *samples);
    /* Sorts what each sample has, and lays it over the sample (R83, R84), but for samples that have much, or equal depths: these are
     * listed. Returns how many they are. */
    int (*blend)(const e3d_alpha_layers *layers, e3d_samples *samples, uint16_t *left);
    /* Clamps planes of colours to [0, 1], and encodes them as RGBA8 with alpha 255. */
    void (*encode)(const float *red, const float *green, const float *blue, int count, int srgb,
                   uint32_t *rgba);
    /* Encodes the colours of a batch likewise, each to its sample's place in rgba. */
    void (*put)(const e3d_batch *batch, int srgb, uint32_t *rgba);
    /* Keeps the clamped colours of a batch in its samples, which then count. */
    void (*keep)(const e3d_batch *batch, e3d_samples *samples);
    /* Averages and encodes `width` pixels of axis x axis samples each, the first in that row of samples. Where no sample counts, a
     * pixel has the background's colour, which is clamped already. */
    void (*average)(const e3d_samples *samples, int axis, int row, int width, const float background[3], int srgb, uint32_t *rgba);
    /* Does all of this at once, from interpolate on: the pixels of a batch, each at its sample's place in rgba. There are few
     * lights. */
    void (*paint)(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint, uint32_t *rgba);
    /* Copies rows with non-temporal stores; e3d_stream_end() must follow before other threads are told. */
    void (*stream)(const e3d_pixel_rows *rows);
    /* Rows of a bloom (R124). What of four rows of radiance is above 1, filtered, by channels; returns whether anything is. */
    int (*bloom_bright)(const float *const rows[4], int width, float *const planes[3]);
    /* Four rows, filtered. */
    void (*bloom_rows)(const float *const rows[4], int count, float *out);
    /* A row of half the width, rounded up. */
    void (*bloom_halve)(const float *row, int width, float *out);
    /* A row of twice as many, between two. */
    void (*bloom_mix)(const float *near, const float *far, int count, float *out);
    /* A row of that width from one of half of it, or that row added to another. */
    void (*bloom_spread)(const float *row, int width, int add, float *out);
    /* The glow, times a scale, over pixels, whose codes decode to these values. */
    void (*bloom_lay)(const float *const glow[3], float scale, const float decode[256], int srgb, int count, uint32_t *rgba);
    /* Draws rows of a shape of the user interface over the picture, which is at least E3D_UI_LEAST_WIDTH wide (of portable kernels: any). */
    void (*ui)(const e3d_canvas *picture, const e3d_ui_shape *shape, const e3d_ui_rows *rows);
} e3d_kernels;

/* NULL for E3D_BACKEND_SCALAR and for what this build or CPU lacks. */
const e3d_kernels *e3d_kernels_for(e3d_backend backend);

extern const e3d_kernels e3d_kernels_portable;
#define E3D_DECLARE_KERNELS(backend, name, ...) extern const e3d_kernels e3d_kernels_##name;
E3D_EACH_BUILT_BACKEND(E3D_DECLARE_KERNELS)

#endif
