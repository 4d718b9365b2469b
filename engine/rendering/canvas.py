"""The 2-D canvas: points, lines, triangles, rectangles and text on an array of pixels.

In:  positions in screen space, in pixels: x right, y down, from the top left corner of the picture.
     Pixel (i, j) is the square [i, i+1) x [j, j+1); its centre is (i + 0.5, j + 0.5).
Out: the pixels, changed in place. Opaque colours overwrite; others are blended with straight alpha.
Every position is legal: drawing is clipped to the canvas, and non-finite positions draw nothing.
The drawing itself is C (csrc/extras/canvas); docs/canvas.md gives its rules.
"""

from __future__ import annotations

import math
import numbers
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, cast, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._native import canvas as native
from .._native.images import encode_png
from ..base.foreign_arrays import is_foreign_array, without_axes
from ..base.image_size import sides_of
from ..base.numbers import as_array, floats, real, shown
from ..base.validation import FixedNames, choose, flag
from ..choices import ColorLike
from ..errors import InvalidArgumentError
from ..model.materials.colors import eight_bit_or_linear, holds_colors, srgb_bytes
from ..model.materials.display_colors import rgba_codes
from .fonts.font import Font, checked_text

if TYPE_CHECKING:
    from PIL import Image

LineAlgorithm = Literal["bresenham", "dda"]
TriangleAlgorithm = Literal["edge", "scanline"]

_TAB_COLUMNS = 4
_MAX_TEXT_SCALE = 4096
# The font's codes of characters; a hollow box stands for all others.
_FONT_CODES = {code: code for code in (ord("\n"), *range(32, 127))}
_FONT_CODES |= {ord(letter): code for code, letter in enumerate("àâçèéêëîïôùûœÀÇÉ", 128)}
_REPLACEMENT_CODE = 127
#: Units of smooth shapes in a pixel, and how large these may be, since their units have 16 bits.
_UNITS, _LARGEST_SHAPE = 16, 2046
_UPWARD = np.array([_UNITS, -_UNITS])
#: Smooth shapes farther out than this are on no canvas.
_FAR = 2.0**30
_ROOT = math.sqrt(2.0)
#: A circle around the origin: eight points on it, and control points of quadratic curves between.
_EIGHTH, _CONTROL = _ROOT / 2, _ROOT - 1.0
_ARC = ((1.0, 0.0), (1.0, _CONTROL), (_EIGHTH, _EIGHTH), (_CONTROL, 1.0))
_CIRCLE = np.array(
    [
        *_ARC,
        *((-y, x) for x, y in _ARC),
        *((-x, -y) for x, y in _ARC),
        *((y, -x) for x, y in _ARC),
    ]
)
_ON_CIRCLE = np.array([1, 0] * 8, np.uint8)
_ON_RING = np.array([1, 0] * 8 + [0, 1] * 8, np.uint8)
_ONE_CIRCLE, _TWO_CIRCLES = np.array([16], np.int32), np.array([16, 32], np.int32)


