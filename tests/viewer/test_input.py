"""SDL events become the viewer's own."""

import ctypes

import pytest

from engine3d import events
from engine3d.apps.viewer.input import Translator
from engine3d.apps.viewer.sdl import load_sdl

sdl2 = load_sdl()


def translate(event):
    return Translator().translate(event)


def key_event(kind, symbol, scancode, modifiers=0, repeat=0):
    event = sdl2.SDL_Event()
    event.type = kind
    event.key.keysym.sym = symbol
    event.key.keysym.scancode = scancode
    event.key.keysym.mod = modifiers
    event.key.repeat = repeat
    return event


def window_event(kind, width=0, height=0):
    event = sdl2.SDL_Event()
    event.type = sdl2.SDL_WINDOWEVENT
    event.window.event = kind
    event.window.data1, event.window.data2 = width, height
    return event


def test_a_key_has_a_letter_and_a_position():
    azerty_z = key_event(sdl2.SDL_KEYDOWN, sdl2.SDLK_z, sdl2.SDL_SCANCODE_W)
    assert translate(azerty_z) == events.KeyDown("Z", "W")


def test_a_key_has_modifiers_and_repeats():
    event = key_event(
        sdl2.SDL_KEYDOWN, sdl2.SDLK_w, sdl2.SDL_SCANCODE_W, sdl2.KMOD_LSHIFT | sdl2.KMOD_RCTRL, 1
    )
    assert translate(event) == events.KeyDown("W", "W", True, True, True)


@pytest.mark.parametrize(("system", "is_control"), [("darwin", True), ("linux", False)])
def test_cmd_counts_as_control_on_macos(monkeypatch, system, is_control):
    monkeypatch.setattr("sys.platform", system)
    translator = Translator()
    down = key_event(sdl2.SDL_KEYDOWN, sdl2.SDLK_o, sdl2.SDL_SCANCODE_O, sdl2.KMOD_LGUI)
    assert translator.translate(down) == events.KeyDown("O", "O", False, is_control)
    press = sdl2.SDL_Event()
    press.type = sdl2.SDL_MOUSEBUTTONDOWN
    press.button.button = sdl2.SDL_BUTTON_LEFT
    assert translator.translate(press).control == is_control
    down.key.keysym.mod = sdl2.KMOD_RCTRL
    assert translator.translate(down).control


def test_a_key_comes_up():
    event = key_event(sdl2.SDL_KEYUP, sdl2.SDLK_LEFT, sdl2.SDL_SCANCODE_LEFT)
    assert translate(event) == events.KeyUp("Left", "Left")


@pytest.mark.parametrize(
    ("symbol", "name"),
    [
        (sdl2.SDLK_RETURN, "Return"),
        (sdl2.SDLK_TAB, "Tab"),
        (sdl2.SDLK_SPACE, "Space"),
        (sdl2.SDLK_F12, "F12"),
        (sdl2.SDLK_ESCAPE, "Escape"),
        (sdl2.SDLK_KP_7, "Keypad 7"),
        (sdl2.SDLK_MINUS, "-"),
    ],
)
def test_keys_bear_the_names_of_the_keymap(symbol, name):
    event = key_event(sdl2.SDL_KEYDOWN, symbol, 0)
    assert translate(event).key == name


def test_a_click_has_the_modifiers_of_its_own_time():
    """Shift is let go again before all of this is looked at."""
    click = sdl2.SDL_Event()
    click.type, click.button.button = sdl2.SDL_MOUSEBUTTONDOWN, sdl2.SDL_BUTTON_LEFT
    shift = sdl2.SDLK_LSHIFT, sdl2.SDL_SCANCODE_LSHIFT
    control = sdl2.SDLK_RCTRL, sdl2.SDL_SCANCODE_RCTRL
    queue = [
        click,
        key_event(sdl2.SDL_KEYDOWN, *shift, sdl2.KMOD_LSHIFT),
        click,
        key_event(sdl2.SDL_KEYDOWN, *control, sdl2.KMOD_LSHIFT | sdl2.KMOD_RCTRL),
        click,
        key_event(sdl2.SDL_KEYUP, *shift, sdl2.KMOD_RCTRL),
        click,
        key_event(sdl2.SDL_KEYUP, *control),
        click,
    ]
    translator = Translator()
    received = [translator.translate(event) for event in queue]
    clicks = [event for event in received if isinstance(event, events.MouseButton)]
    held = [(event.shift, event.control) for event in clicks]
    assert held == [(False, False), (True, False), (True, True), (False, True), (False, False)]


