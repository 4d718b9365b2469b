# Mirrors csrc/include/e3d_ui.h.

from e3d cimport e3d_backend, e3d_status
from e3d_canvas cimport e3d_canvas
from libc.stdint cimport int32_t, uint8_t, uint32_t


cdef extern from "e3d_ui.h" nogil:
    enum: E3D_UI_MAX_SIDE

    ctypedef struct e3d_ui_vertex:
        float x
        float y
        float u
        float v
        uint8_t[4] rgba

    ctypedef enum e3d_ui_format:
        E3D_UI_RGBA8
        E3D_UI_A8
        E3D_UI_RGBX8

    ctypedef enum e3d_ui_filter:
        E3D_UI_BILINEAR
        E3D_UI_NEAREST

    ctypedef struct e3d_ui_texture:
        const uint8_t *pixels
        int32_t width
        int32_t height
        int32_t stride
        e3d_ui_format format
        e3d_ui_filter filter

    ctypedef struct e3d_ui_command:
        int32_t left
        int32_t top
        int32_t right
        int32_t bottom
        uint32_t first_index
        uint32_t index_count
        uint32_t first_vertex
        uint32_t texture

    ctypedef struct e3d_ui_list:
        const e3d_ui_vertex *vertices
        const void *indices
        const e3d_ui_command *commands
        const e3d_ui_texture *textures
        uint32_t vertex_count
        uint32_t index_count
        uint32_t command_count
        uint32_t texture_count
        uint32_t index_bytes

    e3d_status e3d_ui_draw(e3d_backend backend, const e3d_canvas *picture, const e3d_ui_list *list)
