"""Materials: defaults, what they refuse, versions."""

import inspect
import warnings

import numpy as np
import pytest

import engine3d as e3d
from engine3d import linear
from engine3d._native import rasterizer
from engine3d.errors import Engine3DWarning, InvalidArgumentError
from engine3d.model.materials.colors import linear_color
from engine3d.model.materials.material import (
    PARAMETERS,
    TEXTURE_SLOTS,
    Material,
    placed_textures_of,
    put_texture,
    says_something,
    textures_of,
)
from engine3d.model.materials.textures import PlacedTexture, Texture
from engine3d.rendering.draw_list.material_list import _physical


def test_defaults():
    material = Material()
    assert material.color == (1, 1, 1)
    assert material.texture is None
    assert material.specular == (0, 0, 0)
    assert material.shininess == 32
    assert material.extras == {}


def test_rows_make_the_attributes_the_signature_and_the_docstring():
    material, keywords = Material(), inspect.signature(Material).parameters
    assert (
        list(keywords) == list(PARAMETERS) == [name for name in vars(material) if name in keywords]
    )
    for name, row in PARAMETERS.items():
        assert keywords[name].default == row.default
        assert getattr(material, name) == row.kind.check(row.default, name)
        entry = f"{name} : {row.words}\n    {row.doc}".rstrip()
        assert entry in Material.__doc__


def test_each_has_extras_of_its_own():
    material = Material()
    material.extras["a"] = 1
    assert Material().extras == {}


def test_the_core_is_told_all_that_it_wants_to_know():
    material = Material(metallic=0.25, iridescence_ior=1.75, sheen_color=(255, 0, 0))
    told = _physical(material, "srgb")
    assert told.keys() == set(rasterizer.PHYSICAL_NUMBERS)
    assert (told["metallic"], told["roughness"], told["iridescence_ior"]) == (0.25, 1.0, 1.75)
    assert told["sheen_color"] == (1.0, 0.0, 0.0)


def test_colors_are_kept_as_given():
    assert Material(color=(255, 128, 0)).color == (255, 128, 0)
    assert Material(color=linear(0.5, 0.25, 0.0)).color == linear(0.5, 0.25, 0.0)
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


def pixels(*shape):
    return Texture(np.zeros((*shape, 4), np.uint8))


def test_metallic_or_roughness_makes_a_material_physical():
    assert not Material().is_physical
    assert Material(metallic=0).is_physical
    assert Material(roughness=0.5).is_physical
    material = Material(metallic=1.0)
    material.metallic = None
    assert not material.is_physical


def test_a_fourth_component_is_alpha():
    assert (Material().alpha, Material().rgb) == (1, (1, 1, 1))
    light = Material(color=linear(0.5, 0.25, 0.0, 0.75))
    assert light.color == linear(0.5, 0.25, 0.0, 0.75)
    assert (light.rgb, light.alpha) == (linear(0.5, 0.25, 0.0), 0.75)
    encoded = Material(color=(1, 0, 0, 51))
    assert encoded.alpha == 0.2
    assert np.array_equal(
        linear_color(encoded.rgb), linear_color((np.uint8(1), *[np.uint8(0)] * 2))
    )
    assert (Material(color=(1, 1, 1, 0)).rgb, Material(color=(1, 1, 1, 0)).alpha) == ((1, 1, 1), 0)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"metallic": 1.5}, "metallic must be a number from 0 to 1, not 1.5"),
        ({"roughness": float("nan")}, "roughness must be a number from 0 to 1, not nan"),
        ({"color": (1.0, 1.0, 1.0, 1.5)}, "the alpha of color must be in 0..1"),
        ({"color": (1, 1, 1, 300)}, "color of integers must be in 0..255"),
        ({"color": (1, 1, 1, 1, 1)}, "color needs 3 or 4 components, got 5"),
        ({"alpha_mode": "glass"}, "'opaque', 'mask', 'blend', not 'glass'"),
        ({"alpha_cutoff": -1}, "alpha_cutoff"),
        ({"normal_scale": float("inf")}, "normal_scale must be a finite number"),
        ({"ior": 0.5}, "ior must be 0, or 1 or greater, not 0.5"),
        ({"sheen_color": (1, 2)}, "sheen_color needs 3 or 4 components"),
        ({"attenuation_distance": 0}, "attenuation_distance must be greater than 0"),
        ({"normal_texture": "bumps.png"}, "normal_texture must be a Texture or None: str"),
        ({"emissive_strength": -1}, "emissive_strength"),
    ],
)
def test_wrong_values_of_physical_materials_say_what_is_allowed(arguments, message):
    with pytest.raises(InvalidArgumentError, match=message):
        Material(**arguments)


def test_every_slot_takes_placed_textures():
    texture = pixels(2, 3)
    placed = PlacedTexture(texture, uv_set=1, offset=(0.5, 0))
    for slot in TEXTURE_SLOTS:
        assert textures_of(Material(**{slot: placed})) == {slot: texture}
        assert placed_textures_of(Material(**{slot: texture})) == {slot: PlacedTexture(texture)}


def test_slots_are_those_of_the_core():
    assert list(TEXTURE_SLOTS) == list(rasterizer.TEXTURE_SLOTS)


def test_another_texture_goes_to_the_same_place():
    material = Material(
        texture=PlacedTexture(pixels(1, 1), rotation=1.0), normal_texture=pixels(1, 1)
    )
    other = pixels(4, 4)
    for slot in ("texture", "normal_texture"):
        put_texture(material, slot, other)
    assert material.texture == PlacedTexture(other, rotation=1.0)
    assert material.normal_texture is other


@pytest.mark.parametrize("name", ["roughness", "clearcoat", "emissive_strength", "sheen_color"])
def test_what_physical_materials_add_says_something(name):
    assert not says_something(Material())
    value = (1, 0, 0) if name == "sheen_color" else 0.5
    assert says_something(Material(**{name: value}))


@pytest.mark.parametrize("name", ["transmission", "clearcoat", "iridescence", "sheen_color"])
def test_what_needs_a_physical_material_is_told_once(name):
    material = Material(**{name: (1, 0, 0) if name == "sheen_color" else 0.5})
    scene = e3d.Scene()
    scene.add(e3d.box()).object.materials = [material]
    with e3d.Renderer((8, 8), look="plain") as renderer:
        with pytest.warns(Engine3DWarning, match=f"{name} .* is not drawn") as told:
            renderer.render(scene)
            material.color = (0, 0, 0)
            renderer.render(scene)
        assert len(told) == 1
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            material.metallic = 0.0
            renderer.render(scene)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        material.metallic = None
        e3d.render(scene, size=(8, 8))  # the studio makes it physical
