/* The data of lenses: pixels that look into pinhole pictures, and the light that they get there. */
#pragma once

#include "e3d_lens.h"

enum { E3D_LENS_BATCH = 64 }; /* pixels, at most */
