/* Triangles that are drawn one after the other: blended ones, in their given order.
 * In: a draw. Out: fragments where it is nearer than what is there.
 * Always: coverage is that of R8 ... R12, for places in a pixel. */
#include <math.h>

#include "extras/pyrender/clip.h"
#include "extras/pyrender/picture.h"

/* An edge function: inside if a*x + b*y + c >= 0, with x and y in 1/256 pixel. */
typedef struct edge {
    int64_t a, b, c;
} edge;

static int64_t smaller(int64_t a, int64_t b) { return a < b ? a : b; }
static int64_t larger(int64_t a, int64_t b) { return a > b ? a : b; }

static void set_edge(const int64_t from[2], const int64_t to[2], edge *out)
{
    out->a = from[1] - to[1];
    out->b = to[0] - from[0];
    out->c = -(out->a * from[0] + out->b * from[1]);
    if (!(out->a > 0 || (out->a == 0 && out->b > 0)))
        out->c -= 1; /* neither top nor left: a place on it is outside */
}

/* Finds the place on the screen of a corner that was clipped to the room before the viewer; 0 if it is NaN. */
static int to_screen(const e3d_pyr_frame *frame, const double p[4], int64_t out[2])
{
    double across = p[0] / p[3], up = p[1] / p[3];
    out[0] = out[1] = 0;
    if (!(fabs(across) < 2 * PYR_SIDE && fabs(up) < 2 * PYR_SIDE))
        return 0;
    out[0] = (int64_t)rint((across + 1) * (128.0 * frame->width));
    out[1] = (int64_t)rint((1 - up) * (128.0 * frame->height));
    return 1;
}

/* The places of a pixel that three edges enclose. */
static uint32_t covered(const pyr_picture *picture, const edge edges[3], int32_t x, int32_t y)
{
    uint32_t mask = 0;
    for (int p = 0; p < picture->places; p++) {
        int64_t px = 256 * (int64_t)x + 128 + picture->sample_x[p], py = 256 * (int64_t)y + 128 + picture->sample_y[p];
        int inside = 1;
        for (int k = 0; k < 3; k++)
            inside &= edges[k].a * px + edges[k].b * py + edges[k].c >= 0;
        mask |= (uint32_t)inside << p;
    }
    return mask;
}

typedef struct triangle_job {
    pyr_band *band;
    const e3d_pyr_draw *draw;
    const pyr_vertex *vertices;
    pyr_plane plane;
} triangle_job;

/* Draws a triangle on the screen, with corners in clockwise order (y down). */
static void draw_piece(triangle_job *job, int64_t p[3][2])
{
    const pyr_picture *picture = job->band->picture;
    edge edges[3];
    int64_t low[2], high[2];
    for (int k = 0; k < 3; k++)
        set_edge(p[k], p[(k + 1) % 3], &edges[k]);
    for (int c = 0; c < 2; c++) {
        low[c] = smaller(p[0][c], smaller(p[1][c], p[2][c])) >> 8;
        high[c] = larger(p[0][c], larger(p[1][c], p[2][c])) >> 8;
    }
    int32_t left = (int32_t)larger(low[0], 0), right = (int32_t)smaller(high[0], picture->frame->width - 1);
    int32_t top = (int32_t)larger(low[1], job->band->top), bottom = (int32_t)smaller(high[1], job->band->end - 1);
    for (int32_t y = top; y <= bottom; y++)
        for (int32_t x = left; x <= right; x++) {
            uint32_t mask = covered(picture, edges, x, y);
            if (mask)
                pyr_add_nearer(job->band, job->draw, job->vertices, &job->plane, x, y, mask);
        }
}

/* Twice the area of a polygon's piece, y down: negative if it is counter-clockwise to the viewer. */
static int64_t area_of(int64_t p[3][2])
{
    return (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
}

static void draw_fan(triangle_job *job, int64_t corners[PYR_MOST_CORNERS][2], int count)
{
    for (int i = 1; i + 1 < count; i++) {
        int64_t p[3][2] = {{corners[0][0], corners[0][1]},
                           {corners[i][0], corners[i][1]},
                           {corners[i + 1][0], corners[i + 1][1]}};
        int64_t area = area_of(p);
        if (area == 0 || (area > 0 && job->draw->culls_backs))
            continue;
        if (area < 0) {
            int64_t other[2] = {p[1][0], p[1][1]};
            p[1][0] = p[2][0], p[1][1] = p[2][1];
            p[2][0] = other[0], p[2][1] = other[1];
        }
        draw_piece(job, p);
    }
}

void pyr_draw_triangles(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices)
{
    const e3d_pyr_frame *frame = band->picture->frame;
    triangle_job job = {.band = band, .draw = draw, .vertices = vertices};
    for (int32_t t = 0; t < draw->count; t++) {
        double p[PYR_MOST_CORNERS][4];
        int64_t corners[PYR_MOST_CORNERS][2];
        int32_t corner[3];
        pyr_corners(draw, t, corner);
        if (pyr_misses_band(band, vertices, corner, 3) || (draw->culls_backs && pyr_shows_back(vertices, corner)))
            continue;
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 4; c++)
                p[k][c] = vertices[corner[k]].clip[c];
        int count = pyr_clip_polygon(p, 3), above = 1, below = 1, known = 1;
        for (int i = 0; i < count && known; i++) {
            known = to_screen(frame, p[i], corners[i]);
            above &= corners[i][1] < 256 * (int64_t)band->top;
            below &= corners[i][1] >= 256 * (int64_t)band->end;
        }
        if (count < 3 || !known || above || below)
            continue;
        pyr_set_plane(frame, draw, vertices, t, &job.plane);
        draw_fan(&job, corners, count);
    }
    pyr_flush(band);
}
