"""The public renderer: draws anything drawable, in a look where it has no light of its own.

In: a thing, a camera and options. Out: a `Frame`. Scenes with light of their own go to the renderer
of scenes as they are; everything else is staged as ``engine3d render`` stages models, and the stage
is kept until the thing changes.
"""

from __future__ import annotations

import threading
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.calls import hinted
from ..base.validation import flag
from ..choices import Antialiasing, Backend, ColorSpace, Samples
from ..model.materials.material import Material
from ..model.scene.scene import Scene
from ..model.scene.staged_scene import AnyScene, StagedScene
from ..rendering import renderer as rendering
from ..rendering.camera_choice import find_camera
from ..rendering.frame import Frame
from ..rendering.framing import frame_scene
from ..rendering.options import (
    DEFAULTS,
    OUTPUT_MODES,
    OptionKeywords,
    RenderOptions,
    checked_options,
    drawn_mode,
    shows_options,
)
from .appearance import BARE, DARK
from .kept_stages import KeptStages, Stage
from .look import Look, LookChoice, check_look
from .near_origin import pose_from_file
from .output_pictures import COVERAGE, paint
from .overlays.numbers import MarkKeywords, Marks, take_marks
from .painting import check_material
from .scene_bounds import bounding_sphere
from .scenes_of_things import is_lit
from .viewed_thing import comes_from_file, is_file
from .views.camera_view import AnyView, CameraView

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ..model.scene.cameras import Camera
    from ..rendering.camera_choice import CameraChoice
    from .viewed_scene import ViewedScene

_PLAIN = Look.plain()


class DrawingKeywords(OptionKeywords, MarkKeywords, total=False):
    """The keyword arguments of `Renderer.render` for options, and for numbers to show."""

    edges: bool


