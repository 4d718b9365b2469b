/* The 2-D canvas: points, lines, triangles, rectangles and text on an RGBA8 framebuffer.
 * In: a framebuffer and positions in screen space: x right, y down, in pixels; pixel (i, j) is the square [i, i+1) x [j, j+1),
 * its centre is (i + 1/2, j + 1/2).
 * Out: the pixels, overwritten by an opaque colour, or blended with a colour whose alpha is below 255.
 * Always: every position is legal. A position that is not finite draws nothing; a coordinate beyond +-2^31 is clamped to that;
 * what lies outside the framebuffer costs no time in proportion to its size. Results are exact integers, so that they are the
 * same on every machine. Nothing is allocated. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* The longest side of a framebuffer. The edge functions of triangle.c rely on it. */
#define E3D_CANVAS_MAX_SIDE 262144

/* The size of a character cell, in pixels, at scale 1. */
#define E3D_FONT_WIDTH 8
#define E3D_FONT_HEIGHT 14

typedef struct e3d_canvas {
    uint8_t *pixels; /* row 0 is the top row; four bytes a pixel: red, green, blue, alpha */
    int32_t width;   /* 0 ... E3D_CANVAS_MAX_SIDE */
    int32_t height;
    ptrdiff_t stride; /* bytes from a row to the one below it; may be negative */
} e3d_canvas;

/* Straight (not premultiplied) alpha; 0 is transparent, 255 opaque. */
typedef struct e3d_rgba {
    uint8_t r, g, b, a;
} e3d_rgba;

typedef enum e3d_line_algorithm {
    E3D_LINE_BRESENHAM = 0,
    E3D_LINE_DDA = 1,
} e3d_line_algorithm;

typedef enum e3d_triangle_algorithm {
    E3D_TRIANGLE_EDGE = 0,
    E3D_TRIANGLE_SCANLINE = 1,
} e3d_triangle_algorithm;

/* Overwrites every pixel, alpha included. */
void e3d_canvas_clear(const e3d_canvas *canvas, e3d_rgba color);

/* The pixels whose centres lie in [x, x + width) x [y, y + height). */
void e3d_canvas_rectangle(const e3d_canvas *canvas, double x, double y, double width, double height,
                          e3d_rgba color);

/* The border of the same rectangle, one pixel wide. */
void e3d_canvas_rectangle_outline(const e3d_canvas *canvas, double x, double y, double width,
                                  double height, e3d_rgba color);

/* In the functions below, primitive k takes the colour at colors + k * color_stride: a stride of 4
 * reads one colour for each, a stride of 0 the same colour for all. */

/* The pixels that hold the points (x, y). */
void e3d_canvas_points(const e3d_canvas *canvas, const double *xy, size_t count,
                       const uint8_t *colors, size_t color_stride);

/* Draws lines (x0, y0, x1, y1) from the pixel that holds one end to the pixel that holds the other. Both ends are included, and
 * either direction gives the same pixels. Widths up to 1 use `algorithm`; wider lines are parallelograms, `width` thick along
 * the minor axis, filled by the triangles' rule. */
void e3d_canvas_lines(const e3d_canvas *canvas, const double *xyxy, size_t count,
                      const uint8_t *colors, size_t color_stride, double width,
                      e3d_line_algorithm algorithm);

/* Draws lines through `count` points, and back to the first one if `closed`. At widths up to 1 the vertex between two lines is
 * drawn once, so that a translucent polyline shows no dots. A vertex that is not finite interrupts the polyline. */
void e3d_canvas_polyline(const e3d_canvas *canvas, const double *xy, size_t count, int closed,
                         e3d_rgba color, double width, e3d_line_algorithm algorithm);

/* Draws triangles (x0, y0, x1, y1, x2, y2) of either winding. Vertices are snapped to 1/256 pixel (nearest, ties to even). A
 * triangle covers the pixels whose centres lie inside, or on an edge that is a top or a left one. Both algorithms give the same
 * pixels. */
void e3d_canvas_triangles(const e3d_canvas *canvas, const double *xyxyxy, size_t count,
                          const uint8_t *colors, size_t color_stride,
                          e3d_triangle_algorithm algorithm);

/* Draws text in the built-in font; the top left corner of its first cell is the pixel that holds (x, y). `codes` are ASCII, and
 * beyond it those of font.c. Code 10 starts a new line. A code that the font lacks shows as a hollow box. Each pixel of the font
 * becomes scale x scale pixels (scale >= 1). */
void e3d_canvas_text(const e3d_canvas *canvas, double x, double y, const uint8_t *codes,
                     size_t length, int32_t scale, e3d_rgba color);

/* Finds the size in pixels of a text's cells: its longest line by its number of lines. */
void e3d_text_size(const uint8_t *codes, size_t length, int32_t scale, int64_t *width,
                   int64_t *height);

/* A number of 1/256 pixel a unit of a font. */
typedef struct e3d_ratio {
    int32_t numerator, denominator; /* the denominator is positive */
} e3d_ratio;

/* The contours of a glyph, as TrueType has them: points of quadratic curves, and control points between them. */
typedef struct e3d_outline {
    const int16_t *xy;       /* x, y of each point: units of the font, x right, y up */
    const uint8_t *on_curve; /* of each point: whether the curve passes through it */
    const int32_t *ends;     /* of each contour: the number of the point behind its last one; none is empty */
    int32_t points, contours;
    e3d_ratio scale_x, scale_y;
    int32_t shift; /* to the right, 1/256 pixel */
} e3d_outline;

/* Pixels around a glyph's origin, y down. */
typedef struct e3d_glyph_box {
    int32_t left, top, width, height;
} e3d_glyph_box;

/* What the edges add to a pixel: how high they are, and the doubled area to the left of them. */
typedef struct e3d_cell {
    int64_t area; /* of any number of windings */
    int32_t cover;
} e3d_cell;

/* Finds the pixels that an outline may cover. */
e3d_glyph_box e3d_outline_box(const e3d_outline *outline);

/* Finds the alpha of each pixel of that box. `cells` are (width + 1) x height, all 0. */
void e3d_outline_alphas(const e3d_outline *outline, e3d_glyph_box box, e3d_cell *cells, uint8_t *alphas);

/* Each glyph has one picture for each quarter of a pixel that its origin may be at. */
#define E3D_GLYPH_PHASES 4

typedef struct e3d_glyph {
    size_t first; /* its first alpha */
    e3d_glyph_box box;
} e3d_glyph;

typedef struct e3d_font {
    const uint8_t *alphas;
    const e3d_glyph *glyphs; /* E3D_GLYPH_PHASES of each */
    int32_t ascent, line_height; /* pixels: from the top of a line to its baseline, and to the next line */
} e3d_font;

/* Draws text; the first line begins at (x, y), its top left corner. `glyphs` are numbers of the font's glyphs; -1 starts a new
 * line. `advances` are from each glyph's origin to that of the next one in its line, 1/256 pixel. */
void e3d_canvas_glyphs(const e3d_canvas *canvas, double x, double y, const int32_t *glyphs, const int32_t *advances,
                       size_t length, const e3d_font *font, e3d_rgba color);
