/* The backends of whose kernels this build has more than one lane: E3D_EACH_BUILT_BACKEND(X). The build says for which processor it is. */
#ifndef E3D_BUILT_BACKENDS_H
#define E3D_BUILT_BACKENDS_H

#include "e3d_backends.h"

#if defined(E3D_HAVE_X86)
#define E3D_EACH_BUILT_BACKEND(X) E3D_EACH_X86_BACKEND(X)
#elif defined(E3D_HAVE_AARCH64)
#define E3D_EACH_BUILT_BACKEND(X) E3D_EACH_AARCH64_BACKEND(X)
#else
#define E3D_EACH_BUILT_BACKEND(X)
#endif

#endif
