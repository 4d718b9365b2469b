"""Damaged and made-up files of every format, and what must hold of whatever a reader makes of them.

In: a `random.Random`. Out: a name and bytes; `check` writes the file, loads it in every way and
raises `Finding` unless that gives sound arrays or an error of the project's own that names the
file, within 2 s (10 s above 1 MB) and 64 MiB + 40 times the file's size. By itself it runs for as
long as it is told, in two processes; with ``--coverage`` the package atheris chooses the bytes
(engine3d[fuzz]):

    python tests/loaders/fuzzing.py [--seconds 60] [--only obj,ply] [--coverage] [--keep FOLDER]
"""

from __future__ import annotations

import argparse
import contextlib
import gzip
import io
import multiprocessing
import os
import random
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    if "--coverage" in sys.argv:
        import atheris

        with atheris.instrument_imports(include=["engine3d"]):
            from engine3d.io.reading.reader_registry import readers

            readers()  # imports them all

import numpy as np
from loaders.generating import GENERATORS, enlarged, mutated
from loaders.seeds import FILES
from missing_here import peak_memory as most_memory
from PIL import Image
from plain_picture import render
from shared_corpus import CONFORMANCE

import engine3d as e3d
from engine3d.errors import Engine3DError
from engine3d.loaders import load_document

SECONDS, MEMORY, TIMES_SIZE = 2.0, 64 << 20, 40
LARGE, SECONDS_IF_LARGE = 1 << 20, 10.0
LARGEST_SEED = 1 << 16
ENLARGED = 0.005  # of the cases of the long form
PILLOW = {".png": "PNG", ".bmp": "BMP", ".gif": "GIF", ".ppm": "PPM", ".jpg": "JPEG"}
PILLOW |= {".webp": "WEBP", ".tif": "TIFF"}
IMAGES = (".tga", *PILLOW)
_CLEAR_PEAK = Path("/proc/self/clear_refs")


class Finding(AssertionError):
    """Something that must not happen did."""


def require(claim: bool, message: str) -> None:
    if not claim:
        raise Finding(message)


# ---- files ----


def seeds(corpus: bool = True) -> dict[str, list[bytes]]:
    """The files to start from, by extension; by default those of the optional corpus too."""
    found: dict[str, list[bytes]] = {}
    for name, data in FILES.items():
        found.setdefault(Path(name).suffix, []).append(data)
    image = Image.fromarray(np.arange(5 * 7 * 3, dtype=np.uint8).reshape(5, 7, 3))
    for suffix, kind in PILLOW.items():
        file = io.BytesIO()
        image.save(file, kind)
        found[suffix] = [file.getvalue()]
    for path in sorted(CONFORMANCE.rglob("*")) if corpus and CONFORMANCE.is_dir() else ():
        if path.suffix in (*found, *IMAGES) and path.is_file():
            if path.stat().st_size <= LARGEST_SEED:
                found.setdefault(path.suffix, []).append(path.read_bytes())
    return found


def make_case(choice: random.Random, start: dict[str, list[bytes]], suffix: str):
    """Return the name and the bytes of a file: made up, damaged, or both; some compressed."""
    if suffix in GENERATORS and choice.random() < 0.4:
        data = GENERATORS[suffix](choice)
        if choice.random() < 0.4:
            data = mutated(data, choice)
    else:
        data = mutated(choice.choice(start[suffix]), choice)
    name = ("house" if suffix == ".mtl" else "case") + suffix
    if choice.random() < 0.03:
        data = gzip.compress(data, 1)
        name += ".gz"
        if choice.random() < 0.7:
            data = mutated(data, choice)
    return name, data


# ---- what must hold ----


def check_array(array, name: str, dtypes, shape) -> None:
    require(isinstance(array, np.ndarray), f"{name} is no array")
    require(array.dtype in dtypes, f"{name} is {array.dtype}")
    fits = len(array.shape) == len(shape) and all(
        wanted in (None, length) for wanted, length in zip(shape, array.shape, strict=True)
    )
    require(fits, f"{name} has the shape {array.shape}")


def check_indices(array, name: str, count: int, shape) -> None:
    check_array(array, name, (np.int32,), shape)
    require(array.size == 0 or (array.min() >= 0 and array.max() < count), f"{name} out of range")


