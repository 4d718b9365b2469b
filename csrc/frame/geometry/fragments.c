/* bin: turns small triangles into fragments and lists these in their tiles. For a triangle of a few samples fragments are
 * cheaper than a record: 10 bytes a sample, written and read in sequence. Shading finds the triangle again by its ID. */
#include "base/grow.h"
#include "base/limits.h"
#include "kernels/types/fragments.h"
#include "frame/geometry/fragments.h"
#include "frame/pass/view.h"

int e3d_fragments_fit(const e3d_geometry_memory *state)
{
    return state->fragments.drawn.count < (size_t)E3D_FRAGMENT_ID / E3D_CLUSTER_TRIANGLES >> state->id_bits;
}

e3d_drawn_cluster *e3d_fragments_cluster(e3d_fragment_set *set)
{
    if (!e3d_array_reserve(&set->drawn, set->drawn.count + 1, sizeof(e3d_drawn_cluster)))
        return NULL;
    return (e3d_drawn_cluster *)set->drawn.data + set->drawn.count++;
}

/* The ID of the last cluster's first triangle; triangle t has first + (t << bits). */
static int32_t first_id(const e3d_geometry_memory *state)
{
    int32_t number = (int32_t)(state->fragments.drawn.count - 1) * E3D_CLUSTER_TRIANGLES;
    return E3D_FRAGMENT_ID | number << state->id_bits | (int32_t)state->number;
}

void e3d_fragments_add(const e3d_prepared *pass, e3d_geometry_memory *state, const uint8_t *indices, uint64_t triangles)
{
    e3d_small_triangles *small = &state->fragments.triangles;
    if (small->count > E3D_SMALLS - E3D_CLUSTER_TRIANGLES)
        e3d_fragments_flush(pass, state);
    pass->kernels->add_small(&state->vertices, indices, triangles, first_id(state), state->id_bits, small);
}

void e3d_fragments_flush(const e3d_prepared *pass, e3d_geometry_memory *state)
{
    e3d_fragment_set *set = &state->fragments;
    size_t most = e3d_fragment_links_most((size_t)e3d_tile_count(pass->view));
    if (!set->triangles.count)
        return;
    if (!e3d_array_reserve(&set->chains.links, set->chains.links.count + most, sizeof(e3d_fragment_link))) {
        set->triangles.count = 0;
        state->failed = 1;
        return;
    }
    e3d_fragment_bins out = {.links = set->chains.links.data, .bins = set->chains.bins.data, .count = (uint32_t)set->chains.links.count};
    pass->kernels->fragments(&set->triangles, &pass->view->viewport, pass->view->tiles_x, &out);
    set->chains.links.count = out.count;
    state->counters.records += out.triangles;
    state->counters.triangles_drawn += out.triangles;
    state->counters.bin_entries += out.fragments;
}
