# Mirrors csrc/include/e3d_canvas.h.

from libc.stddef cimport ptrdiff_t
from libc.stdint cimport int32_t, int64_t, uint8_t


cdef extern from "e3d_canvas.h" nogil:
    enum: E3D_CANVAS_MAX_SIDE

    ctypedef struct e3d_canvas:
        uint8_t *pixels
        int32_t width
        int32_t height
        ptrdiff_t stride

    ctypedef struct e3d_rgba:
        uint8_t r
        uint8_t g
        uint8_t b
        uint8_t a

    ctypedef enum e3d_line_algorithm:
        E3D_LINE_BRESENHAM
        E3D_LINE_DDA

    ctypedef enum e3d_triangle_algorithm:
        E3D_TRIANGLE_EDGE
        E3D_TRIANGLE_SCANLINE

    void e3d_canvas_clear(const e3d_canvas *canvas, e3d_rgba color)
    void e3d_canvas_rectangle(const e3d_canvas *canvas, double x, double y, double width,
                              double height, e3d_rgba color)
    void e3d_canvas_rectangle_outline(const e3d_canvas *canvas, double x, double y, double width,
                                      double height, e3d_rgba color)
    void e3d_canvas_points(const e3d_canvas *canvas, const double *xy, size_t count,
                           const uint8_t *colors, size_t color_stride)
    void e3d_canvas_lines(const e3d_canvas *canvas, const double *xyxy, size_t count,
                          const uint8_t *colors, size_t color_stride, double width,
                          e3d_line_algorithm algorithm)
    void e3d_canvas_polyline(const e3d_canvas *canvas, const double *xy, size_t count, int closed,
                             e3d_rgba color, double width, e3d_line_algorithm algorithm)
    void e3d_canvas_triangles(const e3d_canvas *canvas, const double *xyxyxy, size_t count,
                              const uint8_t *colors, size_t color_stride,
                              e3d_triangle_algorithm algorithm)
    void e3d_canvas_text(const e3d_canvas *canvas, double x, double y, const uint8_t *codes,
                         size_t length, int32_t scale, e3d_rgba color)
    void e3d_text_size(const uint8_t *codes, size_t length, int32_t scale, int64_t *width,
                       int64_t *height)
