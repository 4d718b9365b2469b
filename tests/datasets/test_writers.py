"""Data sets as files: what COCO's library and plain arithmetic make of them."""

import hashlib
import io
import json
import tarfile
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.apps.datasets.opencv_cameras import intrinsics_of
from engine3d.datasets import (
    BopWriter,
    CocoWriter,
    FolderWriter,
    Sample,
    WebDatasetWriter,
    decode_rle,
    write_dataset,
)

BOP = {"depth_scale": 0.5}


def pixels(path):
    with Image.open(path) as image:
        return np.asarray(image)


def drawn(make_samples, writer, count=1):
    return list(make_samples(writer, count))


# ---- COCO ----


def test_coco_tells_what_shows(make_samples, tmp_path):
    writer = CocoWriter()
    paths = write_dataset(tmp_path, writer, make_samples(writer, 2))
    assert paths == ["images/p0.png", "images/p1.png", "annotations.json", "README.txt"]
    told = json.loads((tmp_path / "annotations.json").read_text())
    assert [c["name"] for c in told["categories"]] == ["ball", "box", "pair"]
    assert [i["file_name"] for i in told["images"]] == ["p0.png", "p1.png"]
    first = drawn(make_samples, writer)[0]
    ids = [{2}, {3}, {1}, {5, 6}]
    names = [2, 3, 1]
    assert names == [node.id for node in (first.scene.find(n) for n in ("near", "far", "box"))]
    of_first = [a for a in told["annotations"] if a["image_id"] == 1]
    assert [a["category_id"] for a in of_first] == [2, 1, 1, 3]  # in the order of the nodes' ids
    for entry, shown in zip(of_first, [ids[2], ids[0], ids[1], ids[3]], strict=True):
        mask = np.isin(first.frame.object_id, list(shown))
        assert np.array_equal(decode_rle(entry["segmentation"]), mask)
        assert entry["area"] == mask.sum()
        x, y, width, height = entry["bbox"]
        inside = mask[y : y + height, x : x + width]
        assert inside.sum() == mask.sum()
        assert inside[[0, -1]].any(axis=1).all() and inside[:, [0, -1]].any(axis=0).all()
    assert np.array_equal(pixels(tmp_path / "images" / "p0.png"), first.frame.color[..., :3])


def test_coco_has_other_outputs_beside_its_own(make_samples, tmp_path):
    """As webdataset and folders; the annotations and pictures stay what they are without them."""
    plain, writer = CocoWriter(), CocoWriter(outputs=["depth", "object_id"])
    write_dataset(tmp_path / "plain", plain, make_samples(plain, 1))
    paths = write_dataset(tmp_path / "more", writer, make_samples(writer, 1))
    own = ["images/p0.png", "annotations.json"]
    assert paths == [own[0], "depth/p0.npy", "object_id/p0.npy", own[1], "README.txt"]
    for path in own:
        assert (tmp_path / "more" / path).read_bytes() == (tmp_path / "plain" / path).read_bytes()
    frame = drawn(make_samples, writer)[0].frame
    for name in ("depth", "object_id"):
        assert np.array_equal(np.load(tmp_path / "more" / name / "p0.npy"), getattr(frame, name))


def test_coco_as_its_own_library_reads_it(make_samples, tmp_path):
    coco = pytest.importorskip("pycocotools.coco", reason="pip install pycocotools")
    writer = CocoWriter(["pair", "box", "ball"])
    write_dataset(tmp_path, writer, make_samples(writer, 2))
    read = coco.COCO(str(tmp_path / "annotations.json"))
    assert sorted(read.getImgIds()) == [1, 2]
    assert [c["id"] for c in read.loadCats(read.getCatIds())] == [1, 2, 3]
    for annotation in read.loadAnns(read.getAnnIds()):
        assert read.annToMask(annotation).sum() == annotation["area"] > 0
        box = coco.maskUtils.toBbox(annotation["segmentation"])
        assert box.tolist() == annotation["bbox"]


