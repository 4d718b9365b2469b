/* Draws a scene with every backend and thread count, and checks that the bytes agree.
 *
 * In:  a stream of random numbers that decides the scene.
 * Out: the status and the hash of the pictures (FNV-1a, 64 bits).
 * Always: outputs are poisoned differently before each run, so that a pixel left unwritten shows.
 */
#pragma once

#include "check/driver/hash.h"
#include "check/driver/random.h"
#include "e3d.h"

typedef struct outcome {
    uint64_t hash;
    e3d_status status;
    int agrees; /* every backend and thread count gave this hash, and no NaN */
} outcome;

/* Which backends and thread counts to try. */
typedef struct run_plan {
    int backends[E3D_BACKEND_COUNT];
    int32_t threads[8];
    int32_t thread_counts;
    int32_t most_side; /* pictures are no wider and no higher; 0: as large as the scene says */
} run_plan;

/* The hash of what is made of an input; 0 where it fails or holds a NaN. */
typedef uint64_t (*hash_of)(const void *input, e3d_backend backend, int32_t threads);

/* Compares the hashes of one input. */
outcome compare_hashes(hash_of find, const void *input, const run_plan *plan, const char *title);
/* The same of what chooses no backend: for each thread count alone. */
outcome compare_thread_counts(hash_of find, const void *input, const run_plan *plan, const char *title);
/* `title` (or NULL for silence) begins the lines that tell standard error what differs. */
outcome compare_scene(random_stream r, const run_plan *plan, const char *title);
/* The same scene, some of whose materials are masked or blended. */
outcome compare_alpha(random_stream r, const run_plan *plan, const char *title);
/* The same scene, most of whose lights have maps of shadows. */
outcome compare_shadows(random_stream r, const run_plan *plan, const char *title);
outcome compare_rasterize(random_stream r, const run_plan *plan, const char *title);
