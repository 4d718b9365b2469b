"""Tasks: complete descriptions of pictures, except for the content of files.

In: values from manifests. Out: a checked `Task`, which can be sent to other processes and has a
key: a hash of its description.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, get_args

from ...base.calls import checks_types
from ...base.files.portable_names import fault_of
from ...base.image_size import check_size
from ...base.numbers import shown
from ...base.validation import choose, flag
from ...choices import Antialiasing, ImageFormat, LookName, Samples
from ...errors import InvalidArgumentError
from ...model.scene.scene import Scene
from ...rendering.frame import OUTPUTS
from ...rendering.options import RenderOptions
from ...stage.look import LOOK_CHOICES
from ...version import __version__
from ..datasets.kinds import named_in_errors
from ..datasets.measured import checked_outputs
from ..datasets.writer import DatasetWriter
from .cameras import check_camera
from .members import member

#: The scene settings that a task may override.
SCENE_KEYS = ("background", "ambient", "light_clamp", "exposure")
_LOOK_CAMERA = ("azimuth_degrees", "elevation_degrees", "yfov_degrees", "name")
_NAME = re.compile(r"[^\W_][\w .+@=,-]*(?:/[^\W_][\w .+@=,-]*)*")
_LONGEST = 200  # characters: with a folder and a suffix, it must still be a valid file name


@dataclass(frozen=True, slots=True)  # there may be millions
class Task:
    """One picture of a batch.

    Parameters
    ----------
    name : str
        Name of its files, without an extension; folders are created. It is unique in a batch.
    model : str, optional
        A file of any format that `load_scene` reads.
    script : str, optional
        A Python file with a function that builds the scene, or changes the model's. A model or a
        script is required.
    function : str
        The function's name; it is called as ``function(scene, generator, **arguments)``; see
        docs/batches.md.
    arguments : mapping
        Further arguments of the function, in JSON's types.
    camera : int or mapping, optional
        The number of a scene camera, or a description: see docs/batches.md. By default the script's
        camera, else the scene's first one, else one that shows the whole scene.
    size : (int, int)
        Width and height in pixels.
    samples, antialiasing
        As in `Renderer`.
    render : mapping
        Keyword arguments of `RenderOptions`, except ``outputs``.
    look : {"studio", "plain"} or the name of a plug-in's look, optional
        Draw the model as ``engine3d render --look`` does. Such a task allows no script, ``render``,
        ``scene`` or output except colour, and only the camera members ``azimuth_degrees`` and
        ``elevation_degrees``, relative to the command's view, and ``yfov_degrees``. By default,
        tasks with nothing but a model and colour are drawn so in the look ``"studio"``; in other
        tasks, scenes without light of their own are dressed as by `engine3d.render`.
    scene : mapping
        ``background``, ``ambient``, ``light_clamp`` and ``exposure``, as in `Scene`.
    outputs : sequence of str
        Files to write without a data set: ``"color"`` (a PNG) or, in another format,
        ``"color.jpg"``; other outputs of frames are written as ``NAME.OUTPUT.npy`` or, such as
        ``"depth.pfm"``, in another format of `engine3d.sensors.save_values`.
    seed : int
        Seed of the script's generator.
    inputs : sequence of str
        Further input files, such as those that scripts read.
    index : int
        Its position in the batch.
    folder : str
        The base of relative paths; by default the current folder.
    root : str, optional
        A second folder, besides the model's own, for files named in the model.
    plugins : bool
        Whether installed packages that extend engine3d may take part (docs/plugins.md).

    Raises
    ------
    InvalidArgumentError
    """

    name: str
    model: str | None = None
    script: str | None = None
    function: str = "build"
    arguments: Mapping[str, Any] = field(default_factory=dict)
    camera: int | Mapping[str, Any] | None = None
    size: tuple[int, int] = (320, 240)
    samples: Samples = 4
    antialiasing: Antialiasing = "msaa"
    render: Mapping[str, Any] = field(default_factory=dict)
    look: LookName | str | None = None
    scene: Mapping[str, Any] = field(default_factory=dict)
    outputs: Sequence[str] = ("color",)
    seed: int = 0
    inputs: Sequence[str] = ()
    index: int = 0
    folder: str = field(default_factory=os.getcwd)
    root: str | None = None
    plugins: bool = True

    def __post_init__(self) -> None:
        for one in fields(self):
            value = checked(one.name, getattr(self, one.name))
            object.__setattr__(self, one.name, value)
        if self.model is None and self.script is None:
            raise InvalidArgumentError("a task needs a model or a script")
        check_look(self)

    @checks_types
    def path(self, name: str) -> str:
        """Return the path of a file that the task names."""
        return os.path.join(self.folder, name)

    @property
    def root_path(self) -> str | None:
        """Return the folder allowed for files that the model names."""
        return None if self.root is None else self.path(self.root)

    @checks_types
    def key(self, writer: DatasetWriter) -> str:
        """Return a hash of the task, the writer and engine3d's version."""
        told = {one.name: getattr(self, one.name) for one in fields(self) if one.name != "folder"}
        with named_in_errors(writer):
            settings = writer.said()
        said = {"task": told, "writer": settings, "engine3d": __version__}
        text = json.dumps(said, sort_keys=True, separators=(",", ":"))
        return hashlib.blake2b(text.encode("utf-8"), digest_size=20).hexdigest()


