/* Random and hostile pictures in pyrender's manner for the driver.
 *
 * In:  a stream of random numbers.
 * Out: the hash of their colours and depths; whether every thread count gave it.
 */
#pragma once

#include "check/driver/compare.h"

outcome compare_pyrender(random_stream r, const run_plan *plan, const char *title);