class Canvas(FixedNames):
    """A 2-D drawing surface.

    Parameters
    ----------
    size : (int, int)
        Width and height in pixels of a new canvas, which starts opaque black.
    pixels : ndarray of uint8, shape (H, W, 4)
        Instead of a size: the RGBA pixels to draw on, top row first, a writable array whose pixels
        are contiguous within each row. It is not copied. A slice of a larger image makes a canvas
        that clips to that window.

    Raises
    ------
    InvalidArgumentError
        If a side is not 0 to 262144, or the array is unsuitable.

    Examples
    --------
    >>> canvas = Canvas((320, 200))
    >>> canvas.line(10, 10, 300, 180, (255, 200, 0))
    >>> canvas.text(10, 10, "engine3d", (255, 255, 255), background=(0, 0, 0, 160))
    """

    @overload
    def __init__(self, size: tuple[int, int]) -> None: ...

    @overload
    def __init__(self, pixels: NDArray[np.uint8], /) -> None: ...

    def __init__(self, size: tuple[int, int] | NDArray[np.uint8]) -> None:
        if is_foreign_array(size):
            size = as_array(size, "pixels")
        if isinstance(size, np.ndarray) and size.ndim > 1:
            self._pixels: NDArray[np.uint8] = size
        else:
            self._pixels = _new_pixels(size)
        try:
            self._surface = native.Surface(self._pixels)
        except ValueError as error:
            raise InvalidArgumentError(
                f"pixels must be a writable (H, W, 4) uint8 array with contiguous rows: {error}"
            ) from None

    @property
    def pixels(self) -> NDArray[np.uint8]:
        """The (H, W, 4) uint8 RGBA pixels, top row first: the array itself, not a copy."""
        return self._pixels

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self.width, self.height

    @property
    def width(self) -> int:
        """Width in pixels."""
        return self._pixels.shape[1]

    @property
    def height(self) -> int:
        """Height in pixels."""
        return self._pixels.shape[0]

    def __reduce__(self) -> tuple[type[Canvas], tuple[NDArray[np.uint8]]]:
        # A shallow copy draws on the same pixels; a pickled canvas has its own.
        return type(self), (self._pixels,)

    def __repr__(self) -> str:
        return f"Canvas(({self.width}, {self.height}))"

    def image(self) -> Image.Image:
        """Return a copy of the pixels as a Pillow image in mode RGBA."""
        from PIL import Image

        return Image.fromarray(self._pixels.copy())

    def _repr_png_(self) -> bytes | None:
        return encode_png(np.ascontiguousarray(self._pixels)) if self._pixels.size else None

    def clear(self, color: ColorLike = (0, 0, 0, 255)) -> None:
        """Overwrite every pixel, alpha included.

        Parameters
        ----------
        color : (r, g, b) or (r, g, b, a)
            Integers 0 to 255. Here, and in every other call, alpha is 255 if left out.
        """
        self._surface.clear(_color_bytes(color))

    def point(self, x: float, y: float, color: ColorLike) -> None:
        """Draw the pixel that contains (x, y)."""
        x, y = _numbers("x and y", x, y)
        self._surface.point(x, y, _color_bytes(color))

    def points(self, xy: ArrayLike, color: ColorLike) -> None:
        """Draw many points in one call.

        Parameters
        ----------
        xy : array_like, shape (N, 2)
            Positions in pixels.
        color : (r, g, b[, a]), or array of uint8, shape (N, 3) or (N, 4)
            One colour for all points, or one for each.
        """
        positions = _positions(xy, 2, "xy")
        self._surface.points(positions, _colors_bytes(color, len(positions)))

    def line(
        self,
        x0: float,
        y0: float,
        x1: float,
        y1: float,
        color: ColorLike,
        *,
        width: float = 1,
        algorithm: LineAlgorithm = "bresenham",
    ) -> None:
        """Draw a line between the pixels that contain its two ends.

        Both end pixels are included, and the two directions of a line give the same pixels.

        Parameters
        ----------
        x0, y0, x1, y1 : float
            The ends, in pixels.
        color : (r, g, b) or (r, g, b, a)
            Integers 0 to 255.
        width : float, optional
            Thickness in pixels along the minor axis (y for a line that is rather horizontal). A
            line up to 1 wide has one pixel a step; a wider one is a filled parallelogram.
        algorithm : {"bresenham", "dda"}, optional
            How a line up to 1 wide finds its pixels: by an integer error term, or by the slope in
            floating point. They differ at most where two pixels are equally near.

        Raises
        ------
        InvalidArgumentError
            If the width is not a positive number or the algorithm is unknown.
        """
        algorithm_code = _algorithm(native.LINE_ALGORITHMS, algorithm)
        x0, y0, x1, y1 = _numbers("x0, y0, x1 and y1", x0, y0, x1, y1)
        self._surface.line(x0, y0, x1, y1, _color_bytes(color), _width(width), algorithm_code)

    def lines(
        self,
        xyxy: ArrayLike,
        color: ColorLike,
        *,
        width: float = 1,
        algorithm: LineAlgorithm = "bresenham",
    ) -> None:
        """Draw many separate lines in one call, in the order given.

        Parameters
        ----------
        xyxy : array_like, shape (N, 4)
            The ends (x0, y0, x1, y1) of each line, in pixels. (N, 2, 2) is taken too.
        color : (r, g, b[, a]), or array of uint8, shape (N, 3) or (N, 4)
            One colour for all lines, or one for each.
        width, algorithm
            As for `line`.
        """
        positions = _positions(xyxy, 4, "xyxy")
        colors = _colors_bytes(color, len(positions))
        algorithm_code = _algorithm(native.LINE_ALGORITHMS, algorithm)
        self._surface.lines(positions, colors, _width(width), algorithm_code)

    def polyline(
        self,
        xy: ArrayLike,
        color: ColorLike,
        *,
        closed: bool = False,
        width: float = 1,
        algorithm: LineAlgorithm = "bresenham",
    ) -> None:
        """Draw a line from each point to the next.

        Parameters
        ----------
        xy : array_like, shape (N, 2)
            The points, in pixels. A non-finite point interrupts the polyline.
        color : (r, g, b) or (r, g, b, a)
            Integers 0 to 255. Up to a width of 1, the pixel that two lines share is drawn once.
        closed : bool, optional
            Whether a line goes from the last point back to the first.
        width, algorithm
            As for `line`.
        """
        positions = _positions(xy, 2, "xy")
        algorithm_code = _algorithm(native.LINE_ALGORITHMS, algorithm)
        color_bytes = _color_bytes(color)
        self._surface.polyline(
            positions, flag(closed, "closed"), color_bytes, _width(width), algorithm_code
        )

    def triangle(
        self,
        a: Sequence[float],
        b: Sequence[float],
        c: Sequence[float],
        color: ColorLike,
        *,
        algorithm: TriangleAlgorithm = "edge",
    ) -> None:
        """Fill a triangle, in either winding.

        A pixel is covered if its centre is inside; a centre on an edge belongs to the triangle if
        the edge is a top or a left one. So triangles that share an edge neither overlap nor leave a
        gap.

        Parameters
        ----------
        a, b, c : (x, y)
            The vertices in pixels, snapped to 1/256 pixel.
        color : (r, g, b) or (r, g, b, a)
            Integers 0 to 255.
        algorithm : {"edge", "scanline"}, optional
            Test the pixels of the bounding box with edge functions, or sweep from row to row. Both
            give the same pixels.
        """
        algorithm_code = _algorithm(native.TRIANGLE_ALGORITHMS, algorithm)
        (ax, ay), (bx, by), (cx, cy) = _pair(a, "a"), _pair(b, "b"), _pair(c, "c")
        self._surface.triangle(ax, ay, bx, by, cx, cy, _color_bytes(color), algorithm_code)

    def triangles(
        self,
        xyxyxy: ArrayLike,
        color: ColorLike,
        *,
        algorithm: TriangleAlgorithm = "edge",
    ) -> None:
        """Fill many triangles in one call, in the order given.

        Parameters
        ----------
        xyxyxy : array_like, shape (N, 6)
            The vertices (x0, y0, x1, y1, x2, y2) of each, in pixels. (N, 3, 2) is taken too.
        color : (r, g, b[, a]), or array of uint8, shape (N, 3) or (N, 4)
            One colour for all triangles, or one for each.
        algorithm
            As for `triangle`.
        """
        positions = _positions(xyxyxy, 6, "xyxyxy")
        colors = _colors_bytes(color, len(positions))
        algorithm_code = _algorithm(native.TRIANGLE_ALGORITHMS, algorithm)
        self._surface.triangles(positions, colors, algorithm_code)

    def rectangle(
        self,
        x: float,
        y: float,
        width: float,
        height: float,
        color: ColorLike,
        *,
        fill: bool = True,
    ) -> None:
        """Draw an axis-aligned rectangle.

        Parameters
        ----------
        x, y : float
            The top left corner, in pixels.
        width, height : float
            The size in pixels; the rectangle covers the pixels whose centres it contains, so that
            one with integer corners covers exactly width x height pixels.
        color : (r, g, b) or (r, g, b, a)
            Integers 0 to 255.
        fill : bool, optional
            Fill it, or draw its outermost pixels only.
        """
        x, y, width, height = _numbers("x, y, width and height", x, y, width, height)
        self._surface.rectangle(x, y, width, height, _color_bytes(color), flag(fill, "fill"))

    def polygon(self, xy: ArrayLike | Sequence[ArrayLike], color: ColorLike) -> None:
        """Fill a polygon with smooth edges: a pixel takes the share of it that is covered.

        Parameters
        ----------
        xy : array_like, shape (N, 2), or sequence of such
            The corners in pixels, rounded to 1/16 pixel; or several contours. What two contours
            wind around in opposite directions is a hole. A non-finite corner draws nothing.
        color : (r, g, b) or (r, g, b, a)
            Integers 0 to 255.

        Raises
        ------
        InvalidArgumentError
            Also if it is 2046 pixels wide or high, or more, on the canvas or not.
        """
        contours = [_positions(contour, 2, "xy") for contour in _contours(xy)]
        contours = [contour for contour in contours if len(contour)]
        if contours:
            points = contours[0] if len(contours) == 1 else np.concatenate(contours)
            ends = np.cumsum([len(contour) for contour in contours], dtype=np.int32)
            self._fill(points, np.ones(len(points), np.uint8), ends, color)

    def disc(
        self, x: float, y: float, radius: float, color: ColorLike, *, width: float | None = None
    ) -> None:
        """Fill a disc with a smooth edge, or a ring.

        Parameters
        ----------
        x, y : float
            The centre, in pixels.
        radius : float
            At most 1000 pixels.
        color : (r, g, b) or (r, g, b, a)
            Integers 0 to 255.
        width : float, optional
            Draw a ring so wide, inward from the radius.

        Raises
        ------
        InvalidArgumentError
            Also if a radius or width is negative, or the disc too large.
        """
        x, y, radius = _numbers("x, y and radius", x, y, radius)
        inner = 0.0 if width is None else max(radius - _numbers("width", width)[0], 0.0)
        if not 0.0 <= inner <= radius < math.inf:
            raise InvalidArgumentError("radius and width must be finite, and not negative")
        points, flags, ends = radius * _CIRCLE, _ON_CIRCLE, _ONE_CIRCLE
        if inner > 0.0:
            points = np.concatenate([points, inner * _CIRCLE[::-1]])
            flags, ends = _ON_RING, _TWO_CIRCLES
        self._fill(points + (x, y), flags, ends, color)

    def _fill(
        self,
        points: NDArray[np.float64],
        on_curve: NDArray[np.uint8],
        ends: NDArray[np.int32],
        color: Any,
    ) -> None:
        """Fill contours of straight and curved parts; see `e3d_outline` for the arrays."""
        color_bytes = _color_bytes(color)
        (left, top), (right, bottom) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        sides = right - left, bottom - top
        if not all(map(math.isfinite, sides)):
            return
        if max(sides) >= _LARGEST_SHAPE:
            raise InvalidArgumentError(
                f"a polygon is less than {_LARGEST_SHAPE} pixels wide and high, not {shown(sides)}"
            )
        if max(abs(left), abs(top)) > _FAR:
            return
        left, top = math.floor(left), math.floor(top)
        units = np.rint((points - (left, top)) * _UPWARD).astype(np.int16)
        self._surface.outline(left, top, units, on_curve, ends, _UNITS, color_bytes)

    def text(
        self,
        x: float,
        y: float,
        string: str,
        color: ColorLike,
        *,
        font: Font | None = None,
        scale: int = 1,
        background: ColorLike | None = None,
    ) -> None:
        """Write text in a font, or in the built-in bitmap font, whose cells are 8 x 14 pixels.

        Parameters
        ----------
        x, y : float
            The top left corner of the first line, in pixels.
        string : str
            ``\\n`` starts a new line, a tab advances to the next multiple of four characters, and
            characters that the font lacks show as a hollow box. The bitmap font has ASCII and the
            letters àâçèéêëîïôùûœÀÇÉ.
        color : (r, g, b) or (r, g, b, a)
            Integers 0 to 255.
        font : Font, optional
            Its glyphs are antialiased. Without one, the bitmap font is used.
        scale : int, optional
            Pixels of the canvas for one of the bitmap font, 1 to 4096.
        background : (r, g, b) or (r, g, b, a), optional
            Draw the text on a box of this colour, with a margin of ``2 * scale`` pixels, or an
            eighth of the font's size. A translucent box keeps text legible on any picture.

        Raises
        ------
        InvalidArgumentError
            Also if both a font and a scale are given: a font has its size.
        """
        (x, y), ink, scale = _numbers("x and y", x, y), _color_bytes(color), _scale(scale)
        if font is not None and (not isinstance(font, Font) or scale != 1):
            raise InvalidArgumentError(
                f"font must be a Font, without a scale, not {shown(font)} with {scale}"
            )
        if background is not None and checked_text(string):
            _color_bytes(background, "background")
            width, height = font.text_size(string) if font else text_size(string, scale)
            pad = round(font.size / 8) if font else 2 * scale
            left, top = np.floor((x, y)) - pad
            self.rectangle(left, top, width + 2 * pad, height + 2 * pad, background)
        if font:
            font._draw(self._surface, x, y, string, ink)
        else:
            self._surface.text(x, y, _codes(string), scale, ink)


