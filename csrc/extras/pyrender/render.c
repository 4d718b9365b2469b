/* A picture in pyrender's manner: vertices, then bands of rows, each through all steps (docs/exactness, section 24).
 *
 * In: a frame. Out: its colors and depths. Always: a band is one thread's; the bytes are the same for any number of threads.
 */
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/fpenv.h"
#include "base/large_pages.h"
#include "base/pool.h"
#include "data/sample_patterns.h"
#include "e3d_renderer.h"
#include "extras/pyrender/picture.h"
#include "extras/pyrender/transfer_tables.h"

enum { VERTICES_AT_A_TIME = 4096 };

#define LITTLE ((size_t)1 << 20) /* smaller requests are allocated as they are; larger ones are rounded up, to fill large pages */

struct e3d_pyr_memory {
    pyr_vertex *vertices; /* kept, since fresh memory for each picture would take longer than the transformation */
    size_t room;
};

typedef struct render_job {
    pyr_picture picture;
    e3d_pyr_memory *memory;
    pyr_band *bands;   /* of each thread */
    int32_t *chunks;   /* where each draw's chunks of vertices begin */
    int threads;
    atomic_int next_chunk, next_band;
} render_job;

/* ---- what shows ---- */

static void mark_places(const e3d_pyr_frame *frame, const e3d_pyr_step *step, int place, uint8_t *shows)
{
    size_t pixels = (size_t)frame->width * (size_t)frame->height;
    int32_t last = -1;
    for (size_t i = 0; i < pixels; i++) {
        int32_t object = step->object_id[place][i];
        if (object < 0 || (object == last && !step->instance_id[place]))
            continue;
        last = object;
        shows[step->draw_of_object[object] + (step->instance_id[place] ? step->instance_id[place][i] : 0)] = 1;
    }
}

static void mark_shown(const pyr_picture *picture, uint8_t *shows)
{
    const e3d_pyr_frame *frame = picture->frame;
    for (int32_t s = 0; s < frame->step_count; s++) {
        const e3d_pyr_step *step = &frame->steps[s];
        if (step->face_id[0] && !step->object_id[0])
            shows[step->draw_of_object[0]] = 1;
        else if (!step->face_id[0])
            memset(shows + step->first_draw, 1, (size_t)step->draw_count);
        else
            for (int p = 0; p < picture->places; p++)
                mark_places(frame, step, p, shows);
    }
}

/* ---- vertices ---- */

e3d_pyr_memory *e3d_pyr_memory_new(void) { return calloc(1, sizeof(e3d_pyr_memory)); }

void e3d_pyr_memory_free(e3d_pyr_memory *memory)
{
    if (memory)
        free(memory->vertices);
    free(memory);
}

static int reserve_vertices(e3d_pyr_memory *memory, size_t count)
{
    size_t bytes = (count ? count : 1) * sizeof *memory->vertices;
    if (count <= memory->room && memory->vertices)
        return 1;
    if (bytes > LITTLE)
        bytes = (bytes + E3D_LARGE_ROOM - 1) / E3D_LARGE_ROOM * E3D_LARGE_ROOM;
    free(memory->vertices);
    memory->vertices = e3d_large_memory(bytes);
    memory->room = memory->vertices ? bytes / sizeof *memory->vertices : 0;
    return memory->vertices != NULL;
}

static int place_vertices(render_job *job, const uint8_t *shows)
{
    const e3d_pyr_frame *frame = job->picture.frame;
    size_t count = 0;
    job->chunks[0] = 0;
    for (int32_t d = 0; d < frame->draw_count; d++) {
        int32_t vertices = shows[d] ? frame->draws[d].vertices : 0;
        count += (size_t)vertices;
        job->chunks[d + 1] = job->chunks[d] + (vertices + VERTICES_AT_A_TIME - 1) / VERTICES_AT_A_TIME;
    }
    if (!reserve_vertices(job->memory, count))
        return 0;
    pyr_vertex *next = job->memory->vertices;
    for (int32_t d = 0; d < frame->draw_count; d++) {
        job->picture.vertices[d] = shows[d] ? next : NULL;
        next += shows[d] ? frame->draws[d].vertices : 0;
    }
    return 1;
}