def check_look(task: Task) -> None:
    """Raise unless a task's other fields fit its look.

    Raises
    ------
    InvalidArgumentError
    """
    other = [] if task.look is None else _not_with_look(task)
    if other:
        raise InvalidArgumentError(f"look does not go with {', '.join(other)}")


def default_look(task: Task) -> LookName | None:
    """Return the look of a task that names none: None if its scene is not only a model."""
    return None if task.camera is not None or _not_with_look(task) else "studio"


def _not_with_look(task: Task) -> list[str]:
    """Return what a task has that a look does not go with."""
    other = [key for key in ("script", "render", "scene") if getattr(task, key)]
    other += [f"the output {name}" for name in task.outputs if not name.startswith("color")]
    if task.camera is not None:
        said = task.camera if isinstance(task.camera, Mapping) else {"a number of a camera": 0}
        other += [f"camera: {key}" for key in said if key not in _LOOK_CAMERA]
    return other


def task_of(values: Mapping[str, Any]) -> Task:
    """Return a task from checked values, which many tasks may share."""
    task = object.__new__(Task)
    for name, value in {**_DEFAULTS, **values}.items():
        object.__setattr__(task, name, value)
    return task


def checked(name: str, value: Any) -> Any:
    """Return the value of a task's field, checked; errors name the field.

    Raises
    ------
    InvalidArgumentError
    """
    return _CHECKS[name](value)


def _name(value: Any) -> str:
    if not (isinstance(value, str) and len(value) <= _LONGEST and _NAME.fullmatch(value)):
        raise InvalidArgumentError(
            f"name must be made of letters, digits and _ . + - @ = , or spaces, with / between "
            f"folders, each beginning with a letter or digit, not {shown(value)}"
        )
    # Of the files: their names go on with an ending.
    if (fault := fault_of(f"{value}.png")) is not None:
        raise InvalidArgumentError(
            f'name must name files of every system: {fault}; "name" gives another than the model\'s'
        )
    return value


def _text(what: str):
    def check(value: Any) -> str:
        if not (isinstance(value, (str, os.PathLike)) and os.fspath(value)):
            raise InvalidArgumentError(f"{what} must be a text, not {shown(value)}")
        return str(os.fspath(value))

    return check


def _optional_text(what: str):
    check = _text(what)
    return lambda value: None if value is None else check(value)


