/* Random pictures through lenses, for the driver.
 *
 * In:  a stream of random numbers.
 * Out: the hash of the colours, or of what the rays meet and the values that are taken from there; whether every backend and
 *      thread count gave them.
 */
#pragma once

#include "check/driver/compare.h"

outcome compare_lens_colors(random_stream r, const run_plan *plan, const char *title);
outcome compare_lens_rays(random_stream r, const run_plan *plan, const char *title);
