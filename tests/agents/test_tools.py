"""Tools of the server besides pictures: records against known values, errors in a line."""

import json
import re

import numpy as np
import pytest
from agents.conftest import Agent, models

import engine3d as e3d


def test_the_list_of_tools_is_short(agent):
    tools = agent.ask(lambda client: client.list_tools()).tools
    names = [tool.name for tool in tools]
    assert names == [
        *("load", "scene", "render", "views", "turntable", "pick", "measure", "distance"),
        *("check", "compare", "edit", "undo", "export", "formats", "health"),
    ]
    assert all(tool.output_schema and tool.description for tool in tools)
    listed = [tool.model_dump(mode="json", by_alias=True, exclude_none=True) for tool in tools]
    assert len(json.dumps(listed)) < 4 * 6000 * 0.8  # four letters are about a token


def test_loading_tells_what_came(agent):
    told = agent.told("load", path="three.e3d.json", name="three")
    assert told["parts"] == ["three/box", "three/ball", "three/ring"]
    assert told["triangles"] == 12 + 1280 + 2304 and told["bounds"][0] == [-0.5, -0.5, -0.6]
    told = agent.told("load", path="block.stl")
    assert (told["name"], told["format"], told["parts"]) == ("block", "stl", ["block"])
    assert any("up" in line for line in told["warnings"])  # +Z, beside +Y
    assert agent.told("load", path="block.stl")["name"] == "block-2"
    assert len(agent.told("scene")["objects"]) == 5


def test_measures_are_those_of_a_block(agent):
    agent.told("load", path="block.stl")
    told = agent.told("measure", objects="block")
    assert told["volume"] == pytest.approx(6) and told["area"] == pytest.approx(22)
    assert told["size"] == [1, 2, 3] and told["watertight"]
    assert told["inertia"][0][0] == pytest.approx(6 * (4 + 9) / 12)


def test_distances_and_faults(loaded):
    told = loaded.told("distance", a="three/box", b="three/ball")
    assert told["distance"] == pytest.approx(0.4, abs=0.01) and not told["touching"]
    loaded.told("edit", name="three/ball", translate=[-0.8, 0, 0])
    assert loaded.told("distance", a="three/box", b="three/ball")["touching"]
    assert "a part in common" in loaded.error("distance", a="three", b="three/box")
    assert loaded.told("check", name="three")["reasons"] == []
    box = e3d.box()
    e3d.save_mesh(e3d.Mesh(box.positions, box.faces[1:]), loaded.root / "open.ply")
    loaded.told("load", path="open.ply")
    told = loaded.told("check", name="open")
    assert told["open_edges"] == 3 and len(told["edges"]) == 3
    assert told["reasons"][0].startswith("3 edges have only one face")
    assert loaded.told("measure", objects="open")["volume"] is None


def test_edits_move_and_undo_takes_them_back(loaded):
    before = loaded.told("scene")["objects"]
    told = loaded.told("edit", name="three/box", translate=[1, 2, 3], scale=2)
    assert told["bounds"] == [[0, 1, 2], [2, 3, 4]]
    told = loaded.told("edit", name="three/box", rotate={"axis": "z", "degrees": 45})
    assert np.ptp(told["bounds"], axis=0) == pytest.approx([8**0.5, 8**0.5, 2])
    loaded.told("edit", name="three/ring", color="tomato")
    _, told = loaded.picture("render", objects="three/ring", view="three/ring", size=[64, 64])
    assert loaded.told("scene")["objects"][2]["color"] == "tomato"
    assert loaded.told("edit", name="three/ball", delete=True)["objects"] == ["three"]
    assert [one["name"] for one in loaded.told("scene")["objects"]] == ["three/box", "three/ring"]
    for _ in range(4):
        loaded.told("undo")
    assert loaded.told("scene")["objects"] == before
    loaded.told("undo")
    assert loaded.error("undo") == "there is nothing to undo"


