"""Mirrors: what flat mirrors of a scene reflect, each drawn as one more view of the scene.

In: an up-to-date draw list, and the picture's view. Out: for each mirror in view its plane, and the
radiance that it reflects at each sample of a part of the picture, by which the core shades faces
(docs/exactness, section 27). The views are drawn by the same passes, this one included.
"""

from __future__ import annotations

from ...base.image_size import MAX_SIZE
from ..options import RenderOptions, as_mirrored, lights_faces
from .mirror_backgrounds import MirrorBackgrounds
from .mirror_planes import MOST_MIRRORS, MirrorFinder, MirrorPlane
from .mirror_views import Part, Reflection, part_of
from .protocol import MirrorPainter, Pass, Picture, Shot, ShownMirror, Tools

_FINER = 2  # rows and columns in a pixel with multisampling, whose outputs have one sample


class Mirrors(Pass):
    """Draws what mirrors reflect, for pictures with lit surfaces."""

    reads = ("scene",)
    writes = ("mirrors",)

    def __init__(self, tools: Tools) -> None:
        super().__init__(tools)
        self._finder = MirrorFinder(tools.draw_list, tools.told)
        self._backgrounds = MirrorBackgrounds(tools.is_srgb)
        self._painters: list[MirrorPainter] = []  # by the mirror's number in the picture
        # By the number of the mirror's plane: its view with its inputs.
        self._views: dict[int, tuple[tuple[object, ...], Reflection]] = {}

    def is_in(self, options: RenderOptions, wanted: set[str]) -> bool:
        return options.mirror_depth > 0 and lights_faces(options, wanted)

    def draw(self, picture: Picture) -> None:
        if not self.tools.draw_list.has_mirrors:
            return
        for plane, view in self._views_of(picture):
            fineness = self.tools.samples[0] * view.scale
            options = as_mirrored(picture.options, fineness)
            shot = self._shot(picture, view, fineness)
            painter = self._painter(len(picture.mirrors))
            radiance = painter.radiance(picture.scene, options, shot)
            self.tools.memory.add_mirror(painter.memory)
            numbers = (*plane.normal.tolist(), plane.offset)
            place = view.part.left, view.part.top, view.scale
            picture.mirrors.append(ShownMirror(numbers, plane.slack, *place, radiance))

    def _views_of(self, picture: Picture) -> list[tuple[MirrorPlane, Reflection]]:
        """Return the mirrors that a picture shows, and the views of what they show.

        Of more than `MOST_MIRRORS` these are the ones that cover most of it, and of equal ones the
        first.
        """
        axis = self.tools.samples[0]
        samples = picture.size[0] * axis, picture.size[1] * axis
        planes = self._finder.find(picture)
        found = [(k, self._part_of(picture, plane, samples)) for k, plane in enumerate(planes)]
        parts = [(k, part) for k, part in found if part is not None]
        views: dict[int, Reflection] = {}
        left = sorted(parts, key=lambda one: (one[1].area, -one[0]))
        while left and len(views) < MOST_MIRRORS:
            k, part = left.pop()
            view = self._view(picture, k, planes[k], part)
            if view.is_usable:
                views[k] = view
        self._views = {k: self._views[k] for k in views}
        if left:
            self.tools.told.warn(
                picture.scene.data,
                f"a view shows {MOST_MIRRORS} mirrors, not {MOST_MIRRORS + len(left)}: those that "
                "cover less of it look as without Material.mirror",
                kind="too many mirrors",
            )
        return [(planes[k], views[k]) for k in sorted(views)]

    def _part_of(
        self, picture: Picture, plane: MirrorPlane, samples: tuple[int, int]
    ) -> Part | None:
        """Return the part of a picture that may show a mirror; None if it shows nothing."""
        part = part_of(plane, picture.view, samples)
        if part is None or max(part.width, part.height) <= MAX_SIZE:
            return part
        self.tools.told.warn(
            picture.scene.data,
            f"a mirror that shows on {part.width}x{part.height} samples looks as without "
            f"Material.mirror: they may be {MAX_SIZE} a side; fewer pixels or samples help",
            kind="too large a mirror",
        )
        return None

    def _view(self, picture: Picture, number: int, plane: MirrorPlane, part: Part) -> Reflection:
        """Return the view of what a mirror shows: the last one of its number if it is the same."""
        axis, multiple = self.tools.samples
        samples = picture.size[0] * axis, picture.size[1] * axis
        is_small = _FINER * max(part.width, part.height) <= MAX_SIZE
        scale, bounds = _FINER if multiple and is_small else 1, picture.scene.bounds
        numbers = plane.normal.tobytes(), plane.offset, plane.slack
        made_of = picture.view, *numbers, part, scale, bounds.tobytes()
        known = self._views.get(number)
        if known is None or known[0] != made_of:
            view = Reflection(picture.view, plane, part, samples, scale, bounds)
            known = self._views[number] = made_of, view
        return known[1]

    def _shot(self, picture: Picture, view: Reflection, fineness: int) -> Shot:
        beyond = self._backgrounds.beyond(picture.scene, picture.options)
        rows, headlight = picture.shot.rows * fineness, picture.shot.headlight
        width, height, finer = picture.shot.whole or (*picture.size, 1.0)
        whole = width, height, finer * fineness
        return Shot(view, view.size, rows, headlight, beyond=beyond, whole=whole)

    def _painter(self, number: int) -> MirrorPainter:
        if number == len(self._painters):
            self._painters.append(self.tools.another())
        return self._painters[number]
