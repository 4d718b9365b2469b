/* The kernels, a row each: E3D_KERNEL(result, name, (parameters)). Every list of kernels is made from these rows. */

/* ---- Geometry ---- */

/* Returns a bit for each of up to 32 clusters, set if all its triangles surely have an area of the sign `drop` on the screen,
 * or none. */
E3D_KERNEL(uint32_t, face_away, (const e3d_cluster *clusters, int count, const e3d_facing *facing, int drop, const float clip[16], const
           e3d_viewport *viewport))
/* These transform `count` vertices, whose positions are 3 (take_clip: 4) planes, `stride` apart. inside: all finite vertices
 * are surely in the frustum, in spite of rounding. */
E3D_KERNEL(void, transform, (const float *positions, int stride, int count, const float matrix[16], const e3d_viewport *viewport, int
           inside, e3d_vertices *out))
E3D_KERNEL(void, take_clip, (const float *positions, int stride, int count, const e3d_viewport *viewport, e3d_vertices *out))
/* Finds the triangles of a cluster that may show; returns how many. indices: three planes of E3D_CLUSTER_TRIANGLES. cull: the
 * sign of the area (screen, Y down) to drop, or 0. fragments: micro-triangles are to become fragments. */
E3D_KERNEL(int, setup, (const e3d_vertices *vertices, const uint8_t *indices, int triangles, int cull, int fragments, const e3d_viewport
           *viewport, e3d_survivors *out))
/* Makes records, and finds their tiles; returns how many. There is room for a whole cluster's records. */
E3D_KERNEL(int, record, (const e3d_record_request *request, e3d_record *out, e3d_tile_rect *spans))
/* Adds micro-triangles of a cluster, given as bits, for which there is room. Triangle t gets the ID first + (t << bits). */
E3D_KERNEL(void, add_small, (const e3d_vertices *vertices, const uint8_t *indices, uint64_t triangles, int32_t first, int bits,
           e3d_small_triangles *to))
/* Turns all micro-triangles into fragments in the bins of their tiles, and empties their list. There are tiles_x tiles in a
 * row. */
E3D_KERNEL(void, fragments, (e3d_small_triangles *triangles, const e3d_viewport *viewport, int tiles_x, e3d_fragment_bins *out))

/* ---- Raster ---- */

/* These draw a piece into a tile: the nearest shows; the last shows; pieces over each sample are counted; samples are marked. */
E3D_KERNEL(void, raster_depth, (const e3d_piece *piece, const e3d_tile_buffers *tile))
E3D_KERNEL(void, raster_overwrite, (const e3d_piece *piece, const e3d_tile_buffers *tile))
E3D_KERNEL(void, raster_count, (const e3d_piece *piece, const e3d_tile_buffers *tile))
E3D_KERNEL(void, raster_mark, (const e3d_piece *piece, const e3d_tile_buffers *tile))
/* These draw records, or a link of fragments, into the tile; the nearest shows (R16). */
E3D_KERNEL(void, raster_visible, (e3d_visible_tile *tile, const e3d_record_table *table, const uint32_t *ids, int count))
E3D_KERNEL(void, raster_fragments, (e3d_visible_tile *tile, const e3d_record_table *table, const e3d_fragment_link *link))
/* Writes the samples of all noted blocks: depths and IDs, or IDs alone, and then the blocks stay noted. */
E3D_KERNEL(void, raster_settle, (e3d_visible_tile *tile, const e3d_record_table *table, int depths))
/* Finds, for each block that isn't noted, its zmax and the farthest depth of each column. */
E3D_KERNEL(void, raster_measure, (e3d_visible_tile *tile, float columns[E3D_TILE_BLOCKS][E3D_BLOCK]))
/* Multisampling: a tile has a plane for each sample of its pixels; `noted`, `stale`, `zmin` and `zmax` of the first plane
 * hold for all. These draw records, write all noted blocks, and measure the others over all planes (see raster_measure). */
E3D_KERNEL(void, raster_msaa, (e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table, const
           uint32_t *ids, int count))
E3D_KERNEL(void, msaa_settle, (e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table))
E3D_KERNEL(void, msaa_measure, (e3d_visible_tile *planes, int count, float columns[E3D_TILE_BLOCKS][E3D_BLOCK]))
/* Finds the mixed pixels, whose samples don't all show the same, as bits row by row. `shared` gets the IDs of the others, and
 * E3D_NO_SLOT for mixed ones. Returns whether some of the others, among the first width x height, show nothing. */
E3D_KERNEL(int, msaa_split, (const e3d_visible_tile *planes, int count, int width, int height, uint64_t mixed[E3D_TILE],
           e3d_visible_tile *shared))
