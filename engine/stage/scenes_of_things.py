"""Makes scenes of meshes, nodes, points and objects of other libraries, for `render` and `show`.

In: one of these. Out: a `Scene` whose nodes share the given meshes.
"""

from __future__ import annotations

from typing import Any

from ..errors import warn
from ..io.scenes.other_libraries import has_points, scene_of_library
from ..model.geometry.mesh import Mesh
from ..model.scene.instances import InstancedMesh
from ..model.scene.nodes import Node
from ..model.scene.scene import Scene
from ..model.scene.shown import placing_pose, shown_object
from .meshes_of_arrays import mesh_of_arrays

#: The ambient light of new scenes, and of scenes from files.
_USUAL_AMBIENT = ((0.1, 0.1, 0.1), (0.0, 0.0, 0.0))


def scene_of(thing: Any) -> Scene | None:
    """Return a scene that shows a thing; None if the thing cannot be shown.

    Parameters
    ----------
    thing : Scene, Node, Mesh, InstancedMesh, array, or another library's object
        Libraries are trimesh, PyVista, meshio and Open3D; a list of their objects is taken, too. A
        scene is returned unchanged. Arrays are what `mesh_of_arrays` takes. For a node, the new
        scene holds its visible subtree at its world poses, in its current deformation.
    """
    if isinstance(thing, Scene):
        return thing
    if (made := scene_of_library(thing)) is not None:
        if not has_points(made):
            warn(f"this {type(thing).__name__} has no points: nothing shows")
        return made
    scene = Scene()
    if (mesh := mesh_of_arrays(thing)) is not None:
        thing = mesh
    if isinstance(thing, Mesh | InstancedMesh):
        scene.add(thing, name=getattr(thing, "name", "") or "mesh")
    elif isinstance(thing, Node):
        if thing.scene is not None:
            thing.scene.data.update()
        _add_branch(scene, thing)
    else:
        return None
    return scene


def is_lit(scene: Scene) -> bool:
    """Return whether a scene has light of its own, so that it wears no look.

    That is a light, visible or not, an environment, or another ambient light than that of new
    scenes and of models in files.
    """
    if scene.environment is not None or tuple(scene.ambient) not in _USUAL_AMBIENT:
        return True
    return bool(scene.data.placed_lights())


def _add_branch(scene: Scene, top: Node) -> None:
    """Add the objects of a node's subtree at their world poses."""
    waiting = [top]
    while waiting:  # iterative, because trees may be deep
        node = waiting.pop()
        if node.visible:
            scene.add(shown_object(node), name=node.name, pose=placing_pose(node))
            waiting += reversed(node.children)
