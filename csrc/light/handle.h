/* The struct behind a handle of an environment. */
#ifndef E3D_ENVIRONMENT_HANDLE_H
#define E3D_ENVIRONMENT_HANDLE_H

#include "e3d_environment.h"

struct e3d_environment {
    e3d_environment_view view;
    float *texels;
};

#endif
