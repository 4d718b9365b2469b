"""The scene of a physics client: what PyBullet's bodies look like now.

In: a client's number. Out: a `Scene` with a node for each visual shape, where its link is. PyBullet
is asked anew for every picture, so that nothing is drawn that is no longer there; only what it does
not tell (textures, which shape of a link was painted, vertices) is noted from calls.
"""

from __future__ import annotations

from itertools import zip_longest
from typing import Any, NamedTuple

import numpy as np

from ...base import linalg
from ...errors import warn
from ...model.geometry.mesh import Mesh
from ...model.materials.textures import Texture
from ...model.scene.cameras import Camera
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...model.scene.selection import NodeSelection
from ._files import search_folder
from ._forms import MESH
from ._visuals import Shape, form_of

# Of getDynamicsInfo: the pose of the inertial frame, and the kind of body.
_INERTIAL, _KIND = slice(3, 5), 10
_SOFT = 3
# Masks have the body in the lower bits, and the link, counted from the base, in the upper ones.
_LINK_SHIFT = 24
_BODY = (1 << _LINK_SHIFT) - 1
# Of a row of visual shape data.
_COLOR = 7
# A scene whose object IDs are beyond this begins anew.
_MOST_ID = 1 << 16


class Origin(NamedTuple):
    """What PyBullet does not tell of how a body was made.

    Attributes
    ----------
    folder : str
        Where Bullet looked for its files.
    meshes : dict of int to list of Mesh
        Those of vertices, by link, in the order of its shapes.
    """

    folder: str
    meshes: dict[int, list[Mesh]]


class _Body:
    """The shapes of a body.

    Attributes
    ----------
    place : tuple
        The pose of the base's inertial frame.
    rows : tuple
        The visual shape data as last seen.
    shapes : list of Shape
    links : list of int
        The links that have shapes, without the base.
    is_shown : bool
        Whether the shapes have their nodes, as far as they can be drawn.
    is_drawn : bool
        Whether one of them has.
    """

    def __init__(self, place: tuple[Any, ...], rows: tuple[Any, ...], origin: Origin) -> None:
        self.place, self.rows = place, rows
        given = {link: list(meshes) for link, meshes in origin.meshes.items()}
        self.shapes: list[Shape] = []
        for row in rows:
            form = form_of(row)
            meshes = given.get(form.link) if form.kind == MESH and not form.file else None
            mesh = meshes.pop(0) if meshes else None
            self.shapes.append(Shape(form, row[_COLOR], mesh, origin.folder))
        self.links = sorted({shape.form.link for shape in self.shapes} - {-1})
        self.is_shown = self.is_drawn = self._is_left_out = False

    def is_of(self, place: tuple[Any, ...], rows: tuple[Any, ...]) -> bool:
        """Return whether this may be the body of that data, if colours may have changed."""
        forms = (row[:_COLOR] for row in self.rows), (row[:_COLOR] for row in rows)
        return place == self.place and all(one == other for one, other in zip_longest(*forms))

    def paint(self, rows: tuple[Any, ...]) -> None:
        """Give each shape the colour of its row, if that one is new."""
        for shape, old, new in zip(self.shapes, self.rows, rows, strict=True):
            if old[_COLOR] != new[_COLOR]:
                shape.paint(new[_COLOR])
        self.rows = rows

    def of_link(self, link: int, place: int) -> list[Shape]:
        """Return the shapes of a link: all, or one by its place among them."""
        shapes = [shape for shape in self.shapes if shape.form.link == link]
        return shapes if place < 0 else shapes[place : place + 1]

    def locals(self) -> list[np.ndarray]:
        """Return, for each drawn shape, frame-from-shape; bases have their inertial frame."""
        turned = linalg.quaternion_to_matrix(self.place[1])
        base = linalg.inverse(linalg.multiply(linalg.translation(self.place[0]), turned))
        return [
            linalg.multiply(base, shape.form.frame) if shape.form.link < 0 else shape.form.frame
            for shape in self.drawn()
        ]

    def take_off(self) -> None:
        """Forget the nodes of a scene that is no longer drawn."""
        for shape in self.shapes:
            shape.node = None
        self.is_shown = self._is_left_out

    def leave_out(self) -> None:
        """Draw none of the shapes."""
        self.is_shown = self._is_left_out = True

    def drawn(self) -> list[Shape]:
        """Return the shapes that have nodes."""
        return [shape for shape in self.shapes if shape.node is not None]


