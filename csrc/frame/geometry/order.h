/* Sorts a frame's records, where the last one wins. */
#pragma once

#include "frame/geometry/bin.h"
#include "frame/pass/prepared.h"

/* Sorts the records of all threads, and bins them as those of the first thread; 0 when memory is out. */
int e3d_sort_records(const e3d_prepared *pass, e3d_bins *bins);
