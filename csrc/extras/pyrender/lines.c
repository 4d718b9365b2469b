/* Lines, edges of triangles, and points.
 * In: a draw. Out: fragments where it is nearer than what is there.
 * Always: with one sample a pixel, a line takes one pixel for each step along its longer axis, and leaves out at its ends
 * what OpenGL's diamonds leave out; with several, it is a rectangle one pixel wide (R151). */
#include <math.h>

#include "extras/pyrender/clip.h"
#include "extras/pyrender/picture.h"

#define MOST_PIXELS 0x1p30
/* Half of the 2^24 - 1 steps that Mesa has from -1 to 1: on an edge that two triangles share, the first one drawn shows */
#define HALF_DEPTHS 8388607.5

/* A line in pixels, y up as OpenGL counts; z and 1/w at its ends. */
typedef struct segment {
    double end[2][2], z[2], inverse_w[2];
    pyr_weights weights[2]; /* of the primitive's corners, at both ends */
} segment;

typedef struct line_job {
    pyr_band *band;
    const e3d_pyr_draw *draw;
    const pyr_vertex *vertices;
} line_job;

/* Clips a line to the part before the near plane and not far to the side; 0 if nothing is left. */
static int clip_segment(const double a[4], const double b[4], double range[2])
{
    range[0] = 0, range[1] = 1;
    for (int plane = 0; plane < E3D_CLIP_PLANES; plane++) {
        double da = pyr_inside(a, plane), db = pyr_inside(b, plane);
        if (da < 0 && db < 0)
            return 0;
        if (da < 0 && da / (da - db) > range[0])
            range[0] = da / (da - db);
        if (db < 0 && da / (da - db) < range[1])
            range[1] = da / (da - db);
    }
    return range[0] < range[1];
}

static int set_segment(const line_job *job, const int32_t corner[2], segment *out)
{
    const e3d_pyr_frame *frame = job->band->picture->frame;
    const double *a = job->vertices[corner[0]].clip, *b = job->vertices[corner[1]].clip;
    double range[2];
    if (!clip_segment(a, b, range))
        return 0;
    for (int e = 0; e < 2; e++) {
        double p[4];
        for (int c = 0; c < 4; c++)
            p[c] = a[c] + (b[c] - a[c]) * range[e];
        out->inverse_w[e] = 1 / p[3];
        out->end[e][0] = (p[0] / p[3] + 1) * (0.5 * frame->width);
        out->end[e][1] = (p[1] / p[3] + 1) * (0.5 * frame->height);
        if (!(fabs(out->end[e][0]) < MOST_PIXELS && fabs(out->end[e][1]) < MOST_PIXELS))
            return 0; /* not a number */
        out->z[e] = p[2] / p[3];
        out->weights[e] = (pyr_weights){{corner[0], corner[1], corner[0]}, {(float)(1 - range[e]), (float)range[e], 0}};
    }
    return 1;
}

/* The parameter along a line at the foot of a perpendicular from a point: 0 at its first end, 1 at its second. */
static double share_at(const segment *line, double x, double y)
{
    double dx = line->end[1][0] - line->end[0][0], dy = line->end[1][1] - line->end[0][1];
    return ((x - line->end[0][0]) * dx + (y - line->end[0][1]) * dy) / (dx * dx + dy * dy);
}

/* Finds the parameter for each place of a pixel, with rows counted from below, and last for lighting. Mesa takes samples and
 * lighting half a pixel to the right of and above their places. */
static void find_shares(const pyr_picture *picture, const segment *line, int32_t x, double row, double out[E3D_PYR_PLACES + 1])
{
    double dx = line->end[1][0] - line->end[0][0], dy = line->end[1][1] - line->end[0][1];
    int places = picture->places;
    if (places == 1) {
        out[0] = fabs(dx) >= fabs(dy) ? (x + 0.5 - line->end[0][0]) / (dx == 0 ? 1 : dx) : (row + 0.5 - line->end[0][1]) / dy;
        out[1] = out[0];
        return;
    }
    for (int p = 0; p + 1 < places; p++)
        out[p] = share_at(line, x + 1 + picture->sample_x[p] / 256.0, row + 1 - picture->sample_y[p] / 256.0);
    out[places - 1] = share_at(line, x + 0.5, row + 0.5);
    out[places] = share_at(line, x + 1, row + 1);
}