class World:
    """The scene of a client.

    Parameters
    ----------
    bullet : module
        pybullet, with its own functions.
    client : int

    Attributes
    ----------
    scene : Scene
    textures : dict of int to Texture
        Those that were loaded, by pybullet's number.
    visuals : dict of int to list of Mesh
        What visual shapes have that name no file, by pybullet's number.
    hulls : set of int
        The collision shapes that have vertices instead of a file.
    origins : dict of int to Origin
        How bodies were made.
    """

    def __init__(self, bullet: Any, client: int) -> None:
        self._bullet, self._client = bullet, client
        self._bodies: dict[int, _Body] = {}
        self._begin_scene()
        self.textures: dict[int, Texture] = {}
        self.visuals: dict[int, list[Mesh]] = {}
        self.hulls: set[int] = set()
        self.origins: dict[int, Origin] = {}
        self._selection: NodeSelection | None = None
        self._locals = np.zeros((0, 4, 4))
        self._frames = np.zeros(0, np.int64)
        self._masks = _tables({})

    def _begin_scene(self) -> None:
        """Begin an empty scene, in which object IDs count from 0."""
        self.scene = Scene(background=None, ambient=(0, 0, 0))
        # Its matrix is clip-from-world: the node stays where the world's origin is.
        self.camera = Camera(np.eye(4))
        self.viewpoint = self.scene.add(self.camera)
        for body in self._bodies.values():
            body.take_off()
        self._is_new = True

    def clear(self) -> None:
        """Forget all bodies, shapes and textures."""
        self._bodies.clear()
        self._begin_scene()
        self.textures.clear()
        self.visuals.clear()
        self.hulls.clear()
        self.origins.clear()

    def forget(self, uid: int) -> None:
        """Forget a body that was removed."""
        self._drop(uid)
        self.origins.pop(uid, None)

    def body(self, uid: int) -> _Body:
        """Return the shapes of a body as they are now."""
        ask = {"physicsClientId": self._client}
        rows = self._bullet.getVisualShapeData(uid, **ask)
        dynamics = self._bullet.getDynamicsInfo(uid, -1, **ask)
        body, place = self._bodies.get(uid), dynamics[_INERTIAL]
        if body is not None and body.rows == rows and body.place == place:
            return body
        if body is None or not body.is_of(place, rows):
            self._drop(uid)
            origin = self.origins.get(uid) or Origin(search_folder(), {})
            body = self._bodies[uid] = _Body(place, rows, origin)
            if dynamics[_KIND] == _SOFT:
                warn("soft bodies of PyBullet are not drawn")
                body.leave_out()
            self._is_new = True
        body.paint(rows)
        return body

    def paint(self, uid: int, link: int, place: int, color: tuple[float, ...]) -> None:
        """Note that shapes of a link were painted: all, or one by its place in the link.

        PyBullet's data then tells the colour for all of them.
        """
        body = self._bodies[uid]
        body.rows = self._bullet.getVisualShapeData(uid, physicsClientId=self._client)
        for shape in body.of_link(link, place):
            shape.paint(color)

    def dress(self, uid: int, link: int, place: int, texture: Texture | None) -> None:
        """Give shapes of a link a texture, or none; see `paint`."""
        for shape in self._bodies[uid].of_link(link, place):
            shape.dress(texture)

    def masks(self, with_links: bool) -> np.ndarray:
        """Return the number that masks have for each object ID; the last one is the background."""
        return self._masks[int(with_links)]

    def hidden(self) -> list[Node]:
        """Return the nodes that alpha 0 hides."""
        shapes = (shape for body in self._bodies.values() for shape in body.drawn())
        return [shape.node for shape in shapes if shape.color[3] == 0.0]

    def update(self) -> None:
        """Bring the scene to the present state of all bodies."""
        bullet, ask = self._bullet, {"physicsClientId": self._client}
        uids = [bullet.getBodyUniqueId(k, **ask) for k in range(bullet.getNumBodies(**ask))]
        for uid in set(self._bodies) - set(uids):
            self._drop(uid)
        bodies = [(uid, self.body(uid)) for uid in uids]
        if self._is_new:
            self._place(bodies)
        frames: list[tuple[float, ...]] = []
        for uid, body in bodies:
            if body.is_drawn:
                where, turned = bullet.getBasePositionAndOrientation(uid, **ask)
                frames.append((*where, *turned))
                if body.links:
                    states = bullet.getLinkStates(uid, body.links, 0, 1, **ask)
                    frames += [(*state[4], *state[5]) for state in states]
        if not frames or self._selection is None:
            return
        rows = np.array(frames)
        poses = linalg.quaternion_to_matrix(rows[:, 3:])
        poses[:, :3, 3] = rows[:, :3]
        self._selection.poses = linalg.multiply(poses[self._frames], self._locals)

    def _place(self, bodies: list[tuple[int, Any]]) -> None:
        """Add the nodes of new bodies, and note which frame each node follows."""
        if self.scene.nodes[-1].id > _MOST_ID:  # the table of masks has a row for each ID
            self._begin_scene()
        nodes, places, frames, masks, count = [], [], [], {}, 0
        for uid, body in bodies:
            for shape in () if body.is_shown else body.shapes:
                shape.show(self.scene)
            body.is_shown = True
            drawn = body.drawn()
            body.is_drawn = bool(drawn)
            if not drawn:
                continue
            number_of = {-1: count, **{link: count + 1 + k for k, link in enumerate(body.links)}}
            count += len(number_of)
            nodes += [shape.node for shape in drawn]
            places += body.locals()
            frames += [number_of[shape.form.link] for shape in drawn]
            for shape in drawn:
                masks[shape.node.id] = uid + ((shape.form.link + 1) << _LINK_SHIFT)
        self._selection = self.scene.select(nodes) if nodes else None
        self._locals = np.array(places).reshape(-1, 4, 4)
        self._frames = np.array(frames, np.int64)
        self._masks = _tables(masks)
        self._is_new = False

    def _drop(self, uid: int) -> None:
        body = self._bodies.pop(uid, None)
        for shape in () if body is None else body.drawn():
            self.scene.remove(shape.node)
        self._is_new = self._is_new or body is not None


def _tables(masks: dict[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Return numbers by object ID, (N,) int32 each: of bodies alone, and with links."""
    table = np.full(max(masks, default=-1) + 2, -1, np.int64)
    table[list(masks)] = list(masks.values())
    whole = table.astype(np.int32)
    return np.where(whole < 0, whole, whole & _BODY), whole
