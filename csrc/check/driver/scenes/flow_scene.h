/* Random optical flow, for the driver.
 *
 * In:  a stream of random numbers.
 * Out: the hash of points, places and marks; whether every thread count gave them.
 */
#pragma once

#include "check/driver/compare.h"

outcome compare_flow(random_stream r, const run_plan *plan, const char *title);
