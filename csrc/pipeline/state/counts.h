/* What became of clusters and triangles, as each thread counts it. */
#ifndef E3D_COUNTS_H
#define E3D_COUNTS_H

#include <stdint.h>

/* What becomes of a cluster: it is transformed and drawn, or left out. */
typedef enum e3d_cull_result {
    E3D_RESULT_DRAWN = 0,
    E3D_RESULT_OUTSIDE,
    E3D_RESULT_BACKFACING,
    E3D_RESULT_OCCLUDED,
    E3D_CULL_RESULTS
} e3d_cull_result;

/* What is known of an instance: one of its clusters was not occluded; one was drawn. */
enum { E3D_MARK_UNOCCLUDED = 1, E3D_MARK_DRAWN = 2 };

typedef struct e3d_counters {
    int64_t blocks; /* that the boxes of the candidates in view may touch */
    int64_t clusters[E3D_CULL_RESULTS], triangles[E3D_CULL_RESULTS]; /* by what became of their cluster */
    int64_t triangles_rejected, triangles_drawn; /* of clusters that show */
    int64_t triangles_clipped, records, bin_entries, shaded;
    int64_t ns_raster, ns_shade, ns_resolve;
} e3d_counters;

#endif
