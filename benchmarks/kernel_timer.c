/* Times the kernels of one instruction set; compiler_flags.py builds it once for each set of flags.
 *
 * In:  -DE3D_TABLE=the table of kernels, -DCPU_FEATURE=what compilers call it (on x86-64).
 * Out: for each kernel a line "name elements seconds hash": the fastest of the repetitions, and a hash
 *      of the output (FNV-1a), which must be the same for every way to build. Exit status 3 where the
 *      CPU lacks the instructions.
 */
#include <stdio.h>
#include <time.h>

#include "base/fpenv.h"
#include "base/limits.h"
#include "check/driver/random.h"
#include "kernels/coverage.h"
#include "kernels/kernels.h"
#ifdef CPU_FEATURE
#include "base/instructions.h"
#endif

enum { TEXTURE_SIDE = 256, TEXTURE_LEVELS = 3, COLORS = 4096, LIGHTS = 3 };

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
                     transform_work.matrix, &transform_work.viewport, 0, &transform_work.out);
}

/* ---- record and visible: triangles in one tile ---- */

enum { CLUSTERS = 12, TRIANGLES = E3D_CLUSTER_VERTICES / 3, PIECES = CLUSTERS * TRIANGLES };

typedef struct raster_work {
    e3d_vertices vertices[CLUSTERS];
    e3d_record records[PIECES + E3D_PAD]; /* kernels write whole vectors */
    uint32_t ids[PIECES];
    int count;
    _Alignas(64) e3d_visible_tile tile;
} raster_work;

static raster_work large_work, small_work;

static struct {
    uint8_t indices[3 * E3D_CLUSTER_TRIANGLES], triangles[E3D_CLUSTER_TRIANGLES + E3D_PAD];
    int32_t faces[E3D_CLUSTER_TRIANGLES];
} cluster;

static const e3d_viewport TILE_VIEWPORT = {E3D_TILE, E3D_TILE, 128.0f * E3D_TILE, 128.0f * E3D_TILE, 1024.0f, 1024.0f};

static void record_all(raster_work *work)
{
    e3d_tile_rect spans[E3D_CLUSTER_TRIANGLES];
    work->count = 0;
    for (int c = 0; c < CLUSTERS; c++) {
        const e3d_record_request request = {.vertices = &work->vertices[c], .indices = cluster.indices,
                                            .triangles = cluster.triangles, .count = TRIANGLES, .tiny = 1,
                                            .order = (uint32_t)(c * TRIANGLES), .faces = cluster.faces,
                                            .viewport = &TILE_VIEWPORT};
        work->count += table->record(&request, work->records + work->count, spans);
    }
}

static void make_corner(random_stream *r, const float centre[2], float extent, e3d_vertices *v, int i)
{
    v->sx[i] = (int32_t)(256.0f * (centre[0] + random_float(r, -extent, extent)));
    v->sy[i] = (int32_t)(256.0f * (centre[1] + random_float(r, -extent, extent)));
    v->zn[i] = random_float(r, 0.0f, 1.0f);
    v->iw[i] = 1.0f;
}

/* Triangles of about `extent` samples, anywhere in the tile. */
static void make_raster(random_stream *r, float extent, raster_work *work)
{
    for (int t = 0; t < TRIANGLES; t++) {
        cluster.triangles[t] = (uint8_t)t;
        cluster.faces[t] = t;
        for (int k = 0; k < 3; k++)
            cluster.indices[k * E3D_CLUSTER_TRIANGLES + t] = (uint8_t)(3 * t + k);
    }
    for (int i = 0; i < PIECES; i++) {
        const float centre[2] = {random_float(r, 0.0f, E3D_TILE), random_float(r, 0.0f, E3D_TILE)};
        work->vertices[i / TRIANGLES].count = 3 * TRIANGLES;
        for (int k = 0; k < 3; k++)
            make_corner(r, centre, extent, &work->vertices[i / TRIANGLES], i % TRIANGLES * 3 + k);
    }
    record_all(work);
    for (int i = 0; i < work->count; i++)
        work->ids[i] = (uint32_t)i;
}

