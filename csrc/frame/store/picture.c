/* Copies a tile's rows to a picture of the caller's, and back. */
#include <string.h>

#include "frame/store/picture.h"
#include "kernels/types/samples.h"

/* Whether a picture's cache lines aren't in this core's caches anyway: it is large, or another core wrote them last. */
static int is_far(const e3d_prepared *pass, size_t bytes)
{
    enum { LARGE = 1 << 20,
           SHARED = 1 << 18 };
    return bytes >= (pass->threads > 1 ? SHARED : LARGE);
}

/* A tile's place in a picture, in bytes: the offset of its first pixel, the size of a row, and the distance of rows. */
typedef struct place {
    size_t start, bytes, pitch;
    int rows;
} place;

static place place_of(const e3d_prepared *pass, const e3d_tile *tile, size_t pixel)
{
    int axis = pass->frame->samples_axis;
    size_t pitch = pixel * (size_t)pass->frame->width;
    size_t start = (size_t)(tile->y / axis) * pitch + (size_t)(tile->x / axis) * pixel;
    return (place){start, pixel * (size_t)(tile->width / axis), pitch, tile->height / axis};
}

static void copy(const e3d_pixel_rows *rows)
{
    for (int y = 0; y < rows->count; y++)
        memcpy(rows->to + (size_t)y * rows->pitch, rows->from + (size_t)y * rows->step, rows->bytes);
}

void e3d_write_tile(const e3d_prepared *pass, const e3d_tile *tile, void *picture, size_t pixel, const void *from, size_t step)
{
    const place at = place_of(pass, tile, pixel);
    const e3d_pixel_rows rows = {(char *)picture + at.start, from, at.bytes, at.pitch, step, at.rows};
    if (is_far(pass, at.pitch * (size_t)pass->frame->height))
        pass->kernels->stream(&rows);
    else
        copy(&rows);
}

void e3d_read_tile(const e3d_prepared *pass, const e3d_tile *tile, const void *picture, size_t pixel, void *to, size_t step)
{
    const place at = place_of(pass, tile, pixel);
    const e3d_pixel_rows rows = {to, (const char *)picture + at.start, at.bytes, step, at.pitch, at.rows};
    copy(&rows);
}