def test_categories_are_those_that_are_listed(make_samples):
    writer = CocoWriter(["ball", "box"])
    with pytest.raises(e3d.InvalidArgumentError, match="'pair' is not one of the categories ball"):
        writer.describe(drawn(make_samples, writer)[0])
    for wrong in ([], ["a", "a"], "ab", [""], [3]):
        with pytest.raises(e3d.InvalidArgumentError, match="categories"):
            CocoWriter(wrong)


# ---- BOP ----


@pytest.fixture(scope="module")
def bop(tmp_path_factory):
    from datasets.conftest import HEIGHT, WIDTH, sample

    folder, writer = tmp_path_factory.mktemp("bop"), BopWriter("train_pbr", scene_size=2, **BOP)
    renderer = e3d.Renderer((WIDTH, HEIGHT), samples=4, threads=1)
    samples = [sample(renderer, writer.outputs, index) for index in range(3)]
    write_dataset(folder, writer, samples)
    return folder / "train_pbr", samples


def told(folder, name, scene=0):
    return json.loads((folder / f"{scene:06d}" / f"{name}.json").read_text())


def test_bop_has_its_folders(bop):
    folder, _ = bop
    names = {path.relative_to(folder).as_posix() for path in folder.rglob("*.png")}
    assert {f"{k // 2:06d}/{kind}/{k % 2:06d}.png" for k in range(3) for kind in ("rgb", "depth")}
    assert "000001/mask_visib/000000_000003.png" in names and len(names) == 3 * (2 + 8)
    assert list(told(folder, "scene_gt")) == ["0", "1"]
    assert list(told(folder, "scene_gt", 1)) == ["0"]


def test_bop_depths_are_the_frames(bop):
    folder, samples = bop
    depth = pixels(folder / "000000" / "depth" / "000000.png")
    millimetres = samples[0].frame.depth * 1000.0
    assert depth.max() > 4000 and (depth == 0).any()
    assert np.abs(depth * 0.5 - millimetres).max() <= 0.26
    assert np.array_equal(depth > 0, millimetres > 0)


def test_bop_poses_and_matrices_lead_to_the_pixels(bop):
    folder, samples = bop
    truth, cameras = told(folder, "scene_gt")["0"], told(folder, "scene_camera")["0"]
    k = np.array(cameras["cam_K"]).reshape(3, 3)
    names = ["box", "near", "far", "pair"]
    assert [entry["obj_id"] for entry in truth] == [2, 1, 1, 3]
    for entry, name in zip(truth, names, strict=True):
        node = samples[0].scene.find(name)
        rotation = np.array(entry["cam_R_m2c"]).reshape(3, 3)
        points = np.array([[0.1, 0.2, -0.1], [-0.2, 0.0, 0.15]])
        of_camera = points * 1000.0 @ rotation.T + entry["cam_t_m2c"]
        u, v, w = k @ of_camera.T
        in_world = points @ node.world_pose[:3, :3].T + node.world_pose[:3, 3]
        expected, depth = samples[0].frame.project(in_world)
        np.testing.assert_allclose(np.stack([u / w, v / w], 1), expected - 0.5, atol=1e-9)
        np.testing.assert_allclose(of_camera[:, 2], depth * 1000.0, rtol=1e-12)
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)


def test_bop_masks_and_counts(bop):
    folder, samples = bop
    frame, scene = samples[0].frame, folder / "000000"
    depth = pixels(scene / "depth" / "000000.png")
    for number, entry in enumerate(told(folder, "scene_gt_info")["0"]):
        whole = pixels(scene / "mask" / f"000000_{number:06d}.png") > 0
        visible = pixels(scene / "mask_visib" / f"000000_{number:06d}.png") > 0
        node = samples[0].scene.nodes[(1, 2, 3, 4)[number]]
        parts = [node.id, *(child.id for child in node.children)]
        assert np.array_equal(visible, np.isin(frame.object_id, parts))
        assert not (visible & ~whole).any()
        assert entry["px_count_visib"] == visible.sum()
        assert entry["px_count_valid"] == (depth[whole] > 0).sum()
        assert entry["visib_fract"] == visible.sum() / entry["px_count_all"]
        rows, columns = np.nonzero(visible)
        x, y, width, height = entry["bbox_visib"]
        assert (x, y) == (columns.min(), rows.min())
        assert (x + width, y + height) == (columns.max(), rows.max())
        if number != 0:  # nothing of it is outside of the picture
            assert entry["px_count_all"] == whole.sum()
    infos = told(folder, "scene_gt_info")["0"]
    assert infos[1]["visib_fract"] == 1.0 and 0.2 < infos[2]["visib_fract"] < 0.9


