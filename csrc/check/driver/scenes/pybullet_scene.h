/* Random and hostile pictures in TinyRenderer's manner for the driver.
 *
 * In:  a stream of random numbers.
 * Out: the hash of their colours, depths and masks; whether every thread count gave it.
 */
#pragma once

#include "check/driver/compare.h"

outcome compare_pybullet(random_stream r, const run_plan *plan, const char *title);
