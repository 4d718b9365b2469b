/* Lists of filled triangles: snaps vertices to 1/256 pixel, and calls one of the two fills.
 * In: positions in pixels, any values; a triangle with a vertex that is not finite is dropped. Out: what triangle_edge.c or
 * triangle_scanline.c draw, which are the same pixels. */
#include "canvas_pixels.h"

/* Snaps to the nearest 1/256 pixel, ties to even, whatever the caller's rounding mode. */
static int64_t snap(double position)
{
    const double scaled = clamp_position(position) * SUBPIXELS;
    const double whole = floor(scaled);
    const double rest = scaled - whole;
    const int64_t below = (int64_t)whole;
    const bool up = rest > 0.5 || (rest == 0.5 && (below & 1));
    return below + up;
}

static bool snap_vertices(const double *xyxyxy, e3d_subpixel vertices[3])
{
    for (int i = 0; i < 3; i++) {
        const double x = xyxyxy[2 * i];
        const double y = xyxyxy[2 * i + 1];
        if (!isfinite(x) || !isfinite(y)) {
            return false;
        }
        vertices[i] = (e3d_subpixel){snap(x), snap(y)};
    }
    return true;
}

void e3d_canvas_triangles(const e3d_canvas *canvas, const double *xyxyxy, size_t count,
                          const uint8_t *colors, size_t color_stride,
                          e3d_triangle_algorithm algorithm)
{
    for (size_t k = 0; k < count; k++) {
        const e3d_rgba color = color_at(colors, color_stride, k);
        e3d_subpixel vertices[3];
        if (color.a == 0 || !snap_vertices(xyxyxy + 6 * k, vertices)) {
            continue;
        }
        if (algorithm == E3D_TRIANGLE_SCANLINE) {
            e3d_canvas_fill_scanline(canvas, vertices, color);
        } else {
            e3d_canvas_fill_edge(canvas, vertices, color);
        }
    }
}
