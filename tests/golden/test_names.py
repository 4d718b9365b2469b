"""Names of golden pictures stay below their folder, are files everywhere, and differ."""

import pytest

from engine3d import InvalidArgumentError
from engine3d.apps.golden import names


@pytest.mark.parametrize(
    ("classes", "test", "number", "expected"),
    [
        ([], "test_torus", 1, "test_torus"),
        ([], "test_torus", 2, "test_torus-2"),
        ([], "test_torus[4-red]", 1, "test_torus-4-red"),
        (
            ["TestShapes", "TestRound"],
            "test_torus[0.5]",
            3,
            "TestShapes.TestRound.test_torus-0.5-3",
        ),
        ([], "test_torus[été]", 1, "test_torus-été"),
    ],
)
def test_names_of_tests(classes, test, number, expected):
    assert names.test_name(classes, test, number) == expected


def test_odd_characters_leave_a_name_that_no_other_has():
    cases = ["a/b", "a:b", "a\\b", "a*b", "a\nb", "a\0b", "a?b", "a_b", "../a", "é\ud800"]
    found = [names.test_name([], f"test[{case}]", 1) for case in cases]
    assert len(set(found)) == len(cases)
    assert found[7] == "test-a_b"
    for name in found:
        assert not set(name) & set('/\\:*?"<>|\n\0') and name.isprintable()
        name.encode("utf-8")


def test_names_are_short():
    long = names.test_name([], f"test[{'x' * 500}]", 1)
    other = names.test_name([], f"test[{'x' * 501}]", 1)
    assert long != other and max(len(long), len(other)) < 140
    assert len(names.given_name("é" * 300).encode()) < 140


@pytest.mark.parametrize("name", ["CON", "nul.txt", " a", "a.", ".hidden", "lpt1"])
def test_names_that_some_system_reads_in_its_own_way_are_changed(name):
    given = names.given_name(name)
    assert given != name and given[0] == "_" and given[-1] not in ". "


def test_given_names():
    assert names.given_name("torus") == "torus"
    assert names.given_name("torus.png") == "torus"
    assert names.given_name("shapes/torus, 4 samples") == "shapes/torus, 4 samples"
    assert names.given_name("e\u0301") == names.given_name("\u00e9")


@pytest.mark.parametrize("name", ["", "..", "../x", "a/../../x", "/x", "a//b", "a/./b", "a/", " "])
def test_a_name_does_not_leave_its_folder(name):
    with pytest.raises(InvalidArgumentError, match="below its folder"):
        names.given_name(name)


def test_a_name_is_text():
    with pytest.raises(InvalidArgumentError, match="is a str, not int"):
        names.given_name(4)
