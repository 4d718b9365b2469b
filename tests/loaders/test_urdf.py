"""Robots of URDF: where links are, what they look like, which files they find, what is refused."""

import math
import os
import re
import struct

import numpy as np
import pytest
from loaders.robots import robot

import engine3d as e3d

BOX = '<geometry><box size="1 2 3"/></geometry>'
ARM = """<robot name="arm">
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="base"><visual><geometry><box size="2 2 1"/></geometry>
    <material name="red"/></visual></link>
  <link name="upper"><visual name="bone"><origin xyz="0 0 1"/>
    <geometry><cylinder radius=".2" length="2"/></geometry>
    <material name="glass"><color rgba="0 0 1 .5"/></material></visual>
    <collision><geometry><sphere radius=".4"/></geometry></collision></link>
  <link name="hand"><visual><geometry><sphere radius=".3"/></geometry>
    <material name="glass"/></visual></link>
  <joint name="elbow" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 .5"/><axis xyz="0 2 0"/><limit lower="-1" upper="1.5"/></joint>
  <joint name="slide" type="prismatic"><parent link="upper"/><child link="hand"/>
    <origin xyz="0 0 2"/><axis xyz="0 0 1"/><limit lower="0" upper=".5"/></joint>
</robot>
"""


pytestmark = pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")


def load(text, **options):
    return e3d.load_scene(text.encode(), **options)


def one(scene):
    (found,) = scene.robots.values()
    return found


def stl(corners=((0, 0, 0), (1, 0, 0), (0, 1, 0))):
    facet = struct.pack("<12fH", 0, 0, 1, *np.ravel(corners), 0)
    return bytes(80) + struct.pack("<I", 1) + facet


def write(path, content=None):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(stl() if content is None else content)


def with_mesh(name, more=""):
    return (
        f'<robot name="r"><link name="a"><visual><geometry>\n<mesh filename="{name}" {more}/>'
        "</geometry></visual></link></robot>"
    )


@pytest.mark.parametrize("seed", range(30))
def test_links_are_where_matrices_say(seed):
    built = robot(seed)
    scene = load(built.text, joints=built.values)
    for name, pose in built.poses.items():
        np.testing.assert_allclose(one(scene).link_pose(name), pose, atol=1e-12)
        np.testing.assert_allclose(scene.find(name).world_pose, pose, atol=1e-12)
    later = load(built.text)
    one(later).set_joints(built.values)
    for name in built.poses:
        np.testing.assert_array_equal(later.find(name).world_pose, scene.find(name).world_pose)
    copied = scene.copy()
    one(copied).set_joints(
        dict.fromkeys([k for k in built.values if np.isscalar(built.values[k])], 0.0)
    )
    for name in built.poses:
        np.testing.assert_array_equal(one(scene).link_pose(name), one(later).link_pose(name))


def test_a_robot_tells_of_its_parts():
    scene = load(ARM)
    arm = one(scene)
    assert (arm.name, list(arm.links), list(arm.joints)) == (
        "arm",
        ["base", "upper", "hand"],
        ["elbow", "slide"],
    )
    elbow = arm.joints["elbow"]
    assert (elbow.kind, elbow.axis, elbow.limits, elbow.mimic) == (
        "revolute",
        (0.0, 1.0, 0.0),
        (-1.0, 1.5),
        None,
    )
    assert (elbow.parent.name, elbow.child.name) == ("base", "upper")
    assert [node.name for node in scene.find("upper").children] == ["bone", "hand"]
    elbow.value = 0.25
    assert arm.values == {"elbow": 0.25, "slide": 0.0} and elbow.value == 0.25
    assert arm.link_poses().keys() == arm.links.keys()


def test_materials_are_named_shared_and_transparent():
    meshes = [node.object for node in load(ARM).nodes if node.object is not None]
    red, bone, hand = (mesh.materials[0] for mesh in meshes)
    assert red.name == "red" and red.rgb == (1.0, 0.0, 0.0) and red.alpha_mode == "opaque"
    assert bone is hand and bone.alpha_mode == "blend"


