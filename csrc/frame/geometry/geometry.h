/* Turns the candidates of a round, cluster by cluster, into records and fragments in bins. */
#pragma once

#include "frame/geometry/round.h"

/* 0 when memory is out. */
int e3d_geometry(const e3d_geometry_in *in, const e3d_geometry_out *out);
