/* Times the kernels of one instruction set; compiler_flags.py builds it once for each set of flags.
 *
 * In:  -DE3D_TABLE=the table of kernels, -DCPU_FEATURE=what __builtin_cpu_supports calls it (on x86-64).
 * Out: for each kernel a line "name elements seconds hash": the fastest of the repetitions, and a hash
 *      of the output (FNV-1a), which must be the same for every way to build. Exit status 3 where the
 *      CPU lacks the instructions.
 */
#include <stdio.h>
#include <time.h>

#include "core/fpenv.h"
#include "driver/random.h"
#include "kernels/kernels.h"

enum { PIECES = 512, TEXTURE_SIDE = 256, TEXTURE_LEVELS = 3, COLORS = 4096, LIGHTS = 3 };

/* One repetition lasts at least this long, in seconds; the fastest of REPETITIONS counts. */
#define ENOUGH 0.002
enum { REPETITIONS = 9 };

typedef struct workload {
    const char *name;
    long elements; /* in one run */
    void (*run)(void);
    const void *output;
    size_t output_size;
} workload;

static const e3d_kernels *const table = &E3D_TABLE;

/* ---- transform: one cluster's vertices ---- */

static struct {
    float positions[3 * E3D_CLUSTER_VERTICES + E3D_PAD], matrix[16];
    e3d_viewport viewport;
    e3d_vertices out;
} transform_work;

static void make_transform(random_stream *r)
{
    for (int i = 0; i < 3 * E3D_CLUSTER_VERTICES; i++)
        transform_work.positions[i] = random_float(r, -1.0f, 1.0f);
    for (int i = 0; i < 16; i++)
        transform_work.matrix[i] = random_float(r, -0.3f, 0.3f) + (float)(i % 5 == 0);
    transform_work.matrix[15] = 4.0f;
    transform_work.viewport = (e3d_viewport){1280, 720, 128.0f * 1280, 128.0f * 720, 32.0f, 64.0f};
}

static void run_transform(void)
{
    table->transform(transform_work.positions, E3D_CLUSTER_VERTICES, E3D_CLUSTER_VERTICES,
                     transform_work.matrix, &transform_work.viewport, &transform_work.out);
}

/* ---- raster: triangles in one tile ---- */

static struct {
    e3d_piece pieces[2][PIECES]; /* large and small ones */
    uint32_t orders[PIECES];
    _Alignas(64) float z[E3D_TILE_SAMPLES];
    _Alignas(64) int32_t slot[E3D_TILE_SAMPLES];
} raster_work;

static int32_t floor_shift(int64_t value)
{
    return (int32_t)(value >> 8); /* rounds down, of negative values too */
}

/* R12 for the edge a -> b of a triangle that turns clockwise. */
static void make_edge(e3d_piece *piece, int k, const int32_t a[2], const int32_t b[2])
{
    int32_t dx = b[0] - a[0], dy = b[1] - a[1];
    int top_left = dy < 0 || (dy == 0 && dx > 0);
    int64_t e = (int64_t)dx * (128 - a[1]) - (int64_t)dy * (128 - a[0]) - !top_left;
    piece->e[k] = floor_shift(e);
    piece->a[k] = -dy;
    piece->b[k] = dx;
}

static int32_t clamped_sample(int32_t position)
{
    int32_t sample = position >> 8;
    return sample < 0 ? 0 : sample > E3D_TILE - 1 ? E3D_TILE - 1 : sample;
}