def test_robots_stand_upright():
    scene = e3d.load(ARM.encode())
    assert scene.bounds[1][1] == pytest.approx(2.5 + 0.3, abs=1e-3)  # the hand is on top
    assert e3d.loaders.load_document(ARM.encode()).unit == "m"


def test_limits_hold_unless_they_are_not_to():
    arm = one(load(ARM))
    with pytest.warns(e3d.Engine3DWarning, match=r"'elbow': 3 rad is beyond its limits -1 to 1.5"):
        arm.set_joint("elbow", 3)
    assert arm.joints["elbow"].value == 1.5
    arm.set_joint("elbow", 3, clamp=False)
    assert arm.joints["elbow"].value == 3.0
    with pytest.warns(e3d.Engine3DWarning, match=r"'slide': -1 m is beyond"):
        load(ARM, joints={"slide": -1})


@pytest.mark.parametrize(
    "values, told",
    [
        ({"elbo": 1}, r"no joint 'elbo': did you mean elbow\? \(joints that move: elbow, slide\)"),
        ({"elbow": "x"}, r"the value of joint 'elbow'\) must be numbers"),
        ({"elbow": math.nan}, "takes finite numbers"),
        ({"elbow": (1, 2)}, "takes one number"),
        ({1: 2}, "no joint 1"),
        (3, "joints must be a dict"),
    ],
)
def test_wrong_joints_are_named(values, told):
    with pytest.raises(e3d.InvalidArgumentError, match=told):
        load(ARM, joints=values)
    arm = one(load(ARM))
    if isinstance(values, dict):
        with pytest.raises(e3d.InvalidArgumentError, match=told):
            arm.set_joints({"slide": 0.1, **values})
        assert arm.values == {"elbow": 0.0, "slide": 0.0}  # none moved


@pytest.mark.parametrize("kind", ["joints", "links", "robots"])
def test_a_misspelt_name_of_a_mapping_suggests_the_nearest(kind):
    scene = e3d.load(ARM.encode())
    (robot,) = scene.robots.values()
    names = scene.robots if kind == "robots" else getattr(robot, kind)
    known = max(names, key=len)
    with pytest.raises(e3d.InvalidArgumentError, match=f"there is no {kind[:-1]} .*{known}"):
        names[known + "s"]
    for wrong in (3, None, ("a",)):
        with pytest.raises(KeyError, match=f"^there is no {kind[:-1]} "):
            names[wrong]
    assert names.get("nothing") is None and "nothing" not in names


def test_fixed_and_following_joints_are_not_set():
    text = ARM.replace(
        "</robot>",
        '<link name="x"/><link name="y"/>'
        '<joint name="f" type="fixed"><parent link="base"/><child link="x"/></joint>'
        '<joint name="m" type="continuous"><parent link="x"/><child link="y"/>'
        '<mimic joint="elbow" multiplier="-2" offset=".5"/></joint></robot>',
    )
    arm = one(load(text))
    assert arm.joints["m"].value == 0.5  # at rest, too
    for name, told in (("f", "'f' is fixed"), ("m", "'m' follows 'elbow'")):
        with pytest.raises(e3d.InvalidArgumentError, match=told):
            arm.set_joint(name, 1)
    arm.set_joint("elbow", 0.25)
    assert arm.joints["m"].value == 0.0
    with pytest.raises(e3d.InvalidArgumentError, match=r"no link 'hnd': did you mean hand\?"):
        arm.link_pose("hnd")


