/* Random and hostile lists of a user interface's triangles for the driver and the fuzzer.
 *
 * In:  a stream of random numbers.
 * Out: the hash of the picture; whether every backend gave it, and no byte beside a row was touched.
 */
#pragma once

#include "check/driver/compare.h"

outcome compare_ui(random_stream r, const run_plan *plan, const char *title);
