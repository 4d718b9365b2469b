# Part of loaders.pyx: texts of numbers (PLY, OFF), and texts whose lines have forms (STL, 3D Studio).
#
# In:  bytes, the last of which is a blank or ends a line.
# Out: float64 numbers, and places in the text.

cdef int check_text_end(const uint8_t[::1] text) except -1:
    """Raise unless the last byte is a blank or ends a line."""
    if text.shape[0] and text[text.shape[0] - 1] not in b" \t\n\v\f\r":
        raise InvalidArgumentError("the text does not end with a blank or a line's end")
    return 0


def read_numbers(const uint8_t[::1] text not None, int comments, rows: int | None = None,
                 bint with_widths=False) -> tuple[NDArray[np.float64], NDArray[np.int64] | None, int, int | None]:
    """Read a text of numbers, whose last byte is a blank or ends a line; ``rows`` lines, or all.

    Returns the numbers (N,) float64, how many each line that holds any has (R,) int64 or None, the
    place behind the last line, and that of a word that is no number or None.
    """
    cdef e3d_numbers found
    cdef e3d_numbers_problem problem
    cdef size_t size = text.shape[0], most = size if rows is None else min(rows, size)
    check_text_end(text)
    if size == 0:
        return np.empty(0), np.empty(0, np.int64) if with_widths else None, 0, None
    with nogil:
        problem = e3d_read_numbers(
            &text[0], size, <e3d_comments>comments, most, with_widths, &found)
    try:
        if problem == E3D_NUMBERS_NO_MEMORY:
            raise OutOfMemoryError("no memory for the numbers of a file")
        values = owned(<void **>&found.values, found.count, np.dtype(np.float64))
        widths = None
        if with_widths:
            widths = owned(<void **>&found.widths, found.rows, np.dtype(np.int64))
        wrong = found.place if problem == E3D_NUMBERS_NOT_A_NUMBER else None
        return values, widths, found.place, wrong
    finally:
        e3d_numbers_free(&found)


def walk_number_rows(const double[::1] values not None, size_t start, skips: list[int], size_t tail,
                     size_t rows) -> tuple[int, NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], int, int]:
    """Go along ``rows`` rows of numbers as `walk_ply_rows` does; places are those of numbers.

    ``skips`` are how many numbers stand before each list of a row.
    """
    cdef size_t count = len(skips), end = values.shape[0]
    if start > end or rows > end:
        raise InvalidArgumentError("more rows than numbers")
    places = np.empty(rows, np.int64)
    starts, sizes = np.empty((rows, count), np.int64), np.empty((rows, count), np.int64)
    if rows == 0:
        return PLY_DONE, places, starts, sizes, start, 0
    cdef int64_t[::1] place_view = places
    cdef int64_t[::1] start_view = starts.reshape(-1), size_view = sizes.reshape(-1)
    given = np.array([*skips, 0], np.uintp)
    cdef size_t[::1] skip_view = given
    cdef e3d_number_body body = e3d_number_body(&values[0], start, end)
    cdef e3d_ply_rows found = e3d_ply_rows(&place_view[0], NULL, NULL, start, 0)
    cdef e3d_ply_problem problem
    if count:
        found.starts, found.sizes = &start_view[0], &size_view[0]
    with nogil:
        problem = e3d_walk_numbers(&body, &skip_view[0], count, tail, rows, &found)
    return problem, places, starts, sizes, found.end, found.row


def copy_numbers(const double[::1] values not None, const int64_t[:, ::1] starts not None,
                 const int64_t[:, ::1] sizes not None, size_t number) -> NDArray[np.float64]:
    """Copy the items of one list of each row (N, K), as `walk_number_rows` found them, to (M,)."""
    cdef size_t rows = starts.shape[0], step = starts.shape[1]
    if <size_t>sizes.shape[0] != rows or <size_t>sizes.shape[1] != step or number >= step:
        raise InvalidArgumentError("the lists of rows do not match")
    items = large_array(int(np.asarray(sizes)[:, number].sum()), np.float64)
    cdef double[::1] view = items
    if len(items):
        with nogil:
            e3d_copy_numbers(&values[0], &starts[0, number], &sizes[0, number], step, rows,
                             &view[0])
    return items


