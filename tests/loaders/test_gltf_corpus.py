"""glTF files of other projects, sound, broken and hostile, against what must come out of them."""

import importlib.util
import json
import time
import warnings

import numpy as np
import pytest
from missing_here import peak_memory
from shared_corpus import SHARED

import engine3d as e3d
from engine3d.apps.cli.commands.info import describe
from engine3d.errors import Engine3DError
from engine3d.loaders import load_document, load_mesh

GLTF = SHARED / "gltf"
SECONDS, SECONDS_IF_LARGE, LARGE = 2.0, 10.0, 1 << 20
# Another machine may be busy: this bounds what hangs.
SLACK = 10
# What a reader of ours takes otherwise than the corpus.
OTHERWISE = {
    # Its buffer is there.
    "broken/microsoft_glTF-SDK/CubeNoBuffer/CubeNoBuffer.glb",
}
# They need a glTF that is newer than 2.0.
NEWER = {
    "generator/Compatibility/Compatibility_04.gltf",
    "validator/base/data/asset/min_version_valid.gltf",
}
# Nothing that is drawn is damaged in these, or nothing but some of it: the rest is, with a warning.
SPARED = {
    "broken/assimp_assimp/badNumber/badNumber.gltf",
    "broken/assimp_assimp/badObject/badObject.gltf",
    "broken/magnum/animation-invalid.gltf",
    "broken/magnum/material-invalid.gltf",
    "broken/magnum/skin-invalid.gltf",
    "broken/vpenades_SharpGLTF/InconsistentMorphTargets_unfixed/"
    "InconsistentMorphTargets_unfixed.glb",
    *(
        f"hostile/{name}.gltf"
        for name in (
            *("anim_backwards", "anim_cubic_short", "anim_nan", "anim_node_oob", "camera_far"),
            *("factor_3", "factor_negative", "morph_count", "morph_target_null"),
            *("skin_ibm_short", "skin_no_joints"),
        )
    ),
    *(
        f"validator/base/data/{name}.gltf"
        for name in (
            *("animation/empty_objects", "animation/sampler_input_format_invalid"),
            *("animation/sampler_output_count_invalid", "animation/sampler_output_format_invalid"),
            *("animation/unresolved_channel_sampler", "animation/unresolved_sampler_input"),
            *("animation/unresolved_sampler_output", "animation_data/invalid_input_values"),
            *("mesh_data/joints_no_weights", "mesh_data/joints_weights_complex"),
            *("root/extensions_non_objects", "root/invalid_collection_type"),
        )
    ),
    "validator/ext/KHR_lights_punctual/data/light/empty_object.gltf",
    "validator/ext/KHR_lights_punctual/data/node/unresolved_light_empty_root_ext.gltf",
}
# Packages that some files need -> what says so.
PACKAGES = {"DracoPy": "engine3d[draco]", "opengl_basisu": "engine3d[ktx2]"}

pytestmark = pytest.mark.skipif(
    not (GLTF / "expected.json").is_file(),
    reason="needs the glTF corpus in ../shared (or ENGINE3D_SHARED)",
)


def cases(*folders):
    try:
        table = json.loads((GLTF / "expected.json").read_text())
    except FileNotFoundError:
        return []
    return [
        pytest.param(case, id=case["file"])
        for case in table
        if case["file"].split("/")[0] in folders
        and case["file"].endswith((".glb", ".gltf"))
        and not (case["file"] in NEWER and "generator" in folders)
    ]