/* Adds the fragment of a line at a pixel, with rows counted from below, for the places in a mask. */
static void add_pixel(const line_job *job, const segment *line, int32_t x, int64_t row, uint32_t mask)
{
    const pyr_picture *picture = job->band->picture;
    const e3d_pyr_frame *frame = picture->frame;
    int64_t y = frame->height - 1 - row;
    if (x < 0 || x >= frame->width || y < job->band->top || y >= job->band->end)
        return;
    double share[E3D_PYR_PLACES + 1], z[E3D_PYR_PLACES] = {0};
    find_shares(picture, line, x, (double)row, share);
    for (int p = 0; p < picture->places; p++)
        z[p] = rint((line->z[0] + (line->z[1] - line->z[0]) * share[p]) * HALF_DEPTHS) / HALF_DEPTHS;
    mask = pyr_test_depths(job->band, x, (int32_t)y, mask, z) & ((1u << frame->samples) - 1);
    if (!mask || frame->shading == E3D_PYR_DEPTH)
        return;
    double t = share[picture->places], from = (1 - t) * line->inverse_w[0], to = t * line->inverse_w[1], sum = from + to;
    pyr_weights weights = line->weights[0];
    for (int k = 0; k < 3; k++)
        weights.weight[k] = (float)((from * line->weights[0].weight[k] + to * line->weights[1].weight[k]) / sum);
    pyr_add_fragment(job->band, job->draw, job->vertices, &weights, NULL, x, (int32_t)y, mask);
}

/* ---- one sample a pixel ---- */

/* An end of a line: its offset from the centre of its pixel, `along` the longer axis and `across` it; the line's direction in
 * both; and its slope across for each step along. */
typedef struct line_end {
    double along, across, runs_along, runs_across, rise;
} line_end;

static int is_in_diamond(const line_end *end) { return fabs(end->along) + fabs(end->across) < 0.5; }

static int alike(double a, double b) { return (a >= 0) == (b >= 0); }

/* Whether the line passes the middle of the diamond's side. Mesa adds here what should be subtracted, and this does the same. */
static int passes(const line_end *end) { return fabs(end->across + end->along * end->rise) < 0.5; }

/* Whether the pixel of an end is drawn: a line draws the pixels whose diamonds it leaves. */
static int draws_first(const line_end *end)
{
    if (is_in_diamond(end))
        return 1;
    if (alike(end->along, end->runs_along))
        return 0; /* behind it already */
    return !alike(0 - end->across, 0 - end->runs_across) || passes(end);
}

static int draws_last(const line_end *end)
{
    if (is_in_diamond(end) || !alike(end->along, end->runs_along))
        return 0;
    return alike(0 - end->across, 0 - end->runs_across) || passes(end);
}

static void draw_thin(const line_job *job, const segment *line)
{
    double dx = line->end[1][0] - line->end[0][0], dy = line->end[1][1] - line->end[0][1];
    int axis = fabs(dx) >= fabs(dy) ? 0 : 1, other = 1 - axis;
    double along = axis ? dy : dx, across = axis ? dx : dy, sign = along < 0 ? -1 : 1;
    if (along == 0)
        return;
    double rise = across / along;
    int64_t step[2];
    for (int e = 0; e < 2; e++) {
        double p = line->end[e][axis], q = line->end[e][other];
        line_end end = {p - floor(p) - 0.5, q - floor(q) - 0.5, along, across, rise};
        if (e && end.across == -0.5 && across > 0)
            end.across = 0.5;
        int draws = e ? draws_last(&end) : draws_first(&end);
        step[e] = (int64_t)floor(p) + (draws ? 0 : (e ? -1 : 1) * (int64_t)sign);
    }
    int64_t low = step[0] < step[1] ? step[0] : step[1], high = step[0] < step[1] ? step[1] : step[0];
    if ((step[1] - step[0]) * (int64_t)sign < 0)
        return;
    uint32_t all = (1u << job->band->picture->places) - 1;
    for (int64_t s = low; s <= high; s++) {
        double beside = line->end[0][other] + ((double)s + 0.5 - line->end[0][axis]) * rise;
        int64_t place = (int64_t)ceil(rint(beside * 256) / 256) - 1; /* half a pixel to each side, without the far end */
        if (axis == 0)
            add_pixel(job, line, (int32_t)s, place, all);
        else
            add_pixel(job, line, (int32_t)place, s, all);
    }
}

/* ---- several samples a pixel ---- */

/* The places of a pixel that are less than half a pixel off a line, between its ends. */
static uint32_t near_line(const pyr_picture *picture, const segment *line, int32_t x, int64_t row)
{
    double dx = line->end[1][0] - line->end[0][0], dy = line->end[1][1] - line->end[0][1], length2 = dx * dx + dy * dy;
    uint32_t mask = 0;
    for (int p = 0; p < picture->places; p++) {
        double px = x + 0.5 + picture->sample_x[p] / 256.0 - line->end[0][0];
        double py = (double)row + 0.5 - picture->sample_y[p] / 256.0 - line->end[0][1];
        double ahead = px * dx + py * dy, beside = px * dy - py * dx;
        if (ahead >= 0 && ahead < length2 && beside * beside < 0.25 * length2)
            mask |= 1u << p;
    }
    return mask;
}

