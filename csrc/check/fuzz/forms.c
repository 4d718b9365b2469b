/* Fuzzes texts whose lines have forms.
 *
 * In:  a byte: STL's forms, or 3D Studio's; a byte: vertices and faces at most; then the text, which a line feed is put
 *      behind.
 * Claims: lines of no form begin where reading stops, and a text cut there gives the same; of STL, a reader that goes by
 *      words keeps the same numbers and marks; of 3D Studio, indices and flags are in range, marks in order.
 */
#include "check/fuzz/input.h"
#include "e3d_forms.h"

#include <strings.h>

enum { MOST_FORMS = 6 };

static const e3d_form stl[] = {
    {"vertex % % %", E3D_FORM_ROW, 3, SIZE_MAX, 0, 0},
    {"endloop ", E3D_FORM_MARK, 0, 0, 0, 0},
    {"facet ", E3D_FORM_SKIPPED, 0, 0, 0, 0},
    {"outer ", E3D_FORM_SKIPPED, 0, 0, 0, 0},
    {"endfacet ", E3D_FORM_SKIPPED, 0, 0, 0, 0},
    {"endsolid ", E3D_FORM_SKIPPED, 0, 0, 0, 0},
};

static const e3d_form asc[] = {
    {"Vertex #_:_X:%_Y:%_Z:%|_U:%_V:%", E3D_FORM_ROW, 5, 0, 0.0, 0},
    {"Face #_:_A:@_B:@_C:@|_AB:?_BC:?_CA:?", E3D_FORM_ROW, 6, 0, 1.0, 0},
    {"Material:", E3D_FORM_MARK, 0, 0, 0, 1},
    {"Smoothing:", E3D_FORM_MARK, 0, 0, 0, 1},
};

typedef struct reading {
    e3d_form_text text;
    e3d_form forms[MOST_FORMS];
    e3d_form_rows rows[MOST_FORMS];
    size_t stops[64], stop_count;
} reading;

static void begin(reading *r, bool is_stl, uint32_t most)
{
    memset(r, 0, sizeof *r);
    const size_t count = is_stl ? sizeof stl / sizeof *stl : sizeof asc / sizeof *asc;
    memcpy(r->forms, is_stl ? stl : asc, count * sizeof *stl);
    if (!is_stl) {
        r->forms[0].most = most % 16;
        r->forms[1].most = most / 16;
    }
    r->text = (e3d_form_text){.forms = r->forms, .form_count = count, .any_case = is_stl, .rows = r->rows};
}

static void finish(reading *r)
{
    for (size_t form = 0; form < r->text.form_count; form++)
        free(r->rows[form].values);
    free(r->text.marks);
}

static size_t line_end(const uint8_t *bytes, size_t at)
{
    while (bytes[at] != '\n' && bytes[at] != '\r')
        at++;
    return at;
}

/* Reads all, passing over lines of no form. */
static void read_all(reading *r, const uint8_t *bytes, size_t size)
{
    size_t place = 0;
    while (place < size) {
        CLAIM(e3d_read_forms(&r->text, bytes, size, &place));
        CLAIM(place <= size);
        if (place == size)
            break;
        CLAIM(place == 0 || bytes[place - 1] == '\n' || bytes[place - 1] == '\r');
        if (r->stop_count < 64)
            r->stops[r->stop_count++] = place;
        size_t again = place;
        CLAIM(e3d_read_forms(&r->text, bytes, size, &again) && again == place);
        place = line_end(bytes, place) + 1;
    }
}

/* Reads only what stands before the first stop, in memory that ends there. */
static void claim_cut(const reading *whole, bool is_stl, uint32_t most, const uint8_t *bytes)
{
    if (whole->stop_count == 0)
        return;
    const size_t size = whole->stops[0];
    uint8_t *const piece = room_for(size, 1);
    memcpy(piece, bytes, size);
    reading r;
    begin(&r, is_stl, most);
    read_all(&r, piece, size);
    CLAIM(r.stop_count == 0);
    for (size_t form = 0; form < r.text.form_count; form++) {
        CLAIM(r.rows[form].rows <= whole->rows[form].rows);
        if (r.rows[form].rows)
            CLAIM(memcmp(r.rows[form].values, whole->rows[form].values,
                         r.rows[form].rows * r.forms[form].width * sizeof(double)) == 0);
    }
    finish(&r);
    free(piece);
}

