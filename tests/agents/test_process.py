"""The command in a process of its own, which talks over its standard streams."""

import asyncio
import gc
import json
import os
import subprocess
import sys
import time

import pytest
from agents.conftest import Agent, models

from engine3d.apps.agents.pictures import Request
from engine3d.apps.cli import main
from engine3d.model.scene.scene import Scene

mcp = pytest.importorskip("mcp", exc_type=ImportError)

#: Libraries of graphics and windows, which are not to be loaded.
_MASKED = ("libGL", "libEGL", "libX11", "libOSMesa", "libwayland-client", "libvulkan")
#: Seconds on a machine that does other work, too.
_PATIENCE = 20.0


def test_a_process_answers_over_its_streams(tmp_path):
    from mcp.client.stdio import StdioServerParameters, stdio_client

    models(tmp_path)
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    command = ["-m", "engine3d", "mcp", "--root", str(tmp_path), "--allow-scripts"]
    server = StdioServerParameters(command=sys.executable, args=command, env=environment)
    maps = "def build():\n    print(open('/proc/self/maps').read()[-9:])\n"
    maps += "    assert not any(n in open('/proc/self/maps').read() for n in MASKED)\n"
    maps += (
        "    import engine3d, os\n    os.write(1, b'noise of a library')\n    return engine3d.box()"
    )

    async def talk():
        async with stdio_client(server) as streams, mcp.ClientSession(*streams) as session:
            await session.initialize()
            await session.call_tool("load", {"path": "three.e3d.json", "name": "three"})
            began = time.perf_counter()
            drawn = await session.call_tool("render", {})
            seconds = time.perf_counter() - began
            made = {"code": f"MASKED = {_MASKED}\n{maps}"}
            return drawn, await session.call_tool("script", made), seconds

    drawn, made, seconds = asyncio.run(talk())
    assert not drawn.is_error and not made.is_error, made.content
    assert seconds < _PATIENCE
    here = Agent(tmp_path)
    here.told("load", path="three.e3d.json", name="three")
    assert here.call("render").content[0].data == drawn.content[0].data


def test_standard_output_carries_only_the_protocol(tmp_path):
    models(tmp_path)
    (tmp_path / "warns.obj").write_text("mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    call = {"name": "load", "arguments": {"path": "warns.obj"}}
    client = {"name": "test", "version": "1"}
    hello = {"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": client}
    lines = [
        {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": hello},
        {"jsonrpc": "2.0", "method": "notifications/initialized"},
        {"jsonrpc": "2.0", "id": 2, "method": "tools/call", "params": call},
    ]
    command = [sys.executable, "-m", "engine3d", "mcp", "--root", str(tmp_path)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        process.stdin.write("".join(json.dumps(line) + "\n" for line in lines))
        process.stdin.flush()
        answers = [json.loads(process.stdout.readline()) for _ in range(2)]
        rest, _ = process.communicate(timeout=60)
    assert [one["id"] for one in answers] == [1, 2] and rest == ""
    assert answers[1]["result"]["structuredContent"]["warnings"]
    assert process.returncode == 0


def test_many_calls_do_not_grow(tmp_path):
    """Scenes of edits are dropped, and pictures of one scene make none."""
    models(tmp_path)
    session = Agent(tmp_path).session
    session.load("three.e3d.json", "three")

    def draw(count, step):
        for number in range(count):
            if step:
                session.edit("three/box", {"translate": [step, 0.0, 0.0]})
            request = Request(view={"azimuth": number}, size=[48, 32])
            session.last = session.studio.draw(session.things, request)
            session.last.at(24, 16)
        gc.collect()
        return sum(isinstance(one, Scene) for one in gc.get_objects())

    before = draw(6, 0.01)
    assert draw(6, 0.01) <= before
    assert draw(30, 0.0) <= before


def test_a_missing_package_is_named(monkeypatch, tmp_path, capsys):
    for name in [name for name in sys.modules if name.startswith("engine3d.apps.agents.")]:
        monkeypatch.delitem(sys.modules, name)
    for name in ("mcp", "mcp.server", "mcp.server.mcpserver"):
        monkeypatch.setitem(sys.modules, name, None)
    assert main(["mcp", "--root", str(tmp_path)]) == 1
    assert "pip install 'engine3d[mcp]'" in capsys.readouterr().err
