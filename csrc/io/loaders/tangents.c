/* Tangents: for each corner, the direction on the surface in which its texture's u grows.
 *
 * In:  triangles whose vertices have positions, normals and texture coordinates.
 * Out: groups of corners that share a tangent, and the tangents, with 1 or -1 for whether up is left or right of them.
 * Method: Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008: corners of neighbouring triangles that turn the image
 *      the same way are a group; its tangent is the sum of its triangles' directions, each in the plane of the normal and
 *      weighted by its angle there.
 * Always: + - * / and roots in double precision, in the order of the corners; what is not finite adds nothing.
 */
#include <math.h>
#include <stdlib.h>

#include "base/fpenv.h"
#include "base/joined_sets.h"
#include "e3d_surfaces.h"
#include "io/loaders/corner_angles.h"

/* A triangle: the direction to the right in its image, of length 1 or 0; and the way it turns the image, 0 while that is open. */
typedef struct turned {
    vector right;
    int turn;
} turned;

static vector vector_at(const float *rows, int32_t row)
{
    const float *v = rows + 3 * (size_t)row;
    return (vector){v[0], v[1], v[2]};
}

static vector scaled(vector v, double factor) { return (vector){v.x * factor, v.y * factor, v.z * factor}; }

/* Normalises; a vector without a usable length becomes 0. */
static vector unit(vector v)
{
    double length = length_of(v);
    return length > 0 && isfinite(length) ? scaled(v, 1 / length) : (vector){0, 0, 0};
}

/* Removes the part along n. */
static vector flattened(vector v, vector n) { return minus(v, scaled(n, dot(n, v))); }

static turned find_turn(const e3d_mapped_surface *s, const int32_t corners[3])
{
    const vector p = vector_at(s->positions, corners[0]);
    const vector e = minus(vector_at(s->positions, corners[1]), p), f = minus(vector_at(s->positions, corners[2]), p);
    const float *a = s->uvs + 2 * (size_t)corners[0], *b = s->uvs + 2 * (size_t)corners[1], *c = s->uvs + 2 * (size_t)corners[2];
    const double du = (double)b[0] - a[0], dv = (double)b[1] - a[1], eu = (double)c[0] - a[0], ev = (double)c[1] - a[1];
    const double area = du * ev - eu * dv;
    const int turn = (area > 0) - (area < 0);
    const vector right = unit(scaled(minus(scaled(e, ev), scaled(f, dv)), turn));
    return (turned){right, dot(right, right) > 0 ? turn : 0};
}

/* ---- neighbours ---- */

/* Side k of a triangle, from corner k to the next one, by the points at its ends. */
typedef struct sorted_side {
    int32_t lesser, greater;
    uint32_t number; /* 3 * triangle + k */
    int32_t is_up;   /* it goes from the lesser point to the greater */
} sorted_side;

static int compare_sides(const void *a, const void *b)
{
    const sorted_side *x = a, *y = b;
    if (x->lesser != y->lesser)
        return x->lesser < y->lesser ? -1 : 1;
    if (x->greater != y->greater)
        return x->greater < y->greater ? -1 : 1;
    if (x->is_up != y->is_up)
        return x->is_up < y->is_up ? -1 : 1;
    return x->number < y->number ? -1 : 1;
}

