/* Normals of a surface that is smooth but for its creases (R145): the edges where triangles meet at more than an angle.
 *
 * In:  positions, triangles, the place of each vertex, and the cosine of the angle. Out: triangles whose corners are split where
 * they have to be, and the normal of each vertex.
 * Round each place, triangles that share an edge that is no crease are of one fan, and so on from triangle to triangle; a fan has
 * one normal, the sum of its triangles' unit normals, each times its angle there. Triangles that run along an edge the same way
 * are turned against each other: one counts as if it were turned over, and has the opposite normal. A vertex is split if its
 * corners are of several fans: the first keeps it, the others get vertices behind all that there are.
 * Every operation is one of + - * / and the square root in double precision; what a triangle brings is rounded to floats.
 * Always: sums go along the triangles in their order, place by place, so nothing else decides about their bits.
 */
#include "e3d_surfaces.h"

#include "base/fpenv.h"
#include "io/loaders/corner_angles.h"
#include "io/loaders/short_sort.h"

#include <stdlib.h>
#include <string.h>

/* If more than two triangles share an edge, each is compared with so many that follow it. */
#define COMPARED 8
/* Lists of up to this many are sorted by insertion. */
#define SHORT 48

/* What a triangle contributes: its unit normal (0 without area), and its angles. */
typedef struct facet {
    float normal[3], angles[3];
} facet;

/* An edge at a place; its corner is numbered in the place's list. */
typedef struct spoke {
    int32_t end;     /* the place where it ends */
    int32_t corner;
    uint8_t leaves;  /* whether the triangle runs along it from here */
    uint8_t hidden;  /* whether it is the diagonal of a polygon */
} spoke;

/* A corner's fan, as a tree of corners; and whether the corner is turned against its parent. */
typedef struct member {
    int32_t parent;
    uint8_t turned;
} member;

/* A corner, sorted by the vertex that it needs. */
typedef struct claim {
    int32_t vertex, fan, corner;
    uint8_t turned;
} claim;

typedef struct work {
    const e3d_creased_surface *surface;
    facet *facets;    /* [face_count] */
    size_t *starts;   /* [place_count + 1] where the corners of a place are listed */
    int32_t *corners; /* [3 * face_count] */
    spoke *spokes;    /* of one place */
    member *members;
    claim *claims;
    double (*sums)[3];
    e3d_creases *made;
    size_t room; /* the room of made->sources, and of the added normals */
} work;

static vector position_at(const e3d_creased_surface *s, int32_t vertex)
{
    const float *const p = s->positions + 3 * (size_t)vertex;
    return (vector){p[0], p[1], p[2]};
}

static int32_t place_of(const e3d_creased_surface *s, int32_t vertex) { return s->places ? s->places[vertex] : vertex; }

static facet facet_of(const e3d_creased_surface *s, const int32_t *corners)
{
    const vector a = position_at(s, corners[0]), b = position_at(s, corners[1]), c = position_at(s, corners[2]);
    const vector edges[3] = {minus(b, a), minus(c, b), minus(a, c)};
    const double lengths[3] = {length_of(edges[0]), length_of(edges[1]), length_of(edges[2])};
    const vector ac = minus(c, a);
    const vector area = {edges[0].y * ac.z - edges[0].z * ac.y, edges[0].z * ac.x - edges[0].x * ac.z,
                         edges[0].x * ac.y - edges[0].y * ac.x};
    const double length = length_of(area);
    facet made = {{0, 0, 0}, {0, 0, 0}};
    if (!isfinite(length) || length == 0)
        return made;
    made.normal[0] = (float)(area.x / length);
    made.normal[1] = (float)(area.y / length);
    made.normal[2] = (float)(area.z / length);
    for (size_t k = 0; k < 3; k++) {
        const size_t back = (k + 2) % 3;
        const double arc = arc_cosine(-dot(edges[k], edges[back]) / (lengths[k] * lengths[back]));
        made.angles[k] = isfinite(arc) ? (float)arc : 0.0f;
    }
    return made;
}

/* Lists the corners of each place, in the order of the triangles. */
static void list_corners(work *w)
{
    const e3d_creased_surface *const s = w->surface;
    const size_t corners = 3 * s->face_count;
    size_t *const ends = w->starts + 1;
    for (size_t c = 0; c < corners; c++)
        ends[place_of(s, s->faces[c])]++;
    size_t total = 0;
    for (size_t place = 0; place < s->place_count; place++) {
        const size_t count = ends[place];
        ends[place] = total; /* where the list begins, until its corners are filled in */
        total += count;
    }
    for (size_t c = 0; c < corners; c++)
        w->corners[ends[place_of(s, s->faces[c])]++] = (int32_t)c;
}

