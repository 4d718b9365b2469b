/* How far the surfaces of a batch shift what is behind them, and how much they blur it. */
#pragma once

#include "frame/shade/job.h"

/* Finds the bends of a batch that is lit already. */
void e3d_find_bends(const e3d_steps *s);
