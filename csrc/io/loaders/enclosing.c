/* Finds whether triangles enclose a volume, with their fronts outside.
 * In: positions, triangles, the place of each vertex. Out: yes or no.
 * They do if each side is run along equally often in both directions, and each connected part has a positive volume. A
 * triangle with two corners at one place has no area, and does not count. Volumes are sums in double precision, from the
 * middle of the first triangle, in the order of the triangles. */
#include "e3d_surfaces.h"

#include "base/fpenv.h"
#include "io/loaders/corner_angles.h"
#include "io/loaders/short_sort.h"

#include <stdlib.h>

/* Lists of up to this many are sorted by insertion. */
#define SHORT 48

/* A triangle's side, listed at the lower of its places. */
typedef struct side {
    int32_t end, face; /* the higher place */
    int32_t way;       /* 1 if the triangle runs upward along it, else -1 */
} side;

typedef struct work {
    const e3d_creased_surface *surface;
    size_t *starts;   /* [place_count + 2] */
    side *sides;      /* [3 * face_count] */
    int32_t *parents; /* [face_count] the parts, as trees of triangles */
    double *volumes;  /* [face_count] six times a part's volume, at its root */
} work;

static int32_t place_of(const e3d_creased_surface *s, int32_t vertex) { return s->places ? s->places[vertex] : vertex; }

/* The places of a triangle; false if two are the same. */
static bool places_of(const e3d_creased_surface *s, size_t face, int32_t places[3])
{
    for (size_t k = 0; k < 3; k++)
        places[k] = place_of(s, s->faces[3 * face + k]);
    return places[0] != places[1] && places[1] != places[2] && places[2] != places[0];
}

static int compare_sides(const void *one, const void *other)
{
    const side *const a = one, *const b = other;
    if (a->end != b->end)
        return a->end < b->end ? -1 : 1;
    return (a->face > b->face) - (a->face < b->face);
}

E3D_DEFINE_SHORT_SORT(sort_sides, side, compare_sides, SHORT)

/* Lists the sides of each place. */
static void list_sides(work *w)
{
    const e3d_creased_surface *const s = w->surface;
    size_t *const ends = w->starts + 1;
    int32_t places[3];
    for (size_t face = 0; face < s->face_count; face++)
        for (size_t k = 0; places_of(s, face, places) && k < 3; k++) {
            const int32_t from = places[k], to = places[(k + 1) % 3];
            ends[from < to ? from : to]++;
        }
    size_t total = 0;
    for (size_t place = 0; place < s->place_count; place++) {
        const size_t count = ends[place];
        ends[place] = total;
        total += count;
    }
    for (size_t face = 0; face < s->face_count; face++)
        for (size_t k = 0; places_of(s, face, places) && k < 3; k++) {
            const int32_t from = places[k], to = places[(k + 1) % 3];
            const bool upward = from < to;
            w->sides[ends[upward ? from : to]++] = (side){upward ? to : from, (int32_t)face, upward ? 1 : -1};
        }
}

static int32_t root_of(int32_t *parents, int32_t face)
{
    for (; parents[face] != face; face = parents[face])
        parents[face] = parents[parents[face]];
    return face;
}

/* Joins the triangles of each side; false if one isn't run along equally often in both directions. */
static bool join_sides(work *w)
{
    for (size_t place = 0; place < w->surface->place_count; place++) {
        const size_t end = w->starts[place + 1];
        sort_sides(w->sides + w->starts[place], end - w->starts[place]);
        int64_t ways = 0;
        for (size_t i = w->starts[place]; i < end; i++) {
            const side *const one = &w->sides[i];
            ways += one->way;
            if (i + 1 == end || one[1].end != one->end) {
                if (ways != 0)
                    return false;
                continue;
            }
            const int32_t a = root_of(w->parents, one->face), b = root_of(w->parents, one[1].face);
            w->parents[a > b ? a : b] = a > b ? b : a;
        }
    }
    return true;
}

static vector position_at(const e3d_creased_surface *s, int32_t vertex)
{
    const float *const p = s->positions + 3 * (size_t)vertex;
    return (vector){p[0], p[1], p[2]};
}

/* Whether all parts have a positive volume. */
static bool are_positive(work *w)
{
    const e3d_creased_surface *const s = w->surface;
    const vector middle = position_at(s, s->faces[0]);
    bool any = false;
    int32_t places[3];
    for (size_t face = 0; face < s->face_count; face++) {
        const int32_t *const corners = s->faces + 3 * face;
        const vector a = minus(position_at(s, corners[0]), middle), b = minus(position_at(s, corners[1]), middle),
                     c = minus(position_at(s, corners[2]), middle);
        const vector cross = {b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x};
        w->volumes[root_of(w->parents, (int32_t)face)] += dot(a, cross);
    }
    for (size_t face = 0; face < s->face_count; face++) {
        if (w->parents[face] != (int32_t)face || !places_of(s, face, places))
            continue;
        any = true;
        if (!(w->volumes[face] > 0) || !isfinite(w->volumes[face]))
            return false;
    }
    return any;
}

int e3d_encloses(const e3d_creased_surface *surface)
{
    const size_t faces = surface->face_count;
    work w = {surface, calloc(surface->place_count + 2, sizeof *w.starts), malloc((3 * faces + 1) * sizeof *w.sides),
              malloc((faces + 1) * sizeof *w.parents), calloc(faces + 1, sizeof *w.volumes)};
    int found = -1;
    const bool has_room = w.starts && w.sides && w.parents && w.volumes;
    if (has_room) {
        const e3d_fpenv saved = e3d_fpenv_enter();
        for (size_t face = 0; face < faces; face++)
            w.parents[face] = (int32_t)face;
        list_sides(&w);
        found = faces > 0 && join_sides(&w) && are_positive(&w);
        e3d_fpenv_leave(saved);
    }
    free(w.starts), free(w.sides), free(w.parents), free(w.volumes);
    return found;
}

/* Writes the open sides of a place; -2 as in e3d_find_open_sides. */
static int64_t take_open(const work *w, size_t place, int32_t *sides, size_t room)
{
    const size_t end = w->starts[place + 1];
    int64_t found = 0, ways = 0;
    size_t first = w->starts[place];
    for (size_t i = first; i < end; i++) {
        const side *const one = &w->sides[i];
        ways += one->way;
        if (i + 1 < end && one[1].end == one->end)
            continue;
        if (ways != 0) {
            if (i != first || (size_t)found == room)
                return -2;
            sides[2 * found] = one->way > 0 ? (int32_t)place : one->end;
            sides[2 * found + 1] = one->way > 0 ? one->end : (int32_t)place;
            found++;
        }
        ways = 0;
        first = i + 1;
    }
    return found;
}

int64_t e3d_find_open_sides(const e3d_creased_surface *surface, int32_t *sides, size_t room)
{
    work w = {.surface = surface,
              .starts = calloc(surface->place_count + 2, sizeof *w.starts),
              .sides = malloc((3 * surface->face_count + 1) * sizeof *w.sides)};
    int64_t found = -1;
    if (w.starts && w.sides) {
        list_sides(&w);
        found = 0;
        for (size_t place = 0; place < surface->place_count && found >= 0; place++) {
            sort_sides(w.sides + w.starts[place], w.starts[place + 1] - w.starts[place]);
            const int64_t more = take_open(&w, place, sides + 2 * found, room - (size_t)found);
            found = more < 0 ? more : found + more;
        }
    }
    free(w.starts), free(w.sides);
    return found;
}