def loaded(load, case):
    """What a file gives, or the error of ours that names it; nothing else may come."""
    path = GLTF / case["file"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return load(path)
        except Engine3DError as error:
            assert str(error).startswith(str(path))
            assert "\n" not in str(error)
            return error


def needs_package(found):
    """Whether a file is refused for lack of a package, which the message names."""
    return isinstance(found, Engine3DError) and any(
        hint in str(found) and importlib.util.find_spec(package) is None
        for package, hint in PACKAGES.items()
    )


@pytest.mark.parametrize("case", cases("models", "generator", "own"))
def test_sound_files(case):
    report = loaded(describe, case)
    if case["file"].startswith(("models/", "own/")) and not isinstance(report, Engine3DError):
        assert json.dumps(loaded(describe, case)) == json.dumps(report)  # the same each time
    expected = case.get("expect")
    if needs_package(report) or expected is None:
        return
    assert not isinstance(report, Engine3DError), report
    for name in ("nodes", "meshes", "cameras"):
        assert report[name] == expected[name], name
    assert report["lights"] == [light["type"] for light in expected["light_list"]]
    assert report["skins"] == [{"joints": skin["joints"]} for skin in expected["skin_list"]]
    for clip, wanted in zip(report["animations"], expected["animation_list"], strict=True):
        assert clip["name"] == wanted["name"]
        assert clip["duration"] == pytest.approx(wanted["duration"], rel=1e-6)
    names = [material.get("name", "") for material in expected["material_list"]]
    assert [material["name"] for material in report["materials"]] == names
    if "KHR_node_visibility" in case["features"]:
        assert report["triangles"] < expected["scene_triangles"]  # which counts hidden nodes, too
        return
    assert report["triangles"] == expected["scene_triangles"]
    check_box(report["bounds"], expected["bbox_rest"])


def check_box(box, expected):
    if expected is None:
        assert box is None
        return
    size = np.ptp(expected, axis=0).max()
    assert np.allclose(box, expected, atol=1e-4 * size + 1e-7, rtol=1e-5)


@pytest.mark.parametrize("case", cases("models", "generator", "own"))
def test_one_mesh_of_sound_files(case):
    expected = case.get("expect")
    mesh = loaded(load_mesh, case)
    if needs_package(mesh) or expected is None or "KHR_node_visibility" in case["features"]:
        return
    drawn = expected["scene_triangles"], expected["scene_line_segments"], expected["scene_points"]
    if isinstance(mesh, Engine3DError):
        assert "no vertices" in str(mesh) and sum(drawn) == 0
        return
    assert (len(mesh.faces), len(mesh.lines), len(mesh.points)) == drawn
    check_box(mesh.bounds, expected["bbox_rest"])


@pytest.mark.parametrize("case", cases("models", "generator", "own"))
def test_materials_of_sound_files(case):
    expected = case.get("expect")
    document = loaded(load_document, case)
    if needs_package(document) or expected is None:
        return
    for material, wanted in zip(document.tree.materials, expected["material_list"], strict=True):
        assert material.name == wanted.get("name", "")
        assert material.two_sided == wanted["doubleSided"]
        assert material.alpha_mode == wanted["alphaMode"].lower()
        assert material.emissive == pytest.approx(wanted["emissiveFactor"])
        if "KHR_materials_pbrSpecularGlossiness" in wanted.get("extensions", ()):
            assert (material.metallic, material.ior) == (0, 0)
            continue
        assert (*material.rgb, material.alpha) == pytest.approx(wanted["baseColorFactor"])
        assert material.metallic == pytest.approx(wanted["metallicFactor"])
        assert material.roughness == pytest.approx(wanted["roughnessFactor"])
        told = " ".join(document.warnings)
        for key, slot in (
            ("baseColorTexture", "texture"),
            ("metallicRoughnessTexture", "metallic_roughness_texture"),
            ("normalTexture", "normal_texture"),
            ("occlusionTexture", "occlusion_texture"),
            ("emissiveTexture", "emissive_texture"),
        ):
            assert (getattr(material, slot) is not None) == (key in wanted) or "left out" in told


@pytest.mark.parametrize("case", cases("broken", "hostile", "validator"))
def test_broken_files(case):
    """Those that must be refused are; the others give a scene, with a warning where it is due."""
    start, before = time.process_time(), peak_memory()
    found = loaded(e3d.load_scene, case)
    most = SECONDS_IF_LARGE if case["size"] > LARGE else SECONDS
    assert time.process_time() - start < SLACK * most
    grown = peak_memory() - before
    assert grown <= (64 << 20) + 100 * case["size"]
    # What reads more of a file finds no more fault with it.
    assert isinstance(loaded(describe, case), Engine3DError) == isinstance(found, Engine3DError)
    if case["file"] in OTHERWISE:
        return
    if case["file"] in NEWER:
        assert "needs glTF of version '2.1', only 2.0 is read" in str(found)
        return
    if case["file"] in SPARED:
        assert found.warnings
        return
    if case["outcome"] == "error":
        assert isinstance(found, Engine3DError)
    if case["outcome"] in ("ok", "warn"):
        assert not isinstance(found, Engine3DError), found
    if case["file"].startswith("hostile/") and case["outcome"] == "warn":
        assert found.warnings