def indices_of(const double[:, :] values not None, size_t limit) -> tuple[NDArray[np.int32], int | None]:
    """Return numbers (N, K), rows at any distance, as int32; and which is none from 0 to limit - 1.

    The second is counted along the rows; None if all are indices.
    """
    cdef size_t rows = values.shape[0], width = values.shape[1], done
    indices = large_array((rows, width), np.int32)
    if rows == 0 or width == 0:
        return indices, None
    if values.strides[1] != sizeof(double) or values.strides[0] % sizeof(double):
        raise InvalidArgumentError("the numbers of a row must lie beside each other")
    cdef size_t stride = values.strides[0] // sizeof(double)
    cdef int32_t[:, ::1] view = indices
    with nogil:
        done = e3d_numbers_to_indices(&values[0, 0], width, stride, rows, limit, &view[0, 0])
    return indices, None if done == rows * width else done


cdef class FormReader:
    """Reads a text whose lines have forms, up to the next line that has none.

    ``forms`` are (pattern, kind, width, most, missing, of), as e3d_loaders.h tells of them; the
    last byte of ``text`` is a blank or ends a line.
    """

    cdef e3d_form_text read_text
    cdef e3d_form *forms
    cdef const uint8_t[::1] text
    cdef list patterns

    def __cinit__(self, const uint8_t[::1] text not None, forms: Iterable[tuple[bytes, int, int, int, float, int]], bint any_case=False):
        cdef size_t count = len(forms), k
        check_text_end(text)
        self.text = text
        self.patterns = [form[0] for form in forms]
        self.forms = <e3d_form *>calloc(count, sizeof(e3d_form))
        self.read_text.rows = <e3d_form_rows *>calloc(count, sizeof(e3d_form_rows))
        if self.forms == NULL or self.read_text.rows == NULL:
            raise OutOfMemoryError("no memory to read a text")
        self.read_text.forms, self.read_text.form_count = self.forms, count
        self.read_text.any_case = any_case
        for k, (pattern, kind, width, most, missing, of) in enumerate(forms):
            if not sum(map(pattern.count, (b"%", b"@", b"?"))) == width <= E3D_FORM_WIDTH or (
                    not 0 <= of < count):
                raise InvalidArgumentError("a form does not fit its pattern")
            self.forms[k] = e3d_form(
                PyBytes_AsString(self.patterns[k]), <e3d_form_kind><int>kind, width, most, missing, of)

    def __dealloc__(self):
        cdef size_t k
        if self.read_text.rows != NULL:
            for k in range(self.read_text.form_count):
                free(self.read_text.rows[k].values)
        free(self.read_text.rows)
        free(self.read_text.marks)
        free(self.forms)

    def read(self, size_t place) -> int:
        """Read lines from a place on; return where one begins that has no form, or the end."""
        cdef bint fits = True
        if place < <size_t>self.text.shape[0]:
            with nogil:
                fits = e3d_read_forms(
                    &self.read_text, &self.text[0], self.text.shape[0], &place)
        if not fits:
            raise OutOfMemoryError("no memory for the numbers of a file")
        return place

    def add(self, size_t form, numbers: Sequence[float], bint is_whole=True):
        """Add a row to a form's."""
        given = np.array(numbers, np.float64)
        cdef double[::1] view = given
        if form >= self.read_text.form_count or (
                <size_t>view.shape[0] != self.forms[form].width) or not len(given):
            raise InvalidArgumentError("a row does not fit its form")
        if not e3d_add_form_row(&self.read_text, form, &view[0], is_whole):
            raise OutOfMemoryError("no memory for the numbers of a file")

    def count(self, size_t form) -> tuple[int, int]:
        """Return how many rows of a form there are, and how many of them lack nothing."""
        if form >= self.read_text.form_count:
            raise InvalidArgumentError("there is no such form")
        return self.read_text.rows[form].rows, self.read_text.rows[form].whole

    def lines(self, size_t form) -> int:
        """Return how many lines of a form were read."""
        if form >= self.read_text.form_count:
            raise InvalidArgumentError("there is no such form")
        return self.read_text.rows[form].lines

    def take_rows(self, size_t form) -> NDArray[np.float64]:
        """Hand over the rows of a form, once: (N, width) float64."""
        rows, _ = self.count(form)
        cdef size_t width = self.forms[form].width
        cdef e3d_form_rows *taken = &self.read_text.rows[form]
        taken.rows = taken.whole = taken.room = 0
        values = owned(<void **>&taken.values, rows * width, np.dtype(np.float64))
        return values.reshape(rows, width)

    def take_marks(self) -> NDArray[Any]:
        """Hand over the marks since the last time: (N,) `MARK`."""
        cdef size_t count = self.read_text.mark_count * MARK.itemsize
        marks = owned(<void **>&self.read_text.marks, count, np.dtype(np.uint8)).view(MARK)
        if count:
            self.read_text.mark_count = self.read_text.mark_room = 0
        return marks
