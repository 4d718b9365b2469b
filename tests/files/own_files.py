"""Every file that engine3d writes and reads again, damaged, and what must come of each.

In: a `random.Random`. Out: files that are damaged as `json_damage` does it, given to what reads
them. Whatever they hold, there is a result, or one line that names the file: no other exception, no
wait. What can be made again ends with the same bytes as if nothing had been damaged. By itself it
runs for as long as it is told:

    python tests/files/own_files.py [--seconds 60] [--only batch,golden] [--seed 1]
"""

from __future__ import annotations

import argparse
import collections
import contextlib
import io
import json
import os
import random
import shutil
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np
from files.json_damage import TEXTS, damaged

import engine3d as e3d
from engine3d.apps.batch.manifest import read_manifest
from engine3d.apps.cli import main
from engine3d.apps.desktop.recent_files import RecentFiles
from engine3d.apps.editor.autosave import Autosave, left_behind
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.recovery import content_of
from engine3d.apps.golden import golden_files, png_files
from engine3d.apps.golden.html_report import Report
from engine3d.apps.golden.result_files import read_json, write_json
from engine3d.apps.golden.results import Result
from engine3d.base.files.json_records import sealed
from engine3d.batch import Task, run
from engine3d.datasets import BopWriter, CocoWriter, FolderWriter, WebDatasetWriter
from engine3d.errors import Engine3DError

SECONDS = 5.0
SCRIPT = """
import engine3d as e3d

def build(scene, generator):
    scene.add(e3d.box(0.5 + generator.uniform(0.0, 0.2)), name="box")
    scene.add(e3d.icosphere(subdivisions=1), name="ball", translation=(0.4, 0.0, 0.0))
"""


class Finding(AssertionError):
    """Something that must not happen did."""


def hostile(value, choice: random.Random) -> bytes:
    return choice.choice(TEXTS) if choice.random() < 0.15 else damaged(value, choice)


def spoil(path: Path, data: bytes, choice: random.Random) -> None:
    """Let a file hold other bytes; or let a folder, or a FIFO, be in its place."""
    kind = choice.random()
    if path.exists():
        path.unlink()
    if kind < 0.03:
        path.mkdir()
    elif kind < 0.05:
        os.mkfifo(path)
    else:
        path.write_bytes(data)


def restore(path: Path, data: bytes) -> None:
    """Let a file hold what it held before."""
    shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
    path.write_bytes(data)


class Waits(BaseException):
    """What was called waits for ever; nobody may catch it on the way."""


class Batch:
    """Records of a batch, and the shapes of a data set of BOP."""

    def __init__(self, folder: Path, writer, pattern: str) -> None:
        self._folder, self._writer = folder, writer
        (folder / "script.py").write_text(SCRIPT)
        self._tasks = [
            Task(name=f"p{n}", script="script.py", seed=n, size=(16, 12), folder=str(folder))
            for n in range(2)
        ]
        self._hash = self._run(False)
        self._files = {path: path.read_bytes() for path in (folder / "out").glob(pattern)}
        assert self._files

    def _run(self, resume: bool) -> str:
        out, writer = self._folder / "out", self._writer
        summary = run(self._tasks, out, writer=writer, jobs=1, threads=1, resume=resume)
        if summary.failures:
            raise e3d.FileAccessError(summary.failures[0].error)
        return summary.hash

    def try_one(self, choice: random.Random) -> None:
        path = choice.choice(list(self._files))
        before = self._files[path]
        data, forged = self._damaged(before, choice)
        spoil(path, data, choice)
        resume = choice.random() < 0.8
        try:
            for again in (resume, True):
                if self._run(again) != self._hash and not forged:
                    raise Finding("the batch ended with other bytes")
        except BaseException:
            restore(path, before)
            self._run(False)
            raise
        restore(path, before)

    def _damaged(self, before: bytes, choice: random.Random) -> tuple[bytes, bool]:
        """Other bytes of a file, and whether they bear a seal that fits."""
        if path_is_binary(before):
            return before[: choice.randrange(len(before))], False
        value = json.loads(before)
        data = hostile(value, choice)
        with contextlib.suppress(ValueError, RecursionError):
            if choice.random() < 0.4 and isinstance(value := json.loads(data), dict):
                return sealed({k: v for k, v in value.items() if k != "seal"}), True
        return data, False


def path_is_binary(data: bytes) -> bool:
    return not data.startswith(b"{")


