"""Draws an agent's pictures.

In: a request. Out: a `Picture`: pixels, and what they show. Renderers are kept, so that the next
picture of an unchanged scene takes no longer than its frame.
"""

from __future__ import annotations

import gc
import time
from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..._native.images import encode_png
from ...base.numbers import shown as shown_value
from ...base.validation import choose
from ...errors import InvalidArgumentError
from ...model.scene.cameras import Camera
from ...model.scene.instances import InstancedMesh
from ...rendering.frame import Frame
from ...stage.blank import Reason, Sight, reason_of
from ...stage.look import Look
from ...stage.renderer import Renderer
from .cut_views import cut_scene, show_caps
from .picture_marks import draw_highlights, draw_names
from .server_limits import Limits
from .shown_scene import Shown, shown_scene
from .things import Part, Thing, Things
from .view_cameras import camera_record, place_perspective, rounded, view_choice

OUTPUTS = ("color", "depth", "object_id", "instance_id", "face_id")
#: What a picture can look like: the look, and options of `Renderer.render`.
LOOKS: dict[str, tuple[str, dict[str, Any]]] = {
    "studio": ("studio", {}),
    "plain": ("plain", {}),
    "edges": ("studio", {"edges": True}),
    "normals": ("studio", {"mode": "world_normal"}),
    "depth": ("studio", {"mode": "depth"}),
    "ids": ("studio", {"mode": "object_id"}),
}
SIZE = (800, 600)
_SMALLEST = 16
_KEPT_SCENES, _KEPT_RENDERERS = 4, 3
#: After so many dropped scenes, their memory is collected.
_DROPPED = 16
#: Parts that a record lists; more would be many words.
MOST_LISTED = 40


@dataclass(frozen=True)
class Request:
    """What a picture is to show; see the tool ``render``."""

    view: Any = "iso"
    size: Any = SIZE
    objects: Any = ()
    hide: Any = ()
    look: str = "studio"
    transparent: bool = False
    labels: bool = False
    section: Any = None
    highlight: Any = ()


@dataclass(frozen=True)
class Drawn:
    """What was drawn.

    Attributes
    ----------
    pixels : (H, W, 4) ndarray of uint8
    record : dict
        What agents are told of it.
    """

    pixels: NDArray[np.uint8]
    record: dict[str, Any]

    def encode(self) -> bytes:
        """Return the bytes of a PNG file."""
        return encode_png(self.pixels)


@dataclass(frozen=True)
class Picture(Drawn):
    """A picture of one view; its record has ``camera``, ``visible``, ``blank`` and others.

    Attributes
    ----------
    shown : Shown
    frame : Frame
        With IDs and depths, for questions about pixels.
    """

    shown: Shown
    frame: Frame

    def at(self, x: int, y: int) -> dict[str, Any]:
        """Return what a pixel shows: the object, the triangle, where it is.

        Raises
        ------
        InvalidArgumentError
            The pixel is outside of the picture.
        """
        frame, shown = self.frame, self.shown
        check_pixel(x, y, frame.size)
        number, face = int(frame.object_id[y, x]), int(frame.face_id[y, x])
        view = self.record["camera"]["view"]
        if number not in shown.owners:
            return {"object": None, "view": view}
        found: dict[str, Any] = {
            "object": shown.label(number),
            "triangle": face if face >= 0 else None,
            "view": view,
        }
        if isinstance(shown.owners[number][1].drawn, InstancedMesh):
            found["instance"] = int(frame.instance_id[y, x])
        hit = shown.viewed.scene.pick(frame, x, y) if face >= 0 else None
        if hit is not None and np.isfinite(hit.position).all():
            found["position"] = rounded(hit.position + shown.origin)
            found["normal"] = rounded(hit.normal)
            found["distance"] = float(hit.distance)
        return found


def check_pixel(x: int, y: int, size: tuple[int, int]) -> None:
    """Raise an error unless a pixel is within a picture."""
    if not (0 <= x < size[0] and 0 <= y < size[1]):
        raise InvalidArgumentError(
            f"pick: pixel ({x}, {y}) is outside of the picture, {size[0]} x {size[1]}"
        )


