"""What stands beside the picture: the bar, the time line, the statistics; and the ball of axes."""

import numpy as np
import pytest
from viewer.scripted_window import ScriptedWindow
from viewer.test_viewer import key, make_viewed_scene

from engine3d import events
from engine3d.apps.viewer.controls.window_layout import LEAST_SIZE, lay_out
from engine3d.apps.viewer.help_panel import CommandPanel
from engine3d.apps.viewer.keymap import BINDINGS, SECTIONS
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.overlays.axes_ball import tips
from engine3d.stage.overlays.theme import DARK, LIGHT
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer

SIZE = (900, 600)


def make_viewer(viewed=None, size=SIZE, **settings):
    view_renderer = ViewRenderer(viewed or make_viewed_scene(), Settings({}, **settings), size)
    viewer = Viewer(view_renderer, ScriptedWindow(size=size))
    viewer.controls.shown = True
    viewer.draw()
    return viewer


def moving(**options):
    times = []
    viewed = make_viewed_scene(update=times.append, period=4.0, **options)
    return make_viewer(viewed), times


def press(viewer, x, y, button="left", **modifiers):
    viewer.handle(events.MouseButton(button, True, x=int(x), y=int(y), **modifiers))


def let_go(viewer, x, y, button="left"):
    viewer.handle(events.MouseButton(button, False, x=int(x), y=int(y)))


def click(viewer, x, y, button="left", **modifiers):
    press(viewer, x, y, button, **modifiers)
    let_go(viewer, x, y, button)


def button(viewer, text):
    """The middle of a button of the bar."""
    found = next(one for one in viewer.controls.buttons if one.text == text)
    return found.left + found.width // 2, viewer.controls.layout.bar.height // 2


def part(viewer, name):
    """The middle of a part of the time line."""
    line, strip = viewer.controls._time_line, viewer.controls.layout.time
    return sum(line.parts()[name]) // 2, strip.top + strip.height // 2


def tip(viewer, name):
    ball, picture = viewer.controls._ball, viewer.controls.layout.picture
    found = next(one for one in tips(viewer.view.rotation(), ball) if one.name == name)
    return picture.left + round(found.x), picture.top + round(found.y)


@pytest.mark.parametrize("strips", [{}, {"bar": 26}, {"bar": 26, "time": 26, "side": 300}])
def test_the_parts_of_a_window_cover_it_once(strips):
    layout = lay_out((900, 600), **strips)
    counts = np.zeros((600, 900), int)
    for rectangle in layout[1:]:
        if rectangle is not None:
            rectangle.of(counts)[...] += 1
    assert (counts == 1).all() and sum(one is not None for one in layout[1:]) == 1 + len(strips)


def test_nothing_lies_over_the_picture_but_the_ball_in_its_corner():
    viewer = make_viewer()
    picture, ball = viewer.controls.layout.picture, viewer.controls._ball
    shown = picture.of(viewer.window.shown[-1])
    assert shown.shape == viewer.frame.color.shape
    rows, columns = np.nonzero((shown != viewer.frame.color).any(axis=2))
    assert np.hypot(columns + 0.5 - ball.x, rows + 0.5 - ball.y).max() <= ball.radius + 1
    assert ball.x > picture.width - 60 and ball.y < 60


@pytest.mark.parametrize(("size", "has_bar"), [(LEAST_SIZE, True), ((559, 400), False)])
def test_small_windows_show_the_picture_alone(size, has_bar):
    viewer = make_viewer(size=size)
    assert (viewer.controls.layout.bar is not None) == has_bar
    if not has_bar:
        assert np.array_equal(viewer.window.shown[-1], viewer.frame.color)


def test_a_key_hides_and_shows_the_controls():
    viewer = make_viewer()
    viewer.handle(key("F10"))
    viewer.messages.said = ""
    viewer.draw()
    assert np.array_equal(viewer.window.shown[-1], viewer.frame.color)
    viewer.handle(key("F10"))
    viewer.draw()
    assert viewer.controls.layout.bar is not None


def test_the_bar_has_a_menu_of_each_theme_and_its_buttons():
    viewer = make_viewer()
    texts = [one.text for one in viewer.controls.buttons]
    wanted = [one.button for one in BINDINGS if one.button]
    assert sorted(texts) == sorted([*SECTIONS, *wanted]) and texts[-1] == "Help"
    narrow = make_viewer(size=(600, 420))
    buttons = narrow.controls.buttons
    assert len(buttons) < len(texts) and buttons[-1].text == "Help"
    ends = [one.left + one.width for one in buttons]
    assert all(end <= one.left for end, one in zip(ends, buttons[1:], strict=False))
    assert ends[-1] == 600


