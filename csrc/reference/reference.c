/* The frame: geometry once, then raster and resolve in bands. Read this file first.
 * In: a frame and the caller's targets. Out: the targets, filled; counters and milliseconds.
 * Always: one thread; the default floating-point environment; memory for the pieces that may be seen, and for one band of at
 * most BAND_SAMPLES samples (or one row of pixels) with its blended fragments. */
#include "reference/reference.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "base/fpenv.h"
#include "data/views/mirrors.h"
#include "data/views/whole_picture.h"
#include "data/shadow_maps/shadows.h"
#include "reference/stages.h"

enum { BAND_SAMPLES = 1 << 20 };

static double milliseconds(void)
{
    struct timespec now = {0}; /* stays so if there is no clock */
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

static int size_is_valid(float size) { return size > 0.0f && size <= 256.0f; }

static int has_poses(const e3d_draw *draw)
{
    if (draw->pose_kind == E3D_POSE_NONE || draw->instances == 0)
        return 1;
    return draw->pose_kind == E3D_POSE_NODES ? draw->node_worlds && draw->node_ids : !!draw->poses;
}

static e3d_status check_frame(const e3d_frame *frame, const e3d_targets *targets)
{
    if (!frame || !targets || frame->width < 1 || frame->height < 1 || frame->width > E3D_MAX_SIZE ||
        frame->height > E3D_MAX_SIZE)
        return E3D_INVALID_ARGUMENT;
    if (frame->samples_axis != 1 && frame->samples_axis != 2 && frame->samples_axis != 4)
        return E3D_INVALID_ARGUMENT;
    if (frame->msaa_samples && (frame->samples_axis != 1 || !e3d_sample_pattern_of(frame->msaa_samples)))
        return E3D_INVALID_ARGUMENT;
    if (!size_is_valid(frame->line_width) || !size_is_valid(frame->point_size))
        return E3D_INVALID_ARGUMENT;
    if (!e3d_shadows_are_valid(frame) || !e3d_mirrors_are_valid(frame) || !e3d_whole_is_valid(frame) ||
        (frame->behind && !frame->behind_depth))
        return E3D_INVALID_ARGUMENT;
    if ((unsigned)frame->line_shape > E3D_LINES_ROUND || (unsigned)frame->point_shape > E3D_POINTS_ROUND)
        return E3D_INVALID_ARGUMENT;
    int64_t primitives = 0;
    for (int32_t d = 0; d < frame->draw_count; d++) {
        const e3d_draw *draw = &frame->draws[d];
        if (!draw->mesh || !has_poses(draw))
            return E3D_INVALID_ARGUMENT;
        const e3d_mesh_desc *mesh = e3d_mesh_view(draw->mesh);
        int64_t each = (int64_t)mesh->faces_count + mesh->lines_count + mesh->points_count;
        primitives += each * (draw->pose_kind == E3D_POSE_NONE ? 1 : draw->instances);
        if (primitives > INT32_MAX)
            return E3D_TOO_MANY_PRIMITIVES;
    }
    return E3D_OK;
}

static void init_scene(ref_scene *scene, const e3d_frame *frame)
{
    *scene = (ref_scene){.frame = frame};
    scene->width = frame->width * frame->samples_axis;
    scene->height = frame->height * frame->samples_axis;
    scene->pattern = e3d_sample_pattern_of(frame->msaa_samples);
    scene->pixel_samples = scene->pattern ? scene->pattern->count : 1;
    scene->guard_x = ref_guard_factor(scene->width);
    scene->guard_y = ref_guard_factor(scene->height);
    ref_round_rows(scene->view_from_world, frame->view_from_world, 3);
    scene->stats.threads = 1;
    scene->stats.backend = E3D_BACKEND_SCALAR;
}

static void free_scene(ref_scene *scene)
{
    free(scene->instances);
    ref_free_casters(&scene->casters);
    free(scene->pieces.items);
    free(scene->edges.items);
}

static e3d_status allocate_band(ref_band *band, const ref_scene *scene)
{
    int32_t n = scene->frame->samples_axis;
    int32_t pixel_rows = BAND_SAMPLES / (scene->width * n * scene->pixel_samples);
    pixel_rows = pixel_rows < 1 ? 1 : pixel_rows;
    band->width = scene->width;
    band->pixel_samples = scene->pixel_samples;
    band->rows = (pixel_rows < scene->frame->height ? pixel_rows : scene->frame->height) * n;
    size_t samples = (size_t)band->rows * (size_t)band->width * (size_t)band->pixel_samples;
    band->depth = malloc(samples * sizeof *band->depth);
    band->piece = malloc(samples * sizeof *band->piece);
    band->overdraw = malloc(samples);
    band->edge = malloc(samples);
    band->first_fragment = malloc((samples + 1) * sizeof *band->first_fragment);
    return band->depth && band->piece && band->overdraw && band->edge && band->first_fragment ? E3D_OK : E3D_OUT_OF_MEMORY;
}

static void free_band(ref_band *band)
{
    free(band->depth);
    free(band->piece);
    free(band->overdraw);
    free(band->edge);
    free(band->first_fragment);
    free(band->fragments);
}

static e3d_status draw_bands(ref_scene *scene, const e3d_targets *targets)
{
    ref_band band = {0};
    e3d_status status = allocate_band(&band, scene);
    int32_t rows = band.rows;
    for (int32_t y = 0; y < scene->height && status == E3D_OK; y += rows) {
        band.first_row = y;
        band.rows = scene->height - y < rows ? scene->height - y : rows;
        double start = milliseconds();
        status = ref_raster_band(scene, &band);
        double rastered = milliseconds();
        if (status == E3D_OK)
            ref_resolve_band(scene, &band, targets);
        scene->stats.ms_raster += rastered - start;
        scene->stats.ms_resolve += milliseconds() - rastered;
        scene->stats.tiles++;
    }
    free_band(&band);
    return status;
}

/* Not inlined, so that no arithmetic moves out of the floating-point environment. */
__attribute__((noinline)) static e3d_status draw_frame(ref_scene *scene, const e3d_targets *targets)
{
    double start = milliseconds();
    int with_edges = scene->frame->wireframe != E3D_WIRE_NONE && targets->color;
    e3d_status status = ref_build_geometry(scene, with_edges);
    if (status == E3D_OK && e3d_has_exact_shadows(scene->frame))
        status = ref_find_casters(scene->frame, &scene->casters);
    scene->stats.ms_geometry = milliseconds() - start;
    if (status != E3D_OK)
        return status;
    if (scene->frame->hidden == E3D_HIDDEN_PAINTER)
        ref_sort_for_painter(&scene->pieces);
    return draw_bands(scene, targets);
}

e3d_status e3d_reference_render(const e3d_frame *frame, const e3d_targets *targets, e3d_stats *stats)
{
    double start = milliseconds();
    e3d_status status = check_frame(frame, targets);
    if (status != E3D_OK)
        return status;
    e3d_fpenv environment = e3d_fpenv_enter();
    ref_scene scene;
    init_scene(&scene, frame);
    status = draw_frame(&scene, targets);
    free_scene(&scene);
    e3d_fpenv_leave(environment);
    scene.stats.ms_total = scene.stats.ms_alone = milliseconds() - start;
    if (stats && status == E3D_OK)
        *stats = scene.stats;
    return status;
}
