/* vertices: applies morph targets, then joints, to a run of vertices (R71 to R74).
 * In: positions, normals and tangents at rest, weights of targets, matrices of joints. Out: positions, normals and tangents.
 * Always: one vertex at a time, its four columns in vectors of four, which have the same bits on every processor; lane 3
 * means nothing. */
#include <string.h>

#include "base/vectors.h"
#include "scene/posing/rest.h"

enum { RUN = 128 }; /* so many vertices that their morphed rows stay in the first-level cache */

#define TURNED(v) LANES(v, v, 1, 2, 0, 3)

typedef struct rows {
    float positions[3 * RUN + 4], normals[3 * RUN + 4];
} rows;

/* out = base, then + weight * delta, target after target (R71); returns out. */
static const float *morph(const float *base, const float *deltas, const float *weights, int32_t targets, size_t stride,
                          size_t count, float *restrict out)
{
    memcpy(out, base, count * sizeof *out);
    for (int32_t t = 0; t < targets; t++) {
        const float *delta = deltas + (size_t)t * stride;
        float weight = weights[t];
        if (weight != 0)
            for (size_t i = 0; i < count; i++)
                out[i] = out[i] + weight * delta[i];
    }
    return out;
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

/* Stores rows of vertices; the last one's fourth lane is not written. */
static inline void store_rows(float *out, const float4 row[4], int count)
{
    for (int i = 0; i < count - 1; i++)
        store4(out + 3 * i, row[i]);
    store3(out + 3 * (count - 1), row[count - 1]);
}

/* Normalises, as in R22. */
static inline void make_unit(float4 row[4])
{
    float4 column[3], least = splat(0x1p-126f);
    columns_of(row, column);
    float4 square = (column[0] * column[0] + column[1] * column[1]) + column[2] * column[2];
    float4 factor = splat(1) / root_of(choose(least > square, least, square));
    for (int i = 0; i < 4; i++)
        row[i] = row[i] * splat(factor[i]);
}

/* Blends the matrices that move a vertex (R72). */
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

/* Transforms four vertices at a time, or the rest: positions by the matrix, normals by its cofactors (R73, R74). */
static inline void skin_four(const e3d_rest *rest, const float *matrices, int32_t first, int count, const float *p,
                             const float *n, float *positions, float *normals)
{
    float4 point[4] = {{0}}, normal[4] = {{0}};
    for (int i = 0; i < count; i++, p += 3) {
        const uint32_t *start = rest->starts + first + i;
        float4 m[4];
        blend(rest->influences + start[0], rest->influences + start[1], matrices, m);
        point[i] = ((m[0] * splat(p[0]) + m[1] * splat(p[1])) + m[2] * splat(p[2])) + m[3];
        if (normals) {
            float4 a = cross4(m[1], m[2]), b = cross4(m[2], m[0]), c = cross4(m[0], m[1]);
            normal[i] = (a * splat(n[3 * i]) + b * splat(n[3 * i + 1])) + c * splat(n[3 * i + 2]);
        }
    }
    store_rows(positions, point, count);
    if (normals) {
        make_unit(normal);
        store_rows(normals, normal, count);
    }
}

static void skin(const e3d_rest *rest, const float *matrices, int32_t first, int32_t count, const float *p, const float *n,
                 float *positions, float *normals)
{
    int32_t v = 0;
    for (; v + 4 <= count; v += 4)
        skin_four(rest, matrices, first + v, 4, p + 3 * v, n + 3 * v, positions + 3 * v, normals ? normals + 3 * v : NULL);
    if (v < count)
        skin_four(rest, matrices, first + v, count - v, p + 3 * v, n + 3 * v, positions + 3 * v, normals ? normals + 3 * v : NULL);
}

static void unit_rows(const float *from, int32_t count, float *out)
{
    for (int32_t v = 0; v < count; v += 4) {
        float4 row[4] = {{0}};
        int some = count - v < 4 ? count - v : 4;
        for (int i = 0; i < some; i++)
            row[i] = load4(from + 3 * (v + i));
        make_unit(row);
        store_rows(out + 3 * v, row, some);
    }
}

/* Transforms tangents by the upper left part of the matrix, and normalises them; the sign of the bitangent stays (R74). */
static void skin_tangents(const e3d_rest *rest, const float *matrices, int32_t first, int32_t count, const float *from, float *out)
{
    for (int32_t v = 0; v < count; v += 4) {
        float4 row[4] = {{0}};
        int some = count - v < 4 ? count - v : 4;
        for (int i = 0; i < some; i++) {
            const float *t = from + 4 * (v + i);
            row[i] = load4(t);
            if (matrices) {
                const uint32_t *start = rest->starts + first + v + i;
                float4 m[4];
                blend(rest->influences + start[0], rest->influences + start[1], matrices, m);
                row[i] = (m[0] * splat(t[0]) + m[1] * splat(t[1])) + m[2] * splat(t[2]);
            }
        }
        make_unit(row);
        for (int i = 0; i < some; i++) {
            store3(out + 4 * (v + i), row[i]);
            out[4 * (v + i) + 3] = from[4 * (v + i) + 3];
        }
    }
}

/* out = base + weight * delta in x, y and z of rows of four (R71); returns out. */
static const float *morph_tangents(const e3d_pose_job *job, int32_t first, int32_t count, float *restrict out)
{
    const e3d_pose_desc *d = &job->rest->desc;
    memcpy(out, d->tangents + 4 * (size_t)first, 4 * (size_t)count * sizeof *out);
    for (int32_t t = 0; t < d->targets; t++) {
        const float *delta = d->target_tangents + 3 * ((size_t)t * (size_t)job->rest->mesh->desc.vertices + (size_t)first);
        float weight = job->weights[t];
        for (int32_t v = 0; weight != 0 && v < count; v++)
            for (int k = 0; k < 3; k++)
                out[4 * v + k] = out[4 * v + k] + weight * delta[3 * v + k];
    }
    return out;
}

static void pose_tangents(const e3d_pose_job *job, int32_t first, int32_t count, float *out)
{
    const e3d_pose_desc *d = &job->rest->desc;
    int turned = job->weights && d->targets && d->target_tangents;
    const float *matrices = job->rest->starts ? job->matrices : NULL;
    float now[4 * RUN];
    const float *from = turned ? morph_tangents(job, first, count, now) : d->tangents + 4 * (size_t)first;
    if (matrices || turned)
        skin_tangents(job->rest, matrices, first, count, from, out + 4 * (size_t)first);
    else
        memcpy(out + 4 * (size_t)first, from, 4 * (size_t)count * sizeof *out);
}

static void pose_run(const e3d_pose_job *job, int32_t first, int32_t count, float *positions, float *normals)
{
    const e3d_rest *rest = job->rest;
    const e3d_pose_desc *d = &rest->desc;
    size_t stride = 3 * (size_t)rest->mesh->desc.vertices, at = 3 * (size_t)first, floats = 3 * (size_t)count;
    const float *p = rest->mesh->desc.positions + at, *n = normals ? d->normals + at : p;
    int moved = job->weights && d->targets, turned = moved && normals && d->target_normals;
    rows now;
    if (moved && d->target_positions)
        p = morph(p, d->target_positions + at, job->weights, d->targets, stride, floats, now.positions);
    if (turned)
        n = morph(n, d->target_normals + at, job->weights, d->targets, stride, floats, now.normals);
    if (rest->starts && job->matrices) {
        skin(rest, job->matrices, first, count, p, n, positions + at, normals ? normals + at : NULL);
        return;
    }
    memcpy(positions + at, p, floats * sizeof *p);
    if (turned)
        unit_rows(n, count, normals + at);
    else if (normals)
        memcpy(normals + at, n, floats * sizeof *n);
}

void e3d_pose_vertices(const e3d_pose_job *job, int32_t first, int32_t count, const e3d_posed_arrays *out)
{
    for (int32_t end = first + count; first < end; first += RUN) {
        int32_t some = end - first < RUN ? end - first : RUN;
        pose_run(job, first, some, out->positions, out->normals);
        if (out->tangents)
            pose_tangents(job, first, some, out->tangents);
    }
}
