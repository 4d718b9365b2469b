/* Opaque triangles of known visibility.
 * In: a step with IDs for each place. Out: a fragment for each triangle that shows in a pixel. But calm triangles that share
 * a vertex with the one at the pixel's centre are one fragment with it, since their colours blend into each other (R152). */
#include "base/vectors.h"
#include "extras/pyrender/picture.h"

/* What shows at a place; nothing if the draw is negative. */
typedef struct shown {
    int32_t draw, triangle;
} shown;

/* The planes of triangles that showed last: neighbours to the right and below often show the same. New planes replace the
 * oldest. */
enum { RECENT = 256,
       RECENT_KEYS = 1024 };

typedef struct recent {
    uint16_t of_key[RECENT_KEYS]; /* the plane that may belong to a triangle of such a number */
    uint16_t next;
    shown of[RECENT];
    uint32_t batch[RECENT]; /* the last batch that needs it */
    pyr_plane plane[RECENT];
} recent;

/* Rows of a step. */
typedef struct row {
    const int32_t *object[E3D_PYR_PLACES], *triangle[E3D_PYR_PLACES], *instance[E3D_PYR_PLACES];
    const int32_t *draw_of_object;
    int places;
} row;

static void set_row(const pyr_picture *picture, const e3d_pyr_step *step, int32_t y, row *out)
{
    size_t first = (size_t)y * (size_t)picture->frame->width;
    out->places = picture->places;
    out->draw_of_object = step->draw_of_object;
    for (int p = 0; p < picture->places; p++) {
        out->object[p] = step->object_id[p] ? step->object_id[p] + first : NULL;
        out->triangle[p] = step->face_id[p] + first;
        out->instance[p] = step->instance_id[p] ? step->instance_id[p] + first : NULL;
    }
}

/* Sets bits where a place shows something other than the first place. */
static void compare_places(const row *row, int32_t width, int32_t *differs)
{
    memset(differs, 0, (size_t)width * sizeof *differs);
    for (int p = 1; p < row->places; p++) {
        for (int32_t x = 0; x < width; x++)
            differs[x] |= row->triangle[0][x] ^ row->triangle[p][x];
        if (row->object[0])
            for (int32_t x = 0; x < width; x++)
                differs[x] |= row->object[0][x] ^ row->object[p][x];
        if (row->instance[0])
            for (int32_t x = 0; x < width; x++)
                differs[x] |= row->instance[0][x] ^ row->instance[p][x];
    }
}

static shown shown_at(const row *row, int place, int32_t x)
{
    int32_t triangle = row->triangle[place][x];
    if (triangle < 0)
        return (shown){-1, -1};
    int32_t instance = row->instance[place] ? row->instance[place][x] : 0;
    return (shown){row->draw_of_object[row->object[place] ? row->object[place][x] : 0] + instance, triangle};
}

static int same(shown a, shown b) { return a.draw == b.draw && a.triangle == b.triangle; }

/* Whether two triangles of a draw may be lit together: they are calm, and share a vertex. */
static int meet(const e3d_pyr_frame *frame, shown a, shown b)
{
    if (a.draw != b.draw || a.draw < 0)
        return 0;
    const e3d_pyr_draw *draw = &frame->draws[a.draw];
    if (!draw->calm[a.triangle] || !draw->calm[b.triangle])
        return 0;
    const int32_t *indices = draw->indices;
    const int32_t *p = indices + 3 * (size_t)a.triangle, *q = indices + 3 * (size_t)b.triangle;
    for (int k = 0; k < 3; k++)
        if (p[k] == q[0] || p[k] == q[1] || p[k] == q[2])
            return 1;
    return 0;
}

/* Whether all samples of a pixel are one fragment with what its centre shows. Within a surface mostly all do, so this tests
 * them together. */
static int all_meet(const e3d_pyr_frame *frame, const shown at[E3D_PYR_PLACES])
{
    shown centre = at[E3D_PYR_CENTRE];
    int32_t other_draws = 0;
    for (int s = 0; s < E3D_PYR_SAMPLES; s++)
        other_draws |= at[s].draw ^ centre.draw;
    if (other_draws || centre.draw < 0)
        return 0;
    const e3d_pyr_draw *draw = &frame->draws[centre.draw];
    const int32_t *p = draw->indices + 3 * (size_t)centre.triangle, *q[E3D_PYR_SAMPLES];
    int calm = draw->calm[centre.triangle];
    int4 shared = {0};
    for (int s = 0; s < E3D_PYR_SAMPLES; s++) {
        calm &= draw->calm[at[s].triangle];
        q[s] = draw->indices + 3 * (size_t)at[s].triangle;
    }
    for (int k = 0; k < 3; k++) {
        int4 vertex = {q[0][k], q[1][k], q[2][k], q[3][k]};
        shared |= (vertex == p[0]) | (vertex == p[1]) | (vertex == p[2]);
    }
    return calm && lanes_of(shared) == (1 << E3D_PYR_SAMPLES) - 1;
}

/* The number of a triangle's plane. The batch is flushed before a plane that it needs is replaced. */
static int find_plane(pyr_band *band, shown what, recent *last)
{
    const pyr_picture *picture = band->picture;
    uint32_t key = (uint32_t)(what.triangle + 31 * what.draw) % RECENT_KEYS;
    int number = last->of_key[key];
    if (same(last->of[number], what))
        return number;
    number = last->next++ % RECENT;
    if (last->batch[number] == band->batch.number)
        pyr_flush(band);
    last->of_key[key] = (uint16_t)number;
    last->of[number] = what;
    pyr_set_plane(picture->frame, &picture->frame->draws[what.draw], picture->vertices[what.draw], what.triangle, &last->plane[number]);
    return number;
}

