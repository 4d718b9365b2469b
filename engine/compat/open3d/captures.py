"""What a `Visualizer` gives out of its pictures: arrays and files."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np

from ...base import linalg
from ...errors import FileAccessError, InvalidArgumentError
from ._loading import load

_DEPTH_MOST = 32767.0  # of 16-bit depth pictures, as in Open3D


class Captures:
    """The methods ``capture_…``; a `Visualizer` has the shots that they draw."""

    def capture_screen_float_buffer(self, do_render: bool = False):
        """Return the picture as ``open3d.geometry.Image``: (H, W, 3) float32 from 0 to 1.

        Parameters
        ----------
        do_render : bool
            Draw what is there now; otherwise it is what `poll_events` last drew.
        """
        return _image(self._colors(do_render).astype(np.float32) / np.float32(255.0))

    def capture_screen_image(self, filename, do_render: bool = False) -> None:
        """Write the picture into a file, .png or .jpg; without a name, into one of Open3D's."""
        path, camera = _names(filename, "ScreenCapture", "ScreenCamera", "png")
        _write(path, _image(self._colors(do_render)))
        self._write_camera(camera)

    def capture_depth_float_buffer(self, do_render: bool = False):
        """Return depths as ``open3d.geometry.Image``: (H, W) float32, world units, 0 is nothing."""
        return _image(self._depths(do_render)[0])

    def capture_depth_image(
        self, filename, do_render: bool = False, depth_scale: float = 1000.0
    ) -> None:
        """Write depths times ``depth_scale`` into a picture of 16 bits, up to 32767."""
        path, camera = _names(filename, "DepthCapture", "DepthCamera", "png")
        depth = self._depths(do_render)[0].astype(np.float64)
        scaled = np.floor(np.clip(depth * float(depth_scale), 0.0, _DEPTH_MOST) + 0.5)
        _write(path, _image(scaled.astype(np.uint16)))
        self._write_camera(camera)

    def capture_depth_point_cloud(
        self, filename, do_render: bool = False, convert_to_world_coordinate: bool = False
    ) -> None:
        """Write a point for each pixel that shows something, in view or world space."""
        path, camera = _names(filename, "DepthCapture", "DepthCamera", "ply")
        _, ndc_depth = self._depths(do_render)
        shot = self._ordered
        points = _unprojected(ndc_depth, shot.projection)
        if convert_to_world_coordinate:
            points = linalg.transform_points(linalg.inverse(shot.view), points)
        o3d = load()
        cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
        _require_written(o3d.io.write_point_cloud(path, cloud), path)
        self._write_camera(camera)

    def _write_camera(self, path: str | None) -> None:
        if path is not None:
            parameters = self._begun().convert_to_pinhole_camera_parameters()
            load().io.write_pinhole_camera_parameters(path, parameters)


def _unprojected(ndc_depth, projection) -> np.ndarray:
    """Return the places of pixels in view space, (N, 3), row after row from below."""
    depth = ndc_depth[::-1]
    height, width = depth.shape
    rows, columns = np.nonzero(np.isfinite(depth))
    clip = np.stack(
        [
            (columns + 0.5) / width * 2.0 - 1.0,
            (rows + 0.5) / height * 2.0 - 1.0,
            depth[rows, columns].astype(np.float64),
        ],
        axis=1,
    )
    return linalg.transform_points(linalg.inverse(projection), clip)


def _names(filename, picture: str, camera: str, suffix: str) -> tuple[str, str | None]:
    """Return the name of a file, and if Open3D chooses it, that of a file for the camera."""
    if str(filename):
        return str(filename), None
    stamp = time.strftime("%Y-%m-%d-%H-%M-%S")
    return f"{picture}_{stamp}.{suffix}", f"{camera}_{stamp}.json"


def _image(array: np.ndarray):
    return load().geometry.Image(np.ascontiguousarray(array))


def _write(path: str, image) -> None:
    suffix = Path(path).suffix.lower()
    if suffix not in (".png", ".jpg", ".jpeg"):
        raise InvalidArgumentError(f"pictures are .png or .jpg files, not {path!r}")
    _require_written(load().io.write_image(path, image), path)


def _require_written(was_written: bool, path: str) -> None:
    if not was_written:
        raise FileAccessError("cannot be written", path)
