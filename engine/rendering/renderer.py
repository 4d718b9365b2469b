"""The renderer: draws scenes into frames on the CPU.

In: a `Scene`, a camera and the options of a picture. Out: a `Frame` with the outputs asked for;
what isn't asked for isn't computed. One call of the core per frame, without the GIL. The same scene
gives the same bytes on every backend and every number of threads.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from .._native import rasterizer as _native
from .._support.image_size import check_side, check_size
from .._support.validation import Closed, choose
from ..choices import (
    Antialias,
    Backend,
    ColorLike,
    ColorSpace,
    Cull,
    Culling,
    HiddenSurfaces,
    Mode,
    Normals,
    Samples,
    Shading,
    Wireframe,
)
from ..errors import InvalidArgumentError, SceneChangedError
from ..materials.colors import COLOR_SPACES
from ..scene.cameras import Camera
from ..scene.scene import Scene
from ._draw_list import DrawList
from ._frame_options import OptionsCache
from ._output_pool import OutputPool
from ._turn import RendererTurn
from ._view import CameraChoice, View, find_camera
from .backend_selection import resolve_backend, resolve_threads
from .frame import OUTPUTS, Frame, Output
from .framing import frame_scene
from .options import WHITE, RenderKeywords, RenderOptions, either

if TYPE_CHECKING:
    from typing_extensions import Unpack

#: By method and samples per pixel: how many are shaded along an axis, and multisampled in each.
_SAMPLES = {
    "ssaa": {1: (1, 0), 4: (2, 0), 16: (4, 0)},
    "msaa": {1: (1, 0), 2: (1, 2), 4: (1, 4), 8: (1, 8), 16: (1, 16)},
}


class Renderer(Closed):
    """Draws frames of one size.

    Several renderers may draw in several threads at once; one renderer used from several threads
    draws one frame after the other.

    Parameters
    ----------
    width, height : int
        Pixels, 1 to 16384.
    backend : str
        One of `engine3d.backends`, or ``"auto"``: what the environment variable
        ``ENGINE3D_BACKEND`` says, else the fastest.
    threads : int
        0: what ``ENGINE3D_THREADS`` says, else all CPUs that this process may use.
    color_space : {"srgb", "linear"}
        ``"srgb"``: 8-bit colours and textures are decoded to linear light, the result is encoded.
        ``"linear"``: 8-bit values are taken as they are, and written so.
    samples : {1, 2, 4, 8, 16}
        Samples per pixel; more samples give smoother edges.
    antialias : {"ssaa", "msaa"}
        What happens at each sample. ``"ssaa"`` (supersampling): everything; 1, 4 or 16 samples.
        ``"msaa"`` (multisampling, in the standard patterns of Direct3D): each surface that shows in
        a pixel gets one colour there, for all samples that it covers. That takes much less time
        and smooths edges alike, but neither textures nor highlights within a surface. Other outputs
        than ``color`` are those of one sample a pixel then.

    Attributes
    ----------
    width, height : int
        `resize` changes them.
    backend : str
        The backend that draws.
    color_space : str
    samples : int
    antialias : str

    Raises
    ------
    InvalidArgumentError, BackendError, OutOfMemoryError
    """

    def __init__(
        self,
        width: int,
        height: int,
        *,
        backend: Backend = "auto",
        threads: int = 0,
        color_space: ColorSpace = "srgb",
        samples: Samples = 1,
        antialias: Antialias = "ssaa",
    ) -> None:
        self._width, self._height = check_side(width, "width"), check_side(height, "height")
        self._color_space = choose(color_space, COLOR_SPACES, "color_space")
        self._antialias = choose(antialias, _SAMPLES, "antialias")
        self._samples = choose(samples, _SAMPLES[antialias], "samples")
        number = resolve_backend(backend)
        self._backend = list(_native.BACKENDS)[number]
        threads = resolve_threads(threads)
        self._native = _native.NativeRenderer(number, threads)
        self._draw_list = DrawList(self._color_space, threads)
        self._options = OptionsCache(self._color_space, threads)
        self._pool = OutputPool()
        self._asked, self._wanted = (), {}
        self._view: View | None = None
        self._framing: tuple[Camera, np.ndarray] | None = None
        self._framed = ()
        self._turn = RendererTurn(self._native)

    @property
    def width(self) -> int:
        return self._width

    @property
    def height(self) -> int:
        return self._height

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
    def antialias(self) -> Antialias:
        return self._antialias

    def resize(self, width: int, height: int) -> None:
        """Change the size of the frames to come."""
        width, height = check_side(width, "width"), check_side(height, "height")
        with self._turn.taken():
            self._width, self._height = width, height
            self._asked = ()
            self._pool.forget()

    def close(self) -> None:
        """Free what the renderer holds; frames stay valid. Drawing afterwards raises."""
        with self._turn.taken(closing=True):
            self._native = self._draw_list = None
            self._turn.let_go()
            self._pool.forget()

    def __reduce_ex__(self, protocol):
        raise TypeError("a Renderer cannot be copied or pickled: make one in each process")

    def __enter__(self) -> Renderer:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def prepare(
        self,
        scene: Scene,
        *,
        mode: Mode = "lit",
        wireframe: Wireframe | None = None,
        outputs: Iterable[Output] = ("color",),
        normals: Normals = "auto",
        options: RenderOptions | None = None,
    ) -> None:
        """Do beforehand what the first frame of a scene would do, so that it is as fast as others.

        Each mesh gets its clusters and the normals or edges that are missing, each texture its mip
        levels. They stay with the mesh or the texture, for every renderer. The renderer allocates
        memory for the outputs and, 8 bytes per sample, for the depths that tell what is hidden.

        Parameters
        ----------
        scene : Scene
        mode, wireframe, outputs, normals, options
            As the frames will be drawn: see `render`.

        Raises
        ------
        InvalidArgumentError, OutOfMemoryError
        """
        with self._turn.taken():
            self._check_drawable(scene)
            keywords = RenderOptions(
                mode=mode, wireframe=wireframe, outputs=outputs, normals=normals
            )
            options = either(options, keywords)
            frame_options = self._options.get(scene, options)
            headlight = (*frame_options.headlight, (0.0, 0.0, 1.0))
            needs = frame_options.needs(options.outputs)
            census = scene._census()
            try:
                self._draw_list.update(scene, needs, options.normals, headlight, None, 0.0, True)
            except Exception as error:
                _blame_change(scene, census, error)
                raise
            self._pool.prepare(self._arrays_of(options.outputs))
            axis, multiple = _SAMPLES[self._antialias][self._samples]
            self._native.prepare(self._width * axis, self._height * axis, multiple or 1)

    def _check_drawable(self, scene) -> None:
        if not isinstance(scene, Scene):
            raise InvalidArgumentError(f"scene must be a Scene, not {type(scene).__name__}")
        if self._native is None:
            raise InvalidArgumentError("the renderer is closed")

    def render(
        self,
        scene: Scene,
        camera: CameraChoice = None,
        *,
        mode: Mode = "lit",
        wireframe: Wireframe | None = None,
        cull: Cull = "back",
        shading: Shading = "deferred",
        outputs: Iterable[Output] = ("color",),
        out: Frame | None = None,
        normals: Normals = "auto",
        hidden_surfaces: HiddenSurfaces = "zbuffer",
        line_width: float = 1.0,
        line_color: ColorLike = WHITE,
        hidden_lines: bool = False,
        point_size: float = 1.0,
        culling: Culling = "all",
        culling_camera: CameraChoice = None,
        batching: bool = True,
        transparent_outputs: bool = False,
        alpha_to_coverage: bool = False,
        options: RenderOptions | None = None,
    ) -> Frame:
        """Draw a frame.

        Parameters
        ----------
        scene : Scene
        camera : None, Node or (Camera, pose)
            A node of this scene. None is its first visible camera; a scene without one is framed
            automatically.
        mode : {"lit", "unlit", "random", "depth", "normal", "triangle_id", "object_id", "overdraw"}
            What the colour shows: light, plain surface colour, a random colour per triangle,
            nearness, view-space normals, identities as colours, or how often each pixel was
            covered.
        wireframe : {None, "overlay", "only"}
            Draw the visible edges over the picture, or instead of its faces.
        cull : {"back", "front", "none"}
            Which faces are left out: those that show their back, or those that show their front.
        shading : {"deferred", "forward"}
            When pixels are shaded: once each, or as they are drawn. Both give the same bytes.
        outputs : iterable of str
            Which arrays the frame holds: ``color``, ``depth``, ``ndc_depth``, ``triangle_id``,
            ``object_id``, ``instance_id``, ``material_id``, ``albedo``, ``normal``, ``position``,
            ``world_normal``, ``world_position``, ``uv``, ``barycentric``.
        out : Frame, optional
            An earlier frame of the same size to draw into; its outputs are drawn, and it is
            returned.
        normals : {"auto", "smooth", "flat"}
            Vertex or face normals; ``"auto"`` follows each material's ``flat_shading``.
        hidden_surfaces : {"zbuffer", "painter", "none"}
            The method of hidden-surface removal: depth buffer, painter's algorithm (drawing from
            far to near), or none.
        line_width, point_size : float
            Pixels, more than 0 and up to 256.
        line_color : sequence of 3 numbers
            Colour of the wireframe.
        hidden_lines : bool
            With ``wireframe="only"``: show the edges that faces hide as well.
        culling : {"all", "tree", "frustum", "none", "always"}
            What is left out before it is drawn. ``"all"``: nodes and parts of meshes outside of the
            view frustum, or that face away, and what is hidden by what is drawn already, tested
            where that may pay; ``"always"`` tests it in every frame. ``"tree"``: only nodes (and
            instances) outside of the frustum, found by the scene's tree of boxes. ``"frustum"``:
            the same ones, found by testing their boxes one by one. ``"none"``: nothing.
            The picture is the same; ``frame.stats["boxes_tested"]`` counts the tests.
        culling_camera : Node or (Camera, pose), optional
            Cull as seen from this camera, but draw as seen from ``camera``, to look at what culling
            leaves out.
        batching : bool
            Hand nodes of the same mesh to the core as one draw. The picture is the same.
        transparent_outputs : bool
            Outputs other than ``color`` are of the nearest surface, even if it is blended; else of
            the nearest that isn't. Modes other than "lit" and "unlit" show blended surfaces as
            opaque ones anyway.
        alpha_to_coverage : bool
            With ``antialias="msaa"``: the alpha of materials of ``alpha_mode="mask"`` tells how
            many of a pixel's samples they cover, half of them at ``alpha_cutoff``: foliage gets
            smooth edges. Else alpha leaves all that they cover, or none.
        options : RenderOptions, optional
            Instead of the arguments above that it holds, which must then be left out.

        Returns
        -------
        frame : Frame

        Raises
        ------
        InvalidArgumentError, OutOfMemoryError
        RendererBusyError
            A signal handler, or something else that ran within a frame of this renderer, asked for
            another one; or the process was forked from within a frame.
        SceneChangedError
            Another thread added or removed nodes meanwhile, and the frame could not be drawn.
        KeyboardInterrupt
            Ctrl-C stops a frame between its tiles.
        """
        with self._turn.taken():
            self._check_drawable(scene)
            given = (
                mode,
                wireframe,
                cull,
                shading,
                normals,
                hidden_surfaces,
                line_width,
                line_color,
                hidden_lines,
                point_size,
                culling,
                batching,
                transparent_outputs,
                alpha_to_coverage,
            )
            named = self._options.of_keywords(given, outputs)
            return self._draw(scene, camera, either(options, named), out, culling_camera)

    def _draw(
        self,
        scene: Scene,
        camera: CameraChoice,
        options: RenderOptions,
        out: Frame | None,
        culling_camera: CameraChoice,
    ) -> Frame:
        """Draw a frame in the turn that the caller has."""
        frame_options = self._options.get(scene, options)
        frame = self._new_frame(options.outputs) if out is None else self._check_out(out)
        census = scene._census()
        try:
            view = self._look(scene, camera)
            headlight = (*frame_options.headlight, view.towards_viewer)
            chosen = None
            if culling_camera is not None:
                chosen = self._clip_from_world(scene, culling_camera)
            frustum = view.clip_from_world if chosen is None else chosen
            self._draw_list.update(
                scene,
                frame_options.needs(frame.outputs),
                options.normals,
                headlight,
                None if options.culling == "none" else frustum,
                frame_options.mark_size / min(self._width, self._height),
                options.batching,
                options.culling == "frustum",
            )
            near, far = 0.0, 1.0
            if options.mode == "depth":
                near, far = view.depth_range(scene.bounds)
        except Exception as error:
            _blame_change(scene, census, error)
            raise
        drawn = self._native.render(
            self._draw_list.native,
            frame._outputs,
            frame_options.native,
            self._width,
            self._height,
            *_SAMPLES[self._antialias][self._samples],
            view.clip_from_world,
            view.view_from_world,
            view.eye,
            id(view.camera),
            near,
            far,
            chosen,
            view.rays if frame_options.has_backdrop else None,
        )
        self._turn.check()
        frame._seen = view, options.cull
        frame._drawn = scene._arrays.count - scene._removed, drawn
        return frame

    def _clip_from_world(self, scene: Scene, camera) -> np.ndarray:
        camera, pose = find_camera(scene, camera)
        return View(camera, pose, self._width, self._height).clip_from_world

    def _new_frame(self, outputs: tuple[str, ...]) -> Frame:
        if outputs is not self._asked:
            self._wanted, self._asked = self._arrays_of(outputs), outputs
        return Frame(self._width, self._height, self._pool.take(self._wanted))

    def _arrays_of(self, outputs: tuple[str, ...]) -> dict[str, tuple[tuple[int, ...], np.dtype]]:
        """Shape and dtype of each output."""
        wanted = {}
        for name in outputs:
            dtype, channels = OUTPUTS[name]
            shape = (self._height, self._width, channels)
            wanted[name] = (shape if channels else shape[:2], dtype)
        return wanted

    def _check_out(self, out: Frame) -> Frame:
        if not isinstance(out, Frame):
            raise InvalidArgumentError(f"out must be a Frame, not {type(out).__name__}")
        if (out.width, out.height) != (self._width, self._height):
            raise InvalidArgumentError(
                f"out must be {self._width}x{self._height}, not {out.width}x{out.height}"
            )
        return out

    def _look(self, scene: Scene, camera) -> View:
        """Find the camera; a view that has not changed is used again."""
        camera, pose = find_camera(scene, camera) or self._frame_scene(scene)
        view = self._view
        if view is None or not view.is_of(camera, pose, self._width, self._height):
            view = self._view = View(camera, pose, self._width, self._height, view)
        return view

    def _frame_scene(self, scene: Scene) -> tuple[Camera, np.ndarray]:
        """A camera that shows the whole scene, kept until something in it changes or moves."""
        state = self._draw_list.changes, self._width, self._height
        if self._framing is None or self._framed != state or not self._draw_list.shows(scene):
            self._framing = frame_scene(scene, aspect=self._width / self._height)
            self._framed = state
        return self._framing

    def __repr__(self) -> str:
        return f"<Renderer {self._width}x{self._height}, {self._backend}>"


def _blame_change(scene: Scene, census: tuple[int, int], error: Exception) -> None:
    """Raise, where nodes came or went since a census, an error that says so instead of another."""
    if scene._census() != census:
        raise SceneChangedError(
            "nodes were added to the scene or removed while it was drawn: change a scene between "
            "frames, not from another thread during one"
        ) from error


def render(
    scene: Scene,
    camera: CameraChoice = None,
    *,
    size: tuple[int, int] = (1280, 720),
    backend: Backend = "auto",
    threads: int = 0,
    color_space: ColorSpace = "srgb",
    samples: Samples = 1,
    antialias: Antialias = "ssaa",
    **options: Unpack[RenderKeywords],
) -> Frame:
    """Draw one frame of a scene.

    Parameters
    ----------
    scene : Scene
    camera : None, Node or (Camera, pose)
    size : (int, int)
        Width and height in pixels.
    backend, threads, color_space, samples, antialias
        As for `Renderer`.
    **options
        As for `Renderer.render`: ``mode``, ``wireframe``, ``outputs`` and so on.

    Returns
    -------
    frame : Frame

    Raises
    ------
    InvalidArgumentError, BackendError, OutOfMemoryError
    """
    width, height = check_size(size)
    with Renderer(
        width,
        height,
        backend=backend,
        threads=threads,
        color_space=color_space,
        samples=samples,
        antialias=antialias,
    ) as renderer:
        return renderer.render(scene, camera, **options)