/* Lists the colours to shade for the list's pixels from `first` on, while there is room; returns the next pixel. */
E3D_KERNEL(int, list_mixed, (const e3d_visible_tile *planes, int samples, int first, e3d_run *runs, e3d_mixed_list *list))
/* Lists the samples that a piece, whose slot is its ID, covers in front of the visible surface: row by row from y0 on, while
 * there is room for a whole row. Returns the next row. */
E3D_KERNEL(int32_t, raster_alpha, (const e3d_piece *piece, const e3d_record_table *table, e3d_alpha_list *out))
/* Lists the pixels of rows y to last that the pieces of one record cover in front of the visible surface; there is one piece
 * for each plane whose bit is set in `live`. Returns the next row. */
E3D_KERNEL(int32_t, cover_msaa, (const e3d_piece *pieces, uint32_t live, int32_t y, int32_t last, const e3d_record_table *table,
           e3d_msaa_list *out))

/* ---- What shows in a tile ---- */

/* Finds the runs of the first width x height samples that show something, row by row; returns how many. `gaps`: whether some
 * samples show nothing. If it must look at samples of noted blocks, it writes their IDs; the blocks stay noted. */
E3D_KERNEL(int, find_runs, (e3d_visible_tile *tile, int width, int height, e3d_run *out, int *gaps))
/* Lists the samples that show records, a primitive for each record, in this order. */
E3D_KERNEL(void, show_records, (const e3d_visible_tile *tile, const e3d_record_table *table, const uint32_t *ids, int count, e3d_shown
           *out))
/* The same for fragments: a primitive for the fragments of one triangle, which follow each other. */
E3D_KERNEL(void, show_fragments, (const e3d_visible_tile *tile, const e3d_fragment_link *link, e3d_shown *out))
/* Adds the samples that records cover, row by row, to the tile's cover, and their runs to the list, a primitive for each
 * record. Returns 0 if a record is too large or may reach beyond the far plane, or if there are too many. */
E3D_KERNEL(int, cover_records, (e3d_cover *cover, const e3d_record_table *table, const uint32_t *ids, int count, e3d_shown *out))
/* Lists the runs of the records that share no sample with others. Lists the numbers of the other records, and returns how
 * many they are. */
E3D_KERNEL(int, show_alone, (const e3d_cover *cover, e3d_shown *out, uint16_t *rest))
/* Lists the runs that show of these records, which come sorted by their nearest depth. Returns 0 if a depth buffer would be
 * faster. */
E3D_KERNEL(int, show_layers, (const e3d_cover *cover, const e3d_record_table *table, const uint16_t *numbers, int count, e3d_layers
           *layers, e3d_shown *out))
/* These add runs or samples from `first` on while the batch has room, at least one to an empty batch; they return how many.
 * `primitive` is the number of the one that is surface 0, and the next ones follow. take_placed is for lists with a pattern. */
E3D_KERNEL(int, take_runs, (const e3d_shown *shown, int first, int count, int32_t primitive, e3d_batch *batch))
E3D_KERNEL(int, take_shown, (const e3d_shown *shown, int first, int count, int32_t primitive, e3d_batch *batch))
E3D_KERNEL(int, take_placed, (const e3d_shown *shown, int first, int count, int32_t primitive, e3d_batch *batch))

/* ---- Surfaces and textures ---- */

/* Finds the corners on the screen (R3, R8, R9) of the primitives that have no record. */
E3D_KERNEL(void, project, (e3d_surfaces *surfaces, const e3d_viewport *viewport))
/* Finds the planes of R18 of primitives that weren't clipped, and the wanted attributes of their vertices. (tile_x, tile_y)
 * is the tile's first sample. */
E3D_KERNEL(void, surface, (e3d_surfaces *surfaces, int tile_x, int tile_y, int wanted))
/* Fills the wanted attributes of a batch (R19-R26). */
E3D_KERNEL(void, interpolate, (e3d_batch *batch, const e3d_surfaces *surfaces, int wanted))
/* color = base * texture. An anisotropic texture needs the batch's weights and the slopes of its surfaces. */
E3D_KERNEL(void, texture, (e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_texture_view *texture, const float base[3]))
/* color *= vertex colour, color *= instance colour */
E3D_KERNEL(void, tint, (e3d_batch *batch, const e3d_surfaces *surfaces, int by_vertex, int by_instance))
/* Finds the attributes of surfaces that textures need, after `surface` (R25, R47). */
E3D_KERNEL(void, texture_surfaces, (const e3d_surfaces *surfaces, const e3d_read_textures *textures, e3d_texture_surfaces *out))
/* Finds coordinates, tangents and texels of a batch whose weights are known, and its normals if there are tangents. */
E3D_KERNEL(void, read_textures, (e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_read_textures *textures,
           const e3d_texture_surfaces *texture_surfaces,
           e3d_texture_batch *out))
