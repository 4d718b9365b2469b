/* Fuzzes navigation grids: any grid that is taken, any triangles.
 *
 * Claims: every cell's layers lie from below upward, finite; obstacles take walkable layers away and add none.
 */
#include "e3d_navigation.h"

#include <math.h>

#include "check/fuzz/input.h"

enum { MAX_SIDE = 12,
       MAX_VERTICES = 24,
       MAX_FACES = 24,
       MATERIALS = 4 };

static void take_mesh(input *in, e3d_navigation_mesh *mesh, float *positions, int32_t *faces, int32_t *ids,
                      uint8_t *kinds)
{
    const int32_t vertices = 1 + take_below(in, MAX_VERTICES);
    mesh->faces_count = take_below(in, MAX_FACES + 1);
    for (int32_t k = 0; k < 3 * vertices; k++)
        positions[k] = (float)take_number(in);
    for (int64_t k = 0; k < mesh->faces_count; k++) {
        for (int corner = 0; corner < 3; corner++)
            faces[3 * k + corner] = take_below(in, vertices);
        ids[k] = take_below(in, MATERIALS);
    }
    for (int k = 0; k < MATERIALS; k++)
        kinds[k] = (uint8_t)take_below(in, 4);
    for (int k = 0; k < 16; k++)
        mesh->world_from_mesh[k] = k % 5 ? 0.0 : 1.0;
    if (take_below(in, 2))
        for (int k = 0; k < 12; k++)
            mesh->world_from_mesh[k] = take_number(in);
    mesh->positions = positions;
    mesh->faces = faces;
    mesh->material_ids = ids;
    mesh->kinds = kinds;
}

/* Returns how many layers are walkable. */
static int64_t claim_layers(const e3d_navigation *grid, int32_t cells)
{
    e3d_navigation_view view;
    int64_t walkable = 0;
    e3d_navigation_get_view(grid, &view);
    CLAIM(view.starts[0] == 0 && view.starts[cells] == view.layers);
    for (int32_t cell = 0; cell < cells; cell++) {
        CLAIM(view.starts[cell] <= view.starts[cell + 1]);
        for (int32_t layer = view.starts[cell]; layer < view.starts[cell + 1]; layer++) {
            CLAIM(isfinite(view.height[layer]) && view.walkable[layer] <= 1);
            CLAIM(layer == view.starts[cell] || view.height[layer - 1] < view.height[layer]);
            walkable += view.walkable[layer];
        }
    }
    return walkable;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    e3d_navigation_desc desc = {.columns = take_below(&in, MAX_SIDE), .rows = take_below(&in, MAX_SIDE)};
    desc.x = take_number(&in);
    desc.z = take_number(&in);
    desc.cell = take_number(&in);
    desc.min_normal_y = take_number(&in);
    desc.step = take_number(&in);
    desc.headroom = take_number(&in);
    desc.radius = take_number(&in);
    e3d_navigation *grid;
    /* What Python refuses. */
    if (!isfinite(desc.x) || !isfinite(desc.z) || !(desc.cell < INFINITY) || !(desc.headroom < INFINITY) ||
        !(desc.radius < INFINITY) || !(desc.min_normal_y > 0.0 && desc.min_normal_y <= 1.0))
        return 0;
    if (e3d_navigation_create(&desc, &grid) != E3D_OK)
        return 0;
    float positions[3 * MAX_VERTICES];
    int32_t faces[3 * MAX_FACES], ids[MAX_FACES];
    uint8_t kinds[MATERIALS];
    e3d_navigation_mesh mesh;
    int64_t walkable = 0;
    take_mesh(&in, &mesh, positions, faces, ids, kinds);
    CLAIM(e3d_navigation_add_ground(grid, &mesh) == E3D_OK && e3d_navigation_sort(grid) == E3D_OK);
    for (int more = 0; more < 2; more++) {
        const int64_t left = claim_layers(grid, desc.columns * desc.rows);
        CLAIM(more == 0 || left <= walkable);
        walkable = left;
        e3d_navigation_add_obstacles(grid, &mesh);
        take_mesh(&in, &mesh, positions, faces, ids, kinds);
    }
    e3d_navigation_destroy(grid);
    return 0;
}
