/* Draws a view: finds its lines, which pieces of them are hidden, and what lies on what is drawn already.
 * In: surfaces in the world, and a view. Out: strokes on paper. */
#include <math.h>
#include <stdlib.h>

#include "base/fpenv.h"
#include "e3d_drawing.h"
#include "extras/drawing/lines.h"

/* Triangles reach beyond their sides by this share of the thickness, so that no line shows through a seam: more than rounding in
 * double precision, but no more, as lines may run almost along a side. */
#define REACH 0x1p-22

enum { KINDS = 128 };

typedef struct drawing {
    const e3d_view *view;
    int8_t *facing;    /* (faces,) of the edges */
    uint8_t *needless; /* (faces,): as of e3d_hiders; NULL: none */
    e3d_array lines; /* of drw_line */
    double *ends;    /* (lines, 2, 3) */
    uint8_t *behind; /* (lines,): as of e3d_lines */
    double *paper;   /* (lines, 2, E3D_SHEET) */
    double *corners; /* (vertices, E3D_SHEET) */
    double nothing;  /* millimetres: shorter pieces are none */
    e3d_piece *pieces, *once;
    size_t piece_count, once_count;
    e3d_stroke *strokes; /* (piece_count,): visible ones first, by their kinds */
    double *segments;    /* (piece_count, 4): their ends */
} drawing;

static double row(const double *m, const double *place)
{
    return ((place[0] * m[0] + place[1] * m[1]) + place[2] * m[2]) + m[3];
}

static void project(const e3d_view *view, const double *places, size_t count, double *paper)
{
    const double *m = view->clip_from_world, half[2] = {0.5 * view->size[0], 0.5 * view->size[1]};
    for (size_t i = 0; i < count; i++, places += 3, paper += E3D_SHEET) {
        double inverse = 1 / row(m + 12, places);
        paper[E3D_SHEET_X] = (row(m, places) * inverse + 1) * half[0];
        paper[E3D_SHEET_Y] = (1 - row(m + 4, places) * inverse) * half[1];
        paper[E3D_SHEET_INVERSE_W] = inverse;
        paper[E3D_SHEET_DEPTH] = view->is_parallel ? row(m + 8, places) : -inverse;
    }
}

static int by_value(const void *a, const void *b)
{
    double first = *(const double *)a, second = *(const double *)b;
    return (first > second) - (first < second);
}

/* Finds what the thickness has on paper, where 1 / w is the middle one of the lines' ends. */
static e3d_status find_nothing(drawing *job)
{
    const double *m = job->view->clip_from_world;
    size_t count = 2 * job->lines.count;
    double across[2], usual = job->paper[E3D_SHEET_INVERSE_W], *sorted;
    if (!job->view->is_parallel) {
        if (!(sorted = malloc(count * sizeof *sorted)))
            return E3D_OUT_OF_MEMORY;
        for (size_t i = 0; i < count; i++)
            sorted[i] = job->paper[E3D_SHEET * i + E3D_SHEET_INVERSE_W];
        qsort(sorted, count, sizeof *sorted, by_value);
        usual = sorted[count / 2];
        free(sorted);
    }
    for (int k = 0; k < 2; k++, m += 4)
        across[k] = sqrt((m[0] * m[0] + m[1] * m[1]) + m[2] * m[2]) * job->view->size[k];
    job->nothing = job->view->thickness * (0.5 * usual * (across[1] > across[0] ? across[1] : across[0]));
    return E3D_OK;
}

/* Puts lines and triangles on paper. */
static e3d_status place(drawing *job, const e3d_surface *hiders)
{
    size_t count = job->lines.count;
    const drw_line *lines = job->lines.data;
    job->ends = malloc(6 * count * sizeof *job->ends);
    job->paper = malloc(2 * E3D_SHEET * count * sizeof *job->paper);
    job->corners = malloc((hiders->vertex_count + 1) * E3D_SHEET * sizeof *job->corners);
    job->behind = malloc(count);
    if (!job->ends || !job->paper || !job->corners || !job->behind)
        return E3D_OUT_OF_MEMORY;
    for (size_t i = 0; i < count; i++) {
        memcpy(job->ends + 6 * i, lines[i].ends, sizeof lines[i].ends);
        job->behind[i] = lines[i].is_behind;
    }
    project(job->view, job->ends, 2 * count, job->paper);
    project(job->view, hiders->places, hiders->vertex_count, job->corners);
    return find_nothing(job);
}

/* Seen from outside, a body that encloses a volume hides nothing with its backs that its fronts do not hide. */
static e3d_status find_needless(drawing *job, const e3d_edges *edges)
{
    job->needless = malloc(edges->of.face_count + 1);
    if (!job->needless)
        return E3D_OUT_OF_MEMORY;
    for (size_t face = 0; face < edges->of.face_count; face++)
        job->needless[face] = drw_is_back(edges, job->facing, (int32_t)face);
    return E3D_OK;
}

