"""``df.plot(backend="engine3d")`` of pandas, and tables as points."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import engine3d as e3d
from engine3d.compat import pandas as backend
from engine3d.io.scenes.other_libraries import scene_of_library
from engine3d.model.materials.colors import srgb_bytes

pd = pytest.importorskip("pandas", exc_type=ImportError)

ROOT = Path(__file__).resolve().parents[2]
SIZE = {"size": (64, 48)}


def table(count=200, **more):
    rng = np.random.default_rng(1)
    columns = {"a": rng.random(count), "b": 100 * rng.random(count), "h": rng.random(count)}
    return pd.DataFrame({**columns, "t": np.arange(count), **more})


def only_mesh(thing):
    (node,) = scene_of_library(thing).nodes
    return node.object


def test_points_show_where_their_columns_say():
    """One row lies high: the column for z is upwards, whatever the units of the columns."""
    data = pd.DataFrame({"a": [0.0, 1, 1], "b": [0.0, 1, 0], "h": [0.0, 0.0, 9e6]})
    look = {"look": "plain", "point_size": 5, **SIZE}
    frame = backend.plot(data, "scatter3d", "a", "b", "h", c="#ff0000", **look)
    red = np.argwhere((frame.color[..., 0] > 200) & (frame.color[..., 1] < 90))
    low = backend.plot(data[:2].assign(h=0.0), "scatter3d", "a", "b", "h", c="#ff0000", **look)
    assert len(red) > len(np.argwhere((low.color[..., 0] > 200) & (low.color[..., 1] < 90)))
    equal = backend.plot(data, "scatter3d", "a", "b", "h", c="#ff0000", equal=True, **look)
    across = np.argwhere((equal.color[..., 0] > 200) & (equal.color[..., 1] < 90))
    assert np.ptp(across[:, 1]) < np.ptp(red[:, 1])


def test_a_column_colours_the_points():
    plain = backend.plot(table(), "scatter3d", "a", "b", "h", **SIZE).color
    shown = backend.plot(table(), "scatter3d", "a", "b", "h", "t", **SIZE).color
    assert not np.array_equal(plain, shown)
    no_bar = backend.plot(table(), "scatter3d", "a", "b", "h", "t", bar=False, **SIZE).color
    assert not np.array_equal(no_bar, shown)
    names = table(3, name=["red", "lime", "blue"])
    named = backend.plot(
        names, "scatter3d", "a", "b", "h", "name", look="plain", point_size=4, **SIZE
    )
    pure = {tuple(one) for one in named.color[..., :3].reshape(-1, 3).tolist()}
    assert {(255, 0, 0), (0, 255, 0), (0, 0, 255)} <= pure


def test_a_line_goes_from_row_to_row():
    line = backend.plot(table(3), "line3d", "a", "b", "h", **SIZE).color
    assert not np.array_equal(
        line, backend.plot(table(3), "scatter3d", "a", "b", "h", **SIZE).color
    )


def test_rows_without_a_place_are_left_out():
    data = table(6)
    data.loc[2, "h"] = np.nan
    shown = backend.plot(data, "scatter3d", "a", "b", "h", "t", **SIZE).color
    kept = data.dropna()
    assert np.array_equal(shown, backend.plot(kept, "scatter3d", "a", "b", "h", "t", **SIZE).color)
    assert backend.plot(data[:0], "scatter3d", "a", "b", "h", "t", **SIZE).size == (64, 48)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"kind": "bar"}, "kind must be one of 'scatter3d', 'line3d'"),
        ({"x": "q"}, "no column 'q': there are a, b, h, t"),
        ({"y": "s"}, "the column 's' must be numbers"),
        ({"c": "no colour"}, "colour|color"),
        ({"data": pd.Series([1.0])}, "needs a DataFrame, not a Series"),
    ],
)
def test_wrong_plots_are_refused(given, said):
    usual = {"data": table(4, s="text"), "kind": "scatter3d", "x": "a", "y": "b", "z": "h"}
    with pytest.raises(e3d.InvalidArgumentError, match=said):
        backend.plot(**{**usual, **given}, **SIZE)


def test_columns_are_taken_by_their_names():
    data = pd.DataFrame(
        {
            "x": [0.0, 1.0, np.nan],
            "y": [0, 1, 2],
            "z": [0, 1, 2],
            "red": [255, 0, 0],
            "green": [0, 128, 0],
            "blue": [0, 0, 9],
            "nx": [0.0, 1.0, 0],
            "ny": 0.0,
            "nz": [1.0, 0.0, 1],
            "heat": [5.0, 6.0, 7.0],
            "note": "text",
        }
    )
    mesh = only_mesh(data)
    assert mesh.points.tolist() == [0, 1] and mesh.positions.tolist() == [[0, 0, 0], [1, 1, 1]]
    assert srgb_bytes(mesh.colors)[:, :3].tolist() == [[255, 0, 0], [0, 128, 0]]
    assert mesh.normals.tolist() == [[0, 0, 1], [1, 0, 0]]
    assert {name: mesh.values[name].tolist() for name in mesh.values} == {"heat": [5.0, 6.0]}
    shares = data[["x", "y", "z"]].assign(r=[1.0, 0, 0], g=0.6, b=0.0)
    assert srgb_bytes(only_mesh(shares).colors)[0, :3].tolist() == [255, 153, 0]
    shown = (e3d.render(data, **SIZE).color, e3d.render(data, color_by="heat", **SIZE).color)
    assert not np.array_equal(*shown)


def colors_of(dtype, rows, **alpha):
    """Return the colours of a table with rows of red, green and blue, as bytes."""
    rgb = dict(zip("rgb", np.array(rows, dtype).T, strict=True))
    count = np.arange(len(rows))
    return srgb_bytes(only_mesh(pd.DataFrame({"x": count, "y": 0, "z": 0, **rgb, **alpha})).colors)


def test_colours_of_laser_scans_range_to_65535():
    wide = [[65535, 32768, 0], [257, 514, 0]]
    bytes_of_wide = [[255, 128, 0], [1, 2, 0]]
    assert colors_of(np.uint16, wide)[:, :3].tolist() == bytes_of_wide
    with pytest.warns(e3d.errors.Engine3DWarning, match="r, g, b: numbers up to 65535 .* to 65535"):
        assert colors_of(np.int64, wide)[:, :3].tolist() == bytes_of_wide
    with pytest.warns(e3d.errors.Engine3DWarning, match="16-bit integers up to 200 .* 0 to 255"):
        assert colors_of(np.uint16, [[200, 100, 0]])[0, :3].tolist() == [200, 100, 0]


def test_alpha_has_a_range_of_its_own():
    found = colors_of(np.uint8, [[200, 100, 0]] * 2, a=[1.0, 0.5])
    assert found.tolist() == [[200, 100, 0, 255], [200, 100, 0, 128]]


def test_tables_without_places_are_refused():
    assert scene_of_library(table()) is None
    with pytest.raises(e3d.InvalidArgumentError, match="this DataFrame of pandas holds nothing"):
        e3d.render(table(), **SIZE)
    with pytest.raises(e3d.InvalidArgumentError, match="the column 'y'"):
        e3d.render(pd.DataFrame({"x": [1], "y": ["a"], "z": [1]}), **SIZE)


def test_pandas_finds_the_entry_point(tmp_path):
    """By the line of pyproject.toml, in metadata as pip writes it."""
    line = 'engine3d = "engine3d.compat.pandas"'
    group = "[project.entry-points.pandas_plotting_backends]"
    assert f"{group}\n{line}\n" in (ROOT / "pyproject.toml").read_text("utf-8")
    metadata = tmp_path / "backend-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: backend\nVersion: 1.0\n")
    points = f"[pandas_plotting_backends]\n{line}\n".replace('"', "")
    (metadata / "entry_points.txt").write_text(points)
    code = (
        f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import pandas as pd; "
        "df = pd.DataFrame({'x': [0, 1], 'y': [0, 1], 'z': [0, 1], 't': [1, 2]}); "
        "print(df.plot(backend='engine3d', kind='scatter3d', x='x', y='y', z='z', c='t', "
        "size=(8, 6)).size)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout == "(8, 6)\n"
