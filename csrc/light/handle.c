/* The view of an environment: apart from what makes one, since the kernels are linked without that where they are timed alone. */
#include "light/handle.h"

const e3d_environment_view *e3d_environment_get_view(const e3d_environment *environment) { return &environment->view; }
