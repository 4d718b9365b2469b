"""Random calls with hostile arguments: each ends in a record, or in an error of one short line.

An error changes nothing.
"""

import random

import pytest

import engine3d as e3d

VALUES = [
    *(None, True, 0, -1, 1e308, 2**70, float("inf"), [], {}, [[]], [1, 2], [1, 2, 3], [40, 30]),
    *("", ".", "iso", "three", "three/box", "x" * 5000, "a\nb", "50%", "png", "out.stl", "#12"),
    *({"axis": "x"}, {"axis": "z", "at": 1e300}, {"axis": "x", "degrees": 1e300}),
    *({"azimuth": 1e300}, {"fit": 5}, {"fit": ["three/box"], "distance": 1e-300}),
    *([{"object": "three/box", "faces": [0]}], [{"object": "three", "faces": [-1]}], ["three"]),
]


def kept(agent):
    """Return what a session keeps for later calls."""
    session = agent.session
    return list(session.things.items()), list(session._before), session.last


@pytest.mark.parametrize("seed", range(3))
def test_any_call_ends_well(agent, seed):
    chosen = random.Random(seed)

    async def calls(client):
        tools = (await client.list_tools()).tools
        for _ in range(60):
            if "three" not in agent.session.things:
                await client.call_tool("load", {"path": "three.e3d.json", "name": "three"})
            tool = chosen.choice(tools)
            names = list(tool.input_schema["properties"])
            given = {name: chosen.choice(VALUES) for name in names if chosen.random() < 0.5}
            if "size" in names:
                given["size"] = [64, 48]
            before = kept(agent)
            result = await client.call_tool(tool.name, given)
            if result.is_error:
                said = result.content[0].text
                assert "a fault of" not in said and "\n" not in said, (tool.name, given, said)
                assert len(said) < 600, (tool.name, given, said)
                assert kept(agent) == before, (tool.name, given)

    agent.ask(calls)


def test_what_stands_far_out_can_be_hidden_and_colored(loaded):
    far = e3d.Scene()
    far.add(e3d.box(), scale=1e31)
    e3d.save_scene(far, loaded.root / "far.e3d.json")
    loaded.told("load", path="far.e3d.json", name="far")
    loaded.told("edit", name="far", color="red")
    loaded.told("edit", name="far", visible=False)


HUGE = [
    {"scale": 1e200},
    {"translate": [0, -1.7e308, 0]},
    {"scale": [1, 1, 1e308], "rotate": {"axis": "x", "degrees": 30}},
]


@pytest.mark.parametrize("change", HUGE, ids=str)
@pytest.mark.parametrize("name", ["three", "three/box", "lamp"])
def test_edits_that_nothing_could_show_change_nothing(loaded, name, change):
    lamp = e3d.Scene()
    lamp.add(e3d.PointLight(), translation=(1, 2, 3))
    e3d.save_scene(lamp, loaded.root / "lamp.e3d.json")
    loaded.told("load", path="lamp.e3d.json", name="lamp")
    before = kept(loaded)
    assert "too large or too far away" in loaded.error("edit", name=name, **change)
    assert kept(loaded) == before
    assert not loaded.told("render", size=[32, 24])["blank"]
    for _ in range(2):  # one large step may be drawn, but not several of them
        loaded.call("edit", name=name, scale=1e25)
    loaded.told("render", size=[32, 24])


@pytest.mark.parametrize(
    ("where", "tool", "given"),
    [
        ("session.Session.bounds_of", "load", {"path": "block.stl"}),
        ("session.Session.bounds_of", "edit", {"name": "three", "scale": 2}),
        ("pictures.Drawn.encode", "render", {"size": [32, 24]}),
    ],
)
def test_an_answer_that_fails_changes_nothing(loaded, monkeypatch, where, tool, given):
    def full(*_):
        raise MemoryError

    before = kept(loaded)
    monkeypatch.setattr(f"engine3d.apps.agents.{where}", full)
    assert loaded.error(tool, **given) == "out of memory"
    assert kept(loaded) == before


@pytest.mark.parametrize("where", ["plug-in", "library"])
def test_nothing_ends_the_server(agent, monkeypatch, where):
    """A reader of another package may exit, and so may a library that engine3d uses."""

    def ended(*_, **__):
        raise SystemExit(1)

    (agent.root / "a.zzz").write_text("x")
    if where == "plug-in":
        e3d.plugins.register("readers", "zzz", ended)
    else:
        monkeypatch.setattr("engine3d.apps.agents.session.open_model", ended)
    try:
        said = agent.error("load", path="a.zzz")
    finally:
        if where == "plug-in":
            e3d.plugins.unregister("readers", "zzz")
    assert "SystemExit: 1" in said
    assert ("'zzz' of engine3d.readers" in said) == (where == "plug-in")
    assert agent.told("scene")["objects"] == []
