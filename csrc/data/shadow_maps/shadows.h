/* Whether the lights of a frame have shadows, and whether lookups in their maps are safe. */
#pragma once

#include "e3d.h"

/* Whether any light has a shadow. */
int e3d_has_shadows(const e3d_frame *frame);
/* Whether any light has an exact shadow. */
int e3d_has_exact_shadows(const e3d_frame *frame);
/* Whether all lights' maps are there, and no comparison leaves them. */
int e3d_shadows_are_valid(const e3d_frame *frame);
