"""Makes scenes of meshes, nodes and trimesh objects, for `render` and `show`.

In: one of these. Out: a `Scene` whose nodes share the given meshes.
"""

from __future__ import annotations

from typing import Any

from ..io.scenes.trimesh_scenes import is_of_trimesh, scene_from_trimesh
from ..model.geometry.mesh import Mesh
from ..model.scene.instances import InstancedMesh
from ..model.scene.nodes import Node
from ..model.scene.scene import Scene
from ..model.scene.shown import placing_pose, shown_object


def scene_of(thing: Any) -> Scene | None:
    """Return a scene that shows a thing; None if the thing cannot be shown.

    Parameters
    ----------
    thing : Scene, Node, Mesh, InstancedMesh, or a scene or geometry of trimesh
        A scene is returned unchanged. For a node, the new scene holds its visible subtree at its
        world poses, in its current deformation.
    """
    if isinstance(thing, Scene):
        return thing
    if is_of_trimesh(thing):
        return scene_from_trimesh(thing)
    scene = Scene()
    if isinstance(thing, Mesh | InstancedMesh):
        scene.add(thing, name=getattr(thing, "name", "") or "mesh")
    elif isinstance(thing, Node):
        if thing.scene is not None:
            thing.scene.data.update()
        _add_branch(scene, thing)
    else:
        return None
    return scene


def _add_branch(scene: Scene, top: Node) -> None:
    """Add the objects of a node's subtree at their world poses."""
    waiting = [top]
    while waiting:  # iterative, because trees may be deep
        node = waiting.pop()
        if node.visible:
            scene.add(shown_object(node), name=node.name, pose=placing_pose(node))
            waiting += reversed(node.children)