def test_collision_shapes_show_on_request():
    names = {
        shapes: [n.name for n in load(ARM, shapes=shapes).nodes if n.object is not None]
        for shapes in ("visual", "collision", "both")
    }
    assert names["visual"] == ["base_visual", "bone", "hand_visual"]
    assert names["collision"] == ["upper_collision"]
    assert names["both"] == ["base_visual", "bone", "upper_collision", "hand_visual"]
    with pytest.raises(e3d.InvalidArgumentError, match="shapes"):
        load(ARM, shapes="all")
    only = f'<robot name="r"><link name="a"><collision>{BOX}</collision></link></robot>'
    scene = load(only)
    assert "no link has a visual shape: the collision shapes are drawn" in scene.warnings[0]
    assert scene.find("a_collision") is not None


def test_other_files_have_no_joints(tmp_path):
    write(tmp_path / "a.stl")
    for options in ({"joints": {"a": 1}}, {"shapes": "both"}):
        for function in (e3d.load_mesh, e3d.load_scene, e3d.loaders.load_document):
            with pytest.raises(
                e3d.InvalidArgumentError,
                match="are options of robots, and this is a file of format stl",
            ):
                function(tmp_path / "a.stl", **options)
    with pytest.raises(TypeError, match="unexpected keyword argument 'joint'"):
        e3d.load_scene(tmp_path / "a.stl", joint={})


@pytest.mark.parametrize("radius, length", [(0.5, 1.0), (0.1, 3.0), (2.0, 0.01)])
def test_shapes_have_their_size_and_stand_along_z(radius, length):
    for kind, high in (("cylinder", length / 2), ("capsule", length / 2 + radius)):
        text = (
            f'<robot name="r"><link name="a"><visual><geometry><{kind} radius="{radius}" '
            f'length="{length}"/></geometry></visual></link></robot>'
        )
        mesh = e3d.load_mesh(text.encode())
        np.testing.assert_allclose(mesh.bounds[1], (radius, radius, high), rtol=1e-6)
        np.testing.assert_allclose(mesh.bounds[0], (-radius, -radius, -high), rtol=1e-6)
        corners = mesh.positions[mesh.faces].astype(float)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert (np.linalg.norm(normals, axis=1) > 0).all()
        told = mesh.normals[mesh.faces].mean(axis=1)
        assert (np.einsum("ij,ij->i", normals, told) > 0).all()


def test_packages_are_found_around_the_robot_and_in_the_path(tmp_path, monkeypatch):
    robot_file = tmp_path / "ws" / "arm_description" / "urdf" / "arm.urdf"
    write(tmp_path / "ws" / "arm_description" / "meshes" / "a.stl")
    write(tmp_path / "ws" / "hand" / "b.stl")
    write(tmp_path / "ws" / "hand" / "package.xml", b"<package/>")
    write(tmp_path / "ros" / "far" / "c.stl")
    folders = [str(tmp_path / name) for name in ("none", "ros")]
    monkeypatch.setenv("ROS_PACKAGE_PATH", os.pathsep.join(folders))
    for name in (
        "package://arm_description/meshes/a.stl",
        "model://arm_description/meshes/a.stl",
        "$(find arm_description)/meshes/a.stl",
        "../meshes/a.stl",
        "package://hand/b.stl",
        "package://far/c.stl",
    ):
        write(robot_file, with_mesh(name).encode())
        scene = e3d.load_scene(robot_file)
        assert scene.warnings == [], name
        assert len(scene.find("a_visual").object.faces) == 1
    monkeypatch.delenv("ROS_PACKAGE_PATH")
    write(robot_file, with_mesh("package://far/c.stl").encode())
    with pytest.raises(
        e3d.FileFormatError, match="mesh 'package://far/c.stl' is left out: not found"
    ):
        e3d.load_scene(robot_file)
    assert e3d.load_scene(robot_file, root=tmp_path / "ros").warnings == []
    assert e3d.load_scene(with_mesh("package://far/c.stl").encode(), root=tmp_path / "ros")


