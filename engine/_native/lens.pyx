# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to pictures through a lens in C: checks shapes, makes one call.

In:  where the pixels of a lens look in the pinhole pictures around it; these pictures' arrays.
Out: the lens's picture, and what its rays meet. What the pictures are is engine/rendering/lens's affair.
"""

from e3d cimport E3D_OK, e3d_backend, e3d_status, e3d_status_text, e3d_thread_count
from e3d_lens cimport *
from .scene_graph cimport NativeGraph, NativeShapes
from libc.stdint cimport int32_t, int64_t, uint8_t, uint16_t
from libc.stdlib cimport calloc, free
from libc.string cimport memcpy

import numpy as np

from ..errors import InvalidArgumentError, OutOfMemoryError

PIXEL_BYTES = sizeof(e3d_lens_pixel)
CODES_BYTES = sizeof(e3d_lens_codes)
MAX_SIDE = 16384


def fill_codes(uint8_t[::1] room not None, bint is_srgb) -> None:
    """Fill the codes by which bytes become light and back, CODES_BYTES bytes, aligned to 2."""
    if room.shape[0] != sizeof(e3d_lens_codes):
        raise InvalidArgumentError("codes have CODES_BYTES bytes")
    e3d_lens_codes_fill(<e3d_lens_codes *>&room[0], is_srgb)


cdef class NativeLens:
    """Where the pixels of a lens look.

    Parameters
    ----------
    faces : list of (start, width, height, axes)
        The first pixel of each pinhole picture in the arrays of all, its size, and right, up and back
        in camera space.
    pixels : (H, W, PIXEL_BYTES) uint8
        Rows of e3d_lens_pixel; whoever makes them makes sure that each looks into its face.
    rays : (H, W, 3) float64
        Unit, camera space.
    """

    cdef e3d_lens_face *faces
    cdef int count
    cdef const uint8_t[:, :, ::1] pixels
    cdef const double[:, :, ::1] rays
    cdef int32_t width, height
    cdef readonly int64_t total

    def __cinit__(
        self, list faces, const uint8_t[:, :, ::1] pixels not None, const double[:, :, ::1] rays not None
    ):
        cdef int k, row, column
        if len(faces) > E3D_LENS_FACES:
            raise InvalidArgumentError(f"a lens has at most {E3D_LENS_FACES} faces")
        if pixels.shape[2] != sizeof(e3d_lens_pixel) or rays.shape[2] != 3:
            raise InvalidArgumentError("pixels must be (H, W, PIXEL_BYTES), rays (H, W, 3)")
        if pixels.shape[0] != rays.shape[0] or pixels.shape[1] != rays.shape[1]:
            raise InvalidArgumentError("pixels and rays must have the same size")
        if not (0 < pixels.shape[0] <= MAX_SIDE and 0 < pixels.shape[1] <= MAX_SIDE):
            raise InvalidArgumentError(f"a side is from 1 to {MAX_SIDE} pixels")
        self.count = <int>len(faces)
        self.faces = <e3d_lens_face *>calloc(max(self.count, 1), sizeof(e3d_lens_face))
        if self.faces == NULL:
            raise OutOfMemoryError("no memory for a lens")
        for k in range(self.count):
            start, width, height, axes = faces[k]
            self.faces[k].start, self.faces[k].width, self.faces[k].height = start, width, height
            for row in range(3):
                for column in range(3):
                    self.faces[k].axes[row][column] = axes[row][column]
            self.total = max(self.total, start + width * height)
        self.pixels, self.rays = pixels, rays
        self.height, self.width = <int32_t>pixels.shape[0], <int32_t>pixels.shape[1]

    def __dealloc__(self):
        free(self.faces)

    def draw(
        self,
        const uint8_t[:, ::1] colors not None,
        uint16_t[:, ::1] scratch not None,
        const uint8_t[:, :, ::1] behind,
        const uint8_t[::1] codes not None,
        tuple outside,
        int backend,
        int threads,
        uint8_t[:, :, ::1] out not None,
    ) -> None:
        """Filter the colours of all faces, (total, 4), into a picture, (H, W, 4).

        behind : (H, W, 4) uint8 or None
            The opaque picture that shows where the faces are transparent.
        """
        cdef e3d_lens_colors all
        cdef e3d_status status
        cdef int k
        self.check_picture(out.shape[0], out.shape[1], out.shape[2], 4)
        if behind is not None:
            self.check_picture(behind.shape[0], behind.shape[1], behind.shape[2], 4)
        if min(colors.shape[0], scratch.shape[0]) < self.total or colors.shape[1] != 4 or scratch.shape[1] != 4:
            raise InvalidArgumentError("colors and scratch must be (total, 4)")
        if codes.shape[0] != sizeof(e3d_lens_codes):
            raise InvalidArgumentError("codes have CODES_BYTES bytes")
        all.faces, all.pixels = self.faces, <const e3d_lens_pixel *>&self.pixels[0, 0, 0]
        all.codes = <const e3d_lens_codes *>&codes[0]
        all.from_ = &colors[0, 0] if colors.shape[0] else NULL
        all.light, all.total = &scratch[0, 0] if scratch.shape[0] else NULL, self.total
        all.behind = &behind[0, 0, 0] if behind is not None else NULL
        for k in range(4):
            all.outside[k] = outside[k]
        all.width, all.height, all.to = self.width, self.height, &out[0, 0, 0]
        with nogil:
            status = e3d_lens_draw(&all, <e3d_backend>backend, threads if threads > 0 else e3d_thread_count())
        if status != E3D_OK:
            raise InvalidArgumentError(e3d_status_text(status).decode())

    def find(
        self,
        NativeGraph graph not None,
        NativeShapes shapes not None,
        tuple nodes,
        bint any_side,
        const double[:, ::1] pose not None,
        tuple range,
        tuple shown,
        dict found,
        bint is_along_axis,
        int threads,
    ) -> int:
        """Find what the rays meet first, as of the graph's last update; return how many were cast.

        nodes : (ids, slots, solid)
            IDs in rising order and their slots, int32; by slot whether all of every face shows, uint8.
        range : (near, far)
        shown : (object_id, instance_id, face_id, depth)
            Of all faces, (total,).
        found : dict of arrays of (H, W), barycentric (H, W, 3)
            By the names of e3d_lens_found, those that are wanted; "exact" with "barycentric".
        is_along_axis : bool
            Whether depth is measured along the lens's axis.
        """
        cdef const int32_t[::1] ids = nodes[0], slots = nodes[1]
        cdef const uint8_t[::1] solid = nodes[2]
        cdef const int32_t[::1] object_id = shown[0], instance_id = shown[1], face_id = shown[2]
        cdef const float[::1] depth = shown[3]
        cdef double near = range[0], far = range[1]
        cdef e3d_lens_scene scene
        cdef e3d_lens_shown seen
        cdef e3d_lens_found out
        cdef int32_t none = 0
        cdef uint8_t nothing = 0
        cdef float zero = 0
        if ids.shape[0] != slots.shape[0] or solid.shape[0] < graph.graph.count:
            raise InvalidArgumentError("a slot an id, and a flag a slot")
        if pose.shape[0] != 4 or pose.shape[1] != 4:
            raise InvalidArgumentError("a pose is 4x4")
        if min(object_id.shape[0], instance_id.shape[0], face_id.shape[0], depth.shape[0]) < self.total:
            raise InvalidArgumentError("what is shown must be (total,)")
        graph.need_tree()
        scene.graph, scene.tree = &graph.graph, graph.tree
        scene.shapes, scene.shape_count = shapes.shapes, shapes.count
        scene.ids = &ids[0] if ids.shape[0] else &none
        scene.slots = &slots[0] if ids.shape[0] else &none
        scene.id_count, scene.any_side = <int32_t>ids.shape[0], any_side
        scene.solid = &solid[0] if solid.shape[0] else &nothing
        seen.object_id = &object_id[0] if self.total else &none
        seen.instance_id = &instance_id[0] if self.total else &none
        seen.face_id = &face_id[0] if self.total else &none
        seen.depth = &depth[0] if self.total else &zero
        out.source = <int32_t *>self.address(found, "source", "int32")
        out.object_id = <int32_t *>self.address(found, "object_id", "int32")
        out.instance_id = <int32_t *>self.address(found, "instance_id", "int32")
        out.face_id = <int32_t *>self.address(found, "face_id", "int32")
        out.depth = <float *>self.address(found, "depth", "float32")
        out.range = <float *>self.address(found, "range", "float32")
        out.barycentric = <float *>self.address(found, "barycentric", "float32", 3)
        out.is_along_axis = is_along_axis
        out.distance = <double *>self.address(found, "distance", "float64")
        out.exact = <uint8_t *>self.address(found, "exact", "uint8")
        if (out.barycentric == NULL) != (out.exact == NULL):
            raise InvalidArgumentError("barycentric and exact go together")
        return e3d_lens_find(
            &scene, self.faces, <const e3d_lens_pixel *>&self.pixels[0, 0, 0], &self.rays[0, 0, 0],
            self.width, self.height, &pose[0, 0], near, far, &seen, &out,
            threads if threads > 0 else e3d_thread_count(),
        )

    def take(
        self,
        const int32_t[:, ::1] source not None,
        const uint8_t[:, ::1] values not None,
        bint is_turned,
        uint8_t none,
        int threads,
        uint8_t[:, :, ::1] out not None,
    ) -> None:
        """Take the values of the sources of all pixels, (total, bytes), into a picture, (H, W, bytes).

        is_turned : bool
            The first three numbers, float32, are a vector in the axes of its face.
        none : int
            Each byte where there is no source.
        """
        cdef e3d_lens_values all
        self.check_picture(source.shape[0], source.shape[1], 1, 1)
        self.check_picture(out.shape[0], out.shape[1], out.shape[2], values.shape[1])
        if values.shape[0] < self.total or values.shape[1] < (12 if is_turned else 1):
            raise InvalidArgumentError("values must be (total, bytes)")
        all.faces, all.face_count = self.faces, self.count
        all.pixels, all.source = <const e3d_lens_pixel *>&self.pixels[0, 0, 0], &source[0, 0]
        all.from_, all.bytes = &values[0, 0] if self.total else NULL, <int32_t>values.shape[1]
        all.is_turned, all.none = is_turned, none
        all.width, all.height, all.to = self.width, self.height, &out[0, 0, 0]
        with nogil:
            e3d_lens_take(&all, threads if threads > 0 else e3d_thread_count())

    cdef void *address(self, dict found, str name, str dtype, int channels=1) except? NULL:
        """Return where a picture of numbers of a type begins; NULL for one that is not wanted."""
        cdef uint8_t[::1] memory
        array = found.get(name)
        if array is None:
            return NULL
        if array.dtype != dtype:
            raise InvalidArgumentError(f"{name} is {dtype}, not {array.dtype}")
        self.check_picture(array.shape[0], array.shape[1], array[0, 0].size, channels)
        if not array.flags.c_contiguous:
            raise InvalidArgumentError(f"{name} must be contiguous")
        memory = array.reshape(-1).view(np.uint8)
        return &memory[0]

    cdef int check_picture(
        self, Py_ssize_t height, Py_ssize_t width, Py_ssize_t channels, Py_ssize_t wanted
    ) except -1:
        if height != self.height or width != self.width or channels != wanted:
            raise InvalidArgumentError("an array does not fit the picture of the lens")
        return 0