static void make_piece(random_stream *r, float extent, uint32_t slot, e3d_piece *piece)
{
    int32_t v[3][2], low[2], high[2];
    float centre[2];
    int64_t area = 0;
    while (area == 0) {
        for (int axis = 0; axis < 2; axis++) {
            centre[axis] = random_float(r, 0.0f, E3D_TILE);
            for (int i = 0; i < 3; i++)
                v[i][axis] = (int32_t)(256.0f * (centre[axis] + random_float(r, -extent, extent)));
        }
        area = (int64_t)(v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) -
               (int64_t)(v[2][0] - v[0][0]) * (v[1][1] - v[0][1]);
    }
    for (int k = 0; k < 3; k++) {
        int from = area > 0 ? k : 2 - k, to = area > 0 ? (k + 1) % 3 : (4 - k) % 3;
        make_edge(piece, k, v[from], v[to]);
    }
    for (int axis = 0; axis < 2; axis++) {
        low[axis] = high[axis] = v[0][axis];
        for (int i = 1; i < 3; i++) {
            low[axis] = v[i][axis] < low[axis] ? v[i][axis] : low[axis];
            high[axis] = v[i][axis] > high[axis] ? v[i][axis] : high[axis];
        }
    }
    piece->x0 = clamped_sample(low[0]);
    piece->x1 = clamped_sample(high[0]);
    piece->y0 = clamped_sample(low[1]);
    piece->y1 = clamped_sample(high[1]);
    piece->z0 = random_float(r, 0.0f, 1.0f);
    piece->gx = random_float(r, -0.01f, 0.01f);
    piece->gy = random_float(r, -0.01f, 0.01f);
    piece->zmin = -1.0f;
    piece->zmax = 1.0f;
    piece->slot = slot;
}

static void make_raster(random_stream *r)
{
    for (uint32_t i = 0; i < PIECES; i++) {
        make_piece(r, 40.0f, i, &raster_work.pieces[0][i]);
        make_piece(r, 4.0f, i, &raster_work.pieces[1][i]);
        raster_work.pieces[0][i].order = raster_work.pieces[1][i].order = i;
        raster_work.orders[i] = i;
    }
}

static long covered_samples(const e3d_piece *piece)
{
    long covered = 0;
    for (int y = piece->y0; y <= piece->y1; y++)
        for (int x = piece->x0; x <= piece->x1; x++) {
            int inside = 1;
            for (int k = 0; k < 3; k++)
                inside &= piece->e[k] + piece->a[k] * x + piece->b[k] * y >= 0;
            covered += inside;
        }
    return covered;
}

static long covered_by_all(void)
{
    long covered = 0;
    for (int i = 0; i < PIECES; i++)
        covered += covered_samples(&raster_work.pieces[0][i]);
    return covered;
}

static void raster_all(const e3d_piece *pieces)
{
    const e3d_tile_buffers tile = {raster_work.z, raster_work.slot, raster_work.orders};
    for (int i = 0; i < E3D_TILE_SAMPLES; i++) {
        raster_work.z[i] = 2.0f;
        raster_work.slot[i] = E3D_NO_SLOT;
    }
    for (int i = 0; i < PIECES; i++)
        table->raster_depth(&pieces[i], &tile);
}

static void run_raster_large(void) { raster_all(raster_work.pieces[0]); }
static void run_raster_small(void) { raster_all(raster_work.pieces[1]); }

/* ---- texture and light: one batch ---- */

static struct {
    uint16_t texels[4 * (TEXTURE_SIDE + 2) * (TEXTURE_SIDE + 2) * 2];
    e3d_texture_view texture;
    e3d_light lights[LIGHTS];
    e3d_lighting lighting;
    e3d_batch batch;
} shade_work;

static void make_texture(random_stream *r)
{
    e3d_texture_view *view = &shade_work.texture;
    uint16_t *texels = shade_work.texels;
    for (size_t i = 0; i < sizeof shade_work.texels / sizeof *texels; i++)
        texels[i] = (uint16_t)random_bits(r);
    *view = (e3d_texture_view){.level_count = TEXTURE_LEVELS, .texel_bytes = 8, .filter = E3D_TRILINEAR};
    for (int l = 0, side = TEXTURE_SIDE; l < TEXTURE_LEVELS; l++, side /= 2) {
        view->levels[l] = (e3d_level){texels, side, side};
        texels += 4 * (side + 2) * (side + 2);
    }
}

static void make_lights(random_stream *r)
{
    for (int n = 0; n < LIGHTS; n++) {
        e3d_light *light = &shade_work.lights[n];
        *light = (e3d_light){.kind = n == 0 ? E3D_LIGHT_DIRECTIONAL : E3D_LIGHT_POINT,
                             .to_light = {0.36f, 0.48f, 0.8f},
                             .range = 100.0f};
        for (int k = 0; k < 3; k++) {
            light->color[k] = random_float(r, 0.2f, 1.0f);
            light->position[k] = random_float(r, -4.0f, 4.0f);
        }
    }
    shade_work.lighting = (e3d_lighting){.lights = shade_work.lights,
                                         .light_count = LIGHTS,
                                         .ambient = {0.1f, 0.1f, 0.1f},
                                         .clamp = {0.0f, 100.0f},
                                         .eye = {0.0f, 0.0f, 5.0f, 1.0f}};
}

