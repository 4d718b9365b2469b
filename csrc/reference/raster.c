/* Raster: which piece is seen at each sample of a band, and how far away it is.
 *
 * In:  the scene's pieces, in the order of R16 or sorted for the painter.
 * Out: depth, visible piece, layers of overdraw and wireframe edges of each sample of the band.
 * Rules: R12 (coverage, in exact integers), R14 and R15 (depth), R16 (order), R17 (overdraw),
 *      R36 (wireframe), R81 and R82 through alpha.c.
 */
#include <math.h>
#include <stdlib.h>

#include "reference/arithmetic.h"
#include "reference/stages.h"

/* R12: the centre is inside, or on a top or left edge. */
static int covers(const ref_piece *piece, int32_t x, int32_t y)
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int64_t a = piece->a[k], b = piece->b[k];
        int64_t e = a * (256 * x + 128 - piece->x[i]) + b * (256 * y + 128 - piece->y[i]);
        int top_left = a > 0 || (a == 0 && b > 0);
        if (e < 0 || (e == 0 && !top_left))
            return 0;
    }
    return 1;
}

float ref_depth_at(const ref_piece *piece, int32_t x, int32_t y)
{
    float dx = (float)(x - piece->left), dy = (float)(y - piece->top);
    float z = (piece->z0 + dx * piece->z_dx) + dy * piece->z_dy;
    return ref_clamp(z, piece->z_min, piece->z_max);
}

/* Pieces come in order, so that an equal depth never replaces an earlier piece. */
static e3d_status keep_fragment(const ref_scene *scene, const ref_piece *piece, int64_t number, float z,
                                ref_band *band, size_t sample)
{
    if (ref_is_blended(scene->frame, piece))
        return ref_add_fragment(band, sample, z, number);
    if (piece->primitive.kind == REF_FACE && band->layers[sample] < 255)
        band->layers[sample]++;
    if (scene->frame->hidden != E3D_HIDDEN_ZBUFFER || z < band->depth[sample]) {
        band->depth[sample] = z;
        band->piece[sample] = number;
    }
    return E3D_OK;
}

/* R36: how far behind the kept depth an edge still shows: the slope of that piece over the line's reach. */
static float edge_slack(const ref_scene *scene, const ref_piece *kept)
{
    float reach = (float)ref_greatest_offset(scene) * (1.0f / 256.0f) + 0.5f;
    float slope = (fabsf(kept->z_dx) + fabsf(kept->z_dy)) * reach;
    return ref_min(slope, kept->z_max - kept->z_min);
}

static void keep_edge(const ref_scene *scene, float z, ref_band *band, size_t sample)
{
    const e3d_frame *frame = scene->frame;
    int tested = frame->hidden == E3D_HIDDEN_ZBUFFER &&
                 (frame->wireframe == E3D_WIRE_OVERLAY || frame->remove_hidden_lines);
    int64_t kept = band->piece[sample];
    if (!tested || kept < 0 ||
        z < band->depth[sample] + edge_slack(scene, &scene->pieces.items[kept]))
        band->edge[sample] = 1;
}

static e3d_status raster_piece(const ref_scene *scene, const ref_piece *piece, int64_t number, ref_band *band)
{
    int32_t last_row = band->first_row + band->rows - 1;
    int32_t top = piece->top > band->first_row ? piece->top : band->first_row;
    int32_t bottom = piece->bottom < last_row ? piece->bottom : last_row;
    for (int32_t y = top; y <= bottom; y++) {
        size_t row = (size_t)(y - band->first_row) * (size_t)band->width;
        for (int32_t x = piece->left; x <= piece->right; x++) {
            if (!covers(piece, x, y))
                continue;
            float z = ref_depth_at(piece, x, y);
            if (z > 1.0f || !ref_alpha_covers(scene, piece, x, y))
                continue;
            e3d_status status = E3D_OK;
            if (piece->primitive.kind == REF_EDGE)
                keep_edge(scene, z, band, row + (size_t)x);
            else
                status = keep_fragment(scene, piece, number, z, band, row + (size_t)x);
            if (status != E3D_OK)
                return status;
        }
    }
    return E3D_OK;
}

static int farther_first(const void *left, const void *right)
{
    const ref_piece *a = left, *b = right;
    if (a->painter_key != b->painter_key)
        return a->painter_key > b->painter_key ? -1 : 1;
    return a->order < b->order ? -1 : a->order > b->order;
}

void ref_sort_for_painter(ref_piece_list *pieces)
{
    if (pieces->count > 1)
        qsort(pieces->items, (size_t)pieces->count, sizeof *pieces->items, farther_first);
}

e3d_status ref_raster_band(const ref_scene *scene, ref_band *band)
{
    size_t samples = (size_t)band->rows * (size_t)band->width;
    for (size_t sample = 0; sample < samples; sample++) {
        band->depth[sample] = INFINITY;
        band->piece[sample] = -1;
        band->layers[sample] = 0;
        band->edge[sample] = 0;
    }
    e3d_status status = E3D_OK;
    band->fragment_count = 0;
    for (int64_t n = 0; n < scene->pieces.count && status == E3D_OK; n++)
        status = raster_piece(scene, &scene->pieces.items[n], n, band);
    for (int64_t n = 0; n < scene->edges.count && status == E3D_OK; n++)
        status = raster_piece(scene, &scene->edges.items[n], n, band);
    if (status == E3D_OK)
        ref_sort_fragments(scene, band);
    return status;
}
