/* Random and hostile 2-D drawing for the driver and the fuzzer.
 *
 * In:  a stream of random numbers.
 * Out: the hash of the framebuffer; whether both triangle fills gave it, no byte beside a row was touched, and each glyph of the
 *      font was closed.
 */
#pragma once

#include "check/driver/compare.h"

enum { CANVAS_SIDE = 80,
       CANVAS_CALLS = 40 };

/* Up to so many pixels wide and high, with so many calls. */
outcome compare_canvas(random_stream r, int32_t most_side, int calls, const char *title);
