"""Draws pictures of scenes along views, each with the passes that it needs.

In: a scene, options and a `Shot`. Out: arrays. A renderer has one painter for its frames, and that
one others for what mirrors show.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._native.rasterizer import NativeRenderer
from ..choices import ColorSpace
from ..model.scene.staged_scene import AnyScene
from ._frame_memory import FrameMemory, Use
from ._frame_options import OptionsCache
from ._output_pool import OutputPool
from ._told import Told
from ._turn import RendererTurn
from .draw_list.draw_list import DrawList
from .options import RenderOptions, with_both_sides
from .passes.all_passes import Passes
from .passes.protocol import Picture, Shot, Tools


class How(NamedTuple):
    """How a painter draws; 0 threads are all."""

    backend: int
    threads: int
    color_space: ColorSpace
    samples: tuple[int, int]  # per pixel: along an axis, and multisamples of each


class Painter:
    """What draws the pictures of one renderer, or of one of its mirrors.

    Parameters
    ----------
    how : How
    turn : RendererTurn
        Of the renderer, whose caller holds it.
    around : FrameMemory, optional
        That of the picture which shows this one's in a mirror.
    told : Told, optional
        What the pictures of the same frames told.

    Attributes
    ----------
    how : How
    memory : FrameMemory
    native : NativeRenderer
    draw_list : DrawList
    options : OptionsCache
    passes : Passes
    """

    def __init__(
        self,
        how: How,
        turn: RendererTurn,
        around: FrameMemory | None = None,
        told: Told | None = None,
    ) -> None:
        backend, threads, color_space, samples = how
        self.native = NativeRenderer(backend, threads)
        self._told = Told() if told is None else told
        self.draw_list = DrawList(color_space, threads, self._told)
        self.options = OptionsCache(color_space, threads)
        self.memory = FrameMemory(*samples, threads, around)
        self.how, self._turn = how, turn
        self._pool = OutputPool()
        turn.hold(self.native)
        self.passes = Passes(
            Tools(
                self.native,
                self.draw_list,
                self.memory,
                backend,
                threads,
                color_space == "srgb",
                samples,
                self._told,
                self.another,
            )
        )

    def another(self) -> Painter:
        """Return a painter with one sample per pixel."""
        return Painter(self.how._replace(samples=(1, 0)), self._turn, self.memory, self._told)

    def look(
        self, scene: AnyScene, options: RenderOptions, listed: tuple[str, ...], shot: Shot
    ) -> Picture:
        """Update the draw list, and return the picture that the passes start with."""
        view, size = shot.view, shot.size
        frame_options = self.options.get(scene, options, shot.rows, shot.beyond)
        frustum = view.clip_from_world if shot.frozen is None else shot.frozen
        self.draw_list.update(
            scene.data,
            frame_options.listing(listed),
            frame_options.headlight(shot.headlight),
            frame_options.placing(frustum, size),
        )
        picture = Picture(scene, options, frame_options, shot, options.cull)
        self.draw_list.native.close_apertures()
        if options.cull == "auto":
            self._let_backs_show(picture)
        if options.mode == "depth":
            picture.depth_range = view.depth_range(scene.bounds)
        return picture

    def radiance(self, scene: AnyScene, options: RenderOptions, shot: Shot) -> NDArray[np.float32]:
        """Return the radiance of a picture, (height, width, 3)."""
        plan = self.passes.plan(options, ("radiance",), shot.size)
        outputs = self._pool.take(plan.outputs)
        self.memory.add(Use(outputs["radiance"].nbytes, "a mirror", "fewer pixels"))
        picture = self.look(scene, options, plan.listed, shot)
        picture.targets, picture.arrays = self.passes.arrays(plan, outputs)
        for one in plan.passes:
            one.draw(picture)
            self._turn.check()
        return outputs["radiance"]

    def _let_backs_show(self, picture: Picture) -> None:
        """Cull backs of closed meshes, unless the camera looks into their holes."""
        apertures = self.draw_list.open_apertures(picture.scene.data, picture.view, picture.size)
        picture.shadow_cull = "none" if self.draw_list.has_holes else "back"
        if apertures is None:
            shot, options = picture.shot, with_both_sides(picture.options)
            picture.frame_options = self.options.get(picture.scene, options, shot.rows, shot.beyond)
