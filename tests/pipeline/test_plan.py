"""The plan of a frame: from what is asked for, by the core's table, the same in every frame."""

from itertools import product

import pytest
from kernels.calls import kernels_testing
from plain_picture import Renderer

import engine3d as e3d

MODES = ("lit", "unlit", "random", "depth", "normal", "face_id", "object_id", "overdraw")
OUTPUTS = {
    "color": "COLOR",
    "ndc_depth": "NDC_DEPTH",
    "depth": "POSITIONS",
    "position": "POSITIONS",
    "world_position": "POSITIONS",
    "normal": "NORMALS",
    "world_normal": "NORMALS",
    "uv": "UVS",
    "albedo": "ALBEDO",
    "face_id": "IDENTITIES",
    "object_id": "IDENTITIES",
    "instance_id": "IDENTITIES",
    "material_id": "IDENTITIES",
    "barycentric": "BARYCENTRIC",
    "metallic_roughness": "MATERIALS",
    "emissive": "MATERIALS",
    "tangent": "TANGENTS",
    "radiance": "RADIANCE",
}


def mesh_with_line():
    return e3d.Mesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], lines=[[0, 2]], uvs=[[0, 0], [1, 0], [0, 1]]
    )


def scene_of(*, lights=(), line=False):
    scene = e3d.Scene()
    scene.add(mesh_with_line() if line else e3d.box())
    for light in lights:
        scene.add(light)
    return scene


def asked_for(scene_facts, *, outputs=("color",), mode="lit", wireframe=None, hidden_lines=False,
              hidden_surfaces="zbuffer", shading="deferred", culling="all"):  # fmt: skip
    """What the table takes for asked, found from the arguments alone."""
    facts = {OUTPUTS[name] for name in outputs}
    of_mode = {"lit": "LIT", "unlit": "UNLIT", "depth": "DEPTH_MODE", "normal": "NORMAL_MODE"}
    facts |= {of_mode[mode]} if mode in of_mode else set()
    facts |= {"OVERDRAW_MODE"} if mode == "overdraw" else set()
    facts |= scene_facts & {"LOCAL_LIGHT", "MANY_LIGHTS"} if mode == "lit" else set()
    if wireframe is not None:
        facts |= {"WIREFRAME"}
    if wireframe == "only":
        facts |= {"WIRE_ONLY"} | (scene_facts & {"LINES"})
        facts |= set() if hidden_lines else {"HIDDEN_LINES"}
    facts |= {"ZBUFFER"} if hidden_surfaces == "zbuffer" else set()
    facts |= {"FORWARD"} if shading == "forward" else set()
    facts |= {"OCCLUSION"} if culling in ("all", "always") else set()
    return facts | {"SRGB"}


def planned(facts):
    """What the conditions make of facts, as `frame.stats["plan"]` names it."""
    known = set(facts)
    for item, needs, forbids in kernels_testing.plan_conditions():
        if known.issuperset(needs) and known.isdisjoint(forbids):
            known.add(item)
    return tuple(name.lower() for name, _ in kernels_testing.planned_items() if name in known)


def check(renderer, scene, scene_facts, **options):
    stats = renderer.render(scene, **options).stats
    assert stats["plan"] == planned(asked_for(scene_facts, **options)), options


@pytest.fixture(scope="module")
def renderer():
    return Renderer((16, 16), threads=1)


@pytest.mark.parametrize("wireframe", [None, "overlay", "only"])
def test_options_lead_to_the_plan_of_the_rules(renderer, wireframe):
    scene = scene_of(lights=[e3d.DirectionalLight()])
    ways = product(MODES, ("zbuffer", "painter", "none"), ("deferred", "forward"), (False, True))
    for mode, hidden, shading, hidden_lines in ways:
        check(renderer, scene, set(), mode=mode, hidden_surfaces=hidden, shading=shading,
              wireframe=wireframe, hidden_lines=hidden_lines)  # fmt: skip


@pytest.mark.parametrize("output", OUTPUTS)
def test_outputs_lead_to_the_plan_of_the_rules(renderer, output):
    scene = scene_of(lights=[e3d.DirectionalLight()])
    for outputs, wireframe in product(((output,), {"color", output}), (None, "only")):
        check(renderer, scene, set(), outputs=outputs, wireframe=wireframe, hidden_lines=True)


@pytest.mark.parametrize("culling", ["all", "always", "tree", "frustum", "none"])
def test_culling_leads_to_the_plan_of_the_rules(renderer, culling):
    check(renderer, scene_of(), set(), culling=culling)


def test_lights_and_lines_of_the_scene_lead_to_the_plan_of_the_rules(renderer):
    near = e3d.PointLight(range=4.0)
    cases = [
        (scene_of(lights=[near]), {"LOCAL_LIGHT"}),
        (scene_of(lights=[e3d.DirectionalLight()] * 5), {"MANY_LIGHTS"}),
        (scene_of(lights=[near] * 5), {"LOCAL_LIGHT", "MANY_LIGHTS"}),
        (scene_of(line=True), {"LINES"}),
    ]
    for scene, facts in cases:
        for mode, wireframe in product(("lit", "unlit"), (None, "only")):
            check(renderer, scene, facts, mode=mode, wireframe=wireframe, hidden_lines=True)


def test_alpha_leads_to_the_plan_of_the_rules(renderer):
    scene, glass = e3d.Scene(), e3d.box()
    glass.materials = [e3d.Material(color=(1.0, 1.0, 1.0, 0.5), alpha_mode="blend")]
    scene.add(glass)
    wanted = ("color",), ("ndc_depth", "color"), ("depth",)
    for mode, shading, outputs in product(MODES, ("deferred", "forward"), wanted):
        for front in (False, True):
            options = {"mode": mode, "shading": shading, "outputs": outputs}
            facts = asked_for(set(), **options) | {"ALPHA"}
            facts |= {"TRANSPARENT_OUTPUTS"} if front else set()
            stats = renderer.render(scene, transparent_outputs=front, **options).stats
            assert stats["plan"] == planned(facts), (options, front)


def test_what_another_camera_holds_is_drawn_without_rounds(renderer):
    scene = scene_of()
    other = e3d.frame_scene(scene)
    plan = renderer.render(scene, culling_camera=other).stats["plan"]
    assert "rounds" in renderer.render(scene).stats["plan"]
    assert "rounds" not in plan


def test_the_reference_has_no_plan():
    frame = Renderer((16, 16), backend="scalar").render(scene_of())
    assert frame.stats["plan"] == ()
