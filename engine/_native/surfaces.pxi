# Part of loaders.pyx: what is derived from faces: normals, edges, triangles of polygons.
#
# In:  positions and indices.
# Out: arrays; indices that are out of range raise.

def smooth_sums(positions: NDArray[np.floating], const int32_t[:, ::1] faces not None,
                const int32_t[:, ::1] groups not None, size_t count, size_t block) -> NDArray[np.float64]:
    """Add up the angle-weighted normals of corners (F, 3) by group: (count, 3) float64.

    ``positions`` (V, 3) are float64 or float32; ``block`` triangles are added up at a time.
    """
    cdef const double[:, ::1] doubles
    cdef const float[:, ::1] floats
    cdef e3d_surface surface
    sums = np.zeros((count, 3), np.float64)
    if faces.shape[0] == 0 or count == 0:
        return sums
    if len(positions) == 0 or faces.shape[1] != 3 or groups.shape[1] != 3 or (
            groups.shape[0] != faces.shape[0]) or positions.shape[1] != 3 or block == 0:
        raise InvalidArgumentError("the triangles have no positions or no groups")
    surface.are_doubles = positions.dtype == np.float64
    if surface.are_doubles:
        doubles = positions
        surface.positions = &doubles[0, 0]
    else:
        floats = positions
        surface.positions = &floats[0, 0]
    surface.faces, surface.groups = &faces[0, 0], &groups[0, 0]
    surface.position_count, surface.face_count = len(positions), faces.shape[0]
    surface.group_count = count
    cdef double[:, ::1] view = sums
    cdef e3d_sums_problem problem
    with nogil:
        problem = e3d_smooth_sums(&surface, block, &view[0, 0])
    if problem == E3D_SUMS_NO_MEMORY:
        raise OutOfMemoryError("no memory for the normals of a mesh")
    if problem != E3D_SUMS_DONE:
        raise InvalidArgumentError("a face holds an index that is out of range")
    return sums


cdef e3d_creased_surface placed_surface(const float[:, ::1] positions, const int32_t[:, ::1] faces,
                                        const int32_t[::1] places, size_t count) except *:
    """Triangles, of which there are some, checked."""
    cdef size_t vertices = positions.shape[0]
    cdef e3d_creased_surface surface = e3d_creased_surface(
        NULL, NULL, NULL, NULL, vertices, faces.shape[0], count, 0.0)
    if positions.shape[1] != 3 or faces.shape[1] != 3:
        raise InvalidArgumentError("the triangles have no positions")
    if np.min(faces) < 0 or np.max(faces) >= vertices:
        raise InvalidArgumentError("a face holds an index that is out of range")
    if faces.shape[0] >= (1 << 31) // 3:
        raise OutOfMemoryError("no memory for what is found of a mesh")
    if places is None:
        surface.place_count = vertices
    elif <size_t>places.shape[0] != vertices or np.min(places) < 0 or np.max(places) >= count:
        raise InvalidArgumentError("a vertex is at a place that is out of range")
    else:
        surface.places = &places[0]
    surface.positions, surface.faces = &positions[0, 0], &faces[0, 0]
    return surface


def encloses(const float[:, ::1] positions not None, const int32_t[:, ::1] faces not None,
             const int32_t[::1] places, size_t count) -> bool:
    """Tell whether triangles enclose a volume, their fronts outside; arguments of find_creases."""
    cdef int found
    if faces.shape[0] == 0 or positions.shape[0] == 0:
        return False
    cdef e3d_creased_surface surface = placed_surface(positions, faces, places, count)
    with nogil:
        found = e3d_encloses(&surface)
    if found < 0:
        raise OutOfMemoryError("no memory for what is found of a mesh")
    return bool(found)


