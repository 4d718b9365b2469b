/* Clusters: a mesh's triangles in runs of up to 64 that lie together and face alike.
 *
 * In:  a checked mesh description.
 * Out: clusters with their boxes, cones of normals and own positions; groups of neighbouring clusters.
 * Always: the same arrays give the same clusters. Triangles are sorted by the cell of a coarse grid along a Morton curve, then by
 *      the side that they face, then by a fine grid; thin ones, whose facing is least certain, stand apart. Corners at
 *      the same place share a vertex: what a cluster is for, the position alone decides. A cluster's positions
 *      are structure of arrays, padded with its first vertex.
 */
#include "core/clusters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/grow.h"

/* ---- the order of triangles ---- */

typedef struct keyed {
    uint32_t key;
    int32_t face;
} keyed;

enum {
    GRID_BITS = 9,       /* cells an axis: 512 */
    FACES_A_CELL = 512,  /* about as many in a cell of the coarse grid */
    SIDE_BITS = 3,
    DIGIT_BITS = 11,
    DIGITS = 1 << DIGIT_BITS
};

static void corners_of(const e3d_mesh_desc *d, int32_t face, const float *p[3])
{
    for (int k = 0; k < 3; k++)
        p[k] = d->positions + (size_t)d->faces[3 * (size_t)face + k] * (size_t)d->components;
}

/* Twice the area vector, and the longest edge squared. */
static double face_vector(const float *const p[3], double n[3])
{
    double a[3], b[3], longest = 0;
    for (int k = 0; k < 3; k++) {
        a[k] = (double)p[1][k] - p[0][k];
        b[k] = (double)p[2][k] - p[0][k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    for (int e = 0; e < 3; e++) {
        double length = 0;
        for (int k = 0; k < 3; k++)
            length += (e == 0 ? a[k] : e == 1 ? b[k] : a[k] - b[k]) * (e == 0 ? a[k] : e == 1 ? b[k] : a[k] - b[k]);
        longest = length > longest ? length : longest;
    }
    return longest;
}

/* Bits of v, two places apart. */
static uint32_t spread(uint32_t v)
{
    v = (v | v << 16) & 0x030000FFu;
    v = (v | v << 8) & 0x0300F00Fu;
    v = (v | v << 4) & 0x030C30C3u;
    return (v | v << 2) & 0x09249249u;
}

static uint32_t cell_of(double v, double lo, double scale)
{
    double cell = (v - lo) * scale;
    return cell > 0 ? cell < (1 << GRID_BITS) - 1 ? (uint32_t)cell : (1 << GRID_BITS) - 1 : 0; /* a NaN is 0 */
}

/* One of six sides, by the greatest component; 6: thin, the longest edge is more than eight times the altitude. */
static uint32_t side_of(const float *const p[3])
{
    double n[3], longest = face_vector(p, n), area = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(8 * area > longest))
        return 6;
    int axis = fabs(n[1]) > fabs(n[0]);
    axis = fabs(n[2]) > fabs(n[axis]) ? 2 : axis;
    return 2 * (uint32_t)axis + (n[axis] < 0);
}

typedef struct grid {
    double lo[3], scale;
    int coarse; /* bits an axis */
} grid;

static uint32_t key_of(const e3d_mesh_desc *d, int32_t face, const grid *g)
{
    const float *p[3];
    uint32_t cell = 0;
    corners_of(d, face, p);
    for (int k = 0; k < 3; k++)
        cell |= spread(cell_of(((double)p[0][k] + p[1][k] + p[2][k]) / 3, g->lo[k], g->scale)) << k;
    int fine = 3 * (GRID_BITS - g->coarse);
    return ((cell >> fine) << SIDE_BITS | side_of(p)) << fine | (cell & ((1u << fine) - 1));
}

static grid grid_of(const e3d_mesh_desc *d, const float lo[3], const float hi[3])
{
    grid g = {.coarse = 0};
    double size = 0;
    for (int k = 0; k < 3; k++) {
        g.lo[k] = lo[k];
        size = (double)hi[k] - lo[k] > size ? (double)hi[k] - lo[k] : size;
    }
    g.scale = size > 0 ? (1 << GRID_BITS) / size : 0;
    while (g.coarse < GRID_BITS && (int64_t)FACES_A_CELL << (2 * (g.coarse + 1)) <= d->faces_count)
        g.coarse++; /* a surface meets about 4^n cells of 8^n */
    return g;
}

/* One pass of a stable radix sort. */
static void sort_digit(const keyed *from, keyed *to, int32_t count, int shift)
{
    uint32_t start[DIGITS] = {0}, total = 0;
    for (int32_t i = 0; i < count; i++)
        start[from[i].key >> shift & (DIGITS - 1)]++;
    for (int b = 0; b < DIGITS; b++) {
        uint32_t here = start[b];
        start[b] = total;
        total += here;
    }
    for (int32_t i = 0; i < count; i++)
        to[start[from[i].key >> shift & (DIGITS - 1)]++] = from[i];
}

/* mesh->faces: the faces in the order in which clusters take them. Clip-space meshes are drawn once, as they are. */
static int order_faces(e3d_mesh *mesh, const float lo[3], const float hi[3])
{
    const e3d_mesh_desc *d = &mesh->desc;
    if (d->components == 4 || d->faces_count <= E3D_CLUSTER_TRIANGLES) {
        for (int32_t f = 0; f < d->faces_count; f++)
            mesh->faces[f] = f;
        return 1;
    }
    keyed *keys = malloc(2 * (size_t)d->faces_count * sizeof *keys);
    if (!keys)
        return 0;
    keyed *other = keys + d->faces_count;
    grid g = grid_of(d, lo, hi);
    for (int32_t f = 0; f < d->faces_count; f++)
        keys[f] = (keyed){key_of(d, f, &g), f};
    sort_digit(keys, other, d->faces_count, 0);
    sort_digit(other, keys, d->faces_count, DIGIT_BITS);
    sort_digit(keys, other, d->faces_count, 2 * DIGIT_BITS);
    for (int32_t f = 0; f < d->faces_count; f++)
        mesh->faces[f] = other[f].face;
    free(keys);
    return 1;
}

/* ---- one cluster after the other ---- */

enum { PLACES = 512 }; /* of a hash table of at most 128 positions */

typedef struct builder {
    e3d_mesh *mesh;
    e3d_array positions;                    /* float */
    e3d_cluster *now;
    const float *member[E3D_CLUSTER_VERTICES];
    uint8_t place[PLACES];                  /* local index + 1, 0: free */
    uint16_t taken[E3D_CLUSTER_VERTICES];   /* the places of the members */
} builder;

static uint32_t hash_position(const float *p, int components)
{
    uint32_t bits, h = 0;
    for (int k = 0; k < components; k++) {
        memcpy(&bits, p + k, 4);
        h = (h ^ bits) * 0x9E3779B1u;
        h ^= h >> 15;
    }
    return h % PLACES;
}

/* Where the position stands in the table, or the free place where it would. */
static uint32_t find_place(const builder *b, const float *p)
{
    int components = b->mesh->desc.components;
    uint32_t at = hash_position(p, components);
    while (b->place[at] && memcmp(b->member[b->place[at] - 1], p, (size_t)components * 4))
        at = (at + 1) % PLACES;
    return at;
}

void e3d_grow_bounds(const float *p, float lo[3], float hi[3], int32_t *any)
{
    if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2]))
        return;
    for (int k = 0; k < 3; k++) {
        lo[k] = *any && lo[k] < p[k] ? lo[k] : p[k];
        hi[k] = *any && hi[k] > p[k] ? hi[k] : p[k];
    }
    *any = 1;
}