def test_bop_counts_what_the_edge_cuts_off(bop):
    folder, samples = bop
    info = told(folder, "scene_gt_info")["0"][0]
    first = samples[0]
    box = first.scene.find("box")
    alone = e3d.Scene()
    alone.add(box.object, pose=box.world_pose)
    fx, _, cx, _, fy, cy, *_ = intrinsics_of(first.camera, 60, 40)
    wide = e3d.IntrinsicsCamera(fx, fy, cx + 60.5, cy + 40.5, znear=0.5, zfar=20.0)
    larger = e3d.render(
        alone, (wide, first.pose), size=(180, 120), samples=4, outputs=("object_id",)
    )
    rows, columns = np.nonzero(larger.object_id >= 0)
    inside = pixels(folder / "000000" / "mask" / "000000_000000.png") > 0
    assert info["px_count_all"] == len(rows) > 1.05 * inside.sum()
    x, y, width, height = info["bbox_obj"]
    assert x < 0 and (x, y) == (columns.min() - 60, rows.min() - 40)
    assert (x + width, y + height) == (columns.max() - 60, rows.max() - 40)


@pytest.mark.parametrize(
    ("do", "message"),
    [
        (lambda s: setattr(s.scene.find("box"), "scale", 2.0), "'box' is scaled"),
        (lambda s: setattr(s, "camera", e3d.OrthographicCamera(1.0)), "no perspective"),
        (lambda s: setattr(s, "labels", {s.scene.find("box"): ""}), "no name of a category"),
        (lambda s: setattr(s, "labels", {e3d.Scene().add(): "a"}), "no node of the scene"),
    ],
)
def test_bop_refuses_what_it_cannot_say(make_samples, do, message):
    writer = BopWriter(**BOP)
    sample = drawn(make_samples, writer)[0]
    do(sample)
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        writer.describe(sample)


def test_depths_that_do_not_fit_say_which_scale_would(make_samples):
    writer = BopWriter(depth_scale=0.01)
    sample = drawn(make_samples, writer)[0]
    with pytest.raises(e3d.InvalidArgumentError, match=r"depth_scale 0.01: 0\.\d+ is enough") as at:
        writer.describe(sample)
    enough = float(str(at.value).split(": ")[1].split()[0])
    BopWriter(depth_scale=enough).describe(sample)


def test_the_usual_depth_scale_holds_for_scenes_in_metres():
    """Up to 65 metres; beyond, scenes of about one size are told one number."""
    writer = BopWriter()
    assert writer._steps(np.float32([[0.0, 0.25, 65.5]])).tolist() == [[0, 250, 65500]]
    for farthest in (66.0, 70.0, 80.0, 85.0):
        with pytest.raises(e3d.InvalidArgumentError, match="depth_scale 1: 2 is enough"):
            writer._steps(np.float32([[farthest]]))


# ---- folders and WebDataset ----


def test_folders_hold_each_output(make_samples, tmp_path):
    writer = FolderWriter(["color", "depth", "world_normal"])
    paths = write_dataset(tmp_path, writer, make_samples(writer, 2))
    assert sorted(paths) == sorted(
        path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()
    )
    lines = (tmp_path / "pictures.jsonl").read_text().splitlines()
    second = drawn(make_samples, writer, 2)[1]
    said = json.loads(lines[1])
    assert said["files"] == ["color/p1.png", "depth/p1.npy", "world_normal/p1.npy"]
    assert np.array_equal(np.load(tmp_path / "depth" / "p1.npy"), second.frame.depth)
    assert said["seed"] == 41 and [t["category"] for t in said["things"]][0] == "box"
    assert np.array_equal(said["camera"]["world_from_camera"], second.pose)