static void transform_chunks(void *argument, int worker)
{
    render_job *job = argument;
    const e3d_pyr_frame *frame = job->picture.frame;
    (void)worker;
    int32_t draw = 0;
    for (;;) {
        int32_t chunk = atomic_fetch_add(&job->next_chunk, 1);
        while (draw < frame->draw_count && job->chunks[draw + 1] <= chunk)
            draw++;
        if (draw == frame->draw_count)
            return;
        int32_t first = (chunk - job->chunks[draw]) * VERTICES_AT_A_TIME, end = first + VERTICES_AT_A_TIME;
        int32_t vertices = frame->draws[draw].vertices;
        pyr_transform(frame, &frame->draws[draw], first, end < vertices ? end : vertices, job->picture.vertices[draw]);
    }
}

/* ---- bands ---- */

static void clear(pyr_band *band)
{
    const e3d_pyr_frame *frame = band->picture->frame;
    size_t pixels = (size_t)(band->end - band->top) * (size_t)frame->width;
    if (frame->color)
        for (size_t i = 0; i < pixels * (size_t)frame->samples; i++)
            memcpy(band->codes + 4 * i, band->picture->background, 4);
    for (size_t i = 0; i < pixels * (size_t)band->picture->places; i++)
        band->depth[i] = INFINITY;
}

static void draw_step(pyr_band *band, const e3d_pyr_step *step)
{
    if (step->face_id[0]) {
        pyr_draw_visible(band, step);
        return;
    }
    for (int32_t d = step->first_draw; d < step->first_draw + step->draw_count; d++) {
        const e3d_pyr_draw *draw = &band->picture->frame->draws[d];
        const pyr_vertex *vertices = band->picture->vertices[d];
        switch (draw->mode) {
        case E3D_PYR_POINTS: pyr_draw_points(band, draw, vertices); break;
        case E3D_PYR_LINES: pyr_draw_lines(band, draw, vertices); break;
        default:
            if (draw->is_wireframe)
                pyr_draw_edges(band, draw, vertices);
            else
                pyr_draw_triangles(band, draw, vertices);
        }
    }
}

static void resolve(const pyr_band *band)
{
    const e3d_pyr_frame *frame = band->picture->frame;
    size_t first = (size_t)band->top * (size_t)frame->width, count = (size_t)(band->end - band->top) * (size_t)frame->width;
    int places = band->picture->places, samples = frame->samples;
    for (size_t i = 0; i < count; i++)
        frame->depth[first + i] = pyr_metric_depth(frame, band->depth[i * (size_t)places + (size_t)band->picture->depth_place]);
    if (!frame->color)
        return;
    for (size_t i = 0; i < count; i++) {
        const uint8_t *code = band->codes + i * (size_t)samples * 4;
        uint8_t *to = frame->color + (first + i) * (size_t)frame->channels;
        for (int c = 0; c < frame->channels; c++) {
            int sum = samples / 2;
            for (int s = 0; s < samples; s++)
                sum += code[4 * s + c];
            to[c] = (uint8_t)(sum / samples);
        }
    }
}

static void draw_bands(void *argument, int worker)
{
    render_job *job = argument;
    const e3d_pyr_frame *frame = job->picture.frame;
    pyr_band *band = &job->bands[worker];
    for (;;) {
        band->top = atomic_fetch_add(&job->next_band, 1) * PYR_BAND;
        if (band->top >= frame->height)
            return;
        band->end = band->top + PYR_BAND < frame->height ? band->top + PYR_BAND : frame->height;
        if (job->picture.keeps_samples)
            clear(band);
        for (int32_t s = 0; s < frame->step_count; s++)
            draw_step(band, &frame->steps[s]);
        if (job->picture.keeps_samples)
            resolve(band);
    }
}

/* ---- the picture ---- */

