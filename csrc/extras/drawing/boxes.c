/* Builds a tree of boxes: triangles sorted along a Morton curve, boxes joined two by two.
 * The method is that of Lauterbach et al., "Fast BVH Construction on GPUs" (2009), with a complete tree. */
#include "extras/drawing/boxes.h"

#include <math.h>
#include <stdlib.h>

static const drw_box EMPTY = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void join(drw_box *all, const drw_box *one)
{
    for (int k = 0; k < 3; k++) {
        all->low[k] = fmin(all->low[k], one->low[k]);
        all->high[k] = fmax(all->high[k], one->high[k]);
    }
}

drw_box drw_box_of(const double *places, const int32_t *face, double margin)
{
    drw_box box = EMPTY;
    for (int corner = 0; corner < 3; corner++)
        for (int k = 0; k < 3; k++) {
            double at = places[3 * (size_t)face[corner] + (size_t)k];
            if (!isfinite(at))
                return EMPTY;
            box.low[k] = fmin(box.low[k], at - margin);
            box.high[k] = fmax(box.high[k], at + margin);
        }
    return box;
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
static uint64_t code_of(const drw_box *box, const drw_box *all)
{
    enum { LAST = (1 << 21) - 1 };
    uint64_t code = 0;
    for (int k = 0; k < 3; k++) {
        double size = all->high[k] - all->low[k], at = ((box->low[k] + box->high[k]) * 0.5 - all->low[k]) / size * (LAST + 1);
        code |= spread(at > 0 ? at < LAST ? (uint64_t)at : LAST : 0) << k;
    }
    return code;
}

typedef struct coded {
    uint64_t code;
    int32_t item;
} coded;

static int by_code(const void *a, const void *b)
{
    const coded *first = a, *second = b;
    if (first->code != second->code)
        return first->code < second->code ? -1 : 1;
    return (first->item > second->item) - (first->item < second->item);
}

static int sort(const double *places, const int32_t *faces, size_t count, int32_t *items)
{
    drw_box all = EMPTY;
    coded *codes = malloc((count + 1) * sizeof *codes);
    if (!codes)
        return 0;
    for (size_t i = 0; i < count; i++) {
        drw_box one = drw_box_of(places, faces + 3 * i, 0);
        join(&all, &one);
    }
    for (size_t i = 0; i < count; i++) {
        drw_box one = drw_box_of(places, faces + 3 * i, 0);
        codes[i] = (coded){code_of(&one, &all), (int32_t)i};
    }
    qsort(codes, count, sizeof *codes, by_code);
    for (size_t i = 0; i < count; i++)
        items[i] = codes[i].item;
    free(codes);
    return 1;
}

static int reserve(drw_boxes *boxes, size_t count)
{
    size_t leaves = 1;
    while (leaves < count)
        leaves *= 2;
    boxes->items = malloc(leaves * sizeof *boxes->items);
    for (size_t level = leaves; boxes->items && level; level /= 2) {
        boxes->levels[boxes->depth] = malloc(level * sizeof(drw_box));
        if (!boxes->levels[boxes->depth++])
            return 0;
    }
    for (size_t i = count; boxes->items && i < leaves; i++) {
        boxes->items[i] = -1;
        boxes->levels[0][i] = EMPTY;
    }
    return boxes->items != NULL;
}

e3d_status drw_boxes_build(drw_boxes *boxes, const double *places, const int32_t *faces, size_t count, double margin)
{
    *boxes = (drw_boxes){0};
    if (!reserve(boxes, count) || !sort(places, faces, count, boxes->items))
        return E3D_OUT_OF_MEMORY;
    for (size_t i = 0; i < count; i++)
        boxes->levels[0][i] = drw_box_of(places, faces + 3 * (size_t)boxes->items[i], margin);
    for (int level = 1; level < boxes->depth; level++)
        for (size_t i = 0; i < (size_t)1 << (boxes->depth - 1 - level); i++) {
            boxes->levels[level][i] = boxes->levels[level - 1][2 * i];
            join(&boxes->levels[level][i], &boxes->levels[level - 1][2 * i + 1]);
        }
    return E3D_OK;
}

void drw_boxes_free(drw_boxes *boxes)
{
    for (int level = 0; level < boxes->depth; level++)
        free(boxes->levels[level]);
    free(boxes->items);
}
