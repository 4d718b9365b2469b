# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to the triangles of user interfaces in C: checks shapes, releases the GIL, makes one call.

In:  a picture, vertices and commands as rows of their C structs, indices, textures.
Out: pixels of the picture. What is drawn is engine/apps/imgui_painter's affair.
"""

from e3d cimport (
    E3D_INVALID_ARGUMENT, E3D_OK, e3d_backend, e3d_status, e3d_status_text
)
from e3d_canvas cimport e3d_canvas
from e3d_ui cimport *
from libc.stdint cimport int32_t, uint8_t, uint16_t, uint32_t

from ..errors import BackendError, InvalidArgumentError

MAX_SIDE = E3D_UI_MAX_SIDE
FILTERS = {"bilinear": E3D_UI_BILINEAR, "nearest": E3D_UI_NEAREST}
VERTEX_BYTES = sizeof(e3d_ui_vertex)


cdef class NativeTexture:
    """Texels to draw with; keeps their array alive, which may change between two calls."""

    cdef const uint8_t[:, :, :] pixels
    cdef e3d_ui_texture texture

    def __cinit__(self, const uint8_t[:, :, :] pixels not None, e3d_ui_filter filter,
                  bint opaque):
        cdef Py_ssize_t height = pixels.shape[0], width = pixels.shape[1]
        cdef Py_ssize_t channels = pixels.shape[2], stride = pixels.strides[0]
        if channels != 1 and channels != 4:
            raise ValueError(f"a texel has 1 or 4 bytes, not {channels}")
        if not (0 < height <= E3D_UI_MAX_SIDE and 0 < width <= E3D_UI_MAX_SIDE):
            raise ValueError(f"a side has 1 to {E3D_UI_MAX_SIDE} texels")
        if (channels > 1 and pixels.strides[2] != 1) or (
                width > 1 and pixels.strides[1] != channels):
            raise ValueError("the texels of a row are not contiguous")
        if height == 1:
            stride = channels * width
        if not channels * width <= stride <= (<Py_ssize_t>1 << 31) // height - 1:
            raise ValueError("the rows of a texture overlap or lie too far apart")
        self.pixels = pixels
        self.texture.pixels = &pixels[0, 0, 0]
        self.texture.width, self.texture.height = <int32_t>width, <int32_t>height
        self.texture.stride = <int32_t>stride
        if channels == 1:
            self.texture.format = E3D_UI_A8
        else:
            self.texture.format = E3D_UI_RGBX8 if opaque else E3D_UI_RGBA8
        self.texture.filter = filter


cdef class NativeTextures:
    """The textures of a list, by their places."""

    cdef list kept
    cdef bytearray room

    def __cinit__(self, textures: Iterable[NativeTexture]):
        cdef NativeTexture one
        cdef Py_ssize_t k
        self.kept = list(textures)
        self.room = bytearray(len(self.kept) * sizeof(e3d_ui_texture))
        cdef e3d_ui_texture *natives = <e3d_ui_texture *><char *>self.room
        for k in range(len(self.kept)):
            one = self.kept[k]
            natives[k] = one.texture


include "picture_memory.pxi"


def draw(int backend, uint8_t[:, :, :] pixels not None, const uint8_t[:, ::1] vertices not None,
         indices not None, const int32_t[:, ::1] commands not None,
         NativeTextures textures not None):
    """Draw a list; indices are uint16 or uint32. Nothing is drawn if something of it is out of range."""
    cdef const uint16_t[::1] narrow
    cdef const uint32_t[::1] wide
    cdef e3d_canvas picture
    cdef e3d_ui_list drawn
    cdef e3d_status status
    take_picture(pixels, E3D_UI_MAX_SIDE, &picture)
    if vertices.shape[1] != sizeof(e3d_ui_vertex) or commands.shape[1] * 4 != sizeof(e3d_ui_command):
        raise ValueError("rows of vertices or commands have another size than their structs")
    if max(vertices.shape[0], commands.shape[0], len(indices), len(textures.kept)) > (1 << 31) - 1:
        raise ValueError("a list is too long")
    if vertices.shape[0] == 0 or commands.shape[0] == 0 or len(indices) == 0:
        if commands.shape[0] > 0 and any(commands[k, 5] for k in range(commands.shape[0])):
            raise InvalidArgumentError("a command of a list without vertices or indices has triangles")
        return
    drawn.index_bytes = indices.itemsize
    if drawn.index_bytes == 2:
        narrow = indices
        drawn.indices = &narrow[0]
    else:
        wide = indices
        drawn.indices = &wide[0]
    drawn.vertices = <const e3d_ui_vertex *>&vertices[0, 0]
    drawn.commands = <const e3d_ui_command *>&commands[0, 0]
    drawn.textures = <const e3d_ui_texture *><char *>textures.room
    drawn.vertex_count, drawn.index_count = vertices.shape[0], len(indices)
    drawn.command_count, drawn.texture_count = commands.shape[0], len(textures.kept)
    with nogil:
        status = e3d_ui_draw(<e3d_backend>backend, &picture, &drawn)
    if status == E3D_INVALID_ARGUMENT:
        raise InvalidArgumentError("an index, a texture or a count of the list is out of its range")
    if status != E3D_OK:
        raise BackendError(e3d_status_text(status).decode())
