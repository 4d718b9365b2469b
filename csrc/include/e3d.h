/* The whole C interface of the engine3d core: plain structs, opaque handles, status codes.
 *
 * In:  arrays that the caller owns and keeps alive and unchanged (meshes borrow them), matrices,
 *      materials, lights and what to write.
 * Out: the caller's own arrays, filled; nothing is written unless E3D_OK or E3D_CANCELLED is returned.
 * Always: any thread may call anything on different renderers at once; one renderer is one thread's
 *      at a time. Matrices are row-major and act on column vectors. Clip space is OpenGL's
 *      (-w <= z <= w). Images are top row first, without padding. docs/exactness has the formulas.
 */
#pragma once

#include "e3d_backends.h"
#include "e3d_behind.h"
#include "e3d_bloom.h"
#include "e3d_options.h"
#include "e3d_casters.h"
#include "e3d_draw.h"
#include "e3d_environment.h"
#include "e3d_frame.h"
#include "e3d_light.h"
#include "e3d_material.h"
#include "e3d_mesh.h"
#include "e3d_mirror.h"
#include "e3d_renderer.h"
#include "e3d_status.h"
#include "e3d_targets.h"
#include "e3d_texture.h"
#include "e3d_tone.h"