static void make_batch(random_stream *r)
{
    e3d_batch *batch = &shade_work.batch;
    batch->count = E3D_BATCH;
    for (int i = 0; i < E3D_BATCH; i++) {
        for (int k = 0; k < 3; k++) {
            batch->position[k][i] = random_float(r, -1.0f, 1.0f);
            batch->normal[k][i] = k == i % 3 ? 1.0f : 0.0f;
        }
        batch->uv[0][i] = random_float(r, -1.0f, 2.0f);
        batch->uv[1][i] = random_float(r, -1.0f, 2.0f);
        batch->lod[i] = random_below(r, 256 * (TEXTURE_LEVELS - 1));
    }
}

static void run_texture(void)
{
    const float white[3] = {1.0f, 1.0f, 1.0f};
    table->texture(&shade_work.batch, &shade_work.texture, white);
}

static void run_light(void) { table->light(&shade_work.batch, &shade_work.lighting, 32.0f); }

/* ---- encode: rows of colours to sRGB bytes ---- */

static struct {
    float planes[3][COLORS + E3D_PAD];
    uint32_t rgba[COLORS + E3D_PAD];
} encode_work;

static void make_colors(random_stream *r)
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < COLORS; i++)
            encode_work.planes[k][i] = random_float(r, 0.0f, 1.0f);
}

static void run_encode(void)
{
    table->encode(encode_work.planes[0], encode_work.planes[1], encode_work.planes[2], COLORS, 1,
                  encode_work.rgba);
}

/* ---- the clock ---- */

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static double seconds_of(void (*run)(void), long rounds)
{
    double start = now();
    for (long i = 0; i < rounds; i++)
        run();
    return now() - start;
}

static uint64_t hash_of(const workload *work)
{
    const uint8_t *bytes = work->output;
    uint64_t hash = 0xCBF29CE484222325u;
    for (size_t i = 0; i < work->output_size; i++)
        hash = (hash ^ bytes[i]) * 0x100000001B3u;
    return hash;
}

static void report(const workload *work)
{
    long rounds = 1;
    double best = seconds_of(work->run, rounds);
    uint64_t hash = hash_of(work);
    while (seconds_of(work->run, rounds) < ENOUGH)
        rounds *= 2;
    for (int i = 0; i < REPETITIONS; i++) {
        double seconds = seconds_of(work->run, rounds) / (double)rounds;
        best = seconds < best ? seconds : best;
    }
    printf("%s %ld %.9g %016llx\n", work->name, work->elements, best, (unsigned long long)hash);
}

int main(void)
{
#ifdef CPU_FEATURE
    if (!__builtin_cpu_supports(CPU_FEATURE))
        return 3;
#endif
    random_stream r = {.state = 1};
    make_transform(&r);
    make_raster(&r);
    make_texture(&r);
    make_lights(&r);
    make_batch(&r);
    make_colors(&r);
    const workload works[] = {
        {"transform", E3D_CLUSTER_VERTICES, run_transform, transform_work.out.x,
         sizeof(float) * E3D_CLUSTER_VERTICES},
        {"raster_large", covered_by_all(), run_raster_large, raster_work.slot,
         sizeof raster_work.slot},
        {"raster_small", PIECES, run_raster_small, raster_work.z, sizeof raster_work.z},
        {"texture", E3D_BATCH, run_texture, shade_work.batch.color[0], sizeof(float) * E3D_BATCH},
        {"light", E3D_BATCH, run_light, shade_work.batch.shine[0], sizeof(float) * E3D_BATCH},
        {"encode", COLORS, run_encode, encode_work.rgba, sizeof(uint32_t) * COLORS},
    };
    e3d_fpenv saved = e3d_fpenv_enter();
    for (size_t i = 0; i < sizeof works / sizeof *works; i++)
        report(&works[i]);
    e3d_fpenv_leave(saved);
    return 0;
}