static int compare_spokes(const void *one, const void *other)
{
    const spoke *const a = one, *const b = other;
    if (a->end != b->end)
        return a->end < b->end ? -1 : 1;
    if (a->corner != b->corner)
        return a->corner < b->corner ? -1 : 1;
    return a->leaves - b->leaves;
}

E3D_DEFINE_SHORT_SORT(sort_spokes, spoke, compare_spokes, SHORT)

static int compare_claims(const void *one, const void *other)
{
    const claim *const a = one, *const b = other;
    if (a->vertex != b->vertex)
        return a->vertex < b->vertex ? -1 : 1;
    if (a->fan != b->fan)
        return a->fan < b->fan ? -1 : 1;
    if (a->turned != b->turned)
        return a->turned - b->turned;
    return (a->corner > b->corner) - (a->corner < b->corner);
}

E3D_DEFINE_SHORT_SORT(sort_claims, claim, compare_claims, SHORT)

/* Finds the root of a member's fan, and whether the member is turned against it. */
static member root_of(member *members, int32_t corner)
{
    member found = {corner, 0};
    while (members[found.parent].parent != found.parent) {
        member *const m = &members[found.parent], *const above = &members[m->parent];
        if (above->parent != m->parent) { /* path halving: the next search is shorter */
            m->turned ^= above->turned;
            m->parent = above->parent;
        }
        found.turned ^= m->turned;
        found.parent = m->parent;
    }
    return found;
}

/* Joins two corners' fans; the lower root stays. */
static void join(member *members, int32_t one, int32_t other, uint8_t turned)
{
    member a = root_of(members, one), b = root_of(members, other);
    if (a.parent == b.parent)
        return;
    if (a.parent > b.parent) {
        const member c = a;
        a = b, b = c;
    }
    members[b.parent] = (member){a.parent, a.turned ^ b.turned ^ turned};
}

static const facet *facet_at(const work *w, const int32_t *list, int32_t corner) { return &w->facets[list[corner] / 3]; }

/* Joins two triangles if their common edge is no crease. */
static void compare(work *w, const int32_t *list, const spoke *one, const spoke *other)
{
    const float *const a = facet_at(w, list, one->corner)->normal, *const b = facet_at(w, list, other->corner)->normal;
    const double product = (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
    const uint8_t turned = one->leaves == other->leaves;
    if ((one->hidden && other->hidden) || (turned ? -product : product) >= w->surface->cosine)
        join(w->members, one->corner, other->corner, turned);
}

static int has_area(const facet *f) { return f->normal[0] != 0 || f->normal[1] != 0 || f->normal[2] != 0; }

/* Finds the edges at a place whose triangles have an area. */
static size_t find_spokes(work *w, const int32_t *list, size_t count)
{
    const e3d_creased_surface *const s = w->surface;
    size_t spokes = 0;
    for (size_t i = 0; i < count; i++) {
        const size_t face = (size_t)list[i] / 3, k = (size_t)list[i] % 3, next = (k + 1) % 3, back = (k + 2) % 3;
        if (!has_area(&w->facets[face]))
            continue;
        const int32_t *const corners = s->faces + 3 * face;
        const uint8_t *const visible = s->visible ? s->visible + 3 * face : NULL;
        w->spokes[spokes++] = (spoke){place_of(s, corners[next]), (int32_t)i, 1, visible && !visible[k]};
        w->spokes[spokes++] = (spoke){place_of(s, corners[back]), (int32_t)i, 0, visible && !visible[back]};
    }
    return spokes;
}

/* Finds the fans of a place, and sums up their triangles at the first corner of each fan. */
static void find_fans(work *w, const int32_t *list, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        w->members[i] = (member){(int32_t)i, 0};
        w->sums[i][0] = w->sums[i][1] = w->sums[i][2] = 0;
    }
    const size_t spokes = find_spokes(w, list, count);
    sort_spokes(w->spokes, spokes);
    for (size_t i = 0; i < spokes; i++)
        for (size_t j = i + 1; j < spokes && j <= i + COMPARED && w->spokes[j].end == w->spokes[i].end; j++)
            compare(w, list, &w->spokes[i], &w->spokes[j]);
    for (size_t i = 0; i < count; i++) {
        const member m = root_of(w->members, (int32_t)i);
        const facet *const f = facet_at(w, list, (int32_t)i);
        const double angle = m.turned ? -f->angles[list[i] % 3] : f->angles[list[i] % 3];
        for (size_t axis = 0; axis < 3; axis++)
            w->sums[m.parent][axis] += angle * f->normal[axis];
    }
}

/* Makes room for one more vertex behind the first ones. */
static int make_room(work *w)
{
    e3d_creases *const made = w->made;
    if (made->added < w->room)
        return 1;
    const size_t room = w->room ? 2 * w->room : 256, all = w->surface->position_count + room;
    int32_t *const sources = realloc(made->sources, room * sizeof *sources);
    if (sources)
        made->sources = sources;
    float *const normals = realloc(made->normals, 3 * all * sizeof *normals);
    if (normals)
        made->normals = normals;
    if (!sources || !normals)
        return 0;
    w->room = room;
    return 1;
}

