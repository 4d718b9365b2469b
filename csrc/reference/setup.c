/* Setup: from clip space to pieces, which are triangles on the screen with their planes.
 * In: accepted or clipped corners of a triangle, line or point.
 * Out: pieces at the end of the scene's list. Each has a positive area, a sample box that is not empty, edge functions, a
 * depth plane and barycentric planes.
 * Rules: R8 (screen), R9 (area, facing), R10 (box), R11 (lines, points), R12 (a, b), R13 (depth), R18 (barycentrics), R114
 * (round lines), R115 (round points). */
#include <math.h>
#include <stdlib.h>

#include "data/half_circle.h"
#include "reference/arithmetic.h"
#include "reference/stages.h"

/* A corner on the screen, in 1/256 sample, Y down. */
typedef struct screen_corner {
    int32_t x, y;
    float z, iw;
    float barycentric[3];
} screen_corner;

/* R8. Returns 0 if the corner cannot be placed. Only a clipped corner can lie behind the eye or beyond the guard band,
 * through the rounding of the cut. */
static int project(const ref_scene *scene, const ref_corner *corner, int clipped, screen_corner *out)
{
    float iw = 1.0f / corner->position[3];
    float x = corner->position[0] * iw, y = corner->position[1] * iw;
    float half_x = (float)(128 * scene->width), half_y = (float)(128 * scene->height);
    out->iw = iw;
    out->z = corner->position[2] * iw;
    if (!isfinite(x) || !isfinite(y) || !isfinite(iw) || !isfinite(out->z) || !(iw > 0.0f))
        return 0;
    if (clipped) {
        x = ref_clamp(x, -scene->guard_x, scene->guard_x);
        y = ref_clamp(y, -scene->guard_y, scene->guard_y);
    }
    out->x = ref_rint(x * half_x + half_x);
    out->y = ref_rint(half_y - y * half_y);
    for (int c = 0; c < 3; c++)
        out->barycentric[c] = corner->barycentric[c];
    return 1;
}

static int64_t double_area(const screen_corner v[3])
{
    int64_t ax = v[1].x - v[0].x, ay = v[1].y - v[0].y;
    int64_t cx = v[2].x - v[0].x, cy = v[2].y - v[0].y;
    return ax * cy - cx * ay;
}

/* Whether the box of a piece reaches into an aperture of the frame. */
static int meets_aperture(const e3d_frame *frame, const ref_piece *piece)
{
    for (int32_t i = 0; i < frame->aperture_count; i++) {
        const e3d_aperture *w = &frame->apertures[i];
        int32_t axis = frame->samples_axis;
        if (piece->left < axis * (w->x1 + 1) && piece->right >= axis * w->x0 && piece->top < axis * (w->y1 + 1) &&
            piece->bottom >= axis * w->y0)
            return 1;
    }
    return 0;
}

/* R9 for a piece whose box is known. */
static int is_culled(const ref_scene *scene, const ref_piece *piece)
{
    const e3d_frame *frame = scene->frame;
    if (piece->primitive.kind != REF_FACE || piece->primitive.material->two_sided)
        return 0;
    if (piece->front)
        return frame->cull == E3D_CULL_FRONT;
    return frame->cull == E3D_CULL_BACK && !meets_aperture(frame, piece);
}

static int32_t min3(const int32_t v[3])
{
    int32_t m = v[0] < v[1] ? v[0] : v[1];
    return m < v[2] ? m : v[2];
}

static int32_t max3(const int32_t v[3])
{
    int32_t m = v[0] > v[1] ? v[0] : v[1];
    return m > v[2] ? m : v[2];
}

