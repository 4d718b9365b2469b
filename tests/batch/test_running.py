"""Batches: who draws changes no byte, nothing is half written, what is there stays."""

import hashlib
import json
import shutil
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from missing_here import KILLED, is_running
from patience import HUNG

import engine3d as e3d
from engine3d.apps.batch.processes import ProcessPool
from engine3d.apps.cli import main
from engine3d.batch import Task, read_manifest, run
from engine3d.datasets import CocoWriter, WebDatasetWriter

MODEL = {"model": "model.obj"}
SCRIPT = {"script": "script.py"}


def files_in(folder):
    """The bytes of all files, records included, but for the lock."""
    paths = [path for path in Path(folder).rglob("*") if path.is_file() and path.name != "lock"]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}


@pytest.fixture
def tasks(manifest):
    """Twelve pictures by a script and two of a model."""
    matrix = {"seed": {"count": 12}}
    cameras = [{"azimuth_degrees": 20}, {"position": [0, 1, 5], "target": [0, 1, 0]}]
    path = manifest(
        {**SCRIPT, "matrix": matrix},
        {**MODEL, "matrix": {"camera": cameras}, "outputs": ["color.tga", "depth"]},
    )
    return read_manifest(path).tasks


@pytest.fixture
def serial(tasks, tmp_path):
    """What one process draws."""
    summary = run(tasks, tmp_path / "serial", jobs=1)
    assert (summary.drawn, summary.failures) == (14, [])
    return summary, files_in(tmp_path / "serial")


def test_pictures_are_those_of_the_scene_api(tasks, serial, place):
    _, files = serial
    scene = e3d.load_scene(place / "model.obj")
    camera = e3d.PerspectiveCamera(np.radians(50.0), znear=1.0, zfar=9.0)
    pose = e3d.look_at((0, 1, 5), (0, 1, 0))
    frame = e3d.render(
        scene, (camera, pose), size=(24, 16), samples=4, cull="auto", outputs=("color", "depth")
    )
    (place / "drawn.tga").write_bytes(frame.encode("tga"))
    assert files["model_1.tga"] == (place / "drawn.tga").read_bytes()
    np.save(place / "depth.npy", frame.depth)
    depth = np.load(place / "serial" / "model_1.depth.npy")
    np.testing.assert_allclose(depth, frame.depth, rtol=1e-6)


def test_looks_are_those_of_the_command(place, manifest):
    camera = {"azimuth_degrees": 25.0, "elevation_degrees": 10.0}
    task = {**MODEL, "look": "studio", "camera": camera, "antialiasing": "msaa", "name": "a"}
    run(read_manifest(manifest(task)).tasks, place / "out", jobs=1)
    drawn = place / "drawn.png"
    angles = ["--camera-azimuth-angle", "25", "--camera-elevation-angle", "10"]
    arguments = ["render", str(place / "model.obj"), "-o", str(drawn), "--size", "24x16"]
    assert main([*arguments, *angles]) == 0
    assert (place / "out" / "a.png").read_bytes() == drawn.read_bytes()


@pytest.mark.parametrize("look", [{}, {"look": "plain"}])
def test_a_picture_beside_its_model_does_not_become_its_texture(place, manifest, look):
    (place / "model.obj").write_text("v -1 0 0\nv 1 0 0\nv 0 2 0\nvt 0 0\nf 1/1 2/1 3/1\n")
    tasks = read_manifest(manifest({**MODEL, **look})).tasks
    first = run(tasks, place, jobs=1)
    picture = (place / "model.png").read_bytes()
    assert run(tasks, place, jobs=1).hash == first.hash
    assert (place / "model.png").read_bytes() == picture
    assert run(tasks, place, jobs=1, resume=True).done_before == 1


def test_processes_draw_the_same_bytes(tasks, serial, tmp_path):
    summary, files = serial
    other = run(tasks, tmp_path / "other", jobs=2, backend="portable", threads=1)
    assert other.hash == summary.hash
    assert files_in(tmp_path / "other") == files


def test_any_executor_draws_the_same_bytes(tasks, serial, tmp_path):
    summary, files = serial
    with ThreadPoolExecutor(3) as executor:
        assert run(tasks, tmp_path / "threads", executor=executor).hash == summary.hash
    assert files_in(tmp_path / "threads") == files


def test_the_list_is_one_that_sha256sum_checks(serial):
    summary, files = serial
    lines = files["SHA256SUMS"].decode().splitlines()
    assert hashlib.sha256(files["SHA256SUMS"]).hexdigest() == summary.hash
    for line in lines:
        digest, path = line.split("  ")
        assert hashlib.sha256(files[path]).hexdigest() == digest
    pictures = {path for path in files if not path.startswith(".batch")} - {"SHA256SUMS"}
    assert [line.split("  ")[1] for line in lines] == sorted(pictures)


