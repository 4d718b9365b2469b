/* A tile's rows to a picture of the caller's. */
#include <string.h>

#include "core/stream.h"
#include "pipeline/frame.h"

/* Whether a picture's lines aren't in this core's caches anyway: it is large, or another core wrote them last. */
static int is_far(const e3d_context *context, size_t bytes)
{
    enum { LARGE = 1 << 21, SHARED = 1 << 18 };
    return bytes >= (context->renderer->threads > 1 ? SHARED : LARGE);
}

void e3d_write_rows(const e3d_context *context, const e3d_tile *tile, void *picture, size_t pixel, const void *rows, size_t step)
{
    int axis = context->frame->samples_axis;
    size_t pitch = pixel * (size_t)context->frame->width, bytes = pixel * (size_t)(tile->width / axis);
    char *to = (char *)picture + (size_t)(tile->y / axis) * pitch + (size_t)(tile->x / axis) * pixel;
    const char *from = rows;
    int far = is_far(context, pitch * (size_t)context->frame->height);
    for (int y = 0; y < tile->height / axis; y++, to += pitch, from += step)
        if (far)
            e3d_stream(to, from, bytes);
        else
            memcpy(to, from, bytes);
}