def test_names_lead_nowhere_else(tmp_path):
    write(tmp_path / "secret" / "a.stl")
    write(tmp_path / "secret.stl")
    file = tmp_path / "robots" / "deep" / "arm.urdf"
    for name in (
        f"file://{tmp_path}/secret/a.stl",
        str(tmp_path / "secret" / "a.stl"),
        "../../secret/a.stl",
        "package://secret/a.stl",
        "package://../secret/a.stl",
        "package:///secret/a.stl",
        "model://robots/../secret/a.stl",
    ):
        write(file, with_mesh(name).encode())
        with pytest.raises(e3d.FileFormatError, match="nothing of this robot can be drawn"):
            e3d.load_scene(file)


def test_missing_meshes_are_named_by_line_and_the_rest_shows(tmp_path):
    text = with_mesh("none.stl").replace(
        "</robot>", f'<link name="b"><visual>{BOX}</visual></link></robot>'
    )
    write(tmp_path / "a.urdf", text.encode())
    scene = e3d.load_scene(tmp_path / "a.urdf")
    assert "a.urdf:1: 2 links have no parent: 'a', 'b'" in scene.warnings[0]
    assert scene.warnings[1].startswith(f"{tmp_path / 'a.urdf'}:2: mesh 'none.stl' is left out")
    assert scene.find("b_visual").object is not None


def test_meshes_are_scaled_and_turned_as_their_format_says(tmp_path):
    write(tmp_path / "a.stl")
    write(tmp_path / "a.urdf", with_mesh("a.stl", 'scale="2 -3 1"').encode())
    assert e3d.load_mesh(tmp_path / "a.urdf").bounds.tolist() == [[0, -3, 0], [2, 0, 0]]
    e3d.save_mesh(e3d.box((1, 2, 4)), tmp_path / "a.glb")  # glTF's +Y is up, a robot's +Z
    write(tmp_path / "a.urdf", with_mesh("a.glb").encode())
    np.testing.assert_allclose(e3d.load_mesh(tmp_path / "a.urdf").bounds[1], (0.5, 2, 1), atol=1e-6)
    e3d.save_mesh(e3d.box((1, 2, 4)), tmp_path / "a.obj")
    write(tmp_path / "a.urdf", with_mesh("a.obj").encode())
    np.testing.assert_allclose(e3d.load_mesh(tmp_path / "a.urdf").bounds[1], (0.5, 1, 2), atol=1e-6)


def test_a_robots_color_replaces_that_of_a_mesh_and_tints_its_texture(tmp_path):
    texture = e3d.Texture(np.full((2, 2, 4), 200, np.uint8))
    for name, material in (
        ("plain", e3d.Material(color=(0, 255, 0))),
        ("dressed", e3d.Material(texture=texture)),
    ):
        mesh = e3d.box()
        mesh.materials = [material]
        e3d.save_mesh(mesh, tmp_path / f"{name}.obj")
        text = with_mesh(f"{name}.obj").replace(
            "</visual>", '<material name="m"><color rgba="1 0 0 1"/></material></visual>'
        )
        write(tmp_path / "a.urdf", text.encode())
        made = e3d.load_mesh(tmp_path / "a.urdf").materials[0]
        assert made.rgb == (1.0, 0.0, 0.0)
        assert (made.texture is not None) == (name == "dressed")


def test_textures_of_materials_are_read_and_missed(tmp_path):
    from PIL import Image

    Image.new("RGB", (4, 4), (9, 8, 7)).save(tmp_path / "wood.png")
    text = (
        f'<robot name="r"><link name="a"><visual>{BOX}<material name="m">'
        '<texture filename="{}"/></material></visual></link></robot>'
    )
    write(tmp_path / "a.urdf", text.format("wood.png").encode())
    assert e3d.load_mesh(tmp_path / "a.urdf").materials[0].texture.name == "wood.png"
    write(tmp_path / "a.urdf", text.format("none.png").encode())
    mesh = e3d.load_mesh(tmp_path / "a.urdf")
    assert mesh.materials[0].texture is None and "a.urdf:1: texture 'none.png'" in mesh.warnings[0]


