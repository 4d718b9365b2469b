"""Overlays, the grid, animations in files, and the file watch."""

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.apps.viewer.controls.controls import SIDE_COLUMNS
from engine3d.base.files.watch import FileWatch
from engine3d.errors import FileAccessError
from engine3d.io.output.animation_files import (
    ANIMATION_FORMATS,
    numbered_path,
    save_animation,
)
from engine3d.rendering.canvas import Canvas
from engine3d.stage.overlays.draw_counts import ROWS, count_names
from engine3d.stage.overlays.frame_statistics import statistics_lines
from engine3d.stage.overlays.frame_times import FrameTimes
from engine3d.stage.overlays.grid_lines import grid, grid_step
from engine3d.stage.overlays.overlay import draw_axes, draw_block
from engine3d.stage.views.viewpoint import UP_DIRECTIONS, Sphere, Viewpoint


@pytest.mark.parametrize("corner", ["top left", "top right", "bottom left", "bottom", "middle"])
def test_a_block_darkens_its_corner_only(corner):
    canvas = Canvas((200, 100))
    canvas.clear((90, 90, 90))
    draw_block(canvas, ["hello"], corner=corner)
    changed = (canvas.pixels[..., :3] != 90).any(axis=2)
    assert changed.any()
    assert changed.mean() < 0.3
    rows, columns = np.nonzero(changed)
    if "bottom" in corner:
        assert rows.min() > 50
    if "top" in corner:
        assert rows.max() < 50
    if "right" in corner:
        assert columns.min() > 100


def test_text_on_a_picture_of_a_pixel_is_clipped():
    canvas = Canvas((1, 1))
    draw_block(canvas, ["hello", "world"])
    draw_axes(canvas, Viewpoint(np.zeros(3), 1.0))


def times(*frames):
    """The times of recent frames: drawing, until shown and in the core, in seconds."""
    found = FrameTimes()
    for frame in frames or ((0.012, 0.02, 0.009),) * 2:
        found.add(*frame)
    return found


def fits(canvas):
    """Whether nothing is drawn at the very edges of a picture, which was black."""
    untouched = (canvas.pixels[..., :3] == 0).all(axis=2)
    rows, columns = untouched.all(axis=1), untouched.all(axis=0)
    return all(edge.all() for edge in (rows[:4], rows[-4:], columns[:4], columns[-4:]))


@pytest.mark.parametrize("corner", ["top left", "bottom", "top right"])
def test_long_lines_are_wrapped(corner, monkeypatch):
    error = "/a/folder/with/a/very/long/name/that/never/ends/model.obj:12345: there is no vertex 99"
    shown, text = [], Canvas.text

    def note(canvas, x, y, string, color, **options):
        shown.append(string)
        text(canvas, x, y, string, color, **options)

    monkeypatch.setattr(Canvas, "text", note)
    canvas = Canvas((320, 240))
    draw_block(canvas, [error], corner=corner)
    assert fits(canvas) and len(shown) > 2
    assert "".join(shown).replace(" ", "") == error.replace(" ", "")
    draw_block(canvas, [error] * 99, corner=corner)
    assert fits(canvas) and shown[-1] == "…"


@pytest.mark.parametrize("size", [(1280, 720), (640, 480)])
def test_the_statistics_fit_small_windows(size):
    canvas = Canvas(size)
    stats = e3d.render(e3d.Scene(), size=(8, 8)).stats
    large = {name: 12_345_678 for name, value in stats.items() if isinstance(value, int)}
    draw_block(canvas, statistics_lines(times(), size, 16, stats | large))
    assert canvas.pixels.any() and fits(canvas)


def test_axes_point_where_the_camera_sees_them():
    canvas = Canvas((200, 200))
    draw_axes(canvas, Viewpoint(np.zeros(3), 1.0, azimuth=0.0, elevation=0.0))
    red, green = (canvas.pixels[..., k].astype(int) for k in (0, 1))
    x_rows, x_columns = np.nonzero(red > green + 80)
    y_rows, y_columns = np.nonzero(green > red + 80)
    assert np.ptp(x_columns) > np.ptp(x_rows)
    assert np.ptp(y_rows) > np.ptp(y_columns)


def test_statistics_name_the_rate_and_the_times_of_a_frame_which_add_up():
    stats = {"ms_raster": 1.5, "pixels_shaded": 12_345, "backend": "avx2", "plan": ("colors",)}
    lines = statistics_lines(times(), (320, 200), 4, stats, "camera at 1, 2, 3")
    told = [line.split() for line in lines]
    assert told[0] == ["50.0", "fps", "20.00", "ms"]
    parts = [float(row[-2]) for row in told[:4]]
    assert parts == [20.0, 9.0, 3.0, 8.0] and parts[0] == sum(parts[1:])
    assert lines[4:6] == ["320x200, 4 samples per pixel", "camera at 1, 2, 3"]
    assert ["raster", "1.50", "ms"] in told and ["pixels", "shaded", "12,345"] in told
    assert "plan" not in "\n".join(lines)
    alone = statistics_lines(times((0.012, 0.02, 0.009)), (1, 1), 1, {})
    assert alone[0].split() == ["one", "frame", "20.00", "ms"]


