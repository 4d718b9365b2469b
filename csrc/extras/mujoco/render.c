/* A picture in MuJoCo's manner: layers, what shows, shadows, then the passes (docs/exactness, section 29).
 *
 * In: a frame. Out: its colours; or numbers of geoms and depths. Always: a band is one thread's; the bytes are the same for any number of
 * threads.
 */
#include <stdatomic.h>

#include "base/fpenv.h"
#include "base/pool.h"
#include "e3d_renderer.h"
#include "extras/mujoco/passes.h"

/* What a thread draws bands with. */
typedef struct muj_hand {
    muj_shader shader, mirror_shader, blend_shader, mirror_blend_shader;
    muj_fragments visible, fragments; /* of a band, where lights have no shadows; of what is mirrored or blended */
    e3d_array codes, stencil, covers, ranges;
    e3d_array depth, shown, mirrored_depth, mirrored_shown; /* of a band */
} muj_hand;

struct e3d_muj_memory {
    muj_picture picture;
    muj_layer opaque, blended, mirrored, mirrored_blended;
    int32_t keeps_depth;      /* of all bands, until shadows are found */
    e3d_array depth, shown;
    muj_fragments *fragments; /* of each band */
    int32_t fragment_lists;
    muj_shadow_memory shadows;
    muj_hand **hands;
    int32_t hand_count;
};

typedef struct render_job {
    e3d_muj_memory *memory;
    int32_t bands;
    atomic_int next, failed;
} render_job;

e3d_muj_memory *e3d_muj_memory_new(void) { return calloc(1, sizeof(e3d_muj_memory)); }

static void free_hand(muj_hand *hand)
{
    if (!hand)
        return;
    e3d_array_free(&hand->codes);
    e3d_array_free(&hand->stencil);
    e3d_array_free(&hand->covers);
    muj_free_fragments(&hand->visible);
    muj_free_fragments(&hand->fragments);
    e3d_array_free(&hand->ranges);
    e3d_array_free(&hand->depth);
    e3d_array_free(&hand->shown);
    e3d_array_free(&hand->mirrored_depth);
    e3d_array_free(&hand->mirrored_shown);
    muj_free_shader(&hand->shader);
    muj_free_shader(&hand->mirror_shader);
    muj_free_shader(&hand->blend_shader);
    muj_free_shader(&hand->mirror_blend_shader);
    free(hand);
}

void e3d_muj_memory_free(e3d_muj_memory *memory)
{
    if (!memory)
        return;
    e3d_array_free(&memory->picture.draws);
    e3d_array_free(&memory->picture.blended);
    muj_free_layer(&memory->opaque);
    muj_free_layer(&memory->blended);
    muj_free_layer(&memory->mirrored);
    muj_free_layer(&memory->mirrored_blended);
    e3d_array_free(&memory->depth);
    e3d_array_free(&memory->shown);
    for (int32_t i = 0; i < memory->fragment_lists; i++)
        muj_free_fragments(&memory->fragments[i]);
    free(memory->fragments);
    muj_free_shadow_memory(&memory->shadows);
    for (int32_t i = 0; i < memory->hand_count; i++)
        free_hand(memory->hands[i]);
    free(memory->hands);
    free(memory);
}

/* ---- preparation ---- */

static void set_lanes(muj_picture *picture)
{
    int single = picture->samples == 1;
    picture->group_pixels = single ? 4 : 1;
    picture->groups = single ? (picture->frame->width + 3) / 4 : picture->frame->width;
    picture->stride = 4 * ((size_t)picture->groups + 3);
    for (int l = 0; l < 4; l++) {
        picture->lane_x[l] = (single ? MUJ_SUB * l : 0) + muj_sample_at(picture->samples, 0, l);
        picture->lane_y[l] = muj_sample_at(picture->samples, 1, l);
    }
}

static void find_shadow_lights(muj_picture *picture)
{
    const e3d_muj_frame *frame = picture->frame;
    picture->shadow_count = 0;
    for (int32_t i = 0; i < frame->light_count && frame->shadows && frame->shadow_size > 2; i++)
        if (frame->lights[i].casts_shadow)
            picture->shadow_lights[picture->shadow_count++] = i;
}

static int set_picture(muj_picture *picture, const e3d_muj_frame *frame)
{
    picture->frame = frame;
    picture->kernels = muj_kernels_for(frame->backend);
    picture->samples = frame->samples;
    set_lanes(picture);
    find_shadow_lights(picture);
    muj_set_view(frame, &picture->view);
    return muj_expand(picture);
}

static int prepare_hand(const muj_picture *picture, muj_hand *hand)
{
    size_t pixels = (size_t)MUJ_BAND * (size_t)picture->frame->width, lanes = (size_t)MUJ_BAND * picture->stride;
    return e3d_array_reserve(&hand->codes, pixels * (size_t)picture->samples, sizeof(uint32_t)) && e3d_array_reserve(&hand->stencil, pixels, 1) &&
           e3d_array_reserve(&hand->covers, (size_t)picture->groups, sizeof(muj_cover)) &&
           e3d_array_reserve(&hand->depth, lanes, sizeof(float)) && e3d_array_reserve(&hand->shown, lanes, sizeof(int32_t)) &&
           e3d_array_reserve(&hand->mirrored_depth, picture->has_mirror ? lanes : 1, sizeof(float)) &&
           e3d_array_reserve(&hand->mirrored_shown, picture->has_mirror ? lanes : 1, sizeof(int32_t));
}