static void set_code_starts(pyr_picture *picture)
{
    int code = 0;
    for (int i = 0; i <= PYR_CODE_STARTS; i++) {
        float root = ((float)i - 0.01f) / PYR_CODE_STARTS; /* a little less, since roots are rounded */
        while (code < 255 && i > 0 && E3D_PYR_POWER_THRESHOLDS[code] <= root * root)
            code++;
        picture->code_start[i] = (uint8_t)code;
    }
}

static void set_places(pyr_picture *picture)
{
    const e3d_sample_pattern *pattern = e3d_sample_pattern_of(E3D_PYR_SAMPLES);
    int32_t asked = picture->frame->depth_place, one = picture->frame->samples == 1;
    picture->places = one ? 1 : E3D_PYR_PLACES;
    picture->depth_place = one ? 0 : asked;
    for (int p = 0; p < picture->places; p++) {
        int32_t sample = one ? asked : p;
        if (sample == E3D_PYR_CENTRE)
            continue;
        picture->sample_x[p] = pattern->x[sample];
        picture->sample_y[p] = -pattern->y[sample]; /* OpenGL counts rows from below */
    }
}

static int prepare_bands(render_job *job)
{
    const e3d_pyr_frame *frame = job->picture.frame;
    size_t pixels = (size_t)PYR_BAND * (size_t)frame->width;
    for (int i = 0; i < job->threads; i++) {
        pyr_band *band = &job->bands[i];
        band->picture = &job->picture;
        band->differs = malloc((size_t)frame->width * sizeof *band->differs);
        if (job->picture.keeps_samples) {
            band->codes = malloc(pixels * (size_t)frame->samples * 4);
            band->depth = malloc(pixels * (size_t)job->picture.places * sizeof *band->depth);
        } else {
            band->sums = malloc(pixels * 4 * sizeof *band->sums);
        }
        if (!band->differs || (job->picture.keeps_samples ? !band->codes || !band->depth : !band->sums))
            return 0;
    }
    return 1;
}

static void run(render_job *job)
{
    e3d_pool_run(job->threads, transform_chunks, job);
    e3d_pool_run(job->threads, draw_bands, job);
}

static e3d_status prepare_and_run(render_job *job, uint8_t *shows)
{
    if (!shows || !job->chunks || !job->picture.vertices || !job->bands)
        return E3D_OUT_OF_MEMORY;
    mark_shown(&job->picture, shows);
    if (!place_vertices(job, shows) || !prepare_bands(job))
        return E3D_OUT_OF_MEMORY;
    run(job);
    return E3D_OK;
}

static void release(render_job *job)
{
    for (int i = 0; job->bands && i < job->threads; i++) {
        free(job->bands[i].codes);
        free(job->bands[i].depth);
        free(job->bands[i].sums);
        free(job->bands[i].differs);
    }
    free(job->bands);
    free(job->chunks);
    free(job->picture.vertices);
}

e3d_status e3d_pyr_render(const e3d_pyr_frame *frame, int32_t threads, e3d_pyr_memory *memory)
{
    if (frame->width <= 0 || frame->height <= 0 || (frame->samples != 1 && frame->samples != E3D_PYR_SAMPLES) ||
        frame->depth_place < 0 || frame->depth_place >= E3D_PYR_PLACES)
        return E3D_INVALID_ARGUMENT;
    size_t draws = (size_t)frame->draw_count;
    render_job job = {.picture = {.frame = frame}, .memory = memory};
    job.threads = threads > 0 ? threads : e3d_thread_count();
    job.picture.keeps_samples = frame->step_count != 1 || !frame->steps[0].face_id[0];
    for (int c = 0; c < 4; c++)
        job.picture.background[c] = pyr_code(frame->background[c]);
    set_places(&job.picture);
    set_code_starts(&job.picture);
    job.picture.vertices = calloc(draws + 1, sizeof *job.picture.vertices);
    job.chunks = calloc(draws + 1, sizeof *job.chunks);
    job.bands = calloc((size_t)job.threads, sizeof *job.bands);
    uint8_t *shows = calloc(draws + 1, 1);
    e3d_fpenv saved = e3d_fpenv_enter();
    e3d_status status = prepare_and_run(&job, shows);
    e3d_fpenv_leave(saved);
    free(shows);
    release(&job);
    return status;
}
