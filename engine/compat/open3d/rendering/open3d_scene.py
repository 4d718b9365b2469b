"""The scene of an offscreen renderer: Open3D's ``Open3DScene``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....base.numbers import floats
from ....errors import InvalidArgumentError, warn
from ....io.scenes.open3d_materials import bytes_of_image
from .._loading import load
from ._axes import AXES, axes_mesh
from .low_level_scene import Scene
from .view import View
from .view_camera import Camera

_own = load().visualization.rendering.Open3DScene
#: Lux of the environment and of the sun by name of a lighting profile.
_PROFILES: dict[str, tuple[float | None, float | None]] = {
    "HARD_SHADOWS": (None, 100000.0),
    "DARK_SHADOWS": (10000.0, 85000.0),
    "MED_SHADOWS": (20000.0, 80000.0),
    "SOFT_SHADOWS": (37500.0, 75000.0),
    "NO_SHADOWS": (37500.0, None),
}


class Open3DScene:
    """Geometries with materials, a camera, light and a background.

    Parameters
    ----------
    renderer : object, optional
        Open3D's renderer of a window: taken and ignored.
    resource_path : str
        Where environments are; by default those of the package open3d.
    """

    LightingProfile = _own.LightingProfile
    HARD_SHADOWS = _own.LightingProfile.HARD_SHADOWS
    DARK_SHADOWS = _own.LightingProfile.DARK_SHADOWS
    MED_SHADOWS = _own.LightingProfile.MED_SHADOWS
    SOFT_SHADOWS = _own.LightingProfile.SOFT_SHADOWS
    NO_SHADOWS = _own.LightingProfile.NO_SHADOWS

    def __init__(self, renderer: object = None, resource_path: str = "") -> None:
        resources = resource_path or str(Path(load().__file__).parent / "resources")
        self._view = View()
        self._scene = Scene(self._view, resources)
        self._resources = resources
        self._names: list[str] = []
        self._bounds = load().geometry.AxisAlignedBoundingBox()
        self.background_image: NDArray[np.uint8] | None = None
        self.downsample_threshold = 6000000
        self.set_background((1.0, 1.0, 1.0, 1.0))
        self.set_lighting(self.MED_SHADOWS, (0.577, -0.577, -0.577))

    # ---- parts ----

    @property
    def scene(self) -> Scene:
        """The low-level scene, with its lights."""
        return self._scene

    @property
    def camera(self) -> Camera:
        """The camera."""
        return self._view.get_camera()

    @property
    def view(self) -> View:
        """How it is drawn."""
        return self._view

    @property
    def bounding_box(self):
        """The box of all that was added since the last `clear_geometry`."""
        return self._bounds

    @property
    def background_color(self) -> NDArray[np.float32]:
        """The colour of the background, (4,)."""
        return self._background

    # ---- geometries ----

    def add_geometry(
        self, name: str, geometry, material, add_downsampled_copy_for_fast_rendering: bool = True
    ) -> None:
        """Add a copy of a geometry in a material.

        Parameters
        ----------
        name : str
        geometry : open3d.geometry.Geometry3D, open3d.t.geometry.Geometry
        material : MaterialRecord
        add_downsampled_copy_for_fast_rendering : bool
            Taken and ignored.
        """
        if self._scene.add_geometry(name, geometry, material):
            self._names.append(name)
            self._bounds += self._scene.box_of(name)

    def add_model(self, name: str, model) -> None:
        """Add a ``TriangleMeshModel``."""
        if self._scene.add_model(name, model):
            self._names.append(name)
            self._bounds += self._scene.box_of(name)

    def has_geometry(self, name: str) -> bool:
        """Return whether a geometry has this name."""
        return self._scene.has_geometry(name)

    def remove_geometry(self, name: str) -> None:
        """Remove a geometry, if it is there; the box stays."""
        if name in self._names:
            self._names.remove(name)
            self._scene.remove_geometry(name)

    def clear_geometry(self) -> None:
        """Remove all geometries."""
        for name in self._names:
            self._scene.remove_geometry(name)
        self._names.clear()
        self._bounds = load().geometry.AxisAlignedBoundingBox()

    def show_geometry(self, name: str, show: bool) -> None:
        """Show or hide a geometry."""
        self._scene.show_geometry(name, show)

    def geometry_is_visible(self, name: str) -> bool:
        """Return whether a geometry is shown."""
        return self._scene.geometry_is_visible(name)

    def set_geometry_transform(self, name: str, transform: ArrayLike) -> None:
        """Set the pose of a geometry, (4, 4)."""
        self._scene.place(name, transform)

    def get_geometry_transform(self, name: str) -> NDArray[np.float64]:
        """Return the pose of a geometry, (4, 4)."""
        found = self._scene.things_of(name)
        return found[0].pose.copy() if found else np.eye(4)

    def modify_geometry_material(self, name: str, material) -> None:
        """Give a geometry another material."""
        self._scene.dress(name, material)

    def update_material(self, material) -> None:
        """Give all geometries a material."""
        for name in self._names:
            self._scene.dress(name, material)

    # ---- surroundings ----

    def set_background(self, color: ArrayLike, image: Any = None) -> None:
        """Set the background: a display colour, (4,), and an image in the middle."""
        given = floats(color, "a background").astype(np.float32).reshape(-1)
        if given.shape != (4,) or not np.isfinite(given).all():
            raise InvalidArgumentError(f"a background is four finite numbers, not {color!r}")
        self._background = given
        is_given = image is not None and not image.is_empty()
        self.background_image = bytes_of_image(image) if is_given else None

    def set_background_color(self, color: ArrayLike) -> None:
        """Set the colour of the background; Open3D prefers `set_background`."""
        self.set_background(color)

    def set_lighting(self, profile, sun_dir: ArrayLike) -> None:
        """Set environment and sun to one of Open3D's profiles."""
        indirect, sun = _PROFILES[profile.name]
        scene = self._scene
        if indirect is not None and scene.environment_path is None:
            scene.set_indirect_light(str(Path(self._resources) / "default"))
        scene.enable_indirect_light(indirect is not None)
        scene.enable_sun_light(sun is not None)
        if indirect is not None:
            scene.set_indirect_light_intensity(indirect)
        if sun is not None:
            scene.set_sun_light(sun_dir, (1.0, 1.0, 1.0), sun)

    def show_skybox(self, enable: bool) -> None:
        """Show the environment behind, instead of the background, or not."""
        self._scene.shows_skybox = bool(enable)

    def show_axes(self, enable: bool) -> None:
        """Show the axes x, y and z in red, green and blue, or not."""
        self._scene.remove_geometry(AXES)
        if enable:
            record = load().visualization.rendering.MaterialRecord()
            self._scene.add_geometry(AXES, axes_mesh(self._bounds), record)
            self._scene.geometry_shadows(AXES, False, False)

    def show_ground_plane(self, enable: bool, plane: object) -> None:
        """Show a grid on a plane: not drawn, and a warning says so."""
        if enable:
            warn("the ground plane of an Open3DScene is not drawn")

    def set_view_size(self, width: int, height: int) -> None:
        """Do nothing: pictures have the renderer's size, as in Open3D."""
