/* Random light that glows, for the driver.
 *
 * In:  a stream of random numbers.
 * Out: the hash of a picture with bloom; whether every backend and thread count gave it.
 */
#pragma once

#include "check/driver/compare.h"

outcome compare_bloom(random_stream r, const run_plan *plan, const char *title);