def test_buttons_do_what_they_say_and_are_lit_when_it_is_on():
    viewer = make_viewer()
    strip = viewer.controls.layout.bar
    before = strip.of(viewer.window.shown[-1]).copy()
    click(viewer, *button(viewer, "Wireframe"))
    assert viewer.view_renderer.appearance.wireframe == "overlay"
    viewer.controls.leave()
    viewer.draw()
    lit = (strip.of(viewer.window.shown[-1])[..., :3] == DARK.title[:3]).all(axis=2)
    assert lit.any() and not (before[..., :3] == DARK.title[:3]).all(axis=2).any()
    click(viewer, *button(viewer, "Wireframe"), "right")
    assert viewer.view_renderer.appearance.wireframe is None
    click(viewer, *button(viewer, "Help"))
    assert isinstance(viewer.panel, CommandPanel) and not viewer.panel.section


def test_menus_open_below_their_button_and_close_beside_it():
    viewer = make_viewer()
    click(viewer, *button(viewer, "View"))
    viewer.draw()
    left, top, width, height = viewer.panel._box
    assert [row.text for row in viewer.panel.rows()] == [one.help for one in SECTIONS["View"]]
    assert top == 0 and left <= button(viewer, "View")[0] < left + width
    picture = viewer.controls.layout.picture
    row = next(n for n, one in enumerate(SECTIONS["View"]) if one.action == "toggle_orthographic")
    y = picture.top + 8 + int((row + 0.5) * viewer.panel._row_height)
    click(viewer, left + 20, y)
    assert viewer.view.orthographic and viewer.panel is not None
    azimuth = viewer.view.azimuth
    press(viewer, left + width + 200, picture.top + height + 40)
    viewer.handle(events.MouseMotion(60, 0, left + width + 260, picture.top + height + 40))
    assert viewer.panel is None and viewer.view.azimuth == azimuth
    click(viewer, *button(viewer, "View"))
    click(viewer, *button(viewer, "View"))
    assert viewer.panel is None


def test_an_open_menu_follows_the_mouse_along_the_bar():
    viewer = make_viewer()
    viewer.handle(events.MouseMotion(1, 0, *button(viewer, "Files")))
    assert viewer.panel is None
    click(viewer, *button(viewer, "View"))
    viewer.handle(events.MouseMotion(1, 0, *button(viewer, "Files")))
    assert viewer.panel.section == "Files"
    viewer.handle(events.MouseMotion(1, 0, *button(viewer, "Picture")))
    assert viewer.panel.section == "Files"


def test_the_mouse_over_the_bar_draws_no_frame():
    viewer = make_viewer()
    frame = viewer.frame
    here, there = (button(viewer, text) for text in ("View", "Wireframe"))
    viewer.window._script = [
        [events.MouseMotion(1, 1, *here)],
        [],
        [events.MouseMotion(1, 1, *there)],
    ]
    for _ in range(3):
        viewer.run_once()
    assert viewer.frame is frame and len(viewer.window.shown) == 3
    assert (viewer.window.shown[1] != viewer.window.shown[2]).any()


def test_clicks_and_drags_in_the_picture_are_where_the_picture_is():
    viewer = make_viewer()
    picture = viewer.controls.layout.picture
    viewer.draw()
    color = viewer.frame.color[..., :3]
    rows, columns = np.nonzero((color != (10, 20, 30)).any(axis=2))
    click(viewer, columns[-1], rows[-1] + picture.top)
    assert viewer.selected is not None
    click(viewer, columns[-1], rows[-1] + 2 * picture.top)  # that far below, nothing shows
    assert viewer.selected is None
    azimuth = viewer.view.azimuth
    press(viewer, 450, 300)
    viewer.handle(events.MouseMotion(80, 0, 530, 300))
    let_go(viewer, 530, 300)
    assert viewer.view.azimuth < azimuth


def test_the_wheel_over_the_bar_does_nothing():
    viewer = make_viewer()
    distance = viewer.view.distance
    viewer.handle(events.Wheel(2, 100, 5))
    assert viewer.view.distance == distance
    viewer.handle(events.Wheel(2, 100, 200))
    assert viewer.view.distance < distance


@pytest.mark.parametrize(("name", "back"), [("+Y", (0, 1, 0)), ("-X", (-1, 0, 0))])
def test_a_click_on_the_ball_looks_along_an_axis(name, back):
    viewer = make_viewer()
    click(viewer, *tip(viewer, name))
    np.testing.assert_allclose(viewer.view.rotation()[:, 2], back, atol=1e-12)
    assert viewer.selected is None


def test_a_drag_of_the_ball_orbits():
    viewer = make_viewer()
    x, y = tip(viewer, "+Z")
    before = viewer.view.copy()
    press(viewer, x, y)
    for step in range(1, 11):
        viewer.handle(events.MouseMotion(6, 0, x + 6 * step, y))
    let_go(viewer, x + 60, y)
    assert viewer.view.azimuth < before.azimuth and viewer.view.elevation == before.elevation
    assert viewer.mouse.drag is None
    turned = viewer.view.azimuth
    viewer.handle(events.MouseMotion(50, 0, 300, 300))
    assert viewer.view.azimuth == turned


