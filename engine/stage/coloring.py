"""Colours meshes by a number of their vertices, faces or points, such as a temperature.

In: a `Numbers` value and meshes with their poses. Out: coloured twins of the meshes, and the
content of a colour bar. The colour map is a texture, so that numbers are interpolated across
triangles, not colours.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..base.linalg import inverse, normalize, transform_directions, transform_points
from ..choices import ValuesOn
from ..errors import InvalidArgumentError
from ..model.geometry.mesh import Mesh
from ..model.geometry.native_meshes import find_tangents_when_drawn
from ..model.geometry.splitting import split_mesh
from ..model.geometry.twins import twin_of
from ..model.geometry.values import OF_FACES, Values, checked_values, told_names
from ..model.materials.material import Material
from ..model.materials.textures import Texture
from ..model.scene.instances import InstancedMesh
from ..model.scene.scene import Scene
from ..model.scene.shown import placing_pose
from .overlays.colormaps import MISSING
from .overlays.numbers import DIRECT, MAGNITUDE, Marks, Numbers
from .painting import dress
from .visibility import DRAWABLE, mesh_of

if TYPE_CHECKING:
    from .viewed_scene import ViewedScene

_AXES = ("x", "y", "z")
_NORMALS = "normals"
# Texture coordinates beyond this lose precision.
_FARTHEST = 1e4


class ScalarBar(NamedTuple):
    """The data of the colour bar.

    Attributes
    ----------
    title : str
    low, high : float
        The numbers of the first and last colour.
    colors : (N, 3) uint8
    """

    title: str
    low: float
    high: float
    colors: NDArray[np.uint8]


class Coloring:
    """Colours some meshes, which share one range of numbers.

    Parameters
    ----------
    numbers : Numbers
    things : iterable of (Mesh, (4, 4) float64 or None)
        The meshes and their poses, which coordinates and normals refer to.
    up : str
        A key of `UP_DIRECTIONS`.
    unit : str
        The symbol of the coordinates' unit.

    Attributes
    ----------
    bar : ScalarBar or None
        None if the numbers are colours.

    Raises
    ------
    InvalidArgumentError
        No mesh has such numbers, or they lack the component.
    """

    bar: ScalarBar | None

    def __init__(
        self,
        numbers: Numbers,
        things: Iterable[tuple[Mesh, NDArray[Any] | None]],
        up: str = "+Y",
        unit: str = "",
    ) -> None:
        self._numbers = numbers
        self._poses = {id(mesh): (mesh, pose) for mesh, pose in things}
        meshes = [mesh for mesh, _ in self._poses.values()]
        self._given: Values | None = None
        self._name = self._find(meshes, up)
        arrays = [self._array(mesh)[0] for mesh in meshes]
        width = max((array.shape[1] for array in arrays), default=1)
        if numbers.component >= width:
            raise InvalidArgumentError(
                f"the values {self._name!r} have no component {numbers.component}: "
                f"the last is {width - 1}"
            )
        self.bar = None
        if numbers.component != DIRECT:
            low, high = numbers.clim or _range(map(self._chosen, arrays))
            title = self._title(width)
            title = f"{title} [{unit}]" if unit and self._name in _AXES else title
            self.bar = ScalarBar(title, low, high, numbers.colors)
            self._texture = _texture(numbers.colors)

    def colored(self, mesh: Mesh) -> Mesh:
        """Return a coloured twin of a mesh, whose faces are in the same order."""
        array, on = self._array(mesh)
        shown: NDArray[Any] = _colors_of(array) if self.bar is None else self._chosen(array)
        twin, rows = _on_vertices(mesh, shown, on)
        shown = shown if rows is None else np.concatenate([shown, _nothing(shown)])[rows]
        find_tangents_when_drawn(twin, None)
        if twin.tangents is not None:
            twin.tangents = None
        if self.bar is None:
            twin.colors = shown
            dress(twin, Material())
        else:
            self._show(twin, shown, self.bar)
        return twin

    def colored_thing(self, thing: Mesh | InstancedMesh) -> Mesh | InstancedMesh:
        """Return what to draw for a mesh or instances."""
        if isinstance(thing, InstancedMesh):
            return InstancedMesh(self.colored(thing.mesh), thing.poses, colors=thing.colors)
        return self.colored(thing)

    def _find(self, meshes: list[Mesh], up: str) -> str:
        """Return the name of the numbers to show."""
        color_by, on = self._numbers.color_by, self._numbers.on
        if color_by is not None and not isinstance(color_by, str):
            return self._take_array(meshes, color_by)
        known = sorted({name for mesh in meshes for name in _names_of(mesh, on)})
        own = (*_AXES, _NORMALS) if on in (None, "vertices") else ()
        if color_by is None and (known or own):
            usual = [name for mesh in meshes for name in _names_of(mesh, on or "vertices")]
            return min(usual) if usual else up[1:].lower()
        if color_by is None or not {color_by, f"_{color_by}"} & {*known, *own}:
            wanted = "values" if color_by is None else f"values {color_by!r}"
            wanted += "" if on is None else f" of {on}"
            whose = "this mesh" if len(meshes) == 1 else "this model"
            raise InvalidArgumentError(f"no {wanted}; {told_names((*known, *own), whose)}")
        return color_by

    def _take_array(self, meshes: list[Mesh], color_by: Any) -> str:
        """Keep an array of the only mesh, and return its name."""
        if len(meshes) != 1:
            raise InvalidArgumentError(
                f"an array colours one mesh, not {len(meshes)}: put numbers into each mesh's values"
            )
        name = getattr(color_by, "name", None)  # as Series of pandas have
        array, on = color_by if isinstance(color_by, Values) else (color_by, self._numbers.on)
        self._given = checked_values(meshes[0], array, "color_by", on)
        return name if isinstance(name, str) else ""

    def _array(self, mesh: Mesh) -> tuple[NDArray[Any], ValuesOn]:
        """Return the numbers of a mesh, (N, K), and what they belong to; NaN if it lacks them."""
        if self._given is not None:
            given = np.asarray(self._given.array)
            return _columns(given), self._given.on
        key = _key_of(mesh, self._name, self._numbers.on)
        if key is not None:
            array = mesh.values[key]
            return _columns(array), mesh.values.on(key)
        pose = self._poses.get(id(mesh), (mesh, None))[1]
        return _coordinates(mesh, self._name, pose), "vertices"

    def _chosen(self, array: NDArray[Any]) -> NDArray[np.float64]:
        """Return one number of each row, NaN where it has none."""
        rows, component = array.astype(np.float64), self._numbers.component
        if component >= rows.shape[1]:
            return np.full(len(rows), np.nan)
        if component >= 0:
            return rows[:, component]
        return rows[:, 0] if rows.shape[1] == 1 else np.sqrt((rows * rows).sum(axis=1))

    def _title(self, width: int) -> str:
        name, component = self._name, self._numbers.component
        if width == 1 or not name:
            return name
        return f"|{name}|" if component == MAGNITUDE else f"{name}[{component}]"

    def _show(self, mesh: Mesh, values: NDArray[np.float64], bar: ScalarBar) -> None:
        """Colour a mesh by a number of each vertex."""
        count, is_number = len(bar.colors), np.isfinite(values)
        shares = (np.where(is_number, values, bar.low) - bar.low) / (bar.high - bar.low)
        if len(mesh.faces):
            # The texture clamps out-of-range numbers per pixel: clamping per vertex would falsify
            # the interpolation.
            across = (0.5 + np.clip(shares, -_FARTHEST, _FARTHEST) * (count - 1)) / count
            mesh.colors = None
            mesh.uvs = np.stack([across, np.where(is_number, 0.25, 0.75)], axis=1)
            dress(mesh, Material(texture=self._texture))
            return
        numbers = np.rint(np.clip(shares, 0.0, 1.0) * (count - 1)).astype(np.int64)
        chosen = bar.colors[numbers]
        mesh.colors = np.where(is_number[:, np.newaxis], chosen, np.uint8(MISSING[0]))
        dress(mesh, Material())


def _columns(array: NDArray[Any]) -> NDArray[Any]:
    """Return numbers as rows, (N, K), also if there are none."""
    return array.reshape(len(array), array[0].size if len(array) else 1)


def coloring_of(scene: Scene, numbers: Numbers, up: str = "+Y", unit: str = "") -> Coloring:
    """Return how a scene's meshes show numbers."""
    scene.data.update()
    shown = [node for node in scene.nodes if node.shown and isinstance(node.object, DRAWABLE)]
    things = [(mesh_of(node.object), placing_pose(node)) for node in shown]
    return Coloring(numbers, things, up, unit)