/* Keeps the normals of a batch, and maps them: the surface's in place, the coat's in an array of their own. */
E3D_KERNEL(void, map_normals, (e3d_batch *batch, const e3d_normal_texture *surface, const e3d_normal_texture *coat,
           e3d_texture_batch *textures))
/* Finds a number that varies over a batch: texels times a factor, or the factor. */
E3D_KERNEL(void, varying, (const e3d_varying *varying, int count, float *out))
/* alpha (R80): base times the texture's (NULL: base includes it), the vertices' and the instance's. */
E3D_KERNEL(void, alpha, (e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_texture_view *texture, const e3d_varying *base, int
           by_vertex, int by_instance))

/* ---- Light ---- */

/* Finds the planes of surfaces in the world, on which exact shadows fall. */
E3D_KERNEL(void, receivers, (const e3d_surfaces *surfaces, e3d_receivers *out))
/* shadowed_lights: for each sample, the lights with exact shadows that something hides and that would add light. */
E3D_KERNEL(void, exact_shadows, (e3d_batch *batch, const e3d_lighting *lighting, const e3d_caster_index *casters,
           const e3d_receivers *receivers))
/* soft_reached: for each sample and each soft light with exact shadows, the share of the light that reaches it. */
E3D_KERNEL(void, soft_exact_shadows, (e3d_batch *batch, const e3d_lighting *lighting, const e3d_caster_index *casters,
           const e3d_receivers *receivers))
/* Begin energy and shine, or the sums of a physically based material, with what area lights add. */
E3D_KERNEL(void, area_light, (e3d_batch *batch, const e3d_lighting *lighting, float shininess))
E3D_KERNEL(void, area_physical, (e3d_batch *batch, const e3d_brdf *brdf, const e3d_lighting *lighting, e3d_texture_batch *textures))
/* Finds energy, and shine if shininess > 0. */
E3D_KERNEL(void, light, (e3d_batch *batch, const e3d_lighting *lighting, float shininess))
/* color = ((color * energy + specular * shine) + emissive) * exposure; specular may be NULL */
E3D_KERNEL(void, combine, (e3d_batch *batch, const float specular[3], const float emissive[3], float exposure))
/* Finds the colours of a physically based material; on entry, color is its base colour. */
E3D_KERNEL(void, physical, (e3d_batch *batch, const e3d_brdf *brdf, const e3d_lighting *lighting, e3d_texture_batch *textures))
/* Finds how much of a mirror's light a physically based material reflects; color is its base colour. */
E3D_KERNEL(void, mirror_shares, (const e3d_batch *batch, const e3d_texture_batch *textures, const e3d_brdf *brdf, const e3d_lighting
           *lighting, e3d_mirror_batch *out))
/* Lays the light of mirrors over colours. */
E3D_KERNEL(void, mirror_light, (e3d_batch *batch, int is_physical, const e3d_mirror_batch *mirrors))
/* Finds an environment's radiance along directions, at a level each. */
E3D_KERNEL(void, environment, (const e3d_environment_light *light, const float *const direction[3], const float *level, int count, float
           *const color[3]))
/* Finds irradiance / pi at normals. */
E3D_KERNEL(void, irradiance, (const e3d_environment_light *light, const float *const normal[3], int count, float *const color[3]))
/* Finds the share of light that surfaces reflect if it is 1 all around. */
E3D_KERNEL(void, albedo, (e3d_dfg kind, const float *roughness, const float *cosine, int count, float *out))
/* Finds how far surfaces shift what is behind them, and how much they blur it (R164, R165). scale: the world units of a thickness
 * of 1. */
E3D_KERNEL(void, bend, (const e3d_bending *bending, const float *scale, int count, e3d_bend_batch *out))
/* Looks up what is behind glass: finds the levels of a batch by its blurs, and the light there (R163). */
E3D_KERNEL(void, behind, (const e3d_behind_view *view, e3d_behind_batch *batch))
/* Adds the light that a block of texels gathers from cells. */
E3D_KERNEL(void, lobe, (const e3d_cell_group *group, e3d_lobe_block *block))

/* ---- Colours ---- */

/* Finds an environment's colours behind `count` pixels of a row, from (x, y) on, neither tone mapped nor clamped. */
E3D_KERNEL(void, backdrop, (const e3d_backdrop *backdrop, int x, int y, int count, float *const color[3]))
/* Blends fog over colours at these positions. */
E3D_KERNEL(void, fog, (const e3d_fog_view *fog, const float *const position[3], int count, float *const color[3]))
/* Filters the light of pinhole pictures, four numbers a pixel, for at most E3D_LENS_BATCH pixels of a lens that look into the
 * same one (R204). mean: four numbers a pixel. */
