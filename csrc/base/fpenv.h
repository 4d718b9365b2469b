/* The default floating-point environment around every piece of core code.
 *
 * Another library's flush-to-zero or rounding mode must not change a pixel, and ours must not leak
 * out: every entry and every worker enters and leaves.
 */
#pragma once

#include "base/machine.h"

#ifdef __FAST_MATH__
#error "engine3d needs IEEE arithmetic: build without -ffast-math"
#endif

typedef e3d_float_control e3d_fpenv;

static inline e3d_fpenv e3d_fpenv_enter(void)
{
    e3d_fpenv saved = e3d_float_control_get();
    e3d_float_control_reset();
    return saved;
}
static inline void e3d_fpenv_leave(e3d_fpenv saved) { e3d_float_control_set(saved); }
