/* Clusters: a mesh's triangles in runs of up to 64 that lie together and face alike.
 *
 * In:  a checked mesh description.
 * Out: clusters with their boxes, cones of normals and own positions; groups of neighbouring clusters.
 * Always: the same arrays give the same clusters on any number of threads: ordered triangles (face_order.c) are cut into
 *      chunks of a fixed size, and each chunk is built by itself. Corners at the same place share a vertex, since geometry
 *      needs the position alone; where vertices are moved, those that move alike. A cluster's positions are structure of
 *      arrays, padded with its first vertex; a chunk's are one slab.
 */
#include "data/mesh/clusters.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "data/bounds.h"
#include "base/large_pages.h"
#include "base/pool.h"
#include "base/vectors.h"

enum {
    CHUNK_FACES = 8192,
    /* Each cluster holds at least 42 triangles (126 / 3), except for the last one of a chunk. */
    LEAST_FACES = (E3D_CLUSTER_VERTICES - 2) / 3,
    INDEX_FLOATS = 3 * E3D_CLUSTER_TRIANGLES / 4, /* the room for a cluster's indices */
    PLACES = 512, /* slots of the hash table of at most 128 positions */
    RECENT = 256  /* so many vertices of the mesh are cached with their members */
};

/* A position; if vertices move, their mover is the fourth word. Two places are the same if their bits are equal. */
typedef union place {
    float at[4];
    float4 all;
    uint64_t bits[2];
} place;

typedef struct corner {
    place place;
    int32_t vertex;
} corner;

typedef struct building {
    e3d_mesh *mesh;
    e3d_cluster *clusters; /* room for `bound` clusters of each chunk, which uses the first counts[chunk] */
    int32_t *counts;
    int32_t bound, chunks;
    atomic_int next, failed;
} building;

/* A thread's own memory. */
typedef struct builder {
    const e3d_mesh_desc *desc;
    e3d_cluster *now;                          /* the cluster that is being built */
    float *data;                               /* positions and indices of the chunk's clusters */
    size_t used;
    place members[E3D_CLUSTER_VERTICES];
    uint8_t indices[3 * E3D_CLUSTER_TRIANGLES];
    uint8_t local[PLACES];                     /* slots of the hash table: index of a member + 1, or 0 */
    struct {
        int32_t vertex;
        uint8_t member;
    } recent[RECENT];                          /* a cache in front of the hash table, by the vertex's number */
} builder;

/* ---- one cluster ---- */

static place place_of(const float *p, int components)
{
    uint64_t xy;
    uint32_t z, w = 0;
    memcpy(&xy, p, sizeof xy);
    memcpy(&z, p + 2, sizeof z);
    if (components == 4)
        memcpy(&w, p + 3, sizeof w);
    return (place){.bits = {xy, z | (uint64_t)w << 32}};
}

static uint32_t hash_of(place p)
{
    return (uint32_t)((p.bits[0] * 0x9E3779B97F4A7C15u + p.bits[1] * 0xC2B2AE3D27D4EB4Fu) >> 55);
}

/* The index of the member at a place, which is added if it is new. */
static inline uint8_t find_member(builder *b, place p)
{
    uint32_t at = hash_of(p);
    for (; b->local[at]; at = (at + 1) % PLACES) {
        const place *other = &b->members[b->local[at] - 1];
        if (other->bits[0] == p.bits[0] && other->bits[1] == p.bits[1])
            return b->local[at] - 1;
    }
    b->members[b->now->vertices] = p;
    b->local[at] = ++b->now->vertices;
    return b->local[at] - 1;
}

static void add_face(builder *b, const corner corners[3])
{
    e3d_cluster *c = b->now;
    for (int k = 0; k < 3; k++) {
        int32_t vertex = corners[k].vertex, slot = vertex % RECENT;
        if (b->recent[slot].vertex != vertex) {
            b->recent[slot].vertex = vertex;
            b->recent[slot].member = find_member(b, corners[k].place);
        }
        b->indices[k * E3D_CLUSTER_TRIANGLES + c->triangles] = b->recent[slot].member;
    }
    c->triangles++;
}

