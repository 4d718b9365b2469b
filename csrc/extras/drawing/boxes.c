/* Builds a tree of boxes: triangles sorted along a Morton curve, boxes joined four by four.
 * The method is that of Lauterbach et al., "Fast BVH Construction on GPUs" (2009), with a complete tree. */
#include "extras/drawing/boxes.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/large_pages.h"

enum { DIGIT = 8, /* bits of a code that one pass sorts by */
       DIGITS = 8 };

typedef struct box {
    double low[3], high[3];
} box;

static const box EMPTY = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static double less(double a, double b) { return b < a ? b : a; }
static double more(double a, double b) { return b > a ? b : a; }

/* Empty if a corner is not finite. */
static box box_of(const double *places, const int32_t *face)
{
    box made = EMPTY;
    int is_finite = 1;
    for (int corner = 0; corner < 3; corner++)
        for (int k = 0; k < 3; k++) {
            double at = places[3 * (size_t)face[corner] + (size_t)k];
            is_finite &= isfinite(at) != 0;
            made.low[k] = less(made.low[k], at);
            made.high[k] = more(made.high[k], at);
        }
    return is_finite ? made : EMPTY;
}

/* Spreads the low 21 bits, so that two zeros follow each. */
static uint64_t spread(uint64_t bits)
{
    bits = (bits | bits << 32) & 0x001F00000000FFFF;
    bits = (bits | bits << 16) & 0x001F0000FF0000FF;
    bits = (bits | bits << 8) & 0x100F00F00F00F00F;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
    return (bits | bits << 2) & 0x1249249249249249;
}

/* Steps are so fine that small triangles are told apart beside one that is a million times as large. */
static uint64_t code_of(const box *one, const box *all)
{
    enum { LAST = (1 << 21) - 1 };
    uint64_t code = 0;
    for (int k = 0; k < 3; k++) {
        double size = all->high[k] - all->low[k], at = ((one->low[k] + one->high[k]) * 0.5 - all->low[k]) / size * (LAST + 1);
        code |= spread(at > 0 ? at < LAST ? (uint64_t)at : LAST : 0) << k;
    }
    return code;
}

typedef struct coded {
    uint64_t code;
    int32_t item;
} coded;

static size_t digit_of(const coded *one, int digit) { return one->code >> (DIGIT * digit) & ((1 << DIGIT) - 1); }

/* Sorts by code, digit by digit from the last, and keeps the order of those with the same code. `room` has as many elements. Returns the
 * array in which they are then. */
static coded *sort(coded *codes, coded *room, size_t count)
{
    size_t starts[DIGITS][1 << DIGIT] = {{0}};
    if (count < 2)
        return codes;
    for (size_t i = 0; i < count; i++)
        for (int digit = 0; digit < DIGITS; digit++)
            starts[digit][digit_of(&codes[i], digit)]++;
    for (int digit = 0; digit < DIGITS; digit++) {
        if (starts[digit][digit_of(&codes[0], digit)] == count)
            continue;
        for (size_t value = 0, start = 0; value < 1 << DIGIT; value++) {
            size_t own = starts[digit][value];
            starts[digit][value] = start;
            start += own;
        }
        for (size_t i = 0; i < count; i++)
            room[starts[digit][digit_of(&codes[i], digit)]++] = codes[i];
        coded *sorted = room;
        room = codes;
        codes = sorted;
    }
    return codes;
}

static void order(const double *places, const int32_t *faces, size_t count, coded *codes, int32_t *items)
{
    box all = EMPTY;
    for (size_t i = 0; i < count; i++) {
        box one = box_of(places, faces + 3 * i);
        for (int k = 0; k < 3; k++) {
            all.low[k] = less(all.low[k], one.low[k]);
            all.high[k] = more(all.high[k], one.high[k]);
        }
    }
    for (size_t i = 0; i < count; i++) {
        box one = box_of(places, faces + 3 * i);
        codes[i] = (coded){code_of(&one, &all), (int32_t)i};
    }
    const coded *sorted = sort(codes, codes + count, count);
    for (size_t i = 0; i < count; i++)
        items[i] = sorted[i].item;
}

/* The nearest float or one beyond it, downward; finite, since infinite ones stand for lanes without a box. */
static float below(double at)
{
    double lower = at - (fabs(at) * 0x1p-23 + 0x1p-148);
    if (lower < FLT_MAX)
        return (float)(lower > -FLT_MAX ? lower : -FLT_MAX);
    return FLT_MAX;
}

static void set_lane(drw_four *four, int lane, const box *one, double margin)
{
    for (int k = 0; k < 3; k++) {
        int is_empty = !(one->low[k] <= one->high[k]);
        four->low[k][lane] = is_empty ? INFINITY : below(one->low[k] - margin);
        four->high[k][lane] = is_empty ? -INFINITY : -below(-(one->high[k] + margin));
    }
}

static void put(drw_four one, drw_four *four, int lane)
{
    for (int k = 0; k < 3; k++) {
        four->low[k][lane] = one.low[k][0];
        four->high[k][lane] = one.high[k][0];
    }
}

/* Makes levels of empty boxes. */
static int reserve(drw_boxes *boxes, size_t count)
{
    for (size_t fours = (count + 3) / 4; boxes->depth == 0 || fours < boxes->fours[boxes->depth - 1]; fours = (fours + 3) / 4) {
        drw_four *level = e3d_large_memory(fours * sizeof *level);
        if (!level)
            return 0;
        for (size_t i = 0; i < fours; i++)
            for (int k = 0; k < 3; k++) {
                level[i].low[k] = splat(INFINITY);
                level[i].high[k] = splat(-INFINITY);
            }
        boxes->levels[boxes->depth] = level;
        boxes->fours[boxes->depth++] = fours;
    }
    boxes->items = malloc(4 * boxes->fours[0] * sizeof *boxes->items);
    for (size_t i = count; boxes->items && i < 4 * boxes->fours[0]; i++)
        boxes->items[i] = -1;
    return boxes->items != NULL;
}

e3d_status drw_boxes_build(drw_boxes *boxes, const double *places, const int32_t *faces, size_t count, double margin)
{
    *boxes = (drw_boxes){.depth = 0};
    coded *codes = malloc(2 * count * sizeof *codes);
    if (!codes || !reserve(boxes, count)) {
        free(codes);
        return E3D_OUT_OF_MEMORY;
    }
    order(places, faces, count, codes, boxes->items);
    free(codes);
    for (size_t i = 0; i < count; i++) {
        box one = box_of(places, faces + 3 * (size_t)boxes->items[i]);
        set_lane(&boxes->levels[0][i / 4], (int)(i % 4), &one, margin);
    }
    for (int level = 1; level < boxes->depth; level++)
        for (size_t i = 0; i < boxes->fours[level - 1]; i++)
            put(drw_around(&boxes->levels[level - 1][i]), &boxes->levels[level][i / 4], (int)(i % 4));
    return E3D_OK;
}

void drw_boxes_free(drw_boxes *boxes)
{
    for (int level = 0; level < boxes->depth; level++)
        free(boxes->levels[level]);
    free(boxes->items);
}
