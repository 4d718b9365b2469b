# Mirrors csrc/include/e3d_loaders.h.

from libc.stdint cimport int32_t, int64_t, uint8_t, uint32_t, uint64_t


cdef extern from "e3d_loaders.h" nogil:
    ctypedef enum e3d_obj_problem:
        E3D_OBJ_DONE
        E3D_OBJ_NO_MEMORY
        E3D_OBJ_TOO_LARGE
        E3D_OBJ_NO_VERTICES
        E3D_OBJ_FEW_NUMBERS
        E3D_OBJ_NOT_A_NUMBER
        E3D_OBJ_NOT_AN_INDEX
        E3D_OBJ_NO_INDEX
        E3D_OBJ_MANY_INDICES
        E3D_OBJ_OUT_OF_RANGE

    enum:
        E3D_OBJ_V
        E3D_OBJ_VT
        E3D_OBJ_VN
        E3D_OBJ_LISTS

    ctypedef enum e3d_obj_setter_kind:
        E3D_OBJ_OBJECT
        E3D_OBJ_GROUP
        E3D_OBJ_SMOOTHING
        E3D_OBJ_MATERIAL
        E3D_OBJ_LIBRARY
        E3D_OBJ_UNKNOWN

    ctypedef struct e3d_obj_place:
        size_t line, word, word_length

    ctypedef struct e3d_obj_error:
        e3d_obj_problem problem
        int list
        size_t count
        e3d_obj_place place

    ctypedef struct e3d_obj_note:
        size_t count
        e3d_obj_place first

    ctypedef struct e3d_obj_elements:
        int32_t *sizes
        int32_t **indices
        size_t count, corners
        bint are_triangles
        e3d_obj_note small
        e3d_obj_note *outside

    ctypedef struct e3d_obj_setter:
        uint32_t kind, line, faces, lines, points, name, name_length
        int32_t value

    ctypedef struct e3d_obj:
        double *positions
        double *uvs
        double *normals
        uint8_t *colors
        size_t *counts
        e3d_obj_elements faces, lines, points
        e3d_obj_setter *setters
        size_t setter_count
        uint8_t *names
        size_t name_bytes
        e3d_obj_error error
        size_t consumed

    bint e3d_obj_begin(e3d_obj *obj, const uint8_t *bytes, size_t size)
    bint e3d_obj_read(e3d_obj *obj, size_t bytes)
    e3d_obj_problem e3d_obj_end(e3d_obj *obj)
    void e3d_obj_free(e3d_obj *obj)

    size_t e3d_weld_corners(
        const int32_t *positions, const int32_t *uvs, const int32_t *normals, size_t corners,
        size_t position_count, int32_t *faces, int32_t *of_position, int32_t *of_uv,
        int32_t *of_normal,
    )
    size_t e3d_mark_used(const int32_t *indices, size_t count, uint8_t *used, size_t total)

    size_t E3D_ROW_WORDS

    ctypedef struct e3d_rows:
        const uint8_t *bytes
        size_t count, width, in_record, stride
        bint are_floats

    ctypedef struct e3d_row_numbers:
        pass

    e3d_row_numbers *e3d_row_numbers_begin(size_t width, bint are_floats, size_t expected)
    bint e3d_row_numbers_add(
        e3d_row_numbers *taken, const e3d_rows *rows, int32_t *numbers, int32_t *first)
    size_t e3d_row_numbers_take(e3d_row_numbers *taken, uint32_t **found)
    void e3d_row_numbers_free(e3d_row_numbers *taken)
    size_t e3d_number_rows(
        const e3d_rows *rows, int32_t *numbers, int32_t *first, uint32_t **found)
    int e3d_rows_repeat(const e3d_rows *rows)

    ctypedef enum e3d_sums_problem:
        E3D_SUMS_DONE
        E3D_SUMS_NO_MEMORY
        E3D_SUMS_OUT_OF_RANGE

    ctypedef struct e3d_surface:
        const void *positions
        bint are_doubles
        const int32_t *faces
        const int32_t *groups
        size_t position_count, face_count, group_count

    e3d_sums_problem e3d_smooth_sums(
        const e3d_surface *surface, size_t block_faces, double *sums)

    ctypedef struct e3d_creased_surface:
        const float *positions
        const int32_t *faces
        const int32_t *places
        const uint8_t *visible
        size_t position_count, face_count, place_count
        double cosine

    ctypedef struct e3d_creases:
        int32_t *faces
        int32_t *sources
        float *normals
        size_t added
        bint is_smooth

    int e3d_encloses(const e3d_creased_surface *surface)
    int64_t e3d_find_open_sides(const e3d_creased_surface *surface, int32_t *sides, size_t room)
    bint e3d_find_creases(const e3d_creased_surface *surface, e3d_creases *made)

    ctypedef struct e3d_mapped_surface:
        const float *positions
        const float *normals
        const float *uvs
        const int32_t *faces
        const int32_t *points
        size_t face_count

    bint e3d_find_tangents(
        const e3d_mapped_surface *surface, int32_t *groups, float *tangents, size_t *group_count)

    ctypedef struct e3d_sides:
        const int32_t *faces
        const int32_t *points
        const uint8_t *wanted
        size_t face_count, point_count

    bint e3d_find_edges(const e3d_sides *sides, uint8_t *first)

    ctypedef enum e3d_cut_problem:
        E3D_CUT_DONE
        E3D_CUT_NO_MEMORY
        E3D_CUT_OUT_OF_RANGE

    ctypedef struct e3d_polygons:
        const int32_t *sizes
        const int32_t *indices
        const void *positions
        bint are_doubles
        size_t count, corner_count, position_count

    ctypedef struct e3d_cut:
        int32_t *corners
        int32_t *polygons
        uint8_t *visible
        bint all_visible
        bint is_complete

    e3d_cut_problem e3d_cut_polygons(const e3d_polygons *polygons, int64_t *tests, e3d_cut *made)

    ctypedef enum e3d_ply_problem:
        E3D_PLY_DONE
        E3D_PLY_SHORT
        E3D_PLY_BAD_LIST

    ctypedef struct e3d_ply_body:
        const uint8_t *bytes
        size_t start, end
        bint is_big_endian

    ctypedef struct e3d_ply_list:
        size_t skip, count_size, item_size
        bint is_signed

    ctypedef struct e3d_ply_rows:
        int64_t *places
        int64_t *starts
        int64_t *sizes
        size_t end, row

    e3d_ply_problem e3d_ply_walk(
        const e3d_ply_body *body, const e3d_ply_list *lists, size_t list_count, size_t tail,
        size_t rows, e3d_ply_rows *found)
    bint e3d_ply_lengths_are(
        const e3d_ply_body *body, size_t stride, size_t rows, size_t count_size, uint64_t length)
    void e3d_ply_copy_lists(
        const e3d_ply_body *body, const int64_t *starts, const int64_t *sizes, size_t step,
        size_t rows, size_t item_size, void *items)
    bint e3d_ply_copy_even_lists(
        const e3d_ply_body *body, size_t rows, size_t count_size, uint64_t length, size_t item_size,
        void *items)
    void e3d_ply_copy_rows(
        const e3d_ply_body *body, size_t stride, size_t rows, size_t width, size_t item_size,
        void *items)

    ctypedef enum e3d_comments:
        E3D_NO_COMMENTS
        E3D_HASH_COMMENTS
        E3D_PLY_COMMENTS

    ctypedef enum e3d_numbers_problem:
        E3D_NUMBERS_DONE
        E3D_NUMBERS_NO_MEMORY
        E3D_NUMBERS_NOT_A_NUMBER

    ctypedef struct e3d_numbers:
        double *values
        int64_t *widths
        size_t count, rows, place

    e3d_numbers_problem e3d_read_numbers(
        const uint8_t *bytes, size_t size, e3d_comments comments, size_t most_rows,
        bint with_widths, e3d_numbers *found)
    void e3d_numbers_free(e3d_numbers *found)

    ctypedef struct e3d_number_body:
        const double *values
        size_t start, end

    e3d_ply_problem e3d_walk_numbers(
        const e3d_number_body *body, const size_t *skips, size_t list_count, size_t tail,
        size_t rows, e3d_ply_rows *found)
    void e3d_copy_numbers(
        const double *values, const int64_t *starts, const int64_t *sizes, size_t step,
        size_t rows, double *items)
    size_t e3d_numbers_to_indices(
        const double *values, size_t width, size_t stride, size_t rows, size_t limit,
        int32_t *indices)

    size_t E3D_FORM_WIDTH

    ctypedef enum e3d_form_kind:
        E3D_FORM_ROW
        E3D_FORM_MARK
        E3D_FORM_SKIPPED

    ctypedef struct e3d_form:
        const char *pattern
        e3d_form_kind kind
        size_t width, most
        double missing
        size_t of

    ctypedef struct e3d_mark:
        size_t form, rows, start, end

    ctypedef struct e3d_form_rows:
        double *values
        size_t rows, whole, room
        size_t lines

    ctypedef struct e3d_form_text:
        const e3d_form *forms
        size_t form_count
        bint any_case
        e3d_form_rows *rows
        e3d_mark *marks
        size_t mark_count, mark_room

    bint e3d_read_forms(e3d_form_text *text, const uint8_t *bytes, size_t size, size_t *place)
    bint e3d_add_form_row(
        e3d_form_text *text, size_t form, const double *numbers, bint is_whole)

    bint e3d_meshopt_attributes(const uint8_t *bytes, size_t size, uint8_t *to, size_t count,
                                size_t stride)
    bint e3d_meshopt_triangles(const uint8_t *bytes, size_t size, uint8_t *to, size_t count,
                               size_t stride)
    bint e3d_meshopt_indices(const uint8_t *bytes, size_t size, uint8_t *to, size_t count,
                             size_t stride)

    enum:
        E3D_MESHOPT_MAX_STRIDE

    ctypedef enum e3d_meshopt_filter:
        E3D_MESHOPT_OCTAHEDRAL
        E3D_MESHOPT_QUATERNION
        E3D_MESHOPT_EXPONENTIAL
        E3D_MESHOPT_COLOR

    void e3d_meshopt_undo_filter(uint8_t *elements, size_t count, size_t stride,
                                 e3d_meshopt_filter filter)