def open_sides(const float[:, ::1] positions not None, const int32_t[:, ::1] faces not None,
               const int32_t[::1] places, size_t count, size_t most) -> NDArray[np.int32] | None:
    """Find the sides that one triangle alone has: places from and to (N, 2); None if they are many.

    Also None where a side is run along several times more often one way than the other.
    """
    sides = np.empty((most + 1, 2), np.int32)
    cdef int32_t[:, ::1] view = sides
    cdef int64_t found
    if faces.shape[0] == 0 or positions.shape[0] == 0:
        return sides[:0]
    cdef e3d_creased_surface surface = placed_surface(positions, faces, places, count)
    with nogil:
        found = e3d_find_open_sides(&surface, &view[0, 0], most)
    if found == -1:
        raise OutOfMemoryError("no memory for what is found of a mesh")
    return None if found < 0 else sides[:found]


def find_creases(const float[:, ::1] positions not None, const int32_t[:, ::1] faces not None,
                 const int32_t[::1] places, const uint8_t[:, ::1] visible, size_t count,
                 double cosine) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float32], bool]:
    """Split vertices where triangles meet at more than an angle; find the normals of all.

    ``places`` (V,), below ``count``, are the same for vertices at one place; None if each has its
    own. ``visible`` (F, 3) is 0 for diagonals of polygons. Returns faces (F, 3) int32, the old
    vertex of each added one (A,) int32, normals (V + A, 3) float32, and whether the corners at
    each place have one normal.
    """
    cdef size_t vertices = positions.shape[0]
    cdef e3d_creases made
    cdef bint done
    if faces.shape[0] == 0 or vertices == 0:
        return np.array(faces), np.empty(0, np.int32), np.zeros((vertices, 3), np.float32), True
    if visible is not None and (visible.shape[0] != faces.shape[0] or visible.shape[1] != 3):
        raise InvalidArgumentError("the triangles have sides that do not match")
    cdef e3d_creased_surface surface = placed_surface(positions, faces, places, count)
    surface.cosine = cosine
    if visible is not None:
        surface.visible = &visible[0, 0]
    with nogil:
        done = e3d_find_creases(&surface, &made)
    if not done:
        raise OutOfMemoryError("no memory for the normals of a mesh")
    cdef size_t added = made.added
    sources = owned(<void **>&made.sources, added, np.dtype(np.int32))
    normals = owned(<void **>&made.normals, 3 * (vertices + added), np.dtype(np.float32))
    split = owned(<void **>&made.faces, 3 * faces.shape[0], np.dtype(np.int32))
    return split.reshape(-1, 3), sources, normals.reshape(-1, 3), bool(made.is_smooth)


def find_tangents(const float[:, ::1] positions not None, const float[:, ::1] normals not None,
                  const float[:, ::1] uvs not None, const int32_t[:, ::1] faces not None,
                  const int32_t[::1] points not None) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    """Find which corners share a tangent: their groups (F, 3) int32, and tangents (G, 4) float32.

    ``points`` (V,) are the same for vertices that are equal in all of the three.
    """
    cdef size_t vertices = positions.shape[0], count = 0
    cdef e3d_mapped_surface surface
    cdef bint done
    groups = np.zeros((faces.shape[0], 3), np.int32)
    tangents = np.zeros((3 * faces.shape[0], 4), np.float32)
    if faces.shape[0] == 0:
        return groups, tangents
    if not (normals.shape[0] == uvs.shape[0] == points.shape[0] == positions.shape[0] > 0) or (
            positions.shape[1] != 3 or normals.shape[1] != 3 or uvs.shape[1] != 2 or faces.shape[1] != 3):
        raise InvalidArgumentError("the triangles have no positions, normals or coordinates")
    if np.min(faces) < 0 or np.max(faces) >= vertices:
        raise InvalidArgumentError("a face holds an index that is out of range")
    if faces.shape[0] >= 1 << 30:
        raise OutOfMemoryError("no memory for the tangents of a mesh")
    cdef int32_t[:, ::1] group_view = groups
    cdef float[:, ::1] tangent_view = tangents
    surface.positions, surface.normals, surface.uvs = &positions[0, 0], &normals[0, 0], &uvs[0, 0]
    surface.faces, surface.points, surface.face_count = &faces[0, 0], &points[0], faces.shape[0]
    with nogil:
        done = e3d_find_tangents(&surface, &group_view[0, 0], &tangent_view[0, 0], &count)
    if not done:
        raise OutOfMemoryError("no memory for the tangents of a mesh")
    return groups, tangents[:count].copy()


