/* vertices: morph targets, then joints, for a run of vertices (R71 to R74).
 *
 * In:  positions and normals at rest, weights of targets, matrices of joints.
 * Out: positions and normals.
 * Always: a vertex at a time, its four columns side by side in vectors of four, which have the same bits on every processor;
 *      lane 3 means nothing.
 */
#include <math.h>
#include <string.h>

#include "core/vectors.h"
#include "posing/rest.h"

enum { RUN = 128 }; /* vertices whose morphed rows stay in the first cache */

#if defined(__clang__)
#define TURNED(v) __builtin_shufflevector(v, v, 1, 2, 0, 3)
#else
#define TURNED(v) __builtin_shuffle(v, (int4){1, 2, 0, 3})
#endif

typedef struct rows {
    float positions[3 * RUN + 4], normals[3 * RUN + 4];
} rows;

/* out = base, then + weight * delta, target after target (R71). */
static void morph(const float *base, const float *deltas, const float *weights, int32_t targets, size_t stride, size_t count,
                  float *restrict out)
{
    memcpy(out, base, count * sizeof *out);
    for (int32_t t = 0; t < targets && deltas; t++) {
        const float *delta = deltas + (size_t)t * stride;
        float weight = weights[t];
        if (weight != 0)
            for (size_t i = 0; i < count; i++)
                out[i] = out[i] + weight * delta[i];
    }
}

/* The cross product: y z x of a * (b turned) - (a turned) * b. */
static inline float4 cross4(float4 a, float4 b)
{
    float4 product = a * TURNED(b) - TURNED(a) * b;
    return TURNED(product);
}

static inline void store3(float *out, float4 v)
{
    out[0] = v[0];
    out[1] = v[1];
    out[2] = v[2];
}

/* Unit length, as in R22. */
static inline float4 unit4(float4 v)
{
    float x = v[0], y = v[1], z = v[2];
    float square = (x * x + y * y) + z * z;
    square = 0x1p-126f > square ? 0x1p-126f : square;
    return v * splat(1.0f / sqrtf(square));
}

/* The blend of the matrices that move a vertex (R72). */
static inline void blend(const e3d_influence *at, const e3d_influence *end, const float *matrices, float4 m[4])
{
    const float *matrix = matrices + at->matrix;
    float4 weight = splat(at->weight);
    for (int k = 0; k < 4; k++)
        m[k] = weight * load4(matrix + 4 * k);
    while (++at < end) {
        matrix = matrices + at->matrix;
        weight = splat(at->weight);
        for (int k = 0; k < 4; k++)
            m[k] = m[k] + weight * load4(matrix + 4 * k);
    }
}

/* Positions by the matrix, normals by its cofactors (R73, R74). */
static void skin(const e3d_rest *rest, const float *matrices, int32_t first, int32_t count, const rows *from, float *positions,
                 float *normals)
{
    for (int32_t v = 0; v < count; v++) {
        const uint32_t *start = rest->starts + first + v;
        const float *p = from->positions + 3 * v, *n = from->normals + 3 * v;
        float4 m[4];
        blend(rest->influences + start[0], rest->influences + start[1], matrices, m);
        store3(positions + 3 * v, ((m[0] * splat(p[0]) + m[1] * splat(p[1])) + m[2] * splat(p[2])) + m[3]);
        if (normals) {
            float4 a = cross4(m[1], m[2]), b = cross4(m[2], m[0]), c = cross4(m[0], m[1]);
            store3(normals + 3 * v, unit4((a * splat(n[0]) + b * splat(n[1])) + c * splat(n[2])));
        }
    }
}

static void copy_rows(const rows *from, int32_t count, int morphed, float *positions, float *normals)
{
    memcpy(positions, from->positions, 3 * (size_t)count * sizeof *positions);
    for (int32_t v = 0; v < count && normals; v++) {
        float4 n = load4(from->normals + 3 * v);
        store3(normals + 3 * v, morphed ? unit4(n) : n);
    }
}

static void pose_run(const e3d_pose_job *job, int32_t first, int32_t count, float *positions, float *normals)
{
    const e3d_rest *rest = job->rest;
    const e3d_pose_desc *d = &rest->desc;
    size_t stride = 3 * (size_t)rest->mesh->desc.vertices, at = 3 * (size_t)first, floats = 3 * (size_t)count;
    int32_t targets = job->weights ? d->targets : 0;
    rows now;
    morph(rest->mesh->desc.positions + at, d->target_positions ? d->target_positions + at : NULL, job->weights, targets, stride,
          floats, now.positions);
    if (normals)
        morph(d->normals + at, d->target_normals ? d->target_normals + at : NULL, job->weights, targets, stride, floats,
              now.normals);
    if (rest->starts && job->matrices)
        skin(rest, job->matrices, first, count, &now, positions + at, normals ? normals + at : NULL);
    else
        copy_rows(&now, count, targets && d->target_normals, positions + at, normals ? normals + at : NULL);
}

void e3d_pose_vertices(const e3d_pose_job *job, int32_t first, int32_t count, float *positions, float *normals)
{
    for (int32_t end = first + count; first < end; first += RUN)
        pose_run(job, first, end - first < RUN ? end - first : RUN, positions, normals);
}
