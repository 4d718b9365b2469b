/* What is found once a frame, before anything is drawn. */
#ifndef E3D_PREPARE_H
#define E3D_PREPARE_H

#include "e3d.h"

typedef struct e3d_context e3d_context;

e3d_status e3d_prepare(e3d_context *context);

#endif
