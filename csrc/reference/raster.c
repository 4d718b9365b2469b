/* Raster: finds the piece that is seen at each sample of a band, and its depth.
 * In: the scene's pieces, in the order of R16 or sorted for the painter.
 * Out: depth, visible piece, overdraw and wireframe edges for each sample of the band.
 * Rules: R12 (coverage, in exact integers), R14 and R15 (depth), R16 (order), R17 (overdraw), R36, R109, R116 (wireframe),
 * R103 and R104 (multisampling), R81, R82 and R108 through alpha.c. */
#include <math.h>
#include <stdlib.h>

#include "reference/arithmetic.h"
#include "reference/stages.h"

/* R103: the offset of a sample from its pixel's centre, in 1/256 pixel. */
typedef struct offset {
    int32_t x, y;
} offset;

static offset offset_of(const ref_scene *scene, int32_t number)
{
    return scene->pattern ? (offset){scene->pattern->x[number], scene->pattern->y[number]} : (offset){0, 0};
}

/* R12: whether a sample is inside, or on a top or left edge. */
static int covers(const ref_piece *piece, int32_t x, int32_t y, offset from_centre)
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int64_t a = piece->a[k], b = piece->b[k];
        int64_t e = a * (256 * x + 128 + from_centre.x - piece->x[i]) + b * (256 * y + 128 + from_centre.y - piece->y[i]);
        int top_left = a > 0 || (a == 0 && b > 0);
        if (e < 0 || (e == 0 && !top_left))
            return 0;
    }
    return 1;
}

/* R14 and R104 */
static float depth_at(const ref_scene *scene, const ref_piece *piece, int32_t x, int32_t y, offset from_centre)
{
    float dx = (float)(x - piece->left), dy = (float)(y - piece->top), z0 = piece->z0;
    if (scene->pattern) {
        float u = (float)from_centre.x * (1.0f / 256.0f), v = (float)from_centre.y * (1.0f / 256.0f);
        z0 = (z0 + u * piece->z_dx) + v * piece->z_dy;
    }
    float z = (z0 + dx * piece->z_dx) + dy * piece->z_dy;
    return ref_clamp(z, piece->z_min, piece->z_max);
}

/* Pieces come in order, so a piece of equal depth never replaces an earlier one. */
static e3d_status keep_fragment(const ref_scene *scene, const ref_piece *piece, int64_t number, float z,
                                ref_band *band, size_t sample)
{
    if (ref_is_blended(scene->frame, piece))
        return scene->frame->opaque_only ? E3D_OK : ref_add_fragment(band, sample, z, number); /* R161 */
    if (piece->primitive.kind == REF_FACE && band->overdraw[sample] < 255)
        band->overdraw[sample]++;
    if (scene->frame->hidden != E3D_HIDDEN_ZBUFFER || z < band->depth[sample]) {
        band->depth[sample] = z;
        band->piece[sample] = number;
    }
    return E3D_OK;
}

/* R36: how far behind the visible depth an edge still shows: the slope of that piece times the line's reach. */
static float edge_slack(const ref_scene *scene, const ref_piece *kept)
{
    float reach = (float)ref_greatest_offset(scene) * (1.0f / 256.0f) + 0.5f;
    float slope = (fabsf(kept->z_dx) + fabsf(kept->z_dy)) * reach;
    return ref_min(slope, kept->z_max - kept->z_min);
}

/* R36 */
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

/* The samples of a pixel that a piece covers up to the far plane, a bit each, and their depths. */
static uint32_t covered_samples(const ref_scene *scene, const ref_piece *piece, int32_t x, int32_t y, float z[E3D_MOST_MSAA_SAMPLES])
{
    uint32_t covered = 0;
    for (int32_t n = 0; n < scene->pixel_samples; n++) {
        offset from_centre = offset_of(scene, n);
        if (!covers(piece, x, y, from_centre))
            continue;
        z[n] = depth_at(scene, piece, x, y, from_centre);
        if (!(z[n] > 1.0f))
            covered |= (uint32_t)1 << n;
    }
    return covered;
}

/* R16 and R17 */
static e3d_status raster_pixel(const ref_scene *scene, const ref_piece *piece, int64_t number, int32_t x, int32_t y, ref_band *band)
{
    float z[E3D_MOST_MSAA_SAMPLES];
    uint32_t covered = covered_samples(scene, piece, x, y, z);
    e3d_status status = E3D_OK;
    covered = covered ? ref_alpha_covers(scene, piece, x, y, covered) : 0;
    for (int32_t n = 0; n < scene->pixel_samples && status == E3D_OK; n++) {
        const ref_place at = {x, y, n, 0};
        if (!(covered >> n & 1))
            continue;
        if (piece->primitive.kind == REF_EDGE)
            keep_edge(scene, z[n], band, ref_sample_at(band, &at));
        else
            status = keep_fragment(scene, piece, number, z[n], band, ref_sample_at(band, &at));
    }
    return status;
}

static e3d_status raster_piece(const ref_scene *scene, const ref_piece *piece, int64_t number, ref_band *band)
{
    int32_t last_row = band->first_row + band->rows - 1;
    int32_t top = piece->top > band->first_row ? piece->top : band->first_row;
    int32_t bottom = piece->bottom < last_row ? piece->bottom : last_row;
    e3d_status status = E3D_OK;
    for (int32_t y = top; y <= bottom; y++)
        for (int32_t x = piece->left; x <= piece->right && status == E3D_OK; x++)
            status = raster_pixel(scene, piece, number, x, y, band);
    return status;
}

static int farther_first(const void *left, const void *right)
{
    const ref_piece *a = left, *b = right;
    if (a->painter_key != b->painter_key)
        return a->painter_key > b->painter_key ? -1 : 1;
    return a->order < b->order ? -1 : a->order > b->order;
}

/* R16 */
void ref_sort_for_painter(ref_piece_list *pieces)
{
    if (pieces->count > 1)
        qsort(pieces->items, (size_t)pieces->count, sizeof *pieces->items, farther_first);
}

e3d_status ref_raster_band(const ref_scene *scene, ref_band *band)
{
    size_t samples = (size_t)band->rows * (size_t)band->width * (size_t)band->pixel_samples;
    for (size_t sample = 0; sample < samples; sample++) {
        band->depth[sample] = INFINITY;
        band->piece[sample] = -1;
        band->overdraw[sample] = 0;
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
