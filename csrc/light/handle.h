/* The struct behind a handle of an environment. */
#pragma once

#include "e3d_environment.h"

struct e3d_environment {
    e3d_environment_view view;
    float *texels;
};