def text_size(string: str, scale: int = 1) -> tuple[int, int]:
    """Return the size of a text in the built-in bitmap font.

    Parameters
    ----------
    string : str
        The text; it may have several lines.
    scale : int, optional
        Pixels of the canvas for one of the font, 1 to 4096.

    Returns
    -------
    width, height : int
        Size in pixels of the text's cells, without the background's margin.
    """
    return native.text_size(_codes(string), _scale(scale))


def lay_over(below: NDArray[np.uint8], pixels: NDArray[np.uint8]) -> None:
    """Blend RGBA pixels over opaque ones, (H, W, 3) or (H, W, 4), as the canvas blends a colour."""
    alpha = pixels[..., 3:].astype(np.uint16)
    mixed = alpha * pixels[..., :3] + (255 - alpha) * below[..., :3]
    below[..., :3] = (mixed + 127) // 255


def _new_pixels(size: object) -> NDArray[np.uint8]:
    width, height = sides_of(size)
    for side in (width, height):
        if not isinstance(side, int | np.integer) or not 0 <= side <= native.MAX_SIDE:
            raise InvalidArgumentError(
                f"width and height must be integers from 0 to {native.MAX_SIDE}, not {shown(side)}"
            )
    pixels = np.zeros((height, width, 4), np.uint8)
    pixels[..., 3] = 255
    return pixels


