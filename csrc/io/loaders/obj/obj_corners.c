/* Faces, lines and points of an OBJ file: corners `v`, `v/vt`, `v//vn` and `v/vt/vn`.
 * In: a line behind its keyword. Out: one more element with indices from 0: OBJ_NONE where a part is left out, OBJ_OUTSIDE or
 * too large where there is no such vertex. obj_check.c tests them at the end, because vertices may follow. */
#include "io/loaders/decimal.h"
#include "obj_reader.h"

/* More digits than this cannot be an index of anything. */
#define MOST_DIGITS 18

/* Reads one part of a corner; NULL if it is neither empty nor an integer. Negative indices count back from the `total` rows
 * so far. */
static inline const uint8_t *read_index(const uint8_t *at, size_t total, int32_t *index)
{
    const bool negative = *at == '-';
    const bool has_sign = negative || *at == '+';
    at += has_sign;
    const uint8_t *const digits = at;
    uint64_t number = 0;
    for (; e3d_is_digit(*at); at++)
        number = number * 10 + (uint8_t)(*at - '0');
    const ptrdiff_t count = at - digits;
    if (count == 0) {
        *index = OBJ_NONE;
        return has_sign ? NULL : at;
    }
    if (count > MOST_DIGITS || number > OBJ_MOST)
        *index = negative ? OBJ_OUTSIDE : OBJ_MOST;
    else if (negative)
        *index = number <= total && number ? (int32_t)(total - number) : OBJ_OUTSIDE;
    else
        *index = number ? (int32_t)number - 1 : OBJ_OUTSIDE;
    return at;
}

/* Reads a corner; returns its end, NULL if it is none. */
static inline const uint8_t *read_corner(const uint8_t *at, const size_t totals[E3D_OBJ_LISTS],
                                         int32_t corner[E3D_OBJ_LISTS])
{
    corner[E3D_OBJ_VT] = corner[E3D_OBJ_VN] = OBJ_NONE;
    at = read_index(at, totals[E3D_OBJ_V], &corner[E3D_OBJ_V]);
    if (at && *at == '/')
        at = read_index(at + 1, totals[E3D_OBJ_VT], &corner[E3D_OBJ_VT]);
    if (at && *at == '/')
        at = read_index(at + 1, totals[E3D_OBJ_VN], &corner[E3D_OBJ_VN]);
    return at && e3d_is_gap(*at) && corner[E3D_OBJ_V] != OBJ_NONE ? at : NULL;
}

/* Sets the error that describes a bad corner. */
static bool fail_at_corner(e3d_obj *obj, const obj_line *line, const uint8_t *word)
{
    const uint8_t *const end = obj_word_end(word, line->end);
    e3d_obj_error error = {.problem = E3D_OBJ_NOT_AN_INDEX, .place.line = line->number};
    int slashes = 0;
    for (const uint8_t *at = word; at < end; at++)
        slashes += *at == '/';
    int32_t index;
    const uint8_t *at = word;
    for (int list = E3D_OBJ_V; list < E3D_OBJ_LISTS; list++, at++) {
        error.list = (e3d_obj_list)list;
        const bool is_empty = *at == '/' || at >= end;
        at = read_index(at, 0, &index);
        if (!at || (*at != '/' && at < end))
            break;
        if (is_empty && list == E3D_OBJ_V) {
            error.problem = E3D_OBJ_NO_INDEX;
            break;
        }
        if (at >= end)
            break;
    }
    if (slashes >= E3D_OBJ_LISTS)
        error.problem = E3D_OBJ_MANY_INDICES;
    return obj_fail_at(obj, error, word, end);
}

/* Makes room for more corners. A list that begins now gets "none" for all corners so far. */
static bool reserve(e3d_obj *obj, obj_elements *elements, e3d_obj_list list, size_t wanted)
{
    e3d_array *indices = &elements->indices[list];
    const bool begins = !indices->data && list != E3D_OBJ_V;
    if (!e3d_array_reserve(indices, wanted, sizeof(int32_t)))
        return obj_fail(obj, E3D_OBJ_NO_MEMORY);
    for (size_t i = 0; begins && i < elements->corners; i++)
        ((int32_t *)indices->data)[i] = OBJ_NONE;
    return true;
}

static inline bool store(e3d_obj *obj, obj_elements *elements, e3d_obj_list list, int32_t index,
                         size_t wanted)
{
    if (!elements->indices[list].data) {
        if (index == OBJ_NONE)
            return true;
        if (!reserve(obj, elements, list, wanted))
            return false;
    }
    ((int32_t *)elements->indices[list].data)[elements->corners] = index;
    if (index > elements->largest[list])
        elements->largest[list] = index;
    elements->has_outside[list] |= index == OBJ_OUTSIDE;
    return true;
}

bool obj_read_corners(e3d_obj *obj, obj_element_kind kind, const obj_line *line)
{
    obj_elements *elements = &obj->reader->elements[kind];
    const size_t first = elements->corners;
    /* A corner takes a byte, and a blank separates it from the next one. */
    const size_t wanted = first + (size_t)(line->end - line->at) / 2 + 1;
    if (wanted > OBJ_MOST || elements->sizes.count == OBJ_MOST)
        return obj_fail(obj, E3D_OBJ_TOO_LARGE);
    for (int list = 0; list < E3D_OBJ_LISTS; list++)
        if ((list == E3D_OBJ_V || elements->indices[list].data) &&
            !reserve(obj, elements, (e3d_obj_list)list, wanted))
            return false;
    for (const uint8_t *at = line->at;;) {
        at = obj_skip_gaps(at, line->end);
        if (at == line->end)
            break;
        int32_t corner[E3D_OBJ_LISTS];
        const uint8_t *const next = read_corner(at, obj->counts, corner);
        if (!next)
            return fail_at_corner(obj, line, at);
        for (int list = 0; list < E3D_OBJ_LISTS; list++)
            if (!store(obj, elements, (e3d_obj_list)list, corner[list], wanted))
                return false;
        elements->corners++;
        at = next;
    }
    const size_t size = elements->corners - first;
    if (!e3d_array_reserve(&elements->sizes, elements->sizes.count + 1, sizeof(int32_t)))
        return obj_fail(obj, E3D_OBJ_NO_MEMORY);
    ((int32_t *)elements->sizes.data)[elements->sizes.count++] = (int32_t)size;
    elements->has_others |= size != 3;
    if (size < 3 && elements->small.count++ == 0)
        elements->small.first.line = line->number;
    return true;
}
