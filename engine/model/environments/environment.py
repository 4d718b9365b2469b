"""Environments: light that reaches a scene from every direction.

In: an equirectangular picture of linear light, a file of one, or a built-in name. Out: an immutable
`Environment`. The core prefilters it for each roughness when it is first drawn, and keeps the
result with the object.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Callable
from typing import TYPE_CHECKING, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen, is_frozen
from ...base.calls import checks_types
from ...base.linalg.single import normalize
from ...base.notebook_pictures import ShownInNotebooks
from ...base.numbers import floats, real, shown
from ...base.validation import Closed, text, vector3
from ...choices import BuiltInEnvironment
from ...errors import InvalidArgumentError

if TYPE_CHECKING:
    from ...io.reading.sources import File, Source

#: Names of the procedural environments.
BUILT_IN: tuple[BuiltInEnvironment, ...] = get_args(BuiltInEnvironment)
MAX_SIDE = 16384


class Environment(ShownInNotebooks, Closed):
    """Light from every direction, as an equirectangular picture.

    Column u and row v, both in [0, 1] from the left and from below, hold the radiance from the
    direction (x, y, z) with u = atan2(z, x)/2pi + 1/2 and v = asin(y)/pi + 1/2: up is the top row;
    -Z, where cameras look, is a quarter from the left. three.js and Blender use the same layout.

    An environment is immutable, so scenes and renderers can share it. The first frame prefilters it
    (some tenths of a second for 2048 x 1024 pixels); the result is kept with the object.

    Parameters
    ----------
    pixels : (H, W, 3) array-like of float
        Linear radiance, the top row first; 1 is the radiance of a white surface under light of 1.
        Sides from 1 to 16384, commonly W = 2H. Negative and non-finite values become 0; values
        above 2**40 are clamped.
    name : str

    Attributes
    ----------
    pixels : (H, W, 3) float32, read-only
    name : str
    path : str or None
        The file it was loaded from.
    built_in : str or None
        ``"studio"``, ``"sky"`` or ``"hall"`` for built-in environments.
    sun : (sun_direction, turbidity, sun_disc) or None
        The arguments of `sky`.

    Raises
    ------
    InvalidArgumentError
    """

    _pixels: NDArray[np.float32]
    _name: str
    _path: str | None
    _built_in: BuiltInEnvironment | None
    _sun: tuple[tuple[float, float, float], float, bool] | None

    def __init__(self, pixels: ArrayLike, *, name: str = "") -> None:
        self._pixels = _checked(pixels)
        self._name = text(name, "name")
        self._path = None
        self._built_in = None
        self._sun = None

    @staticmethod
    def load(path: File) -> Environment:
        """Load an environment from a file.

        Parameters
        ----------
        path : str, path-like, bytes, binary file object or Traversable
            Radiance (``.hdr``) or OpenEXR (``.exr``, by the optional package OpenEXR:
            ``pip install engine3d[exr]``), told apart by the content.

        Returns
        -------
        environment : Environment

        Raises
        ------
        FileAccessError
            The file cannot be read, or the package it needs is missing.
        FileFormatError
            The file is damaged or of neither format; the message names the file and the byte.
        InvalidArgumentError
        """
        from ...io.reading.sources import read_source

        with read_source(path) as source:
            return environment_of(source)

    @staticmethod
    def studio() -> Environment:
        """Return a photographer's studio: two soft boxes, a strip above, a light floor.

        It lights a white surface about as bright as white paper, with soft highlights.
        """
        return _made("studio")

    @staticmethod
    @checks_types
    def sky(
        sun_direction: ArrayLike | None = None, turbidity: float = 3.0, *, sun_disc: bool = True
    ) -> Environment:
        """Return a clear sky over bare ground.

        Without a direction it is a painted sky: the sun stands behind the right shoulder of a
        viewer who looks along -Z, and lights what they see. With a direction it is a physical sky
        (Preetham, Shirley and Smits 1999): blue at noon, red at dusk.

        Parameters
        ----------
        sun_direction : (3,) float, optional
            Towards the sun, of any nonzero length, not below the horizon (Y < 0).
        turbidity : float
            Turbidity of the air, 2 to 10: 2 is clear, 6 a light haze. Only with a direction.
        sun_disc : bool
            Whether the sun's disc is drawn and lights the scene. Without it, `DirectionalLight.sun`
            with the same direction and turbidity gives its light and can cast shadows. Only with a
            direction.

        Raises
        ------
        InvalidArgumentError
        """
        if sun_direction is None:
            if turbidity != 3.0 or not sun_disc:
                raise InvalidArgumentError("turbidity and sun_disc go with a sun_direction")
            return _made("sky")
        return _daylight(*daylight_arguments(sun_direction, turbidity), bool(sun_disc))

    @staticmethod
    def hall() -> Environment:
        """Return a warm hall with a row of tall windows on its right, and lamps."""
        return _made("hall")

    @property
    def pixels(self) -> NDArray[np.float32]:
        return self._pixels

    @property
    def name(self) -> str:
        return self._name

    @property
    def path(self) -> str | None:
        return self._path

    @property
    def built_in(self) -> BuiltInEnvironment | None:
        return self._built_in

    @property
    def sun(self) -> tuple[tuple[float, float, float], float, bool] | None:
        return self._sun

    @property
    def width(self) -> int:
        return self._pixels.shape[1]

    @property
    def height(self) -> int:
        return self._pixels.shape[0]

    def __repr__(self) -> str:
        return f"Environment({self.width}x{self.height}, name={self.name!r})"


def environment_of(source: Source) -> Environment:
    """Return the environment held by a file's content; raise as `Environment.load` does."""
    from ...io.formats.radiance_pictures import load_radiance

    environment = Environment(frozen(load_radiance(source)), name=source.stem)
    if source.has_path:
        environment._path = os.path.abspath(source.path)
    return environment


