/* A tile's rows to a picture of the caller's, and back. */
#include <string.h>

#include "pipeline/frame.h"

/* Whether a picture's lines aren't in this core's caches anyway: it is large, or another core wrote them last. */
static int is_far(const e3d_context *context, size_t bytes)
{
    enum { LARGE = 1 << 20, SHARED = 1 << 18 };
    return bytes >= (context->renderer->threads > 1 ? SHARED : LARGE);
}

/* The tile's pixels in a picture: where, how long a row is, and how far apart rows are. */
typedef struct place {
    size_t start, bytes, pitch;
    int rows;
} place;

static place place_of(const e3d_context *context, const e3d_tile *tile, size_t pixel)
{
    int axis = context->frame->samples_axis;
    size_t pitch = pixel * (size_t)context->frame->width;
    return (place){(size_t)(tile->y / axis) * pitch + (size_t)(tile->x / axis) * pixel, pixel * (size_t)(tile->width / axis), pitch,
                   tile->height / axis};
}

void e3d_write_rows(const e3d_context *context, const e3d_tile *tile, void *picture, size_t pixel, const void *rows, size_t step)
{
    const place at = place_of(context, tile, pixel);
    char *to = (char *)picture + at.start;
    const char *from = rows;
    int far = is_far(context, at.pitch * (size_t)context->frame->height);
    for (int y = 0; y < at.rows; y++, to += at.pitch, from += step)
        if (far)
            context->kernels->stream(to, from, at.bytes);
        else
            memcpy(to, from, at.bytes);
}

void e3d_read_rows(const e3d_context *context, const e3d_tile *tile, const void *picture, size_t pixel, void *rows, size_t step)
{
    const place at = place_of(context, tile, pixel);
    const char *from = (const char *)picture + at.start;
    char *to = rows;
    for (int y = 0; y < at.rows; y++, to += step, from += at.pitch)
        memcpy(to, from, at.bytes);
}
