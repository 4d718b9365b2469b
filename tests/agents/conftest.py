"""A client in the same process as its server, over a folder with models."""

import asyncio
import base64
import io
import warnings

import pytest
from PIL import Image

import engine3d as e3d

try:
    import mcp
except ImportError:
    mcp = None


def pytest_collect_file():
    if mcp is None:
        pytest.skip("needs engine3d[mcp]")


class Agent:
    """Calls tools as a client does, each call in a session of its own with the same server."""

    def __init__(self, root, **limits):
        from engine3d.apps.agents.server import server_for
        from engine3d.apps.agents.server_limits import Limits
        from engine3d.apps.agents.session import Session

        self.root = root
        self.session = Session(Limits(root=str(root), **limits))
        self.server = server_for(self.session)

    def ask(self, request):
        """Return what a function of a client awaits."""

        async def asked():
            async with mcp.Client(self.server) as client:
                return await request(client)

        return asyncio.run(asked())

    def call(self, tool, **arguments):
        return self.ask(lambda client: client.call_tool(tool, arguments))

    def told(self, tool, **arguments):
        """Return a tool's record."""
        result = self.call(tool, **arguments)
        assert not result.is_error, result.content[0].text
        return result.structured_content

    def picture(self, tool, **arguments):
        """Return a tool's picture and record."""
        result = self.call(tool, **arguments)
        assert not result.is_error, result.content[0].text
        content = result.content[0]
        image = Image.open(io.BytesIO(base64.b64decode(content.data)))
        assert content.mime_type == f"image/{image.format.lower()}"
        return image, result.structured_content

    def error(self, tool, **arguments):
        """Return the message of a tool's error."""
        result = self.call(tool, **arguments)
        assert result.is_error and result.structured_content is None
        return result.content[0].text


def models(folder):
    """Write three things in a file, and a part alone."""
    scene = e3d.Scene()
    scene.add(e3d.box(), name="box")
    scene.add(e3d.icosphere(0.6), name="ball", translation=(1.5, 0.3, 0))
    scene.add(e3d.torus(), name="ring", translation=(0, 1.4, 0))
    e3d.save_scene(scene, folder / "three.e3d.json")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", e3d.Engine3DWarning)  # of what STL does not hold
        e3d.save_mesh(e3d.box((1, 2, 3)), folder / "block.stl")


@pytest.fixture
def agent(tmp_path):
    models(tmp_path)
    return Agent(tmp_path)


@pytest.fixture
def loaded(agent):
    agent.told("load", path="three.e3d.json", name="three")
    return agent
