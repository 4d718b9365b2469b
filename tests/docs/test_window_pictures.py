"""Real windows of the programs show, byte for byte, what was recorded of them on three screens."""

import pytest
from desktop import MARKS, Desktop, until, virtual_screen
from own_scripts import importable
from PIL import Image

with importable("docs/pictures"):
    import screens

pytestmark = MARKS
# Messages pass at once. The editor opens in its size, as columns remember another one, and tells
# neither how fast it draws nor the folders of here.
COMMAND = """
import sys
from engine3d.apps.viewer import messages
messages.MESSAGE_SECONDS, messages.READ_A_SECOND = 0.05, 1e9
if sys.argv[1] == "edit":
    from engine3d.apps.editor.ui.scene_panel import ScenePanel
    from engine3d.apps.editor.ui.console_panel import ConsolePanel
    from engine3d.apps.viewer.program_window import ProgramWindow
    ScenePanel._draw_times = lambda panel, corner: None
    ConsolePanel._draw_log = lambda panel: None
    ProgramWindow.fit_to_screen = lambda window: None
from engine3d.start import main
sys.exit(main())
"""


@pytest.fixture(scope="module", params=screens.SCREENS, ids=str)
def screen(request):
    width, height, dpi = request.param
    with virtual_screen(width, height, "-dpi", str(dpi)) as screen:
        yield request.param, screen


def fill_screen(desktop):
    """Let the window fill its screen, and keep the mouse from what lights up below it."""
    size = desktop.screen.size
    desktop.do("windowmove", desktop.window, 0, 0, "windowsize", desktop.window, *size)
    desktop.do("mousemove", *(side - 1 for side in size))
    place = "X=0", "Y=0", f"WIDTH={size[0]}", f"HEIGHT={size[1]}"
    shell = "getwindowgeometry", "--shell", desktop.window
    until(lambda: set(place) <= set(desktop.do(*shell).split()))


@pytest.mark.parametrize("program", screens.PROGRAMS)
def test_a_real_window_shows_what_was_recorded(program, screen, tmp_path):
    reason = screens.why_not(program)
    if reason:
        pytest.skip(reason)
    kind, virtual = screen
    homes = {name: str(tmp_path) for name in ("XDG_STATE_HOME", "XDG_CACHE_HOME")}
    command = ["-c", COMMAND, *screens.PROGRAMS[program].command(kind)]
    with Desktop(virtual, screens.MODELS, command, **homes) as desktop:
        fill_screen(desktop)
        shown = desktop.settle()
    name = screens.window_name(program, kind)
    path = tmp_path / "shown.png"
    Image.fromarray(shown).save(path)
    again = "python docs/pictures/screens.py draws and records them again"
    assert screens.DIGESTS.knows(name, shown), f"{name}: see {path}; {again}"
