"""Draws pictures through lenses.

In: a scene, the view of a lens camera, options. Out: the frame's arrays. The pinhole pictures
around the lens are drawn first, each with its passes; then the lens's pixels are looked up in them
(docs/exactness, section 31).
"""

from __future__ import annotations

from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from ..._native import rasterizer as _native
from ..._native.lens import CODES_BYTES, fill_codes
from ...errors import warn
from ...model.scene.cameras import IntrinsicsCamera
from ...model.scene.gradients import Gradient
from ...model.scene.lenses.lens_camera import LensCamera
from ...model.scene.scene import Scene
from ...model.scene.staged_scene import AnyScene
from .._bare_scene import BareScene
from .._lens_view import LensView
from .._memo import Memo
from .._output_pool import OutputPool, Shapes, shapes_of
from .._painter import How, Painter
from .._told import Told
from .._turn import RendererTurn
from .._view import View
from ..options import RenderOptions
from ..passes.protocol import Picture, Shot
from .lens_options import (
    IDENTITIES,
    OF_VALUES,
    border_of,
    check_outputs,
    faces_options,
    faces_outputs,
    warn_of_scene,
)
from .lens_plan import Face, LensPlan, plan_lens
from .lens_scene import lens_scene, lets_light_pass
from .lens_stats import LensStats
from .lens_values import Found, blank, coloured_values, empty, value_of

Arrays = dict[str, NDArray[Any]]
_MOST_PLANS = 4


class Through(NamedTuple):
    """What is drawn through a lens.

    Attributes
    ----------
    scene : Scene or StagedScene
    options : RenderOptions
    view : LensView
    size : (int, int)
    frozen : (4, 4) float64 or None
        The frustum to cull by, if another.
    """

    scene: AnyScene
    options: RenderOptions
    view: LensView
    size: tuple[int, int]
    frozen: NDArray[np.float64] | None