static int prepare_hands(e3d_muj_memory *memory, int32_t threads)
{
    if (memory->hand_count < threads) {
        muj_hand **hands = realloc(memory->hands, (size_t)threads * sizeof *hands);
        if (!hands)
            return 0;
        memory->hands = hands;
        while (memory->hand_count < threads) {
            if (!(hands[memory->hand_count] = calloc(1, sizeof **hands)))
                return 0;
            memory->hand_count++;
        }
    }
    for (int32_t i = 0; i < threads; i++) {
        muj_hand *hand = memory->hands[i];
        if (!prepare_hand(&memory->picture, hand))
            return 0;
        const muj_picture *picture = &memory->picture;
        muj_begin_shading(&hand->shader, picture, &picture->view, 0, 0);
        muj_begin_shading(&hand->blend_shader, picture, &picture->view, 1, 1);
        muj_begin_shading(&hand->mirror_shader, picture, &picture->mirror, 1, 0);
        muj_begin_shading(&hand->mirror_blend_shader, picture, &picture->mirror, 1, 1);
    }
    return 1;
}

static int prepare_bands(e3d_muj_memory *memory, int32_t bands)
{
    size_t lanes = (size_t)memory->picture.frame->height * memory->picture.stride;
    if (memory->fragment_lists < bands) {
        muj_fragments *lists = realloc(memory->fragments, (size_t)bands * sizeof *lists);
        if (!lists)
            return 0;
        memset(lists + memory->fragment_lists, 0, (size_t)(bands - memory->fragment_lists) * sizeof *lists);
        memory->fragments = lists;
        memory->fragment_lists = bands;
    }
    memory->keeps_depth = memory->picture.shadow_count > 0 && memory->blended.records.count > 0;
    return !memory->keeps_depth ||
           (e3d_array_reserve(&memory->depth, lanes, sizeof(float)) && e3d_array_reserve(&memory->shown, lanes, sizeof(int32_t)));
}

static int set_layers(e3d_muj_memory *memory, int32_t threads)
{
    const muj_picture *picture = &memory->picture;
    int32_t opaque = (int32_t)picture->draws.count, blended = (int32_t)picture->blended.count;
    if (!muj_set_layer(&memory->opaque, picture, &picture->view, 0, opaque, threads) ||
        !muj_set_layer(&memory->blended, picture, &picture->view, opaque, blended, threads))
        return 0;
    return !picture->has_mirror || (muj_set_layer(&memory->mirrored, picture, &picture->mirror, 0, opaque, threads) &&
                                    muj_set_layer(&memory->mirrored_blended, picture, &picture->mirror, opaque, blended, threads));
}

/* ---- bands ---- */

static muj_target target_of(const e3d_muj_memory *memory, const muj_hand *hand, int32_t band)
{
    const muj_picture *picture = &memory->picture;
    int32_t top = band * MUJ_BAND, end = top + MUJ_BAND < picture->frame->height ? top + MUJ_BAND : picture->frame->height;
    size_t first = (size_t)top * picture->stride;
    if (!memory->keeps_depth)
        return (muj_target){picture, top, end, hand->depth.data, hand->shown.data};
    return (muj_target){picture, top, end, (float *)memory->depth.data + first, (int32_t *)memory->shown.data + first};
}

/* Writes the geoms that show, and their depths. */
static void write_segments(const e3d_muj_memory *memory, const muj_target *target)
{
    const muj_picture *picture = &memory->picture;
    const e3d_muj_frame *frame = picture->frame;
    size_t width = (size_t)frame->width;
    int32_t last = MUJ_NONE, geom = MUJ_NONE;
    for (int32_t y = target->top; y < target->end; y++) {
        size_t from = (size_t)(y - target->top) * picture->stride, to = (size_t)y * width;
        if (frame->depth)
            memcpy(frame->depth + to, target->depth + from, width * sizeof(float));
        for (size_t x = 0; x < width && frame->geom; x++) {
            int32_t shown = target->shown[from + x];
            if (shown != last)
                geom = shown < 0 ? MUJ_NONE : muj_draw_of(picture, muj_record_of(&memory->opaque, shown)->draw)->number;
            last = shown;
            frame->geom[to + x] = geom;
        }
    }
}

/* Marks the samples where the reflecting geom shows; returns whether there are any. */
static int set_stencil(const muj_target *target, const muj_fragments *fragments, uint8_t *stencil)
{
    size_t width = (size_t)target->picture->frame->width;
    const muj_run *runs = fragments->runs.data;
    int any = 0;
    memset(stencil, 0, (size_t)(target->end - target->top) * width);
    for (size_t i = 0; i < fragments->runs.count; i++) {
        uint8_t *at = stencil + ((size_t)runs[i].pixel - (size_t)target->top * width);
        for (int32_t k = 0; k < runs[i].count && runs[i].adds; k++)
            at[k] |= runs[i].mask;
        any |= runs[i].adds;
    }
    return any;
}

