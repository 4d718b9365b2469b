/* geometry: transforms, clips and sets up the triangles of a cluster, which become records and fragments in bins. */
#include <string.h>

#include "base/limits.h"
#include "e3d.h"
#include "kernels/coverage.h"
#include "kernels/kernels.h"
#include "kernels/types/records.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/clip.h"
#include "frame/geometry/cluster.h"
#include "frame/geometry/fragments.h"
#include "frame/geometry/setup.h"
#include "frame/pass/plan.h"

static e3d_cull cull_of(const e3d_cluster_job *j, int32_t face)
{
    const e3d_frame *frame = j->pass->frame;
    if (!j->draw->any_two_sided || j->draw->all_two_sided)
        return j->draw->all_two_sided ? E3D_CULL_NONE : frame->cull;
    return e3d_material_at(frame, j->draw, face)->two_sided ? E3D_CULL_NONE : frame->cull;
}

/* The sign of the area (screen, Y down) of the faces that one-sided materials don't show; front faces have a negative one. */
static int culled_sign(const e3d_cluster_job *j)
{
    e3d_cull cull = j->pass->frame->cull;
    int sign = (cull == E3D_CULL_BACK) - (cull == E3D_CULL_FRONT);
    return j->instance->mirrored ? -sign : sign;
}

int e3d_drop_sign(const e3d_cluster_job *j) { return j->draw->any_two_sided || j->open ? 0 : culled_sign(j); }

static e3d_primitive face_primitive(const e3d_cluster_job *j, int32_t face)
{
    return (e3d_primitive){.order = j->order + (uint32_t)face,
                           .set = E3D_SET_SCENE,
                           .face = 1,
                           .alpha = e3d_alpha_kind_of(j->pass, j->draw, face),
                           .cull = cull_of(j, face),
                           .mirrored = j->instance->mirrored};
}

/* Emits one triangle, with its key for the painter's algorithm. */
static void draw_triangle(const e3d_cluster_job *j, int triangle)
{
    const e3d_vertices *v = &j->state->vertices;
    e3d_corner corner[3];
    for (int k = 0; k < 3; k++) {
        int i = j->indices[k * E3D_CLUSTER_TRIANGLES + triangle];
        corner[k] = (e3d_corner){v->sx[i], v->sy[i], v->zn[i], v->iw[i], {0, 0, 0}};
    }
    e3d_primitive primitive = face_primitive(j, j->draw->mesh->faces[j->cluster->first + triangle]);
    int64_t before = j->state->counters.records;
    e3d_emit(j->pass, j->state, corner, &primitive);
    j->state->counters.triangles_drawn += j->state->counters.records > before;
}

static void draw_clipped(const e3d_cluster_job *j, int triangle)
{
    const e3d_vertices *v = &j->state->vertices;
    const e3d_viewport *viewport = &j->pass->view->viewport;
    float corner[3][4];
    e3d_clip_vertex polygon[E3D_CLIP_MAX];
    e3d_corner projected[E3D_CLIP_MAX];
    int good[E3D_CLIP_MAX];
    for (int k = 0; k < 3; k++) {
        int i = j->indices[k * E3D_CLUSTER_TRIANGLES + triangle];
        corner[k][0] = v->x[i];
        corner[k][1] = v->y[i];
        corner[k][2] = v->z[i];
        corner[k][3] = v->w[i];
    }
    int count = e3d_clip_triangle(corner, viewport, polygon);
    j->state->counters.triangles_clipped++;
    int64_t before = j->state->counters.records;
    for (int i = 0; i < count; i++) {
        good[i] = e3d_project(polygon[i].v, 1, viewport, &projected[i]);
        for (int k = 0; k < 3; k++)
            projected[i].c[k] = polygon[i].c[k];
    }
    e3d_primitive primitive = face_primitive(j, j->draw->mesh->faces[j->cluster->first + triangle]);
    primitive.cut = 1;
    for (int i = 1; i + 1 < count; i++)
        if (good[0] && good[i] && good[i + 1]) {
            const e3d_corner piece[3] = {projected[0], projected[i], projected[i + 1]};
            e3d_emit(j->pass, j->state, piece, &primitive);
        }
    j->state->counters.triangles_drawn += j->state->counters.records > before;
}

