"""What the rays of a lens may meet: the nodes of a scene whose faces show exactly as they are.

In: a scene as it is drawn. Out: its nodes as `NativeLens.find` takes them. What is drawn otherwise
(levels of detail, parts of a staged scene, what lies beside it) is left to the pinhole pictures.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..._native.scene_graph import SHOWN, NativeGraph, NativeShapes
from ...model.materials.material import Material
from ...model.scene.scene_data import SceneData
from ...model.scene.staged_data import StagedData
from ...model.scene.staged_scene import AnyScene
from ...model.spatial.rays import known_shapes


class LensScene(NamedTuple):
    """The nodes that rays may meet.

    Attributes
    ----------
    graph, shapes
        As the core has them.
    ids, slots : (N,) int32
        IDs in rising order, and the slots of their nodes.
    solid : (slots,) uint8
        1 for nodes of whose faces every part shows.
    """

    graph: NativeGraph
    shapes: NativeShapes
    ids: NDArray[np.int32]
    slots: NDArray[np.int32]
    solid: NDArray[np.uint8]


def lens_scene(scene: AnyScene, is_nearest: bool) -> LensScene:
    """Return the nodes that rays may meet, up to date.

    Parameters
    ----------
    scene : Scene or StagedScene
    is_nearest : bool
        Whether pictures show the nearest face; otherwise rays meet nothing.
    """
    staged = scene.data if isinstance(scene.data, StagedData) else None
    data: SceneData = scene.data if staged is None else staged.own  # type: ignore[assignment]
    shapes = known_shapes(data)
    arrays, table = data.arrays, data.objects
    count = arrays.count
    column = {name: arrays.columns[name][:count] for name in ("id", "object_id", "flags", "object")}
    drawn = (column["object"] >= 0) & ((column["flags"] & SHOWN) != 0)
    own = drawn & (column["object_id"] == column["id"])
    if staged is not None:
        own[data.slots_of(staged.hidden)] = False
    if not is_nearest or (staged is not None and staged.part_of is not None):
        own[:] = False
    solid = np.array([_is_solid(obj) for obj in table.objects] + [False])
    flags = np.append(own & solid[column["object"]], False).astype(np.uint8)
    slots = np.flatnonzero(own).astype(np.int32)
    return LensScene(arrays, shapes, column["id"][slots], slots, flags)


def lets_light_pass(scene: AnyScene) -> bool:
    """Return whether some material of a scene transmits light."""
    data = scene.data.own if isinstance(scene.data, StagedData) else scene.data
    objects = data.objects.objects
    return any(one.is_physical and one.transmission for obj in objects for one in _materials(obj))


def _is_solid(obj: Any) -> bool:
    """Return whether all of an object's faces show, and nothing through them."""
    return all(one.alpha_mode == "opaque" and not one.transmission for one in _materials(obj))


def _materials(obj: Any) -> Iterable[Material]:
    return getattr(getattr(obj, "mesh", obj), "materials", ())
