# Mirrors csrc/include/e3d_pyrender.h.

from e3d cimport e3d_status
from libc.stdint cimport int32_t, uint8_t


cdef extern from "e3d_pyrender.h" nogil:
    enum: E3D_PYR_LEVELS
    enum: E3D_PYR_SAMPLES
    enum: E3D_PYR_CENTRE
    enum: E3D_PYR_PLACES
    enum: E3D_PYR_SLOTS
    enum: E3D_PYR_TRIANGLES
    enum: E3D_PYR_LINES
    enum: E3D_PYR_POINTS
    enum: E3D_PYR_LIT
    enum: E3D_PYR_FLAT
    enum: E3D_PYR_PLAIN
    enum: E3D_PYR_DEPTH
    enum: E3D_PYR_REPEAT
    enum: E3D_PYR_CLAMP
    enum: E3D_PYR_MIRROR
    enum: E3D_PYR_DIRECTIONAL
    enum: E3D_PYR_POINT
    enum: E3D_PYR_SPOT

    ctypedef struct e3d_pyr_texture:
        const uint8_t *level[E3D_PYR_LEVELS]
        int32_t width
        int32_t height
        int32_t channels
        int32_t levels
        int32_t wrap[2]
        int32_t linear_near
        int32_t linear_far
        int32_t blends_levels

    ctypedef struct e3d_pyr_draw:
        int32_t mode
        int32_t count
        int32_t vertices
        const int32_t *indices
        const float *positions
        const float *normals
        const float *uvs
        const float *colors
        const uint8_t *calm
        double world[16]
        int32_t culls_backs
        int32_t is_wireframe
        int32_t blends
        float color[4]
        float metallic
        float roughness
        float emissive[3]
        const e3d_pyr_texture *textures[E3D_PYR_SLOTS]
        int32_t first_light
        int32_t light_count

    ctypedef struct e3d_pyr_light:
        int32_t kind
        float color[3]
        float position[3]
        float direction[3]
        float cone_scale
        float cone_offset
        const float *shadow_map
        int32_t shadow_size
        double shadow_from_world[16]

    ctypedef struct e3d_pyr_step:
        const int32_t *object_id[E3D_PYR_PLACES]
        const int32_t *triangle_id[E3D_PYR_PLACES]
        const int32_t *instance_id[E3D_PYR_PLACES]
        const int32_t *draw_of_object
        int32_t first_draw
        int32_t draw_count

    ctypedef struct e3d_pyr_frame:
        int32_t width
        int32_t height
        int32_t samples
        int32_t shading
        double clip_from_world[16]
        float eye[3]
        float ambient[3]
        float background[4]
        float point_size
        double depth_near
        double depth_far
        int32_t depth_place
        int32_t depth_is_straight
        const e3d_pyr_draw *draws
        int32_t draw_count
        const e3d_pyr_light *lights
        const int32_t *light_numbers
        const e3d_pyr_step *steps
        int32_t step_count
        uint8_t *color
        int32_t channels
        float *depth

    ctypedef struct e3d_pyr_memory:
        pass

    void e3d_pyr_find_calm(const e3d_pyr_draw *draw, uint8_t *out)
    e3d_pyr_memory *e3d_pyr_memory_new()
    void e3d_pyr_memory_free(e3d_pyr_memory *memory)
    e3d_status e3d_pyr_render(const e3d_pyr_frame *frame, int32_t threads, e3d_pyr_memory *memory)