static int store_positions(builder *b)
{
    e3d_cluster *c = b->now;
    int components = b->mesh->desc.components;
    c->stride = (c->vertices + 15) & ~15;
    size_t size = (size_t)c->stride * (size_t)components;
    if (!e3d_array_reserve(&b->positions, b->positions.count + size, sizeof(float)))
        return 0;
    float *out = (float *)b->positions.data + b->positions.count;
    c->positions = b->positions.count;
    b->positions.count += size;
    for (int32_t v = 0; v < c->stride; v++)
        for (int k = 0; k < components; k++)
            out[k * c->stride + v] = b->member[v < c->vertices ? v : 0][k];
    for (int32_t v = 0; v < c->vertices; v++)
        e3d_grow_bounds(b->member[v], c->lo, c->hi, &c->any_finite);
    return 1;
}

/* The mean direction of the faces, and the least cosine to it; the least altitude. None where one has no area. */
static void find_cone(const builder *b, e3d_cluster *c)
{
    const e3d_mesh *mesh = b->mesh;
    double normals[E3D_CLUSTER_TRIANGLES][3], sum[3] = {0, 0, 0}, altitude = INFINITY, least = 1;
    c->altitude = 0;
    for (int32_t t = 0; t < c->triangles; t++) {
        const float *p[3];
        corners_of(&mesh->desc, mesh->faces[c->first + t], p);
        double longest = face_vector(p, normals[t]), area = 0;
        for (int k = 0; k < 3; k++)
            area += normals[t][k] * normals[t][k];
        area = sqrt(area);
        if (!(area > 0) || !isfinite(area))
            return;
        altitude = area / sqrt(longest) < altitude ? area / sqrt(longest) : altitude;
        for (int k = 0; k < 3; k++)
            sum[k] += normals[t][k] /= area;
    }
    double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    if (!(length > 0))
        return;
    for (int k = 0; k < 3; k++)
        c->axis[k] = (float)(sum[k] / length);
    for (int32_t t = 0; t < c->triangles; t++) {
        double cosine = 0;
        for (int k = 0; k < 3; k++)
            cosine += normals[t][k] * c->axis[k];
        least = cosine < least ? cosine : least;
    }
    c->cosine = (float)(least - 1e-5);
    c->altitude = c->cosine > 0 ? (float)(altitude * 0.999) : 0;
}

