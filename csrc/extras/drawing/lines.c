/* Finds the edges that are outlines, borders or creases in a view, and cuts all lines by its planes. */
#include "extras/drawing/lines.h"

#include <math.h>
#include <stdlib.h>

/* Triangles are seen from the front if the angle to the line of sight has at least this sine. */
#define EDGE_ON 1e-6

/* More than the share of its terms by which a sum of a few of them is wrong. */
#define ROUNDING 0x1p-48

enum { SIDES = 4 };

/* The planes that cut lines: what is kept has a x + b y + c z + d >= 0. */
typedef struct cutter {
    double planes[E3D_VIEW_PLANES + SIDES][4];
    size_t count;
} cutter;

/* Leaves out planes that all places are surely on the inner side of. */
static void forget_needless(cutter *by, const e3d_surface *of)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, nothing = 0;
    for (size_t i = 0; i < 3 * of->vertex_count; i += 3)
        for (size_t k = 0; k < 3; k++) {
            double at = of->places[i + k];
            low[k] = at < low[k] ? at : low[k];
            high[k] = at > high[k] ? at : high[k];
            nothing += at * 0; /* no number if the place is none */
        }
    size_t kept = 0;
    for (size_t i = 0; i < by->count; i++) {
        const double *plane = by->planes[i];
        double least = plane[3] + nothing, size = fabs(plane[3]);
        for (int k = 0; k < 3; k++) {
            double a = plane[k] * low[k], b = plane[k] * high[k];
            least += a < b ? a : b;
            size += fabs(a) > fabs(b) ? fabs(a) : fabs(b);
        }
        if (!(least > size * ROUNDING))
            memmove(by->planes[kept++], plane, sizeof by->planes[0]);
    }
    by->count = kept;
}

static cutter cutter_of(const e3d_view *view, size_t first)
{
    cutter made = {.count = 0};
    for (size_t i = first; i < view->plane_count; i++)
        memcpy(made.planes[made.count++], view->planes[i], sizeof made.planes[0]);
    for (int side = 0; side < SIDES; side++, made.count++)
        for (int k = 0; k < 4; k++) {
            double across = view->clip_from_world[4 * (side / 2) + k], w = view->clip_from_world[12 + k];
            made.planes[made.count][k] = side % 2 ? w - across : w + across;
        }
    return made;
}

static double height(const double plane[4], const double *place)
{
    return ((place[0] * plane[0] + place[1] * plane[1]) + place[2] * plane[2]) + plane[3];
}

/* Cuts a line; returns whether anything is left of it. */
static int cut(const cutter *by, double ends[6])
{
    for (size_t i = 0; i < by->count; i++) {
        double at[2] = {height(by->planes[i], ends), height(by->planes[i], ends + 3)};
        int inside[2] = {at[0] >= 0, at[1] >= 0};
        if (inside[0] && inside[1])
            continue;
        if (!inside[0] && !inside[1])
            return 0;
        int inner = inside[0] ? 0 : 1, outer = 1 - inner;
        double share = at[inner] / (at[inner] - at[outer]);
        for (int k = 0; k < 3; k++) {
            double from = ends[3 * inner + k];
            ends[3 * outer + k] = from + (ends[3 * outer + k] - from) * share;
        }
    }
    return 1;
}

static int add(e3d_array *lines, const cutter *by, const double *a, const double *b, int8_t kind, int32_t part, uint8_t is_behind)
{
    if (!e3d_array_reserve(lines, lines->count + 1, sizeof(drw_line)))
        return 0;
    drw_line *line = (drw_line *)lines->data + lines->count;
    *line = (drw_line){{a[0], a[1], a[2], b[0], b[1], b[2]}, part, kind, is_behind};
    lines->count += cut(by, line->ends) != 0;
    return 1;
}

static double length_of(const double v[3]) { return sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]); }

static int8_t facing_of(const double *normal, const double to_eye[3], double length)
{
    double sine = ((normal[0] * to_eye[0] + normal[1] * to_eye[1]) + normal[2] * to_eye[2]) / length;
    return (int8_t)((sine > EDGE_ON) - (sine < -EDGE_ON));
}

void drw_find_facing(const e3d_edges *edges, const double eye[4], int8_t *facing)
{
    const double *normal = edges->normals, length = length_of(eye);
    for (size_t face = 0; face < edges->of.face_count && eye[3] == 0; face++, normal += 3)
        facing[face] = facing_of(normal, eye, length);
    for (size_t face = 0; face < edges->of.face_count && eye[3] != 0; face++, normal += 3) {
        const double *place = edges->of.places + 3 * (size_t)edges->of.faces[3 * face];
        double to_eye[3] = {eye[0] - place[0] * eye[3], eye[1] - place[1] * eye[3], eye[2] - place[2] * eye[3]};
        facing[face] = facing_of(normal, to_eye, length_of(to_eye));
    }
}

uint8_t drw_is_back(const e3d_edges *edges, const int8_t *facing, int32_t face)
{
    return facing[face] && facing[face] == -edges->enclosing[face];
}

static int add_edges(const e3d_edges *edges, const int8_t *facing, const e3d_view *view, const cutter *by, e3d_array *lines)
{
    for (size_t i = 0; i < edges->count; i++) {
        const int32_t *ends = edges->ends + 2 * i, *beside = edges->beside + 2 * i;
        int is_outline = beside[1] >= 0 && (facing[beside[0]] > 0) != ((facing[beside[1]] > 0) ^ edges->turned[i]);
        if ((is_outline || edges->kinds[i] >= 0) &&
            !add(lines, by, edges->of.places + 3 * (size_t)ends[0], edges->of.places + 3 * (size_t)ends[1],
                 is_outline ? view->outline : edges->kinds[i], edges->parts[beside[0]],
                 view->is_outside && drw_is_back(edges, facing, beside[0]) && beside[1] >= 0 && drw_is_back(edges, facing, beside[1])))
            return 0;
    }
    return 1;
}

e3d_status drw_find_lines(const e3d_edges *edges, const int8_t *facing, const e3d_other_lines *others, const e3d_view *view,
                          e3d_array *lines)
{
    cutter all = cutter_of(view, 0), but_first = cutter_of(view, 1);
    cutter of_edges = all;
    forget_needless(&of_edges, &edges->of);
    int fits = add_edges(edges, facing, view, &of_edges, lines);
    for (size_t i = 0; fits && i < others->count; i++) {
        const double *ends = others->ends + 6 * i;
        fits = add(lines, i < others->cut ? &all : &but_first, ends, ends + 3, others->kinds[i], others->parts[i], 0);
    }
    return fits ? E3D_OK : E3D_OUT_OF_MEMORY;
}
