"""3MF: whatever only says how triangles look is left out with a warning, and never the file."""

import re
import warnings

import numpy as np
import pytest
from loaders.seeds import THREEMF, THREEMF_MODEL, threemf_package

from engine3d.loaders import load_mesh

TEXT = THREEMF_MODEL.decode()
#: Attributes that say how something looks, and elements that hold nothing but them.
LOOKS = ("pid", "pindex", "p1", "p2", "p3")
OF_PROPERTIES = ("basematerials", "base ", "m:")
NONSENSE = ("44", "-1", "x", "", "1e99", "nan", "4294967296", "#12", "0 9", "99999999999999")


def places() -> list[tuple[int, int]]:
    """Where the values of all these attributes begin and end in the text."""
    return [
        (tag.start() + attribute.start(2), tag.start() + attribute.end(2))
        for tag in re.finditer(r"<[^/?!][^>]*>", TEXT)
        for attribute in re.finditer(r'\s([\w:]+)="([^"]*)"', tag[0])
        if tag[0][1:].startswith(OF_PROPERTIES) or attribute[1] in LOOKS
    ]


def loaded(text: str):
    """The mesh of a package of such a model, and its warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        mesh = load_mesh(threemf_package({**THREEMF, "3D/model.model": text.encode()}))
    return mesh, [line.partition(": ")[2] for line in mesh.warnings]


def corners(mesh) -> np.ndarray:
    return mesh.positions[mesh.faces]


@pytest.mark.parametrize("value", NONSENSE)
def test_nonsense_in_any_attribute_that_is_of_looks(value):
    whole, usual = loaded(TEXT)
    said = 0
    for start, end in places():
        mesh, told = loaded(TEXT[:start] + value + TEXT[end:])
        assert (corners(mesh) == corners(whole)).all(), TEXT[start - 30 : end]
        said += len(told) > len(usual)
    # Names, paths and tiles are any text, and some numbers are as good as others.
    assert said >= (10 if value in ("0 9", "nan", "44") else 18)


def test_any_element_of_looks_may_be_missing():
    whole, _ = loaded(TEXT)
    for tag in re.finditer(
        r"<(m:color|m:tex2coord|base|m:multi|m:composite|m:texture2d) .*?/>", TEXT
    ):
        mesh, _ = loaded(TEXT[: tag.start()] + TEXT[tag.end() :])
        assert (corners(mesh) == corners(whole)).all(), tag[0]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('pid="4" p1="0" p2="1"', 'pid="4" p1="0" p2="2"', "a property of group 4 beyond its 2"),
        ('pid="4" p1', 'pid="44" p1', "there is no property group 44"),
        ('pid="4" p1', 'pid="3" p1', "a property of group 3 beyond its 0"),
        ('texid="3"', 'texid="1"', "resource 1 is no texture"),
        ("#0080FF80", "0080FF80", "no colour like #rrggbb: '0080FF80'"),
        ('colorgroup id="2"', 'colorgroup id="1"', "id 1 is given twice"),
        ('pindex="1"', 'pindex="x"', "'pindex' is no index: 'x'"),
        ('pids="1 4"', 'pids="9"', "multi-properties of no properties"),
        ('matid="1"', 'matid="2"', "composite materials of what is not there"),
    ],
)
def test_what_is_left_out_is_named(old, new, message):
    assert old in TEXT
    _, told = loaded(TEXT.replace(old, new, 1))
    assert any(line.startswith(message) for line in told), told


def test_a_triangle_whose_property_is_left_out_looks_as_its_object():
    mesh, _ = loaded(TEXT.replace('pid="4" p1', 'pid="44" p1'))
    first, textured = (mesh.materials[mesh.material_ids[number]] for number in (0, 2))
    assert textured is first and first.name == "glass"