/* R10 and R104. Returns 0 if the box holds no sample of the viewport. */
static int setup_box(const ref_scene *scene, ref_piece *piece)
{
    int32_t reach = scene->pattern ? scene->pattern->reach : 0;
    piece->left = ref_floor_256(min3(piece->x) - reach - 128 + 255);
    piece->right = ref_floor_256(max3(piece->x) + reach - 128);
    piece->top = ref_floor_256(min3(piece->y) - reach - 128 + 255);
    piece->bottom = ref_floor_256(max3(piece->y) + reach - 128);
    if (piece->left < 0)
        piece->left = 0;
    if (piece->top < 0)
        piece->top = 0;
    if (piece->right > scene->width - 1)
        piece->right = scene->width - 1;
    if (piece->bottom > scene->height - 1)
        piece->bottom = scene->height - 1;
    return piece->left <= piece->right && piece->top <= piece->bottom;
}

/* R12 */
static void setup_edges(ref_piece *piece)
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        piece->a[k] = (int64_t)piece->y[i] - piece->y[j];
        piece->b[k] = (int64_t)piece->x[j] - piece->x[i];
    }
}

/* R13. Returns 0 if the plane is not finite. */
static int setup_depth(ref_piece *piece, const screen_corner v[3], int64_t area)
{
    double ax = (double)(v[1].x - v[0].x), ay = (double)(v[1].y - v[0].y);
    double cx = (double)(v[2].x - v[0].x), cy = (double)(v[2].y - v[0].y);
    double d1 = (double)v[1].z - (double)v[0].z, d2 = (double)v[2].z - (double)v[0].z;
    double r = 256.0 / (double)area;
    double gx = (d1 * cy - d2 * ay) * r;
    double gy = (d2 * ax - d1 * cx) * r;
    double ex = (double)(256 * piece->left + 128 - v[0].x) / 256.0;
    double ey = (double)(256 * piece->top + 128 - v[0].y) / 256.0;
    piece->z0 = (float)(((double)v[0].z + ex * gx) + ey * gy);
    piece->z_dx = (float)gx;
    piece->z_dy = (float)gy;
    piece->z_min = ref_min(ref_min(v[0].z, v[1].z), v[2].z);
    piece->z_max = ref_max(ref_max(v[0].z, v[1].z), v[2].z);
    piece->painter_key = (v[0].z + v[1].z) + v[2].z;
    return isfinite(piece->z0) && isfinite(piece->z_dx) && isfinite(piece->z_dy);
}

/* R18. Every corner carries its barycentrics in the original primitive. For a whole triangle they are unit vectors, for which
 * the change of basis is exact and undoes the exchange of R9. */
static void setup_barycentrics(ref_piece *piece, const screen_corner v[3], int64_t area)
{
    double m = 0.0, ra = 1.0 / (double)area;
    double p[3], px[3], py[3];
    for (int k = 0; k < 3; k++)
        m = (double)v[k].iw > m ? (double)v[k].iw : m;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        double q = (double)v[k].iw * (1.0 / m);
        int64_t e = piece->a[k] * (256 * piece->left + 128 - piece->x[i]) +
                    piece->b[k] * (256 * piece->top + 128 - piece->y[i]);
        p[k] = ((double)e * ra) * q;
        px[k] = ((double)(256 * piece->a[k]) * ra) * q;
        py[k] = ((double)(256 * piece->b[k]) * ra) * q;
    }
    for (int j = 0; j < 3; j++) {
        double c0 = (double)v[0].barycentric[j], c1 = (double)v[1].barycentric[j],
               c2 = (double)v[2].barycentric[j];
        piece->bary0[j] = (float)((p[0] * c0 + p[1] * c1) + p[2] * c2);
        piece->bary_dx[j] = (float)((px[0] * c0 + px[1] * c1) + px[2] * c2);
        piece->bary_dy[j] = (float)((py[0] * c0 + py[1] * c1) + py[2] * c2);
    }
}

static e3d_status append(ref_piece_list *list, const ref_piece *piece)
{
    if (list->count == list->capacity) {
        int64_t capacity = list->capacity ? 2 * list->capacity : 256;
        ref_piece *items = realloc(list->items, (size_t)capacity * sizeof *items);
        if (!items)
            return E3D_OUT_OF_MEMORY;
        list->items = items;
        list->capacity = capacity;
    }
    list->items[list->count] = *piece;
    list->items[list->count].order = list->count;
    list->count++;
    return E3D_OK;
}

