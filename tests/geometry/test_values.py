"""Numbers on meshes: what they belong to, what is refused, and what keeps them."""

import copy
import itertools
import pickle

import numpy as np
import pytest

import engine3d as e3d
from engine3d.errors import InvalidArgumentError

ROWS = {"vertices": 5, "faces": 2, "points": 3}


def mesh():
    positions = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 2, 0)]
    return e3d.Mesh(positions, [(0, 1, 2), (0, 2, 3)], points=[4, 0, 2])


def numbers(on, shape=(), dtype="f8"):
    return np.arange(ROWS[on] * int(np.prod(shape, initial=1))).reshape(-1, *shape).astype(dtype)


def filled():
    made = mesh()
    for on in ROWS:
        made.values[on[0]] = numbers(on)
        made.values[f"{on[0]}3"] = numbers(on, (3,))
    return made


def told(made):
    return {name: (made.values.on(name), made.values[name].tolist()) for name in made.values}


@pytest.mark.parametrize("on", ROWS)
@pytest.mark.parametrize("shape", [(), (1,), (3,)])
def test_the_length_tells_what_numbers_belong_to(on, shape):
    made = mesh()
    made.values["t"] = numbers(on, shape)
    assert made.values.on("t") == on
    assert made.values["t"].shape == (ROWS[on], *shape)
    assert not made.values["t"].flags.writeable


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        *((code, code) for code in ["f4", "f8", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8"]),
        *(("f2", "f4"), ("?", "u1"), (">f4", "f4"), (">i2", "i2")),
    ],
)
def test_types_that_are_kept(given, kept):
    made = mesh()
    made.values["t"] = numbers("vertices", dtype=given)
    assert made.values["t"].dtype == np.dtype(kept)


def test_a_length_that_fits_several():
    made = e3d.Mesh(np.eye(4)[:, :3], [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)])
    with pytest.raises(InvalidArgumentError, match="4 rows of values 't' .* Values.array, on="):
        made.values["t"] = [1, 2, 3, 4]
    made.values["t"] = e3d.Values([1, 2, 3, 4], on="faces")
    made.values["t"] = made.values["t"] * 2  # a name keeps its kind
    made.values["u"] = made.values["t"]
    assert made.values.on("t") == made.values.on("u") == "faces"
    cloud = e3d.Mesh(np.eye(3), points=[0, 1, 2])
    cloud.values["t"] = [1, 2, 3]  # in a cloud both are the same
    assert cloud.values.on("t") == "vertices"


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ([1, 2], "2 rows for 24 vertices, 12 faces"),
        (e3d.Values([1, 2], on="faces"), "2 rows for 12 faces"),
        (e3d.Values([1] * 12, on="edges"), "on must be one of 'vertices', 'faces', 'points'"),
        (["a"] * 12, "must be numbers"),
        (np.zeros((12, 2, 2)), r"must have shape \(N,\) or \(N, K\)"),
        (np.zeros((12, 0)), "must have shape"),
        (5, "must have shape"),
    ],
)
def test_what_is_refused(given, said):
    box = e3d.box()
    with pytest.raises(InvalidArgumentError, match=said):
        box.values["t"] = given
    assert box.values == {}
    with pytest.raises(InvalidArgumentError, match="no values 't'; this mesh has none"):
        box.values.on("t")
    with pytest.raises(InvalidArgumentError, match="must be a str"):
        box.values = {1: np.zeros(12)}


def test_a_change_renews_the_mesh():
    made, array = mesh(), numbers("faces")
    before = made.version
    made.values["t"] = array
    assert made.version != before
    array[:] = -1  # it was copied
    assert made.values["t"].tolist() == [0, 1]
    with pytest.raises(ValueError, match="read-only"):
        made.values["t"][0] = 5
    del made.values["t"]
    made.values |= {"a": numbers("points")}
    assert told(made) == {"a": ("points", [0, 1, 2])}


def test_numbers_never_outlive_their_elements():
    made = filled()
    made.points = [1]
    assert list(made.values) == ["v", "v3", "f", "f3"]
    made.faces = [(0, 1, 2)]
    assert list(made.values) == ["v", "v3"]
    made.faces = [(0, 1, 3)]
    made.values["f"] = e3d.Values([7], on="faces")
    made.faces = [(0, 1, 2)]  # as many: they stay
    assert list(made.values) == ["v", "v3", "f"]
    made.positions = np.zeros((9, 3))
    assert list(made.values) == ["f"]


@pytest.mark.parametrize(
    "copied", [copy.copy, copy.deepcopy, lambda made: pickle.loads(pickle.dumps(made))]
)
def test_copies_have_their_own(copied):
    made = filled()
    twin = copied(made)
    assert told(twin) == told(made)
    twin.values["new"] = numbers("faces")
    assert "new" not in made.values and not twin.values["v"].flags.writeable


def test_joined_meshes():
    first, second = filled(), filled()
    del second.values["f"], second.values["v3"]
    second.values["v3"] = numbers("vertices")  # fewer columns
    second.values["p"] = e3d.Values(numbers("vertices"), on="vertices")  # of something else
    whole = e3d.Mesh.concatenate([first, second])
    for name in whole.values:
        on = whole.values.on(name)
        assert len(whole.values[name]) == 2 * ROWS[on]
    assert whole.values["v"].tolist() == [0, 1, 2, 3, 4] * 2
    np.testing.assert_array_equal(whole.values["f"], [0, 1, np.nan, np.nan])
    np.testing.assert_array_equal(whole.values["p"], [0, 1, 2, np.nan, np.nan, np.nan])
    assert whole.values["v3"].shape == (10, 3) and whole.values["v3"][5:, 0].tolist() == [*range(5)]
    assert np.isnan(whole.values["v3"][5:, 1:]).all()
    turned = e3d.Mesh.concatenate([first], poses=[((1, 2, 3), (0, 0, 0, 1), -1)])
    assert told(turned) == told(first)


def test_split_vertices_keep_theirs():
    box = e3d.box()
    box = e3d.Mesh(*_welded(box), crease_angle=0.1)
    box.values["v"] = box.positions[:, 0]
    box.values["f"] = np.arange(12)
    split = box.with_creases()
    assert len(split.positions) > 8
    assert (split.values["v"] == split.positions[:, 0]).all()
    assert split.values["f"].tolist() == [*range(12)]


def _welded(box):
    positions, numbers = np.unique(box.positions, axis=0, return_inverse=True)
    return positions, numbers.reshape(-1)[box.faces]


def test_every_sequence_of_changes_leaves_lengths_that_fit():
    changes = {
        "faces": lambda made: setattr(made, "faces", made.faces[:1]),
        "points": lambda made: setattr(made, "points", made.points[:1]),
        "name": lambda made: made.values.pop("v"),
        "more": lambda made: made.values.update(x=np.zeros(len(made.faces) and 5)),
    }
    for order in itertools.permutations(changes):
        made = filled()
        for change in order:
            changes[change](made)
            for name, (array, on) in made.values.held().items():
                held = made.positions if on == "vertices" else getattr(made, on)
                assert len(array) == len(held), (order, name)
