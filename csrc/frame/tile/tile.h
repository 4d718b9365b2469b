/* Draws the tiles of a picture, one after the other. */
#pragma once

#include "e3d.h"
#include "frame/tile/job.h"

/* Draws all tiles that hold anything, and clears the others, until memory is out or the poll says stop. */
e3d_status e3d_tiles(const e3d_tiles_in *in, e3d_tiles_out *out);
