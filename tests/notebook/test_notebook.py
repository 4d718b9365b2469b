"""Views in notebooks: the mouse moves the picture; JPEGs while it moves, then a PNG."""

import asyncio
import base64
import io
import os

import numpy as np
import pytest
from PIL import Image

import engine3d
from engine3d import events

pytest.importorskip("jupyter_rfb", reason="needs jupyter_rfb: engine3d[notebook]")

from engine3d.notebook import View, _Page


class Browser:
    """The other end of a view: keeps what was sent, and says that it was shown."""

    def __init__(self, view, ratio=1.0):
        self.view = view
        self.pictures = []
        view.send = self.receive
        view._has_visible_views = True
        width, height = (float(css.removesuffix("px")) for css in (view.css_width, view.css_height))
        size = {"width": width, "height": height}
        physical = {"pwidth": width * ratio, "pheight": height * ratio, "ratio": ratio}
        self.tell("resize", **size, **physical)

    def receive(self, message, buffers):
        self.pictures.append((message["mimetype"], buffers[0]))
        shown = {"timestamp": message["timestamp"], "localtime": message["timestamp"]}
        self.view._frame_feedback = {"index": message["index"], **shown}

    def tell(self, kind, **values):
        event = {"type": kind, "timestamp": 0.0, "modifiers": (), **values}
        self.view._rfb_handle_msg(self.view, event, [])

    async def last_png(self):
        """Wait for the picture at rest and return it."""
        while not self.pictures or self.pictures[-1][0] != "image/png":
            await asyncio.sleep(0.01)
        return np.asarray(Image.open(io.BytesIO(self.pictures[-1][1])))


async def dragged():
    view = View(engine3d.torus(), size=(160, 100))
    browser = Browser(view)
    before = await browser.last_png()
    browser.pictures.clear()
    for kind, x in (
        ("pointer_down", 60),
        ("pointer_move", 75),
        ("pointer_move", 90),
        ("pointer_up", 90),
    ):
        browser.tell(kind, x=x, y=50, button=1, buttons=(1,))
        await asyncio.sleep(0.02)
    after = await browser.last_png()
    kinds = [kind for kind, _ in browser.pictures]
    view.close()
    view.close()
    return before, after, kinds


def test_a_drag_turns_the_scene_in_jpegs_and_ends_in_a_png():
    before, after, kinds = asyncio.run(dragged())
    assert before.shape == after.shape == (100, 160, 3)
    assert (before != after).any()
    assert kinds[0] == "image/jpeg"
    assert kinds[-1] == "image/png"


async def rested(scene, ratio=1.0, change=None):
    view = View(scene, size=(96, 64))
    browser = Browser(view, ratio)
    picture = await browser.last_png()
    if change is not None:
        change()
        browser.pictures.clear()
        view.update()
        picture = await browser.last_png()
    view.close()
    return picture


def test_pictures_have_the_pixels_of_the_screen():
    assert asyncio.run(rested(engine3d.box(), ratio=2.0)).shape == (128, 192, 3)


def test_a_change_of_the_scene_shows_after_update():
    scene = engine3d.Scene(background=(10, 20, 30))
    node = scene.add(engine3d.box())
    scene.add(engine3d.PerspectiveCamera(), pose=engine3d.look_at((0, 0, 4), (0, 0, 0)))
    before = asyncio.run(rested(scene))

    def hide():
        node.visible = False

    after = asyncio.run(rested(scene, change=hide))
    assert (before != (10, 20, 30)).any()
    assert (after != before).any()
    assert len(scene.nodes) == 2, "the view's own lights are left in the scene"


