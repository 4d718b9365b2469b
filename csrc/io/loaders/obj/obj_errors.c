/* The errors of an OBJ file, and the words that errors, notes and setters refer to.
 * In: a problem, or a word of the file. Out: the error in the e3d_obj; the word in `names`. */
#include "obj_reader.h"

#include <string.h>

bool obj_fail(e3d_obj *obj, e3d_obj_problem problem)
{
    obj->error = (e3d_obj_error){.problem = problem};
    return false;
}

bool obj_fail_at(e3d_obj *obj, e3d_obj_error error, const uint8_t *word, const uint8_t *end)
{
    error.place.word_length = (size_t)(end - word);
    if (obj_keep_name(obj, word, end, &error.place.word))
        obj->error = error;
    return false;
}

bool obj_keep_name(e3d_obj *obj, const uint8_t *word, const uint8_t *end, size_t *start)
{
    e3d_array *names = &obj->reader->names;
    const size_t length = (size_t)(end - word);
    if (length > UINT32_MAX - names->count)
        return obj_fail(obj, E3D_OBJ_TOO_LARGE);
    if (!e3d_array_reserve(names, names->count + length, 1))
        return obj_fail(obj, E3D_OBJ_NO_MEMORY);
    if (length)
        memcpy((uint8_t *)names->data + names->count, word, length);
    *start = names->count;
    names->count += length;
    return true;
}