def test_the_ball_gives_way_to_texts():
    viewer = make_viewer(metadata=True)
    height = viewer.controls.layout.picture.height
    assert viewer.controls._ball.y > height - 60
    rows, columns = np.nonzero((viewer.frame.color[..., :3] != (10, 20, 30)).any(axis=2))
    viewer.select(int(columns[-1]), int(rows[-1]))
    assert viewer.selected is not None and viewer.controls._ball.y == height / 2
    listing = make_viewer()
    listing.handle(key("O"))
    assert listing.controls._ball.y > height - 60
    viewer.handle(key("S"))
    assert viewer.controls._ball is None


def test_only_what_moves_by_itself_has_a_time_line():
    assert make_viewer().controls.layout.time is None
    viewer, _ = moving()
    assert viewer.controls.layout.time is not None


def test_the_time_line_plays_drags_and_changes_speed():
    viewer, _ = moving()
    click(viewer, *part(viewer, "play"))
    assert viewer.playing
    x, y = part(viewer, "track")
    press(viewer, x, y)
    assert viewer.time == pytest.approx(2.0, abs=0.05)
    viewer.advance(0.1)
    assert viewer.time == pytest.approx(2.0, abs=0.05)  # the mouse holds it
    viewer.handle(events.MouseMotion(5000, 0, x + 5000, y - 300))
    assert 3.99 < viewer.time < 4.0
    viewer.handle(events.MouseMotion(-9000, 0, x - 9000, y))
    let_go(viewer, x - 9000, y)
    assert viewer.time == 0.0
    click(viewer, *part(viewer, "faster"))
    viewer.advance(0.1)
    assert viewer.time == pytest.approx(0.2)
    for _ in range(2):
        click(viewer, *part(viewer, "slower"))
    viewer.advance(0.1)
    assert viewer.time == pytest.approx(0.25)


def test_keys_move_the_time_and_change_the_speed():
    viewer, _ = moving()
    viewer.handle(key("Right", control=True))
    viewer.handle(key("Right", control=True, repeat=True))
    assert viewer.time == pytest.approx(4 / 25)
    viewer.handle(key("Left", control=True))
    assert viewer.time == pytest.approx(4 / 50)
    for _ in range(9):
        viewer.handle(key("Up", control=True))
    assert viewer.speed == 4.0
    for _ in range(9):
        viewer.handle(key("Down", control=True))
    assert viewer.speed == 0.1
    still = make_viewer()
    still.handle(key("Right", control=True))
    assert still.time == 0.0 and "nothing moves" in still.messages.said


def test_the_time_line_shows_how_far_the_animation_is():
    viewer, _ = moving()
    ends = []
    for time in (0.5, 2.0, 3.5):
        viewer.time = time
        viewer.draw()
        strip = viewer.controls.layout.time.of(viewer.window.shown[-1])[..., :3]
        columns = np.flatnonzero((strip == DARK.title[:3]).all(axis=2).any(axis=0))
        ends.append(int(columns.max()))
    steps = np.diff(ends)
    assert steps[0] > 100 and steps[0] == pytest.approx(steps[1], abs=2)


def test_statistics_stand_beside_the_picture_where_there_is_room():
    viewer = make_viewer(size=(1300, 500))
    width = viewer.controls.layout.picture.width
    viewer.handle(key("Z"))
    viewer.draw()
    assert viewer.controls.holds_line and viewer.controls.layout.picture.width == width
    viewer.handle(key("Z"))
    viewer.messages.said = ""
    viewer.draw()
    side = viewer.controls.layout.side
    assert side is not None and viewer.frame.color.shape[1] == side.left < width
    text = (side.of(viewer.window.shown[-1])[..., :3] != DARK.block[:3]).any(axis=2)
    assert text.sum() > 1000
    small = make_viewer(size=(600, 450))
    small.statistics = "long"
    small.draw()
    assert small.controls.layout.side is None


def test_strips_wear_the_theme():
    viewer = make_viewer()
    for theme in (DARK, LIGHT):
        viewer.view_renderer.staging.theme = theme
        viewer.draw()
        strip = viewer.controls.layout.bar.of(viewer.window.shown[-1])[..., :3]
        assert (strip == theme.block[:3]).all(axis=2).mean() > 0.5


def test_walking_leaves_the_mouse_to_the_walker():
    viewer = make_viewer()
    viewer.handle(key("Tab"))
    viewer.draw()
    assert viewer.controls._ball is None
    click(viewer, *button(viewer, "Wireframe"))
    assert viewer.view_renderer.appearance.wireframe is None
