"""Thin films and anisotropy (R136 to R141): the texts of their extensions in float64."""

import numpy as np
import pytest
from kernels.harness import all_backends
from kernels.test_physical import directions, seen, shown, unit

# Belcour and Barla 2017: Gaussians over the wave number, in metres.
VALUE = np.array([5.4856e-13, 4.4201e-13, 5.2481e-13, 9.7470e-14])
PLACE = np.array([1.6810e6, 1.7953e6, 2.2084e6, 2.2399e6])
SPREAD = np.array([4.3278e9, 9.3046e9, 6.6121e9, 4.5282e9])
RGB = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.9692660, 1.8760108, 0.0415560],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)


def sensitivity(path, shift):
    """Of a path in nanometres and phases (3,), as KHR_materials_iridescence writes it."""
    phase, shifts = 2e-9 * np.pi * path, np.append(shift, shift[0])
    waves = VALUE * np.sqrt(2 * np.pi * SPREAD) * np.cos(PLACE * phase + shifts)
    waves *= np.exp(-SPREAD * phase**2) / 1.0685e-7
    return RGB @ (waves[:3] + [waves[3], 0, 0])


def schlick(f0, cosine):
    return f0 + (1 - f0) * (1 - cosine) ** 5


def film_of(cosine, ior, thickness, f0):
    """Reflectance (3,) of a film on what reflects ``f0``."""
    below = np.sqrt(1 - (1 - cosine**2) / ior**2)
    r12 = schlick(((ior - 1) / (ior + 1)) ** 2, cosine)
    root = np.sqrt(np.clip(f0, 0, 0.9999))
    base = (1 + root) / (1 - root)
    r23 = schlick(((base - ior) / (base + ior)) ** 2, below)
    phase = np.pi + np.where(base < ior, np.pi, 0)
    both = np.clip(r12 * r23, 1e-5, 0.9999)
    rs = (1 - r12) ** 2 * r23 / (1 - both)
    total, term = r12 + rs, rs - (1 - r12)
    for m in (1, 2):
        term = term * np.sqrt(both)
        total = total + term * 2 * sensitivity(m * 2 * ior * thickness * below, m * phase)
    return np.clip(total, 0, 1)


@all_backends
@pytest.mark.parametrize("metallic", [0, 1])
def test_films_reflect_what_the_extension_says(kernels, metallic):
    """Seen as the highlight of one light over what a surface without its film shows there."""
    rng = np.random.default_rng(9)
    for n, v, to in zip(*directions(60, 4), strict=True):
        ior, thickness, albedo = rng.uniform(1.05, 2.4), rng.uniform(1, 1200), rng.uniform(0, 1, 3)
        look = {"metallic": [metallic], "roughness": [0.6], "reflectance": [0.06, 0.04, 0.09]}
        film = {
            "iridescence": [0.8],
            "iridescence_ior": [ior],
            "iridescence_thickness": [thickness],
        }
        f0 = albedo if metallic else np.array(look["reflectance"])
        bare, coated = (shown(kernels, n, v, albedo, to, **look, **more) for more in ({}, film))
        cosine, w5 = min(abs(n @ v), 1), (1 - v @ unit(to + v)) ** 5
        reflects = film_of(cosine, ior, thickness, f0)
        fresnel, top = f0 + (1 - f0) * w5, 0.09 + 0.91 * w5
        # With both, the lobe's D times V follows from the bare surface.
        diffuse = (1 - metallic) * albedo / np.pi * (n @ to)
        lobe = (bare - diffuse * (1 - top)) / fresnel
        mixed = fresnel + (reflects - fresnel) * 0.8
        kept = 1 - (top + (reflects.max() - top) * 0.8)
        expected = diffuse * kept + lobe * mixed
        assert np.allclose(coated, expected, rtol=2e-5, atol=1e-5), (ior, thickness)


@all_backends
def test_no_film_without_thickness(kernels):
    for n, v, to in zip(*directions(5, 5), strict=True):
        film = {"iridescence": [1], "iridescence_ior": [1.3], "iridescence_thickness": [0]}
        args = kernels, n, v, (0.9, 0.5, 0.1), to, 0.3
        assert np.allclose(shown(*args, **film), shown(*args), rtol=1e-6)


def stretched(n, t, v, to, roughness, strength):
    """KHR_materials_anisotropy's D times V."""
    h, b, ab = unit(to + v), np.cross(n, t), roughness**2
    at = ab + (1 - ab) * strength**2
    f = np.array([ab * (t @ h), at * (b @ h), at * ab * (n @ h)])
    distribution = (at * ab) * ((at * ab) / (f @ f)) ** 2 / np.pi
    lengths = [np.linalg.norm([at * (t @ d), ab * (b @ d), n @ d]) for d in (v, to)]
    return distribution * 0.5 / ((n @ to) * lengths[0] + abs(n @ v) * lengths[1])


@all_backends
def test_anisotropy_is_that_of_the_extension(kernels):
    rng = np.random.default_rng(7)
    for n, v, to in zip(*directions(80, 6), strict=True):
        t = unit(np.cross(n, rng.normal(size=3)))
        roughness, strength, turn = rng.uniform(0.2, 1), rng.uniform(0, 1), rng.uniform(0, 6)
        sign = rng.choice([-1, 1])
        albedo = np.array([0.9, 0.5, 0.1])
        look = {"metallic": [1], "roughness": [roughness], "anisotropy": [strength]}
        look["anisotropy_turn"] = [np.cos(turn), np.sin(turn)]
        got = shown(kernels, n, v, albedo, to, tangent=[*t, sign], **look)
        along = np.cos(turn) * t + np.sin(turn) * sign * np.cross(n, t)
        fresnel = albedo + (1 - albedo) * (1 - v @ unit(to + v)) ** 5
        expected = fresnel * stretched(n, along, v, to, roughness, strength) * (n @ to)
        # As for appendix B: what is rounded to float32 counts more where the lobe is narrow.
        allowed = 1e-5 + (1e-5 + 4e-7 / roughness**2) * expected
        assert (abs(got - expected) <= allowed).all(), (roughness, strength)


@all_backends
def test_without_a_tangent_a_lobe_is_round(kernels):
    for n, v, to in zip(*directions(20, 8), strict=True):
        look = {"metallic": [1], "roughness": [0.4]}
        args = kernels, n, v, (0.9, 0.5, 0.1), to
        assert np.allclose(
            shown(*args, anisotropy=[1], **look), shown(*args, **look), rtol=3e-5, atol=1e-6
        )


@all_backends
def test_the_furnace_is_at_most_white(kernels):
    """Light that is 1 all around and behind: with films and stretched lobes nothing shows more."""
    for angle in (0.05, 0.7, 1.2, 1.5):
        view = np.array([np.sin(angle), 0, np.cos(angle)])
        for roughness in (0, 0.3, 1):
            for film in (0, 150, 400, 700):
                look = {
                    "roughness": [roughness],
                    "iridescence_thickness": [film],
                    "iridescence_ior": [1.4],
                }
                look |= {"iridescence": [1], "anisotropy": [0.8], "transmission": [0.5]}
                for metallic in (0, 0.5, 1):
                    args = kernels, (0, 0, 1), view, [1] * 3, None, 1
                    tangent = [1, 0, 0, 1]
                    own, passing = seen(*args, tangent=tangent, metallic=[metallic], **look)
                    assert (own + passing).max() <= 1.005
                    assert (own + passing).min() > 0.5
