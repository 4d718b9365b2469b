"""Cameras of calibrations: files of other programs, and records of scene files.

In: JSON, COLMAP's ``cameras.txt``, or YAML of ROS. Out: a camera. Known are records of engine3d's
scene files (``kind``), nerfstudio's ``transforms.json`` (``camera_model``), NeRF's without a model
(``fl_x`` or ``camera_angle_x``), COLMAP's models (``model`` and ``params``), and ROS's
``camera_info`` (``distortion_model``, ``K``, ``D``). Where a format puts the centre of the first
pixel at (0, 0), as ROS does, half a pixel is added.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..base.calls import hinted
from ..base.files.json_records import parsed
from ..base.near_words import meant
from ..base.numbers import floats, real, shown
from ..errors import FileFormatError, InvalidArgumentError
from ..model.scene.cameras import Camera, IntrinsicsCamera
from ..model.scene.lenses.brown_conrady_camera import BrownConradyCamera
from ..model.scene.lenses.fisheye_camera import FisheyeCamera
from ..model.scene.lenses.panorama_cameras import EquirectangularCamera
from .camera_yaml import calibration, is_calibration
from .reading.sources import File, read_source
from .scenes.object_kinds import KINDS

_LARGEST = 1 << 24  # bytes
_CAMERAS = {kind: cls for kind, cls in KINDS.items() if issubclass(cls, Camera)}


@hinted
def load_camera(path: File) -> Camera:
    """Read a camera from a calibration.

    Parameters
    ----------
    path : str, path-like, bytes or binary file
        JSON: a camera's record of a scene file, ``transforms.json`` of NeRF or nerfstudio, ROS's
        ``camera_info``, a camera of COLMAP; or COLMAP's ``cameras.txt``, of which the first camera
        is taken; or ROS's YAML, which needs the package PyYAML.

    Returns
    -------
    Camera
        Near and far planes are the defaults, except in a scene file's record.

    Raises
    ------
    FileFormatError
        The file is none of these, or its model is not known.
    FileAccessError
    """
    return load_calibration(path)[0]


def load_calibration(path: File) -> tuple[Camera, tuple[int, int] | None]:
    """Read a camera, and the width and height of its pictures where the file states them."""
    with read_source(path) as source:
        if source.size > _LARGEST:
            raise FileFormatError(f"not read: larger than {_LARGEST} bytes", source.path)
        data = bytes(source.data)
        try:
            if data.lstrip().startswith((b"{", b"[")):
                said: Any = parsed(data, source.path)
            elif is_calibration(data):
                said = calibration(data)
            else:
                said = _first_camera(data.decode("utf-8", "replace"))
            return camera_of_record(said, "the camera"), stated_size(said)
        except InvalidArgumentError as error:
            raise FileFormatError(str(error), source.path) from None


def camera_of_record(said: Any, what: str) -> Camera:
    """Return the camera that a record describes.

    Parameters
    ----------
    said : mapping
        As `load_camera` reads it.
    what : str
        Its name in errors.

    Raises
    ------
    InvalidArgumentError
    """
    if not isinstance(said, Mapping):
        raise InvalidArgumentError(f"{what} must be an object, not {shown(said)}")
    for key, make in _FORMS.items():
        if key in said:
            return make(said, what)
    raise InvalidArgumentError(f"{what} names no camera model: it has none of {', '.join(_FORMS)}")


def stated_size(said: Mapping[str, Any]) -> tuple[int, int] | None:
    """Return the size that a record states; None for none, and for what is no size."""
    # w and h are nerfstudio's, image_width and image_height are those of ROS's YAML.
    names = (("width", "w", "image_width"), ("height", "h", "image_height"))
    sides = [next((said[name] for name in side if name in said), None) for side in names]
    if not all(real(side) >= 1 and real(side).is_integer() for side in sides):
        return None
    return int(real(sides[0])), int(real(sides[1]))


def _of_kind(said: Mapping[str, Any], what: str) -> Camera:
    kind = _chosen(said["kind"], _CAMERAS, f"{what}: kind")
    try:
        camera = _CAMERAS[kind](**{key: value for key, value in said.items() if key != "kind"})
    except TypeError as error:
        raise InvalidArgumentError(f"{what}: {error}") from None
    return camera


def _of_nerfstudio(said: Mapping[str, Any], what: str) -> Camera:
    models = ("PINHOLE", "SIMPLE_PINHOLE", "OPENCV", "OPENCV_FISHEYE", "EQUIRECTANGULAR")
    model = _chosen(said["camera_model"], models, f"{what}: camera_model")
    if model == "EQUIRECTANGULAR":
        return EquirectangularCamera()
    fx = _number(said, "fl_x", what)
    pixels = {"fx": fx, "fy": _number(said, "fl_y", what, fx)}
    pixels |= {"cx": _number(said, "cx", what), "cy": _number(said, "cy", what)}
    k1, k2, k3, k4, p1, p2 = (
        _number(said, name, what, 0.0) for name in ("k1", "k2", "k3", "k4", "p1", "p2")
    )
    if model == "OPENCV_FISHEYE":
        return FisheyeCamera(**pixels, k=(k1, k2, k3, k4))
    if k4:
        raise InvalidArgumentError(f"{what}: k4 is not 0, which model OPENCV has not")
    if not any((k1, k2, k3, p1, p2)):
        return IntrinsicsCamera(**pixels)
    return BrownConradyCamera(**pixels, distortion=(k1, k2, p1, p2, k3))


def _of_nerf(said: Mapping[str, Any], what: str) -> Camera:
    """Return the camera of NeRF's ``transforms.json``, whose angle counts in widths."""
    if "fl_x" in said:  # instant-ngp's
        model = "OPENCV_FISHEYE" if said.get("is_fisheye") is True else "OPENCV"
        return _of_nerfstudio({"camera_model": model, **said}, what)
    size, angle = stated_size(said), _number(said, "camera_angle_x", what)
    if size is None:
        raise InvalidArgumentError(f"{what}: camera_angle_x of NeRF counts with w and h only")
    if not 0 < angle < math.pi:
        raise InvalidArgumentError(f"{what}: camera_angle_x must be between 0 and π, not {angle}")
    width, height = size
    focal = width / 2 / math.tan(angle / 2)
    return IntrinsicsCamera(focal, focal, width / 2, height / 2)


