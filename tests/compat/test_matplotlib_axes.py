"""Matplotlib's 3-D axes: files, events, what programs do with the artists."""

import io
import pickle
import re
import warnings

import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib", minversion="3.11")
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib import patheffects  # noqa: E402
from matplotlib.backend_bases import MouseEvent  # noqa: E402
from mpl_toolkits.mplot3d import art3d  # noqa: E402

from engine3d.compat.matplotlib import Axes3D  # noqa: E402
from engine3d.errors import Engine3DWarning, InvalidArgumentError  # noqa: E402

SQUARE = np.meshgrid([-1.0, 1.0], [-1.0, 1.0])


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture
def ax():
    figure = plt.figure(figsize=(4, 3), dpi=100)
    ax = figure.add_subplot(projection="engine3d")
    ax.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1, 1))
    return ax


def wall(ax, color="b", **more):
    x, z = SQUARE
    return ax.plot_surface(x, 0 * x, z, color=color, shade=False, **more)


def pixels_of(ax):
    canvas = ax.get_figure().canvas
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].astype(int)


def saved(ax, kind="png", **options):
    out = io.BytesIO()
    plain = {"svg": {"metadata": {"Date": None}}, "pdf": {"metadata": {"CreationDate": None}}}
    with plt.rc_context({"svg.hashsalt": "same", "svg.fonttype": "none"}):
        ax.get_figure().savefig(out, format=kind, **plain.get(kind, {}), **options)
    return out.getvalue()


def count(pixels, color):
    return (abs(pixels - np.array(color)).max(-1) < 40).sum()


def test_the_projection_has_a_name_and_its_axes_are_mplot3ds(ax):
    assert isinstance(ax, Axes3D) and ax.name == "3d" and Axes3D.name == "engine3d"


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_files_have_the_same_bytes_twice_and_after_pickling(ax, kind):
    wall(ax)
    ax.scatter([0, 0.5], [-0.5, 0.5], [0, 0], c=[0, 1])
    ax.text(0, -0.5, 0, "here")
    first = saved(ax, kind)
    assert saved(ax, kind) == first
    again = pickle.loads(pickle.dumps(ax.get_figure()))
    assert saved(again.axes[0], kind) == first


def test_a_vector_file_has_one_picture_and_texts(ax):
    wall(ax)
    ax.text(0, -0.5, 0.3, "before it")
    ax.text(0, 0.5, -0.3, "behind it")
    ax.set(title="title", xlabel="across")
    svg = saved(ax, "svg").decode()
    assert svg.count("<image") == 1
    words = re.findall(r"<text[^>]*>\s*([^<]+?)\s*</text>", svg)
    assert {"title", "across", "before it"} <= set(words) and "behind it" not in words


def test_a_text_behind_clear_or_partly_behind_is_in_the_picture(ax):
    wall(ax, alpha=0.5)
    ax.text(0, 0.5, 0, "through it", color="r", fontsize=20, ha="center")
    assert "through it" not in saved(ax, "svg").decode()
    seen = pixels_of(ax)
    blurred = (seen[..., 0] > seen[..., 1] + 30) & (seen[..., 2] > 90)
    assert blurred.sum() > 20


def test_a_text_that_something_hides_in_part_goes_on_outside_the_axes(ax):
    ax.set_axis_off()
    wall(ax)
    ax.text(0.2, 0.2, 0, "a text that is so long that it leaves the axes", color="r")
    seen = pixels_of(ax)
    inside, outside = seen[:, 100:300], seen[:, 330:]
    assert count(outside, (255, 0, 0)) > 20 and count(inside, (255, 0, 0)) < 20


def test_sizes_tight_boxes_and_transparency(ax):
    wall(ax)
    for dpi in (50, 150):
        image = plt.imread(io.BytesIO(saved(ax, dpi=dpi)), format="png")
        assert image.shape[:2] == (3 * dpi, 4 * dpi)
    tight = plt.imread(io.BytesIO(saved(ax, bbox_inches="tight")), format="png")
    assert tight.shape[1] < 390 and tight[..., :3].std() > 0.1
    clear = plt.imread(io.BytesIO(saved(ax, transparent=True)), format="png")
    blue = (clear[..., 2] > 0.9) & (clear[..., 0] < 0.1)
    assert clear[0, 0, 3] == 0 and (clear[blue][:, 3] > 0.99).mean() > 0.9 and blue.sum() > 3000


def test_what_is_clipped_and_what_is_not(ax):
    ax.set_axis_off()
    ax.plot([-6, 6], [0, 0], [0, 0], color="r", linewidth=5)
    ax.plot([-6, 6], [0, 0], [0.5, 0.5], color="b", linewidth=5, clip_on=False)
    seen = pixels_of(ax)
    outside = np.concatenate([seen[:, :60], seen[:, -60:]], 1)
    assert count(outside, (255, 0, 0)) == 0 and count(outside, (0, 0, 255)) > 100
    assert count(seen[:, 100:300], (255, 0, 0)) > 100