/* R9, and everything that follows from it: all kinds of primitives end here. */
static e3d_status setup_piece(ref_scene *scene, const ref_primitive *primitive, const screen_corner corners[3])
{
    int64_t area = double_area(corners);
    int faces_us = (area < 0) ^ scene->instances[primitive->instance].mirrored;
    ref_piece piece = {.primitive = *primitive, .front = primitive->kind != REF_FACE || faces_us};
    if (area == 0)
        return E3D_OK;
    int swap = area < 0;
    screen_corner v[3] = {corners[0], corners[swap ? 2 : 1], corners[swap ? 1 : 2]};
    area = swap ? -area : area;
    for (int k = 0; k < 3; k++) {
        piece.x[k] = v[k].x;
        piece.y[k] = v[k].y;
    }
    if (!setup_box(scene, &piece) || is_culled(scene, &piece) || !setup_depth(&piece, v, area))
        return E3D_OK;
    setup_edges(&piece);
    setup_barycentrics(&piece, v, area);
    scene->stats.triangles_setup++;
    return append(primitive->kind == REF_EDGE ? &scene->edges : &scene->pieces, &piece);
}

e3d_status ref_setup_triangle(ref_scene *scene, const ref_primitive *primitive, const ref_corner corners[3],
                              int clipped)
{
    screen_corner v[3];
    for (int k = 0; k < 3; k++)
        if (!project(scene, &corners[k], clipped, &v[k]))
            return E3D_OK;
    return setup_piece(scene, primitive, v);
}

static screen_corner shifted(screen_corner v, int32_t dx, int32_t dy)
{
    v.x += dx;
    v.y += dy;
    return v;
}

static e3d_status setup_quad(ref_scene *scene, const ref_primitive *primitive, const screen_corner quad[4])
{
    screen_corner first[3] = {quad[0], quad[1], quad[2]}, second[3] = {quad[0], quad[2], quad[3]};
    e3d_status status = setup_piece(scene, primitive, first);
    return status == E3D_OK ? setup_piece(scene, primitive, second) : status;
}

/* R11: half a line's width or a point's size, in 1/256 sample. */
int32_t ref_half_size(const ref_scene *scene, float size)
{
    int32_t half = ref_rint((size * (float)scene->frame->samples_axis) * 128.0f);
    return half > 1 ? half : 1;
}

/* R11: how far a line reaches from its centre along its minor axis, in 1/256 sample. */
static int32_t line_offset(const ref_scene *scene, double dx, double dy)
{
    int32_t half = ref_half_size(scene, scene->frame->line_width);
    if (scene->frame->line_width <= 1.0f)
        return half;
    return (int32_t)lrint((double)half * sqrt(dx * dx + dy * dy) / (dx > dy ? dx : dy));
}

/* R36 */
int32_t ref_greatest_offset(const ref_scene *scene)
{
    int32_t half = ref_half_size(scene, scene->frame->line_width);
    return scene->frame->line_width <= 1.0f || scene->frame->line_shape == E3D_LINES_ROUND ? half : (int32_t)lrint((double)half * sqrt(2.0));
}

/* R114: the number of corners of a half circle, less one. */
static int arc_steps(int32_t radius)
{
    static const int32_t MOST[] = {128, 512, 2048, 8192, 32768};
    int steps = 2;
    for (int k = 0; k < 5 && radius > MOST[k]; k++)
        steps = 2 * steps;
    return steps;
}