static void put_normal(const work *w, size_t vertex, const claim *c)
{
    const double *const sum = w->sums[c->fan];
    const double length = length_of((vector){sum[0], sum[1], sum[2]});
    float *const normal = w->made->normals + 3 * vertex;
    for (size_t axis = 0; axis < 3; axis++) {
        const double part = length > 0 ? sum[axis] / length : 0;
        normal[axis] = (float)(c->turned ? -part : part);
    }
}

/* Gives each corner of a place its vertex. */
static int split(work *w, const int32_t *list, size_t count)
{
    const e3d_creased_surface *const s = w->surface;
    int32_t whole = -1; /* the first fan of triangles with an area; corners without one join it */
    for (size_t i = 0; i < count && whole < 0; i++)
        if (has_area(facet_at(w, list, (int32_t)i)))
            whole = root_of(w->members, (int32_t)i).parent;
    for (size_t i = 0; i < count; i++) {
        const member m = root_of(w->members, (int32_t)i);
        const int has = has_area(facet_at(w, list, (int32_t)i));
        const int32_t joined = whole < 0 ? 0 : whole, fan = has ? m.parent : joined;
        w->claims[i] = (claim){s->faces[list[i]], fan, (int32_t)i, has ? m.turned : 0};
        w->made->is_smooth &= (whole < 0 || fan == whole) && !w->claims[i].turned;
    }
    sort_claims(w->claims, count);
    size_t vertex = 0;
    for (size_t i = 0; i < count; i++) {
        const claim *const c = &w->claims[i], *const before = i ? c - 1 : NULL;
        if (!before || before->vertex != c->vertex) {
            vertex = (size_t)c->vertex;
            put_normal(w, vertex, c);
        } else if (before->fan != c->fan || before->turned != c->turned) {
            if (!make_room(w))
                return 0;
            w->made->sources[w->made->added] = c->vertex;
            vertex = s->position_count + w->made->added++;
            put_normal(w, vertex, c);
        }
        w->made->faces[list[c->corner]] = (int32_t)vertex;
    }
    return 1;
}

static int allocate(work *w)
{
    const e3d_creased_surface *const s = w->surface;
    e3d_creases *const made = w->made;
    w->facets = malloc((s->face_count + 1) * sizeof *w->facets);
    w->starts = calloc(s->place_count + 2, sizeof *w->starts);
    w->corners = malloc((3 * s->face_count + 1) * sizeof *w->corners);
    made->faces = malloc((3 * s->face_count + 1) * sizeof *made->faces);
    made->normals = calloc(3 * s->position_count + 1, sizeof *made->normals);
    return w->facets && w->starts && w->corners && made->faces && made->normals;
}

/* Makes room for the data of one place. */
static int allocate_place(work *w)
{
    size_t most = 1;
    for (size_t place = 0; place < w->surface->place_count; place++)
        most = w->starts[place + 1] - w->starts[place] > most ? w->starts[place + 1] - w->starts[place] : most;
    w->spokes = malloc(2 * most * sizeof *w->spokes);
    w->members = malloc(most * sizeof *w->members);
    w->claims = malloc(most * sizeof *w->claims);
    w->sums = malloc(most * sizeof *w->sums);
    return w->spokes && w->members && w->claims && w->sums;
}

static int find_creases(work *w)
{
    const e3d_creased_surface *const s = w->surface;
    if (!allocate(w))
        return 0;
    list_corners(w);
    if (!allocate_place(w))
        return 0;
    for (size_t face = 0; face < s->face_count; face++)
        w->facets[face] = facet_of(s, s->faces + 3 * face);
    w->made->is_smooth = true;
    for (size_t place = 0; place < s->place_count; place++) {
        const size_t start = w->starts[place], count = w->starts[place + 1] - start;
        find_fans(w, w->corners + start, count);
        if (!split(w, w->corners + start, count))
            return 0;
    }
    return 1;
}

bool e3d_find_creases(const e3d_creased_surface *surface, e3d_creases *made)
{
    work w = {.surface = surface, .made = made};
    memset(made, 0, sizeof *made);
    const e3d_fpenv saved = e3d_fpenv_enter();
    const int done = find_creases(&w);
    e3d_fpenv_leave(saved);
    free(w.facets), free(w.starts), free(w.corners);
    free(w.spokes), free(w.members), free(w.claims), free(w.sums);
    if (!done)
        e3d_free_creases(made);
    return done;
}

void e3d_free_creases(e3d_creases *made)
{
    free(made->faces), free(made->sources), free(made->normals);
    memset(made, 0, sizeof *made);
}
