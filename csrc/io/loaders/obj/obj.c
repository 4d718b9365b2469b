/* Wavefront OBJ: the statements of a file, one after the other.
 *
 * In:  bytes. Out: an e3d_obj. Statements of numbers and indices become arrays; those that set something
 *      for the elements behind them (names, smoothing groups) are listed with what stands before them.
 *      Format: "Object Files (.obj)", Appendix B1 of the Advanced Visualizer manual.
 */
#include "base/fpenv.h"
#include "io/loaders/decimal.h"
#include "obj_reader.h"

#include <stdlib.h>
#include <string.h>

/* These statements change nothing that is drawn here. */
static const char *const ignored[] = {"lod", "shadow_obj", "trace_obj", "bevel",
                                      "c_interp", "d_interp", "vp", "mg"};

static bool is_word(const uint8_t *at, const uint8_t *end, const char *word)
{
    const size_t length = strlen(word);
    return (size_t)(end - at) == length && memcmp(at, word, length) == 0;
}

/* The value of `s`: 0 for off; -1 if it is no number. */
static int32_t smoothing_group(const uint8_t *at, const uint8_t *end)
{
    end = obj_word_end(at, end);
    if (at == end || is_word(at, end, "off"))
        return 0;
    if (is_word(at, end, "on"))
        return 1;
    const bool negative = *at == '-';
    int64_t number = 0;
    /* Groups are small numbers; anything behind ten characters is ignored. */
    const uint8_t *const last = end - at > 10 ? at + 10 : end;
    at += negative || *at == '+';
    if (at == last)
        return -1;
    for (; at < last; at++) {
        if (!e3d_is_digit(*at))
            return -1;
        number = number * 10 + (*at - '0');
    }
    if (negative)
        return 0;
    return number > INT32_MAX ? INT32_MAX : (int32_t)number;
}

static bool add_setter(e3d_obj *obj, e3d_obj_setter_kind kind, const obj_line *line,
                       const uint8_t *name, const uint8_t *end)
{
    struct e3d_obj_reader *reader = obj->reader;
    if (line->number > UINT32_MAX)
        return obj_fail(obj, E3D_OBJ_TOO_LARGE);
    e3d_array *setters = &reader->setters;
    if (!e3d_array_reserve(setters, setters->count + 1, sizeof(e3d_obj_setter)))
        return obj_fail(obj, E3D_OBJ_NO_MEMORY);
    e3d_obj_setter setter = {.kind = kind, .line = (uint32_t)line->number};
    setter.faces = (uint32_t)reader->elements[OBJ_FACES].sizes.count;
    setter.lines = (uint32_t)reader->elements[OBJ_LINES].sizes.count;
    setter.points = (uint32_t)reader->elements[OBJ_POINTS].sizes.count;
    if (kind == E3D_OBJ_SMOOTHING)
        setter.value = smoothing_group(name, end);
    size_t start = 0;
    if (kind != E3D_OBJ_SMOOTHING || setter.value < 0) {
        if (!obj_keep_name(obj, name, end, &start))
            return false;
        setter.name_length = (uint32_t)(end - name);
    }
    setter.name = (uint32_t)start;
    ((e3d_obj_setter *)setters->data)[setters->count++] = setter;
    return true;
}

/* Reads statements other than numbers and indices. */
static bool read_other(e3d_obj *obj, const obj_line *line, const uint8_t *keyword_end)
{
    const uint8_t *keyword = line->at, *end = line->end;
    const uint8_t *name = obj_skip_gaps(keyword_end, end);
    while (end > name && e3d_is_gap(end[-1]))
        end--;
    static const char *const keywords[] = {"o", "g", "s", "usemtl", "mtllib"};
    for (int kind = 0; kind < E3D_OBJ_UNKNOWN; kind++)
        if (is_word(keyword, keyword_end, keywords[kind]))
            return add_setter(obj, (e3d_obj_setter_kind)kind, line, name, end);
    for (size_t i = 0; i < sizeof ignored / sizeof ignored[0]; i++)
        if (is_word(keyword, keyword_end, ignored[i]))
            return true;
    return add_setter(obj, E3D_OBJ_UNKNOWN, line, keyword, keyword_end);
}

static bool read_line(e3d_obj *obj, obj_line *line)
{
    const obj_element_kind kind = obj_elements_of(line);
    if (line->at == line->end && kind == OBJ_ELEMENT_KINDS)
        return true;
    if (kind != OBJ_ELEMENT_KINDS)
        return obj_read_corners(obj, kind, line);
    const uint8_t *const keyword_end = obj_word_end(line->at, line->end);
    for (int list = 0; list < E3D_OBJ_LISTS; list++)
        if (obj_begins(line, 'v', "\0tn"[list])) {
            line->at = keyword_end;
            return obj_read_row(obj, (e3d_obj_list)list, line);
        }
    return read_other(obj, line, keyword_end);
}

