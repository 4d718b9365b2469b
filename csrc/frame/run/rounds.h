/* Rounds draw first what is near or was seen in the last frames, for it hides what is behind it. */
#pragma once

#include "e3d.h"
#include "frame/run/prepare.h"

/* Draws the pass's geometry in as many rounds as pay. Tiles may be finished meanwhile; e3d_tiles() draws what the last round
 * left in their bins. */
e3d_status e3d_rounds(const e3d_context *context, e3d_stats *stats);
