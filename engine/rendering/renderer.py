"""The renderer: draws scenes into frames on the CPU.

In: a `Scene`, a camera and the options of a picture. Out: a `Frame` with the outputs asked for;
what isn't asked for isn't computed. One call of the core per frame, without the GIL. The same scene
gives the same bytes on every backend and every number of threads.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .._native import rasterizer as _native
from .._support.calls import hinted, refuse_unknown
from .._support.image_size import check_side, check_size
from .._support.validation import Closed, choose, is_one_of
from ..choices import (
    Antialias,
    Backend,
    ColorLike,
    ColorSpace,
    Culling,
    FrameCull,
    HiddenSurfaces,
    LineShape,
    Mode,
    Normals,
    PointShape,
    Samples,
    Shading,
    SizeUnit,
    ToneMapping,
    Wireframe,
)
from ..errors import InvalidArgumentError, SceneChangedError
from ..geometry.mesh import Mesh
from ..materials.colors import COLOR_SPACES
from ..scene.instances import InstancedMesh
from ..scene.nodes import Node
from ..scene.scene import Scene
from ..scene.scenes_of_things import scene_of
from ..scene.staged_scene import StagedScene
from ._ambient_occlusion import AmbientOcclusion, radius_of, shows_occlusion
from ._bloom import Bloom
from ._draw_list import DrawList
from ._exact_shadows import ExactShadows
from ._frame_memory import FrameMemory
from ._frame_options import OptionsCache
from ._output_pool import OutputPool, shapes_of
from ._shadow_maps import ShadowMaps
from ._surface_pass import SurfacePass
from ._turn import RendererTurn
from ._view import CameraChoice
from ._viewpoint import Viewpoint, frustum_of
from .backend_selection import resolve_backend, resolve_threads
from .frame import Frame, Output
from .options import WHITE, RenderKeywords, RenderOptions, either, shows_light, with_both_sides

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
        Samples per pixel; more samples give smoother edges. 2 and 8 need ``antialias="msaa"``.
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
        self._samples = _check_samples(samples, self._antialias)
        number = resolve_backend(backend)
        self._backend = list(_native.BACKENDS)[number]
        threads = resolve_threads(threads)
        self._native = _native.NativeRenderer(number, threads)
        self._draw_list = DrawList(self._color_space, threads)
        self._shadow_maps = ShadowMaps(self._native, self._draw_list)
        self._exact_shadows = ExactShadows(self._draw_list)
        self._options = OptionsCache(self._color_space, threads)
        self._pool = OutputPool()
        self._bloom = Bloom(number, threads, self._color_space == "srgb")
        self._asked, self._wanted = (), {}
        self._viewpoint = Viewpoint(self._draw_list)
        self._surfaces = SurfacePass()
        self._occlusion = AmbientOcclusion(number, threads)
        self._memory = FrameMemory(*_SAMPLES[antialias][samples], threads)
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
            self._forget_arrays()

    def close(self) -> None:
        """Free what the renderer holds; frames stay valid. Drawing afterwards raises."""
        with self._turn.taken(closing=True):
            self._native = self._draw_list = self._viewpoint = None
            self._shadow_maps = self._exact_shadows = None
            self._turn.let_go()
            self._forget_arrays()

    def _forget_arrays(self) -> None:
        for memory in (self._pool, self._bloom, self._surfaces, self._occlusion):
            memory.forget()

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
            frame_options = self._options.get(scene, options, self._height)
            headlight = (*frame_options.headlight, (0.0, 0.0, 1.0))
            needs = frame_options.needs(options.outputs)
            census = scene._census()
            try:
                self._draw_list.update(
                    scene,
                    needs,
                    options.normals,
                    headlight,
                    None,
                    0.0,
                    True,
                    by_mesh=options.cull == "auto",
                )
            except Exception as error:
                _blame_change(scene, census, error)
                raise
            self._memory.begin(options, self._width, self._height)
            self._pool.prepare(shapes_of(options.outputs, self._width, self._height))
            axis, multiple = _SAMPLES[self._antialias][self._samples]
            self._native.prepare(self._width * axis, self._height * axis, multiple or 1)

    def _check_drawable(self, scene) -> None:
        if not isinstance(scene, (Scene, StagedScene)):
            raise InvalidArgumentError(f"scene must be a Scene, not {type(scene).__name__}")
        if self._native is None:
            raise InvalidArgumentError("the renderer is closed")

    @hinted
    @hinted
    def render(
        self,
        scene: Scene,
        camera: CameraChoice = None,
        *,
        mode: Mode = "lit",
        wireframe: Wireframe | None = None,
        cull: FrameCull = "back",
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
        tone_mapping: ToneMapping = "none",
        bloom: float = 0.0,
        line_shape: LineShape = "plain",
        point_shape: PointShape = "square",
        size_unit: SizeUnit = "pixels",
        alpha_to_coverage: bool = False,
        ambient_occlusion: bool = False,
        ambient_occlusion_radius: float | None = None,
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
        cull : {"back", "front", "none", "auto"}
            Which faces are left out: those that show their back, or those that show their front.
            ``"auto"`` shows both sides, but leaves the backs out of opaque meshes that enclose a
            volume, their fronts outside, where the picture is the same.
        shading : {"deferred", "forward"}
            When pixels are shaded: once each, or as they are drawn. Both give the same bytes.
        outputs : iterable of str
            Which arrays the frame holds: ``color``, ``depth``, ``ndc_depth``, ``triangle_id``,
            ``object_id``, ``instance_id``, ``material_id``, ``albedo``, ``normal``, ``position``,
            ``world_normal``, ``world_position``, ``uv``, ``barycentric``, ``metallic_roughness``,
            ``emissive``, ``tangent``, ``radiance``: see `Frame`.
        out : Frame, optional
            An earlier frame of the same size to draw into; its outputs are drawn, and it is
            returned.
        normals : {"auto", "smooth", "flat", "facet"}
            Vertex or face normals; ``"auto"`` follows each material's ``flat_shading``. With
            ``"facet"`` each triangle also has one light, that of its middle.
        hidden_surfaces : {"zbuffer", "painter", "none"}
            The method of hidden-surface removal: depth buffer, painter's algorithm (drawing from
            far to near), or none.
        line_width, point_size : float
            In ``size_unit``, more than 0 and up to 256.
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
            the nearest that isn't. ``radiance`` has all layers in any case. Modes other than "lit"
            and "unlit" show blended surfaces as opaque ones anyway.
        tone_mapping : {"none", "neutral", "aces", "agx"}
            How light of any brightness becomes what a screen can show, in mode "lit": of lit
            surfaces and of an environment behind them. ``"none"`` shows what is above 1 as 1;
            ``"neutral"`` (Khronos PBR Neutral) keeps colours up to 0.8 and makes room above;
            ``"aces"`` and ``"agx"`` look like film, the latter with softer contrast.
        bloom : float
            How much of the light above 1 glows around where it comes from, in modes "lit" and
            "unlit", 0 to 100; 1 is a lot. It changes no alpha, so that before a transparent
            background only what is drawn glows.
        line_shape : {"plain", "round"}
            Of lines and of a wireframe's edges. ``"plain"``: their ends are cut along a row or a
            column, and lines of up to a pixel take one pixel for each step, so that slanted ones
            are thinner across. ``"round"``: as wide as they say at any angle, with half a disc at
            each end, so that lines that meet have round joins.
        point_shape : {"square", "round"}
        size_unit : {"pixels", "picture"}
            What line_width and point_size count: pixels, or thousandths of the picture's height, so
            that a scene looks alike at every size; of these at least 1 pixel is drawn, and at
            most 256.
        alpha_to_coverage : bool
            With ``antialias="msaa"``: the alpha of materials of ``alpha_mode="mask"`` tells how
            many of a pixel's samples they cover, half of them at ``alpha_cutoff``: foliage gets
            smooth edges. Else alpha leaves all that they cover, or none.
        ambient_occlusion : bool
            In mode "lit": less of the light from all around reaches corners and hollows.
        ambient_occlusion_radius : float, optional
            World units: what is farther away is in no light's way. By default a share of the
            diagonal of the scene's box.
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
                tone_mapping,
                bloom,
                line_shape,
                point_shape,
                size_unit,
                alpha_to_coverage,
                ambient_occlusion,
                ambient_occlusion_radius,
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
        frame_options = self._options.get(scene, options, self._height)
        self._memory.begin(options, self._width, self._height)
        frame = self._new_frame(options.outputs) if out is None else self._check_out(out)
        census = scene._census()
        try:
            view = self._viewpoint.look(scene, camera, self._width, self._height)
            headlight = (*frame_options.headlight, view.towards_viewer)
            chosen = frustum_of(scene, culling_camera, self._width, self._height)
            frustum = view.clip_from_world if chosen is None else chosen
            by_mesh = options.cull == "auto"
            self._draw_list.update(
                scene,
                frame_options.needs(frame.outputs),
                options.normals,
                headlight,
                None if options.culling == "none" else frustum,
                frame_options.mark_size / min(self._width, self._height),
                options.batching,
                options.culling == "frustum",
                by_mesh,
            )
            shadow_cull = options.cull
            self._draw_list.native.close_windows()
            if by_mesh:
                windows = self._draw_list.open_windows(scene, view, (self._width, self._height))
                shadow_cull = "none" if self._draw_list.has_holes else "back"
                if windows is None:
                    frame_options = self._options.get(scene, with_both_sides(options), self._height)
            if options.mode == "lit" and shows_light(frame.outputs):
                self._shadow_maps.update(scene, view, shadow_cull, self._memory)
                self._turn.check()
                self._exact_shadows.update(scene, self._memory)
            near, far = 0.0, 1.0
            if options.mode == "depth":
                near, far = view.depth_range(scene.bounds)
        except Exception as error:
            _blame_change(scene, census, error)
            raise
        visibility = None
        if shows_occlusion(options, frame.outputs):
            depth = self._surfaces.draw(
                *(self._native, self._draw_list, frame_options, view),
                (self._width, self._height),
                ("depth",),
                frozen_clip_from_world=chosen,
            )["depth"]
            visibility = self._occlusion.find(depth, view, radius_of(options, scene.bounds))
        targets = self._bloom.targets(frame._outputs, options)
        drawn = self._native.render(
            self._draw_list.native,
            targets,
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
            visibility,
        )
        self._turn.check()
        drawn.shadow_maps, drawn.shadow_maps_drawn = (
            self._shadow_maps.count,
            self._shadow_maps.drawn,
        )
        self._bloom.add(targets, options)
        frame._seen = view, "none" if by_mesh else options.cull
        frame._drawn = scene._arrays.count - scene._removed, drawn
        return frame

    def _new_frame(self, outputs: tuple[str, ...]) -> Frame:
        if outputs is not self._asked:
            self._wanted = shapes_of(outputs, self._width, self._height)
            self._asked = outputs
        return Frame(self._width, self._height, self._pool.take(self._wanted))

    def _check_out(self, out: Frame) -> Frame:
        if not isinstance(out, Frame):
            raise InvalidArgumentError(f"out must be a Frame, not {type(out).__name__}")
        if (out.width, out.height) != (self._width, self._height):
            raise InvalidArgumentError(
                f"out must be {self._width}x{self._height}, not {out.width}x{out.height}"
            )
        return out

    def __repr__(self) -> str:
        return f"<Renderer {self._width}x{self._height}, {self._backend}>"


def _check_samples(samples: Samples, antialias: Antialias) -> Samples:
    """Check a number of samples, and name the method that has it where another was chosen."""
    others = [how for how, numbers in _SAMPLES.items() if is_one_of(samples, numbers)]
    if others and antialias not in others:
        raise InvalidArgumentError(
            f"samples={samples} needs antialias={others[0]!r}: with antialias={antialias!r} it is "
            f"one of {', '.join(map(str, _SAMPLES[antialias]))}"
        )
    return choose(samples, _SAMPLES[antialias], "samples")


#: What `render` takes for the renderer that it makes.
_RENDERER_KEYWORDS = ("size", "backend", "threads", "color_space", "samples", "antialias")


def _blame_change(scene: Scene, census: tuple[int, int], error: Exception) -> None:
    """Raise, where nodes came or went since a census, an error that says so instead of another."""
    if scene._census() != census:
        raise SceneChangedError(
            "nodes were added to the scene or removed while it was drawn: change a scene between "
            "frames, not from another thread during one"
        ) from error


def render(
    scene: Scene | Node | Mesh | InstancedMesh | Any,
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
    """Draw one frame of a scene, of a part of one, or of a mesh alone.

    Parameters
    ----------
    scene : Scene, Node, Mesh, InstancedMesh, or a scene or geometry of trimesh
        What is no scene is drawn before black. Of a node, all below it is drawn, where it is in the
        world, in the light of those lights that are among it.
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
    refuse_unknown("render", options, (*RenderKeywords.__annotations__, *_RENDERER_KEYWORDS))
    width, height = check_size(size)
    drawn = scene_of(scene)
    if drawn is None:
        raise InvalidArgumentError(
            f"a scene, a node or a mesh can be drawn, not {type(scene).__name__}"
        )
    with Renderer(
        width,
        height,
        backend=backend,
        threads=threads,
        color_space=color_space,
        samples=samples,
        antialias=antialias,
    ) as renderer:
        return renderer.render(drawn, camera, **options)
