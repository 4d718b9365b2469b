"""The lights and geometries of an offscreen scene: Open3D's low-level ``Scene``."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ....base import linalg
from ....base.numbers import floats
from ....errors import InvalidArgumentError, warn
from .._loading import load
from ._ktx import environment_of_ktx
from ._things import Thing, thing_of
from .view import View

_own = load().visualization.rendering.Scene


@dataclass(frozen=True)
class Lamp:
    """A light: ``intensity`` in lux of a direction, in lumen of a place, as Filament has them."""

    kind: str
    color: tuple[float, ...]
    intensity: float
    position: tuple[float, ...] = (0.0, 0.0, 0.0)
    direction: tuple[float, ...] = (0.0, 0.0, -1.0)
    falloff: float = 1.0
    cone: tuple[float, float] = (0.0, 0.0)
    casts_shadows: bool = False


class Scene:
    """Geometries by name, and lights; ``Open3DScene.scene`` is one."""

    GroundPlane = _own.GroundPlane
    XZ, XY, YZ = _own.GroundPlane.XZ, _own.GroundPlane.XY, _own.GroundPlane.YZ
    UPDATE_POINTS_FLAG = _own.UPDATE_POINTS_FLAG
    UPDATE_NORMALS_FLAG = _own.UPDATE_NORMALS_FLAG
    UPDATE_COLORS_FLAG = _own.UPDATE_COLORS_FLAG
    UPDATE_UV0_FLAG = _own.UPDATE_UV0_FLAG

    def __init__(self, view: View, resources: str) -> None:
        self._view, self._resources = view, resources
        self.things: dict[str, Thing] = {}
        self._models: dict[str, list[str]] = {}
        self.lamps: dict[str, Lamp] = {}
        self.sun = Lamp("sun", (1.0, 1.0, 1.0), 10000.0, direction=(0.0, 0.0, 1.0))
        self.has_sun = self.has_indirect_light = True
        self.environment_path: str | None = None
        self.skybox_path: str | None = None
        self.shows_skybox = False
        self.indirect_intensity = 30000.0

    # ---- geometries ----

    def add_geometry(
        self, name: str, geometry, material, downsampled_name="", downsample_threshold=0
    ) -> bool:
        """Add a copy of a geometry in a material; return whether it is drawn."""
        if name in self.things or name in self._models:
            warn(f"geometry {name!r} has been added already")
            return False
        thing = thing_of(geometry, material, self._planes())
        if thing is None:
            if not geometry.is_empty():
                warn(f"a {type(geometry).__name__} is not drawn")
            return False
        self.things[name] = thing
        return True

    def add_model(self, name: str, model) -> bool:
        """Add the meshes of a ``TriangleMeshModel``."""
        if name in self.things or name in self._models:
            warn(f"model {name!r} has been added already")
            return False
        parts: list[str] = []
        for part in model.meshes:
            own = f"{name}:{part.mesh_name}"
            own = own if own not in parts else f"{own}_{len(parts)}"
            if self.add_geometry(own, part.mesh, model.materials[part.material_idx]):
                parts.append(own)
        self._models[name] = parts
        return True

    def has_geometry(self, name: str) -> bool:
        """Return whether a geometry or a model has this name."""
        return name in self.things or name in self._models

    def remove_geometry(self, name: str) -> None:
        """Remove a geometry or a model, if it is there."""
        for one in self._models.pop(name, [name]):
            self.things.pop(one, None)

    def things_of(self, name: str) -> list[Thing]:
        """Return the things of a geometry or a model; a warning says that there is none."""
        found = [self.things[one] for one in self._models.get(name, [name]) if one in self.things]
        if not found:
            warn(f"there is no geometry {name!r}")
        return found

    def update_geometry(self, name: str, point_cloud, update_flag: int) -> None:
        """Take arrays of an ``open3d.t.geometry.PointCloud`` with as many points."""
        for thing in self.things_of(name):
            arrays = thing.arrays
            count = len(point_cloud.point.positions)
            if count > len(arrays.positions):
                warn(f"geometry {name!r} has fewer points: add it anew")
                return
            cloud = point_cloud.to_legacy()
            taken: dict[str, Any] = {}
            if update_flag & self.UPDATE_POINTS_FLAG:
                taken["positions"] = np.array(cloud.points)
            if update_flag & self.UPDATE_COLORS_FLAG and cloud.has_colors():
                taken["colors"] = np.array(cloud.colors)
            if update_flag & self.UPDATE_NORMALS_FLAG and cloud.has_normals():
                taken["normals"] = np.array(cloud.normals)
            kept = {
                key: None if value is None else value[:count]
                for key, value in (("colors", arrays.colors), ("normals", arrays.normals))
            }
            kept |= {"positions": arrays.positions[:count], "elements": np.arange(count)}
            thing.arrays = replace(arrays, **{**kept, **taken})
            thing.dress(thing.record, thing.planes)

    def show_geometry(self, name: str, show: bool) -> None:
        """Show or hide a geometry."""
        for thing in self.things_of(name):
            thing.is_visible = bool(show)

    def geometry_is_visible(self, name: str) -> bool:
        """Return whether a geometry is shown."""
        found = self.things_of(name)
        return bool(found) and found[0].is_visible

    def geometry_shadows(self, name: str, cast_shadows: bool, receive_shadows: bool) -> None:
        """Set whether a geometry casts and receives shadows."""
        for thing in self.things_of(name):
            thing.casts_shadows = bool(cast_shadows)
            thing.receives_shadows = bool(receive_shadows)

    def set_geometry_culling(self, name: str, enable: bool) -> None:
        """Do nothing: culling does not change pictures here."""

    def set_geometry_priority(self, name: str, priority: int) -> None:
        """Draw a geometry in this order among those of equal depth: not supported."""
        warn("priorities of geometries are not drawn")

    def dress(self, name: str, material) -> None:
        """Give a geometry another material."""
        for thing in self.things_of(name):
            thing.dress(material, self._planes())

    def _planes(self) -> tuple[float, float]:
        camera = self._view.get_camera()
        return camera.get_near(), camera.get_far()

    def place(self, name: str, transform: ArrayLike) -> None:
        """Set the pose of a geometry."""
        matrix = np.asarray(transform, np.float64)
        if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
            raise InvalidArgumentError(f"a transform must be (4, 4) and finite, not {matrix.shape}")
        for thing in self.things_of(name):
            thing.pose = matrix.astype(np.float32).astype(np.float64)

    def box_of(self, name: str):
        """Return the box of a geometry in the world."""
        whole = load().geometry.AxisAlignedBoundingBox()
        for thing in self.things_of(name):
            corners = linalg.transform_points(thing.pose, np.asarray(thing.box.get_box_points()))
            whole += type(whole)(corners.min(axis=0), corners.max(axis=0))
        return whole

    # ---- light ----

    def enable_indirect_light(self, enable: bool) -> None:
        """Light the scene from its environment, or not."""
        self.has_indirect_light = bool(enable)

    def set_indirect_light(self, name: str) -> bool:
        """Take an environment: the path of a file ``name_ibl.ktx`` without its ending."""
        base = str(name)
        if not Path(f"{base}_ibl.ktx").exists():
            base = str(Path(self._resources) / Path(base).name)
        environment_of_ktx(f"{base}_ibl.ktx")
        self.environment_path, self.skybox_path = f"{base}_ibl.ktx", f"{base}_skybox.ktx"
        return True

    def set_indirect_light_intensity(self, intensity: float) -> None:
        """Set the brightness of the environment, in lux."""
        self.indirect_intensity = float(intensity)

    def enable_sun_light(self, enable: bool) -> None:
        """Let the sun shine, or not."""
        self.has_sun = bool(enable)

    def set_sun_light(self, direction: ArrayLike, color: ArrayLike, intensity: float) -> None:
        """Set the sun: the direction in which its light goes, its colour, lux."""
        self.sun = Lamp("sun", _three(color), float(intensity), direction=_three(direction))

    def add_directional_light(self, name, color, direction, intensity, cast_shadows) -> bool:
        """Add light from one direction, in lux."""
        lamp = Lamp("directional", _three(color), float(intensity), direction=_three(direction))
        return self._add(name, replace(lamp, casts_shadows=bool(cast_shadows)))

    def add_point_light(self, name, color, position, intensity, falloff, cast_shadows) -> bool:
        """Add light from a point, in lumen; ``falloff`` is where it ends."""
        lamp = Lamp("point", _three(color), float(intensity), _three(position))
        return self._add(name, replace(lamp, falloff=float(falloff), casts_shadows=cast_shadows))

    def add_spot_light(
        self,
        name,
        color,
        position,
        direction,
        intensity,
        falloff,
        inner_cone_angle,
        outer_cone_angle,
        cast_shadows,
    ) -> bool:
        """Add a cone of light, in lumen; angles in radians from its axis."""
        lamp = Lamp("spot", _three(color), float(intensity), _three(position), _three(direction))
        cone = float(inner_cone_angle), float(outer_cone_angle)
        return self._add(
            name,
            replace(lamp, falloff=float(falloff), cone=cone, casts_shadows=bool(cast_shadows)),
        )

    def _add(self, name: str, lamp: Lamp) -> bool:
        if name in self.lamps:
            warn(f"light {name!r} has been added already")
            return False
        self.lamps[name] = lamp
        return True

    def remove_light(self, name: str) -> None:
        """Remove a light."""
        if self.lamps.pop(name, None) is None:
            warn(f"there is no light {name!r}")

    def _change(self, name: str, **values: Any) -> None:
        if name not in self.lamps:
            warn(f"there is no light {name!r}")
            return
        self.lamps[name] = replace(self.lamps[name], **values)

    def update_light_color(self, name: str, color: ArrayLike) -> None:
        """Change a light's colour."""
        self._change(name, color=_three(color))

    def update_light_position(self, name: str, position: ArrayLike) -> None:
        """Change where a light is."""
        self._change(name, position=_three(position))

    def update_light_direction(self, name: str, direction: ArrayLike) -> None:
        """Change where a light shines to."""
        self._change(name, direction=_three(direction))

    def update_light_intensity(self, name: str, intensity: float) -> None:
        """Change how bright a light is."""
        self._change(name, intensity=float(intensity))

    def update_light_falloff(self, name: str, falloff: float) -> None:
        """Change where a light ends."""
        self._change(name, falloff=float(falloff))

    def update_light_cone_angles(self, name: str, inner_cone_angle, outer_cone_angle) -> None:
        """Do nothing, as Open3D does."""

    def enable_light_shadow(self, name: str, can_cast_shadows: bool) -> None:
        """Let a light cast shadows, or not."""
        self._change(name, casts_shadows=bool(can_cast_shadows))

    # ---- cameras by name, which Open3D takes and ignores ----

    def add_camera(self, name: str, camera: object) -> None:
        """Do nothing, as Open3D does."""

    def remove_camera(self, name: str) -> None:
        """Do nothing, as Open3D does."""

    def set_active_camera(self, name: str) -> None:
        """Do nothing, as Open3D does."""


def _three(value: ArrayLike) -> tuple[float, ...]:
    vector = floats(value, "three finite numbers").reshape(-1)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise InvalidArgumentError(f"three finite numbers are needed, not {value!r}")
    return tuple(vector.tolist())
