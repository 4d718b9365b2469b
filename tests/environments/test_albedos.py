"""The table of albedos against integrals over the light, and what makes it."""

import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest
from shared_corpus import SHARED

kernels_testing = pytest.importorskip("engine3d._native.kernels_testing")

TRUTH = SHARED / "gltf" / "truth" / "dfg_truth.json"
SCRIPT = Path(__file__).parents[2] / "csrc" / "light" / "make_dfg_table.py"


@pytest.fixture(scope="module")
def script():
    specification = importlib.util.spec_from_file_location("make_dfg_table", SCRIPT)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def light_directions(count):
    """Cosines to the normal, crowded at the horizon, azimuths crowded at the mirror; weights."""
    t = (np.arange(count) + 0.5) / count
    return t**3, 3 * t**2 / count, np.pi * (1 - t**2), 4 * np.pi * t / count


def integrated(roughness, v, count=1500):
    """A and B by a sum over directions of light, which knows nothing of half vectors' shares."""
    square = roughness**4
    light, width, azimuth, arc = (array for array in light_directions(count))
    light, width = light[:, None], width[:, None]
    along = np.sqrt(1 - v * v) * np.sqrt(1 - light * light) * np.cos(azimuth) + v * light
    toward = np.sqrt((1 + along) / 2)
    h = (v + light) / (2 * toward)
    distribution = square / (np.pi * (h * h * (square - 1) + 1) ** 2)
    smith = light * np.sqrt(square + v * v * (1 - square))
    smith += v * np.sqrt(square + light * light * (1 - square))
    weight = distribution * 0.5 / smith * light * width * arc
    fresnel = (1 - toward) ** 5
    return (weight * (1 - fresnel)).sum(), (weight * fresnel).sum()


@pytest.mark.parametrize("roughness", [0.3, 0.5, 0.75, 1.0])
@pytest.mark.parametrize("v", [0.03125, 0.2, 0.6, 0.97])
def test_the_method_gives_the_integrals(script, roughness, v):
    assert script.ggx(roughness, v) == pytest.approx(integrated(roughness, v), abs=6e-5)


def test_the_table_is_what_the_script_makes(script):
    tables = [np.array(kernels_testing.dfg_table(kind)) for kind in range(3)]
    for i, j in ((0, 5), (3, 0), (10, 1), (31, 17), (45, 63), (63, 40)):
        roughness, v = i / 63, max((j / 63) ** 2, script.LEAST_COSINE)
        expected = [*script.ggx(roughness, v), script.sheen(roughness, v)]
        assert [table[i, j] for table in tables] == pytest.approx(expected, abs=1e-6)


def test_albedos_lose_light_and_never_make_any():
    a, b, sheen = (np.array(kernels_testing.dfg_table(kind)) for kind in range(3))
    assert (a >= 0).all() and (b >= 0).all() and (sheen >= 0).all()
    assert (a + b <= 1 + 1e-6).all() and (sheen <= 1).all()
    assert np.allclose((a + b)[0], 1)  # a mirror loses none


@pytest.mark.skipif(not TRUTH.exists(), reason="there is no shared/gltf/truth")
def test_against_the_truth_table(script):
    """Whose own sums are off by up to 0.0015 near grazing angles, where `integrated` is not."""
    truth = json.loads(TRUTH.read_text("utf-8"))
    errors = np.array(
        [
            [
                np.abs(np.subtract(script.ggx(roughness, v), truth["A_B"][i][j])).max()
                for j, v in enumerate(truth["NoV"])
            ]
            for i, roughness in enumerate(truth["roughness"])
        ]
    )
    assert errors.max() < 0.0016
    assert np.median(errors) < 1e-5
    rough = np.array(truth["roughness"]) >= 0.5
    steep = np.array(truth["NoV"]) > 0.5
    assert errors[np.ix_(rough, steep)].max() < 1e-5
