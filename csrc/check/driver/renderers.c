/* Renderers of the driver's scenes: new ones, or some that have drawn other scenes before. */
#include "check/driver/renderers.h"

enum { MOST_THREADS = 8 };

static e3d_renderer *kept[E3D_BACKEND_COUNT][MOST_THREADS + 1];
static int keeps;

void renderers_keep(void) { keeps = 1; }

void renderers_free(void)
{
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        for (int32_t threads = 0; threads <= MOST_THREADS; threads++)
            e3d_renderer_destroy(kept[k][threads]);
}

e3d_status renderer_take(e3d_backend backend, int32_t threads, e3d_renderer **out)
{
    if (!keeps || threads % 2 || threads > MOST_THREADS)
        return e3d_renderer_create(backend, threads, out);
    e3d_renderer **place = &kept[backend][threads];
    e3d_status status = *place ? E3D_OK : e3d_renderer_create(backend, threads, place);
    *out = *place;
    return status;
}

void renderer_return(e3d_renderer *renderer)
{
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        for (int32_t threads = 0; threads <= MOST_THREADS; threads++)
            if (renderer && kept[k][threads] == renderer)
                return;
    e3d_renderer_destroy(renderer);
}