static void draw_records(const e3d_cluster_job *j, const e3d_record_request *request, int alpha)
{
    e3d_record_set *set = &j->state->sets[E3D_SET_SCENE];
    e3d_tile_rect spans[E3D_CLUSTER_TRIANGLES];
    if (!e3d_records_fit(set, j->state->id_bits, E3D_CLUSTER_TRIANGLES)) {
        j->state->failed = 1;
        return;
    }
    e3d_record *records = (e3d_record *)set->records.data + set->records.count;
    int made = j->pass->kernels->record(request, records, spans);
    uint32_t number = (uint32_t)set->records.count;
    set->records.count += (size_t)made;
    j->state->counters.records += made;
    j->state->counters.triangles_drawn += made;
    if (!e3d_bin_records(j->pass->view, j->state, set, e3d_chains_of(set, alpha), number, spans, made))
        j->state->failed = 1;
}

/* Draws triangles of a cluster, given as bits, a vector at a time; tiny ones may be among them. */
static void draw_triangles(const e3d_cluster_job *j, uint64_t triangles, int tiny, int alpha)
{
    uint8_t list[E3D_CLUSTER_TRIANGLES + E3D_PAD];
    int count = 0;
    if (!triangles)
        return;
    tiny = tiny && !j->pass->view->viewport.reach; /* with multisampling a cover isn't found in advance */
    for (uint64_t left = triangles; left; left &= left - 1)
        list[count++] = (uint8_t)__builtin_ctzll(left);
    memset(list + count, 0, E3D_PAD);
    const e3d_record_request request = {.vertices = &j->state->vertices,
                                        .indices = j->indices,
                                        .triangles = list,
                                        .count = count,
                                        .tiny = tiny,
                                        .cull = e3d_drop_sign(j),
                                        .mirrored = j->instance->mirrored,
                                        .order = j->order,
                                        .faces = j->draw->mesh->faces + j->cluster->first,
                                        .viewport = &j->pass->view->viewport};
    draw_records(j, &request, alpha);
}

/* Whether a triangle is culled that setup kept, since other materials of its cluster are two-sided. */
static int is_culled(const e3d_cluster_job *j, int triangle)
{
    const e3d_vertices *v = &j->state->vertices;
    int32_t x[3], y[3];
    for (int k = 0; k < 3; k++) {
        int i = j->indices[k * E3D_CLUSTER_TRIANGLES + triangle];
        x[k] = v->sx[i];
        y[k] = v->sy[i];
    }
    if ((e3d_doubled_area(x, y) < 0 ? -1 : 1) != culled_sign(j))
        return 0;
    const e3d_box box = e3d_sample_box(x, y, &j->pass->view->viewport);
    return !(j->open && e3d_meets_aperture(j->pass->view, &box)) &&
           cull_of(j, j->draw->mesh->faces[j->cluster->first + triangle]) != E3D_CULL_NONE;
}

/* Removes culled triangles from the survivors. */
static void drop_culled(const e3d_cluster_job *j)
{
    e3d_survivors *s = &j->state->survivors;
    uint64_t culled = 0;
    if (e3d_drop_sign(j) || !culled_sign(j) || j->draw->all_two_sided)
        return; /* setup has dropped them, or none are culled */
    for (uint64_t left = s->draw | s->small; left; left &= left - 1)
        if (is_culled(j, __builtin_ctzll(left)))
            culled |= left & -left;
    s->draw &= ~culled;
    s->small &= ~culled;
}

/* Draws the triangles that have alpha, small or not, and removes them from the survivors. They become records in lists of their
 * own: as fragments they would hide at once what is behind them. */