class Renderer(rendering.Renderer):
    """Draws frames of one size.

    Several renderers may draw in several threads at once; one renderer shared by threads draws one
    frame after the other. A renderer stages a thing once, and again after it has changed: files,
    meshes, instances and scenes; nodes, arrays and objects of other libraries each time.

    Parameters
    ----------
    size : (int, int)
        Width and height in pixels, 1 to 16384.
    look : {"studio", "plain"} or Look
        How things without light of their own are drawn: all but scenes, and nodes with their
        subtrees, that have a light, an environment or ambient light. ``"studio"`` draws them as
        ``engine3d render`` does; ``"plain"`` adds nothing.
    material : Material, optional
        Everything is drawn in this material; the models keep theirs.
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
    antialiasing : {"msaa", "ssaa"}
        The antialiasing method. ``"msaa"`` (multisampling, with Direct3D's standard patterns)
        shades each surface once per pixel, for all samples it covers. ``"ssaa"`` (supersampling)
        shades every sample; 1, 4 or 16 samples. It is much slower and smooths edges equally, but
        also textures and highlights within a surface, and outputs other than ``color``, which with
        ``"msaa"`` have one sample per pixel.

    Attributes
    ----------
    size : (int, int)
        Width and height; changed by `resize`.
    width, height : int
    look : Look
    material : Material or None
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
        look: LookChoice = "studio",
        material: Material | None = None,
        backend: Backend = "auto",
        threads: int = 0,
        color_space: ColorSpace = "srgb",
        samples: Samples = 4,
        antialiasing: Antialiasing = "msaa",
    ) -> None:
        self._worn, self._paint = check_look(look), check_material(material)
        self._is_plain = self._worn == _PLAIN
        super().__init__(
            size,
            backend=backend,
            threads=threads,
            color_space=color_space,
            samples=samples,
            antialiasing=antialiasing,
        )
        self._drawing = {"backend": self.backend, "threads": threads, "antialiasing": antialiasing}
        self._of_thread = threading.local()  # stages are changed by drawing

    @property
    def look(self) -> Look:
        return self._worn

    @property
    def material(self) -> Material | None:
        return self._paint

    @hinted
    def resize(self, size: tuple[int, int]) -> None:
        """Change the size of future frames."""
        with self._turn.taken(staging=True):
            super().resize(size)

    def close(self) -> None:
        """Free the renderer's memory; frames stay valid. Drawing afterwards raises an error."""
        with self._turn.taken(closing=True, staging=True):
            super().close()
            self._of_thread = threading.local()

    @shows_options
    def prepare(
        self,
        scene: Any,
        *,
        options: RenderOptions | None = None,
        **keywords: Unpack[DrawingKeywords],
    ) -> None:
        """Do the work of a thing's first frame in advance, so that it is as fast as later ones.

        Each mesh gets its clusters and missing normals or edges, each texture its mip levels. They
        stay with the mesh or texture, for every renderer. The renderer allocates memory for the
        outputs and, 8 bytes per sample, for the depths of occlusion culling.

        Parameters
        ----------
        scene : path-like, Scene, Node, Mesh, InstancedMesh, array, or another library's object
            Arrays are as for `render`. Other libraries are trimesh, PyVista, meshio, Open3D,
            CadQuery and build123d.
        options, **keywords
            As for `render`.

        Raises
        ------
        InvalidArgumentError, OutOfMemoryError, FileFormatError, FileAccessError
        """
        marks, named = _take_marks(keywords)
        if not marks.shows_any and self._is_drawn_as_it_is(scene):
            super().prepare(scene, options=_beneath(checked_options(options, named)))
            return
        with self._turn.taken(staging=True):
            chosen, given = _chosen(options, named)
            stage = self._stage_of(scene, given, marks)
            super().prepare(stage.view_renderer.staging.scene, options=_beneath(chosen))

    @shows_options
    def render(
        self,
        scene: Any,
        camera: CameraChoice = None,
        *,
        out: Frame | None = None,
        culling_camera: CameraChoice = None,
        options: RenderOptions | None = None,
        **keywords: Unpack[DrawingKeywords],
    ) -> Frame:
        """Draw a frame.

        Parameters
        ----------
        scene : path-like, Scene, Node, Mesh, InstancedMesh, array, or another library's object
            Arrays are as for `render`. Other libraries are trimesh, PyVista, meshio, Open3D,
            CadQuery and build123d.
            A file is opened and seen as by ``engine3d render``. Of a node its subtree is drawn, at
            its world pose.
        camera : None, Node or (Camera, pose)
            A node of this scene. None uses its first visible camera; without one, all of the thing
            shows. The cameras of files count only if they are loaded as scenes. The pose for a file
            is in its coordinates.
        out : Frame, optional
            An earlier frame of the same size to draw into; its outputs are redrawn, and it is
            returned.
        culling_camera : Node or (Camera, pose), optional
            Cull for this camera but draw from ``camera``, to see the effect of culling.
        options : RenderOptions, optional
            Replaces its keyword arguments, which must then be left out. A look replaces those of
            its options that have their default.
        color_by : str or array, optional
            Show numbers as colours instead of the surfaces' own: a name in ``mesh.values``,
            ``"x"``, ``"y"`` or ``"z"``, the coordinates, or ``"normals"``; or an array, (N,) or
            (N, K), for the vertices, faces or points of the only mesh. Where there is no number
            (NaN), it is grey. By default, with any of the parameters below up to ``bar``, the first
            name in alphabetical order, or else the height.
        colormap : str, colour map of matplotlib, or (N, 3) array, optional
            ``"viridis"``, the default, ``"plasma"``, ``"inferno"``, ``"magma"``, ``"turbo"``,
            ``"coolwarm"`` or ``"gray"``; the path of a picture whose middle row it is; places from
            0 to 1 with their colours, such as ``"0,#000000,0.4,red,1,white"``; or display colours,
            lowest number first.
        clim : (float, float), optional
            The numbers of the first and last colour; by default the lowest and highest finite
            number.
        component : int, optional
            Which number of rows with several, from 0 on; -1, the default: their length; -2: they
            are colours.
        on : {"vertices", "faces", "points"}, optional
            What the numbers belong to, if their name or their length leaves that open.
        bar : bool
            Show which colour is which number.
        axes_grid : bool
            Show a grid behind the scene, with coordinates.
        edges : bool
            Draw the edges of faces over them: ``wireframe="overlay"``.
        **keywords
            Those of `RenderOptions`: ``mode``, ``wireframe``, ``outputs`` and so on.

        Returns
        -------
        frame : Frame

        Raises
        ------
        InvalidArgumentError, OutOfMemoryError, FileFormatError, FileAccessError
        RendererBusyError
            A signal handler, or other code that ran within a frame of this renderer, requested
            another one; or the process was forked from within a frame.
        SceneChangedError
            Another thread added or removed nodes, and the frame could not be drawn.
        KeyboardInterrupt
            Ctrl-C stops a frame between its tiles.
        """
        marks, named = _take_marks(keywords)
        if not marks.shows_any and self._is_drawn_as_it_is(scene):
            passed: Any = {"out": out, "culling_camera": culling_camera}
            mode = named.get("mode") if options is None else getattr(options, "mode", None)
            if isinstance(mode, str) and mode in OUTPUT_MODES:
                return self._draw_output(scene, camera, checked_options(options, named), passed)
            return super().render(scene, camera, options=options, **passed, **named)
        with self._turn.taken(staging=True), np.errstate(all="ignore"):
            chosen, given = _chosen(options, named)
            stage = self._stage_of(scene, given, marks)
            viewed = stage.view_renderer.viewed
            if culling_camera is not None:
                culling_camera = _find_camera(viewed, scene, culling_camera)
            view = self._view(stage, scene, camera, self._is_bare(scene, marks))
            return stage.view_renderer.draw(
                view, outputs=chosen.outputs, out=out, culling_camera=culling_camera
            )

    def _draw_output(
        self, scene: AnyScene, camera: CameraChoice, options: RenderOptions, passed: Any
    ) -> Frame:
        """Draw a frame of a scene as it is, and paint an output over it."""
        frame = super().render(scene, camera, options=_beneath(options), **passed)
        if "color" in frame.outputs:
            whole = scene.scene if isinstance(scene, StagedScene) else scene
            paint(frame, options.mode, bounding_sphere(whole))
        return frame

    def _is_drawn_as_it_is(self, thing: Any) -> bool:
        """Return whether nothing is added to a thing, nor changed in it."""
        if isinstance(thing, StagedScene):
            return True
        if not isinstance(thing, Scene) or self._paint is not None:
            return False
        return self._is_plain or is_lit(thing)

    @property
    def _stages(self) -> KeptStages:
        """The stages of this thread."""
        kept: KeptStages | None = getattr(self._of_thread, "kept", None)
        if kept is None:
            kept = KeptStages(self, self._worn, self._paint, self._drawing)
            self._of_thread.kept = kept
        return kept

    def _stage_of(self, thing: Any, given: dict[str, Any], marks: Marks) -> Stage:
        """Return the stage of a thing, for the options that were given."""
        options = (BARE if self._is_bare(thing, marks) else {}) | given
        return self._stages.stage_of(thing, options, marks)

    def _is_bare(self, thing: Any, marks: Marks) -> bool:
        """Return whether a thing is drawn as a scene would be that holds it."""
        return self._is_plain and not comes_from_file(thing) and not marks.shows_any

    def _view(self, stage: Stage, thing: Any, camera: CameraChoice, is_bare: bool) -> AnyView:
        """Return the view of a stage: that of a camera, else the thing's first one."""
        view_renderer = stage.view_renderer
        viewed = view_renderer.viewed
        found = _find_camera(viewed, thing, camera)
        if found is None and is_bare:
            found = frame_scene(viewed.scene, aspect=self.width / self.height)
        if found is None:
            return stage.first
        view_renderer.choose_theme(stage.first)
        view_renderer.staging.alone = None  # what is drawn next is seen from elsewhere
        return CameraView(*found, stage.first.up, self.size)


