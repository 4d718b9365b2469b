/* The view of an environment. It is in a file of its own, since benchmarks link the kernels without the code that makes
 * environments. */
#include "light/handle.h"

const e3d_environment_view *e3d_environment_get_view(const e3d_environment *environment) { return &environment->view; }