/* R114: corner j of the half circle around v, which begins across the direction u, to its left on the screen. */
static screen_corner arc_corner(screen_corner v, int32_t radius, const double u[2], int j, int sign)
{
    int step = j * (E3D_HALF_CIRCLE / arc_steps(radius));
    double c = e3d_half_circle_cosine(step), s = e3d_half_circle_sine(step);
    int32_t dx = (int32_t)lrint((double)radius * (c * u[1] + s * u[0]));
    int32_t dy = (int32_t)lrint((double)radius * (s * u[1] - c * u[0]));
    return shifted(v, sign * dx, sign * dy);
}

static e3d_status setup_half_disc(ref_scene *scene, const ref_primitive *primitive, screen_corner v, int32_t radius,
                                  const double u[2], int sign)
{
    e3d_status status = E3D_OK;
    for (int j = 1; j < arc_steps(radius) && status == E3D_OK; j++) {
        screen_corner fan[3] = {arc_corner(v, radius, u, 0, sign), arc_corner(v, radius, u, j, sign),
                                arc_corner(v, radius, u, j + 1, sign)};
        status = setup_piece(scene, primitive, fan);
    }
    return status;
}

/* R114 */
static e3d_status setup_round_line(ref_scene *scene, const ref_primitive *primitive, const screen_corner v[2])
{
    int32_t half = ref_half_size(scene, scene->frame->line_width);
    double dx = (double)v[1].x - v[0].x, dy = (double)v[1].y - v[0].y, length = sqrt(dx * dx + dy * dy);
    double u[2] = {length > 0.0 ? dx / length : 1.0, length > 0.0 ? dy / length : 0.0};
    screen_corner quad[4] = {arc_corner(v[0], half, u, 0, 1), arc_corner(v[1], half, u, 0, 1),
                             arc_corner(v[1], half, u, 0, -1), arc_corner(v[0], half, u, 0, -1)};
    e3d_status status = setup_quad(scene, primitive, quad);
    if (status == E3D_OK)
        status = setup_half_disc(scene, primitive, v[1], half, u, 1);
    return status == E3D_OK ? setup_half_disc(scene, primitive, v[0], half, u, -1) : status;
}

e3d_status ref_setup_line(ref_scene *scene, const ref_primitive *primitive, const ref_corner ends[2],
                          int clipped)
{
    screen_corner v[2];
    if (!project(scene, &ends[0], clipped, &v[0]) || !project(scene, &ends[1], clipped, &v[1]))
        return E3D_OK;
    if (primitive->kind == REF_EDGE)
        for (int k = 0; k < 2; k++)
            v[k].z = v[k].z - E3D_WIRE_PULL;
    if (scene->frame->line_shape == E3D_LINES_ROUND)
        return setup_round_line(scene, primitive, v);
    long across = labs((long)v[1].x - v[0].x), down = labs((long)v[1].y - v[0].y);
    if (across == 0 && down == 0)
        return E3D_OK;
    int32_t offset = line_offset(scene, (double)across, (double)down);
    int32_t dx = across >= down ? 0 : offset, dy = across >= down ? offset : 0;
    screen_corner quad[4] = {shifted(v[0], -dx, -dy), shifted(v[1], -dx, -dy), shifted(v[1], dx, dy),
                             shifted(v[0], dx, dy)};
    return setup_quad(scene, primitive, quad);
}

/* R11 and R115 */
e3d_status ref_setup_point(ref_scene *scene, const ref_primitive *primitive, const ref_corner *corner)
{
    screen_corner v;
    if (!project(scene, corner, 0, &v))
        return E3D_OK;
    int32_t half = ref_half_size(scene, scene->frame->point_size);
    if (scene->frame->point_shape == E3D_POINTS_ROUND && half > E3D_LEAST_DISC) {
        static const double U[2] = {1.0, 0.0};
        e3d_status status = setup_half_disc(scene, primitive, v, half, U, 1);
        return status == E3D_OK ? setup_half_disc(scene, primitive, v, half, U, -1) : status;
    }
    screen_corner quad[4] = {shifted(v, -half, -half), shifted(v, half, -half), shifted(v, half, half),
                             shifted(v, -half, half)};
    return setup_quad(scene, primitive, quad);
}