def test_picking(ax):
    line = ax.plot([-0.5, 0.5], [0, 0], [0, 0], "o", picker=5)[0]
    dots = ax.scatter([0.0], [0.0], [0.6], s=80, picker=True)
    surface = wall(ax, picker=True)
    ax.get_figure().canvas.draw()
    picked = []
    canvas = ax.get_figure().canvas
    canvas.mpl_connect("pick_event", lambda event: picked.append(event.artist))

    def press(place):
        x, y = ax.transData.transform(place)
        canvas.callbacks.process(
            "button_press_event", MouseEvent("button_press_event", canvas, x, y, 1)
        )

    press(line.get_xydata()[0])
    press(dots.get_offsets()[0])
    assert {line, dots, surface} == set(picked)


def test_turning_with_the_mouse_draws_anew(ax):
    wall(ax)
    before, canvas = pixels_of(ax), ax.get_figure().canvas
    for name, x in (("button_press_event", 200), ("motion_notify_event", 230)):
        event = MouseEvent(name, canvas, x, 150, 1)
        canvas.callbacks.process(name, event)
    assert (pixels_of(ax) != before).any()
    assert not ax.stale and "azimuth" in ax.format_coord(0, 0)


class Drawn(art3d.Line3D):
    def draw(self, renderer):
        super().draw(renderer)


def test_what_cannot_be_drawn_lies_on_top_with_a_warning(ax):
    ax.set_axis_off()
    wall(ax)
    ax.add_line(Drawn([-0.5, 0.5], [0.5, 0.5], [0, 0], color="r", linewidth=9))
    with pytest.warns(Engine3DWarning, match="Drawn .* a method draw of its own"):
        seen = pixels_of(ax)
    assert count(seen, (255, 0, 0)) > 300
    ax.lines[0].remove()
    ax.plot([-0.5, 0.5], [0.5, 0.5], [0, 0], path_effects=[patheffects.Normal()])
    with pytest.warns(Engine3DWarning, match="Line3D .* path effects"):
        pixels_of(ax)


def test_warnings_point_at_the_callers_line(ax):
    ax.plot([0, 1], [0, 1], [0, 1], drawstyle="steps")
    with pytest.warns(Engine3DWarning, match="it has steps") as told:
        saved(ax)
    assert told[0].filename == __file__