E3D_KERNEL(void, lens, (const uint16_t *light, const e3d_lens_face *face, const e3d_lens_pixel *pixels, int count, float *mean))
/* Tone maps planes of colours to [0, 1]. */
E3D_KERNEL(void, tone, (e3d_tone_mapping mapping, float *const color[3], int count))
/* Blends the colours of a batch over the samples; each sample occurs once (R84). */
E3D_KERNEL(void, lay, (const e3d_batch *batch, e3d_samples *samples))
/* The same for materials that light passes through, with the shares in `textures` (R135). */
E3D_KERNEL(void, lay_through, (const e3d_batch *batch, const e3d_texture_batch *textures, e3d_samples *samples))
/* Sorts the layers of each sample, and blends them over it (R83, R84). Samples with many layers, or with equal depths, are
 * listed in `left` instead; returns how many they are. */
E3D_KERNEL(int, blend, (const e3d_alpha_layers *layers, e3d_samples *samples, uint16_t *left))
/* Clamps planes of colours to [0, 1], and encodes them as RGBA8 with alpha 255. */
E3D_KERNEL(void, encode, (const float *red, const float *green, const float *blue, int count, int srgb, uint32_t *rgba))
/* Encodes the colours of a batch likewise, and writes each to its sample's place in rgba. */
E3D_KERNEL(void, put, (const e3d_batch *batch, int srgb, uint32_t *rgba))
/* Stores the clamped colours of a batch in its samples, which then count. */
E3D_KERNEL(void, keep, (const e3d_batch *batch, e3d_samples *samples))
/* Averages and encodes `width` pixels of axis x axis samples each, the first of which are in that row of samples. A pixel of
 * which no sample counts gets the background's colour, which is clamped already. */
E3D_KERNEL(void, average, (const e3d_samples *samples, int axis, int row, int width, const float background[3], int srgb, uint32_t *rgba))
/* Does what interpolate, texture, tint, light, combine, fog and tone do, as far as it is asked for, at once. It is for few
 * lights. The colours go to paint->samples, or encoded to their samples' places in rgba; if both are NULL, they stay in the
 * batch. */
E3D_KERNEL(void, paint, (e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint, uint32_t *rgba))
/* Copies rows with non-temporal stores. e3d_stream_end() must be called before other threads may read them. */
E3D_KERNEL(void, stream, (const e3d_pixel_rows *rows))

/* ---- Whole pictures ---- */

/* Ambient occlusion, of a row of sites: their depths and nearness, from a row of pixels; with the rows above and below, their
 * faces and the shares of light that are hidden; the means of shares over sites to the left and right; those over the nine rows
 * around the middle one; the means of these a cell to the left and right, and those a cell above and below; and the visibility
 * of a row of pixels, at the first of two rows of sites or between them. */
E3D_KERNEL(void, occlusion_sites, (const float *depth, int width, int is_perspective, const e3d_occlusion_sites *out))
E3D_KERNEL(void, occlusion, (const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, int row))
E3D_KERNEL(void, occlusion_across, (const e3d_occlusion_plan *plan, const e3d_occlusion_sites *row, float *out))
E3D_KERNEL(void, occlusion_down, (const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, float *out))
E3D_KERNEL(void, occlusion_wide_across, (const e3d_occlusion_plan *plan, const e3d_occlusion_sites *row, float *out))
E3D_KERNEL(void, occlusion_wide_down, (const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, float *out))
E3D_KERNEL(void, occlusion_spread, (const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, const float *depth, int is_below, float *out))
/* Rows of a bloom (R124). Filters what four rows of radiance have above 1, channel by channel; returns whether there is any. */
E3D_KERNEL(int, bloom_bright, (const float *const rows[4], int width, float *const planes[3]))
/* Filters four rows. */
E3D_KERNEL(void, bloom_rows, (const float *const rows[4], int count, float *out))
/* Halves the width of a row, rounded up. */
E3D_KERNEL(void, bloom_halve, (const float *row, int width, float *out))
/* Finds a row between two others. */
E3D_KERNEL(void, bloom_mix, (const float *near, const float *far, int count, float *out))
/* Doubles the width of a row, to `width`; `add`: adds it to another. */
E3D_KERNEL(void, bloom_spread, (const float *row, int width, int add, float *out))
/* Adds the glow, times a scale, to pixels whose codes decode to these values. */
E3D_KERNEL(void, bloom_lay, (const float *const glow[3], float scale, const float decode[256], int srgb, int count, uint32_t *rgba))
/* Draws rows of a shape of the user interface over the picture, whose width is at least E3D_UI_LEAST_WIDTH (portable kernels:
 * any). */
E3D_KERNEL(void, ui, (const e3d_canvas *picture, const e3d_ui_shape *shape, const e3d_ui_rows *rows))
