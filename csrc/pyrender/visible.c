/* Opaque triangles of which it is known what shows where: each is a fragment once a pixel, whatever samples it covers. */
#include "pyrender/picture.h"

/* What shows at a place: nothing where the draw is negative. */
typedef struct shown {
    int32_t draw, triangle;
} shown;

static shown shown_at(const e3d_pyr_step *step, int place, size_t pixel)
{
    int32_t object = step->object_id[place][pixel];
    if (object < 0)
        return (shown){-1, -1};
    int32_t instance = step->instance_id[place] ? step->instance_id[place][pixel] : 0;
    return (shown){step->draw_of_object[object] + instance, step->triangle_id[place][pixel]};
}

static int same(shown a, shown b) { return a.draw == b.draw && a.triangle == b.triangle; }

/* The plane of what showed last: neighbours often show the same. */
typedef struct recent {
    shown of;
    pyr_plane plane;
} recent;

static const pyr_plane *plane_of(const pyr_picture *picture, shown what, recent *last)
{
    if (!same(last->of, what)) {
        const e3d_pyr_draw *draw = &picture->frame->draws[what.draw];
        last->of = what;
        pyr_set_plane(picture->frame, draw, picture->vertices[what.draw], what.triangle, &last->plane);
    }
    return &last->plane;
}

/* The places of a mask at which a triangle isn't hidden by an earlier step. */
static uint32_t nearer(const pyr_band *band, const pyr_plane *plane, int32_t x, int32_t y, uint32_t mask)
{
    const pyr_picture *picture = band->picture;
    double z[E3D_PYR_PLACES] = {0};
    if (!picture->keeps_depths)
        return mask;
    for (int p = 0; p < picture->places; p++)
        if (mask >> p & 1)
            z[p] = pyr_depth_at(plane, x + 0.5 + picture->sample_x[p] / 256.0, y + 0.5 + picture->sample_y[p] / 256.0);
    return pyr_test_depths(band, x, y, mask, z);
}

static void add(pyr_band *band, shown what, recent *last, int32_t x, int32_t y, uint32_t mask)
{
    const pyr_picture *picture = band->picture;
    const e3d_pyr_frame *frame = picture->frame;
    const pyr_plane *plane = plane_of(picture, what, last);
    pyr_weights weights;
    uint32_t centre = 1u << (picture->places - 1);
    double z = pyr_weigh(plane, x + 0.5, y + 0.5, weights.weight);
    for (int k = 0; k < 3; k++)
        weights.corner[k] = plane->corner[k];
    if (mask & centre && !picture->keeps_depths)
        pyr_depths_at(band, x, y)[picture->places - 1] = z;
    mask = nearer(band, plane, x, y, mask) & ((1u << frame->samples) - 1);
    if (mask && frame->shading != E3D_PYR_DEPTH)
        pyr_add_fragment(band, &frame->draws[what.draw], picture->vertices[what.draw], &weights, plane, x, y, mask);
}

/* A pixel whose places show different things: each of these once. */
static void add_each(pyr_band *band, const shown at[E3D_PYR_PLACES], recent *last, int32_t x, int32_t y)
{
    int places = band->picture->places;
    uint32_t left = (1u << places) - 1;
    for (int p = places - 1; p >= 0; p--) {
        uint32_t mask = 0;
        if (!(left >> p & 1))
            continue;
        for (int q = 0; q <= p; q++)
            if (left >> q & 1 && same(at[q], at[p]))
                mask |= 1u << q;
        left &= ~mask;
        if (at[p].draw >= 0)
            add(band, at[p], last, x, y, mask);
    }
}

void pyr_draw_visible(pyr_band *band, const e3d_pyr_step *step)
{
    int32_t width = band->picture->frame->width;
    int places = band->picture->places;
    recent last = {.of = {-1, -1}};
    shown at[E3D_PYR_PLACES];
    for (int32_t y = band->top; y < band->end; y++)
        for (int32_t x = 0; x < width; x++) {
            int differ = 0;
            for (int p = 0; p < places; p++) {
                at[p] = shown_at(step, p, (size_t)y * (size_t)width + (size_t)x);
                differ |= !same(at[p], at[0]);
            }
            if (differ)
                add_each(band, at, &last, x, y);
            else if (at[0].draw >= 0)
                add(band, at[0], &last, x, y, (1u << places) - 1);
        }
    pyr_flush(band);
}