def _color_bytes(color: Any, what: str = "color") -> bytes:
    try:
        rgba = bytes(tuple(cast("Sequence[int]", color)))
    except (TypeError, ValueError):  # a word, or floats
        rgba = rgba_codes(color, what)
    if len(rgba) == 3:
        return rgba + b"\xff"
    if len(rgba) != 4:
        raise InvalidArgumentError(
            f"{what} must be (r, g, b) or (r, g, b, a), integers from 0 to 255, not {shown(color)}"
        )
    return rgba


def _colors_bytes(color: ColorLike, count: int) -> bytes | NDArray[np.uint8]:
    """Return 4 bytes for all primitives, or 4 for each of them."""
    if isinstance(color, str) or as_array(color, "color").ndim != 2 and not holds_colors(color):
        return _color_bytes(color)
    colors = srgb_bytes(eight_bit_or_linear(color, "color"))
    if colors.shape not in ((count, 3), (count, 4)):
        raise InvalidArgumentError(
            f"color for {count} primitives is one, or ({count}, 3) or ({count}, 4) numbers, "
            f"not {colors.shape}"
        )
    rgba = np.full((count, 4), 255, np.uint8)
    rgba[:, : colors.shape[1]] = colors
    return rgba.reshape(-1)


def _positions(values: ArrayLike, columns: int, name: str) -> NDArray[np.float64]:
    positions = floats(values, name)
    if positions.size == 0:
        return np.empty((0, columns))
    if positions.ndim == 3 and positions.shape[1] * positions.shape[2] == columns:
        positions = positions.reshape(-1, columns)
    if positions.ndim != 2 or positions.shape[1] != columns:
        raise InvalidArgumentError(f"{name} must be (N, {columns}), not {positions.shape}")
    return positions