class Golden:
    """What a golden picture says of itself, with a seal that fits."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def try_one(self, choice: random.Random) -> None:
        path = str(self._folder / "golden.png")
        shape, kinds = (
            (3, 4, *choice.choice(((), (3,), (4,)))),
            ("uint8", "float32", "bool", "int32"),
        )
        golden_files.write_golden(path, np.zeros(shape, choice.choice(kinds)))
        chunks = png_files.split_chunks(Path(path).read_bytes())
        (name, text) = chunks[1]
        data = hostile(json.loads(text), choice)
        if choice.random() < 0.2:
            k = choice.randrange(2, len(chunks) - 1)
            chunks[k] = (chunks[k][0], hostile(0, choice))
        Path(path).write_bytes(png_files.join_chunks([chunks[0], (name, data), *chunks[2:]]))
        golden = golden_files.read_golden(path)
        golden.pixels()
        if golden.digest is not None and not isinstance(golden.digest, str):
            raise Finding(f"a digest is {golden.digest!r}")
        exact = golden_files.exact_pixels(golden.data, path)
        if exact is not None and not isinstance(exact, np.ndarray):
            raise Finding("no array")


class Results:
    """Results of comparisons, ours or reg-cli's, made a report."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / "results.json"
        golden_files.write_golden(str(folder / "a.png"), np.zeros((4, 4, 3), np.uint8))
        picture = str(folder / "a.png")
        results = [
            Result(
                "a", "changed", "1 differs", "", picture, picture, picture, 1, 16, 3.0, [0, 0, 2, 2]
            ),
            Result("b/c", "new", actual=picture),
        ]
        write_json(str(self._path), results, {"actualDir": "x", "expectedDir": "y", "diffDir": "z"})
        self._whole = json.loads(self._path.read_text())
        self._reg_cli = {key: one for key, one in self._whole.items() if key != "pictures"}

    def try_one(self, choice: random.Random) -> None:
        value = choice.choice((self._whole, self._whole, self._reg_cli))
        self._path.write_bytes(hostile(value, choice))
        results = read_json(str(self._path))
        Report("title", "a", "b").page(results)


class Copies:
    """The copies that editors leave behind."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder / "unsaved"
        document = SceneDocument()
        document.scene.add(e3d.box())
        autosave = Autosave(document, self._folder)
        autosave.save()
        (self._path,) = self._folder.glob("*.e3d.json")
        self._head, _, self._rest = self._path.read_bytes().partition(b"\n")
        os.close(autosave._lock)
        self._lock = self._path.with_suffix(".lock")

    def try_one(self, choice: random.Random) -> None:
        head = json.loads(self._head.removesuffix(b",") + b"}")
        rest = self._rest
        if choice.random() < 0.3:
            rest = hostile(json.loads(b"{" + rest), choice).removeprefix(b"{")
        line = hostile(head, choice).removesuffix(b"}").replace(b"\n", b" ") + b",\n"
        spoil(self._path, line + rest, choice)
        self._lock.touch()
        try:
            for copy in left_behind(self._folder):
                time.strftime("%Y-%m-%d %H:%M", time.localtime(copy.time))
                f"{copy.document!r}".encode()
                content_of(copy)
                SceneDocument.recover(copy)
        finally:
            if self._path.is_dir():
                self._path.rmdir()


class Recent:
    """The lists of files that were opened lately."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / "recent.json"

    def try_one(self, choice: random.Random) -> None:
        spoil(self._path, hostile([str(self._path), "/etc/passwd"], choice), choice)
        recent = RecentFiles(self._path)
        if not all(isinstance(path, str) for path in recent.paths()):
            raise Finding("no paths")
        if not self._path.is_file():
            self._path.rmdir() if self._path.is_dir() else self._path.unlink()
        recent.add(__file__)
        if recent.paths()[0] != __file__:
            raise Finding("a list that was damaged stays so")


class Config:
    """Options that stand in files."""

    VALUE = (
        {"files": "*.obj", "options": {"up": "+Z", "grid": True, "size": "8x8"}},
        {"files": ["*.stl"], "options": {"fov": 20}},
        {"options": {"camera_direction": [0, 0, -1], "light_intensity": 0.5, "samples": 1}},
    )

    def __init__(self, folder: Path) -> None:
        self._path, self._model = folder / "config.json", folder / "m.obj"
        self._model.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")

    def try_one(self, choice: random.Random) -> None:
        value = json.loads(json.dumps(self.VALUE))
        spoiled = hostile(value, choice)
        self._path.write_bytes(spoiled)
        said = io.StringIO()
        arguments = ["render", str(self._model), "--config", str(self._path), "--size", "8x8"]
        arguments += ["--look", "plain", "-o", str(self._path.with_name("out.png"))]
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
            status = main(arguments)
        if status not in (0, 1, 2) or "Traceback" in said.getvalue():
            raise Finding(said.getvalue())
        if status and not said.getvalue().startswith("engine3d: "):
            raise Finding(f"no line: {said.getvalue()!r}")
        if status:
            raise e3d.FileFormatError("refused")


class Scene:
    """Scenes, which also is what copies hold."""

    def __init__(self, folder: Path) -> None:
        scene = e3d.Scene()
        material = e3d.Material(texture=e3d.Texture(np.zeros((2, 2, 3), np.uint8)))
        box = e3d.box()
        box.materials = (material,)
        scene.add(box, name="box")
        material.extras = {"a": [1, 2.5, {"b": None}]}
        scene.add(e3d.PointLight(), translation=(1, 2, 3))
        scene.add(e3d.PerspectiveCamera())
        self._path, self._again = folder / "scene.e3d.json", folder / "again.e3d.json"
        scene.save(self._path)
        self._value = json.loads(self._path.read_bytes())

    def try_one(self, choice: random.Random) -> None:
        self._path.write_bytes(hostile(self._value, choice))
        scene = e3d.load_scene(self._path)
        scene.save(self._again)
        e3d.load_scene(self._again)


