/* Renderers of the driver's scenes: new ones, or some that have drawn other scenes before. */
#pragma once

#include "e3d.h"

/* From now on, renderers of an even number of threads are kept for the scenes that follow. */
void renderers_keep(void);
void renderers_free(void);
e3d_status renderer_take(e3d_backend backend, int32_t threads, e3d_renderer **out);
/* NULL: nothing is returned. */
void renderer_return(e3d_renderer *renderer);
