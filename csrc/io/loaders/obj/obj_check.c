/* Checks that need the whole OBJ file: indices against the lists.
 * In: elements as they were read. Out: their arrays. A vertex that does not exist is an error. A texture coordinate or a
 * normal that does not exist is noted and left out, and so are normals without a direction. The place of a bad corner is
 * looked up in the file again, since hardly any file has one. */
#include "obj_reader.h"

#include <math.h>

/* A normal whose largest component is not larger has no direction that floats could hold. */
#define SHORTEST 1e-15
#define LONGEST 1e15

/* Finds the line and the word of a corner. */
static bool find_corner(e3d_obj *obj, obj_element_kind kind, size_t corner, e3d_obj_place *place)
{
    obj_lines lines;
    obj_lines_begin(&lines, obj->reader->bytes, obj->reader->size);
    bool kept = false, found = false;
    size_t before = 0;
    for (obj_line line; !found && obj_next_line(&lines, &line) == OBJ_LINE;) {
        if (obj_elements_of(&line) != kind)
            continue;
        const uint8_t *word = obj_skip_gaps(line.at, line.end), *end;
        for (; !found && word < line.end; word = obj_skip_gaps(end, line.end)) {
            end = obj_word_end(word, line.end);
            found = before++ == corner;
            if (!found)
                continue;
            place->line = line.number;
            place->word_length = (size_t)(end - word);
            kept = obj_keep_name(obj, word, end, &place->word);
        }
    }
    e3d_array_free(&lines.scratch);
    return kept || (!found && obj_fail(obj, E3D_OBJ_NO_MEMORY));
}

/* Removes indices of a list that do not exist, and notes them. */
static bool check_list(e3d_obj *obj, obj_element_kind kind, e3d_obj_list list, int32_t *indices,
                       e3d_obj_note *note)
{
    const size_t total = obj->counts[list];
    size_t first = 0;
    for (size_t i = 0; i < obj->reader->elements[kind].corners; i++) {
        if (indices[i] == OBJ_NONE || (indices[i] >= 0 && (size_t)indices[i] < total))
            continue;
        if (note->count++ == 0)
            first = i;
        indices[i] = OBJ_NONE;
    }
    return note->count == 0 || find_corner(obj, kind, first, &note->first);
}

static bool has_direction(const double normal[3])
{
    const double x = fabs(normal[0]), y = fabs(normal[1]), z = fabs(normal[2]);
    return x <= LONGEST && y <= LONGEST && z <= LONGEST &&
           (x >= SHORTEST || y >= SHORTEST || z >= SHORTEST);
}

static void leave_out_normals(const e3d_obj *obj, int32_t *indices, size_t corners)
{
    const double *normals = obj->normals;
    size_t sound = 0;
    while (sound < obj->counts[E3D_OBJ_VN] && has_direction(normals + 3 * sound))
        sound++;
    if (sound == obj->counts[E3D_OBJ_VN])
        return;
    for (size_t i = 0; i < corners; i++)
        if (indices[i] >= 0 && !has_direction(normals + 3 * (size_t)indices[i]))
            indices[i] = OBJ_NONE;
}

static bool has_any(const int32_t *indices, size_t corners)
{
    for (size_t i = 0; i < corners; i++)
        if (indices[i] >= 0)
            return true;
    return false;
}

bool obj_check(e3d_obj *obj, obj_element_kind kind, e3d_obj_elements *elements)
{
    obj_elements *read = &obj->reader->elements[kind];
    for (int list = 0; list < E3D_OBJ_LISTS; list++) {
        int32_t *indices = read->indices[list].data;
        if (!indices)
            continue;
        const bool is_wrong =
            read->has_outside[list] || (size_t)read->largest[list] >= obj->counts[list];
        if (is_wrong &&
            !check_list(obj, kind, (e3d_obj_list)list, indices, &elements->outside[list]))
            return false;
        if (list == E3D_OBJ_V && elements->outside[list].count) {
            obj->error = (e3d_obj_error){E3D_OBJ_OUT_OF_RANGE, E3D_OBJ_V, obj->counts[E3D_OBJ_V],
                                         elements->outside[list].first};
            return false;
        }
        if (list == E3D_OBJ_VN)
            leave_out_normals(obj, indices, read->corners);
        if (!has_any(indices, read->corners))
            e3d_array_free(&read->indices[list]);
    }
    return true;
}