/* Adds what shows at some places of a pixel. */
static void add(pyr_band *band, shown what, recent *last, int32_t x, int32_t y, uint32_t mask)
{
    const pyr_picture *picture = band->picture;
    const e3d_pyr_draw *draw = &picture->frame->draws[what.draw];
    const pyr_vertex *vertices = picture->vertices[what.draw];
    int number = find_plane(band, what, last);
    if (picture->keeps_samples) {
        pyr_add_nearer(band, draw, vertices, &last->plane[number], x, y, mask);
        return;
    }
    pyr_add_shown(band, draw, vertices, &last->plane[number], x, y, mask);
    last->batch[number] = band->batch.number;
}

/* If no samples are kept: fills a row with the background. */
static void fill_row(const pyr_band *band, int32_t y)
{
    const e3d_pyr_frame *frame = band->picture->frame;
    memset(frame->depth + (size_t)y * (size_t)frame->width, 0, (size_t)frame->width * sizeof *frame->depth);
    if (!frame->color)
        return;
    uint8_t *to = pyr_color_at(frame, 0, y);
    size_t size = (size_t)frame->width * (size_t)frame->channels, done = (size_t)frame->channels;
    memcpy(to, band->picture->background, done);
    for (; done * 2 <= size; done *= 2)
        memcpy(to + done, to, done);
    memcpy(to + done, to, size - done);
}

/* If no samples are kept: begins the sum of a pixel's codes with its samples that show nothing. */
static void begin_sum(pyr_band *band, int32_t x, int32_t y, uint32_t nothing)
{
    const e3d_pyr_frame *frame = band->picture->frame;
    uint16_t *sum = pyr_sums_at(band, x, y);
    int count = 0;
    for (int s = 0; s < frame->samples; s++)
        count += nothing >> s & 1;
    for (int c = 0; c < 4; c++)
        sum[c] = (uint16_t)(count * band->picture->background[c] + frame->samples / 2);
}

/* Adds a pixel whose places show different things: each of these once, the centre's first. */
static void add_each(pyr_band *band, const shown at[E3D_PYR_PLACES], recent *last, int32_t x, int32_t y)
{
    const e3d_pyr_frame *frame = band->picture->frame;
    int places = band->picture->places;
    shown of[E3D_PYR_PLACES];
    uint32_t mask[E3D_PYR_PLACES], nothing = 0;
    int count = 0;
    if (all_meet(frame, at)) {
        band->differs[x] = 0;
        add(band, at[E3D_PYR_CENTRE], last, x, y, (1u << places) - 1);
        return;
    }
    for (int p = places - 1; p >= 0; p--) {
        int k = 0;
        if (at[p].draw < 0) {
            nothing |= 1u << p;
            continue;
        }
        while (k < count && !same(of[k], at[p]) && !(k == 0 && meet(frame, of[0], at[p])))
            k++;
        if (k == count) {
            of[count] = at[p];
            mask[count++] = 0;
        }
        mask[k] |= 1u << p;
    }
    uint32_t samples = (1u << frame->samples) - 1;
    band->differs[x] = 1;
    for (int k = 0; k < count; k++)
        band->differs[x] &= (mask[k] & samples) != samples;
    if (band->differs[x] && !band->picture->keeps_samples)
        begin_sum(band, x, y, nothing);
    for (int k = 0; k < count; k++)
        add(band, of[k], last, x, y, mask[k]);
}

/* Finds the colours of the pixels of a row that show several things. */
static void add_up(const pyr_band *band, int32_t y)
{
    const e3d_pyr_frame *frame = band->picture->frame;
    for (int32_t x = 0; x < frame->width; x++) {
        if (!band->differs[x])
            continue;
        const uint16_t *sum = pyr_sums_at(band, x, y);
        uint8_t *to = pyr_color_at(frame, x, y);
        for (int c = 0; c < frame->channels; c++)
            to[c] = (uint8_t)(sum[c] / frame->samples);
    }
}

static void draw_row(pyr_band *band, const row *row, recent *last, int32_t y)
{
    const pyr_picture *picture = band->picture;
    uint32_t all = (1u << picture->places) - 1;
    shown at[E3D_PYR_PLACES];
    compare_places(row, picture->frame->width, band->differs);
    if (!picture->keeps_samples)
        fill_row(band, y);
    for (int32_t x = 0; x < picture->frame->width; x++) {
        at[0] = shown_at(row, 0, x);
        if (band->differs[x]) {
            for (int p = 1; p < picture->places; p++)
                at[p] = shown_at(row, p, x);
            add_each(band, at, last, x, y);
        } else if (at[0].draw >= 0) {
            add(band, at[0], last, x, y, all);
        }
    }
    if (picture->keeps_samples || !picture->frame->color)
        return;
    pyr_flush(band);
    add_up(band, y);
}

void pyr_draw_visible(pyr_band *band, const e3d_pyr_step *step)
{
    recent last;
    row row;
    memset(last.of_key, 0, sizeof last.of_key);
    last.next = 0;
    for (int k = 0; k < RECENT; k++) {
        last.of[k] = (shown){-2, -2};
        last.batch[k] = band->batch.number - 1;
    }
    for (int32_t y = band->top; y < band->end; y++) {
        set_row(band->picture, step, y, &row);
        draw_row(band, &row, &last, y);
    }
    pyr_flush(band);
}