def test_without_labels_each_mesh_is_a_thing(make_samples):
    writer = FolderWriter(["color"])
    sample = drawn(make_samples, writer)[0]
    sample.labels = None
    names = [thing.category for thing in sample.things()]
    assert names == ["ground", "box", "near", "far", "box", "box"]


def test_tars_hold_the_pictures(make_samples, tmp_path):
    writer = WebDatasetWriter(["color", "depth"], shard=2)
    paths = write_dataset(tmp_path, writer, make_samples(writer, 3))
    assert paths[-3:] == ["shard-000000.tar", "shard-000001.tar", "README.txt"]
    assert {path.name for path in tmp_path.rglob("*")} == set(paths[-3:])  # and no empty folder
    with tarfile.open(tmp_path / paths[-3]) as tar:
        names = tar.getnames()
        assert names[:3] == ["000000000.depth.npy", "000000000.json", "000000000.png"]
        assert len(names) == 6 and all(entry.mtime == 0 for entry in tar)
        depth = np.load(io.BytesIO(tar.extractfile("000000001.depth.npy").read()))
    assert np.array_equal(depth, drawn(make_samples, writer, 2)[1].frame.depth)


def test_tars_as_their_own_library_reads_them(make_samples, tmp_path):
    webdataset = pytest.importorskip("webdataset", reason="pip install webdataset")
    writer = WebDatasetWriter(shard=2)
    write_dataset(tmp_path, writer, make_samples(writer, 2))
    dataset = webdataset.WebDataset(str(tmp_path / "shard-000000.tar"), shardshuffle=False)
    entries = list(dataset.decode("rgb8"))
    assert [entry["__key__"] for entry in entries] == ["000000000", "000000001"]
    assert entries[1]["png"].shape == (40, 60, 3)
    assert entries[1]["json"]["things"][1]["category"] == "ball"


def test_the_same_samples_give_the_same_bytes(make_samples, tmp_path):
    def digest(folder):
        writer = WebDatasetWriter(["color", "object_id"])
        write_dataset(folder, writer, make_samples(writer, 2))
        return hashlib.sha256((Path(folder) / "shard-000000.tar").read_bytes()).hexdigest()

    assert digest(tmp_path / "a") == digest(tmp_path / "b")


def test_samples_come_in_order(make_samples, tmp_path):
    writer = FolderWriter(["color"])
    samples = drawn(make_samples, writer, 2)[::-1]
    with pytest.raises(e3d.InvalidArgumentError, match="order"):
        write_dataset(tmp_path, writer, samples)
    assert isinstance(samples[0], Sample)


@pytest.mark.parametrize(
    ("names", "told"),
    [
        (("a", "a"), "files of two pictures have the name 'color/a.png'"),
        (("a", "A"), "names that are one on Windows and macOS, 'color/a.png' and 'color/A.png'"),
        (("a", "nul"), "'nul.png' is a device on Windows"),
        (("a", "b:c"), "Windows allows no ':' in 'b:c.png'"),
    ],
)
def test_no_file_replaces_another_on_any_system(make_samples, tmp_path, names, told):
    writer = FolderWriter(["color"])
    samples = drawn(make_samples, writer, 2)
    for sample, name in zip(samples, names, strict=True):
        sample.name = name
    with pytest.raises(e3d.InvalidArgumentError, match=told):
        write_dataset(tmp_path, writer, samples)
    assert [path.name for path in tmp_path.rglob("*.*")] == ["a.png"]


@pytest.mark.parametrize(
    "make",
    [
        lambda: FolderWriter(["colour"]),
        lambda: FolderWriter([]),
        lambda: CocoWriter(outputs=["colour"]),
        lambda: WebDatasetWriter(shard=0),
        lambda: BopWriter(split="a/b"),
        lambda: BopWriter(scene_size=True),
        lambda: BopWriter(depth_scale=0.0),
    ],
)
def test_wrong_options_are_errors(make):
    with pytest.raises(e3d.InvalidArgumentError):
        make()
