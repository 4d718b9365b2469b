# The Cython mirror of csrc/include/e3d.h, and nothing else. The header explains every name.

from libc.stdint cimport int32_t, int64_t, uint8_t, uint32_t, uint64_t


cdef extern from "e3d.h" nogil:
    ctypedef enum e3d_status:
        E3D_OK
        E3D_OUT_OF_MEMORY
        E3D_INVALID_ARGUMENT
        E3D_UNSUPPORTED_BACKEND
        E3D_TOO_MANY_PRIMITIVES
        E3D_CANCELLED

    ctypedef enum e3d_option:
        E3D_OPTION_ALPHA_MODE
        E3D_OPTION_BACKEND
        E3D_OPTION_CULL
        E3D_OPTION_CULLING
        E3D_OPTION_FALLOFF
        E3D_OPTION_FILTER
        E3D_OPTION_HIDDEN
        E3D_OPTION_LIGHT_KIND
        E3D_OPTION_LINE_SHAPE
        E3D_OPTION_MAP_LAYOUT
        E3D_OPTION_MODE
        E3D_OPTION_NORMALS
        E3D_OPTION_POINT_SHAPE
        E3D_OPTION_SHADING
        E3D_OPTION_TEXTURE_SLOT
        E3D_OPTION_TONE_MAPPING
        E3D_OPTION_WIREFRAME
        E3D_OPTION_WRAP

    const char *e3d_option_name(e3d_option option, int32_t value)

    ctypedef struct e3d_array_format:
        const char *name
        int32_t channels
        int32_t bytes
        int32_t is_float

    ctypedef enum e3d_backend:
        pass

    const char *e3d_status_text(e3d_status status)
    const char *e3d_backend_name(e3d_backend backend)
    const char *e3d_plan_step(int32_t bit)
    int e3d_backend_available(e3d_backend backend)
    e3d_backend e3d_backend_best()
    int e3d_thread_count()

    ctypedef struct e3d_mesh:
        pass

    ctypedef enum e3d_vertex_attribute:
        E3D_VERTEX_ATTRIBUTES

    const e3d_array_format E3D_VERTEX_FORMATS[]

    ctypedef struct e3d_mesh_desc:
        const float *positions
        int32_t components
        int32_t vertices
        const int32_t *faces
        int32_t faces_count
        const float *face_normals
        const int32_t *material_ids
        const int32_t *lines
        int32_t lines_count
        const int32_t *points
        int32_t points_count
        const int32_t *edges
        int32_t edges_count
        const int32_t *movers

    e3d_status e3d_mesh_create(const e3d_mesh_desc *desc, int32_t threads, e3d_mesh **out)
    const e3d_mesh_desc *e3d_mesh_view(const e3d_mesh *mesh)
    void e3d_mesh_destroy(e3d_mesh *mesh)
    void e3d_mesh_desc_set(e3d_mesh_desc *desc, e3d_vertex_attribute attribute, const void *array)
    void e3d_mesh_set_attribute(e3d_mesh *mesh, e3d_vertex_attribute attribute, const void *array)
    void e3d_mesh_set_face_normals(e3d_mesh *mesh, const float *face_normals)
    e3d_status e3d_mesh_set_edges(e3d_mesh *mesh, const int32_t *edges, int32_t count)
    int e3d_bound_points(const float *points, int64_t count, float lo[3], float hi[3])

    ctypedef struct e3d_texture:
        pass

    ctypedef enum e3d_filter:
        pass

    ctypedef enum e3d_wrap:
        pass

    ctypedef struct e3d_sampling:
        e3d_filter filter
        e3d_wrap wrap[2]
        int32_t anisotropy
        float lod_bias

    e3d_status e3d_texture_create(const uint8_t *pixels, int32_t width, int32_t height,
                                  int decode_srgb, const e3d_sampling *sampling, e3d_texture **out)
    void e3d_texture_destroy(e3d_texture *texture)

    ctypedef struct e3d_texture_use:
        const e3d_texture *texture
        int32_t uv_set
        int32_t is_moved
        float matrix[6]

    ctypedef enum e3d_alpha_mode:
        E3D_ALPHA_OPAQUE
        E3D_ALPHA_MASK
        E3D_ALPHA_BLEND

    ctypedef struct e3d_physical:
        float metallic
        float roughness
        float occlusion_strength
        float reflectance[3]
        float specular_intensity
        float clearcoat
        float clearcoat_roughness
        float clearcoat_normal_scale
        float sheen_color[3]
        float sheen_roughness
        float transmission
        float thickness
        float absorption[3]
        float anisotropy
        float anisotropy_turn[2]
        float iridescence, iridescence_ior
        float iridescence_thickness[2]
    ctypedef struct e3d_environment:
        pass

    enum:
        E3D_ENVIRONMENT_LEVELS

    ctypedef struct e3d_environment_level:
        const float *texels
        int32_t size

    ctypedef struct e3d_environment_view:
        e3d_environment_level levels[]

    e3d_status e3d_environment_create(const float *pixels, int32_t width, int32_t height,
                                      int threads, e3d_environment **out)
    void e3d_environment_destroy(e3d_environment *environment)
    const e3d_environment_view *e3d_environment_get_view(const e3d_environment *environment)

    ctypedef struct e3d_environment_light:
        const e3d_environment *environment
        float cosine
        float sine
        float intensity

    ctypedef struct e3d_backdrop:
        e3d_environment_light light
        float level
        float ray[3]
        float across[3]
        float down[3]

    ctypedef enum e3d_dfg:
        E3D_DFG_TABLES

    enum:
        E3D_DFG_SIZE

    const float E3D_DFG_TABLE[E3D_DFG_TABLES][E3D_DFG_SIZE * E3D_DFG_SIZE]

    ctypedef struct e3d_material:
        float color[3]
        float alpha
        float specular[3]
        float shininess
        float emissive[3]
        float normal_scale
        e3d_texture_use texture
        e3d_texture_use emissive_texture
        int32_t id
        int32_t two_sided
        int32_t flat
        int32_t is_unlit
        e3d_alpha_mode alpha_mode
        float alpha_cutoff
        int32_t is_physical
        e3d_physical physical

    ctypedef enum e3d_texture_slot:
        pass

    void e3d_material_set_texture(e3d_material *material, e3d_texture_slot slot,
                                  const e3d_texture_use *use)

    ctypedef enum e3d_emission:
        E3D_EMITS_EVENLY

    ctypedef enum e3d_map_layout:
        pass

    ctypedef enum e3d_light_kind:
        pass

    ctypedef struct e3d_light_traits:
        int32_t has_position
        e3d_emission emission
        e3d_map_layout maps

    e3d_light_traits e3d_light_traits_of(e3d_light_kind kind)

    ctypedef enum e3d_falloff:
        pass

    ctypedef enum e3d_shadow_kind:
        E3D_SHADOW_NONE
        E3D_SHADOW_MAP
        E3D_SHADOW_EXACT

    enum:
        E3D_MAX_EXACT_LIGHTS

    ctypedef struct e3d_shadow_map:
        float scale
        float x
        float y
        float texel

    ctypedef struct e3d_light_maps:
        int32_t first
        int32_t count
        int32_t size
        int32_t taps
        float bias
        float normal_bias
        int32_t step
        float margin
        float axes[3][3]
        float depth[2]
        const float *depths
        const uint32_t *ranges

    ctypedef struct e3d_light_shadow:
        e3d_shadow_kind kind
        int32_t exact
        e3d_light_maps maps

    int32_t e3d_shadow_ranges_side(int32_t size)
    e3d_status e3d_find_shadow_ranges(const float *depths, int32_t size, int32_t taps, int32_t step, uint32_t *ranges)

    ctypedef struct e3d_light:
        e3d_light_kind kind
        e3d_falloff falloff
        float color[3]
        float to_light[3]
        float position[3]
        float range
        float cone[2]
        float lux[3]
        e3d_light_shadow shadow

    enum: E3D_AMBIENT_TERMS

    ctypedef struct e3d_ambient_light:
        int32_t is_given
        float terms[9][3]

    ctypedef enum e3d_pose_kind:
        E3D_POSE_NONE
        E3D_POSE_MATRIX
        E3D_POSE_OFFSET_SCALE
        E3D_POSE_NODES

    ctypedef struct e3d_draw:
        const e3d_mesh *mesh
        double world_from_node[16]
        e3d_pose_kind pose_kind
        const float *poses
        int32_t instances
        const uint8_t *instance_colors_u8
        const float *instance_colors_f32
        int32_t node_id
        int32_t material_base
        int32_t first_instance
        const int32_t *instance_ids
        const double *node_worlds
        const int32_t *node_ids
        int32_t unshadowed
        uint32_t spared_lights

    ctypedef struct e3d_casters:
        const e3d_draw *draws
        int32_t draw_count
        const e3d_material *materials
        int32_t material_count
        int64_t version

    ctypedef enum e3d_mode:
        E3D_MODE_UNLIT

    ctypedef enum e3d_cull:
        E3D_CULL_NONE

    ctypedef enum e3d_wireframe:
        pass

    ctypedef enum e3d_hidden:
        pass

    ctypedef enum e3d_shading:
        pass

    ctypedef enum e3d_normals:
        pass

    ctypedef enum e3d_culling:
        pass

    ctypedef enum e3d_tone_mapping:
        pass

    ctypedef enum e3d_fog_kind:
        E3D_FOG_NONE
        E3D_FOG_LINEAR
        E3D_FOG_EXPONENTIAL

    ctypedef struct e3d_fog:
        e3d_fog_kind kind
        float color[3]
        float lit_color[3]
        float near
        float far
        float density

    ctypedef struct e3d_gradient:
        int32_t shows
        float top[3]
        float bottom[3]
    ctypedef enum e3d_line_shape:
        pass

    ctypedef enum e3d_point_shape:
        pass

    enum:
        E3D_MAX_WINDOWS

    ctypedef struct e3d_window:
        int32_t x0
        int32_t y0
        int32_t x1
        int32_t y1

    ctypedef struct e3d_frame:
        int32_t width
        int32_t height
        int32_t samples_axis
        double clip_from_world[16]
        double view_from_world[16]
        float eye[4]
        int64_t view
        e3d_mode mode
        e3d_cull cull
        const e3d_window *windows
        int32_t window_count
        e3d_wireframe wireframe
        e3d_hidden hidden
        e3d_shading shading
        e3d_normals normals
        int32_t remove_hidden_lines
        int32_t transparent_outputs
        int32_t msaa_samples
        int32_t alpha_to_coverage
        float line_width
        float point_size
        float line_color[3]
        float background[4]
        e3d_backdrop backdrop
        e3d_environment_light environment
        int32_t encode_srgb
        int32_t decode_srgb
        float depth_near
        float depth_far
        float ambient[3]
        float light_clamp[2]
        float exposure
        const e3d_material *materials
        int32_t material_count
        const e3d_light *lights
        int32_t light_count
        const e3d_draw *draws
        int32_t draw_count
        const int32_t *order
        int32_t order_count
        e3d_culling culling
        const double *frozen_clip_from_world
        const e3d_shadow_map *shadow_maps
        int32_t shadow_map_count
        int32_t faces_only
        e3d_tone_mapping tone_mapping
        e3d_fog fog
        e3d_gradient gradient
        const e3d_casters *casters
        e3d_line_shape line_shape
        e3d_point_shape point_shape
        e3d_ambient_light ambient_light
        const float *ambient_visibility

    ctypedef enum e3d_output_kind:
        E3D_OUTPUT_NDC_DEPTH
        E3D_OUTPUTS

    ctypedef struct e3d_targets:
        pass

    void e3d_targets_set(e3d_targets *targets, e3d_output_kind output, void *pixels)

    const e3d_array_format E3D_OUTPUT_FORMATS[]

    ctypedef struct e3d_stats:
        int64_t draws
        int64_t instances
        int64_t clusters
        int64_t triangles
        int64_t clusters_in_frustum
        int64_t clusters_unoccluded
        int64_t clusters_drawn
        int64_t triangles_in_frustum
        int64_t triangles_unoccluded
        int64_t triangles_drawn
        int64_t nodes_unoccluded
        int64_t nodes_drawn
        int64_t clusters_culled
        int64_t clusters_occluded
        int64_t triangles_occluded
        int64_t triangles_culled
        int64_t triangles_clipped
        int64_t triangles_setup
        int64_t bin_entries
        int64_t pixels_shaded
        double ms_geometry
        double ms_raster
        double ms_shade
        double ms_resolve
        double ms_total
        int32_t threads
        int32_t tiles
        int32_t rounds
        uint64_t plan
        e3d_backend backend

    ctypedef struct e3d_renderer:
        pass

    e3d_status e3d_renderer_create(e3d_backend backend, int32_t threads, e3d_renderer **out)
    void e3d_renderer_destroy(e3d_renderer *renderer)
    e3d_status e3d_renderer_prepare(e3d_renderer *renderer, int32_t width, int32_t height, int32_t planes)
    void e3d_renderer_set_poll(e3d_renderer *renderer, int (*poll)(void *) noexcept nogil, void *user)
    ctypedef struct e3d_bloom:
        const float *radiance
        uint8_t *color
        int32_t width
        int32_t height
        float strength
        int32_t srgb

    size_t e3d_bloom_scratch(int32_t width, int32_t height, int32_t threads)
    e3d_status e3d_add_bloom(const e3d_bloom *bloom, e3d_backend backend, int32_t threads, float *scratch)

    e3d_status e3d_render(e3d_renderer *renderer, const e3d_frame *frame,
                          const e3d_targets *targets, e3d_stats *stats)

    e3d_status e3d_rasterize(const float *clip, int32_t vertices, const int32_t *faces,
                             int32_t faces_count, int32_t width, int32_t height, e3d_cull cull,
                             e3d_backend backend, int32_t threads, int32_t *triangle_id,
                             float *depth, float *barycentric)
