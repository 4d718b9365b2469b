/* Random scene graphs for the driver: nodes are moved, and what the tree over their boxes finds is hashed. */
#include "check/driver/scenes/graph_scene.h"

#include <stdio.h>
#include <stdlib.h>

#include "e3d_scene.h"

/* Enough for several tasks of an update, and for a tree that is built by several threads. */
enum { MOST_NODES = 6000,
       WORDS = MOST_NODES / 64 + 1,
       OBJECTS = 2,
       ROUNDS = 3 };

static const double OBJECT_BOXES[OBJECTS][E3D_OBJECT_BOX] = {{-1, -1, -1, 1, 1, 1, 1, 1, 1}, {-2, -1, 0, 1, 1, 3, 2, 1, 3}};

/* A graph with its memory. */
typedef struct nodes {
    int32_t words[9][MOST_NODES];
    double numbers[12 + 4 + 3 + 12 + E3D_BOX][MOST_NODES];
    uint32_t versions[2][MOST_NODES];
    uint8_t flags[MOST_NODES];
} nodes;

static e3d_graph empty_graph(nodes *n)
{
    return (e3d_graph){.parent = n->words[0],
                       .first_child = n->words[1],
                       .last_child = n->words[2],
                       .next = n->words[3],
                       .previous = n->words[4],
                       .object = n->words[5],
                       .id = n->words[6],
                       .changed = n->words[7],
                       .stack = n->words[8],
                       .flags = n->flags,
                       .pose = n->numbers[0],
                       .rotation = n->numbers[12],
                       .scale = n->numbers[16],
                       .world = n->numbers[19],
                       .bounds = n->numbers[31],
                       .pose_version = n->versions[0],
                       .world_version = n->versions[1]};
}

static void move_some(e3d_graph *g, random_stream *r)
{
    int32_t moves = random_once_in(r, 2) ? g->count : random_below(r, g->count);
    for (int32_t m = 0; m < moves; m++) {
        double pose[12];
        int32_t slot = moves == g->count ? m : random_below(r, g->count);
        for (int k = 0; k < 12; k++)
            pose[k] = random_float(r, -1.0f, k % 4 == 3 ? 60.0f : 1.0f);
        e3d_graph_set_pose(g, slot, pose);
    }
}

/* 0 when memory is out. */
static int follow(e3d_graph *g, e3d_tree *tree, int round, int threads)
{
    e3d_graph_update(g, OBJECT_BOXES[0], OBJECTS, threads);
    int done = round == 0 ? e3d_tree_build(tree, g->bounds, g->count, threads)
                          : e3d_tree_refit(tree, g->bounds, g->count, g->changed, g->changed_count, threads);
    g->changed_count = 0;
    return done;
}

static uint64_t hash_graph(uint64_t hash, const e3d_graph *g, const e3d_tree *tree)
{
    const double low[3] = {0, 0, 0}, high[3] = {30, 30, 30};
    uint64_t found[WORDS] = {0};
    size_t count = (size_t)g->count;
    e3d_tree_overlaps(tree, low, high, found);
    hash = hash_bytes(hash, (const uint8_t *)g->world, 12 * count * sizeof(double));
    hash = hash_bytes(hash, (const uint8_t *)g->bounds, E3D_BOX * count * sizeof(double));
    return hash_bytes(hash, (const uint8_t *)found, sizeof found);
}

/* 0 when memory is out. */
static uint64_t live(random_stream r, int threads)
{
    nodes *memory = calloc(1, sizeof *memory);
    e3d_tree *tree = e3d_tree_create();
    uint64_t hash = HASH_START;
    if (memory && tree) {
        e3d_graph g = empty_graph(memory);
        int32_t count = 1 + random_below(&r, MOST_NODES);
        for (int32_t i = 0; i < count; i++) {
            int32_t parent = i == 0 || random_once_in(&r, 2) ? -1 : random_below(&r, i);
            e3d_graph_add(&g, parent, random_below(&r, OBJECTS + 1) - 1, i);
        }
        for (int round = 0; round < ROUNDS && hash; round++) {
            move_some(&g, &r);
            hash = follow(&g, tree, round, threads) ? hash_graph(hash, &g, tree) : 0;
        }
    }
    if (tree)
        e3d_tree_destroy(tree);
    free(memory);
    return memory && tree ? hash : 0;
}

outcome compare_graph(random_stream r, const run_plan *plan, const char *title)
{
    outcome result = {.hash = live(r, 1), .agrees = 1};
    result.status = result.hash ? E3D_OK : E3D_OUT_OF_MEMORY;
    for (int32_t t = 0; t < plan->thread_counts; t++)
        result.agrees &= live(r, plan->threads[t]) == result.hash;
    if (!result.agrees && title != NULL)
        fprintf(stderr, "%s: thread counts differ\n", title);
    return result;
}
