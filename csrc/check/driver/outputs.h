/* Draws a scene for one output after another, and checks that each is what it is beside all others. */
#pragma once

#include "check/driver/compare.h"

outcome compare_outputs(random_stream r, const run_plan *plan, const char *title);