static void draw_alpha(const e3d_cluster_job *j)
{
    e3d_survivors *s = &j->state->survivors;
    uint64_t of[E3D_ALPHA_UNSEEN + 1] = {0};
    for (uint64_t left = s->draw | s->small; left; left &= left - 1)
        of[e3d_alpha_kind_of(j->pass, j->draw, j->draw->mesh->faces[j->cluster->first + __builtin_ctzll(left)])] |= left & -left;
    s->draw &= of[E3D_ALPHA_NONE];
    s->small &= of[E3D_ALPHA_NONE];
    for (int kind = 0; kind < E3D_ALPHA_KINDS; kind++)
        draw_triangles(j, of[kind], 1, kind);
}

static void draw_small(const e3d_cluster_job *j)
{
    uint64_t small = j->state->survivors.small;
    e3d_drawn_cluster *drawn = e3d_fragments_cluster(&j->state->fragments);
    if (!drawn) {
        j->state->failed = 1;
        return;
    }
    /* Written in place: a copy of the struct would load wider words than were just stored, which the processor cannot forward
     * from its store buffer. */
    *drawn = (e3d_drawn_cluster){j->draw->mesh->faces + j->cluster->first, j->order, (int32_t)j->number,
                                 (int32_t)(j->draw - j->pass->draws->states), j->instance->mirrored};
    e3d_fragments_add(j->pass, j->state, j->indices, small);
}

void e3d_transform_cluster(const e3d_cluster_job *j, int inside)
{
    const e3d_kernels *kernels = j->pass->kernels;
    const e3d_viewport *viewport = &j->pass->view->viewport;
    e3d_vertices *out = &j->state->vertices;
    if (j->draw->mesh->desc.components == 4)
        kernels->take_clip(j->cluster->positions, j->cluster->stride, j->cluster->vertices, viewport, out);
    else
        kernels->transform(j->cluster->positions, j->cluster->stride, j->cluster->vertices, j->instance->clip, viewport, inside, out);
}

/* Prefetches, for writing, the cache lines of the next records: other threads read the last frame's records there. */
static void fetch_records(const e3d_cluster_job *j, int count)
{
    e3d_record_set *set = &j->state->sets[E3D_SET_SCENE];
    if (!count || !e3d_records_fit(set, j->state->id_bits, E3D_CLUSTER_TRIANGLES))
        return; /* the function that makes them prefetches again */
    const e3d_record *next = (const e3d_record *)set->records.data + set->records.count;
    _Static_assert(sizeof *next == 64, "a record is a line of the cache");
    for (int i = 0; i < count; i++)
        __builtin_prefetch(next + i, 1);
}

void e3d_draw_cluster(const e3d_cluster_job *j)
{
    const e3d_mesh *mesh = j->draw->mesh;
    const e3d_kernels *kernels = j->pass->kernels;
    const e3d_viewport *viewport = &j->pass->view->viewport;
    e3d_geometry_memory *state = j->state;
    int fragments = e3d_plans(j->pass, E3D_PLAN_FRAGMENTS) && mesh->desc.components == 3 && e3d_fragments_fit(state);
    e3d_survivors *s = &state->survivors;
    int count = kernels->setup(&state->vertices, j->indices, j->cluster->triangles, e3d_drop_sign(j), fragments, viewport, s);
    state->counters.triangles_rejected += j->cluster->triangles - count;
    drop_culled(j);
    fetch_records(j, __builtin_popcountll(s->draw));
    int sorts = e3d_plans(j->pass, E3D_PLAN_SORTS);
    if (j->draw->any_alpha && !sorts)
        draw_alpha(j);
    if (s->small)
        draw_small(j);
    if (!sorts)
        draw_triangles(j, s->draw, !fragments, E3D_ALPHA_NONE);
    for (uint64_t left = sorts ? s->draw : 0; left; left &= left - 1)
        draw_triangle(j, __builtin_ctzll(left));
    for (uint64_t left = s->clip; left; left &= left - 1)
        draw_clipped(j, __builtin_ctzll(left));
}
