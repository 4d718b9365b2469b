"""Rendered frames: outputs as arrays, and ways to show and save them.

In: the arrays that `Renderer.render` drew. Out: one writable array per output, top row first.
Reading an output that was not requested raises an error that names the argument to request it.
Files are written whole or not at all.
"""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING, Any, Generic, Literal, TypeVar, cast, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._native import rasterizer as _native
from .._native.images import encode_png
from ..base.calls import checks_types, hints_keywords
from ..base.files.atomic_write import atomic_write, checked_path
from ..base.foreign_names import refuses_foreign_names
from ..base.image_size import sides_of
from ..base.validation import choose
from ..choices import FrameCull, ImageFormat, OutputMode
from ..errors import InvalidArgumentError, MissingOutputError
from .picture_mark import TGA_MARK
from .transparency import refuse_transparency

if TYPE_CHECKING:
    from PIL import Image

    from ._view import View
    from .canvas import Canvas
    from .lens.lens_stats import LensStats

# What a frame may hold, for type checkers: colour, depths, what the core's modes show, and all that
# the viewer shows besides. `Frame` has a property of each.
Output = Literal["color", "depth", "ndc_depth", "face_id", "object_id", "normal", OutputMode]
# Their dtypes and numbers of channels (0: no third axis), as the core lists them.
OUTPUTS: dict[str, tuple[np.dtype[Any], int]] = {
    name: (np.dtype(dtype), channels if channels > 1 else 0)
    for name, (dtype, channels) in _native.OUTPUTS.items()
}

# File name suffix -> (Pillow's format, options for saving).
_FORMATS: dict[ImageFormat, tuple[str, dict[str, Any]]] = {
    "png": ("PNG", {}),
    "jpg": ("JPEG", {"quality": 95, "subsampling": 0}),
    "jpeg": ("JPEG", {"quality": 95, "subsampling": 0}),
    "tga": ("TGA", {"compression": "tga_rle", "id_section": TGA_MARK}),
    "webp": ("WEBP", {"lossless": True}),
}


Scalar = TypeVar("Scalar", bound=np.generic)


class _Output(Generic[Scalar]):
    """A property that returns one output."""

    def __init__(self, doc: str) -> None:
        self.__doc__ = doc

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, frame: None, owner: type | None = None) -> _Output[Scalar]: ...

    @overload
    def __get__(self, frame: Frame, owner: type | None = None) -> NDArray[Scalar]: ...

    def __get__(self, frame: Frame | None, owner: type | None = None) -> Any:
        if frame is None:
            return self
        try:
            return frame._outputs[self._name]
        except KeyError:
            raise MissingOutputError(
                f"this frame has no {self._name}: ask for it with "
                f'render(..., outputs=("{self._name}",))'
            ) from None


