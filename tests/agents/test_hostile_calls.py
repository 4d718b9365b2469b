"""Random calls with hostile arguments: each ends in a record, or in an error of one short line."""

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
            result = await client.call_tool(tool.name, given)
            if result.is_error:
                said = result.content[0].text
                assert "a fault of" not in said and "\n" not in said, (tool.name, given, said)
                assert len(said) < 600, (tool.name, given, said)

    agent.ask(calls)


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