def _checked(pixels: ArrayLike) -> NDArray[np.float32]:
    """Return a picture as a read-only, C-contiguous float32 array."""
    if isinstance(pixels, (str, os.PathLike)):
        raise InvalidArgumentError(
            f"an Environment is made of pixels: use Environment.load({pixels!r})"
        )
    if isinstance(pixels, np.ndarray) and pixels.dtype == np.float32:
        array = pixels
    else:
        with np.errstate(over="ignore"):
            array = frozen(floats(pixels, "pixels").astype(np.float32))
    if array.ndim != 3 or array.shape[2] != 3:
        raise InvalidArgumentError(f"pixels must be (H, W, 3), got {array.shape}")
    height, width, _ = array.shape
    if not (1 <= height <= MAX_SIDE and 1 <= width <= MAX_SIDE):
        raise InvalidArgumentError(
            f"an environment's sides must be in 1..{MAX_SIDE}, got {width}x{height}"
        )
    if not np.isfinite(array).all():
        raise InvalidArgumentError("an environment's pixels must be finite")
    if is_frozen(array) and array.flags.c_contiguous:
        return array
    return frozen(np.array(array, order="C"))


@functools.cache
def _made(name: BuiltInEnvironment) -> Environment:
    from . import hall, sky, studio

    makers: dict[str, Callable[[], np.ndarray]] = {
        "studio": studio.pixels,
        "sky": sky.pixels,
        "hall": hall.pixels,
    }
    environment = Environment(frozen(makers[name]()), name=name)
    environment._built_in = name
    return environment


def daylight_arguments(
    sun_direction: ArrayLike, turbidity: float
) -> tuple[tuple[float, float, float], float]:
    """Return the unit vector towards the sun, and the turbidity, checked.

    Raises
    ------
    InvalidArgumentError
    """
    from .daylight import LEAST_TURBIDITY, MOST_TURBIDITY

    x, y, z = normalize(vector3(sun_direction, "sun_direction").tolist())
    if not (x or y or z):
        raise InvalidArgumentError("sun_direction must not be the zero vector")
    if y < 0:
        raise InvalidArgumentError(f"the sun is below the horizon: {shown(sun_direction)}")
    haze = real(turbidity)
    if not LEAST_TURBIDITY <= haze <= MOST_TURBIDITY:
        raise InvalidArgumentError(
            f"turbidity must be in {LEAST_TURBIDITY:g}..{MOST_TURBIDITY:g}, not {shown(turbidity)}"
        )
    return (x, y, z), haze


@functools.lru_cache(maxsize=8)
def _daylight(sun: tuple[float, float, float], turbidity: float, sun_disc: bool) -> Environment:
    from . import daylight

    environment = Environment(frozen(daylight.pixels(sun, turbidity, sun_disc)), name="sky")
    environment._built_in = "sky"
    environment._sun = sun, turbidity, sun_disc
    return environment


def named_environment(name: str) -> Environment:
    """Return the built-in environment with a given name.

    Raises
    ------
    InvalidArgumentError
    """
    if name not in BUILT_IN:
        raise InvalidArgumentError(
            f"environment must be one of {', '.join(BUILT_IN)}, not {shown(name)}"
        )
    return _made(name)
