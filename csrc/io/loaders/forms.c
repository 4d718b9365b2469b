/* Texts whose lines have forms: those of 3D Studio ASCII and of STL files.
 *
 * In:  bytes, the last of which is a blank or ends a line; forms, such as "vertex % % %". Out: the numbers of each
 *      form's lines, row after row, and where marks stand between them.
 * Always: a line of no form ends the reading, so that whoever asked can take it, or tell what is wrong with it.
 */
#include "e3d_forms.h"

#include "base/grow.h"
#include "number_text.h"

/* A line, as far as it follows a pattern. */
typedef struct match {
    const uint8_t *at;
    double numbers[E3D_FORM_WIDTH];
    size_t count;
    bool is_whole;
} match;

/* Returns what follows a whole number of a few digits; NULL if there is none. */
static const uint8_t *read_whole(const uint8_t *at, size_t *value)
{
    const uint8_t *const start = at;
    *value = 0;
    for (; e3d_is_digit(*at) && at - start < 18; at++)
        *value = *value * 10 + (size_t)(*at - '0');
    return at == start || e3d_is_digit(*at) || (*start == '0' && at - start > 1) ? NULL : at;
}

/* Reads what a character of the pattern stands for; false if something else is there. */
static bool read_item(const e3d_form_text *text, size_t form, char sign, match *m)
{
    size_t whole = 0;
    double number;
    const uint8_t *const next = sign == '%' ? e3d_read_number(m->at, ' ', &number) : read_whole(m->at, &whole);
    if (!next)
        return false;
    m->at = next;
    if (sign == '#')
        return whole == text->rows[form].rows;
    if (!e3d_is_gap(*next) || (sign == '@' && whole >= text->rows[0].rows) || (sign == '?' && whole > 1))
        return false;
    m->numbers[m->count++] = sign == '%' ? number : (double)whole;
    return true;
}

static bool is_same(uint8_t byte, char letter, bool any_case)
{
    return byte == (uint8_t)letter || (any_case && letter >= 'a' && letter <= 'z' && (byte | 0x20) == letter);
}

static void fill(const e3d_form *form, match *m)
{
    m->is_whole = false;
    while (m->count < form->width)
        m->numbers[m->count++] = form->missing;
}

/* Follows a form's pattern from m->at on; false if the line doesn't fit. */
static bool follow(const e3d_form_text *text, size_t number, const uint8_t *end, match *m)
{
    const e3d_form *const form = &text->forms[number];
    for (const char *sign = form->pattern; *sign; sign++) {
        switch (*sign) {
        case '%':
        case '@':
        case '?':
        case '#':
            m->at = e3d_skip_blanks(m->at, end);
            if (m->at == end || !read_item(text, number, *sign, m))
                return false;
            break;
        case '_':
            m->at = e3d_skip_blanks(m->at, end);
            break;
        case ' ':
            if (m->at < end && !e3d_is_gap(*m->at))
                return false;
            break;
        case '|':
            m->at = e3d_skip_blanks(m->at, end);
            if (m->at == end || e3d_ends_line(*m->at)) {
                fill(form, m);
                return true;
            }
            break;
        default:
            if (m->at == end || !is_same(*m->at++, *sign, text->any_case))
                return false;
        }
    }
    return true;
}

bool e3d_add_form_row(e3d_form_text *text, size_t form, const double *numbers, bool is_whole)
{
    e3d_form_rows *const rows = &text->rows[form];
    const size_t width = text->forms[form].width, count = rows->rows * width;
    e3d_array values = {rows->values, count, rows->room};
    if (!e3d_array_reserve(&values, count + width, sizeof(double)))
        return false;
    rows->values = values.data;
    rows->room = values.room;
    memcpy(rows->values + count, numbers, width * sizeof(double));
    rows->rows++;
    rows->whole += is_whole;
    return true;
}

static bool add_mark(e3d_form_text *text, e3d_mark mark)
{
    e3d_array marks = {text->marks, text->mark_count, text->mark_room};
    if (!e3d_array_reserve(&marks, text->mark_count + 1, sizeof mark))
        return false;
    text->marks = marks.data;
    text->mark_room = marks.room;
    text->marks[text->mark_count++] = mark;
    return true;
}

/* Finds the form of the line that begins at m->at, and its numbers; form_count if there is none. */
static size_t find_form(const e3d_form_text *text, const uint8_t *end, match *m)
{
    const uint8_t *const start = m->at;
    for (size_t number = 0; number < text->form_count; number++) {
        const e3d_form *const form = &text->forms[number];
        *m = (match){.at = start, .is_whole = true};
        if (!follow(text, number, end, m))
            continue;
        if (form->kind != E3D_FORM_ROW)
            return number;
        m->at = e3d_skip_blanks(m->at, end);
        if ((m->at == end || e3d_ends_line(*m->at)) && text->rows[number].rows < form->most)
            return number;
    }
    return text->form_count;
}

bool e3d_read_forms(e3d_form_text *text, const uint8_t *bytes, size_t size, size_t *place)
{
    const uint8_t *const end = bytes + size, *line = bytes + *place;
    bool fits = true;
    while (fits && line < end) {
        match m = {.at = e3d_skip_blanks(line, end)};
        if (m.at < end && !e3d_ends_line(*m.at)) {
            const size_t number = find_form(text, end, &m);
            if (number == text->form_count)
                break;
            text->rows[number].lines++;
            const e3d_form *const form = &text->forms[number];
            const uint8_t *const line_end = e3d_line_end(m.at, end);
            if (form->kind == E3D_FORM_ROW)
                fits = e3d_add_form_row(text, number, m.numbers, m.is_whole);
            else if (form->kind == E3D_FORM_MARK)
                fits = add_mark(text, (e3d_mark){number, text->rows[form->of].rows, (size_t)(m.at - bytes),
                                                 (size_t)(line_end - bytes)});
            m.at = line_end;
        }
        line = m.at < end ? m.at + 1 : end;
    }
    *place = (size_t)(line - bytes);
    return fits;
}
