/* Random and hostile pictures in MuJoCo's manner for the driver.
 *
 * In:  a stream of random numbers.
 * Out: the hash of their colours, or of geoms and depths; whether every backend and thread count gave it.
 */
#pragma once

#include "check/driver/compare.h"

outcome compare_mujoco(random_stream r, const run_plan *plan, const char *title);