bool e3d_obj_begin(e3d_obj *obj, const uint8_t *bytes, size_t size)
{
    *obj = (e3d_obj){0};
    obj->reader = calloc(1, sizeof *obj->reader);
    if (!obj->reader)
        return obj_fail(obj, E3D_OBJ_NO_MEMORY);
    obj->reader->bytes = bytes;
    obj->reader->size = size;
    obj_lines_begin(&obj->reader->lines, bytes, size);
    return true;
}

bool e3d_obj_read(e3d_obj *obj, size_t bytes)
{
    if (obj->error.problem)
        return false;
    struct e3d_obj_reader *reader = obj->reader;
    obj_lines *lines = &reader->lines;
    const size_t stop = bytes < reader->size - obj->consumed ? obj->consumed + bytes : reader->size;
    const e3d_fpenv saved = e3d_fpenv_enter();
    obj_step step = OBJ_LINE;
    while (!obj->error.problem && obj->consumed < stop) {
        obj_line line;
        step = obj_next_line(lines, &line);
        if (step == OBJ_LINES_NO_MEMORY)
            obj_fail(obj, E3D_OBJ_NO_MEMORY);
        if (step != OBJ_LINE || !read_line(obj, &line))
            break;
        obj->consumed = (size_t)(lines->next - reader->bytes);
    }
    e3d_fpenv_leave(saved);
    return step == OBJ_LINE && !obj->error.problem && obj->consumed < reader->size;
}

/* Hands over an array, or nothing if it is empty. */
static void *taken(e3d_array *array, size_t count)
{
    void *data = count ? array->data : NULL;
    if (!count)
        free(array->data);
    *array = (e3d_array){0};
    return data;
}

static void take_elements(obj_elements *read, e3d_obj_elements *elements)
{
    elements->count = read->sizes.count;
    elements->corners = read->corners;
    elements->are_triangles = !read->has_others;
    elements->small = read->small;
    elements->sizes = taken(&read->sizes, read->sizes.count);
    for (int list = 0; list < E3D_OBJ_LISTS; list++)
        elements->indices[list] = taken(&read->indices[list], read->corners);
}

static void free_reader(struct e3d_obj_reader *reader)
{
    if (!reader)
        return;
    e3d_array_free(&reader->lines.scratch);
    e3d_array_free(&reader->colors);
    e3d_array_free(&reader->setters);
    e3d_array_free(&reader->names);
    for (int list = 0; list < E3D_OBJ_LISTS; list++)
        e3d_array_free(&reader->rows[list]);
    for (int kind = 0; kind < OBJ_ELEMENT_KINDS; kind++) {
        e3d_array_free(&reader->elements[kind].sizes);
        for (int list = 0; list < E3D_OBJ_LISTS; list++)
            e3d_array_free(&reader->elements[kind].indices[list]);
    }
    free(reader);
}

/* Takes over what was read, and checks it. */
static void finish(e3d_obj *obj)
{
    struct e3d_obj_reader *reader = obj->reader;
    obj->positions = taken(&reader->rows[E3D_OBJ_V], obj->counts[E3D_OBJ_V]);
    obj->uvs = taken(&reader->rows[E3D_OBJ_VT], obj->counts[E3D_OBJ_VT]);
    obj->normals = taken(&reader->rows[E3D_OBJ_VN], obj->counts[E3D_OBJ_VN]);
    if (!obj->positions) {
        obj_fail(obj, E3D_OBJ_NO_VERTICES);
        return;
    }
    e3d_obj_elements *all[OBJ_ELEMENT_KINDS] = {&obj->faces, &obj->lines, &obj->points};
    for (int kind = 0; kind < OBJ_ELEMENT_KINDS; kind++) {
        if (!obj_check(obj, (obj_element_kind)kind, all[kind]))
            return;
        take_elements(&reader->elements[kind], all[kind]);
    }
    obj_convert_colors(obj);
}

e3d_obj_problem e3d_obj_end(e3d_obj *obj)
{
    struct e3d_obj_reader *reader = obj->reader;
    if (!reader)
        return obj->error.problem;
    if (!obj->error.problem)
        finish(obj);
    obj->setter_count = reader->setters.count;
    obj->setters = taken(&reader->setters, obj->setter_count);
    obj->name_bytes = reader->names.count;
    obj->names = taken(&reader->names, obj->name_bytes);
    free_reader(reader);
    obj->reader = NULL;
    return obj->error.problem;
}

e3d_obj_problem e3d_obj_parse(const uint8_t *bytes, size_t size, e3d_obj *obj)
{
    if (e3d_obj_begin(obj, bytes, size))
        while (e3d_obj_read(obj, SIZE_MAX))
            ;
    return e3d_obj_end(obj);
}

static void free_elements(e3d_obj_elements *elements)
{
    free(elements->sizes);
    for (int list = 0; list < E3D_OBJ_LISTS; list++)
        free(elements->indices[list]);
}

void e3d_obj_free(e3d_obj *obj)
{
    free_reader(obj->reader);
    free(obj->positions);
    free(obj->uvs);
    free(obj->normals);
    free(obj->colors);
    free(obj->setters);
    free(obj->names);
    free_elements(&obj->faces);
    free_elements(&obj->lines);
    free_elements(&obj->points);
    *obj = (e3d_obj){0};
}