static void open_cluster(builder *b, int32_t first)
{
    *b->now = (e3d_cluster){.first = first};
    memset(b->indices, 0, sizeof b->indices);
    memset(b->local, 0, sizeof b->local);
    memset(b->recent, 255, sizeof b->recent);
}

static void bound_cluster(const builder *b)
{
    e3d_cluster *c = b->now;
    float4 lo = b->members[0].all, hi = lo, sum = splat(0);
    for (int v = 0; v < c->vertices; v++) {
        float4 p = b->members[v].all;
        lo = less_of(p, lo);
        hi = more_of(p, hi);
        sum += p - p; /* 0, or NaN if p isn't finite */
    }
    int32_t any = sum[0] == 0 && sum[1] == 0 && sum[2] == 0;
    for (int k = 0; k < 3 && any; k++) {
        c->lo[k] = lo[k];
        c->hi[k] = hi[k];
    }
    for (int v = 0; v < c->vertices && sum[0] + sum[1] + sum[2] != 0; v++)
        e3d_grow_bounds(b->members[v].at, c->lo, c->hi, &any);
    c->any_finite = (uint8_t)any;
}

static void close_cluster(builder *b)
{
    e3d_cluster *c = b->now;
    int components = b->desc->components;
    float *out = b->data + b->used;
    c->positions = out;
    c->stride = (uint8_t)((c->vertices + 15) & ~15);
    for (int v = c->vertices; v < c->stride; v++)
        b->members[v] = b->members[0];
    for (int k = 0; k < components; k++)
        for (int v = 0; v < c->stride; v++)
            out[k * c->stride + v] = b->members[v].at[k];
    memcpy(out + components * c->stride, b->indices, sizeof b->indices);
    b->used += (size_t)(components * c->stride + INDEX_FLOATS);
    bound_cluster(b);
    if (components == 3)
        e3d_find_cone(c);
    b->now++;
}

/* ---- a chunk of them ---- */

