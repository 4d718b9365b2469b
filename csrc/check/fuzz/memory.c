/* Fuzzes what happens when memory runs out: some allocation fails, and perhaps all behind it.
 *
 * In:  a byte: what is done; a byte: which allocation fails, whether those behind it do; then the data.
 * Claims: each says so, and frees what it had. Linked so that the allocations of the core come through here.
 */
#include "check/fuzz/input.h"
#include "e3d_images.h"
#include "e3d_loaders.h"
#include "e3d_navigation.h"
#include "e3d_scene.h"

#include <errno.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
int __real_posix_memalign(void **room, size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
int __wrap_posix_memalign(void **room, size_t alignment, size_t size);

static int until_failure = -1, failures, then_all;

static int fails(void)
{
    const int failing = until_failure == 0 || (then_all && failures);
    until_failure -= until_failure >= 0;
    failures += failing;
    return failing;
}

void *__wrap_malloc(size_t size) { return fails() ? NULL : __real_malloc(size); }
void *__wrap_calloc(size_t count, size_t size) { return fails() ? NULL : __real_calloc(count, size); }
void *__wrap_realloc(void *old, size_t size) { return fails() ? NULL : __real_realloc(old, size); }
int __wrap_posix_memalign(void **room, size_t alignment, size_t size)
{
    return fails() ? ENOMEM : __real_posix_memalign(room, alignment, size);
}

/* Each returns whether it went well. */

static int read_obj(input in)
{
    e3d_obj obj;
    const e3d_obj_problem problem = e3d_obj_parse(in.at, in.left, &obj);
    e3d_obj_free(&obj);
    return problem != E3D_OBJ_NO_MEMORY;
}

static int write_png(input in)
{
    uint8_t *file = NULL;
    size_t size = 0;
    if (in.left < 4)
        return 1;
    const size_t width = 1 + in.at[0] % 16, all = in.left / 4, height = all / width;
    if (height == 0)
        return 1;
    const int done = e3d_png_encode(in.at, (int32_t)width, (int32_t)height, (ptrdiff_t)(4 * width), 4, 8, &file, &size);
    if (done)
        free(file);
    return done;
}

static int number_rows(input in)
{
    int32_t numbers[512];
    uint32_t *found = NULL;
    e3d_rows rows = {.bytes = in.at, .width = 1, .in_record = 1, .stride = 4};
    rows.count = in.left / 4 < 512 ? in.left / 4 : 512;
    if (rows.count == 0)
        return 1;
    const int done = e3d_number_rows(&rows, numbers, NULL, &found) != SIZE_MAX;
    free(found);
    return done && e3d_rows_repeat(&rows) >= 0;
}

static int weld(input in)
{
    int32_t given[256], faces[256], made[256];
    size_t count = in.left < 256 ? in.left : 256;
    for (size_t i = 0; i < count; i++)
        given[i] = in.at[i];
    return e3d_weld_corners(given, NULL, NULL, count, 256, faces, made, NULL, NULL) != SIZE_MAX;
}

static int build_tree(input in)
{
    double boxes[E3D_BOX * 40];
    int done = 1;
    for (int k = 0; k < E3D_BOX * 40; k++)
        boxes[k] = take_number(&in);
    const int32_t count = take_below(&in, 41);
    int32_t moved[40];
    for (int k = 0; k < 40; k++)
        moved[k] = k;
    e3d_tree *tree = e3d_tree_create();
    if (!tree)
        return 0;
    for (int32_t first = count / 2; done && first <= count; first += 1 + count / 4)
        done = e3d_tree_refit(tree, boxes, first, moved, first, 1);
    e3d_tree_destroy(tree);
    return done;
}

static int find_ground(input in)
{
    const e3d_navigation_desc desc = {.cell = 0.5, .columns = 9, .rows = 9, .min_normal_y = 0.1, .headroom = 1.0};
    const int32_t face[3] = {0, 1, 2}, material = 0;
    const uint8_t kind = 3;
    float positions[9];
    for (int k = 0; k < 9; k++)
        positions[k] = (float)take_number(&in);
    e3d_navigation_mesh mesh = {.positions = positions,
                                .faces = face,
                                .faces_count = 1,
                                .material_ids = &material,
                                .kinds = &kind,
                                .world_from_mesh = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    e3d_navigation *grid = NULL;
    if (e3d_navigation_create(&desc, &grid) != E3D_OK)
        return 0;
    const int done = e3d_navigation_add_ground(grid, &mesh) == E3D_OK && e3d_navigation_sort(grid) == E3D_OK;
    if (done)
        e3d_navigation_add_obstacles(grid, &mesh);
    e3d_navigation_destroy(grid);
    return done;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static int (*const works[])(input) = {read_obj, write_png, number_rows, weld, build_tree, find_ground};
    input in = {bytes, size};
    int (*const work)(input) = works[take_below(&in, sizeof works / sizeof *works)];
    const uint32_t when = take_byte(&in);
    failures = 0;
    then_all = when >> 7;
    until_failure = (int)(when & 127);
    const int done = work(in);
    until_failure = -1;
    then_all = 0;
    /* A tree that finds no room for what is new is built again. */
    CLAIM(failures == 0 ? done : !done || work == build_tree);
    return 0;
}
