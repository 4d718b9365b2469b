/* Fuzzes the reading of OBJ files, and the welding of what they hold.
 *
 * Claims: read at once or in pieces, a file gives the same; what a file gives is in range, as e3d_obj.h says;
 * so are its faces, once welded.
 */
#include "e3d_obj.h"
#include "e3d_rows.h"
#include "check/fuzz/input.h"

static void read_in_pieces(const uint8_t *bytes, size_t size, e3d_obj *obj)
{
    const size_t piece = 1 + size % 97;
    if (e3d_obj_begin(obj, bytes, size))
        while (e3d_obj_read(obj, piece))
            CLAIM(obj->consumed <= size);
    e3d_obj_end(obj);
}

static int same(const void *a, const void *b, size_t size) { return size == 0 || memcmp(a, b, size) == 0; }

static int same_elements(const e3d_obj_elements *a, const e3d_obj_elements *b)
{
    int equal = a->count == b->count && a->corners == b->corners;
    equal = equal && same(a->sizes, b->sizes, a->count * sizeof *a->sizes);
    for (int list = 0; equal && list < E3D_OBJ_LISTS; list++) {
        equal = (a->indices[list] == NULL) == (b->indices[list] == NULL);
        if (equal && a->indices[list])
            equal = same(a->indices[list], b->indices[list], a->corners * sizeof(int32_t));
    }
    return equal;
}

static void claim_same(const e3d_obj *a, const e3d_obj *b)
{
    CLAIM(a->error.problem == b->error.problem && a->error.place.line == b->error.place.line);
    CLAIM(memcmp(a->counts, b->counts, sizeof a->counts) == 0);
    CLAIM(a->name_bytes == b->name_bytes && same(a->names, b->names, a->name_bytes));
    CLAIM(a->setter_count == b->setter_count);
    CLAIM(same(a->setters, b->setters, a->setter_count * sizeof *a->setters));
    if (a->error.problem)
        return;
    CLAIM(same(a->positions, b->positions, 3 * a->counts[E3D_OBJ_V] * sizeof(double)));
    CLAIM(same(a->uvs, b->uvs, 2 * a->counts[E3D_OBJ_VT] * sizeof(double)));
    CLAIM(same(a->normals, b->normals, 3 * a->counts[E3D_OBJ_VN] * sizeof(double)));
    CLAIM((a->colors == NULL) == (b->colors == NULL));
    CLAIM(!a->colors || same(a->colors, b->colors, 4 * a->counts[E3D_OBJ_V]));
    CLAIM(same_elements(&a->faces, &b->faces) && same_elements(&a->lines, &b->lines));
    CLAIM(same_elements(&a->points, &b->points));
}

static void claim_place(const e3d_obj *obj, const e3d_obj_place *place)
{
    CLAIM(place->word_length == 0 || place->word + place->word_length <= obj->name_bytes);
}

static void claim_elements(const e3d_obj *obj, const e3d_obj_elements *elements)
{
    size_t corners = 0;
    for (size_t i = 0; i < elements->count; i++) {
        CLAIM(elements->sizes[i] >= 0 && (!elements->are_triangles || elements->sizes[i] == 3));
        corners += (size_t)elements->sizes[i];
    }
    CLAIM(corners == elements->corners);
    CLAIM(corners == 0 || elements->indices[E3D_OBJ_V] != NULL);
    for (int list = 0; list < E3D_OBJ_LISTS; list++) {
        const int32_t *indices = elements->indices[list];
        for (size_t i = 0; indices && i < corners; i++)
            CLAIM(indices[i] >= (list == E3D_OBJ_V ? 0 : -1) && indices[i] < (int64_t)obj->counts[list]);
        claim_place(obj, &elements->outside[list].first);
    }
}

static void claim_setters(const e3d_obj *obj)
{
    uint32_t faces = 0, line = 0;
    for (size_t i = 0; i < obj->setter_count; i++) {
        const e3d_obj_setter *s = &obj->setters[i];
        CLAIM(s->kind <= E3D_OBJ_UNKNOWN && (size_t)s->name + s->name_length <= obj->name_bytes);
        CLAIM(s->line > line && s->faces >= faces);
        faces = s->faces;
        line = s->line;
        if (!obj->error.problem)
            CLAIM(faces <= obj->faces.count && s->lines <= obj->lines.count && s->points <= obj->points.count);
    }
}

static void weld(const e3d_obj *obj)
{
    const e3d_obj_elements *f = &obj->faces;
    if (f->corners == 0)
        return;
    int32_t *made[4];
    for (int k = 0; k < 4; k++)
        made[k] = room_for(f->corners, sizeof(int32_t));
    const size_t vertices = e3d_weld_corners(f->indices[E3D_OBJ_V], f->indices[E3D_OBJ_VT], f->indices[E3D_OBJ_VN],
                                             f->corners, obj->counts[E3D_OBJ_V], made[0], made[1], made[2], made[3]);
    CLAIM(vertices <= f->corners);
    for (size_t i = 0; i < f->corners; i++) {
        CLAIM(made[0][i] >= 0 && (size_t)made[0][i] < vertices);
        for (int list = 0; list < E3D_OBJ_LISTS; list++)
            CLAIM(!f->indices[list] || made[1 + list][made[0][i]] == f->indices[list][i]);
    }
    for (int k = 0; k < 4; k++)
        free(made[k]);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    e3d_obj whole, pieces;
    const e3d_obj_problem problem = e3d_obj_parse(bytes, size, &whole);
    CLAIM(problem == whole.error.problem && problem != E3D_OBJ_NO_MEMORY);
    read_in_pieces(bytes, size, &pieces);
    claim_same(&whole, &pieces);
    claim_place(&whole, &whole.error.place);
    claim_setters(&whole);
    if (problem == E3D_OBJ_DONE) {
        claim_elements(&whole, &whole.faces);
        claim_elements(&whole, &whole.lines);
        claim_elements(&whole, &whole.points);
        weld(&whole);
    }
    e3d_obj_free(&whole);
    e3d_obj_free(&pieces);
    return 0;
}
