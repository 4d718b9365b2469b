"""What a program registers itself, and what readers get and may return."""

import gzip

import numpy as np
import pytest

import engine3d as e3d
from engine3d import plugins
from engine3d.base.plugins import registry
from engine3d.io.reading.sources import endings


@pytest.fixture(autouse=True)
def nothing_stays(monkeypatch):
    monkeypatch.setattr(registry, "_registered", {})


def boxes(file):
    """Return a box of the size in the file."""
    return e3d.box(float(file.read()))


def test_registered_readers_are_used_until_they_are_taken_back(tmp_path):
    path = tmp_path / "a.vox"
    path.write_text("2")
    plugins.register("readers", "vox", boxes)
    assert e3d.load_mesh(path).bounds[1].tolist() == [1, 1, 1]
    assert [str(each) for each in plugins.listed()] == [
        "the program's plug-in 'vox' of engine3d.readers"
    ]
    plugins.unregister("engine3d.readers", "vox")
    with pytest.raises(e3d.FileFormatError, match="unknown mesh format"):
        e3d.load_mesh(path)
    with pytest.raises(e3d.InvalidArgumentError, match="'vox' was not registered among the read"):
        plugins.unregister("readers", "vox")


@pytest.mark.parametrize(
    ("group", "name", "said"),
    [
        ("reader", "vox", "group must be one of readers, .* not 'reader': did you mean readers?"),
        ("readers", "stl", "'stl' is a name of engine3d's own readers"),
        ("writers", "json", "'json' is a name of engine3d's own writers"),
        ("datasets", "coco", "'coco' is a name of engine3d's own datasets"),
        ("commands", "render", "'render' is a name of engine3d's own commands"),
        ("scenes", "city", "'city' is a name of engine3d's own scenes"),
        ("looks", "plain", "'plain' is a name of engine3d's own looks"),
        ("readers", ".vox", "name must be the extension of a file in lower case, without a dot"),
        ("readers", "VOX", "name must be the extension of a file in lower case, .* not 'VOX'"),
        ("writers", "a/b", "name must be the extension of a file in lower case, .* not 'a/b'"),
        ("writers", "a\0", "name must be the extension of a file"),
        ("readers", "", "name must be"),
    ],
)
def test_wrong_names_are_refused(group, name, said):
    with pytest.raises(e3d.InvalidArgumentError, match=said):
        plugins.register(group, name, boxes)


@pytest.mark.parametrize(
    ("group", "value", "said"),
    [
        ("readers", 3, "readers take a function, not 3"),
        ("datasets", e3d.Look, "datasets take a DatasetWriter, not <class"),
        ("looks", e3d.Look, "looks take a Look, not <class"),
    ],
)
def test_wrong_values_are_refused(group, value, said):
    with pytest.raises(e3d.InvalidArgumentError, match=f"value cannot be registered: {said}"):
        plugins.register(group, "demo", value)


def test_a_registered_one_replaces_an_installed_one(package, tmp_path):
    package("def read(file): 1 / 0", readers={"vox": "{0}:read"})
    (tmp_path / "a.vox").write_text("2")
    plugins.register("readers", "vox", boxes)
    assert len(e3d.load_mesh(tmp_path / "a.vox").faces) == 12


def test_a_reader_gets_the_content_and_a_path_where_there_is_one(tmp_path):
    seen = []

    def read(file):
        seen.append((file.read(), file.path, file.name))
        return e3d.box()

    plugins.register("readers", "vox", read)
    path = tmp_path / "a.vox"
    path.write_bytes(b"data")
    e3d.load_mesh(path)
    assert seen.pop() == (b"data", str(path), str(path))
    packed = tmp_path / "b.vox.gz"
    packed.write_bytes(gzip.compress(b"data"))
    e3d.load_mesh(packed)
    assert seen.pop() == (b"data", None, str(packed))
    e3d.load_mesh(b"data", format="vox")
    assert seen.pop() == (b"data", None, "<bytes>")
    with path.open("rb") as file:
        e3d.load_mesh(file)
    assert seen.pop() == (b"data", None, str(path))


def test_files_named_in_a_model_stay_in_its_folder(tmp_path):
    def read(file):
        return e3d.box(float(file.open(file.read().decode()).read()))

    plugins.register("readers", "vox", read)
    folder = tmp_path / "models"
    folder.mkdir()
    (folder / "size.txt").write_text("4")
    (tmp_path / "secret.txt").write_text("6")
    (folder / "a.vox").write_text("SIZE.txt")
    assert e3d.load_mesh(folder / "a.vox").bounds[1, 0] == 2
    for name in ("../secret.txt", str(tmp_path / "secret.txt"), "none.txt"):
        (folder / "a.vox").write_text(name)
        with pytest.raises(e3d.FileAccessError):
            e3d.load_mesh(folder / "a.vox")
    (folder / "a.vox").write_text("../secret.txt")
    assert e3d.load_mesh(folder / "a.vox", root=tmp_path).bounds[1, 0] == 3