def test_resuming_draws_what_is_not_there(tasks, serial, tmp_path):
    summary, files = serial
    folder = tmp_path / "serial"
    (folder / "script_3.png").unlink()
    (folder / "script_4.png").write_bytes(files["script_4.png"][:-1])
    (folder / ".batch" / "script_5.json").unlink()
    (folder / ".batch" / "script_6.json").write_text("{")
    (folder / ".script_7.png.0123456789abcdef.part").write_bytes(b"half")
    again = run(tasks, folder, jobs=1, resume=True)
    assert (again.drawn, again.done_before, again.hash) == (4, 10, summary.hash)
    assert files_in(folder) == files


def test_resuming_draws_what_follows_from_other_files(tasks, serial, place):
    folder = place / "serial"
    script = (place / "script.py").read_text()
    (place / "script.py").write_text(script + "\n# changed\n")
    assert run(tasks, folder, jobs=1, resume=True).drawn == 12
    (place / "model.obj").write_text("v -1 0 0\nv 1 0 0\nv 0 3 0\nf 1 2 3\n")
    assert run(tasks, folder, jobs=1, resume=True).drawn == 2
    assert run(tasks, folder, jobs=1, resume=True).drawn == 0


def test_textures_and_declared_files_count(place, manifest):
    (place / "model.mtl").write_text("newmtl a\nmap_Kd picture.png\n")
    (place / "model.obj").write_text(
        "mtllib model.mtl\nusemtl a\nv -1 0 0\nv 1 0 0\nv 0 2 0\nvt 0 0\nf 1/1 2/1 3/1\n"
    )
    frame = e3d.render(e3d.Scene(background=(200, 10, 10)), size=(2, 2))
    frame.save(place / "picture.png")
    (place / "table").write_text("1")
    tasks = read_manifest(manifest({**MODEL, "inputs": ["table"]})).tasks
    first = run(tasks, place / "out", jobs=1).hash
    e3d.render(e3d.Scene(background=(20, 10, 210)), size=(2, 2)).save(place / "picture.png")
    second = run(tasks, place / "out", jobs=1, resume=True)
    assert second.drawn == 1 and second.hash != first
    (place / "table").write_text("2")
    assert run(tasks, place / "out", jobs=1, resume=True).drawn == 1
    assert run(tasks, place / "out", jobs=1, resume=True).drawn == 0


def test_a_model_on_another_drive_counts(place, manifest, monkeypatch):
    tasks = read_manifest(manifest(MODEL)).tasks

    def refused(path, start):  # as on Windows
        raise ValueError("path is on mount 'D:', start on mount 'C:'")

    monkeypatch.setattr("os.path.relpath", refused)
    assert run(tasks, place / "out", jobs=1).drawn == 1
    assert run(tasks, place / "out", jobs=1, resume=True).done_before == 1
    (place / "model.obj").write_text("v -1 0 0\nv 1 0 0\nv 0 3 0\nf 1 2 3\n")
    assert run(tasks, place / "out", jobs=1, resume=True).drawn == 1


def test_modules_beside_a_script_count(place, manifest):
    (place / "sizes.py").write_text("SIDE = 1.0\n")
    (place / "with_sizes.py").write_text(
        "import engine3d as e3d\nfrom sizes import SIDE\n\n"
        "def build(scene, generator):\n    scene.add(e3d.plane((SIDE, 1.0)), euler=(1, 0, 0))\n"
    )
    tasks = read_manifest(manifest({"script": "with_sizes.py"})).tasks
    first = run(tasks, place / "out", jobs=1)
    (place / "sizes.py").write_text("SIDE = 0.5\n")
    second = run(tasks, place / "out", jobs=1, resume=True)
    assert second.drawn == 1 and second.hash != first.hash


def test_what_a_script_changes_does_not_reach_other_pictures(place, manifest):
    path = manifest({**SCRIPT, "function": "change", "matrix": {"seed": [1, 2, 3]}})
    tasks = read_manifest(path).tasks
    run(tasks, place / "all", jobs=1)
    for task in tasks:
        run([task], place / "one", jobs=1)
        name = f"{task.name}.png"
        assert (place / "one" / name).read_bytes() == (place / "all" / name).read_bytes()