@pytest.mark.filterwarnings("error::pytest.PytestUnraisableExceptionWarning")
def test_what_cannot_be_shown_is_an_error():
    with pytest.raises(engine3d.InvalidArgumentError, match="scene, a node or a mesh, not int"):
        View(3)
    with pytest.raises(engine3d.InvalidArgumentError, match=r"quality must be .* in 1\.\.100"):
        View(engine3d.torus(), quality=300)
    with pytest.raises(engine3d.InvalidArgumentError, match="up must be one of"):
        View(engine3d.box(), up="north")
    with pytest.raises(engine3d.InvalidArgumentError, match="update must be a function of the"):
        View(engine3d.box(), update=3)


@pytest.mark.parametrize(
    ("event", "expected"),
    [
        ({"type": "key_down", "key": "w", "modifiers": ()}, [events.KeyDown("W", "W")]),
        (
            {"type": "key_down", "key": "ArrowLeft", "modifiers": ("Shift",)},
            [events.KeyDown("Left", "Left", shift=True)],
        ),
        ({"type": "key_up", "key": " "}, [events.KeyUp("Space", "Space")]),
        ({"type": "char", "data": "é"}, [events.TextEntered("é")]),
        ({"type": "wheel", "dy": -200, "x": 4, "y": 5}, [events.Wheel(2.0, 4, 5)]),
        ({"type": "pointer_leave"}, [events.MouseLeft()]),
        ({"type": "pointer_down", "button": 5, "x": 1, "y": 1, "modifiers": ()}, []),
        ({"type": "show"}, []),
        (
            {"type": "pointer_down", "button": 2, "x": 1, "y": 2, "modifiers": ("Control",)},
            [events.MouseButton("right", True, False, True, 1, 2)],
        ),
        (
            {"type": "key_down", "key": "o", "modifiers": ("Meta",)},
            [events.KeyDown("O", "O", False, True)],
        ),
        (
            {"type": "double_click", "x": 1, "y": 2},
            [events.MouseButton("left", down, x=1, y=2, clicks=2) for down in (True, False)],
        ),
    ],
    ids=lambda value: value["type"] if isinstance(value, dict) else "",
)
def test_what_browsers_tell(event, expected):
    assert _Page((40, 30)).translated(event) == expected


NOTEBOOK = (
    "import engine3d as e3d\nfrom engine3d.notebook import View\nview = View(e3d.torus())\nview",
    "frame = e3d.render(view._viewer.view_renderer.viewed.scene, size=(64, 48))\nframe",
    "e3d.Canvas((20, 10))",
    "scene = e3d.Scene()\nscene.add(e3d.box())\nscene",
    "e3d.uv_sphere()",
    "e3d.show(scene)",
)


def test_a_notebook_shows_views_frames_and_canvases(tmp_path, monkeypatch):
    nbformat = pytest.importorskip("nbformat", reason="needs nbformat")
    nbclient = pytest.importorskip("nbclient", reason="needs nbclient")
    pytest.importorskip("ipykernel", reason="needs ipykernel")
    for name in ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_RUNTIME_DIR"):
        monkeypatch.setenv(name, os.fspath(tmp_path / name))
    cells = [nbformat.v4.new_code_cell(source) for source in NOTEBOOK]
    book = nbformat.v4.new_notebook(cells=cells)
    monkeypatch.setenv("SDL_VIDEODRIVER", "x11")
    monkeypatch.delenv("DISPLAY", raising=False)
    nbclient.NotebookClient(book, timeout=600, kernel_name="python3", allow_errors=True).execute()
    shown = [
        set().union(*(output.get("data", {}) for output in cell.outputs)) for cell in book.cells
    ]
    assert "application/vnd.jupyter.widget-view+json" in shown[0]
    for data in shown[:5]:
        assert "image/png" in data
    picture = base64.b64decode(book.cells[0].outputs[-1]["data"]["image/png"])
    pixels = np.asarray(Image.open(io.BytesIO(picture)))
    assert pixels.shape[:2] == (400, 640) and len(np.unique(pixels.reshape(-1, 4), axis=0)) > 20
    assert "engine3d.notebook.View" in book.cells[5].outputs[0]["evalue"]