def joint(name, parent, child, kind="fixed", more=""):
    return (
        f'\n<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f"{more}</joint>"
    )


LINKS = "".join(f'\n<link name="{n}"><visual>{BOX}</visual></link>' for n in "abc")


@pytest.mark.parametrize(
    "inside, line, told",
    [
        (joint("j", "a", "bb"), 5, r"no link 'bb'$"),
        (joint("j", "base", "b"), 5, "no link 'base'"),
        (joint("j", "a", "b") + joint("j", "a", "c"), 6, "joint 'j' is in line 5 already"),
        ('\n<link name="a"/>', 5, "link 'a' is in line 2 already"),
        (
            joint("j", "a", "b") + joint("k", "c", "b"),
            6,
            "'b' has two parents: joint 'j' of line 5",
        ),
        (joint("j", "a", "b") + joint("k", "b", "a"), 6, "'a' is below itself: joints 'k'.*'j'"),
        (joint("j", "a", "a"), 5, "'a' is below itself"),
        ("\n<link/>", 5, "<link> needs name="),
        ('\n<joint name="j"/>', 5, "<joint> needs type="),
        ('\n<joint name="j" type="fixed"/>', 5, "<joint> needs <parent>"),
        (joint("j", "a", "b", "revolute", '<mimic joint="x"/>'), 5, "no joint 'x'"),
        (joint("j", "a", "b", "revolute", '<mimic joint="j"/>'), 5, "'j' follows itself"),
        (
            joint("j", "a", "b", "continuous", '<mimic joint="k"/>')
            + joint("k", "b", "c", "continuous", '<mimic joint="j"/>'),
            5,
            "'j' follows itself",
        ),
        ('\n<link name="d"><visual><geometry><box size="${w} 1 1"/>', 5, "this is xacro"),
    ],
)
def test_faults_of_the_tree_are_errors_with_lines(inside, line, told):
    ends = "</geometry></visual></link>" if "${" in inside else ""
    text = f'<robot name="r">{LINKS}{inside}{ends}</robot>'
    with pytest.raises(e3d.FileFormatError, match=told) as caught:
        load(text)
    assert caught.value.line == line


def of_color(rgba):
    """Return a link of a colour, in the robot's fifth line."""
    look = f'<material name="m"><color rgba="{rgba}"/></material>'
    return f'\n<link name="d"><visual>{BOX}{look}</visual></link>'


@pytest.mark.parametrize(
    "inside, told",
    [
        (joint("j", "a", "b", "revolut"), r"type 'revolut': did you mean revolute\?; it is fixed"),
        (joint("j", "a", "b", "revolute"), "a revolute joint without <limit>"),
        (
            joint("j", "a", "b", "revolute", '<limit lower="2" upper="1"/>'),
            "lower limit 2 is above",
        ),
        (
            joint("j", "a", "b", "continuous", '<axis xyz="0 0 0"/>'),
            "axis of joint 'j' has no length",
        ),
        (joint("j", "a", "b", "fixed", '<origin xyz="1 2"/>'), "xyz '1 2' is unreadable: 0 0 0"),
        (joint("j", "a", "b", "fixed", '<origin xyz="1 2 nan"/>'), "is unreadable"),
        (joint("j", "a", "b", "fixed", '<origin xyz="1 2 3 4"/>'), "of xyz '1 2 3 4', the first 3"),
        ('\n<link name="d"><visual><geometry><cone/></geometry></visual></link>', "'cone', which"),
        ('\n<link name="d"><visual/></link>', "visual of link 'd' has no geometry"),
        (
            '\n<link name="d"><visual><geometry><sphere radius="0"/></geometry></visual></link>',
            "size",
        ),
        (f'\n<link name="d"><visual>{BOX}<material name="m"/></visual></link>', "no material 'm'"),
        (of_color("255 0 0 1"), "rgba '255 0 0 1' is beyond 0 to 1"),
        (of_color("1 0 -.5 1"), "rgba '1 0 -.5 1' is beyond 0 to 1"),
        (of_color("1 0 0"), "rgba '1 0 0' is unreadable: 1 1 1 1"),
    ],
)
def test_what_can_be_left_out_is_a_warning_with_its_line(inside, told):
    scene = load(f'<robot name="r">{LINKS}{inside}</robot>')
    said = [line for line in scene.warnings if "have no parent" not in line]
    assert len(said) == 1 and ":5: " in said[0]
    assert re.search(told, said[0])


