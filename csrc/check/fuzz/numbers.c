/* Fuzzes the reading of texts of numbers, and of the lists among those numbers.
 *
 * In:  a byte: comments, whether widths are asked for; a byte: rows at most; a byte: lists in a row, their skips and the
 *      tail; then the text, which a line's end is put behind.
 * Claims: a reader that takes word after word finds the same numbers, with strtod's bits; a walk by floor() the same
 *      lists; indices are those numbers that are whole and in range.
 */
#include "e3d_numbers.h"
#include "check/fuzz/input.h"
#include "io/loaders/number_text.h"

enum { MOST_LISTS = 2 };

typedef struct expected {
    double *values;
    size_t count, rows, place;
    bool is_sound;
} expected;

static bool is_gap(char byte) { return strchr(" \t\n\v\f\r", byte) && byte; }

static bool is_plain(const char *word, size_t length)
{
    return strspn(word, "0123456789+-.eE") == length;
}

/* A word's value; false if it is no number. */
static bool value_of(const char *text, size_t length, double *value)
{
    char *word = room_for(length + 1, 1), *end;
    memcpy(word, text, length);
    word[length] = '\0';
    bool is_number = is_plain(word, length);
    if (is_number) {
        *value = strtod(word, &end);
        is_number = end == word + length && length;
    } else {
        is_number = e3d_decimal_word((const uint8_t *)word, length, value);
    }
    free(word);
    return is_number;
}

static bool is_keyword(const char *word, size_t length, const char *keyword)
{
    const size_t size = strlen(keyword);
    if (length < size || memcmp(word, keyword, size) != 0)
        return false;
    const char next = word[size]; /* behind the word, a gap */
    return length == size || !(strchr("0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ", next) && next);
}

/* Reads word after word, as the header says. */
static expected expect(const char *text, size_t size, e3d_comments comments, size_t most)
{
    expected e = {room_for(size, sizeof(double)), 0, 0, 0, true};
    size_t at = 0;
    while (at < size && e.rows < most) {
        size_t end = at;
        while (text[end] != '\n' && text[end] != '\r')
            end++;
        const size_t before = e.count;
        size_t last = end;
        const char *sign = comments == E3D_HASH_COMMENTS ? memchr(text + at, '#', end - at) : NULL;
        if (sign)
            last = (size_t)(sign - text);
        bool is_first = true;
        while (at < last) {
            if (is_gap(text[at])) {
                at++;
                continue;
            }
            size_t length = 0;
            while (at + length < last && !is_gap(text[at + length]))
                length++;
            if (is_first && comments == E3D_PLY_COMMENTS &&
                (is_keyword(text + at, length, "comment") || is_keyword(text + at, length, "obj_info")))
                break;
            is_first = false;
            if (!value_of(text + at, length, &e.values[e.count])) {
                e.is_sound = false;
                e.place = at;
                return e;
            }
            e.count++;
            at += length;
        }
        e.rows += e.count > before;
        at = end + 1;
    }
    e.place = at;
    return e;
}

static void claim_numbers(const e3d_numbers *found, e3d_numbers_problem problem, const expected *e)
{
    CLAIM(problem == (e->is_sound ? E3D_NUMBERS_DONE : E3D_NUMBERS_NOT_A_NUMBER));
    CLAIM(found->count == e->count && found->rows == e->rows && found->place == e->place);
    for (size_t i = 0; i < e->count; i++)
        CLAIM(memcmp(&found->values[i], &e->values[i], sizeof(double)) == 0);
    int64_t total = 0;
    for (size_t row = 0; found->widths && row < found->rows; row++) {
        CLAIM(found->widths[row] > 0);
        total += found->widths[row];
    }
    CLAIM(!found->widths || !e->is_sound || (size_t)total == found->count);
}