@hints_keywords
@refuses_foreign_names
class Frame:
    """The result of rendering: the requested outputs as arrays.

    The arrays belong to the caller and never change, unless the frame is passed to
    ``render(out=...)``. ``np.asarray(frame)`` has the memory of ``frame.color``; so have
    ``torch.from_dlpack(frame)`` and, from Python 3.12 on, ``memoryview(frame)``.

    Attributes
    ----------
    size : (int, int)
        Width and height in pixels.
    width, height : int
    outputs : tuple of str
        Names of the outputs it holds.
    stats : dict
        Counters (draws, triangles, pixels_shaded, …), milliseconds of the stages (``ms_…``), of
        all (``ms_total``), and of that while fewer than two threads worked (``ms_alone``); the
        number of threads and tiles, and the backend. ``plan`` names the code paths of the tiles
        (docs/plan.md lists them; none for the backend ``scalar``). ``nodes``, ``instances``,
        ``clusters`` and ``triangles`` count the whole scene, ``objects`` its nodes that draw
        anything; with the suffix ``_in_frustum``, ``_unoccluded`` or ``_drawn``, what remains after
        each culling stage. ``boxes_tested`` counts the boxes tested
        for frustum culling when the view or the scene last changed: those of nodes and instances,
        and those of tree branches. Through a lens, counters and times are sums over ``lens_faces``
        pinhole pictures, and ``lens_rays`` rays were cast into the scene.
    """

    color: _Output[np.uint8] = _Output(
        "(H, W, 4) uint8 RGBA; alpha is 255, and 0 where a background of None shows."
    )
    depth: _Output[np.float32] = _Output(
        "(H, W) float32: metric distance along the view axis, 0 = background."
    )
    ndc_depth: _Output[np.float32] = _Output(
        "(H, W) float32: z_ndc, smaller is nearer, +inf = background."
    )
    face_id: _Output[np.int32] = _Output("(H, W) int32: index into mesh.faces as given, -1 = none.")
    object_id: _Output[np.int32] = _Output("(H, W) int32: node.id, -1 = background.")
    instance_id: _Output[np.int32] = _Output(
        "(H, W) int32: row of the instances, 0 for a plain mesh, -1 = background."
    )
    material_id: _Output[np.int32] = _Output(
        "(H, W) int32: index into mesh.materials, -1 = background."
    )
    albedo: _Output[np.float32] = _Output(
        "(H, W, 3) float32: surface colour before light, linear; 0 = background."
    )
    normal: _Output[np.float32] = _Output(
        "(H, W, 3) float32: unit normal in view space; 0 = background."
    )
    position: _Output[np.float32] = _Output(
        "(H, W, 3) float32: position in view space; 0 = background."
    )
    world_normal: _Output[np.float32] = _Output(
        "(H, W, 3) float32: unit normal in world space; 0 = background."
    )
    world_position: _Output[np.float32] = _Output(
        "(H, W, 3) float32: position in world space; 0 = background."
    )
    uv: _Output[np.float32] = _Output(
        "(H, W, 2) float32: texture coordinates, origin bottom left; 0 = background."
    )
    barycentric: _Output[np.float32] = _Output(
        "(H, W, 3) float32: perspective-correct weights; 0 = background."
    )
    metallic_roughness: _Output[np.float32] = _Output(
        "(H, W, 2) float32: metallic and roughness, of what is not physically based 0 and 1; "
        "0 = background."
    )
    emissive: _Output[np.float32] = _Output(
        "(H, W, 3) float32: linear light that the surface gives off; 0 = background."
    )
    tangent: _Output[np.float32] = _Output(
        "(H, W, 4) float32: unit vector in view space to the right in the image of normal maps, "
        "and 1 or -1: up is this times cross(normal, tangent), the normal before it is mapped; "
        "0 = none, background."
    )
    radiance: _Output[np.float32] = _Output(
        "(H, W, 3) float32: the colour with exposure and fog before it is tone mapped and clamped, "
        "linear; 0 = background, unless it is an environment. What is blended is laid over what is "
        "behind it, as in the picture."
    )
    range: _Output[np.float32] = _Output(
        "(H, W) float32: distance from the camera along the pixel's ray, in world units; without "
        "perspective the same as depth; 0 = background."
    )

    def __init__(self, size: tuple[int, int], outputs: dict[str, NDArray[Any]]) -> None:
        self.width, self.height = sides_of(size)
        self._stats: dict[str, Any] = {}
        # Until they are read: the number of nodes, and the core's counters.
        self._drawn: tuple[int, _native.NativeStats | LensStats] | None = None
        # For picking: the view, and which faces were culled.
        self._seen: tuple[View, FrameCull] | None = None
        self._outputs = outputs

    @property
    def size(self) -> tuple[int, int]:
        return self.width, self.height

    @property
    def outputs(self) -> tuple[Output, ...]:
        return cast("tuple[Output, ...]", tuple(self._outputs))

    @property
    def stats(self) -> dict[str, Any]:
        unread = self._drawn  # another thread may read it meanwhile
        if unread is not None:
            nodes, drawn = unread
            self._stats, self._drawn = {"nodes": nodes, **drawn.as_dict()}, None
        return self._stats

    def __getstate__(self) -> dict[str, Any]:
        self._stats = self.stats  # a pickled frame keeps only the statistics
        return self.__dict__

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        if copy is False and dtype is not None and np.dtype(dtype) != np.uint8:
            raise ValueError("a frame's colour is uint8: another dtype needs a copy")
        if copy:
            return np.array(self.color, dtype)
        return np.asarray(self.color, dtype)

    def __buffer__(self, flags: int) -> memoryview:  # read from Python 3.12 on (PEP 688)
        return memoryview(self.color)

    def __dlpack__(self, **options: Any) -> Any:
        export: Any = self.color.__dlpack__
        return export(**{key: value for key, value in options.items() if value is not None})

    def __dlpack_device__(self) -> tuple[int, int]:
        return self.color.__dlpack_device__()

    def project(self, points: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the pixel positions of world points, and their distances from the camera.

        Parameters
        ----------
        points : (3,) or (N, 3) float
            World space.

        Returns
        -------
        pixels : (2,) or (N, 2) float64
            Screen space, in pixels: x to the right and y down from the top left corner; the centre
            of the top left pixel is (0.5, 0.5). Points outside the picture have positions outside
            it. NaN for points not in front of the camera.
        depth : () or (N,) float64
            Distance along the view axis in world units, as in ``frame.depth``; negative behind the
            camera. A point is visible if it is in the picture and nothing nearer is drawn there.

        Raises
        ------
        InvalidArgumentError
            The points have a wrong shape, or the frame was not drawn by a `Renderer`.
        """
        return view_of(self).project(points, self.width, self.height)

    def rays(self, pixels: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the rays along which places of the picture look: the inverse of `project`.

        Parameters
        ----------
        pixels : (2,) or (N, 2) float
            Screen space, as `project` returns them; the centre of the top left pixel is (0.5, 0.5).

        Returns
        -------
        origins : (3,) or (N, 3) float64
            World space: the camera or, without perspective, points on its near plane.
        directions : (3,) or (N, 3) float64
            Unit vectors in world space; NaN where a lens sees nothing.

        Raises
        ------
        InvalidArgumentError
            The pixels have a wrong shape, or the frame was not drawn by a `Renderer`.

        Examples
        --------
        >>> hits = scene.raycast_many(*frame.rays([(320.5, 240.5), (10.5, 20.5)]))
        """
        if self._seen is None:
            raise InvalidArgumentError("the frame was not drawn by a Renderer")
        return self._seen[0].world_rays(pixels, self.width, self.height)

    def image(self) -> Image.Image:
        """Return the colour as a Pillow image (``PIL.Image.Image``, RGBA), a copy."""
        from PIL import Image

        return Image.frombytes("RGBA", (self.width, self.height), self.color.tobytes())

    def canvas(self) -> Canvas:
        """Return an `engine3d.Canvas` that draws into this frame's colour."""
        from .canvas import Canvas

        return Canvas(self.color)

    @checks_types
    def save(self, path: str | os.PathLike[str], **options: Any) -> None:
        """Write the colour to an image file, whole or not at all.

        Parameters
        ----------
        path : str or path-like
            The suffix decides the format: .png, .jpg, .jpeg (no alpha), .tga or .webp (lossless).
        **options
            Passed to Pillow's writer, such as ``quality=80``. Without options, the engine writes
            PNG itself: fast, and the same bytes everywhere.

        Raises
        ------
        InvalidArgumentError
            The suffix is none of these, or the format lacks the alpha that the picture needs.
        FileAccessError
            The file cannot be written.
        """
        suffix = os.path.splitext(checked_path(path))[1].lstrip(".").lower()
        data = self.encode(cast(ImageFormat, suffix), **options)
        with atomic_write(path) as file:
            file.write(data)

    @checks_types
    def encode(self, format: ImageFormat = "png", **options: Any) -> bytes:
        """Return the colour as the bytes of an image file.

        Parameters
        ----------
        format : {"png", "jpg", "jpeg", "tga", "webp"}
        **options
            As for `save`.

        Raises
        ------
        InvalidArgumentError
            The format is none of these, or lacks the alpha that the picture needs.
        """
        choose(format, _FORMATS, "format")
        if format == "png" and not options:
            return encode_png(self.color)
        name, defaults = _FORMATS[format]
        image = self.image()
        if name == "JPEG":
            refuse_transparency(self.color, f".{format}")
            image = image.convert("RGB")
        buffer = io.BytesIO()
        image.save(buffer, name, **{**defaults, **options})
        return buffer.getvalue()

    def _repr_png_(self) -> bytes | None:
        return self.encode("png") if "color" in self._outputs else None

    def __repr__(self) -> str:
        return f"<Frame {self.width}x{self.height}: {', '.join(self._outputs)}>"


def view_of(frame: Frame) -> View:
    """Return the view that a frame was drawn from.

    Raises
    ------
    InvalidArgumentError
        The frame was not drawn by a `Renderer`.
    """
    if frame._seen is None:
        raise InvalidArgumentError("the frame was not drawn by a Renderer")
    return frame._seen[0]