def test_flat_artists_lie_on_top_without_a_warning(ax):
    wall(ax)
    ax.text2D(0.4, 0.5, "flat", transform=ax.transAxes, color="r")
    ax.annotate("note", (0, 0), color="r")
    ax.legend(handles=[plt.Line2D([], [], label="entry")])
    ax.text(9, 9, 9, "", visible=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert count(pixels_of(ax), (255, 0, 0)) > 10


def test_animated_and_hidden_artists_are_not_in_the_picture(ax):
    wall(ax)
    wall(ax, color="r").set_visible(False)
    line = ax.plot([0, 0], [-0.9, -0.9], [-1, 1], color="g", linewidth=9, animated=True)[0]
    seen = pixels_of(ax)
    assert count(seen, (255, 0, 0)) == 0 and count(seen, (0, 128, 0)) == 0
    line.set_animated(False)
    assert count(pixels_of(ax), (0, 128, 0)) > 300


def test_changed_artists_change_the_picture(ax):
    surface = wall(ax)
    dots = ax.scatter([0], [-0.9], [0], s=900, color="g", depthshade=False)
    before = pixels_of(ax)
    surface.set_facecolor("r")
    surface.set_alpha(0.5)
    dots.set_sizes([100])
    after = pixels_of(ax)
    assert count(before, (0, 0, 255)) > 3000 and count(after, (0, 0, 255)) == 0
    assert count(after, (0, 128, 0)) < 0.3 * count(before, (0, 128, 0))
    surface.set_verts([[(0, 0, 0), (1, 0, 0), (1, 0, 1)]])
    assert (pixels_of(ax) != after).any()
    assert surface.get_facecolor().shape == (1, 4)


def test_scales_limits_and_masks(ax):
    ax.set_axis_off()
    ax.set(xscale="log", xlim=(1, 1000))
    x = np.array([1.0, 10.0, 100.0, 1000.0])
    ax.plot(x, 0 * x, 0 * x, color="r", linewidth=6)
    red = np.argwhere(abs(pixels_of(ax) - [255, 0, 0]).max(-1) < 40)
    # It is straight, as logarithms are evenly apart.
    assert len(red) > 300 and np.polyfit(red[:, 1], red[:, 0], 1, full=True)[1][0] / len(red) < 8
    ax.lines[0].remove()
    points = np.ma.masked_greater(x, 50)
    ax.plot(points, 0 * x, 0 * x, color="b", linewidth=6)
    clipped = ax.scatter(x, 0 * x, 0 * x + [0, 0, 0, 5], color="g", axlim_clip=True)
    seen = pixels_of(ax)
    assert 0 < count(seen, (0, 0, 255)) < len(red) and len(clipped.get_offsets()) == 4


def test_voxels_are_one_collection_until_one_is_asked_for():
    ax = plt.figure().add_subplot(projection="engine3d")
    filled = np.random.default_rng(3).random((4, 3, 5)) > 0.5
    colors = np.where(filled, "red", "blue")
    plain = plt.figure().add_subplot(projection="3d")
    expected = plain.voxels(filled, facecolors=colors, edgecolors="k")
    got = ax.voxels(filled, facecolors=colors, edgecolors="k")
    assert len(ax.collections) == 1 and set(got) == set(expected) and len(got) == len(expected)
    for ours, theirs in ((ax.get_xlim(), plain.get_xlim()), (ax.get_zlim(), plain.get_zlim())):
        assert np.allclose(ours, theirs)
    for key, polygons in expected.items():
        # The same faces in the same colours, in some order.
        rows = [
            np.sort(np.hstack([one._faces.reshape(-1, 12), one._facecolor3d]), 0)
            for one in (polygons, got[key])
        ]
        assert np.allclose(*rows)
    assert len(ax.collections) == len(got)


@pytest.mark.parametrize("shape", [(2, 3, 2), (1, 1, 1), (0, 0, 0), (0, 2, 3)])
def test_voxels_without_any(ax, shape):
    assert ax.voxels(np.zeros(shape, bool)) == {} and not ax.collections
    pixels_of(ax)


def test_bars_are_told_each_place_once(ax):
    with pytest.raises(TypeError, match="multiple values"):
        ax.bar3d([0], [0], [0], 1, 1, 1, x=[5])


def test_markers_of_no_size_do_not_show(ax):
    empty = pixels_of(ax)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # matplotlib takes the root, too
        for sizes in (-5, np.nan, [-5, 0], [np.nan, -1e300]):
            markers = ax.scatter([0, 0.5], [0, 0.5], [0, 0.5], s=sizes, linewidths=0)
            assert np.array_equal(pixels_of(ax), empty)
            markers.remove()
        ax.scatter([0, 0.5], [0, 0.5], [0, 0.5], s=[-5, 200], color="r")
        assert count(pixels_of(ax), (255, 0, 0)) > 50


def test_colours_that_are_no_numbers_are_clear(ax):
    empty = pixels_of(ax)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ax.plot_surface(
            *SQUARE, np.zeros((2, 2)), facecolors=np.full((2, 2, 4), np.nan), shade=False
        )
        assert np.array_equal(pixels_of(ax), empty)


def test_bars_are_those_of_mplot3d():
    ax = plt.figure().add_subplot(projection="engine3d")
    plain = plt.figure().add_subplot(projection="3d")
    for color in (None, "r", ["r", "g", "b"], [(0, 0, 1, 0.5)]):
        args = ([1, 2, 3], 0, [0, 1, 0], 0.5, [1, 2, 3], 0.3)
        ours, theirs = (one.bar3d(*args, color=color, edgecolor="k") for one in (ax, plain))
        assert np.array_equal(ours._faces, theirs._faces)
        assert np.allclose(ours._facecolor3d, theirs._facecolor3d)
        assert np.allclose(ours._edgecolor3d, theirs._edgecolor3d)
    assert np.allclose(ax.get_w_lims(), plain.get_w_lims())


def test_hostile_numbers_draw_nothing_or_something_but_raise_nothing(ax):
    bad = np.array([[np.nan, np.inf], [-np.inf, 1e300]])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        ax.plot_surface(*SQUARE, bad)
        ax.plot([0, np.nan, 1e300], [0, 0, np.inf], [0, 1, 2], "o--")
        ax.scatter([np.nan, 0], [0, np.inf], [0, 0])
        ax.add_collection3d(art3d.Poly3DCollection([np.full((3, 3), np.nan)]))
        ax.add_collection3d(art3d.Line3DCollection([]), autolim=False)
        ax.text(np.nan, 0, 0, "nowhere")
        ax.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1, 1))
        pixels_of(ax)


def test_axes_without_anything(ax):
    plain = plt.figure(figsize=(4, 3), dpi=100).add_subplot(projection="3d")
    plain.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1, 1))
    assert (pixels_of(ax) == pixels_of(plain)).all()


@pytest.mark.parametrize("size", [(170, 0.2), (0.2, 170)])
def test_axes_larger_than_pictures_can_be_are_refused(size):
    figure = plt.figure(figsize=size, dpi=100)
    ax = figure.add_axes((0, 0, 1, 1), projection="engine3d")
    ax.plot([0, 1], [0, 1], [0, 1])
    ax.set_position((0, 0, 1, 1))
    ax.apply_aspect = lambda position=None: None  # fill the figure
    with pytest.raises(InvalidArgumentError, match="at most 16384 a side can: lower the figure"):
        pixels_of(ax)