/* Walks by the numbers themselves as far as they are sound. */
static size_t claim_walk(const e3d_number_body *body, const size_t *skips, size_t lists, size_t tail, size_t rows,
                         e3d_ply_problem problem, const e3d_ply_rows *found)
{
    double place = (double)body->start;
    const double end = (double)body->end;
    for (size_t row = 0; row < rows; row++) {
        CLAIM((double)found->places[row] == place);
        for (size_t k = 0; k < lists; k++) {
            place += (double)skips[k];
            if (place >= end) {
                CLAIM(problem == E3D_PLY_SHORT);
                return row;
            }
            const double length = body->values[(size_t)place];
            if (!isfinite(length) || length < 0 || floor(length) != length) {
                CLAIM(problem == E3D_PLY_BAD_LIST && found->row == row && (double)found->end == place);
                return row;
            }
            place++;
            if (place + length > end) {
                CLAIM(problem == E3D_PLY_SHORT);
                return row;
            }
            CLAIM((double)found->starts[row * lists + k] == place && (double)found->sizes[row * lists + k] == length);
            place += length;
        }
        place += (double)tail;
        if (place > end) {
            CLAIM(problem == E3D_PLY_SHORT);
            return row;
        }
    }
    CLAIM(problem == E3D_PLY_DONE && (double)found->end == place);
    return rows;
}

static void claim_copies(const e3d_number_body *body, const e3d_ply_rows *found, size_t lists, size_t rows)
{
    size_t total = 0, at = 0;
    for (size_t row = 0; row < rows; row++)
        total += (size_t)found->sizes[row * lists];
    double *const items = room_for(total, sizeof(double));
    e3d_copy_numbers(body->values, found->starts, found->sizes, lists, rows, items);
    for (size_t row = 0; row < rows; row++)
        for (int64_t i = 0; i < found->sizes[row * lists]; i++)
            CLAIM(memcmp(&items[at++], &body->values[found->starts[row * lists] + i], sizeof(double)) == 0);
    free(items);
}

static void claim_indices(const double *values, size_t count, size_t width, size_t limit)
{
    const size_t stride = width + 1, rows = count / stride;
    int32_t *const indices = room_for(rows * width, sizeof(int32_t));
    const size_t done = e3d_numbers_to_indices(values, width, stride, rows, limit, indices);
    for (size_t i = 0; i < rows * width && i <= done; i++) {
        const double value = values[i / width * stride + i % width];
        const bool is_index = value >= 0 && value < (double)limit && floor(value) == value;
        CLAIM(is_index == (i < done));
        CLAIM(i == done || (double)indices[i] == value);
    }
    CLAIM(done <= rows * width);
    free(indices);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    const uint32_t kind = take_byte(&in), most = take_byte(&in), shape = take_byte(&in);
    const e3d_comments comments = (e3d_comments)((kind & 3) % 3);
    const size_t most_rows = most == 255 ? SIZE_MAX : most;
    char *const text = room_for(in.left + 1, 1);
    memcpy(text, in.at, in.left);
    text[in.left] = "\n \r"[kind / 4 % 3];
    const size_t length = in.left + 1;
    e3d_numbers found;
    const e3d_numbers_problem problem =
        e3d_read_numbers((const uint8_t *)text, length, comments, most_rows, kind & 128, &found);
    if (text[in.left] != ' ') {
        expected e = expect(text, length, comments, most_rows);
        claim_numbers(&found, problem, &e);
        free(e.values);
    }
    const size_t lists = shape % (MOST_LISTS + 1), skips[MOST_LISTS] = {shape / 4 % 4, shape / 16 % 2}, tail = shape >> 6;
    const e3d_number_body body = {found.values, found.count > 8 ? shape % 3 : 0, found.count};
    const size_t rows = found.count < 64 ? found.count : 64;
    e3d_ply_rows walked = {.places = room_for(rows, sizeof(int64_t)), .end = body.start};
    walked.starts = room_for(rows * lists, sizeof(int64_t));
    walked.sizes = room_for(rows * lists, sizeof(int64_t));
    const e3d_ply_problem outcome = e3d_walk_numbers(&body, skips, lists, tail, rows, &walked);
    const size_t sound = claim_walk(&body, skips, lists, tail, rows, outcome, &walked);
    if (lists)
        claim_copies(&body, &walked, lists, sound);
    claim_indices(found.values, found.count, 1 + shape % 4, most);
    free(walked.places);
    free(walked.starts);
    free(walked.sizes);
    e3d_numbers_free(&found);
    free(text);
    return 0;
}