def test_files_that_other_readers_take_are_taken():
    plain = f'<robot name="r"><link name="a"><visual>{BOX}</visual></link></robot>'
    for text, told in (
        ("\n\n <?xml version='1.0'?>\n" + plain, 0),
        (plain + "\n\x01\x02 ", 1),
        (plain.replace('"1 2 3"', '"1, 2,3"'), 0),
        (plain.replace("<robot", '<robot xmlns:xacro="http://ros.org/wiki/xacro"'), 0),
    ):
        scene = load(text)
        assert len(scene.warnings) == told
        np.testing.assert_allclose(scene.bounds[1], (0.5, 1, 1.5))
    other = load("<?xml version='1.0'?>\n" + plain, format="urdf")
    assert one(other).name == "r"


@pytest.mark.parametrize(
    "text, told",
    [
        ("<robot name='r'><link name='a'>", "no well-formed XML"),
        ("<sdf/>", "its root is <sdf>, not <robot>"),
        ("<robot name='r'/>", "a robot without links"),
        ("<robot name='r'><link name='a'/></robot>", "no link has a shape that can be drawn"),
        *(
            (
                f"<robot name='r'><link name='a'><visual>{inside}</visual></link></robot>",
                f"nothing of this robot can be drawn: a visual of link 'a' {why}",
            )
            for inside, why in (
                ("<geometry><box size='0 1 1'/></geometry>", "has no size"),
                ("<geometry><box size='nan 1 1'/></geometry>", "has no size"),
                ("<geometry><sphere/></geometry>", "has no size"),
                ("<geometry><cone/></geometry>", "is a 'cone'"),
                ("", "has no geometry"),
            )
        ),
        (
            "<!DOCTYPE robot [<!ENTITY a 'aaa'>]><robot name='&a;'/>",
            "a document type is not allowed",
        ),
        (
            "<!DOCTYPE r [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><robot name='r'>&x;</robot>",
            "a document type is not allowed",
        ),
        (
            "<robot xmlns:xacro='http://ros.org/wiki/xacro'><xacro:include filename='x'/></robot>",
            "this is xacro, from which URDF is made: xacro IN.urdf.xacro > OUT.urdf",
        ),
        ("<robot>" + "<a>" * 100 + "</a>" * 100 + "</robot>", "nested more than 64 deep"),
    ],
)
def test_what_is_no_robot_is_refused(text, told):
    with pytest.raises(e3d.FileFormatError, match=told):
        load(text, format="urdf")


def test_damaged_files_end_in_our_errors():
    random = np.random.default_rng(5)
    for seed in range(150):
        data = bytearray(robot(seed % 7, 5).text.encode())
        for _ in range(random.integers(1, 6)):
            place = random.integers(len(data))
            data[place : place + random.integers(0, 9)] = random.bytes(random.integers(0, 5))
        try:
            e3d.load_scene(bytes(data), format="urdf")
        except e3d.Engine3DError as error:
            assert "\n" not in str(error)


def test_long_chains_are_read_in_time():
    count = 3000
    text = f'<robot name="r"><link name="l0"><visual>{BOX}</visual></link>'
    text += "".join(
        f'<link name="l{k}"/>'
        + joint(f"j{k}", f"l{k - 1}", f"l{k}", "prismatic", '<origin xyz="0 0 1"/>')
        for k in range(1, count)
    )
    scene = load(text + "</robot>")
    assert one(scene).link_pose(f"l{count - 1}")[2, 3] == count - 1