static int draw_band(const e3d_muj_memory *memory, muj_hand *hand, int32_t band, const muj_fragments *fragments)
{
    const muj_picture *picture = &memory->picture;
    muj_target target = target_of(memory, hand, band);
    muj_codes codes = {hand->codes.data, hand->stencil.data, hand->covers.data, &hand->fragments, &hand->ranges};
    size_t pixels = (size_t)(target.end - target.top) * (size_t)picture->frame->width;
    int32_t blended, mirrored[2] = {0};
    if (picture->has_mirror) {
        muj_band_items(&memory->mirrored, band, &mirrored[0]);
        muj_band_items(&memory->mirrored_blended, band, &mirrored[1]);
    }
    int is_mirroring = (mirrored[0] || mirrored[1]) && set_stencil(&target, fragments, codes.stencil);
    muj_band_items(&memory->blended, band, &blended);
    if (is_mirroring || blended)
        memset(codes.of, 0, pixels * (size_t)picture->samples * sizeof *codes.of);
    if (is_mirroring) {
        muj_target behind = {picture, target.top, target.end, hand->mirrored_depth.data, hand->mirrored_shown.data};
        if (!muj_draw_mirrored(&behind, &memory->mirrored, &memory->mirrored_blended, band, &hand->mirror_shader,
                               &hand->mirror_blend_shader, &codes))
            return 0;
    }
    if (!blended) {
        muj_resolve_fragments(&target, fragments, is_mirroring ? &codes : NULL);
        return 1;
    }
    muj_write_fragments(&target, fragments, &codes);
    if (!muj_blend_all(&target, &memory->blended, band, &hand->blend_shader, NULL, &codes))
        return 0;
    muj_resolve(&target, codes.of);
    return 1;
}

/* Finds what a band shows; and draws it, unless shadows must be found before. */
static int see_band(const e3d_muj_memory *memory, muj_hand *hand, int32_t band)
{
    int waits = memory->picture.shadow_count > 0;
    muj_fragments *fragments = waits ? &memory->fragments[band] : &hand->visible;
    muj_target target = target_of(memory, hand, band);
    muj_draw_records(&target, &memory->opaque, band);
    if (memory->picture.frame->is_segmented) {
        write_segments(memory, &target);
        return 1;
    }
    return muj_gather(&target, &memory->opaque, &hand->shader, NULL, fragments) && (waits || draw_band(memory, hand, band, fragments));
}

static void find_visible(void *argument, int number)
{
    render_job *job = argument;
    for (;;) {
        int32_t band = atomic_fetch_add(&job->next, 1);
        if (band >= job->bands)
            return;
        if (!see_band(job->memory, job->memory->hands[number], band))
            atomic_store(&job->failed, 1);
    }
}

static void draw_bands(void *argument, int number)
{
    render_job *job = argument;
    for (;;) {
        int32_t band = atomic_fetch_add(&job->next, 1);
        if (band >= job->bands)
            return;
        if (!draw_band(job->memory, job->memory->hands[number], band, &job->memory->fragments[band]))
            atomic_store(&job->failed, 1);
    }
}

/* ---- the picture ---- */

static int run(render_job *job, const e3d_muj_frame *frame, int32_t threads)
{
    e3d_muj_memory *memory = job->memory;
    muj_picture *picture = &memory->picture;
    if (!set_picture(picture, frame) || !prepare_hands(memory, threads) || !set_layers(memory, threads) || !prepare_bands(memory, job->bands))
        return 0;
    e3d_pool_run(threads, find_visible, job);
    if (atomic_load(&job->failed))
        return 0;
    if (!picture->shadow_count || frame->is_segmented)
        return 1;
    for (int32_t k = 0; k < picture->shadow_count; k++)
        if (!muj_cast(picture, k, memory->fragments, job->bands, threads, &memory->shadows))
            return 0;
    atomic_store(&job->next, 0);
    e3d_pool_run(threads, draw_bands, job);
    return !atomic_load(&job->failed);
}

e3d_status e3d_muj_render(const e3d_muj_frame *frame, int32_t threads, e3d_muj_memory *memory)
{
    if (frame->width <= 0 || frame->height <= 0 || frame->width > MUJ_MOST || frame->height > MUJ_MOST || frame->shadow_size > MUJ_MOST || (frame->samples != 1 && frame->samples != E3D_MUJ_SAMPLES) ||
        frame->light_count > E3D_MUJ_LIGHTS || (frame->is_segmented ? frame->samples != 1 : !frame->color))
        return E3D_INVALID_ARGUMENT;
    render_job job = {.memory = memory, .bands = (frame->height + MUJ_BAND - 1) / MUJ_BAND};
    e3d_fpenv saved = e3d_fpenv_enter();
    int done = run(&job, frame, threads > 0 ? threads : e3d_thread_count());
    e3d_fpenv_leave(saved);
    return done ? E3D_OK : E3D_OUT_OF_MEMORY;
}