def test_colours_are_drawn(loaded):
    loaded.told("edit", name="three/ball", color="#ff0000")
    image, told = loaded.picture("render", look="plain", size=[200, 200], objects="three/ball")
    x, y, width, height = told["visible"][0]["box"]
    red, green, blue = np.asarray(image)[y + height // 2, x + width // 2, :3].tolist()
    assert red > 150 and green < 60 and blue < 60


def test_comparisons(loaded):
    image, told = loaded.picture("compare", a="three/box", b="three/box", size=[120, 90])
    assert told["changed_pixels"] == 0 and told["hausdorff"]["distance"] == 0
    assert image.size == (3 * 120 + 12, 90)
    _, told = loaded.picture("compare", a="three/box", b="block.stl", size=[120, 90])
    assert told["changed_pixels"] > 100
    assert told["hausdorff"]["distance"] == pytest.approx((0.5**2 + 1) ** 0.5, abs=0.01)
    loaded.told("render", objects="three/box", size=[120, 90])
    loaded.told("export", path="last.png")
    _, told = loaded.picture("compare", a="last.png", b="last.png")
    assert told["changed_pixels"] == 0 and told["hausdorff"] is None
    _, told = loaded.picture("compare", a="three/ball", b="last.png")
    assert told["changed_pixels"] > 1000 and told["pixels"] == 120 * 90


@pytest.mark.parametrize("suffix", [".glb", ".stl", ".ply", ".obj", ".e3d.json"])
def test_what_is_exported_is_the_scene(loaded, suffix):
    loaded.told("edit", name="three/box", translate=[-2, 0, 0])
    told = loaded.told("export", path=f"out{suffix}", objects=["three/box", "three/ball"])
    assert told["bytes"] == (loaded.root / f"out{suffix}").stat().st_size
    found = e3d.load_mesh(loaded.root / f"out{suffix}")
    assert len(found.faces) == 12 + 1280
    np.testing.assert_allclose(found.bounds, [(-2.5, -0.5, -0.6), (2.1, 0.9, 0.6)], atol=1e-6)
    assert "give overwrite=true" in loaded.error("export", path=f"out{suffix}")
    loaded.told("export", path=f"out{suffix}", overwrite=True)


def test_formats_and_health(agent):
    told = agent.told("formats")
    assert {".glb", ".obj", ".step"} <= set(told["read"]) and ".stl" in told["write"]
    told = agent.told("health")
    assert told["version"] == e3d.__version__ and told["backend"] in e3d.backends()
    assert told["scripts"] is False and told["limits"]["root"] == str(agent.root)


@pytest.mark.parametrize(
    ("tool", "arguments", "message"),
    [
        ("rendr", {}, "there is no tool 'rendr': did you mean render?"),
        ("qqq", {}, "there is no tool 'qqq'"),
        ("render", {"vieww": "iso"}, "render has no argument 'vieww': did you mean view?"),
        ("render", {"view": "isso"}, "did you mean iso?"),
        ("render", {"view": {"azimut": 3}}, "did you mean azimuth?"),
        ("render", {"view": {"elevation": 91}}, "from -90 to 90"),
        ("render", {"view": {"azimuth": "north"}}, "must be a number"),
        ("render", {"view": 7}, "render: view: "),
        ("render", {"size": [800]}, "render: size: "),
        ("render", {"size": [0, 5]}, "each 16 to 1568 pixels (--max-side)"),
        ("render", {"size": [9999, 5]}, "each 16 to 1568 pixels (--max-side)"),
        ("render", {"look": "edgs"}, "did you mean edges?"),
        ("render", {"objects": ["bal"]}, "there is no 'bal'"),
        ("render", {"highlight": [{"object": "three/box", "faces": [12]}]}, "from 0 to 11"),
        ("render", {"highlight": [{"name": "three/box"}]}, "highlight must be like"),
        ("render", {"section": {"axis": "w"}}, "section"),
        ("views", {"names": "frnt"}, "'frnt' is none of front"),
        ("views", {"sections": "q=3"}, "is not like x=0.5"),
        ("turntable", {"frames": 1}, "from 2 to 36"),
        ("turntable", {"format": "gif"}, "format must be one of 'png', 'webp'"),
        ("pick", {"x": 1}, "pick: y: field required"),
        ("pick", {"x": 1, "y": 2}, "there is no picture yet"),
        ("pick", {"x": 999, "y": 2, "view": "iso"}, "outside of the picture, 800 x 600"),
        ("measure", {"objects": "nothing"}, "there is no 'nothing'"),
        ("compare", {"a": "three", "b": "nothing"}, "there is no 'nothing'"),
        ("edit", {"name": "three"}, "say what to change"),
        ("edit", {"name": "three", "scale": 0}, "a factor must not be 0"),
        ("edit", {"name": "three", "rotate": {"axis": "w", "degrees": 1}}, "axis must be x, y, z"),
        ("edit", {"name": "three", "translate": [1, 2]}, "translate must be three numbers"),
        ("edit", {"name": "three", "color": "tomatoe"}, "did you mean tomato?"),
        ("export", {"path": "a.xyz123"}, "none of those that can be written"),
        ("export", {"path": "a.png"}, "there is no picture yet"),
        ("export", {"path": "a.jpg"}, "pictures are written as .png"),
        ("load", {"path": "three.e3d.json", "up": "up"}, "up must be auto or one of"),
        ("load", {"path": "three.e3d.json", "name": "a/b"}, "without a slash"),
    ],
)
def test_errors_are_a_line_that_helps(loaded, tool, arguments, message):
    said = loaded.error(tool, **arguments)
    assert message in said and "\n" not in said and "Traceback" not in said


def test_damaged_files_are_errors(agent):
    (agent.root / "bad.glb").write_bytes(b"glTF\x02\0\0\0")
    assert "bad.glb" in agent.error("load", path="bad.glb")
    assert agent.told("scene")["objects"] == []


def test_scripts_run_only_where_they_may(agent, tmp_path):
    assert agent.call("script", code="def build(): pass").is_error
    models(tmp_path)
    may = Agent(tmp_path, allow_scripts=True)
    code = (
        "import engine3d as e\nprint('hello')\n"
        "def build():\n    return {'a': e.box(), 'b': [e.torus(), e.plane()]}\n"
    )
    told = may.told("script", code=code, name="made")
    assert told["parts"] == ["made/a", "made/b.1", "made/b.2"] and told["printed"] == "hello\n"
    (tmp_path / "part.py").write_text("import engine3d\nmake = engine3d.icosphere\n")
    assert may.told("script", path="part.py", function="make")["triangles"] == 1280
    for code, said in (
        ("def build():\n    return 1 / 0", "<script>:2: ZeroDivisionError: division by zero"),
        ("def build(:", "<script>:1: SyntaxError"),
        ("x = 1", "it defines no function 'build'"),
        ("def build(): return 5", "returned int"),
        ("import sys\ndef build(): sys.exit(3)", "SystemExit(3)"),
        ("a = []\na.append(a)\ndef build(): return a", "too deep"),
    ):
        assert said in may.error("script", code=code)


LATE = {
    "a generator": ("def build():\n    yield e.box()\n    yield 1 / 0", 4),
    "an iterator": ("def build(): return map(grown, 'ab')\ndef grown(a):\n    1 / 0", 4),
    "a mapping": (
        "class Many(dict):\n    def items(self):\n        1 / 0\ndef build(): return Many()",
        4,
    ),
    "a generator that exits": ("def build():\n    yield exit(3)", None),
}


@pytest.mark.parametrize("what", LATE)
def test_errors_in_what_a_script_returned_name_its_line(tmp_path, what):
    code, line = LATE[what]
    said = Agent(tmp_path, allow_scripts=True).error("script", code=f"import engine3d as e\n{code}")
    if line is None:
        assert said == "the script ended itself: SystemExit(3)"
    else:
        assert said == f"<script>:{line}: ZeroDivisionError: division by zero"


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"import engine3d\nname = '\xe9'\nbuild = engine3d.box", "a.py:2: SyntaxError: .*decode"),
        (b"# coding: nowhere\n", "a.py:1: SyntaxError: unknown encoding: nowhere"),
        ("x = 1".encode("utf-16"), "a.py:1: SyntaxError: source code .*null bytes"),
        (b"# coding: latin-1\nimport engine3d\nx = '\xe9'\nbuild = engine3d.box\n", ""),
        (b"\xef\xbb\xbfimport engine3d\r\nbuild = engine3d.box", ""),
    ],
)
def test_the_encoding_of_a_script_is_what_it_states(tmp_path, content, said):
    (tmp_path / "a.py").write_bytes(content)
    agent = Agent(tmp_path, allow_scripts=True)
    if said:
        assert re.match(said, agent.error("script", path="a.py"))
    else:
        assert agent.told("script", path="a.py")["triangles"] == 12


def test_a_call_ends_when_its_time_is_over(tmp_path):
    models(tmp_path)
    agent = Agent(tmp_path, allow_scripts=True, seconds=0.3)
    said = agent.error("script", code="def build():\n    while True:\n        pass")
    assert said == "took longer than 0.3 s, the limit (--timeout)"
    agent.told("load", path="block.stl")


def test_limits_of_size_hold(tmp_path):
    models(tmp_path)
    small = Agent(tmp_path, most_triangles=1000, most_bytes=100)
    assert "larger than 0 MB" in small.error("load", path="three.e3d.json")
    agent = Agent(tmp_path, most_triangles=1000)
    assert "the limit is 1,000 (--max-triangles)" in agent.error("load", path="three.e3d.json")
    assert agent.told("scene")["objects"] == []