def test_a_script_writes_over_no_output(place, manifest):
    said = {"value": {"files": {"depth.npy": "text"}}}
    task = {**SCRIPT, "function": "returned", "arguments": said, "outputs": ["depth"], "name": "a"}
    summary = run(read_manifest(manifest(task)).tasks, place / "out", jobs=1)
    assert summary.failures[0].error.startswith("a.depth.npy is written twice")


def test_a_script_may_write_files_beside(place, manifest):
    tasks = read_manifest(manifest({**SCRIPT, "function": "beside", "name": "a"})).tasks
    run(tasks, place / "out", jobs=1)
    assert np.load(place / "out" / "a.points.npy").tolist() == [0, 1, 2]
    assert json.loads((place / "out" / "a.said.json").read_text()) == {"seed": 1}
    assert (place / "out" / "a.words.txt").read_text() == "text"


FAILING = [
    ({**SCRIPT, "function": "fail"}, "script.py:36: ValueError: no such thing"),
    ({**SCRIPT, "function": "nothing"}, "script.py: there is no function nothing"),
    ({**SCRIPT, "arguments": {"size": 1}}, "TypeError: build() got an unexpected keyword"),
    ({**SCRIPT, "function": "returned"}, "what returned returned: must be None or a dict, not 3"),
    (
        {**SCRIPT, "function": "returned", "arguments": {"value": {"labels": 3}}},
        "labels must be a dict",
    ),
    (
        {**SCRIPT, "function": "returned", "arguments": {"value": {"files": {"../a": 1}}}},
        "files: '../a' is no end of a file's name",
    ),
    (
        {**SCRIPT, "function": "returned", "arguments": {"value": {"camera": 1}}},
        "camera must be a node of a camera, or (camera, pose)",
    ),
    (
        {**SCRIPT, "function": "returned", "arguments": {"value": {"labels": {"a": "b"}}}},
        "labels: 'a' is no node of the scene",
    ),
    ({"script": "broken.py"}, "broken.py:2: SyntaxError: "),
    ({"script": "none.py"}, "none.py: FileNotFoundError: "),
    ({"model": "none.obj"}, "none.obj: "),
    ({**MODEL, "camera": 2}, "the scene has no camera 2 (there are none)"),
]


def test_failures_name_the_task_and_the_reason(place, manifest):
    (place / "broken.py").write_text("# a\nx = (\n")
    entries = [{"name": f"t{n}", **task} for n, (task, _) in enumerate(FAILING)]
    tasks = read_manifest(manifest(*entries, {**MODEL, "name": "fine"})).tasks
    summary = run(tasks, place / "out", jobs=1, writer=CocoWriter())
    assert summary.drawn == 1
    assert [failure.name for failure in summary.failures] == [entry["name"] for entry in entries]
    for failure, (_, message) in zip(summary.failures, FAILING, strict=True):
        assert message in failure.error and "\n" not in failure.error
    assert {path.name for path in (place / "out").rglob("*.png")} == {"fine.png"}


def test_a_killed_process_loses_nothing(place, manifest):
    entries = [{**SCRIPT, "name": f"t{n}", "seed": n} for n in range(6)]
    entries[2]["function"] = "die_once"
    tasks, said = read_manifest(manifest(*entries)).tasks, []
    summary = run(
        tasks, place / "out", jobs=2, progress=lambda task, outcome, text: said.append(text)
    )
    assert summary.drawn + summary.done_before == 6 and not summary.failures
    told = [text for text in said if f"{KILLED} while it drew" in text]
    assert len(told) == 1 and "t2" in told[0] and told[0].endswith(": drawn again")
    shutil.rmtree(place / "serial", ignore_errors=True)
    assert run(tasks, place / "serial", jobs=1).hash == summary.hash


def test_a_picture_that_kills_its_process_fails_alone(place, manifest):
    entries = [{**SCRIPT, "name": f"t{n}", "seed": n} for n in range(4)]
    entries[1]["function"] = "die"
    with ProcessPool(1) as pool:
        summary = run(read_manifest(manifest(*entries)).tasks, place / "out", executor=pool)
    assert [failure.name for failure in summary.failures] == ["t1"]
    assert KILLED in summary.failures[0].error
    assert summary.drawn + summary.done_before == 3


def test_an_executor_that_was_shut_down_fails_all(tasks, tmp_path):
    executor = ThreadPoolExecutor(1)
    executor.shutdown()
    summary = run(tasks, tmp_path / "out", executor=executor)
    assert len(summary.failures) == len(tasks) and summary.drawn == 0
    assert summary.failures[3].error.startswith("the executor takes no more calls: ")