def check_mesh(mesh) -> None:
    """Raise unless everything that a mesh holds or derives is sound."""
    vertices, faces = len(mesh.positions), len(mesh.faces)
    check_array(mesh.positions, "positions", (np.float32,), (None, 3))
    check_indices(mesh.faces, "faces", vertices, (None, 3))
    check_indices(mesh.lines, "lines", vertices, (None, 2))
    check_indices(mesh.points, "points", vertices, (None,))
    check_indices(mesh.material_ids, "material_ids", len(mesh.materials), (faces,))
    for name, columns in (("normals", 3), ("uvs", 2)):
        array = getattr(mesh, name)
        if array is not None:
            check_array(array, name, (np.float32,), (vertices, columns))
            require(bool(np.isfinite(array).all()), f"{name} are not finite")
    if mesh.colors is not None:
        check_array(mesh.colors, "colors", (np.uint8, np.float32), (vertices, 4))
    if mesh.edge_visible is not None:
        check_array(mesh.edge_visible, "edge_visible", (np.bool_,), (faces, 3))
    for name, group in mesh.groups.items():
        check_indices(group, f"group {name!r}", faces, (None,))
    check_array(mesh.face_normals, "face_normals", (np.float32,), (faces, 3))
    require(bool(np.isfinite(mesh.face_normals).all()), "face_normals are not finite")
    require(bool(np.isfinite(mesh.bounds).all()), "bounds are not finite")
    require(len(mesh.polygons) == faces, "polygons do not match the faces")
    require(mesh.edges().max(initial=0) < max(vertices, 1), "edges out of range")
    require(all(isinstance(text, str) and "\n" not in text for text in mesh.warnings), "warnings")


def load(path: Path, draw: bool) -> None:
    """Load a file in every way that there is for it."""
    target = path.with_name("house.obj") if path.name.startswith("house.mtl") else path
    if ".hdr" in target.suffixes:
        environment = e3d.Environment.load(target)
        check_array(environment.pixels, "pixels", (np.float32,), (None, None, 3))
        require(environment.pixels.size > 0, "a picture without pixels")
        require(bool(np.isfinite(environment.pixels).all()), "pixels are not finite")
        return
    if ".obj" in target.suffixes or not any(s in IMAGES for s in target.suffixes):
        mesh = e3d.load_mesh(target)
        check_mesh(mesh)
        for entry in load_document(target).objects:
            check_mesh(entry.mesh)
        scene = e3d.load_scene(target)
        if draw:
            draw_scene(scene)
        return
    texture = e3d.load_texture(target)
    check_array(texture.pixels, "pixels", (np.uint8,), (None, None, 4))
    require(texture.pixels.size > 0, "an image without pixels")


def draw_scene(scene) -> None:
    """Draw what was loaded; that no camera can be placed far outside of any range is no finding."""
    with contextlib.suppress(e3d.InvalidArgumentError):
        frame = render(scene, size=(16, 16), outputs=("color", "depth"))
        require(bool(np.isfinite(frame.depth).all()), "depths are not finite")


@contextlib.contextmanager
def peak_memory(result: list[int]):
    """Measure by how much the process's peak rises within the block, in bytes."""
    before = _memory("VmRSS:")
    if before:
        _CLEAR_PEAK.write_text("5")
    else:
        before = most_memory()
    yield
    after = _memory("VmHWM:") or most_memory()
    result.append(after - before)


def _memory(key: str) -> int:
    """A line of /proc/self/status, in bytes; 0 where there is none, or no peak can be cleared."""
    if not os.access(_CLEAR_PEAK, os.W_OK):
        return 0
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(key):
            return int(line.split()[1]) << 10
    return 0


def check(folder: Path, name: str, data: bytes, *, draw: bool = False, slack: float = 1.0) -> bool:
    """Load a file; return whether it loaded.

    Parameters
    ----------
    folder : Path
        Where it is written, beside the files that it may name.
    draw : bool
        Draw what is in it, too.
    slack : float
        How many times the limit of time is allowed.

    Raises
    ------
    Finding
    """
    path = folder / name
    path.write_bytes(data)
    loaded, peak = True, []
    start = time.process_time()
    with warnings.catch_warnings(), peak_memory(peak):
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", e3d.Engine3DWarning)
        try:
            load(path, draw)
        except Engine3DError as error:
            loaded = False
            text = str(error)
            require(text.startswith(str(folder)), f"the error does not name the file: {text}")
            require("\n" not in text and len(text) < 1000, f"not one short line: {text!r}")
            require("more memory than there is" not in text, "memory ran out")
    seconds = time.process_time() - start
    most = SECONDS_IF_LARGE if len(data) > LARGE else SECONDS
    require(seconds <= most * slack, f"took {seconds:.1f} s")
    limit = MEMORY + TIMES_SIZE * len(data)
    if loaded or path.suffix in PILLOW:
        limit += 3 * 4 * _announced_pixels(path)
    require(peak[0] <= limit, f"took {peak[0] >> 20} MiB")
    return loaded