static uint32_t next_corner(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

static void sort_sides(const e3d_mapped_surface *s, sorted_side *sides)
{
    for (uint32_t n = 0; n < 3 * s->face_count; n++) {
        int32_t a = s->points[s->faces[n]], b = s->points[s->faces[next_corner(n)]];
        sides[n] = a < b ? (sorted_side){a, b, n, 1} : (sorted_side){b, a, n, 0};
    }
    qsort(sides, 3 * s->face_count, sizeof *sides, compare_sides);
}

enum { NONE = UINT32_MAX };

/* Pairs sides of opposite directions, in the order of their numbers. */
static void pair_sides(const sorted_side *sides, size_t count, uint32_t *other)
{
    for (size_t i = 0, end = 0; i < count; i = end) {
        size_t up = i;
        while (end < count && sides[end].lesser == sides[i].lesser && sides[end].greater == sides[i].greater)
            up = sides[end++].is_up ? up : end;
        for (size_t n = i; n < end; n++)
            other[sides[n].number] = NONE;
        for (size_t n = i, m = up; n < up && m < end && sides[i].lesser != sides[i].greater; n++, m++) {
            other[sides[n].number] = sides[m].number;
            other[sides[m].number] = sides[n].number;
        }
    }
}

/* A triangle of unknown turn takes that of a neighbour; the first triangle decides if none is known. */
static void spread_turns(const uint32_t *other, turned *faces, size_t count, uint32_t *queue)
{
    size_t last = 0;
    for (uint32_t f = 0; f < count; f++)
        if (faces[f].turn)
            queue[last++] = f;
    for (size_t first = 0; first < last; first++)
        for (uint32_t side = 3 * queue[first]; side < 3 * queue[first] + 3; side++) {
            if (other[side] == NONE || faces[other[side] / 3].turn)
                continue;
            faces[other[side] / 3].turn = faces[queue[first]].turn;
            queue[last++] = other[side] / 3;
        }
}

/* ---- groups ---- */

/* Numbers the groups in the order of their first corners; returns how many there are. */
static size_t number_groups(const uint32_t *other, const turned *faces, size_t face_count, uint32_t *parent, int32_t *groups)
{
    size_t count = 0;
    for (uint32_t n = 0; n < 3 * face_count; n++)
        parent[n] = n;
    for (uint32_t n = 0; n < 3 * face_count; n++) {
        if (other[n] == NONE || other[n] < n || faces[n / 3].turn != faces[other[n] / 3].turn)
            continue;
        e3d_join_sets(parent, n, next_corner(other[n]));
        e3d_join_sets(parent, next_corner(n), other[n]);
    }
    for (uint32_t n = 0; n < 3 * face_count; n++) {
        uint32_t root = e3d_set_of(parent, n);
        groups[n] = root == n ? (int32_t)count++ : groups[root];
    }
    return count;
}

/* ---- tangents ---- */

static void add_corner(const e3d_mapped_surface *s, const turned *face, size_t corner, double sum[3])
{
    const int32_t *corners = s->faces + 3 * (corner / 3);
    const size_t k = corner % 3;
    const vector n = unit(vector_at(s->normals, corners[k])), p = vector_at(s->positions, corners[k]);
    const vector after = unit(flattened(minus(vector_at(s->positions, corners[(k + 1) % 3]), p), n));
    const vector before = unit(flattened(minus(vector_at(s->positions, corners[(k + 2) % 3]), p), n));
    const vector right = unit(flattened(face->right, n));
    const double angle = arc_cosine(dot(after, before));
    if (!isfinite(angle * right.x) || !isfinite(angle * right.y) || !isfinite(angle * right.z))
        return;
    sum[0] += angle * right.x;
    sum[1] += angle * right.y;
    sum[2] += angle * right.z;
}

static void write_tangent(const double sum[3], int turn, float out[4])
{
    const vector t = unit((vector){sum[0], sum[1], sum[2]});
    const int is_some = dot(t, t) > 0;
    out[0] = is_some ? (float)t.x : 1.0f;
    out[1] = (float)t.y;
    out[2] = (float)t.z;
    out[3] = turn < 0 ? -1.0f : 1.0f;
}

static bool add_groups(const e3d_mapped_surface *s, const turned *faces, size_t count, const int32_t *groups, float *tangents)
{
    double (*sums)[3] = calloc(count + 1, sizeof *sums);
    if (!sums)
        return false;
    for (size_t n = 0; n < 3 * s->face_count; n++)
        add_corner(s, &faces[n / 3], n, sums[groups[n]]);
    for (size_t n = 0; n < 3 * s->face_count; n++)
        write_tangent(sums[groups[n]], faces[n / 3].turn, tangents + 4 * (size_t)groups[n]);
    free(sums);
    return true;
}

/* Not inlined, so that no arithmetic moves out of the floating-point environment. */
__attribute__((noinline)) static bool find_tangents(const e3d_mapped_surface *s, turned *faces, sorted_side *sides, uint32_t *words,
                                                    int32_t *groups, float *tangents, size_t *count)
{
    uint32_t *other = words, *spare = words + 3 * s->face_count;
    for (size_t f = 0; f < s->face_count; f++)
        faces[f] = find_turn(s, s->faces + 3 * f);
    sort_sides(s, sides);
    pair_sides(sides, 3 * s->face_count, other);
    spread_turns(other, faces, s->face_count, spare);
    *count = number_groups(other, faces, s->face_count, spare, groups);
    return add_groups(s, faces, *count, groups, tangents);
}

bool e3d_find_tangents(const e3d_mapped_surface *surface, int32_t *groups, float *tangents, size_t *group_count)
{
    turned *faces = malloc((surface->face_count + 1) * sizeof *faces);
    sorted_side *sides = malloc((3 * surface->face_count + 1) * sizeof *sides);
    uint32_t *words = malloc((6 * surface->face_count + 1) * sizeof *words);
    bool done = false;
    if (faces && sides && words) {
        const e3d_fpenv saved = e3d_fpenv_enter();
        done = find_tangents(surface, faces, sides, words, groups, tangents, group_count);
        e3d_fpenv_leave(saved);
    }
    free(words);
    free(sides);
    free(faces);
    return done;
}
