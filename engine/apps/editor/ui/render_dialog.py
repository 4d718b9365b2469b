"""The dialog that draws a picture, a turn or the motion of the scene into a file.

In: the user's choices. Out: a file, drawn as `engine3d.render` does; meanwhile how far it is.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import Any, get_args

import numpy as np

from ....base import linalg
from ....base.language import translated, translated_choice, translated_count
from ....choices import LookName, Samples
from ....io.output.animation_files import ANIMATION_SUFFIXES, PICTURE_SUFFIXES
from ....model.scene.cameras import Camera
from ....model.scene.nodes import Node
from ..render_job import RenderJob, Shot
from .files import Files
from .middle import begin_dialog
from .properties.fields import label_before
from .translated_imgui import imgui
from .translated_imgui import label as labelled
from .workspace import Workspace

_WHAT = {"picture": "Picture", "turn": "Turn", "motion": "Motion"}
_MOST_SIDE, _MOST_PICTURES, _MOST_FPS = 16384, 5000, 50
#: Pictures of the window until it shows that the drawing has ended.
SETTLING = 3
_LABELS = 12.0  # letters that labels take
_TITLE, _PROGRESS = "Render", "Rendering"


@dataclass
class Choices:
    """What is drawn.

    Attributes
    ----------
    what : {"picture", "turn", "motion"}
    size : (int, int)
    camera : Node or None
        None for the camera of the view.
    look : {"studio", "plain"}
    samples : int
    pictures : int
        Of a turn.
    """

    what: str = "picture"
    size: tuple[int, int] = (1280, 720)
    camera: Node | None = None
    look: LookName = "studio"
    samples: Samples = 4
    pictures: int = 72


class RenderDialog:
    """Asks what to draw and where to, and draws it.

    Parameters
    ----------
    workspace : Workspace
    files : Files
        Asks for the file.

    Attributes
    ----------
    choices : Choices
    """

    def __init__(self, workspace: Workspace, files: Files) -> None:
        self._workspace, self._files = workspace, files
        self.choices = Choices()
        self._opens = False
        self._job: RenderJob | None = None
        self._pictures_due = 0  # of the window, after the end

    @property
    def is_waiting(self) -> bool:
        """Whether something is being drawn: the next frame of the window is another one."""
        return self._job is not None or self._pictures_due > 0

    def open(self) -> None:
        """Open the dialog."""
        camera = self.choices.camera
        if camera is not None and camera.scene is not self._workspace.scene:
            self.choices.camera = None
        if self.choices.what == "motion" and not self._workspace.document.moves:
            self.choices.what = "picture"
        self._opens = True

    def close(self) -> None:
        """Give up what is being drawn."""
        if self._job is not None:
            self._job.stop()
            self._job.wait()
            self._job = None

    def draw(self) -> None:
        """Lay out the dialog, or the progress, if one of them is open."""
        self._pictures_due = max(self._pictures_due - 1, 0)
        if self._opens:
            imgui.open_popup(_TITLE)
            self._opens = False
        if begin_dialog(_TITLE):
            self._draw_choices()
            imgui.end_popup()
        if self._job is not None and not imgui.is_popup_open(labelled(_PROGRESS)):
            imgui.open_popup(_PROGRESS)
        if begin_dialog(_PROGRESS, imgui.Cond_.always):
            self._draw_progress()
            imgui.end_popup()

    def _draw_choices(self) -> None:
        chosen = self.choices
        imgui.push_item_width(14.0 * imgui.get_font_size())
        for what, title in _WHAT.items():
            imgui.begin_disabled(what == "motion" and not self._workspace.document.moves)
            if imgui.radio_button(title, chosen.what == what):
                chosen.what = what
            imgui.end_disabled()
            imgui.same_line()
        imgui.new_line()
        label_before("Size in pixels", _LABELS)
        changed, size = imgui.input_int2("##size", list(chosen.size))
        if changed:
            chosen.size = tuple(min(max(side, 1), _MOST_SIDE) for side in size)
        self._draw_camera()
        chosen.look = _choice("Look without lights", chosen.look, get_args(LookName))
        chosen.samples = _choice("Samples a pixel", chosen.samples, get_args(Samples))
        if chosen.what == "turn":
            label_before("Pictures", _LABELS)
            _, chosen.pictures = imgui.input_int("##pictures", chosen.pictures, 12)
            chosen.pictures = min(max(chosen.pictures, 2), _MOST_PICTURES)
        if chosen.what != "picture":
            label_before("Pictures a second", _LABELS)
            _, fps = imgui.input_int("##fps", self._workspace.display.fps)
            self._workspace.display.fps = fps = min(max(fps, 1), _MOST_FPS)
            count = self._count()
            imgui.text_disabled(
                translated_count(
                    "{count:,} picture, {seconds:.1f} s",
                    "{count:,} pictures, {seconds:.1f} s",
                    count,
                    seconds=count / fps,
                )
            )
        imgui.pop_item_width()
        imgui.spacing()
        if imgui.is_window_appearing():
            imgui.set_keyboard_focus_here()
            imgui.set_nav_cursor_visible(True)
        if imgui.button("Choose the file ..."):
            imgui.close_current_popup()
            self._ask_for_file()
        imgui.same_line()
        if imgui.button("Cancel") or imgui.is_key_pressed(imgui.Key.escape, False):
            imgui.close_current_popup()

    def _draw_camera(self) -> None:
        chosen, cameras = self.choices, self._workspace.scene.data.cameras.values()
        view, unnamed = translated("the view"), translated("unnamed")
        name = view if chosen.camera is None else chosen.camera.name or unnamed
        label_before("Through", _LABELS)
        if not imgui.begin_combo("##camera", name):
            return
        if imgui.selectable(view, chosen.camera is None)[0]:
            chosen.camera = None
        for node in cameras:
            label = f"{node.name or unnamed}##{node.id}"
            if imgui.selectable(label, node is chosen.camera)[0]:
                chosen.camera = node
        imgui.end_combo()

    def _ask_for_file(self) -> None:
        still = self.choices.what == "picture"
        path = self._workspace.document.path
        stem = "scene" if path is None else os.path.basename(path).partition(".")[0]
        suffixes = PICTURE_SUFFIXES if still else (".webp", ".gif", *ANIMATION_SUFFIXES)
        name = f"{stem}{suffixes[0]}"
        kinds = {"Pictures" if still else "Animations": suffixes}
        self._files.ask_for_new("Render into a file", kinds, name, self.render_to)

    def render_to(self, path: str) -> None:
        """Begin to draw into a file."""
        chosen, scene = self.choices, self._workspace.scene
        self._workspace.plays = False
        self._job = RenderJob(
            scene.copy() if chosen.what == "motion" else scene,
            self.shots(),
            path,
            size=chosen.size,
            look=chosen.look,
            samples=chosen.samples,
            fps=float(self._workspace.display.fps),
        )

    def shots(self) -> list[Shot]:
        """Return the pictures to draw."""
        what, count = self.choices.what, self._count()
        if what == "picture":
            return [self._shot(0.0)]
        if what == "turn":
            return [self._shot(2.0 * math.pi * number / count) for number in range(count)]
        seconds = self._workspace.document.length
        still = self._shot(0.0)
        times = [seconds * number / count for number in range(count)]
        node = self.choices.camera
        moves = node is not None and isinstance(node.object, Camera)
        place = self._workspace.scene.nodes.index(node) if moves else None
        return [Shot(still.camera, still.pose, time, place) for time in times]

    def _count(self) -> int:
        """Return the number of pictures."""
        if self.choices.what == "picture":
            return 1
        if self.choices.what == "turn":
            return self.choices.pictures
        wanted = round(self._workspace.document.length * self._workspace.display.fps)
        return min(max(wanted, 2), _MOST_PICTURES)

    def _shot(self, angle: float) -> Shot:
        """Return a picture from the camera turned about the middle of what it sees."""
        workspace, node = self._workspace, self.choices.camera
        if node is None or not isinstance(node.object, Camera):
            view = workspace.view.copy()
            view.azimuth += angle
            return Shot(view.camera(workspace.bounds), view.pose())
        middle = np.asarray(workspace.bounds.center)
        turn = linalg.rotation_axis(workspace.view.up, angle)
        about = linalg.multiply(linalg.translation(middle), turn)
        about = linalg.multiply(about, linalg.translation(-middle))
        return Shot(
            node.object, linalg.multiply(about, node.world_pose) if angle else node.world_pose
        )

    def _draw_progress(self) -> None:
        job = self._job
        if job is None:
            imgui.close_current_popup()
            return
        imgui.text_unformatted(os.path.basename(job.path))
        width = 20.0 * imgui.get_font_size()
        told = translated("{done:,} of {count:,}", done=job.done, count=job.count)
        imgui.progress_bar(job.done / job.count, (width, 0.0), told)
        imgui.begin_disabled(job.is_stopped)
        if imgui.button("Stop") or imgui.is_key_pressed(imgui.Key.escape, False):
            job.stop()
        imgui.end_disabled()
        if job.is_ended:
            self._job, self._pictures_due = None, SETTLING
            self._tell(job)
            imgui.close_current_popup()

    def _tell(self, job: RenderJob) -> None:
        console = self._workspace.console
        if job.error:
            console.write("error", translated("Render: {reason}", reason=job.error))
            return
        told = translated_count(
            "Render a picture into {path}",
            "Render {count:,} pictures into {path}",
            job.count,
            path=job.path,
        )
        console.write("action", told)


def _choice(label: str, now: Any, choices: tuple) -> Any:
    """Lay out a choice; return the chosen one."""
    names = [translated_choice("look", str(each)) for each in choices]
    label_before(label, _LABELS)
    return choices[imgui.combo(f"##{label}", choices.index(now), names)[1]]
