"""Draws Dear ImGui's output with the engine's own rasteriser.

In:  ImGui's draw data of a frame, and textures by number: ImGui's own, which hold its glyphs and
     grow as they are needed, and pictures that panels show.
Out: the picture, changed in place. Dear ImGui comes with ``pip install engine3d[editor]``.
"""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from ...choices import Backend
from .triangles import COMMAND, VERTEX, Texture, draw_triangles

if TYPE_CHECKING:
    from imgui_bundle import imgui


class ImguiPainter:
    """Draws frames of the current ImGui context, and keeps their textures.

    Parameters
    ----------
    backend : str
        As `Renderer` takes it.
    """

    def __init__(self, backend: Backend = "auto") -> None:
        from imgui_bundle import imgui

        if (imgui.VERTEX_SIZE, imgui.INDEX_SIZE) not in (
            (VERTEX.itemsize, 2),
            (VERTEX.itemsize, 4),
        ):
            raise ImportError("this build of Dear ImGui has vertices of another size")
        self._imgui = imgui
        self._index = np.dtype(f"u{imgui.INDEX_SIZE}")
        self._backend = backend
        self._textures: dict[int, Texture] = {}
        self._next = 1
        io = imgui.get_io()
        io.backend_flags |= imgui.BackendFlags_.renderer_has_textures
        io.backend_flags |= imgui.BackendFlags_.renderer_has_vtx_offset
        io.fonts.tex_desired_format = imgui.ImTextureFormat.alpha8

    def add(
        self,
        pixels: NDArray[np.uint8],
        filter: Literal["bilinear", "nearest"] = "bilinear",
        *,
        opaque: bool = False,
    ) -> int:
        """Register a picture; return its number. See `Texture`."""
        number = self._next
        self._next += 1
        self.replace(number, pixels, filter, opaque=opaque)
        return number

    def replace(
        self,
        number: int,
        pixels: NDArray[np.uint8],
        filter: Literal["bilinear", "nearest"] = "bilinear",
        *,
        opaque: bool = False,
    ) -> None:
        """Replace the picture under a number."""
        self._textures[number] = Texture(pixels, filter, opaque=opaque)

    def remove(self, number: int) -> None:
        """Remove a picture; the frame in layout may still show it."""
        self._textures.pop(number, None)

    def draw(self, draw_data: imgui.ImDrawData, pixels: NDArray[np.uint8]) -> None:
        """Draw a frame over a picture; (0, 0) of its display is the picture's top left corner."""
        for texture in _items(draw_data.textures):
            self._follow(texture)
        lists = [drawn for drawn in _items(draw_data.cmd_lists) if drawn.idx_buffer.size()]
        if not lists:
            return
        vertices = _joined([drawn.vtx_buffer for drawn in lists], VERTEX)
        indices = _joined([drawn.idx_buffer for drawn in lists], self._index)
        commands, numbers = self._commands(lists)
        draw_triangles(
            pixels,
            vertices,
            indices,
            commands,
            [self._textures[number] for number in numbers],
            backend=self._backend,
        )

    def _commands(self, lists: list[Any]) -> tuple[NDArray[Any], list[int]]:
        """Return the commands of all lists joined, and the numbers of their textures."""
        rows: list[Any] = []
        places: dict[Any, int] = {}
        first_vertex = first_index = 0
        for drawn in lists:
            for command in _items(drawn.cmd_buffer):
                number = command.get_tex_id()
                if command.elem_count and number in self._textures:
                    rect = command.clip_rect
                    rows.append(
                        (
                            *(int(side) for side in (rect.x, rect.y, rect.z, rect.w)),
                            first_index + command.idx_offset,
                            command.elem_count,
                            first_vertex + command.vtx_offset,
                            places.setdefault(number, len(places)),
                        )
                    )
            first_vertex += drawn.vtx_buffer.size()
            first_index += drawn.idx_buffer.size()
        return np.array(rows, COMMAND), list(places)

    def _follow(self, texture: imgui.ImTextureData) -> None:
        """Apply ImGui's request for one of its own textures, whose memory is shared."""
        status = self._imgui.ImTextureStatus
        if texture.status == status.want_create:
            side = texture.height, texture.width, texture.bytes_per_pixel
            texture.set_tex_id(self.add(texture.get_pixels_array().reshape(side)))
        if texture.status in (status.want_create, status.want_updates):
            texture.set_status(status.ok)
        elif texture.status == status.want_destroy and texture.unused_frames > 0:
            self.remove(texture.get_tex_id())
            texture.set_tex_id(0)
            texture.set_status(status.destroyed)


def _items(vector: Any) -> list[Any]:
    """Return the items of an ImGui vector: on Windows, its iterator may give them other types."""
    return [vector[place] for place in range(vector.size())]


def _joined(vectors: list[Any], dtype: np.dtype) -> NDArray[Any]:
    """Return a concatenated copy of some ImGui vectors.

    It copies bytes: NumPy would copy structures field by field.
    """
    memory = [
        (ctypes.c_ubyte * (vector.size() * dtype.itemsize)).from_address(vector.data_address())
        for vector in vectors
    ]
    return np.frombuffer(b"".join(memory), dtype)