def _announced_pixels(path: Path) -> int:
    """How many pixels an image says it has: what decodes it may believe that; 0 for no image."""
    with warnings.catch_warnings(), contextlib.suppress(Exception):
        warnings.simplefilter("ignore")
        with Image.open(path) as image:
            return image.width * image.height
    return 0


def write_companions(folder: Path) -> None:
    """Write the files that others name."""
    for name, data in FILES.items():
        (folder / name).write_bytes(data)


# ---- by itself ----


def run(number: int, seconds: float, suffixes: list[str], keep: Path) -> tuple[int, int, int]:
    """Try cases for so long; return how many there were, how many loaded, how many findings."""
    start, cases, loaded, findings = seeds(), 0, 0, 0
    end = time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as folder:
        write_companions(Path(folder))
        while time.monotonic() < end and findings < 20:
            choice = random.Random(f"{number} {cases}")
            suffix = suffixes[cases % len(suffixes)]
            name, data = make_case(choice, start, suffix)
            if choice.random() < ENLARGED:
                data = enlarged(data, choice, choice.choice([LARGE // 8, 2 * LARGE]))
            try:
                loaded += check(Path(folder), name, data, draw=cases % 16 == 0)
            except Exception:
                findings += 1
                keep.mkdir(parents=True, exist_ok=True)
                kept = keep / f"{number}-{cases}-{name}"
                kept.write_bytes(data)
                print(f"{kept}\n{traceback.format_exc(limit=-4)}", flush=True)
            cases += 1
    return cases, loaded, findings


def run_by_coverage(seconds: int, suffixes: list[str], keep: Path) -> None:
    """Let atheris choose the bytes: the first says which format, the others are the file."""
    import atheris

    keep.mkdir(parents=True, exist_ok=True)
    folder = Path(tempfile.mkdtemp())
    write_companions(folder)

    def one(data: bytes) -> None:
        if data:
            suffix = suffixes[data[0] % len(suffixes)]
            check(folder, ("house" if suffix == ".mtl" else "case") + suffix, data[1:], slack=20)

    corpus = folder / "corpus"
    corpus.mkdir()
    for k, suffix in enumerate(suffixes):
        for i, data in enumerate(seeds()[suffix]):
            (corpus / f"{suffix[1:]}-{i}").write_bytes(bytes([k]) + data)
    options = [f"-max_total_time={seconds}", "-max_len=8192", "-rss_limit_mb=4096"]
    atheris.Setup([sys.argv[0], *options, f"-artifact_prefix={keep}/", str(corpus)], one)
    atheris.Fuzz()


def main() -> int:
    parser = argparse.ArgumentParser(description="Fuzz the readers of files.")
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--first", type=int, default=0, help="another number, other files")
    parser.add_argument("--only", help="extensions, with commas; all by default")
    parser.add_argument("--coverage", action="store_true", help="atheris chooses the bytes")
    parser.add_argument("--keep", type=Path, default=Path("findings"), help="where findings go")
    arguments = parser.parse_args()
    wanted = arguments.only.split(",") if arguments.only else None
    suffixes = [s for s in sorted(seeds()) if wanted is None or s[1:] in wanted]
    if arguments.coverage:
        run_by_coverage(arguments.seconds, suffixes, arguments.keep)
        return 0
    jobs = [(arguments.first + k, arguments.seconds, suffixes, arguments.keep) for k in range(2)]
    with multiprocessing.Pool(2) as pool:
        results = pool.starmap(run, jobs)
    cases, loaded, findings = (sum(column) for column in zip(*results, strict=True))
    print(f"{cases} files, {loaded} loaded, {findings} findings")
    return int(findings > 0)


if __name__ == "__main__":
    sys.exit(main())