static void draw_wide(const line_job *job, const segment *line)
{
    const pyr_band *band = job->band;
    const e3d_pyr_frame *frame = band->picture->frame;
    double dx = line->end[1][0] - line->end[0][0], dy = line->end[1][1] - line->end[0][1];
    double low = fmin(line->end[0][1], line->end[1][1]) - 1, high = fmax(line->end[0][1], line->end[1][1]) + 1;
    int64_t from = (int64_t)floor(fmax(low, frame->height - band->end)), to = (int64_t)floor(fmin(high, frame->height - 1 - band->top));
    for (int64_t row = from; row <= to; row++) {
        double left = fmin(line->end[0][0], line->end[1][0]), right = fmax(line->end[0][0], line->end[1][0]);
        if (dy != 0) { /* where it crosses this row */
            double a = line->end[0][0] + ((double)row - 1 - line->end[0][1]) * dx / dy;
            double b = line->end[0][0] + ((double)row + 2 - line->end[0][1]) * dx / dy;
            left = fmax(left, fmin(a, b)), right = fmin(right, fmax(a, b));
        }
        int64_t last = (int64_t)floor(fmin(right + 1, frame->width - 1));
        for (int64_t x = (int64_t)floor(fmax(left - 1, 0)); x <= last; x++) {
            uint32_t mask = near_line(band->picture, line, (int32_t)x, row);
            if (mask)
                add_pixel(job, line, (int32_t)x, row, mask);
        }
    }
}

static void draw_line(const line_job *job, int32_t from, int32_t to)
{
    int32_t corner[2] = {from, to};
    segment line;
    if (pyr_misses_band(job->band, job->vertices, corner, 2) || !set_segment(job, corner, &line))
        return;
    if (job->band->picture->places == 1)
        draw_thin(job, &line);
    else
        draw_wide(job, &line);
}

void pyr_draw_lines(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices)
{
    line_job job = {band, draw, vertices};
    for (int32_t i = 0; i < draw->count; i++)
        draw_line(&job, draw->indices[2 * (size_t)i], draw->indices[2 * (size_t)i + 1]);
    pyr_flush(band);
}

void pyr_draw_edges(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices)
{
    line_job job = {band, draw, vertices};
    for (int32_t i = 0; i < draw->count; i++) {
        const int32_t *corner = draw->indices + 3 * (size_t)i;
        if (draw->culls_backs && pyr_shows_back(vertices, corner))
            continue;
        draw_line(&job, corner[2], corner[0]);
        draw_line(&job, corner[0], corner[1]);
        draw_line(&job, corner[1], corner[2]);
    }
    pyr_flush(band);
}

/* ---- points ---- */

/* The places of a pixel in a square around a point, in 1/256 pixel, y down; its left and lower sides belong to it. */
static uint32_t in_square(const pyr_picture *picture, const int64_t low[2], const int64_t high[2], int64_t x, int64_t y)
{
    uint32_t mask = 0;
    for (int p = 0; p < picture->places; p++) {
        int64_t px = 256 * x + 128 + picture->sample_x[p], py = 256 * y + 128 + picture->sample_y[p];
        mask |= (uint32_t)(px >= low[0] && px < high[0] && py > low[1] && py <= high[1]) << p;
    }
    return mask;
}

static void draw_point(const line_job *job, int32_t corner)
{
    const e3d_pyr_frame *frame = job->band->picture->frame;
    const double *p = job->vertices[corner].clip;
    int64_t low[2], high[2], half = (int64_t)rint(128.0 * frame->point_size);
    if (pyr_inside(p, 0) < 0 || pyr_inside(p, 1) < 0 || !(fabs(p[0]) <= p[3] && fabs(p[1]) <= p[3]))
        return; /* a point is outside if its middle is */
    double across = p[0] / p[3], up = p[1] / p[3];
    if (!(fabs(across) <= 1 && fabs(up) <= 1))
        return; /* NaN: infinity by infinity */
    int64_t middle[2] = {(int64_t)rint((across + 1) * (128.0 * frame->width)), (int64_t)rint((1 - up) * (128.0 * frame->height))};
    for (int c = 0; c < 2; c++)
        low[c] = middle[c] - half, high[c] = middle[c] + half;
    pyr_weights weights = {{corner, corner, corner}, {1, 0, 0}};
    double z[E3D_PYR_PLACES];
    for (int k = 0; k < E3D_PYR_PLACES; k++)
        z[k] = p[2] / p[3];
    for (int64_t y = low[1] >> 8; y <= high[1] >> 8; y++)
        for (int64_t x = low[0] >> 8; x <= high[0] >> 8; x++) {
            if (x < 0 || x >= frame->width || y < job->band->top || y >= job->band->end)
                continue;
            uint32_t mask = in_square(job->band->picture, low, high, x, y);
            mask = pyr_test_depths(job->band, (int32_t)x, (int32_t)y, mask, z) & ((1u << frame->samples) - 1);
            if (mask && frame->shading != E3D_PYR_DEPTH)
                pyr_add_fragment(job->band, job->draw, job->vertices, &weights, NULL, (int32_t)x, (int32_t)y, mask);
        }
}

void pyr_draw_points(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices)
{
    line_job job = {band, draw, vertices};
    for (int32_t i = 0; i < draw->count; i++)
        draw_point(&job, draw->indices[i]);
    pyr_flush(band);
}
