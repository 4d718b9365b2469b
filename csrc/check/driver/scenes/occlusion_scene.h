/* Random and hostile pictures of depths for the driver.
 *
 * In:  a stream of random numbers.
 * Out: the hash of their ambient visibility; whether every backend and thread count gave it, and no NaN.
 */
#pragma once

#include "check/driver/compare.h"

outcome compare_occlusion(random_stream r, const run_plan *plan, const char *title);