static long covered_samples(const raster_work *work)
{
    long covered = 0;
    for (int i = 0; i < work->count; i++)
        for (int y = 0; y < E3D_TILE; y++)
            for (int x = 0; x < E3D_TILE; x++) {
                int inside = 1;
                for (int k = 0; k < 3; k++)
                    inside &= e3d_edge_at(&work->records[i], k, x, y).e >= 0;
                covered += inside;
            }
    return covered;
}

static void draw_all(raster_work *work)
{
    const e3d_record *const records[1] = {work->records};
    const e3d_record_table records_of = {records, 0};
    e3d_visible_tile *tile = &work->tile;
    for (int b = 0; b < E3D_TILE_BLOCKS; b++) {
        tile->zmin[b] = tile->zmax[b] = E3D_BEYOND_FAR;
        tile->noted_id[b] = E3D_NO_SLOT;
    }
    tile->noted = ~(uint64_t)0;
    tile->stale = 0;
    table->raster_visible(tile, &records_of, work->ids, work->count);
    table->raster_settle(tile, &records_of, 1);
}

static void run_record(void) { record_all(&small_work); }
static void run_visible_large(void) { draw_all(&large_work); }
static void run_visible_small(void) { draw_all(&small_work); }

/* ---- texture and light: one batch ---- */

static struct {
    uint16_t texels[4 * (TEXTURE_SIDE + 2) * (TEXTURE_SIDE + 2) * 2];
    e3d_texture_view texture;
    e3d_light lights[LIGHTS];
    float reach[5][LIGHTS + E3D_PAD], shown[LIGHTS][3];
    e3d_lighting lighting;
    e3d_batch batch;
} shade_work;

static void make_texture(random_stream *r)
{
    e3d_texture_view *view = &shade_work.texture;
    uint16_t *texels = shade_work.texels;
    for (size_t i = 0; i < sizeof shade_work.texels / sizeof *texels; i++)
        texels[i] = (uint16_t)(random_bits(r) & 0x7FFF); /* 15 bits (R28) */
    *view = (e3d_texture_view){.level_count = TEXTURE_LEVELS, .channel_bits = 16, .filter = E3D_TRILINEAR, .anisotropy = 1, .level_scale = 1.0f};
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
            light->color[k] = random_float(r, 0.6f, 3.2f);
            shade_work.shown[n][k] = light->color[k] * E3D_OVER_PI;
            shade_work.reach[k][n] = light->position[k] = random_float(r, -4.0f, 4.0f);
        }
        shade_work.reach[3][n] = light->range * light->range;
        shade_work.reach[4][n] = 1.0f / shade_work.reach[3][n];
    }
    shade_work.lighting = (e3d_lighting){.lights = shade_work.lights,
                                         .light_count = LIGHTS,
                                         .shown = (const float (*)[3])shade_work.shown,
                                         .ambient = {0.1f, 0.1f, 0.1f},
                                         .clamp = {0.0f, 100.0f},
                                         .eye = {0.0f, 0.0f, 5.0f, 1.0f}};
    for (int row = 0; row < 5; row++)
        shade_work.lighting.reach[row] = shade_work.reach[row];
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
    table->texture(&shade_work.batch, NULL, &shade_work.texture, white); /* no surfaces: it is not anisotropic */
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
    if (!e3d_has_instructions(CPU_FEATURE))
        return 3;
#endif
    random_stream r = {.state = 1};
    make_transform(&r);
    make_raster(&r, 40.0f, &large_work);
    make_raster(&r, 4.0f, &small_work);
    make_texture(&r);
    make_lights(&r);
    make_batch(&r);
    make_colors(&r);
    const workload works[] = {
        {"transform", E3D_CLUSTER_VERTICES, run_transform, transform_work.out.x,
         sizeof(float) * E3D_CLUSTER_VERTICES},
        {"record", PIECES, run_record, small_work.records, sizeof(e3d_record) * (size_t)small_work.count},
        {"visible_large", covered_samples(&large_work), run_visible_large, large_work.tile.id,
         sizeof(int32_t) * E3D_TILE_SAMPLES},
        {"visible_small", small_work.count, run_visible_small, small_work.tile.z,
         sizeof(float) * E3D_TILE_SAMPLES},
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
