/* The lists of an OBJ file: `v` with colours, `vt`, `vn`.
 *
 * In:  a line behind its keyword. Out: one row more, of doubles. All words must be numbers, also those
 *      that nobody asks for.
 * Colours come after the coordinates, `x y z r g b` with or without alpha, as scanners and painting
 * programs write them: display values of 0..1, or of 0..255 if any in the file is above 1.
 */
#include "obj_reader.h"

#include <math.h>

#define COLOR_AT 3
#define WITH_COLOR 6
#define WITH_ALPHA 7

static const struct {
    size_t least, columns;
} shapes[E3D_OBJ_LISTS] = {{3, 3}, {1, 2}, {3, 3}};

/* Reads all numbers; keeps the first seven. */
static bool read_numbers(e3d_obj *obj, e3d_obj_list list, const obj_line *line,
                         double numbers[WITH_ALPHA], size_t *count)
{
    size_t read = 0;
    for (const uint8_t *at = line->at;; read++) {
        at = obj_skip_gaps(at, line->end);
        if (at == line->end)
            break;
        double value;
        const uint8_t *const next = e3d_read_number(at, ' ', &value);
        if (!next)
            return obj_fail_at(obj,
                               (e3d_obj_error){.problem = E3D_OBJ_NOT_A_NUMBER,
                                               .list = list,
                                               .place.line = line->number},
                               at, obj_word_end(at, line->end));
        if (read < WITH_ALPHA)
            numbers[read] = value;
        at = next;
    }
    *count = read;
    return true;
}

/* Adds the colour of a vertex. If it has none, or one that is not finite, its red is NaN; if it has no alpha, that is NaN. */
static bool add_color(e3d_obj *obj, const double *numbers, size_t count)
{
    e3d_array *colors = &obj->reader->colors;
    const size_t vertex = obj->counts[E3D_OBJ_V];
    if (!e3d_array_reserve(colors, vertex + 1, 4 * sizeof(double)))
        return obj_fail(obj, E3D_OBJ_NO_MEMORY);
    double (*rows)[4] = colors->data;
    for (; colors->count <= vertex; colors->count++)
        rows[colors->count][0] = NAN;
    if (count < WITH_COLOR)
        return true;
    double *color = rows[vertex];
    bool is_finite = count < WITH_ALPHA || isfinite(numbers[WITH_ALPHA - 1]);
    for (int channel = 0; channel < 3; channel++) {
        color[channel] = numbers[COLOR_AT + channel];
        is_finite = is_finite && isfinite(color[channel]);
    }
    color[3] = count < WITH_ALPHA ? NAN : numbers[WITH_ALPHA - 1];
    if (!is_finite)
        color[0] = NAN;
    return true;
}

bool obj_read_row(e3d_obj *obj, e3d_obj_list list, const obj_line *line)
{
    struct e3d_obj_reader *reader = obj->reader;
    double numbers[WITH_ALPHA];
    size_t count = 0;
    if (!read_numbers(obj, list, line, numbers, &count))
        return false;
    if (count < shapes[list].least)
        return obj_fail_at(obj,
                           (e3d_obj_error){.problem = E3D_OBJ_FEW_NUMBERS,
                                           .list = list,
                                           .count = count,
                                           .place.line = line->number},
                           NULL, NULL);
    const size_t row = obj->counts[list], columns = shapes[list].columns;
    if (row == OBJ_MOST)
        return obj_fail(obj, E3D_OBJ_TOO_LARGE);
    if (!e3d_array_reserve(&reader->rows[list], (row + 1) * columns, sizeof(double)))
        return obj_fail(obj, E3D_OBJ_NO_MEMORY);
    double *values = (double *)reader->rows[list].data + row * columns;
    for (size_t column = 0; column < columns; column++)
        values[column] = column < count ? numbers[column] : 0.0;
    if (list == E3D_OBJ_V && (count >= WITH_COLOR || reader->colors.data) &&
        !add_color(obj, numbers, count))
        return false;
    obj->counts[list]++;
    return true;
}

static uint8_t color_byte(double value, double scale)
{
    const double scaled = value * scale;
    if (scaled <= 0)
        return 0;
    return scaled >= 255 ? 255 : (uint8_t)(scaled + 0.5);
}

bool obj_convert_colors(e3d_obj *obj)
{
    e3d_array *colors = &obj->reader->colors;
    if (!colors->data)
        return true;
    const double (*rows)[4] = colors->data;
    /* Alphas have a range of their own. */
    double largest = 0, largest_alpha = 0;
    for (size_t i = 0; i < colors->count; i++) {
        const double *row = rows[i];
        for (int channel = 0; channel < 3 && !isnan(row[0]); channel++)
            largest = row[channel] > largest ? row[channel] : largest;
        if (!isnan(row[0]) && row[3] > largest_alpha)
            largest_alpha = row[3];
    }
    const double scale = largest <= 1 ? 255 : 1, alpha_scale = largest_alpha <= 1 ? 255 : 1;
    obj->colors = malloc(4 * colors->count);
    if (!obj->colors)
        return obj_fail(obj, E3D_OBJ_NO_MEMORY);
    for (size_t i = 0; i < 4 * colors->count; i++) {
        const double *row = rows[i / 4];
        const double value = row[i % 4];
        obj->colors[i] = isnan(row[0]) || isnan(value) ? 255 : color_byte(value, i % 4 == 3 ? alpha_scale : scale);
    }
    e3d_array_free(colors);
    return true;
}