def _beneath(options: RenderOptions) -> RenderOptions:
    """Return the options that draw what an output is painted over, and the output."""
    if options.mode not in OUTPUT_MODES:
        return options
    outputs = dict.fromkeys((*options.outputs, options.mode, COVERAGE))
    return replace(options, mode=drawn_mode(options.mode), outputs=tuple(outputs))


def _take_marks(keywords: DrawingKeywords) -> tuple[Marks, Any]:
    """Return what keywords say about numbers, and the options of the others."""
    named: Any = dict(keywords)
    marks = take_marks(named)
    if "edges" in named and flag(named.pop("edges"), "edges"):
        named = {"wireframe": "overlay", "line_color": DARK, **named}
    return marks, named


def _find_camera(
    viewed: ViewedScene, thing: Any, camera: CameraChoice
) -> tuple[Camera, np.ndarray] | None:
    """Return the camera that is chosen for a thing, and its pose in the scene; perhaps none."""
    if camera is None and comes_from_file(thing):
        return None
    found = find_camera(viewed.scene, camera)
    if found is None or not is_file(thing):
        return found
    return found[0], pose_from_file(viewed, found[1])


def _chosen(
    options: RenderOptions | None, keywords: OptionKeywords
) -> tuple[RenderOptions, dict[str, Any]]:
    """Return the options of a call, and those that were given, without outputs."""
    chosen = checked_options(options, keywords)
    names = [one.name for one in fields(RenderOptions) if one.name != "outputs"]
    if options is None:
        return chosen, {name: getattr(chosen, name) for name in names if name in keywords}
    held = {name: getattr(chosen, name) for name in names}
    return chosen, {name: value for name, value in held.items() if value != getattr(DEFAULTS, name)}
