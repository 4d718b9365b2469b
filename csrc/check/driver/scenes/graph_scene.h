/* Random scene graphs for the driver: nodes that move, and the tree over their boxes.
 *
 * In:  a stream of random numbers.
 * Out: the hash of world poses, boxes and what a search of the tree finds; whether every thread count gave it.
 */
#pragma once

#include "check/driver/compare.h"

outcome compare_graph(random_stream r, const run_plan *plan, const char *title);
