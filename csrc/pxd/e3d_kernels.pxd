# The Cython mirror of csrc/kernels/kernels.h and types/, and nothing else: what the tests of the kernels need.

from libc.stdint cimport int32_t, uint8_t, uint16_t, uint32_t, uint64_t

from e3d cimport (
    e3d_backdrop, e3d_backend, e3d_dfg, e3d_environment_light, e3d_filter, e3d_fog_kind, e3d_light, e3d_shadow_map, e3d_tone_mapping, e3d_wrap
)
from e3d_clusters cimport e3d_cluster


ctypedef float three_floats[3]
ctypedef float four_floats[4]

cdef extern from "kernels/kernels.h" nogil:
    enum:
        E3D_MAX_LEVELS
        E3D_PAD
        E3D_TILE
        E3D_TILE_SAMPLES
        E3D_TILE_BLOCKS
        E3D_BLOCK
        E3D_CLUSTER_TRIANGLES
        E3D_CLUSTER_VERTICES
        E3D_BATCH
        E3D_BATCH_SURFACES
        E3D_MOST_COVERING
        E3D_COVER_ROWS
        E3D_SMALLS
        E3D_MOST_FRAGMENTS
        E3D_BLOCK_FRAGMENTS
        E3D_FRAGMENT_ID

    ctypedef struct e3d_level:
        const void *texels
        int32_t width
        int32_t height

    ctypedef struct e3d_texture_view:
        e3d_level levels[16]
        int32_t level_count
        int32_t channel_bits
        int32_t is_opaque
        e3d_filter filter
        e3d_wrap wrap[2]
        int32_t anisotropy
        float level_scale

    ctypedef struct e3d_viewport:
        int32_t width
        int32_t height
        float scale_x
        float scale_y
        float guard_x
        float guard_y

    ctypedef struct e3d_vertices:
        pass

    ctypedef struct e3d_survivors:
        pass

    ctypedef struct e3d_record:
        pass

    ctypedef struct e3d_record_request:
        const e3d_vertices *vertices
        const uint8_t *indices
        const uint8_t *triangles
        int count
        int tiny
        int cull
        int mirrored
        uint32_t order
        const int32_t *faces
        const e3d_viewport *viewport

    ctypedef struct e3d_tile_span:
        pass

    ctypedef struct e3d_bin:
        pass

    ctypedef struct e3d_facing:
        pass

    ctypedef struct e3d_small_triangles:
        int32_t count

    ctypedef struct e3d_fragment_block:
        pass

    ctypedef struct e3d_fragment_bins:
        e3d_fragment_block *blocks
        e3d_bin *bins
        uint32_t count
        int32_t fragments, triangles

    size_t e3d_fragment_blocks_most(size_t tiles)

    ctypedef struct e3d_drawn_cluster:
        pass

    ctypedef struct e3d_piece:
        pass

    ctypedef struct e3d_record_table:
        const e3d_record *const *records
        const e3d_drawn_cluster *const *drawn
        int32_t bits

    ctypedef struct e3d_visible_tile:
        pass

    ctypedef struct e3d_tile_buffers:
        float *z
        int32_t *slot
        const uint32_t *orders

    ctypedef struct e3d_run:
        pass

    ctypedef struct e3d_layers:
        pass
    ctypedef struct e3d_cover:
        pass
    ctypedef struct e3d_shown:
        pass

    ctypedef struct e3d_surfaces:
        pass

    ctypedef struct e3d_batch:
        pass

    ctypedef struct e3d_cell_group:
        pass

    ctypedef struct e3d_lobe_block:
        pass

    ctypedef struct e3d_lighting:
        const e3d_light *lights
        int light_count
        const float *reach[5]
        float ambient[3]
        float clamp[2]
        float eye[4]
        float exposure
        const void *environment
        const e3d_shadow_map *shadows
        const float *ambient_terms
        int has_visibility

    ctypedef struct e3d_pixel_rows:
        char *to
        const char *source "from"
        size_t bytes, pitch, step
        int count

    ctypedef struct e3d_samples:
        pass

    ctypedef struct e3d_alpha_list:
        const float *limit
        const int32_t *kept
        e3d_shown *shown
        float *z
        uint64_t once[64]
        uint64_t met

    ctypedef struct e3d_alpha_layers:
        const uint32_t *first
        const int32_t *depth
        const uint32_t *which
        const four_floats *color
        const four_floats *through
        const four_floats *light
        three_floats *lit
        int axis

    ctypedef struct e3d_fog_view:
        e3d_fog_kind kind
        float row[4]
        float color[3]
        float near
        float scale
        float density

    ctypedef struct e3d_paint:
        int wanted
        const e3d_texture_view *texture
        const float *base
        int by_vertex
        int by_instance
        const e3d_lighting *lighting
        float shininess
        const float *specular
        const float *emissive
        int srgb
        e3d_samples *samples
        const e3d_fog_view *fog
        e3d_tone_mapping tone

    ctypedef struct e3d_map_batch:
        pass

    ctypedef struct e3d_varying:
        const float *lanes
        float factor

    ctypedef struct e3d_stretch_map:
        float strength
        float turn[2]

    ctypedef struct e3d_surface_model:
        e3d_varying metallic
        e3d_varying roughness
        e3d_varying occlusion
        float occlusion_strength
        e3d_varying reflectance[3]
        e3d_varying specular
        e3d_varying emissive[3]
        e3d_varying coat
        e3d_varying coat_roughness
        e3d_varying sheen[3]
        e3d_varying sheen_roughness
        int has_coat
        int has_sheen
        int is_grey
        int coat_is_mapped
        e3d_varying transmission
        e3d_varying thickness
        float absorption[3]
        int transmits
        int absorbs
        int anisotropic
        int iridescent
        e3d_stretch_map stretch
        e3d_varying iridescence
        e3d_varying film
        float film_least
        float film_ior
        int is_rare

    ctypedef struct e3d_kernels:
        uint32_t (*face_away)(const e3d_cluster *clusters, int count, const e3d_facing *facing, int drop, const float *clip,
                              const e3d_viewport *viewport)
        void (*transform)(const float *positions, int stride, int count, const float *matrix,
                          const e3d_viewport *viewport, int inside, e3d_vertices *out)
        void (*take_clip)(const float *positions, int stride, int count,
                          const e3d_viewport *viewport, e3d_vertices *out)
        int (*setup)(const e3d_vertices *vertices, const uint8_t *indices, int triangles, int cull,
                     int fragments, const e3d_viewport *viewport, e3d_survivors *out)
        int (*record)(const e3d_record_request *request, e3d_record *out, e3d_tile_span *spans)
        void (*add_small)(const e3d_vertices *vertices, const uint8_t *indices, uint64_t triangles, int32_t first,
                          int bits, e3d_small_triangles *to)
        void (*fragments)(e3d_small_triangles *triangles, const e3d_viewport *viewport, int tiles_x,
                          e3d_fragment_bins *out)
        void (*raster_depth)(const e3d_piece *piece, const e3d_tile_buffers *tile)
        void (*raster_overwrite)(const e3d_piece *piece, const e3d_tile_buffers *tile)
        void (*raster_count)(const e3d_piece *piece, const e3d_tile_buffers *tile)
        void (*raster_mark)(const e3d_piece *piece, const e3d_tile_buffers *tile)
        void (*raster_visible)(e3d_visible_tile *tile, const e3d_record_table *table,
                               const uint32_t *ids, int count)
        void (*raster_fragments)(e3d_visible_tile *tile, const e3d_record_table *table,
                                 const e3d_fragment_block *block)
        void (*raster_settle)(e3d_visible_tile *tile, const e3d_record_table *table, int depths)
        void (*raster_measure)(e3d_visible_tile *tile, float (*columns)[E3D_BLOCK])
        int (*find_runs)(e3d_visible_tile *tile, int width, int height, e3d_run *out, int *gaps)
        void (*show_records)(const e3d_visible_tile *tile, const e3d_record_table *table,
                             const uint32_t *ids, int count, e3d_shown *out)
        void (*show_fragments)(const e3d_visible_tile *tile, const e3d_fragment_block *block,
                               e3d_shown *out)
        int (*cover_records)(e3d_cover *cover, const e3d_record_table *table, const uint32_t *ids,
                             int count, e3d_shown *out)
        int (*show_alone)(const e3d_cover *cover, e3d_shown *out, uint16_t *rest)
        int (*show_layers)(const e3d_cover *cover, const e3d_record_table *table, const uint16_t *numbers,
                           int count, e3d_layers *layers, e3d_shown *out)
        int (*take_runs)(const e3d_shown *shown, int first, int count, int32_t piece,
                         e3d_batch *batch)
        int (*take_shown)(const e3d_shown *shown, int first, int count, int32_t piece,
                          e3d_batch *batch)
        void (*project)(e3d_surfaces *surfaces, const e3d_viewport *viewport)
        void (*surface)(e3d_surfaces *surfaces, int tile_x, int tile_y, int wanted)
        void (*interpolate)(e3d_batch *batch, const e3d_surfaces *surfaces, int wanted)
        void (*texture)(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_texture_view *texture, const float *base)
        void (*tint)(e3d_batch *batch, const e3d_surfaces *surfaces, int by_vertex, int by_instance)
        void (*light)(e3d_batch *batch, const e3d_lighting *lighting, float shininess)
        void (*combine)(e3d_batch *batch, const float *specular, const float *emissive,
                        float exposure)
        void (*physical)(e3d_batch *batch, const e3d_surface_model *model, const e3d_lighting *lighting,
                         e3d_map_batch *maps)
        void (*environment)(const e3d_environment_light *light, const float *const *direction, const float *level,
                            int count, float *const *color)
        void (*irradiance)(const e3d_environment_light *light, const float *const *normal, int count,
                           float *const *color)
        void (*albedo)(e3d_dfg kind, const float *roughness, const float *cosine, int count, float *out)
        void (*lobe)(const e3d_cell_group *group, e3d_lobe_block *block)
        void (*backdrop)(const e3d_backdrop *backdrop, int x, int y, int count, float *const *color)
        void (*fog)(const e3d_fog_view *fog, const float *const *position, int count, float *const *color)
        void (*tone)(e3d_tone_mapping mapping, float *const *color, int count)
        void (*encode)(const float *red, const float *green, const float *blue, int count, int srgb,
                       uint32_t *rgba)
        void (*put)(const e3d_batch *batch, int srgb, uint32_t *rgba)
        void (*keep)(const e3d_batch *batch, e3d_samples *samples)
        int32_t (*raster_alpha)(const e3d_piece *piece, const e3d_record_table *table, e3d_alpha_list *out)
        void (*alpha)(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_texture_view *texture, const e3d_varying *base,
                      int by_vertex, int by_instance)
        void (*lay)(const e3d_batch *batch, e3d_samples *samples)
        void (*lay_through)(const e3d_batch *batch, const e3d_map_batch *maps, e3d_samples *samples)
        int (*blend)(const e3d_alpha_layers *layers, e3d_samples *samples, uint16_t *left)
        void (*average)(const e3d_samples *samples, int axis, int row, int width,
                        const float *background, int srgb, uint32_t *rgba)
        void (*paint)(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint,
                      uint32_t *rgba)
        void (*stream)(const e3d_pixel_rows *rows)

    const e3d_kernels *e3d_kernels_for(e3d_backend backend)