/* Loads the corners of faces in two loops of independent loads, so that cache misses overlap: corners lie anywhere in memory. */
static void fetch(const e3d_mesh_desc *d, const int32_t *faces, int32_t count, corner out[][3])
{
    for (int32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            out[i][k].vertex = d->faces[3 * (size_t)faces[i] + (size_t)k];
    for (int32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            out[i][k].place = place_of(d->positions + (size_t)out[i][k].vertex * (size_t)d->components, d->components);
    for (int32_t i = 0; i < count && d->movers; i++)
        for (int k = 0; k < 3; k++)
            out[i][k].place.bits[1] |= (uint64_t)(uint32_t)d->movers[out[i][k].vertex] << 32;
}

static void build_clusters(builder *b, const int32_t *faces, int32_t first, int32_t end)
{
    corner corners[E3D_CLUSTER_TRIANGLES][3];
    open_cluster(b, first);
    for (int32_t at = first; at < end; at += E3D_CLUSTER_TRIANGLES) {
        int32_t count = end - at < E3D_CLUSTER_TRIANGLES ? end - at : E3D_CLUSTER_TRIANGLES;
        fetch(b->desc, faces + at, count, corners);
        for (int32_t i = 0; i < count; i++) {
            if (b->now->triangles == E3D_CLUSTER_TRIANGLES || b->now->vertices + 3 > E3D_CLUSTER_VERTICES) {
                close_cluster(b);
                open_cluster(b, at + i);
            }
            add_face(b, corners[i]);
        }
    }
    close_cluster(b);
}

/* Moves positions and indices from the thread's memory to a slab of their own. */
static int keep_data(building *work, builder *b, int32_t chunk)
{
    void *slab;
    if (posix_memalign(&slab, 64, b->used * sizeof(float)))
        return 0;
    memcpy(slab, b->data, b->used * sizeof(float));
    work->mesh->slabs[chunk] = slab;
    for (e3d_cluster *c = work->clusters + (size_t)chunk * (size_t)work->bound; c < b->now; c++)
        c->positions = (float *)slab + (c->positions - b->data);
    return 1;
}

static void build_chunk(building *work, builder *b, int32_t chunk)
{
    int32_t count = work->mesh->desc.faces_count, first = chunk * CHUNK_FACES;
    e3d_cluster *clusters = work->clusters + (size_t)chunk * (size_t)work->bound;
    b->now = clusters;
    b->used = 0;
    build_clusters(b, work->mesh->faces, first, count - first < CHUNK_FACES ? count : first + CHUNK_FACES);
    work->counts[chunk] = (int32_t)(b->now - clusters);
    if (!keep_data(work, b, chunk))
        atomic_store(&work->failed, 1);
}

static void build_chunks(void *argument, int worker)
{
    building *work = argument;
    const e3d_mesh_desc *desc = &work->mesh->desc;
    size_t most = (size_t)work->bound * (size_t)(desc->components * E3D_CLUSTER_VERTICES + INDEX_FLOATS);
    builder *b = malloc(sizeof *b);
    float *data = malloc(most * sizeof *data);
    (void)worker;
    if (b && data) {
        b->desc = desc;
        b->data = data;
        for (int32_t chunk; !work->failed && (chunk = atomic_fetch_add(&work->next, 1)) < work->chunks;)
            build_chunk(work, b, chunk);
    } else {
        atomic_store(&work->failed, 1);
    }
    free(b);
    free(data);
}

/* ---- a mesh ---- */

static int join_chunks(const building *work)
{
    e3d_mesh *mesh = work->mesh;
    size_t count = 0;
    for (int32_t i = 0; i < work->chunks; i++)
        count += (size_t)work->counts[i];
    mesh->clusters = malloc(count * sizeof *mesh->clusters);
    if (!mesh->clusters)
        return 0;
    for (int32_t i = 0; i < work->chunks; i++) {
        memcpy(mesh->clusters + mesh->cluster_count, work->clusters + (size_t)i * (size_t)work->bound,
               (size_t)work->counts[i] * sizeof *mesh->clusters);
        mesh->cluster_count += work->counts[i];
    }
    return 1;
}

static int group_clusters(e3d_mesh *mesh)
{
    mesh->group_count = (mesh->cluster_count + E3D_GROUP_CLUSTERS - 1) / E3D_GROUP_CLUSTERS;
    mesh->groups = malloc((size_t)mesh->group_count * sizeof *mesh->groups);
    if (!mesh->groups)
        return 0;
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
    return 1;
}

static int build_all(e3d_mesh *mesh, int threads)
{
    int32_t count = mesh->desc.faces_count;
    building work = {.mesh = mesh, .chunks = (count + CHUNK_FACES - 1) / CHUNK_FACES};
    work.bound = (count < CHUNK_FACES ? count : CHUNK_FACES) / LEAST_FACES + 1;
    mesh->slab_count = work.chunks;
    mesh->slabs = calloc((size_t)work.chunks, sizeof *mesh->slabs);
    work.counts = calloc((size_t)work.chunks, sizeof *work.counts);
    work.clusters = malloc((size_t)work.chunks * (size_t)work.bound * sizeof *work.clusters);
    int done = mesh->slabs && work.counts && work.clusters;
    if (done)
        e3d_pool_run(threads < work.chunks ? threads : work.chunks, build_chunks, &work);
    done = done && !work.failed && join_chunks(&work) && group_clusters(mesh);
    free(work.counts);
    free(work.clusters);
    return done;
}

int e3d_clusters_build(e3d_mesh *mesh, int threads)
{
    const e3d_mesh_desc *d = &mesh->desc;
    float lo[3], hi[3];
    mesh->faces = e3d_large_memory(((size_t)d->faces_count + E3D_CLUSTER_TRIANGLES) * sizeof *mesh->faces);
    if (!mesh->faces)
        return 0;
    /* Padding, since whole vectors are read */
    memset(mesh->faces + d->faces_count, 0, E3D_CLUSTER_TRIANGLES * sizeof *mesh->faces);
    /* It has one cluster, or is a clip-space mesh, which is drawn once */
    if (d->components == 4 || d->faces_count <= E3D_CLUSTER_TRIANGLES) {
        for (int32_t f = 0; f < d->faces_count; f++)
            mesh->faces[f] = f;
    } else {
        e3d_bound_points(d->positions, d->vertices, lo, hi);
        if (!e3d_order_faces(d, lo, hi, threads, mesh->faces))
            return 0;
    }
    return d->faces_count == 0 || build_all(mesh, threads);
}