/* Goes by words, as Python's split() gives them. */
static void claim_stl(const reading *r, const uint8_t *bytes, size_t size)
{
    static const char *const skipped[] = {"facet", "outer", "endfacet", "endsolid"};
    size_t vertices = 0, marks = 0;
    for (size_t at = 0; at < size; at = line_end(bytes, at) + 1) {
        const size_t length = line_end(bytes, at) - at;
        char *const line = room_for(length + 1, 1), *rest = line;
        memcpy(line, bytes + at, length);
        line[length] = '\0';
        for (char *zero; (zero = memchr(line, '\0', length));)
            *zero = '?'; /* as little of a word as that is */
        char *words[5];
        size_t count = 0;
        for (char *word; count < 5 && (word = strtok_r(rest, " \t\v\f", &rest));)
            words[count++] = word;
        bool is_known = false;
        for (size_t k = 0; count && k < 4; k++)
            is_known |= strcasecmp(words[0], skipped[k]) == 0;
        if (count && strcasecmp(words[0], "endloop") == 0) {
            CLAIM(marks < r->text.mark_count && r->text.marks[marks++].rows == vertices);
        } else if (count == 4 && strcasecmp(words[0], "vertex") == 0) {
            bool is_plain = true;
            for (size_t k = 1; k < 4; k++)
                is_plain &= strspn(words[k], "0123456789-.") == strlen(words[k]);
            double value[3];
            char *end;
            for (size_t k = 1; is_plain && k < 4; k++) {
                value[k - 1] = strtod(words[k], &end);
                is_plain = *end == '\0' && end > words[k];
            }
            if (is_plain)
                CLAIM(vertices < r->rows[0].rows && memcmp(r->rows[0].values + 3 * vertices, value, sizeof value) == 0);
            bool is_stop = false;
            for (size_t k = 0; k < r->stop_count; k++)
                is_stop |= r->stops[k] == at;
            vertices += !is_stop;
        } else if (count && !is_known && r->stop_count < 64) {
            bool is_stop = false;
            for (size_t k = 0; k < r->stop_count; k++)
                is_stop |= r->stops[k] == at;
            CLAIM(is_stop);
        }
        free(line);
        if (r->stop_count == 64)
            return;
    }
}

static void claim_asc(const reading *r, size_t size)
{
    const size_t vertices = r->rows[0].rows, faces = r->rows[1].rows;
    CLAIM(vertices <= r->forms[0].most && faces <= r->forms[1].most);
    CLAIM(r->rows[0].whole <= vertices && r->rows[1].whole <= faces);
    for (size_t face = 0; face < faces; face++)
        for (size_t k = 0; k < 6; k++) {
            const double value = r->rows[1].values[6 * face + k];
            CLAIM(value >= 0 && floor(value) == value && value < (k < 3 ? (double)vertices : 2));
        }
    for (size_t k = 0; k < r->text.mark_count; k++) {
        const e3d_mark *const mark = &r->text.marks[k];
        CLAIM((mark->form == 2 || mark->form == 3) && mark->rows <= faces);
        CLAIM(mark->start <= mark->end && mark->end < size);
        CLAIM(k == 0 || (mark[-1].end < mark->start && mark[-1].rows <= mark->rows));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    const bool is_stl = take_byte(&in) & 1;
    const uint32_t most = take_byte(&in);
    uint8_t *const text = room_for(in.left + 1, 1);
    memcpy(text, in.at, in.left);
    text[in.left] = '\n';
    reading r;
    begin(&r, is_stl, most);
    read_all(&r, text, in.left + 1);
    if (is_stl)
        claim_stl(&r, text, in.left + 1);
    else
        claim_asc(&r, in.left + 1);
    claim_cut(&r, is_stl, most, text);
    finish(&r);
    free(text);
    return 0;
}