class Gltf:
    """glTF, of which engine3d writes a part."""

    def __init__(self, folder: Path) -> None:
        scene = e3d.Scene()
        scene.add(e3d.box(), name="box")
        scene.add(e3d.PointLight(), translation=(1, 2, 3))
        self._path = folder / "scene.gltf"
        e3d.save_scene(scene, self._path)
        self._value = json.loads(self._path.read_bytes())

    def try_one(self, choice: random.Random) -> None:
        self._path.write_bytes(hostile(self._value, choice))
        e3d.load_scene(self._path)


class Manifest:
    """Manifests, which people write."""

    VALUE = {
        "version": 1,
        "defaults": {"size": [8, 8], "render": {"mode": "unlit"}, "scene": {"exposure": 0.5}},
        "tasks": [
            {"model": "m.obj", "camera": {"azimuth_degrees": 30}, "name": "{model}_{index:03}"},
            {"script": "s.py", "matrix": {"seed": {"from": 1, "count": 3}, "samples": [1, 4]}},
        ],
        "dataset": {"writer": "bop", "categories": ["a"], "depth_scale": 0.1},
    }

    def __init__(self, folder: Path) -> None:
        self._path = folder / "manifest.json"

    def try_one(self, choice: random.Random) -> None:
        value = {key: one for key, one in self.VALUE.items() if choice.random() < 0.9}
        self._path.write_bytes(hostile(value, choice))
        read_manifest(self._path)


def batch_of(writer, pattern: str = ".batch/*.json"):
    return lambda folder: Batch(folder, writer, pattern)


#: What reads each kind of file; a function of a folder that it may write to.
KINDS = {
    "batch-plain": batch_of(None),
    "batch-coco": batch_of(CocoWriter()),
    "batch-bop": batch_of(BopWriter()),
    "batch-folders": batch_of(FolderWriter()),
    "batch-web": batch_of(WebDatasetWriter()),
    "bop-shapes": batch_of(BopWriter(), ".models/*"),
    "golden": Golden,
    "results": Results,
    "copies": Copies,
    "recent": Recent,
    "config": Config,
    "scene": Scene,
    "gltf": Gltf,
    "manifest": Manifest,
}


def try_kind(name: str, folder: Path, seed: int, count: int | None, seconds: float = 0.0):
    """Try so many damaged files, or for so long; return counts of what came of them, and findings.

    Parameters
    ----------
    name : str
    folder : Path
        Is made.
    seed : int
    count : int, optional
    seconds : float
        Counts where ``count`` is left out.
    """
    folder.mkdir()
    case, counts, findings = KINDS[name](folder), collections.Counter(), {}
    ends = time.monotonic() + seconds
    number = 0
    while number < count if count is not None else time.monotonic() < ends:
        choice = random.Random(f"{name} {seed} {number}")
        begun = time.monotonic()
        outcome = _outcome(case, choice, findings, f"{seed} {number}")
        if time.monotonic() - begun > SECONDS:
            outcome = "slow"
            findings.setdefault("slow", f"{seed} {number}: {time.monotonic() - begun:.1f} s")
        counts[outcome] += 1
        number += 1
    return counts, findings


def _outcome(case, choice: random.Random, findings: dict, place: str) -> str:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", e3d.Engine3DWarning)
            _in_time(case.try_one, choice)
    except Engine3DError as error:
        if "\n" in str(error) or not str(error).isprintable():
            findings.setdefault(f"no line: {error!r:.80}", place)
            return "finding"
        return "refused"
    except (Exception, Waits) as error:
        where = traceback.extract_tb(error.__traceback__)[-1]
        key = f"{type(error).__name__} {Path(where.filename).name}:{where.lineno} {error!s:.60}"
        findings.setdefault(key, place)
        return "finding"
    return "read"


def _in_time(function, choice: random.Random) -> None:
    """Call a function; what waits for ever is a finding, where the system has an alarm."""
    import signal

    if not hasattr(signal, "setitimer"):
        return function(choice)

    def stop(*_):
        raise Waits("it waits for ever")

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, 2 * SECONDS, SECONDS)
    try:
        function(choice)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Give damaged files to what reads them.")
    parser.add_argument("--seconds", type=float, default=60.0, help="for each kind of file")
    parser.add_argument("--only", default=",".join(KINDS))
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    given = parser.parse_args()
    print(f"seed {given.seed}")
    total = 0
    with tempfile.TemporaryDirectory() as place:
        os.environ["XDG_STATE_HOME"] = place
        for kind in given.only.split(","):
            known, found = try_kind(kind, Path(place) / kind, given.seed, None, given.seconds)
            print(kind, dict(known), *(f"\n    {k}  [{v}]" for k, v in found.items()), flush=True)
            total += known["finding"] + known["slow"]
    sys.exit(total > 0)