class LensPainter:
    """What draws the pictures through lenses of one renderer.

    Parameters
    ----------
    how : How
    turn : RendererTurn
        Of the renderer, whose caller holds it.
    """

    def __init__(self, how: How, turn: RendererTurn) -> None:
        self._how, self._turn = how, turn
        self._painters: list[Painter] = []
        self._views: list[tuple[tuple[float, ...], View]] = []  # by face, with its lens
        self._plans: dict[tuple[Any, ...], LensPlan] = {}
        self._pool = OutputPool()
        self._codes: NDArray[np.uint8] | None = None
        self._told, self._told_by_faces = Memo(), Told()

    def forget(self) -> None:
        """Free unused arrays."""
        self._pool.forget()
        self._plans.clear()
        for painter in self._painters:
            painter.passes.forget()

    def draw(self, through: Through, outputs: Arrays) -> LensStats:
        """Draw a frame's outputs.

        Raises
        ------
        InvalidArgumentError
            A lens has none of an output, or the faces exceed a frame's memory limit.
        """
        check_outputs(outputs)
        options = through.options
        plan = self._plan(through)
        names = faces_outputs(options, tuple(outputs))
        arrays = self._pool.take(_flat(shapes_of(names, 1, 1), plan.total))
        pictures = [self._draw_face(through, plan, k, arrays) for k in range(len(plan.faces))]
        self._warn(through, pictures)
        rays = 0
        found = None
        if "object_id" in arrays:
            found, rays = self._find(through, plan, arrays, outputs)
        for name, array in outputs.items():
            if name != "color":
                assert found is not None
                value_of(name, found, plan, through.view, arrays, self._how.threads, array)
        if "color" in outputs:
            self._draw_color(through, plan, arrays, found, outputs["color"])
        return LensStats([picture.drawn for picture in pictures], rays)

    def _plan(self, through: Through) -> LensPlan:
        camera, border = through.view.camera, border_of(through.options)
        key = *_shape_of(camera), through.size, border
        kept = self._plans.get(key)
        if kept is None:
            if len(self._plans) >= _MOST_PLANS:
                self._plans.clear()
            kept = self._plans[key] = plan_lens(camera, through.size, border)
        return kept

    def _warn(self, through: Through, faces: list[Picture]) -> None:
        """Warn once of each scene and options of what differs from a pinhole's picture."""
        scene, options = through.scene, through.options
        refracts = any("behind" in face.arrays for face in faces)
        if self._told.differs(id(scene), scene.fog, options, len(faces), refracts):
            if len(faces) > 1:
                warn_of_scene(scene, options, refracts)
            if _is_behind(scene) and options.mode == "lit" and lets_light_pass(scene):
                warn("through a lens, glass shows a gradient behind it without the glass's colour")
            self._told.done()

    def _draw_face(self, through: Through, plan: LensPlan, k: int, arrays: Arrays) -> Picture:
        """Draw a pinhole picture into its part of the arrays, and return it."""
        face = plan.faces[k]
        if k == len(self._painters):
            self._painters.append(Painter(self._how, self._turn, told=self._told_by_faces))
        painter = self._painters[k]
        options = faces_options(through.options, plan.scale)
        width, height = face.size
        outputs = {
            name: array[face.pixels].reshape(height, width, *array.shape[1:])
            for name, array in arrays.items()
        }
        scene = (
            cast(AnyScene, BareScene(through.scene)) if _is_behind(through.scene) else through.scene
        )
        passes = painter.passes.plan(options, tuple(outputs), face.size)
        view = self._view(through.view, face, k)
        whole, towards = (*through.size, plan.scale), through.view.towards_viewer
        shot = Shot(view, face.size, plan.rows, towards, through.frozen, whole=whole)
        picture = painter.look(scene, options, passes.listed, shot)
        picture.targets, picture.arrays = painter.passes.arrays(passes, outputs)
        for one in passes.passes:
            one.draw(picture)
            self._turn.check()
        return picture

    def _view(self, lens: LensView, face: Face, k: int) -> View:
        """Return the view of a face; the last one if nothing has changed."""
        pose, camera = face.pose(lens.pose), lens.camera
        made_of = *face.intrinsics, camera.znear, camera.zfar
        if k == len(self._views):
            self._views.append((made_of, View(_pinhole(*made_of), pose, *face.size)))
        known, view = self._views[k]
        pinhole = view.camera if known == made_of else _pinhole(*made_of)
        if not view.is_of(pinhole, pose, *face.size):
            view = View(pinhole, pose, *face.size, view)
            self._views[k] = made_of, view
        return view

    def _find(
        self, through: Through, plan: LensPlan, arrays: Arrays, outputs: Arrays
    ) -> tuple[Found, int]:
        """Find what the rays of the pixels meet."""
        options, camera = through.options, through.view.camera
        nodes = lens_scene(through.scene, options.hidden_surfaces == "zbuffer")
        found = empty(outputs, options.mode, through.size)
        rays = plan.native.find(
            nodes.graph,
            nodes.shapes,
            (nodes.ids, nodes.slots, nodes.solid),
            options.cull in ("auto", "none"),
            through.view.pose,
            (camera.znear, camera.zfar),
            (*(arrays[name] for name in IDENTITIES), arrays["depth"]),
            found,
            camera.depth_along == "axis",
            self._how.threads,
        )
        return found, rays

    def _draw_color(
        self,
        through: Through,
        plan: LensPlan,
        arrays: Arrays,
        found: Found | None,
        color: NDArray[np.uint8],
    ) -> None:
        scene, options = through.scene, through.options
        behind = self._behind(through) if _is_behind(scene) else None
        outside = (0, 0, 0, 0 if scene.background is None else 255)
        light = self._pool.take({"light": ((plan.total, 4), np.dtype(np.uint16))})["light"]
        codes, threads = self._light_codes(), self._how.threads
        backend = self._how.backend
        plan.native.draw(arrays["color"], light, behind, codes, outside, backend, threads, color)
        if options.mode in OF_VALUES and options.wireframe is None:
            assert found is not None
            name = OF_VALUES[options.mode]
            values = found.get(name)
            if values is None:
                values = blank(name, through.size)
                value_of(name, found, plan, through.view, arrays, threads, values)
            range_ = through.view.depth_range(scene.bounds)
            coloured_values(options.mode, values, found, range_, color)
        if "radiance" in arrays and options.bloom > 0 and options.mode in ("lit", "unlit"):
            self._add_bloom(through, plan, arrays, color)

    def _light_codes(self) -> NDArray[np.uint8]:
        if self._codes is None:
            self._codes = np.empty(CODES_BYTES, np.uint8)
            fill_codes(self._codes, self._how.color_space == "srgb")
        return self._codes

    def _behind(self, through: Through) -> NDArray[np.uint8]:
        """Return the picture of the background alone, which goes with the picture's rows."""
        empty = Scene(background=through.scene.background)
        painter = self._painters[0]
        options = RenderOptions()
        plan = painter.passes.plan(options, ("color",), through.size)
        outputs = self._pool.take(plan.outputs)
        width, height = through.size
        shot = Shot(through.view, through.size, height, through.view.towards_viewer)
        picture = painter.look(empty, options, plan.listed, shot)
        picture.targets, picture.arrays = painter.passes.arrays(plan, outputs)
        for one in plan.passes:
            one.draw(picture)
        return outputs["color"]

    def _add_bloom(
        self, through: Through, plan: LensPlan, arrays: Arrays, color: NDArray[np.uint8]
    ) -> None:
        """Add the glow over the whole picture."""
        radiance = blank("radiance", through.size)
        at = plan.nearest()
        np.take(arrays["radiance"], np.maximum(at, 0), axis=0, out=radiance)
        radiance[at < 0] = 0.0
        how = self._how
        scratch = np.empty(_native.bloom_scratch(*through.size, how.threads), np.float32)
        is_srgb = how.color_space == "srgb"
        strength = through.options.bloom
        _native.add_bloom(radiance, color, strength, is_srgb, how.backend, how.threads, scratch)


def _shape_of(camera: LensCamera) -> tuple[Any, ...]:
    """Return what decides where a lens's pixels look: all but its clip planes."""
    beside = ("version", "znear", "zfar")
    held = tuple((name, value) for name, value in vars(camera).items() if name not in beside)
    return type(camera), held


def _pinhole(
    fx: float, fy: float, cx: float, cy: float, znear: float, zfar: float
) -> IntrinsicsCamera:
    return IntrinsicsCamera(fx, fy, cx, cy, znear=znear, zfar=zfar)


def _is_behind(scene: AnyScene) -> bool:
    """Return whether the background goes with the picture's rows, and not with directions."""
    return isinstance(scene.background, Gradient)


def _flat(shapes: Shapes, total: int) -> Shapes:
    """Return the shapes of arrays over the pixels of all faces."""
    return {name: ((total, *shape[2:]), dtype) for name, (shape, dtype) in shapes.items()}