def test_mouse_events():
    event = sdl2.SDL_Event()
    event.type = sdl2.SDL_MOUSEBUTTONDOWN
    event.button.button = sdl2.SDL_BUTTON_MIDDLE
    assert translate(event) == events.MouseButton("middle", True)
    event.button.button = 9
    assert translate(event) is None
    event = sdl2.SDL_Event()
    event.type = sdl2.SDL_MOUSEMOTION
    event.motion.xrel, event.motion.yrel = 3, -4
    event.motion.x, event.motion.y = 40, 30
    assert translate(event) == events.MouseMotion(3, -4, 40, 30)
    halved = Translator(lambda x, y: (x // 2, y // 2)).translate(event)
    assert halved == events.MouseMotion(3, -4, 20, 15)
    event = sdl2.SDL_Event()
    event.type = sdl2.SDL_MOUSEWHEEL
    event.wheel.y = 2
    assert translate(event) == events.Wheel(2)
    event.wheel.direction = sdl2.SDL_MOUSEWHEEL_FLIPPED
    assert translate(event) == events.Wheel(-2)


def test_window_events():
    resized = window_event(sdl2.SDL_WINDOWEVENT_SIZE_CHANGED, 300, 200)
    assert translate(resized) == events.Resized(300, 200)
    for kind, expected in [
        (sdl2.SDL_WINDOWEVENT_EXPOSED, events.Exposed),
        (sdl2.SDL_WINDOWEVENT_MINIMIZED, events.Minimised),
        (sdl2.SDL_WINDOWEVENT_RESTORED, events.Restored),
        (sdl2.SDL_WINDOWEVENT_FOCUS_LOST, events.FocusLost),
        (sdl2.SDL_WINDOWEVENT_CLOSE, events.CloseRequested),
    ]:
        assert isinstance(translate(window_event(kind)), expected)
    assert translate(window_event(sdl2.SDL_WINDOWEVENT_MOVED)) is None


def drop_event(kind, name=None):
    event = sdl2.SDL_Event()
    event.type = kind
    if name is not None:
        sdl2.SDL_malloc.restype = ctypes.c_void_p
        memory = sdl2.SDL_malloc(len(name) + 1)
        ctypes.memmove(memory, name + b"\0", len(name) + 1)
        event.drop.file = ctypes.cast(memory, ctypes.c_char_p)
    return event


def test_a_text_comes_as_it_was_entered():
    event = sdl2.SDL_Event()
    event.type = sdl2.SDL_TEXTINPUT
    event.text.text = "é語".encode()
    assert Translator().translate(event) == events.TextEntered("é語")


def test_files_that_are_dropped_together_are_one_event():
    translator = Translator()
    for names in (("/tmp/päth.obj",), ("/a.stl", "/b.stl", "/c.ply")):
        for name in names:
            event = drop_event(sdl2.SDL_DROPFILE, name.encode())
            assert translator.translate(event) is None
        complete = drop_event(sdl2.SDL_DROPCOMPLETE)
        assert translator.translate(complete) == events.FilesDropped(names)
    assert translator.translate(drop_event(sdl2.SDL_DROPCOMPLETE)) is None


def test_other_events_mean_nothing():
    event = sdl2.SDL_Event()
    event.type = sdl2.SDL_USEREVENT
    assert translate(event) is None
