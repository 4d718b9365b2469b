"""Scenes: trees of nodes, a background and ambient light."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from ...base.box_corners import box_corners
from ._bounded import Bounded
from ._held import Named
from .camera import Camera
from .light import DirectionalLight, Light, PointLight, SpotLight
from .mesh import Mesh
from .node import Node
from .utils import format_color_vector


def _entries(node: Node) -> list:
    """Return the objects of a node."""
    return [obj for obj in (node.mesh, node.camera, node.light) if obj is not None]


def _of_kind(kind: type, what: str) -> tuple[property, property]:
    """Return properties for lights of one kind, and for their nodes."""
    return (
        property(lambda self: {node.light for node in self._light_nodes[kind]}, doc=f"All {what}."),
        property(lambda self: self._light_nodes[kind], doc=f"The nodes that hold {what}."),
    )


class Scene(Bounded, Named):
    """A tree of nodes.

    Parameters
    ----------
    nodes : list or set of Node, optional
        Each with all of its children.
    bg_color : sequence of 3 or 4 numbers, optional
        By default white; whole numbers are of 0 to 255.
    ambient_light : float or sequence of 3 numbers, optional
        By default none.
    name : str, optional
    """

    def __init__(self, nodes=None, bg_color=None, ambient_light=None, name=None):
        self.bg_color = bg_color
        self.ambient_light = ambient_light
        self.name = name
        self._numbers = itertools.count()
        self.clear()
        parents: dict = dict.fromkeys(nodes or ())
        for node in list(parents):
            for child in node.children:
                if parents.get(child) is not None:
                    raise ValueError("Nodes may not have more than one parent")
                parents[child] = node
        for node, parent in parents.items():
            if parent is None:
                self.add_node(node)

    def clear(self) -> None:
        """Remove all nodes."""
        self._nodes: set[Node] = set()
        self._order: dict[Node, int] = {}  # the order of adding: sets have none
        self._parents: dict[Node, Node | None] = {}
        self._mesh_nodes: set[Node] = set()
        self._camera_nodes: set[Node] = set()
        self._light_nodes: dict[type, set[Node]] = {
            kind: set() for kind in (DirectionalLight, PointLight, SpotLight)
        }
        self._main_camera_node: Node | None = None

    @property
    def bg_color(self) -> NDArray[np.float32]:
        """Background and its alpha, (4,) float32."""
        return self._bg_color

    @bg_color.setter
    def bg_color(self, value) -> None:
        self._bg_color = format_color_vector(np.ones(4) if value is None else value, 4)

    @property
    def ambient_light(self) -> NDArray[np.float32]:
        """Ambient light, (3,) float32."""
        return self._ambient_light

    @ambient_light.setter
    def ambient_light(self, value) -> None:
        self._ambient_light = format_color_vector(np.zeros(3) if value is None else value, 3)

    # ---- what there is ----

    @property
    def nodes(self) -> set[Node]:
        """All nodes."""
        return self._nodes

    @property
    def meshes(self) -> set[Mesh]:
        """All meshes."""
        return {node.mesh for node in self._mesh_nodes}

    @property
    def mesh_nodes(self) -> set[Node]:
        """The nodes that hold meshes."""
        return self._mesh_nodes

    @property
    def lights(self) -> set[Light]:
        """All lights."""
        return {node.light for node in self.light_nodes}

    @property
    def light_nodes(self) -> set[Node]:
        """The nodes that hold lights."""
        return set().union(*self._light_nodes.values())

    point_lights, point_light_nodes = _of_kind(PointLight, "point lights")
    spot_lights, spot_light_nodes = _of_kind(SpotLight, "spotlights")
    directional_lights, directional_light_nodes = _of_kind(DirectionalLight, "directional lights")

    @property
    def cameras(self) -> set[Camera]:
        """All cameras."""
        return {node.camera for node in self._camera_nodes}

    @property
    def camera_nodes(self) -> set[Node]:
        """The nodes that hold cameras."""
        return self._camera_nodes

    @property
    def main_camera_node(self) -> Node | None:
        """The node of the main camera: the first, unless another is assigned."""
        return self._main_camera_node

    @main_camera_node.setter
    def main_camera_node(self, value) -> None:
        if value not in self._nodes:
            raise ValueError("New main camera node must already be in scene")
        self._main_camera_node = value

    # ---- sizes ----

    @property
    def bounds(self) -> NDArray:
        """Lowest and highest corner of the boxes of all meshes, (2, 3); 0 where there are none."""
        corners = []
        for node in self._mesh_nodes:
            box = node.mesh.bounds
            if not len(node.mesh.primitives):
                continue
            pose = self.get_pose(node)
            points = box_corners(box)
            corners.append(points @ pose[:3, :3].T + pose[:3, 3])
        if not corners:
            return np.zeros((2, 3))
        points = np.concatenate(corners)
        return np.array([points.min(axis=0), points.max(axis=0)])

    # ---- changes ----

    def add(self, obj, name=None, pose=None, parent_node=None, parent_name=None) -> Node:
        """Add a mesh, a light or a camera to the scene.

        Parameters
        ----------
        obj : Mesh, Light or Camera
        name : str, optional
            Of the node.
        pose : (4, 4) float, optional
        parent_node : Node, optional
        parent_name : str, optional
            Instead: the name of one node.

        Returns
        -------
        node : Node

        Raises
        ------
        TypeError, ValueError
        """
        for kind, slot in ((Mesh, "mesh"), (Light, "light"), (Camera, "camera")):
            if isinstance(obj, kind):
                node = Node(name=name, matrix=pose, **{slot: obj})
                break
        else:
            raise TypeError("Unrecognized object type")
        if parent_node is None and parent_name is not None:
            found = self.get_nodes(name=parent_name)
            if len(found) != 1:
                count = "No" if not found else "More than one"
                raise ValueError(f"{count} parent node with name {parent_name} found")
            (parent_node,) = found
        self.add_node(node, parent_node=parent_node)
        return node

    def get_nodes(self, node=None, name=None, obj=None, obj_name=None) -> set[Node]:
        """Return the nodes that match all given criteria.

        Parameters
        ----------
        node : Node, optional
        name : str, optional
            Of the node.
        obj : Mesh, Light or Camera, optional
            That it holds.
        obj_name : str, optional
            The name of what it holds.
        """
        if node is not None:
            return {node} if node in self._nodes else set()
        found = set(self._nodes)
        if name is not None:
            found = {one for one in found if one.name == name}
        if obj is not None:
            found = {one for one in found if any(held is obj for held in _entries(one))}
        if obj_name is not None:
            found = {one for one in found if any(held.name == obj_name for held in _entries(one))}
        return found

    def add_node(self, node, parent_node=None) -> None:
        """Add a node and its children to the scene.

        Parameters
        ----------
        node : Node
        parent_node : Node, optional
            A node of the scene.

        Raises
        ------
        ValueError
            The node is in the scene already, or its parent isn't.
        """
        if node in self._nodes:
            raise ValueError("Node already in scene")
        if parent_node is not None and parent_node not in self._nodes:
            raise ValueError("Parent node must already be in scene")
        self._nodes.add(node)
        self._order[node] = next(self._numbers)
        self._parents[node] = parent_node
        if parent_node is not None and node not in parent_node.children:
            parent_node.children.append(node)
        self._list(node)
        for child in node.children:
            self.add_node(child, node)

    def _list(self, node: Node) -> None:
        """Add a node to the sets for its objects."""
        if node.mesh is not None:
            self._mesh_nodes.add(node)
        for kind, nodes in self._light_nodes.items():
            if isinstance(node.light, kind):
                nodes.add(node)
        if node.camera is not None:
            self._camera_nodes.add(node)
            if self._main_camera_node is None:
                self._main_camera_node = node

    def has_node(self, node) -> bool:
        """Return whether a node is in the scene."""
        return node in self._nodes

    def remove_node(self, node) -> None:
        """Remove a node and its children from the scene.

        Raises
        ------
        ValueError
            It isn't there.
        """
        if node not in self._nodes:
            raise ValueError("Node must already be in scene")
        parent = self._parents[node]
        self._remove(node)
        if parent is not None:
            parent.children.remove(node)

    def _remove(self, node: Node) -> None:
        for child in node.children:
            if child in self._nodes:
                self._remove(child)
        for nodes in (self._nodes, self._mesh_nodes, self._camera_nodes):
            nodes.discard(node)
        for nodes in self._light_nodes.values():
            nodes.discard(node)
        del self._order[node], self._parents[node]
        if self._main_camera_node is node:
            self._main_camera_node = min(self._camera_nodes, key=self._order.get, default=None)

    def get_pose(self, node) -> NDArray:
        """Return world-from-node, (4, 4).

        Raises
        ------
        ValueError
            The node isn't in the scene.
        """
        if node not in self._nodes:
            raise ValueError("Node must already be in scene")
        pose = np.array(node._parent_from_node(), np.float64)
        above = self._parents[node]
        while above is not None:
            pose = above._parent_from_node() @ pose
            above = self._parents[above]
        return pose

    def set_pose(self, node, pose) -> None:
        """Set the pose of a node relative to its parent.

        Parameters
        ----------
        node : Node
            Of this scene.
        pose : (4, 4) float

        Raises
        ------
        ValueError
        """
        if node not in self._nodes:
            raise ValueError("Node must already be in scene")
        node._matrix = np.eye(4) if pose is None else np.asarray(pose)

    @staticmethod
    def from_trimesh_scene(trimesh_scene, bg_color=None, ambient_light=None) -> Scene:
        """Return a scene converted from a trimesh scene: its meshes and their poses.

        Parameters
        ----------
        trimesh_scene : trimesh.Scene
        bg_color, ambient_light
            As for `Scene`.
        """
        meshes = {name: Mesh.from_trimesh(one) for name, one in trimesh_scene.geometry.items()}
        scene = Scene(bg_color=bg_color, ambient_light=ambient_light)
        for node in trimesh_scene.graph.nodes_geometry:
            pose, name = trimesh_scene.graph[node]
            scene.add(meshes[name], pose=pose)
        return scene

    def _in_order(self, nodes) -> list[Node]:
        """Return nodes of the scene in the order of adding."""
        return sorted(nodes, key=self._order.__getitem__)


__all__ = ["Scene"]
