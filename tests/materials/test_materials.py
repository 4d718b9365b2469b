"""Materials: defaults, what they refuse, versions."""

import numpy as np
import pytest

from engine3d.errors import InvalidArgumentError
from engine3d.materials.material import Material
from engine3d.materials.textures import Texture


def test_defaults():
    material = Material()
    assert material.color == (1, 1, 1)
    assert material.texture is None
    assert material.specular == (0, 0, 0)
    assert material.shininess == 32
    assert material.extras == {}


def test_colors_are_kept_as_given():
    assert Material(color=(255, 128, 0)).color == (255, 128, 0)
    assert Material(color=(0.5, 0.25, 0.0)).color == (0.5, 0.25, 0.0)


def test_assigning_raises_the_version_and_checks():
    material = Material()
    before = material.version
    material.color = (0, 1, 0)
    material.texture = Texture(np.zeros((1, 1), np.uint8))
    assert material.version > before
    with pytest.raises(InvalidArgumentError, match="shininess"):
        material.shininess = float("nan")
    with pytest.raises(AttributeError, match="colour"):
        material.colour = (1, 1, 1)


@pytest.mark.parametrize(
    "arguments",
    [
        {"color": (1, 2)},
        {"texture": "wood.png"},
        {"shininess": -1},
        {"extras": []},
        {"emissive": (-1.0, 0, 0)},
    ],
)
def test_wrong_values_are_refused(arguments):
    with pytest.raises(InvalidArgumentError):
        Material(**arguments)