def _of_colmap(said: Mapping[str, Any], what: str) -> Camera:
    model = _chosen(said["model"], _COLMAP, f"{what}: model")
    params = floats(said.get("params", ()), f"{what}: params").reshape(-1).tolist()
    count, make = _COLMAP[model]
    if len(params) != count:
        raise InvalidArgumentError(f"{what}: {model} has {count} params, not {len(params)}")
    return make(params)


def _of_ros(said: Mapping[str, Any], what: str) -> Camera:
    models = ("plumb_bob", "rational_polynomial", "equidistant", "fisheye")
    model = _chosen(said["distortion_model"] or "plumb_bob", models, f"{what}: distortion_model")
    numbers = []
    for name, in_yaml in (("K", "camera_matrix"), ("D", "distortion_coefficients")):
        held = said.get(name, said.get(name.lower(), said.get(in_yaml, ())))
        held = held.get("data", ()) if isinstance(held, Mapping) else held
        numbers.append(floats(held, f"{what}: {name}").reshape(-1))
    k, d = numbers
    if len(k) != 9:
        raise InvalidArgumentError(f"{what}: K must be 9 numbers, not {len(k)}")
    if model in ("equidistant", "fisheye"):
        return FisheyeCamera.from_opencv(k.reshape(3, 3), d if len(d) else (0.0,) * 4)
    return BrownConradyCamera.from_opencv(k.reshape(3, 3), d if len(d) else (0.0,) * 5)


def _first_camera(text: str) -> Mapping[str, Any]:
    """Return the first camera of COLMAP's text file."""
    for line in text.splitlines():
        words = line.split()
        if words and not words[0].startswith("#"):
            if len(words) < 5:
                break
            width, height, *params = map(_real_text, words[2:])
            return {"model": words[1], "width": width, "height": height, "params": params}
    raise InvalidArgumentError(
        "neither JSON, nor ROS's YAML, nor a line of CAMERA_ID MODEL WIDTH HEIGHT PARAMS"
    )


def _real_text(word: str) -> float:
    """Return a number of a text file."""
    try:
        return float(word)
    except ValueError:
        raise InvalidArgumentError(f"{shown(word)} is not a number") from None


def _chosen(value: Any, known: Sequence[str] | Mapping[str, Any], what: str) -> str:
    if isinstance(value, str) and value in known:
        return value
    hint = meant(value, iter(known)) if isinstance(value, str) else ""
    raise InvalidArgumentError(
        f"{what} must be one of {', '.join(known)}, not {shown(value)}{hint}"
    )


def _number(said: Mapping[str, Any], name: str, what: str, usual: float | None = None) -> float:
    value = said.get(name, usual)
    if value is None or real(value) != real(value):
        raise InvalidArgumentError(f"{what}: {name} must be a number, not {shown(value)}")
    return real(value)


def _opencv(p: Sequence[float]) -> Camera:
    fx, fy, cx, cy, *distortion = p
    return BrownConradyCamera(fx, fy, cx, cy, distortion)


def _fisheye(p: Sequence[float]) -> Camera:
    fx, fy, cx, cy, *k = p
    return FisheyeCamera(fx, fy, cx, cy, (*k, *(0.0,) * (4 - len(k))))


#: COLMAP's models: how many parameters each has, and its camera. Its first pixel's centre is at
#: (0.5, 0.5), as here.
_COLMAP: dict[str, tuple[int, Callable[[list[float]], Camera]]] = {
    "SIMPLE_PINHOLE": (3, lambda p: IntrinsicsCamera(p[0], p[0], p[1], p[2])),
    "PINHOLE": (4, lambda p: IntrinsicsCamera(*p)),
    "SIMPLE_RADIAL": (4, lambda p: _opencv([p[0], *p[:3], p[3], 0.0, 0.0, 0.0])),
    "RADIAL": (5, lambda p: _opencv([p[0], *p[:3], *p[3:], 0.0, 0.0])),
    "OPENCV": (8, _opencv),
    "FULL_OPENCV": (12, _opencv),
    "OPENCV_FISHEYE": (8, _fisheye),
    "SIMPLE_RADIAL_FISHEYE": (4, lambda p: _fisheye([p[0], *p])),
    "RADIAL_FISHEYE": (5, lambda p: _fisheye([p[0], *p])),
}
_FORMS: dict[str, Callable[[Mapping[str, Any], str], Camera]] = {
    "kind": _of_kind,
    "camera_model": _of_nerfstudio,
    "fl_x": _of_nerf,
    "camera_angle_x": _of_nerf,
    "distortion_model": _of_ros,
    "model": _of_colmap,
}
