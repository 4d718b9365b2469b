# cython: language_level=3, boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to the 2-D canvas in C: checks shapes, releases the GIL, makes one call.

In:  a framebuffer, positions as float64, colours as bytes (4, or 4 for each primitive).
Out: pixels of the framebuffer. Names of algorithms and kinds of arguments are engine/rendering/canvas.py's affair.
"""

from e3d_canvas cimport *
from e3d_window cimport *
from libc.stdint cimport int16_t, int32_t, int64_t, uint8_t
from libc.stdlib cimport calloc, free

MAX_SIDE = E3D_CANVAS_MAX_SIDE
LINE_ALGORITHMS = {"bresenham": E3D_LINE_BRESENHAM, "dda": E3D_LINE_DDA}
TRIANGLE_ALGORITHMS = {"edge": E3D_TRIANGLE_EDGE, "scanline": E3D_TRIANGLE_SCANLINE}


cdef e3d_rgba rgba(const uint8_t[::1] color) except *:
    if color.shape[0] != 4:
        raise ValueError(f"a colour is 4 bytes, not {color.shape[0]}")
    return e3d_rgba(color[0], color[1], color[2], color[3])


cdef size_t color_stride(const uint8_t[::1] colors, Py_ssize_t count) except? 1:
    """0 for one colour for all primitives, 4 for one each."""
    if colors.shape[0] == 4:
        return 0
    if colors.shape[0] != 4 * count:
        raise ValueError(f"{count} primitives take 4 or {4 * count} bytes of colours, "
                         f"not {colors.shape[0]}")
    return 4


cdef int check_columns(const double[:, ::1] positions, Py_ssize_t columns) except -1:
    if positions.shape[1] != columns:
        raise ValueError(f"positions have {columns} columns, not {positions.shape[1]}")
    return 0


include "picture_memory.pxi"


cdef class Surface:
    """A framebuffer to draw on; keeps its pixels alive."""

    cdef uint8_t[:, :, :] pixels
    cdef e3d_canvas canvas

    def __cinit__(self, uint8_t[:, :, :] pixels not None):
        take_picture(pixels, E3D_CANVAS_MAX_SIDE, &self.canvas)
        self.pixels = pixels

    def clear(self, const uint8_t[::1] color not None):
        cdef e3d_rgba native_color = rgba(color)
        with nogil:
            e3d_canvas_clear(&self.canvas, native_color)

    def rectangle(self, double x, double y, double width, double height,
                  const uint8_t[::1] color not None, bint fill):
        cdef e3d_rgba native_color = rgba(color)
        with nogil:
            if fill:
                e3d_canvas_rectangle(&self.canvas, x, y, width, height, native_color)
            else:
                e3d_canvas_rectangle_outline(&self.canvas, x, y, width, height, native_color)

    def point(self, double x, double y, const uint8_t[::1] color not None):
        cdef double[2] xy = [x, y]
        cdef size_t stride = color_stride(color, 1)
        e3d_canvas_points(&self.canvas, xy, 1, &color[0], stride)

    def points(self, const double[:, ::1] xy not None, const uint8_t[::1] colors not None):
        check_columns(xy, 2)
        cdef size_t count = xy.shape[0]
        cdef size_t stride = color_stride(colors, xy.shape[0])
        if count > 0:
            with nogil:
                e3d_canvas_points(&self.canvas, &xy[0, 0], count, &colors[0], stride)

    def line(self, double x0, double y0, double x1, double y1, const uint8_t[::1] color not None,
             double width, e3d_line_algorithm algorithm):
        cdef double[4] xyxy = [x0, y0, x1, y1]
        cdef size_t stride = color_stride(color, 1)
        with nogil:
            e3d_canvas_lines(&self.canvas, xyxy, 1, &color[0], stride, width, algorithm)

    def lines(self, const double[:, ::1] xyxy not None, const uint8_t[::1] colors not None,
              double width, e3d_line_algorithm algorithm):
        check_columns(xyxy, 4)
        cdef size_t count = xyxy.shape[0]
        cdef size_t stride = color_stride(colors, xyxy.shape[0])
        if count > 0:
            with nogil:
                e3d_canvas_lines(&self.canvas, &xyxy[0, 0], count, &colors[0], stride, width,
                                 algorithm)

    def polyline(self, const double[:, ::1] xy not None, bint closed,
                 const uint8_t[::1] color not None, double width, e3d_line_algorithm algorithm):
        check_columns(xy, 2)
        cdef e3d_rgba native_color = rgba(color)
        cdef size_t count = xy.shape[0]
        if count > 0:
            with nogil:
                e3d_canvas_polyline(&self.canvas, &xy[0, 0], count, closed, native_color, width,
                                    algorithm)

    def triangle(self, double ax, double ay, double bx, double by, double cx, double cy,
                 const uint8_t[::1] color not None, e3d_triangle_algorithm algorithm):
        cdef double[6] xyxyxy = [ax, ay, bx, by, cx, cy]
        cdef size_t stride = color_stride(color, 1)
        with nogil:
            e3d_canvas_triangles(&self.canvas, xyxyxy, 1, &color[0], stride, algorithm)

    def triangles(self, const double[:, ::1] xyxyxy not None, const uint8_t[::1] colors not None,
                  e3d_triangle_algorithm algorithm):
        check_columns(xyxyxy, 6)
        cdef size_t count = xyxyxy.shape[0]
        cdef size_t stride = color_stride(colors, xyxyxy.shape[0])
        if count > 0:
            with nogil:
                e3d_canvas_triangles(&self.canvas, &xyxyxy[0, 0], count, &colors[0], stride,
                                     algorithm)

    def text(self, double x, double y, const uint8_t[::1] codes not None, int scale,
             const uint8_t[::1] color not None):
        cdef e3d_rgba native_color = rgba(color)
        cdef size_t length = codes.shape[0]
        if scale < 1:
            raise ValueError(f"scale is at least 1, not {scale}")
        if length > 0:
            with nogil:
                e3d_canvas_text(&self.canvas, x, y, &codes[0], length, scale, native_color)

    def glyphs(self, double x, double y, const int32_t[::1] numbers not None, const int32_t[::1] advances not None,
               Glyphs font not None, const uint8_t[::1] color not None):
        """Draw glyphs of a font; the caller keeps others from adding to it."""
        cdef e3d_rgba native_color = rgba(color)
        cdef Py_ssize_t k
        if advances.shape[0] != numbers.shape[0]:
            raise ValueError(f"{numbers.shape[0]} glyphs have as many advances, not {advances.shape[0]}")
        for k in range(numbers.shape[0]):
            if numbers[k] >= font.count:
                raise ValueError(f"the font has {font.count} glyphs, not {numbers[k] + 1}")
        if font.count > 0 and numbers.shape[0] > 0:
            font.draw(&self.canvas, x, y, numbers, advances, native_color)

    def outline(self, int x, int y, const int16_t[:, ::1] points not None, const uint8_t[::1] on_curve not None,
                const int32_t[::1] ends not None, int units, const uint8_t[::1] color not None):
        """Fill an outline whose origin is the pixel corner (x, y), with so many units a pixel, y up."""
        cdef e3d_rgba native_color = rgba(color)
        cdef e3d_outline outline = outline_of(points, on_curve, ends)
        if not 1 <= units <= 256:
            raise ValueError("a pixel has 1 to 256 units")
        outline.scale_x = outline.scale_y = e3d_ratio(256, units)
        outline.shift = 0
        cdef e3d_glyph glyph
        cdef bytearray alphas = bytearray()
        cdef int32_t number = 0, advance = 0
        add_alphas(alphas, &glyph, &outline)
        cdef uint8_t *first = alphas
        cdef e3d_font font
        font.alphas, font.glyphs = first, &glyph
        font.ascent = font.line_height = 0
        with nogil:
            e3d_canvas_glyphs(&self.canvas, x, y, &number, &advance, 1, &font, native_color)


cdef class Glyphs:
    """The pictures of a font's glyphs, as many as were added.

    In: pixels from the top of a line to its baseline, and to the next line.
    """

    cdef bytearray alphas, glyph_bytes
    cdef readonly int count
    cdef int ascent, line_height

    def __cinit__(self, int ascent, int line_height):
        self.alphas, self.glyph_bytes = bytearray(), bytearray()
        self.ascent, self.line_height = ascent, line_height

    cdef void draw(self, const e3d_canvas *canvas, double x, double y,
                   const int32_t[::1] numbers, const int32_t[::1] advances, e3d_rgba color) noexcept:
        cdef uint8_t *alphas = self.alphas
        cdef uint8_t *glyphs = self.glyph_bytes
        cdef e3d_font font
        font.alphas, font.glyphs = alphas, <const e3d_glyph *>glyphs
        font.ascent, font.line_height = self.ascent, self.line_height
        e3d_canvas_glyphs(canvas, x, y, &numbers[0], &advances[0], numbers.shape[0], &font, color)

    def add(self, const int16_t[:, ::1] points not None, const uint8_t[::1] on_curve not None,
            const int32_t[::1] ends not None, int across, int units_across, int up, int units_up) -> int:
        """Draw a glyph at each quarter of a pixel; return its number.

        Parameters
        ----------
        points : (N, 2), on_curve : (N,), ends : (contours,)
            The outline: see `e3d_outline`.
        across, units_across, up, units_up : int
            How many 1/256 pixel so many units of the font are.
        """
        cdef e3d_outline outline = outline_of(points, on_curve, ends)
        cdef int phase
        if units_across < 1 or units_up < 1:
            raise ValueError("a scale has a positive number of units")
        outline.scale_x = e3d_ratio(across, units_across)
        outline.scale_y = e3d_ratio(up, units_up)
        # What a failure left behind isn't a glyph.
        del self.glyph_bytes[self.count * E3D_GLYPH_PHASES * sizeof(e3d_glyph):]
        for phase in range(E3D_GLYPH_PHASES):
            outline.shift = phase * 256 // E3D_GLYPH_PHASES
            self.add_phase(&outline)
        self.count += 1
        return self.count - 1

    cdef int add_phase(self, const e3d_outline *outline) except -1:
        cdef e3d_glyph glyph
        add_alphas(self.alphas, &glyph, outline)
        self.glyph_bytes.extend((<uint8_t *>&glyph)[:sizeof(e3d_glyph)])
        return 0


cdef e3d_outline outline_of(
    const int16_t[:, ::1] points, const uint8_t[::1] on_curve, const int32_t[::1] ends
) except *:
    """An outline without a scale; the arrays must live as long."""
    cdef e3d_outline outline
    if points.shape[1] != 2 or on_curve.shape[0] != points.shape[0]:
        raise ValueError("points are (N, 2), and on_curve has as many")
    check_ends(ends, points.shape[0])
    outline.points, outline.contours = <int32_t>points.shape[0], <int32_t>ends.shape[0]
    outline.xy = &points[0, 0] if outline.points else NULL
    outline.on_curve = &on_curve[0] if outline.points else NULL
    outline.ends = &ends[0] if outline.contours else NULL
    return outline


cdef int add_alphas(bytearray alphas, e3d_glyph *glyph, const e3d_outline *outline) except -1:
    """Add the alphas of an outline, and tell the glyph where they are and which pixels they are for."""
    glyph.first, glyph.box = len(alphas), e3d_outline_box(outline)
    cdef size_t cells_count = <size_t>(glyph.box.width + 1) * glyph.box.height
    cdef size_t alphas_count = <size_t>glyph.box.width * glyph.box.height
    alphas.extend(bytes(alphas_count))
    cdef uint8_t *all = alphas
    cdef e3d_cell *cells = NULL
    if cells_count > 0:
        cells = <e3d_cell *>calloc(cells_count, sizeof(e3d_cell))
        if cells == NULL:
            raise MemoryError()
        e3d_outline_alphas(outline, glyph.box, cells, all + glyph.first)
        free(cells)
    return 0


cdef int check_ends(const int32_t[::1] ends, Py_ssize_t points) except -1:
    cdef Py_ssize_t k
    cdef int32_t last = 0
    for k in range(ends.shape[0]):
        if ends[k] <= last:
            raise ValueError("each contour has a point")
        last = ends[k]
    if last != points:
        raise ValueError(f"the contours have {last} points, not {points}")
    return 0


def copy_to_window(const uint8_t[:, :, ::1] picture not None, uint8_t[:, :, :] shown not None,
                   bint is_swapped, uint8_t[::1] changed not None) -> None:
    """Copy a picture to a window's memory, and tell which rows changed: see `e3d_window_copy`."""
    cdef e3d_canvas target
    take_picture(shown, E3D_CANVAS_MAX_SIDE, &target)
    if picture.shape[2] != 4 or (picture.shape[1], picture.shape[0]) != (target.width, target.height):
        raise ValueError("the window's memory is not as large as the picture")
    if changed.shape[0] != target.height:
        raise ValueError(f"{target.height} rows take as many flags, not {changed.shape[0]}")
    if target.height == 0 or target.width == 0:
        return
    with nogil:
        e3d_window_copy(&picture[0, 0, 0], picture.strides[0], target.pixels, target.stride,
                        target.width, target.height, is_swapped, &changed[0])


def text_size(const uint8_t[::1] codes not None, int scale) -> tuple[int, int]:
    """The (width, height) in pixels of the cells of a text."""
    cdef int64_t width = 0, height = 0
    cdef size_t length = codes.shape[0]
    e3d_text_size(&codes[0] if length > 0 else NULL, length, scale, &width, &height)
    return width, height
