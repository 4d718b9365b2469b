"""The renderer: draws scenes into frames on the CPU.

In: a `Scene`, a camera and options. Out: a `Frame` with the requested outputs; no others are
computed. One call of the core per frame, without the GIL. The same scene gives the same bytes on
every backend and every number of threads.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn, SupportsIndex

from .._native import rasterizer as _native
from ..base.calls import hinted
from ..base.image_size import check_size
from ..base.thread_count import resolve_threads
from ..base.validation import Closed, choose, is_one_of
from ..choices import Antialiasing, Backend, ColorSpace, Samples
from ..errors import InvalidArgumentError, SceneChangedError
from ..model.materials.colors import COLOR_SPACES
from ..model.scene.scene import Scene
from ..model.scene.staged_scene import AnyScene, StagedScene
from ._lens_view import LensView
from ._output_pool import OutputPool, shapes_of
from ._painter import How, Painter
from ._turn import RendererTurn
from ._view import View
from ._viewpoint import Viewpoint, frustum_of
from .backend_selection import resolve_backend
from .camera_choice import CameraChoice
from .draw_list.placement import Placing
from .frame import Frame
from .options import OptionKeywords, RenderOptions, shows_options
from .passes.protocol import Picture, Shot

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .lens.lens_painter import LensPainter

#: By method and samples per pixel: samples shaded along an axis, and multisamples of each.
_SAMPLES = {
    "ssaa": {1: (1, 0), 4: (2, 0), 16: (4, 0)},
    "msaa": {1: (1, 0), 2: (1, 2), 4: (1, 4), 8: (1, 8), 16: (1, 16)},
}


class Renderer(Closed):
    """Draws frames of one size.

    Several renderers may draw in several threads at once; one renderer shared by threads draws one
    frame after the other.

    Parameters
    ----------
    size : (int, int)
        Width and height in pixels, 1 to 16384.
    backend : str
        One of `engine3d.backends`, or ``"auto"``: the environment variable ``ENGINE3D_BACKEND`` if
        set, else the fastest.
    threads : int
        0: ``ENGINE3D_THREADS`` if set, else all CPUs that this process may use.
    color_space : {"srgb", "linear"}
        ``"srgb"``: 8-bit colours and textures are decoded to linear light, and the result is
        encoded. ``"linear"``: 8-bit values are neither decoded nor encoded.
    samples : {1, 2, 4, 8, 16}
        Samples per pixel; more samples give smoother edges. 2 and 8 need ``antialiasing="msaa"``.
    antialiasing : {"ssaa", "msaa"}
        The antialiasing method. ``"ssaa"`` (supersampling) shades every sample; 1, 4 or 16 samples.
        ``"msaa"`` (multisampling, with Direct3D's standard patterns) shades each surface once per
        pixel, for all samples it covers. It is much faster and smooths edges equally, but not
        textures or highlights within a surface; outputs other than ``color`` then have one sample
        per pixel.

    Attributes
    ----------
    size : (int, int)
        Width and height; changed by `resize`.
    width, height : int
    backend : str
        The backend that draws.
    color_space : str
    samples : int
    antialiasing : str

    Raises
    ------
    InvalidArgumentError, BackendError, OutOfMemoryError
    """

    def __init__(
        self,
        size: tuple[int, int],
        *,
        backend: Backend = "auto",
        threads: int = 0,
        color_space: ColorSpace = "srgb",
        samples: Samples = 1,
        antialiasing: Antialiasing = "ssaa",
    ) -> None:
        self._size = check_size(size)
        self._color_space = choose(color_space, COLOR_SPACES, "color_space")
        self._antialias = choose(antialiasing, _SAMPLES, "antialiasing")
        self._samples = _check_samples(samples, self._antialias)
        number = resolve_backend(backend)
        self._backend = list(_native.BACKENDS)[number]
        threads = resolve_threads(threads)
        self._pool = OutputPool()
        self._turn = RendererTurn()
        per_pixel = _SAMPLES[antialiasing][samples]
        self._painter = Painter(How(number, threads, self._color_space, per_pixel), self._turn)
        self._viewpoint = Viewpoint(self._painter.draw_list)
        self._lens: LensPainter | None = None

    @property
    def size(self) -> tuple[int, int]:
        return self._size

    @property
    def width(self) -> int:
        return self._size[0]

    @property
    def height(self) -> int:
        return self._size[1]

    @property
    def backend(self) -> str:
        return self._backend

    @property
    def color_space(self) -> ColorSpace:
        return self._color_space

    @property
    def samples(self) -> Samples:
        return self._samples

    @property
    def antialiasing(self) -> Antialiasing:
        return self._antialias

    @hinted
    def resize(self, size: tuple[int, int]) -> None:
        """Change the size of future frames."""
        size = check_size(size)
        with self._turn:
            self._size = size
            self._forget_arrays()

    def close(self) -> None:
        """Free the renderer's memory; frames stay valid. Drawing afterwards raises an error."""
        with self._turn.taken(closing=True):
            # Nothing reads these again: `_check_drawable` refuses to draw.
            self._painter = self._viewpoint = None  # type: ignore[assignment]
            self._lens = None
            self._turn.let_go()
            self._pool.forget()

    def _forget_arrays(self) -> None:
        self._pool.forget()
        if self._painter is not None:
            self._painter.passes.forget()
        if self._lens is not None:
            self._lens.forget()

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a Renderer cannot be copied or pickled: make one in each process")

    def __enter__(self) -> Renderer:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    @shows_options
    def prepare(
        self,
        scene: AnyScene,
        *,
        options: RenderOptions | None = None,
        **keywords: Unpack[OptionKeywords],
    ) -> None:
        """Do the work of a scene's first frame in advance, so that it is as fast as later ones.

        Each mesh gets its clusters and missing normals or edges, each texture its mip levels. They
        stay with the mesh or texture, for every renderer. The renderer allocates memory for the
        outputs and, 8 bytes per sample, for the depths of occlusion culling.

        Parameters
        ----------
        scene : Scene
        options, **keywords
            As for `render`.

        Raises
        ------
        InvalidArgumentError, OutOfMemoryError
        """
        with self._turn:
            self._check_drawable(scene)
            painter = self._painter
            options = painter.options.named(options, keywords)
            frame_options = painter.options.get(scene, options, self.height)
            plan = painter.passes.plan(options, tuple(options.outputs), self._size)
            headlight = frame_options.headlight((0.0, 0.0, 1.0))
            listing, census = frame_options.listing(plan.listed), scene.data.census()
            try:
                painter.draw_list.update(scene.data, listing, headlight, Placing())
            except Exception as error:
                _blame_change(scene, census, error)
                raise
            self._pool.prepare(plan.outputs)
            axis, multiple = _SAMPLES[self._antialias][self._samples]
            painter.native.prepare(self.width * axis, self.height * axis, multiple or 1)

    def _check_drawable(self, scene: object) -> None:
        if not isinstance(scene, (Scene, StagedScene)):
            raise InvalidArgumentError(f"scene must be a Scene, not {type(scene).__name__}")
        if self._painter is None:
            raise InvalidArgumentError("the renderer is closed")

    @shows_options
    def render(
        self,
        scene: AnyScene,
        camera: CameraChoice = None,
        *,
        out: Frame | None = None,
        culling_camera: CameraChoice = None,
        options: RenderOptions | None = None,
        **keywords: Unpack[OptionKeywords],
    ) -> Frame:
        """Draw a frame.

        Parameters
        ----------
        scene : Scene
        camera : None, Node or (Camera, pose)
            A node of this scene. None uses its first visible camera; a scene without one is framed
            automatically.
        out : Frame, optional
            An earlier frame of the same size to draw into; its outputs are redrawn, and it is
            returned.
        culling_camera : Node or (Camera, pose), optional
            Cull for this camera but draw from ``camera``, to see the effect of culling.
        options : RenderOptions, optional
            Replaces its keyword arguments, which must then be left out.
        **keywords
            Those of `RenderOptions`: ``mode``, ``wireframe``, ``outputs`` and so on.

        Returns
        -------
        frame : Frame

        Raises
        ------
        InvalidArgumentError, OutOfMemoryError
        RendererBusyError
            A signal handler, or other code that ran within a frame of this renderer, requested
            another one; or the process was forked from within a frame.
        SceneChangedError
            Another thread added or removed nodes, and the frame could not be drawn.
        KeyboardInterrupt
            Ctrl-C stops a frame between its tiles.
        """
        with self._turn:
            self._check_drawable(scene)
            options = self._painter.options.named(options, keywords)
            return self._draw(scene, camera, options, out, culling_camera)

    def _draw(
        self,
        scene: AnyScene,
        camera: CameraChoice,
        options: RenderOptions,
        out: Frame | None,
        culling_camera: CameraChoice,
    ) -> Frame:
        """Draw a frame; the caller holds the turn."""
        outputs = tuple(options.outputs if out is None else self._check_out(out).outputs)
        passes = self._painter.passes
        census, reads_scene = scene.data.census(), True
        try:
            view = self._viewpoint.look(scene, camera, *self._size)
        except Exception as error:
            _blame_change(scene, census, error)
            raise
        if isinstance(view, LensView):
            return self._draw_through(scene, view, options, outputs, out, culling_camera)
        plan = passes.plan(options, outputs, self._size)
        frame = Frame(self._size, self._pool.take(plan.outputs)) if out is None else out
        try:
            picture = self._look(scene, view, options, plan.listed, culling_camera)
            picture.targets, picture.arrays = passes.arrays(plan, frame._outputs)
            for one in plan.passes:
                reads_scene = "scene" in one.reads
                one.draw(picture)
                self._turn.check()
        except Exception as error:
            if reads_scene:
                _blame_change(scene, census, error)
            raise
        frame._seen = picture.view, "none" if options.cull == "auto" else options.cull
        frame._drawn = scene.data.node_count, picture.drawn
        return frame

    def _draw_through(
        self,
        scene: AnyScene,
        view: LensView,
        options: RenderOptions,
        outputs: tuple[str, ...],
        out: Frame | None,
        culling_camera: CameraChoice,
    ) -> Frame:
        """Draw a frame through a lens; the caller holds the turn."""
        from .lens.lens_painter import LensPainter, Through

        frozen = frustum_of(scene, culling_camera, *self._size)
        if self._lens is None:
            self._lens = LensPainter(self._painter.how, self._turn)
        shapes = shapes_of(outputs, *self._size)
        frame = Frame(self._size, self._pool.take(shapes)) if out is None else out
        census = scene.data.census()
        try:
            through = Through(scene, options, view, self._size, frozen)
            drawn = self._lens.draw(through, frame._outputs)
        except Exception as error:
            _blame_change(scene, census, error)
            raise
        frame._seen = view, "none" if options.cull == "auto" else options.cull
        frame._drawn = scene.data.node_count, drawn
        return frame

    def _look(
        self,
        scene: AnyScene,
        view: View,
        options: RenderOptions,
        listed: tuple[str, ...],
        culling_camera: CameraChoice,
    ) -> Picture:
        """Update the draw list, and return the picture that the passes start with."""
        frozen = frustum_of(scene, culling_camera, *self._size)
        shot = Shot(view, self._size, self.height, view.towards_viewer, frozen)
        return self._painter.look(scene, options, listed, shot)

    def _check_out(self, out: Frame) -> Frame:
        if not isinstance(out, Frame):
            raise InvalidArgumentError(f"out must be a Frame, not {type(out).__name__}")
        if out.size != self._size:
            raise InvalidArgumentError(
                f"out must be {self.width}x{self.height}, not {out.width}x{out.height}"
            )
        return out

    def __repr__(self) -> str:
        return f"<Renderer {self.width}x{self.height}, {self._backend}>"


def _check_samples(samples: Samples, antialiasing: Antialiasing) -> Samples:
    """Check the number of samples; on an error, name the method that supports it."""
    others = [how for how, numbers in _SAMPLES.items() if is_one_of(samples, numbers)]
    if others and antialiasing not in others:
        raise InvalidArgumentError(
            f"samples={samples} needs antialiasing={others[0]!r}: with antialiasing="
            f"{antialiasing!r} it is one of {', '.join(map(str, _SAMPLES[antialiasing]))}"
        )
    return choose(samples, _SAMPLES[antialiasing], "samples")


def _blame_change(scene: AnyScene, census: tuple[Any, ...], error: Exception) -> None:
    """If nodes came or went since a census, replace an error with one that says so."""
    if scene.data.census() != census:
        raise SceneChangedError(
            "nodes were added to the scene or removed while it was drawn: change a scene between "
            "frames, not from another thread during one"
        ) from error