class Studio:
    """Draws pictures of objects.

    Parameters
    ----------
    limits : Limits
    """

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._scenes: OrderedDict[Any, Shown] = OrderedDict()
        self._renderers: OrderedDict[Any, Renderer] = OrderedDict()
        self._dropped = 0

    def close(self) -> None:
        """Free the memory of all renderers and scenes."""
        for renderer in self._renderers.values():
            renderer.close()
        self._renderers.clear()
        self._scenes.clear()

    def draw(self, things: Things, request: Request) -> Picture:
        """Draw a picture.

        Raises
        ------
        InvalidArgumentError
        """
        began = time.perf_counter()
        size = self.checked_size(request.size)
        choice = view_choice(request.view, things)
        look, options = LOOKS[choose(request.look, LOOKS, "look")]
        parts = visible_parts(things, request.objects, request.hide)
        shown = self.scene_of(parts, things.lamps(request.objects, request.hide))
        cut = None
        if request.section is not None:
            if not shown.owners:
                raise InvalidArgumentError("section: there is no object to cut")
            cut = cut_scene(shown, request.section, choice, size)
            camera, pose = cut.camera, cut.pose
            options = {**options, "cull": "none"}
        else:
            camera, pose = place_perspective(shown, things, choice, size)
        renderer = self._renderer(look, size, request.transparent, cut is None)
        frame = self._frame(renderer, shown, (camera, pose), options)
        caps = None if cut is None else show_caps(shown, cut, frame)
        draw_highlights(frame, shown, things, request.highlight or ())
        if request.labels:
            draw_names(frame, shown)
        record = camera_record(shown, choice, camera, pose)
        told = _told(shown, frame, (camera, pose)) | {"camera": record}
        if caps is not None:
            told["cut"] = [
                {"name": shown.label(one.node), "pixels": one.pixels, "area": one.area}
                for one in caps.nodes
            ]
        told["seconds"] = round(time.perf_counter() - began, 4)
        return Picture(frame.color, told, shown, frame)

    def draw_with(
        self, parts: list[tuple[Thing, Part]], camera: Camera, pose: Any, size: tuple[int, int]
    ) -> NDArray[np.uint8]:
        """Return the pixels of parts before a plain ground, seen by a camera.

        The pose is in the objects' coordinates.
        """
        shown, renderer = self.scene_of(parts), self._renderer("studio", size, False, False)
        pose = pose.copy()
        pose[:3, 3] -= shown.origin
        return self._frame(renderer, shown, (camera, pose), {}).color

    def scene_of(self, parts: list[tuple[Thing, Part]], lamps: Sequence[Thing] = ()) -> Shown:
        """Return the scene of some parts: the same one as long as they and the lamps are."""
        key = tuple(id(part) for _, part in parts), tuple(map(id, lamps))
        found = self._scenes.get(key)  # holds them all, so that no other one gets their identity
        if found is None:
            found = self._scenes[key] = shown_scene(parts, lamps)
        self._scenes.move_to_end(key)
        while len(self._scenes) > _KEPT_SCENES:
            self._scenes.popitem(last=False)
            self._dropped += 1
        if self._dropped >= _DROPPED:
            # Scenes and their stages refer to each other, and hold more memory than Python knows.
            self._dropped = 0
            gc.collect()
        return found

    def checked_size(self, size: Any) -> tuple[int, int]:
        """Return a size, or raise an error that names the limits."""
        most = self._limits.most_side
        is_pair = isinstance(size, (list, tuple)) and len(size) == 2
        if not is_pair or not all(
            isinstance(side, int) and not isinstance(side, bool) and _SMALLEST <= side <= most
            for side in size
        ):
            raise InvalidArgumentError(
                f"size must be [width, height], each {_SMALLEST} to {most} pixels (--max-side), "
                f"not {shown_value(size)}"
            )
        return int(size[0]), int(size[1])

    def _renderer(
        self, look: str, size: tuple[int, int], transparent: bool, has_ground: bool
    ) -> Renderer:
        key = look, transparent, has_ground
        renderer = self._renderers.get(key)
        if renderer is None:
            worn = Look.studio() if look == "studio" else Look.plain(background="auto")
            if transparent:
                worn = worn.replace(background=None)
            if not has_ground or transparent:
                worn = worn.replace(ground=False)
            renderer = self._renderers[key] = Renderer(size, look=worn)
        self._renderers.move_to_end(key)
        while len(self._renderers) > _KEPT_RENDERERS:
            self._renderers.popitem(last=False)[1].close()
        if renderer.size != size:
            renderer.resize(size)
        return renderer

    def _frame(
        self, renderer: Renderer, shown: Shown, camera: Any, options: dict[str, Any]
    ) -> Frame:
        return renderer.render(
            shown.viewed, camera, outputs=OUTPUTS, transparent_outputs=True, **options
        )


def visible_parts(things: Things, objects: Any, hide: Any) -> list[tuple[Thing, Part]]:
    """Return the parts that a picture shows: some or all objects, without those hidden."""
    if objects:
        wanted = things.find(objects, with_lamps=True)
    else:
        wanted = [pair for pair in things.all_parts() if pair[1].visible]
    hidden = {id(part) for _, part in things.find(hide or (), "hide", with_lamps=True)}
    return [pair for pair in wanted if id(pair[1]) not in hidden]


def _told(shown: Shown, frame: Frame, camera: tuple[Camera, Any]) -> dict[str, Any]:
    """Return what a frame shows, and why it shows nothing."""
    visible = shown.visible(frame)
    reason = None if visible else _reason(shown, frame, camera)
    return {
        "size": list(frame.size),
        "blank": reason is not None,
        "reason": None if reason is None else f"{reason.word}: {reason.sentence}",
        "visible": [
            {"name": name, "pixels": counted.pixels, "box": list(counted.box)}
            for name, counted in visible[:MOST_LISTED]
        ],
        "not_visible": sorted(
            {thing.label(part) for thing, part in shown.owners.values()}
            - {name for name, _ in visible}
        )[:MOST_LISTED],
    }


def _reason(shown: Shown, frame: Frame, camera: tuple[Camera, Any]) -> Reason:
    return reason_of(Sight(shown.viewed.scene, *camera, frame.size, {"cull": "auto"}))