def show_numbers(viewed: ViewedScene, marks: Marks) -> None:
    """Show numbers of a viewed scene as colours, if there are some to show."""
    if marks.numbers is None:
        return
    viewed.coloring = coloring_of(viewed.scene, marks.numbers, viewed.up, viewed.unit)
    viewed.bar = viewed.coloring.bar
    # Tone mapping would change the colours shown in the bar.
    viewed.appearance = {**viewed.appearance, "tone_mapping": "none"}


def _names_of(mesh: Mesh, on: ValuesOn | None) -> list[str]:
    """Return the names of numbers of a mesh."""
    names = [name for name in mesh.values if on in (None, mesh.values.on(name))]
    return [name.removesuffix(OF_FACES) if on == "faces" else name for name in names]


def _key_of(mesh: Mesh, name: str, on: ValuesOn | None) -> str | None:
    """Return the key of a mesh's numbers, or None; names in glTF files begin with ``_``."""
    for key in (name, name + OF_FACES, f"_{name}"):
        if key in mesh.values and on in (None, mesh.values.on(key)):
            return key
    return None


def _coordinates(mesh: Mesh, name: str, pose: NDArray[Any] | None) -> NDArray[Any]:
    """Return a coordinate or the normals of a mesh's vertices, (V, K); NaN for another name."""
    pose = None if pose is None or np.array_equal(pose, np.eye(4)) else pose
    if name == _NORMALS:
        normals = mesh.normals.astype(np.float64)
        if pose is None:
            return normals
        return normalize(transform_directions(inverse(pose).T, normals))
    if name not in _AXES:
        return np.full((len(mesh.positions), 1), np.nan)
    positions = mesh.positions.astype(np.float64)
    if pose is not None:
        positions = transform_points(pose, positions)
    return positions[:, [_AXES.index(name)]]


