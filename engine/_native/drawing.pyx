# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to line drawings in C: checks shapes, releases the GIL, makes one call.

In:  arrays of triangles and lines, in the world and on the drawing. Out: arrays of pieces, of edges, of segments.
Which lines there are, and how they look, is engine/apps/drawings's affair.
"""

import numpy as np

from e3d cimport E3D_OK, E3D_OUT_OF_MEMORY, e3d_status
from e3d_drawing cimport *
from libc.stdint cimport int8_t, int32_t, uint8_t
from libc.stdlib cimport free
from libc.string cimport memcpy

from ..errors import InvalidArgumentError, OutOfMemoryError

#: e3d_piece
PIECE = np.dtype([("line", np.int32), ("is_hidden", np.int32), ("from", np.float64), ("to", np.float64)])
#: e3d_side
SIDE = np.dtype([(name, np.int32) for name in ("low", "high", "first", "second", "uses")])
#: e3d_crossing
CROSSING = np.dtype([("faces", np.int32, 2), ("ends", np.float64, 6)])
#: Columns of places on the drawing.
SHEET = E3D_SHEET


cdef int require(bint condition, str message) except -1:
    if not condition:
        raise InvalidArgumentError(message)
    return 0


cdef int check(e3d_status status) except -1:
    if status == E3D_OUT_OF_MEMORY:
        raise OutOfMemoryError("no memory for a line drawing")
    require(status == E3D_OK, "a line drawing of impossible arrays")
    return 0


cdef int check_indices(const int32_t[:, ::1] faces, size_t vertices) except -1:
    require(faces.shape[1] == 3, "faces have three vertices")
    require(<size_t>faces.shape[0] < 2**31 // 3, "more triangles than a drawing takes")
    if faces.shape[0]:
        indices = np.asarray(faces)
        require(0 <= indices.min() and indices.max() < vertices, "faces name vertices that are not there")
    return 0


cdef object taken(void **data, size_t count, object dtype):
    """An array with a copy of what C allocated, which is freed."""
    cdef uint8_t[::1] view
    try:
        array = np.empty(count, dtype)
        if count:
            view = array.view(np.uint8)
            memcpy(&view[0], data[0], view.shape[0])
        return array
    finally:
        free(data[0])
        data[0] = NULL


cdef object checked_sides(object sides, const int32_t[:, ::1] faces):
    """The bytes of sides of `SIDE`, of faces that are there."""
    sides = np.ascontiguousarray(sides, SIDE)
    columns = sides.view(np.int32).reshape(-1, 5)
    if len(columns):
        require(0 <= columns[:, 2].min() and columns[:, 2:4].max() < 3 * faces.shape[0], "sides name faces that are not there")
        require(((columns[:, 3] >= 0) == (columns[:, 4] > 1)).all(), "sides have second triangles if they have two uses")
    return sides.view(np.uint8)


def hide_lines(
    const double[:, ::1] places not None, const double[:, ::1] sheet not None, const int32_t[:, ::1] faces not None,
    const double[::1] eye not None, double thickness, double reach,
    const double[:, :, ::1] line_places not None, const double[:, :, ::1] line_sheet not None, double least, int threads,
) -> NDArray[Any]:
    """Return the pieces (P,) of `PIECE` of lines (N, 2, 3) and (N, 2, 4) before and behind triangles.

    Triangles are of vertices (V, 3) and (V, 4): in the world, and on the drawing.
    """
    cdef e3d_hiders hiders
    cdef e3d_lines lines
    cdef e3d_piece *pieces = NULL
    cdef size_t count = 0
    cdef e3d_status status
    cdef int k
    require(places.shape[1] == 3 and sheet.shape[1] == SHEET and places.shape[0] == sheet.shape[0] and eye.shape[0] == 4,
            "the arrays of triangles do not fit each other")
    require(line_places.shape[0] == line_sheet.shape[0] and line_places.shape[1] == 2 and line_sheet.shape[1] == 2
            and line_places.shape[2] == 3 and line_sheet.shape[2] == SHEET, "the arrays of lines do not fit each other")
    check_indices(faces, places.shape[0])
    if line_places.shape[0] == 0:
        return np.empty(0, PIECE)
    hiders.places = &places[0, 0] if places.shape[0] else NULL
    hiders.sheet = &sheet[0, 0] if places.shape[0] else NULL
    hiders.faces = &faces[0, 0] if faces.shape[0] else NULL
    hiders.count, hiders.thickness, hiders.reach, hiders.needless = faces.shape[0], thickness, reach, NULL
    for k in range(4):
        hiders.eye[k] = eye[k]
    lines.places, lines.sheet = &line_places[0, 0, 0], &line_sheet[0, 0, 0]
    lines.count, lines.least, lines.behind = line_places.shape[0], least, NULL
    with nogil:
        status = e3d_hide_lines(&hiders, &lines, threads, &pieces, &count)
    check(status)
    return taken(<void **>&pieces, count, PIECE)


def hide_repeated(const double[:, ::1] segments not None, double tolerance, int threads) -> NDArray[Any]:
    """Return the pieces (P,) of `PIECE` of segments (N, 4); hidden are those on an earlier segment."""
    cdef e3d_piece *pieces = NULL
    cdef size_t count = 0
    cdef e3d_status status
    require(segments.shape[1] == 4, "segments have two ends")
    if segments.shape[0] == 0:
        return np.empty(0, PIECE)
    with nogil:
        status = e3d_hide_repeated(&segments[0, 0], segments.shape[0], tolerance, threads, &pieces, &count)
    check(status)
    return taken(<void **>&pieces, count, PIECE)


def find_sides(const int32_t[:, ::1] faces not None, size_t vertices) -> NDArray[Any]:
    """Return the edges (E,) of `SIDE` of triangles (F, 3), by their vertices in ascending order."""
    cdef e3d_side *sides = NULL
    cdef size_t count = 0
    cdef e3d_status status
    check_indices(faces, vertices)
    if faces.shape[0] == 0:
        return np.empty(0, SIDE)
    with nogil:
        status = e3d_find_sides(&faces[0, 0], faces.shape[0], vertices, &sides, &count)
    check(status)
    return taken(<void **>&sides, count, SIDE)


def unfold_sides(const int32_t[:, ::1] faces not None, sides) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.uint8]]:
    """Return of ``sides``, as of `find_sides`, their vertices (E, 2), their triangles (E, 2), and which two are wound oppositely.

    The second triangle of a border is -1.
    """
    cdef const uint8_t[::1] records = checked_sides(sides, faces)
    cdef size_t count = records.shape[0] // sizeof(e3d_side)
    ends, beside, turned = np.empty((count, 2), np.int32), np.empty((count, 2), np.int32), np.empty(count, np.uint8)
    cdef int32_t[:, ::1] end_view = ends
    cdef int32_t[:, ::1] beside_view = beside
    cdef uint8_t[::1] turned_view = turned
    if count:
        with nogil:
            e3d_unfold_sides(&faces[0, 0], <const e3d_side *>&records[0], count, &end_view[0, 0], &beside_view[0, 0], &turned_view[0])
    return ends, beside, turned


def find_cosines(const double[:, ::1] normals not None, const int32_t[:, ::1] beside not None,
                 const uint8_t[::1] turned not None) -> NDArray[np.float64]:
    """Return the cosines (E,) of the angles between the triangles at edges (E, 2), 1 at borders."""
    cdef size_t count = beside.shape[0]
    require(normals.shape[1] == 3 and beside.shape[1] == 2 and <size_t>turned.shape[0] == count, "the arrays of edges do not fit each other")
    cosines = np.empty(count)
    cdef double[::1] view = cosines
    if count:
        at = np.asarray(beside)
        require(0 <= at[:, 0].min() and at.max() < normals.shape[0], "edges name faces that are not there")
        with nogil:
            e3d_find_cosines(&normals[0, 0], &beside[0, 0], &turned[0], count, &view[0])
    return cosines


def find_enclosing(const double[:, ::1] places not None, const int32_t[:, ::1] faces not None, sides) -> NDArray[np.int8]:
    """Return for each triangle (F, 3) whether it belongs to a body that encloses a volume: 1, or -1 if its backs are outside.

    ``sides`` are those that `find_sides` returns.
    """
    require(places.shape[1] == 3, "places have three coordinates")
    check_indices(faces, places.shape[0])
    cdef const uint8_t[::1] records = checked_sides(sides, faces)
    enclosing = np.zeros(faces.shape[0], np.int8)
    cdef int8_t[::1] view = enclosing
    cdef size_t count = faces.shape[0], side_count = records.shape[0] // sizeof(e3d_side)
    cdef e3d_status status
    require(not side_count or (0 <= sides["low"].min() and max(sides["low"].max(), sides["high"].max()) < places.shape[0]),
            "sides name vertices that are not there")
    if count and side_count:
        with nogil:
            status = e3d_find_enclosing(
                &places[0, 0], places.shape[0], &faces[0, 0], count, <const e3d_side *>&records[0], side_count, &view[0])
        check(status)
    return enclosing


def find_normals(const double[:, ::1] places not None, const int32_t[:, ::1] faces not None, double lowest) -> NDArray[np.float64]:
    """Return the unit normals (F, 3) of triangles; 0 for those whose height is at most ``lowest``."""
    require(places.shape[1] == 3, "places have three coordinates")
    check_indices(faces, places.shape[0])
    normals = np.empty((faces.shape[0], 3))
    cdef double[:, ::1] view = normals
    cdef size_t count = faces.shape[0]
    if count:
        with nogil:
            e3d_find_normals(&places[0, 0], &faces[0, 0], count, lowest, &view[0, 0])
    return normals


def find_bodies(const int32_t[:, ::1] faces not None, size_t vertices) -> NDArray[np.int32]:
    """Return for each triangle (F, 3) the least vertex of all triangles that hang together with it."""
    check_indices(faces, vertices)
    bodies = np.empty(faces.shape[0], np.int32)
    above = np.empty(vertices, np.int32)
    cdef int32_t[::1] view = bodies
    cdef int32_t[::1] room = above
    cdef size_t count = faces.shape[0]
    if count:
        with nogil:
            e3d_number_bodies(&faces[0, 0], count, vertices, &room[0], &view[0])
    return bodies


def cross_surfaces(const double[:, ::1] places not None, const int32_t[:, ::1] faces not None, const int32_t[::1] parts,
                   double thickness, int threads) -> NDArray[Any]:
    """Return the segments (S,) of `CROSSING` in which triangles (F, 3) of different parts (F,) cross.

    Without parts: in which triangles without a common side do.
    """
    cdef const int32_t *part_numbers = NULL
    cdef e3d_crossing *crossings = NULL
    cdef size_t count = 0
    cdef e3d_status status
    require(places.shape[1] == 3 and (parts is None or parts.shape[0] == faces.shape[0]), "the arrays of triangles do not fit each other")
    check_indices(faces, places.shape[0])
    if faces.shape[0] == 0:
        return np.empty(0, CROSSING)
    if parts is not None:
        part_numbers = &parts[0]
    with nogil:
        status = e3d_cross_surfaces(&places[0, 0], &faces[0, 0], part_numbers, faces.shape[0], thickness, threads, &crossings, &count)
    check(status)
    return taken(<void **>&crossings, count, CROSSING)


cdef e3d_surface surface_of(const double[:, ::1] places, const int32_t[:, ::1] faces) except *:
    cdef e3d_surface made
    require(places.shape[1] == 3, "places have three coordinates")
    require(faces.shape[1] == 3, "faces have three vertices")
    made.places = &places[0, 0] if places.shape[0] else NULL
    made.faces = &faces[0, 0] if faces.shape[0] else NULL
    made.vertex_count, made.face_count = places.shape[0], faces.shape[0]
    return made


cdef class Edges:
    """The edges (E,) of triangles (F, 3) of vertices (V, 3), checked once for all views.

    ``normals`` (F, 3), ``parts`` and ``enclosing`` (F,) are those of the triangles. ``ends``, ``beside`` (E, 2) are an edge's vertices, and
    the triangles at its sides, -1 for none. ``turned`` (E,): these have opposite winding. ``kinds`` (E,): what an edge is even
    if it is no outline, -1 for nothing.
    """

    cdef e3d_edges c
    cdef tuple kept

    def __init__(
        self, const double[:, ::1] places not None, const int32_t[:, ::1] faces not None, const double[:, ::1] normals not None,
        const int32_t[::1] parts not None, const int8_t[::1] enclosing not None, const int32_t[:, ::1] ends not None, const int32_t[:, ::1] beside not None,
        const uint8_t[::1] turned not None, const int8_t[::1] kinds not None,
    ):
        cdef size_t count = ends.shape[0]
        self.c.of = surface_of(places, faces)
        check_indices(faces, places.shape[0])
        require(normals.shape[0] == faces.shape[0] and normals.shape[1] == 3 and parts.shape[0] == faces.shape[0]
                and enclosing.shape[0] == faces.shape[0], "the arrays of triangles do not fit each other")
        require(<size_t>beside.shape[0] == count and <size_t>turned.shape[0] == count and <size_t>kinds.shape[0] == count
                and ends.shape[1] == 2 and beside.shape[1] == 2, "the arrays of edges do not fit each other")
        if count:
            of, at = np.asarray(ends), np.asarray(beside)
            require(0 <= of.min() and of.max() < places.shape[0], "edges name vertices that are not there")
            require(0 <= at[:, 0].min() and -1 <= at.min() and at.max() < faces.shape[0], "edges name faces that are not there")
            self.c.ends, self.c.beside, self.c.turned, self.c.kinds = &ends[0, 0], &beside[0, 0], &turned[0], &kinds[0]
        if faces.shape[0]:
            self.c.normals, self.c.parts, self.c.enclosing = &normals[0, 0], &parts[0], &enclosing[0]
        self.c.count = count
        self.kept = places, faces, normals, parts, enclosing, ends, beside, turned, kinds


def draw_view(
    Edges edges not None, const double[:, :, ::1] other_ends not None, const int8_t[::1] other_kinds not None,
    const int32_t[::1] other_parts not None, size_t cut, const double[:, ::1] places, const int32_t[:, ::1] faces,
    const double[:, ::1] clip_from_world not None, size, eye, bint is_parallel, bint is_outside, const double[:, ::1] planes not None,
    double thickness, double nearness, int outline, int threads,
) -> tuple[NDArray[np.float64], NDArray[np.int8], NDArray[np.int32], NDArray[np.bool_]]:
    """Return the strokes of a view: their ends (S, 2, 2), kinds, parts, and which are hidden. They are of edges and other lines
    (N, 2, 3), before and behind triangles.

    Triangles (F, 3) of vertices (V, 3) hide, if they are given, else those of the edges.
    The first plane (K, 4) of the view leaves out what is below it of edges and of the first ``cut`` other lines, the
    others all that is. ``size``, in millimetres, is that of the frame; ``eye`` the viewer, or the direction to him and 0, who may be outside of
    all bodies.
    """
    cdef e3d_other_lines others
    cdef e3d_view view
    cdef e3d_surface hiders = edges.c.of
    cdef e3d_stroke *strokes = NULL
    cdef size_t count = 0
    cdef e3d_status status
    cdef int k
    if faces is not None:
        hiders = surface_of(places, faces)
        check_indices(faces, places.shape[0])
    require(other_ends.shape[1] == 2 and other_ends.shape[2] == 3 and other_kinds.shape[0] == other_ends.shape[0]
            and other_parts.shape[0] == other_ends.shape[0], "the arrays of lines do not fit each other")
    require(0 < planes.shape[0] <= E3D_VIEW_PLANES and planes.shape[1] == 4, "a view has one plane to four")
    require(clip_from_world.shape[0] == 4 and clip_from_world.shape[1] == 4, "a projection is a matrix of four rows")
    others.count, others.cut = other_ends.shape[0], cut
    require(0 <= outline < 128 and (not others.count or np.asarray(other_kinds).min() >= 0), "kinds are at least 0")
    if others.count:
        others.ends, others.kinds, others.parts = &other_ends[0, 0, 0], &other_kinds[0], &other_parts[0]
    memcpy(view.clip_from_world, &clip_from_world[0, 0], sizeof(view.clip_from_world))
    memcpy(view.planes, &planes[0, 0], 4 * sizeof(double) * planes.shape[0])
    view.plane_count = planes.shape[0]
    view.size[0], view.size[1] = size
    for k in range(4):
        view.eye[k] = eye[k]
    view.thickness, view.nearness, view.is_parallel, view.outline = thickness, nearness, is_parallel, outline
    view.is_outside = is_outside and faces is None
    with nogil:
        status = e3d_draw_view(&edges.c, &others, &hiders, &view, threads, &strokes, &count)
    check(status)
    return columns_of(strokes, count)


cdef tuple columns_of(e3d_stroke *strokes, size_t count):
    """Copy what C allocated, which is freed, into an array for each member."""
    cdef double[:, :, ::1] ends
    cdef int8_t[::1] kinds
    cdef int32_t[::1] parts
    cdef uint8_t[::1] hidden
    cdef size_t i
    try:
        columns = np.empty((count, 2, 2)), np.empty(count, np.int8), np.empty(count, np.int32), np.empty(count, np.uint8)
        ends, kinds, parts, hidden = columns
        for i in range(count):
            memcpy(&ends[i, 0, 0], strokes[i].ends, sizeof(strokes[i].ends))
            kinds[i], parts[i], hidden[i] = strokes[i].kind, strokes[i].part, strokes[i].is_hidden
    finally:
        free(strokes)
    return *columns[:3], columns[3].view(bool)


require(PIECE.itemsize == sizeof(e3d_piece) and SIDE.itemsize == sizeof(e3d_side) and CROSSING.itemsize == sizeof(e3d_crossing),
        "the records differ from the core's")
