/* A tile's rows to a picture of the caller's, and back. */
#include <string.h>

#include "pipeline/frame.h"

/* Whether a picture's lines aren't in this core's caches anyway: it is large, or another core wrote them last. */
static int is_far(const e3d_context *context, size_t bytes)
{
    enum { LARGE = 1 << 20, SHARED = 1 << 18 };
    return bytes >= (context->renderer->threads > 1 ? SHARED : LARGE);
}

/* Where the tile's first pixel is in a picture, in bytes. */
static size_t start_of(const e3d_context *context, const e3d_tile *tile, size_t pixel)
{
    int axis = context->frame->samples_axis;
    return ((size_t)(tile->y / axis) * (size_t)context->frame->width + (size_t)(tile->x / axis)) * pixel;
}

static void copy(const e3d_pixel_rows *rows)
{
    for (int y = 0; y < rows->count; y++)
        memcpy(rows->to + (size_t)y * rows->pitch, rows->from + (size_t)y * rows->step, rows->bytes);
}

void e3d_write_rows(const e3d_context *context, const e3d_tile *tile, void *picture, size_t pixel, const void *from, size_t step)
{
    int axis = context->frame->samples_axis;
    size_t pitch = pixel * (size_t)context->frame->width;
    const e3d_pixel_rows rows = {(char *)picture + start_of(context, tile, pixel), from, pixel * (size_t)(tile->width / axis), pitch,
                                 step, tile->height / axis};
    if (is_far(context, pitch * (size_t)context->frame->height))
        context->kernels->stream(&rows);
    else
        copy(&rows);
}

void e3d_read_rows(const e3d_context *context, const e3d_tile *tile, const void *picture, size_t pixel, void *to, size_t step)
{
    int axis = context->frame->samples_axis;
    size_t pitch = pixel * (size_t)context->frame->width;
    const e3d_pixel_rows rows = {to, (const char *)picture + start_of(context, tile, pixel), pixel * (size_t)(tile->width / axis), step,
                                 pitch, tile->height / axis};
    copy(&rows);
}