def _on_vertices(mesh: Mesh, shown: NDArray[Any], on: ValuesOn) -> tuple[Mesh, NDArray[Any] | None]:
    """Return a twin of a mesh with a vertex for each different number of its elements.

    Parameters
    ----------
    mesh : Mesh
    shown : (N,) or (N, K) number
        What each element shows.
    on : {"vertices", "faces", "points"}

    Returns
    -------
    twin : Mesh
    rows : (V,) int or None
        The row of ``shown`` for each vertex, -1 for none. With None, it has a row for each vertex.
    """
    if on == "vertices":
        return twin_of(mesh, mesh.materials, mesh.name), None
    count, rows = len(mesh.positions), np.arange(len(mesh.points))
    if on == "points":
        vertices: NDArray[Any] = mesh.points
        faces: NDArray[Any] = mesh.faces
        points: NDArray[Any] = count + rows
    else:
        kinds = np.unique(shown, axis=0, return_inverse=True)[1].reshape(-1)
        keys = mesh.faces.astype(np.int64) * (len(shown) + 1) + kinds[:, np.newaxis]
        _, corners, numbers = np.unique(keys.ravel(), return_index=True, return_inverse=True)
        vertices, rows = mesh.faces.ravel()[corners], corners // 3
        faces, points = count + numbers.reshape(-1, 3), mesh.points
    twin = split_mesh(mesh, faces, np.concatenate([np.arange(count), vertices]))
    twin.points = points
    return twin, np.concatenate([np.full(count, -1), rows])


def _nothing(shown: NDArray[Any]) -> NDArray[Any]:
    """Return a row for vertices that show no number: NaN, or black."""
    return np.full((1, *shown.shape[1:]), np.nan if shown.dtype.kind == "f" else 0, shown.dtype)


def _colors_of(array: NDArray[Any]) -> NDArray[np.uint8]:
    """Return numbers that are colours as (N, 3): 0 to 255 if integers, else 0 to 1."""
    scale = 1.0 if array.dtype.kind in "iu" else 255.0
    numbers = np.clip(np.nan_to_num(array.astype(np.float64)) * scale, 0.0, 255.0)
    channels = [0, 0, 0] if array.shape[1] < 3 else [0, 1, 2]
    return np.rint(numbers[:, channels]).astype(np.uint8)


def _texture(colors: NDArray[np.uint8]) -> Texture:
    """Return a colour map as a texture: its lower row; the upper has the missing colour."""
    pixels = np.empty((2, len(colors), 3), np.uint8)
    pixels[0], pixels[1] = MISSING, colors
    return Texture(pixels, filter="bilinear", wrap="clamp", name="colour map")


def _range(arrays: Iterable[NDArray[np.float64]]) -> tuple[float, float]:
    """Return the lowest and highest number, made distinct."""
    finite = [array[np.isfinite(array)] for array in arrays]
    finite = [array for array in finite if len(array)]
    if not finite:
        return 0.0, 1.0
    low = min(float(array.min()) for array in finite)
    high = max(float(array.max()) for array in finite)
    if low < high:
        return low, high
    # A constant array: put its value in the middle of the bar, in a range wide enough to be
    # written.
    around = abs(low) / 2 or 0.5
    return low - around, low + around