def _contours(xy: Any) -> Sequence[Any]:
    """Return the contours of a polygon, which may be given as one array of corners."""
    if isinstance(xy, np.ndarray):
        return [xy] if xy.ndim < 3 else list(xy)
    if not isinstance(xy, Sequence):
        return [xy]
    rows = [as_array(row, "xy") for row in xy]
    is_one = all(row.ndim == 1 for row in rows)
    return [xy] if is_one else rows


def _numbers(what: str, *values: float) -> list[float]:
    for value in values:
        if not isinstance(without_axes(value, what), numbers.Real):
            raise InvalidArgumentError(f"{what} must be numbers, not {shown(value)}")
    return list(map(real, values))


def _pair(value: Sequence[float], what: str) -> list[float]:
    try:
        x, y = value
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"{what} must be (x, y), not {shown(value)}") from None
    return _numbers(what, x, y)


def _algorithm(codes: dict[str, int], name: str) -> int:
    return codes[choose(name, codes, "algorithm")]


def _width(width: float) -> float:
    number = real(width)
    if not number > 0:
        raise InvalidArgumentError(f"width must be a positive number, not {shown(width)}")
    return number


def _scale(scale: int) -> int:
    if not isinstance(scale, int | np.integer) or not 1 <= scale <= _MAX_TEXT_SCALE:
        raise InvalidArgumentError(
            f"scale must be an integer from 1 to {_MAX_TEXT_SCALE}, not {shown(scale)}"
        )
    return int(scale)


def _codes(string: str) -> bytes:
    characters = checked_text(string).expandtabs(_TAB_COLUMNS).encode("utf-32-le", "surrogatepass")
    codes = np.frombuffer(characters, "<u4")
    if codes.size and (codes.max() > 126 or codes.min() < 32):
        unique, places = np.unique(codes, return_inverse=True)
        known = [_FONT_CODES.get(code, _REPLACEMENT_CODE) for code in unique.tolist()]
        codes = np.array(known)[places]
    return codes.astype(np.uint8).tobytes()
