/* What is found once a pass, before anything is drawn. */
#ifndef E3D_PREPARE_H
#define E3D_PREPARE_H

#include "e3d.h"
#include "pipeline/frame/context.h"

/* Prepares a pass, and all of the renderer's memory for it. */
e3d_status e3d_prepare(e3d_renderer *renderer, const e3d_pass *asked, e3d_context *out);

#endif