def find_edges(const int32_t[:, ::1] faces not None, const int32_t[::1] points,
               const uint8_t[::1] wanted, size_t count) -> NDArray[np.uint8]:
    """Mark the first of all sides between two points: (3 F,) uint8.

    ``points`` (V,) are the vertices' points, below ``count``, or None if each vertex is its own;
    ``wanted`` (3 F,) leaves out sides where it is 0.
    """
    cdef e3d_sides sides = e3d_sides(NULL, NULL, NULL, faces.shape[0], count)
    first = np.zeros(3 * faces.shape[0], np.uint8)
    cdef uint8_t[::1] view = first
    cdef bint done = True
    if faces.shape[0] == 0:
        return first
    if faces.shape[1] != 3 or (wanted is not None and wanted.shape[0] != view.shape[0]):
        raise InvalidArgumentError("faces must be (F, 3), wanted (3 F,)")
    vertices = count if points is None else points.shape[0]
    low, high = np.min(faces), np.max(faces)
    if low < 0 or high >= vertices:
        raise InvalidArgumentError("a face holds an index that is out of range")
    if points is not None and (np.min(points) < 0 or np.max(points) >= count):
        raise InvalidArgumentError("a vertex is a point that is out of range")
    sides.faces = &faces[0, 0]
    if points is not None:
        sides.points = &points[0]
    if wanted is not None:
        sides.wanted = &wanted[0]
    with nogil:
        done = e3d_find_edges(&sides, &view[0])
    if not done:
        raise OutOfMemoryError("no memory for the edges of a mesh")
    return first


def cut_polygons(
    const int32_t[::1] sizes not None, positions: NDArray[np.floating], const int32_t[::1] indices, size_t corners,
    size_t triangles, int64_t tests,
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.bool_] | None, bool, int]:
    """Cut polygons (P,) of so many corners each into so many triangles.

    ``indices`` (C,) are the corners' positions; None if they are the first of ``positions`` (V, 3),
    float64 or float32. Returns corner numbers (T, 3) int32, the polygon of each triangle (T,)
    int32, which edges are the polygons' (T, 3) bool or None, whether no concave polygon was cut as
    a fan, and how many tests are left.
    """
    cdef e3d_polygons given = e3d_polygons(NULL, NULL, NULL, False, sizes.shape[0], corners, 0)
    cdef const double[:, ::1] doubles
    cdef const float[:, ::1] floats
    cdef e3d_cut made
    cdef e3d_cut_problem problem
    cut = large_array((triangles, 3), np.int32)
    polygons = large_array((triangles,), np.int32)
    visible = large_array((triangles, 3), np.bool_)
    if triangles == 0:
        return cut, polygons, None, True, tests
    given.position_count = len(positions)
    if given.position_count == 0 or positions.shape[1] != 3 or (
            (np.maximum(sizes, 2) - 2).sum() != triangles) or (
            indices is not None and <size_t>indices.shape[0] != corners):
        raise InvalidArgumentError("the corners of polygons do not match")
    given.are_doubles = positions.dtype == np.float64
    if given.are_doubles:
        doubles = positions
        given.positions = &doubles[0, 0]
    else:
        floats = positions
        given.positions = &floats[0, 0]
    given.sizes = &sizes[0]
    if indices is not None:
        given.indices = &indices[0]
    cdef int32_t[:, ::1] cut_view = cut
    cdef int32_t[::1] polygon_view = polygons
    cdef uint8_t[:, ::1] visible_view = visible.view(np.uint8)
    made.corners, made.polygons = &cut_view[0, 0], &polygon_view[0]
    made.visible = &visible_view[0, 0]
    with nogil:
        problem = e3d_cut_polygons(&given, &tests, &made)
    if problem == E3D_CUT_NO_MEMORY:
        raise OutOfMemoryError("no memory to cut the polygons of a mesh")
    if problem != E3D_CUT_DONE:
        raise InvalidArgumentError("a polygon has an index that is out of range")
    edges = None if made.all_visible else frozen(visible)
    return cut, polygons, edges, bool(made.is_complete), tests