static int close_cluster(builder *b)
{
    if (!b->now)
        return 1;
    for (int32_t v = 0; v < b->now->vertices; v++)
        b->place[b->taken[v]] = 0;
    if (b->mesh->desc.components == 3)
        find_cone(b, b->now);
    return store_positions(b);
}

static void open_cluster(builder *b, int32_t first)
{
    e3d_mesh *mesh = b->mesh;
    b->now = &mesh->clusters[mesh->cluster_count];
    memset(b->now, 0, sizeof *b->now);
    b->now->first = first;
    b->now->indices = (size_t)mesh->cluster_count++ * 3 * E3D_CLUSTER_TRIANGLES;
}

static void add_face(builder *b, const float *const p[3])
{
    e3d_cluster *c = b->now;
    for (int k = 0; k < 3; k++) {
        uint32_t at = find_place(b, p[k]);
        if (!b->place[at]) {
            b->member[c->vertices] = p[k];
            b->taken[c->vertices] = (uint16_t)at;
            b->place[at] = (uint8_t)++c->vertices;
        }
        b->mesh->indices[c->indices + (size_t)(k * E3D_CLUSTER_TRIANGLES + c->triangles)] = b->place[at] - 1;
    }
    c->triangles++;
}

static int build_clusters(builder *b)
{
    e3d_mesh *mesh = b->mesh;
    for (int32_t i = 0; i < mesh->desc.faces_count; i++) {
        const float *p[3];
        corners_of(&mesh->desc, mesh->faces[i], p);
        if (!b->now || b->now->triangles == E3D_CLUSTER_TRIANGLES ||
            b->now->vertices + 3 > E3D_CLUSTER_VERTICES) {
            if (!close_cluster(b))
                return 0;
            open_cluster(b, i);
        }
        add_face(b, p);
    }
    return close_cluster(b);
}

static void group_clusters(e3d_mesh *mesh)
{
    for (int32_t c = 0; c < mesh->cluster_count; c++) {
        e3d_group_box *group = &mesh->groups[c / E3D_GROUP_CLUSTERS];
        const e3d_cluster *cluster = &mesh->clusters[c];
        if (c % E3D_GROUP_CLUSTERS == 0)
            *group = (e3d_group_box){.first_cluster = c};
        group->clusters++;
        group->triangles += cluster->triangles;
        if (cluster->any_finite) {
            e3d_grow_bounds(cluster->lo, group->lo, group->hi, &group->any_finite);
            e3d_grow_bounds(cluster->hi, group->lo, group->hi, &group->any_finite);
        }
    }
    mesh->group_count = (mesh->cluster_count + E3D_GROUP_CLUSTERS - 1) / E3D_GROUP_CLUSTERS;
}

/* Clusters hold at least 42 triangles (126 / 3) except the last, so this bounds their number. */
static size_t cluster_bound(int32_t faces) { return (size_t)faces / 42 + 1; }

static int allocate(e3d_mesh *mesh)
{
    size_t clusters = cluster_bound(mesh->desc.faces_count), faces = (size_t)mesh->desc.faces_count;
    mesh->clusters = malloc(clusters * sizeof *mesh->clusters);
    mesh->groups = malloc((clusters / E3D_GROUP_CLUSTERS + 1) * sizeof *mesh->groups);
    mesh->indices = calloc(clusters, 3 * E3D_CLUSTER_TRIANGLES);
    mesh->faces = calloc(faces + E3D_CLUSTER_TRIANGLES, sizeof *mesh->faces); /* whole vectors are read */
    return mesh->clusters && mesh->groups && mesh->indices && mesh->faces;
}

static void *shrunk(void *data, size_t size)
{
    void *smaller = realloc(data, size ? size : 1);
    return smaller ? smaller : data;
}

int e3d_clusters_build(e3d_mesh *mesh, const float lo[3], const float hi[3])
{
    builder *b = allocate(mesh) ? calloc(1, sizeof *b) : NULL;
    if (!b)
        return 0;
    b->mesh = mesh;
    int done = order_faces(mesh, lo, hi) && build_clusters(b);
    mesh->positions = shrunk(b->positions.data, b->positions.count * sizeof(float));
    mesh->clusters = shrunk(mesh->clusters, (size_t)mesh->cluster_count * sizeof *mesh->clusters);
    mesh->indices = shrunk(mesh->indices, (size_t)mesh->cluster_count * 3 * E3D_CLUSTER_TRIANGLES);
    free(b);
    if (done)
        group_clusters(mesh);
    return done;
}