static e3d_status hide(drawing *job, const e3d_surface *by, int threads)
{
    const double *eye = job->view->eye;
    e3d_hiders hiders = {by->places, job->corners, by->faces, by->face_count, {eye[0], eye[1], eye[2], eye[3]}, job->view->thickness, REACH * job->nothing, job->needless};
    e3d_lines lines = {job->ends, job->paper, job->lines.count, job->nothing, job->behind};
    return e3d_hide_lines(&hiders, &lines, threads, &job->pieces, &job->piece_count);
}

static void cut(const double *from, const double *to, const e3d_piece *piece, double out[4])
{
    double shares[2] = {piece->from, piece->to};
    for (int end = 0; end < 2; end++)
        for (int k = 0; k < 2; k++)
            out[2 * end + k] = from[k] * (1 - shares[end]) + to[k] * shares[end];
}

/* Puts the pieces in the order of their importance. */
static e3d_status order(drawing *job)
{
    size_t starts[2 * KINDS + 1] = {0};
    const drw_line *lines = job->lines.data;
    job->strokes = malloc((job->piece_count + 1) * sizeof *job->strokes);
    job->segments = malloc((4 * job->piece_count + 1) * sizeof *job->segments);
    if (!job->strokes || !job->segments)
        return E3D_OUT_OF_MEMORY;
    for (size_t i = 0; i < job->piece_count; i++)
        starts[job->pieces[i].is_hidden * KINDS + lines[job->pieces[i].line].kind + 1]++;
    for (size_t bin = 0; bin < 2 * KINDS; bin++)
        starts[bin + 1] += starts[bin];
    for (size_t i = 0; i < job->piece_count; i++) {
        const e3d_piece *piece = &job->pieces[i];
        const drw_line *line = &lines[piece->line];
        const double *paper = job->paper + 2 * E3D_SHEET * (size_t)piece->line;
        size_t at = starts[piece->is_hidden * KINDS + line->kind]++;
        cut(paper, paper + E3D_SHEET, piece, job->segments + 4 * at);
        job->strokes[at] = (e3d_stroke){{0}, line->part, line->kind, (int8_t)piece->is_hidden};
    }
    return E3D_OK;
}

/* Leaves out what lies on more important strokes. */
static e3d_status draw_once(drawing *job, int threads, e3d_stroke **strokes, size_t *count)
{
    double tolerance = 2 * job->nothing > job->view->nearness ? 2 * job->nothing : job->view->nearness;
    e3d_status status = e3d_hide_repeated(job->segments, job->piece_count, tolerance, threads, &job->once, &job->once_count);
    e3d_stroke *kept = status == E3D_OK ? malloc((job->once_count + 1) * sizeof *kept) : NULL;
    if (!kept)
        return E3D_OUT_OF_MEMORY;
    *strokes = kept;
    *count = 0;
    for (size_t i = 0; i < job->once_count; i++) {
        const e3d_piece *piece = &job->once[i];
        const double *segment = job->segments + 4 * (size_t)piece->line;
        if (piece->is_hidden)
            continue;
        *kept = job->strokes[piece->line];
        cut(segment, segment + 2, piece, kept->ends);
        kept++;
        ++*count;
    }
    return E3D_OK;
}

/* Finds the lines, and which triangles are seen from where. */
static e3d_status look(drawing *job, const e3d_edges *edges, const e3d_other_lines *others)
{
    job->facing = malloc(edges->of.face_count + 1);
    if (!job->facing)
        return E3D_OUT_OF_MEMORY;
    drw_find_facing(edges, job->view->eye, job->facing);
    if (job->view->is_outside && find_needless(job, edges) != E3D_OK)
        return E3D_OUT_OF_MEMORY;
    return drw_find_lines(edges, job->facing, others, job->view, &job->lines);
}

e3d_status e3d_draw_view(const e3d_edges *edges, const e3d_other_lines *others, const e3d_surface *hiders, const e3d_view *view,
                         int threads, e3d_stroke **strokes, size_t *count)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    drawing job = {.view = view};
    *strokes = NULL;
    *count = 0;
    e3d_status status = look(&job, edges, others);
    if (status == E3D_OK && job.lines.count) {
        status = place(&job, hiders);
        if (status == E3D_OK)
            status = hide(&job, hiders, threads);
        if (status == E3D_OK)
            status = order(&job);
        if (status == E3D_OK)
            status = draw_once(&job, threads, strokes, count);
    }
    free(job.facing);
    free(job.needless);
    e3d_array_free(&job.lines);
    free(job.ends);
    free(job.behind);
    free(job.paper);
    free(job.corners);
    free(job.pieces);
    free(job.once);
    free(job.strokes);
    free(job.segments);
    e3d_fpenv_leave(saved);
    return status;
}