def lit_scene(file):
    scene = e3d.Scene(background="white")
    mesh = e3d.box()
    scene.add(mesh, name="left", translation=(-2, 0, 0))
    scene.add(mesh, name="right", translation=(2, 0, 0))
    scene.add(e3d.PointLight(), translation=(0, 5, 0))
    scene.add(e3d.box(), name="hidden").visible = False
    file.warn("half of it is left out")
    return scene


def test_a_scene_is_kept_whole_and_is_each_callers_own(tmp_path):
    plugins.register("readers", "vox", lit_scene)
    path = tmp_path / "a.vox"
    path.write_text("x")
    with pytest.warns(e3d.Engine3DWarning, match=r"a\.vox: half of it is left out"):
        scene = e3d.load_scene(path)
    assert [node.name for node in scene.nodes] == ["left", "right", "", "hidden"]
    assert scene.warnings == [f"{path}: half of it is left out"]
    assert scene.background == (255, 255, 255)
    with pytest.warns(e3d.Engine3DWarning):
        mesh = e3d.load_mesh(path)
    assert mesh.bounds[:, 0].tolist() == [-2.5, 2.5] and len(mesh.faces) == 24
    with pytest.warns(e3d.Engine3DWarning):
        document = e3d.loaders.load_document(path)
    from engine3d.io.scenes.scene_loading import scene_from_document

    first, second = scene_from_document(document), scene_from_document(document)
    assert first is not second and first.nodes[0].object is second.nodes[0].object


def test_instances_count_as_meshes(tmp_path):
    poses = np.array([np.eye(4), np.eye(4)])
    poses[1, 0, 3] = 5

    def read(file):
        scene = e3d.Scene()
        scene.add(e3d.InstancedMesh(e3d.box(), poses), translation=(1, 0, 0))
        return scene

    plugins.register("readers", "vox", read)
    (tmp_path / "a.vox").write_text("x")
    assert e3d.load_mesh(tmp_path / "a.vox").bounds[:, 0].tolist() == [0.5, 6.5]


def test_the_up_axis_and_what_is_not_finite(tmp_path):
    def read(file):
        return e3d.Mesh([[0, 0, 0], [1, 0, 0], [0, 0, 1], [np.nan, 0, 0]], [[0, 1, 2], [0, 1, 3]])

    read.up = "+Z"
    plugins.register("readers", "vox", read)
    (tmp_path / "a.vox").write_text("x")
    with pytest.warns(e3d.Engine3DWarning, match="1 of 4 vertices have coordinates that are not"):
        scene = e3d.load(tmp_path / "a.vox")
    assert scene.find("upright") is not None


def test_a_mesh_without_vertices_is_refused(tmp_path):
    plugins.register("readers", "vox", lambda file: e3d.Mesh(np.zeros((0, 3)), []))
    (tmp_path / "a.vox").write_text("x")
    with pytest.raises(e3d.FileFormatError, match=r"a\.vox: no vertices in this file"):
        e3d.load_mesh(tmp_path / "a.vox")


def test_extensions_of_several_words(tmp_path):
    assert endings("/x/a.Vox.XML.gz") == ["vox.xml.gz", "vox.xml", "xml.gz", "xml", "gz"]
    assert endings("a") == [] and endings("<bytes>") == []
    plugins.register("readers", "vox.xml", boxes)
    path = tmp_path / "a.b.VOX.xml"
    path.write_text("2")
    assert len(e3d.load_mesh(path).faces) == 12
    plugins.register("writers", "vox.xml", lambda scene, file: file.write(b"x") and None)
    e3d.save_mesh(e3d.box(), path)
    assert path.read_bytes() == b"x"


def test_a_writer_may_seek_and_close(tmp_path):
    import zipfile

    def write(scene, file):
        with zipfile.ZipFile(file, "w") as archive:
            archive.writestr("count", str(len(scene.nodes)))
        file.close()

    plugins.register("writers", "vox", write)
    e3d.save_mesh(e3d.box(), tmp_path / "a.vox")
    with zipfile.ZipFile(tmp_path / "a.vox") as archive:
        assert archive.read("count") == b"1"
    with (tmp_path / "b.vox").open("wb") as file:
        e3d.save_mesh(e3d.box(), file, format="vox")
    assert zipfile.is_zipfile(tmp_path / "b.vox")


def test_a_registered_scene_look_and_kind():
    plugins.register("looks", "mine", e3d.Look.plain(background="red"))
    assert e3d.render(e3d.Scene(), size=(4, 4), look="mine").color.shape == (4, 4, 4)
    with pytest.raises(e3d.InvalidArgumentError, match='"studio", "plain", "mine" or a Look'):
        e3d.render(e3d.box(), look="yours")
    assert e3d.batch.Task("a", model="a.obj", look="mine").look == "mine"
    with pytest.raises(e3d.InvalidArgumentError, match="one of None, 'studio', 'plain', 'mine"):
        e3d.batch.Task("a", model="a.obj", look="yours")
