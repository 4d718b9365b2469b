/* The outputs of a batch: its colours as the radiance, and those other than colour. */
#pragma once

#include "kernels/types/shading.h"
#include "frame/shade/job.h"
#include "frame/store/store.h"

void e3d_outputs_radiance(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *out);
void e3d_outputs_batch(const e3d_store *store, const e3d_bucket *bucket, e3d_shade_memory *memory, e3d_store_memory *out);