@pytest.mark.parametrize("radius", [1e-3, 0.37, 1.0, 5.0, 123.0, 1e6])
def test_grid_steps_are_round(radius):
    step = grid_step(radius)
    mantissa = step / 10.0 ** np.floor(np.log10(step * 1.0001))
    assert any(mantissa == pytest.approx(round_number) for round_number in (1, 2, 5))
    assert 0.1 < step / radius < 1.0


@pytest.mark.parametrize("up", UP_DIRECTIONS.values())
def test_the_grid_lies_under_the_scene(up):
    mesh = grid(-2.0, Sphere((0.0, 0.0, 0.0), 3.7), up)
    heights = mesh.positions @ np.array(up)
    np.testing.assert_allclose(heights, -2.0, atol=1e-5)
    assert len(mesh.lines) > 10
    assert len(mesh.faces) == 0


@pytest.mark.parametrize("suffix", ANIMATION_FORMATS)
@pytest.mark.parametrize("alpha", [255, 0])
def test_animations_hold_every_picture_and_loop(tmp_path, suffix, alpha):
    pictures = np.zeros((5, 20, 30, 4), dtype=np.uint8)
    pictures[..., 3] = 255
    for index in range(5):
        pictures[index, :, index * 5 : index * 5 + 5, :3] = (200, 100, 50)
    pictures[:, :5, :, 3] = alpha
    path = tmp_path / f"turn{suffix}"
    save_animation(iter(pictures), path, 0.05)
    with Image.open(path) as image:
        assert image.n_frames == 5
        assert image.info.get("loop", 0) == 0
        for index in range(5):
            image.seek(index)
            shown = np.asarray(image.convert("RGBA")).astype(int)
            assert (abs(shown[10:, :, :3] - pictures[index, 10:, :, :3]) < 40).all()
            assert (shown[:4, :, 3] == alpha).all()
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_an_animation_that_fails_leaves_no_file(tmp_path):
    def pictures():
        yield np.full((4, 4, 4), 255, dtype=np.uint8)
        raise RuntimeError("lost")

    with pytest.raises(RuntimeError, match="lost"):
        save_animation(pictures(), tmp_path / "a.gif", 0.1)
    assert list(tmp_path.iterdir()) == []


def test_an_animation_into_a_missing_folder(tmp_path):
    with pytest.raises(FileAccessError):
        save_animation(iter(np.zeros((1, 4, 4, 4), np.uint8)), tmp_path / "no" / "a.gif", 0.1)


def test_numbered_paths_take_the_first_free_number(tmp_path):
    assert numbered_path(tmp_path, "a", ".png").name == "a-001.png"
    (tmp_path / "a-001.png").touch()
    assert numbered_path(tmp_path, "a", ".png").name == "a-002.png"


def test_a_file_watch_reports_a_change_once_it_has_settled(tmp_path, monkeypatch):
    monkeypatch.setattr("engine3d.base.files.watch.CHECK_SECONDS", 0.0)
    path = tmp_path / "model"
    path.write_text("one")
    watch = FileWatch(path)
    assert not watch.changed()
    path.write_text("longer")
    assert not watch.changed()
    assert watch.changed()
    path.chmod(0o600)
    assert not any(watch.changed() for _ in range(3))
    path.write_text("after that")
    assert [watch.changed() for _ in range(3)] == [False, True, False]
    path.unlink()
    assert [watch.changed() for _ in range(3)] == [False, True, False]
    assert watch.missing
    path.write_text("after that")
    assert [watch.changed() for _ in range(3)] == [False, True, False]
    assert not watch.missing


def test_a_file_watch_does_not_report_what_is_away_for_a_moment(tmp_path, monkeypatch):
    monkeypatch.setattr("engine3d.base.files.watch.CHECK_SECONDS", 0.0)
    path, other = tmp_path / "model", tmp_path / "other"
    path.write_text("one")
    watch = FileWatch(path)
    path.rename(other)
    assert not watch.changed() and not watch.missing
    other.rename(path)
    assert not watch.changed() and not watch.missing


def test_the_table_of_counts_is_that_of_the_frame():
    frame = e3d.render(e3d.Scene(), size=(8, 8))
    assert count_names() <= frame.stats.keys()
    stats = {name: 1000 + k for k, name in enumerate(sorted(count_names()))}
    lines = statistics_lines(times(), (8, 8), 1, {**frame.stats, **stats})
    head = next(n for n, line in enumerate(lines) if "".join(line.split()) == "ofallinviewdrawn")
    table = [line.rsplit(maxsplit=3) for line in lines[head + 1 : head + 1 + len(ROWS)]]
    expected = [[what, *(f"{stats[name]:,}" for name in names)] for what, names in ROWS.items()]
    assert table == expected
    assert any(line.startswith("culling all: 0 boxes tested, by the tree; then ") for line in lines)
    assert max(map(len, lines[head : head + 1 + len(ROWS)])) <= SIDE_COLUMNS