def _texts(what: str):
    check = _text(what)

    def check_all(value: Any) -> tuple[str, ...]:
        if isinstance(value, str) or not isinstance(value, Sequence):
            raise InvalidArgumentError(f"{what} must be a list of texts, not {shown(value)}")
        texts = []
        for number, one in enumerate(value):
            with member(number):
                texts.append(check(one))
        return tuple(texts)

    return check_all


def _whole(what: str):
    def check(value: Any) -> int:
        if isinstance(value, bool) or not isinstance(value, int) or value < 0:
            raise InvalidArgumentError(f"{what} must be a whole number from 0 on: {shown(value)}")
        return value

    return check


def _mapping(what: str, value: Any) -> dict[str, Any]:
    if not (isinstance(value, Mapping) and all(isinstance(key, str) for key in value)):
        raise InvalidArgumentError(f"{what} must be an object, not {shown(value)}")
    return dict(value)


def _function(value: Any) -> str:
    if not (isinstance(value, str) and value.isidentifier()):
        raise InvalidArgumentError(f"function must be a name, not {shown(value)}")
    return value


def _arguments(value: Any) -> dict[str, Any]:
    arguments = _mapping("arguments", value)
    try:
        return json.loads(json.dumps(arguments, allow_nan=False))
    except (TypeError, ValueError) as error:
        raise InvalidArgumentError(f"arguments must be of JSON's types: {error}") from None


def _render(value: Any) -> dict[str, Any]:
    options = _mapping("render", value)
    known = {one.name for one in fields(RenderOptions)} - {"outputs"}
    for key in options:
        with member(key):
            _check_key("render", key, sorted(known))
    try:
        RenderOptions(**options)
    except (InvalidArgumentError, TypeError):
        for key, one in options.items():
            with member(key):
                RenderOptions(**{key: one})
        raise
    return options


def _check_key(what: str, key: str, known: Sequence[str]) -> None:
    if key not in known:
        raise InvalidArgumentError(f"{what}: {key} is none of {', '.join(known)}")


def _scene(value: Any) -> dict[str, Any]:
    values = _mapping("scene", value)
    if values:
        scene = Scene()
        for key, held in values.items():
            with member(key):
                _check_key("scene", key, SCENE_KEYS)
                setattr(scene, key, held)
    return values


def _look(value: Any) -> str | None:
    if value is None or (isinstance(value, str) and value in LOOK_CHOICES):
        return value
    return choose(value, (None, *LOOK_CHOICES), "look")


def _outputs(value: Any) -> tuple[str, ...]:
    names = _texts("outputs")(value)
    for number, name in enumerate(names):
        with member(number):
            _check_output(name)
    if not names or len({name.partition(".")[0] for name in names}) < len(names):
        raise InvalidArgumentError("outputs must name some outputs, none twice")
    return names


def _check_output(name: str) -> None:
    output, _, suffix = name.partition(".")
    choose(output, OUTPUTS, "outputs")
    if suffix and output == "color":
        choose(suffix, get_args(ImageFormat), "outputs: the format of color")
    elif suffix:
        checked_outputs([name], None)


_CHECKS = {
    "name": _name,
    "model": _optional_text("model"),
    "script": _optional_text("script"),
    "function": _function,
    "arguments": _arguments,
    "camera": check_camera,
    "size": check_size,
    "samples": lambda value: choose(value, get_args(Samples), "samples"),
    "antialiasing": lambda value: choose(value, get_args(Antialiasing), "antialiasing"),
    "render": _render,
    "scene": _scene,
    "look": _look,
    "outputs": _outputs,
    "seed": _whole("seed"),
    "inputs": _texts("inputs"),
    "root": _optional_text("root"),
    "plugins": lambda value: flag(value, "plugins"),
    "index": _whole("index"),
    "folder": _text("folder"),
}
_USUAL = Task(name="a", model="a", folder="/")
_DEFAULTS = {one.name: getattr(_USUAL, one.name) for one in fields(Task)} | {"model": None}