def test_the_process_group_ends_with_whoever_asked(place, manifest):
    tasks = read_manifest(manifest({**SCRIPT, "function": "wait"})).tasks
    with ProcessPool(1) as pool:
        from engine3d.apps.batch.drawing import How, draw_chunk

        how = How(str(place / "out"), None, 1, "auto", False, e3d.__version__)
        pool.submit(draw_chunk, tasks, how)
        deadline = time.monotonic() + HUNG
        while not (waiting := list(place.glob("waiting*"))):
            assert time.monotonic() < deadline
            time.sleep(0.02)
        (process,) = pool.process_ids()
        assert waiting[0].name == f"waiting{process}"
    assert not is_running(process)


def test_another_version_is_refused(tasks, tmp_path):
    from engine3d.apps.batch.drawing import How, draw_chunk

    how = How(str(tmp_path), None, 1, "auto", False, "0.0")
    with pytest.raises(e3d.InvalidArgumentError, match="0.0 asks it"):
        draw_chunk(tasks[:1], how)


def test_one_batch_at_a_time_writes_to_a_folder(tasks, tmp_path):
    from engine3d.apps.batch.locking import locked_folder

    (tmp_path / "out" / ".batch").mkdir(parents=True)
    with locked_folder(str(tmp_path / "out" / ".batch")):
        with pytest.raises(e3d.FileAccessError, match="another batch writes"):
            run(tasks, tmp_path / "out", jobs=1)


def test_data_sets_do_not_depend_on_who_draws(place, manifest):
    path = manifest({**SCRIPT, "matrix": {"seed": {"count": 10}}})
    tasks = read_manifest(path).tasks
    for writer in (CocoWriter(), WebDatasetWriter(["color", "depth"], shard=4)):
        first = run(tasks, place / "a", writer=writer, jobs=1)
        with ThreadPoolExecutor(2) as executor:
            second = run(tasks, place / "b", writer=writer, executor=executor)
        assert first.hash == second.hash and first.drawn == 10
        assert files_in(place / "a") == files_in(place / "b")
        shutil.rmtree(place / "a")
        shutil.rmtree(place / "b")


def test_packed_pictures_are_done(place, manifest):
    tasks = read_manifest(manifest({**SCRIPT, "matrix": {"seed": {"count": 5}}})).tasks
    writer = WebDatasetWriter(shard=2)
    first = run(tasks, place / "out", writer=writer, jobs=1)
    before = files_in(place / "out")
    again = run(tasks, place / "out", writer=writer, jobs=1, resume=True)
    assert (again.drawn, again.done_before, again.hash) == (0, 5, first.hash)
    (place / "out" / ".batch" / f"{tasks[2].name}.json").unlink()
    again = run(tasks, place / "out", writer=writer, jobs=1, resume=True)
    assert (again.drawn, again.hash) == (1, first.hash)
    assert files_in(place / "out") == before


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"jobs": 0}, "must be a whole number"),
        ({"threads": 1.5}, "must be a whole number"),
        ({"timeout": 0}, "timeout must be a number of seconds, not 0"),
        ({"timeout": "3"}, "timeout must be a number or None, not '3'"),
        ({"jobs": 1, "scheduler": "tcp://a:1"}, "give one of"),
        ({"executor": 3}, "executor must have a method submit"),
    ],
)
def test_wrong_arguments_are_errors(tasks, tmp_path, arguments, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        run(tasks, tmp_path / "out", **arguments)


@pytest.mark.parametrize(("one", "other"), [("Chair", "chair"), ("\u00e9", "\u00c9")])
def test_names_that_some_system_takes_for_one_are_used_once(tmp_path, one, other):
    tasks = [Task(name=f"a/{name}1", model="a.obj") for name in (one, other)]
    with pytest.raises(e3d.InvalidArgumentError, match="one on Windows and macOS, 'a/"):
        run(tasks, tmp_path / "out")


@pytest.mark.parametrize("name", ["con", "aux.1", "COM1", "a/nul", "lpt1/a", "a./b", "a /b"])
def test_names_are_files_of_every_system(name):
    with pytest.raises(e3d.InvalidArgumentError, match="name must name files of every system"):
        Task(name=name, model="a.obj")


def test_names_that_only_look_like_devices_stand():
    for name in ("console", "com", "a.con", "con_1", "v1.", "a "):
        assert Task(name=name, model="a.obj").name == name


def test_names_are_used_once(tmp_path):
    tasks = [Task(name="a", model="a.obj"), Task(name="a", model="b.obj")]
    with pytest.raises(e3d.InvalidArgumentError, match="two tasks have the name 'a'"):
        run(tasks, tmp_path / "out")
