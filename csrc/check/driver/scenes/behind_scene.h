/* Random pictures behind glass, for the driver.
 *
 * In:  a stream of random numbers.
 * Out: the hash of all levels of a picture; whether every backend and thread count gave them.
 */
#pragma once

#include "check/driver/compare.h"

outcome compare_behind(random_stream r, const run_plan *plan, const char *title);
