/* Draws a scene from two eyes, in one call and each by itself, and checks that it comes to the same. */
#pragma once

#include "check/driver/compare.h"
#include "check/driver/random.h"

outcome compare_passes(random_stream r, const run_plan *plan, const char *title);
