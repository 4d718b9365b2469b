/* Sums up what the threads counted. */
#pragma once

#include "e3d.h"
#include "frame/run/renderer.h"
#include "frame/pass/prepared.h"

/* Counts what the frame submits, and counts all of it as drawn. */
void e3d_count_submitted(const e3d_frame *frame, e3d_stats *stats);
void e3d_count(const e3d_prepared *pass, const e3d_renderer *renderer, e3d_stats *stats);
