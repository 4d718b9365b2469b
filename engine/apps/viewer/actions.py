"""The actions of keys, one function each; `keymap` binds keys to them.

Every function takes the `Viewer` and a step: 1, or -1 with Shift, for actions that cycle through
choices.
"""

from __future__ import annotations

import math
from pathlib import Path

from ...base.language import translated, translated_choice
from ...io.output.animation_files import numbered_path
from ...stage.appearance import CHOICES, following
from ...stage.overlays.debug_lines import DEBUG_DRAWINGS
from ...stage.overlays.theme import THEMES
from ...stage.played_clips import play_clips
from ...stage.views.viewpoint import QUARTER_TURN, UP_DIRECTIONS
from .file_dialog import FolderPanel, RecentPanel
from .help_panel import CommandPanel
from .list_panels import MaterialPanel, ObjectPanel
from .recording import record
from .sampling import AT_REST, MOTION_FPS
from .tools.explosion_panel import ExplosionPanel
from .tools.measuring_panel import MeasuringPanel
from .tools.pointing_panel import PointingPanel
from .tools.section_panel import SectionPanel

SAMPLES = (1, 4, 16)  # available with both supersampling and multisampling
STATISTICS = (None, "short", "long")
LINE_WIDTHS = (1.0, 16.0)
#: Speeds of the animation, and the share of it by which keys move its time.
SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)
TIME_SHARE = 1 / 50
#: The angle by which a key turns the camera.
ORBIT_STEP = math.radians(7.5)
#: How far a key moves the camera, in heights of the picture.
PAN_STEP = 1 / 20
#: What each culling method omits.
LEFT_OUT = {
    "all": "what is outside the view, faces away or is hidden is left out",
    "tree": "nodes outside the view are left out, found by a tree of boxes",
    "frustum": "nodes outside the view are left out, their boxes tested one by one",
    "none": "nothing is left out",
    "always": "as all, but hidden things are looked for in every frame",
}
ISOMETRIC_ELEVATION = math.atan(1 / math.sqrt(2))


def _cycling(option: str):
    """Return an action that sets an option to its next value."""

    def cycle(viewer, step: int) -> None:
        appearance = viewer.view_renderer.appearance
        value = following(getattr(appearance, option), CHOICES[option], step)
        setattr(appearance, option, value)
        viewer.say(
            "{what}: {detail}",
            what=translated(option.replace("_", " ")),
            detail=translated_choice(option, value or "off"),
        )

    return cycle


cycle_wireframe = _cycling("wireframe")
cycle_mode = _cycling("mode")
cycle_cull = _cycling("cull")
cycle_hidden_surfaces = _cycling("hidden_surfaces")
cycle_tone_mapping = _cycling("tone_mapping")


def toggle_edges(viewer, step: int) -> None:
    """Toggle the wireframe over the faces."""
    appearance = viewer.view_renderer.appearance
    appearance.wireframe = None if appearance.wireframe == "overlay" else "overlay"
    viewer.say("edges: on" if appearance.wireframe else "edges: off")


def _toggle_mode(viewer, mode: str) -> None:
    appearance = viewer.view_renderer.appearance
    appearance.mode = "lit" if appearance.mode == mode else mode
    viewer.say("mode: {mode}", mode=translated_choice("mode", appearance.mode))


def toggle_normals_mode(viewer, step: int) -> None:
    """Toggle between normals as colours and lit surfaces."""
    _toggle_mode(viewer, "normal")


def toggle_unlit(viewer, step: int) -> None:
    """Toggle between unlit and lit surfaces."""
    _toggle_mode(viewer, "unlit")


def toggle_flat(viewer, step: int) -> None:
    """Cycle through face normals, facet lighting, and smooth normals."""
    appearance = viewer.view_renderer.appearance
    following = {"flat": "facet", "facet": "smooth"}
    appearance.normals = following.get(appearance.normals, "flat")
    viewer.say("normals: {value}", value=translated_choice("normals", appearance.normals))


def cycle_lights(viewer, step: int) -> None:
    """Switch to the next lighting."""
    lighting = viewer.view_renderer.lighting
    lighting.choose(following(lighting.name, lighting.names, step))
    viewer.say("lights: {name}", name=translated_choice("lights", lighting.name))


def cycle_samples(viewer, step: int) -> None:
    """Switch to the next number of samples per pixel: automatic, or a fixed one."""
    viewer.sampling.fixed = following(viewer.sampling.fixed, (None, *SAMPLES), step)
    if viewer.sampling.fixed:
        viewer.say("samples per pixel: {count}", count=viewer.sampling.fixed)
        return
    viewer.say(
        "samples per pixel: {count}, or fewer to keep {fps:.0f} fps in motion",
        count=AT_REST,
        fps=MOTION_FPS,
    )


def _scale_lines(viewer, factor: float) -> None:
    appearance = viewer.view_renderer.appearance
    low, high = LINE_WIDTHS
    appearance.line_width = min(high, max(low, appearance.line_width * factor))
    appearance.point_size = min(high, max(low, viewer.view_renderer.point_size * factor))
    viewer.say(
        "line width: {width:g}, point size: {size:g}",
        width=appearance.line_width,
        size=appearance.point_size,
    )


def widen_lines(viewer, step: int) -> None:
    """Increase the width of lines and the size of points."""
    _scale_lines(viewer, 2.0)


def narrow_lines(viewer, step: int) -> None:
    """Decrease the width of lines and the size of points."""
    _scale_lines(viewer, 0.5)


def _looking(azimuth: float, elevation: float):
    """Return an action that looks along a direction."""

    def look(viewer, step: int) -> None:
        if viewer.walker is not None:
            viewer.toggle_walking()
        viewer.view.azimuth, viewer.view.elevation = azimuth, elevation
        viewer.view_renderer.frame(viewer.view)

    return look


view_front = _looking(0.0, 0.0)
view_right = _looking(QUARTER_TURN, 0.0)
view_top = _looking(0.0, QUARTER_TURN)
view_isometric = _looking(QUARTER_TURN / 2, ISOMETRIC_ELEVATION)


def _turning(right: float, up: float):
    """Return an action that rotates the camera about its target by two angles."""

    def turn(viewer, step: int) -> None:
        if viewer.walker is None:
            viewer.orbit.turn(right, up)

    return turn


quarter_left, quarter_right = _turning(-QUARTER_TURN, 0.0), _turning(QUARTER_TURN, 0.0)
quarter_down, quarter_up = _turning(0.0, -QUARTER_TURN), _turning(0.0, QUARTER_TURN)
orbit_left, orbit_right = _turning(-ORBIT_STEP, 0.0), _turning(ORBIT_STEP, 0.0)
orbit_down, orbit_up = _turning(0.0, -ORBIT_STEP), _turning(0.0, ORBIT_STEP)


def zoom_in(viewer, step: int) -> None:
    """Approach what the camera looks at, as by a step of the wheel."""
    if viewer.walker is None:
        viewer.orbit.dolly(1.0)


def zoom_out(viewer, step: int) -> None:
    """Recede from what the camera looks at, as by a step of the wheel."""
    if viewer.walker is None:
        viewer.orbit.dolly(-1.0)


def _panning(right: float, up: float):
    """Return an action that moves the camera by heights of the picture."""

    def pan(viewer, step: int) -> None:
        if viewer.walker is None:
            viewer.orbit.pan(-right, up, 1)

    return pan


pan_left, pan_right = _panning(-PAN_STEP, 0.0), _panning(PAN_STEP, 0.0)
pan_down, pan_up = _panning(0.0, -PAN_STEP), _panning(0.0, PAN_STEP)


def _turning_light(right: float, down: float):
    """Return an action that turns the lights, as a drag does, by angles."""

    def turn(viewer, step: int) -> None:
        a_turn = viewer.view_renderer.size[1] / math.tau
        viewer.turn_light(right * a_turn, down * a_turn)

    return turn


light_left, light_right = _turning_light(-ORBIT_STEP, 0.0), _turning_light(ORBIT_STEP, 0.0)
light_up, light_down = _turning_light(0.0, -ORBIT_STEP), _turning_light(0.0, ORBIT_STEP)


def _turn_up(viewer, up: str) -> None:
    if viewer.walker is not None:
        viewer.toggle_walking()
    viewer.view_renderer.turn_up(up)
    for view in (viewer.view, viewer.first_view):
        view.up = UP_DIRECTIONS[up]
        viewer.view_renderer.frame(view)
    viewer.say("{axis} is up", axis=up)


def turn_y_up(viewer, step: int) -> None:
    """Make +Y the up direction, or -Y with Shift."""
    _turn_up(viewer, "+Y" if step > 0 else "-Y")


def turn_z_up(viewer, step: int) -> None:
    """Make +Z the up direction, or -Z with Shift."""
    _turn_up(viewer, "+Z" if step > 0 else "-Z")


def toggle_orthographic(viewer, step: int) -> None:
    """Toggle between parallel and perspective projection."""
    viewer.view.orthographic = not viewer.view.orthographic
    viewer.say("orthographic" if viewer.view.orthographic else "perspective")


def reset_view(viewer, step: int) -> None:
    """Return to the first view."""
    viewer.reset_view()


def toggle_walking(viewer, step: int) -> None:
    """Toggle walking; the picture stays, or moves down to the ground."""
    viewer.toggle_walking()


def toggle_occlusion(viewer, step: int) -> None:
    """Toggle ambient occlusion."""
    appearance = viewer.view_renderer.appearance
    appearance.ambient_occlusion = not appearance.ambient_occlusion
    on = appearance.ambient_occlusion
    viewer.say("ambient occlusion: on" if on else "ambient occlusion: off")


def toggle_split(viewer, step: int) -> None:
    """Toggle between nine outputs side by side and the picture alone."""
    viewer.view_renderer.split = not viewer.view_renderer.split


def cycle_debug(viewer, step: int) -> None:
    """Switch to the next debug drawing of culling: boxes, their trees, the frustum, or none."""
    drawing = following(viewer.view_renderer.culling.drawing, DEBUG_DRAWINGS, step)
    viewer.view_renderer.choose_debug(drawing, viewer.view)
    viewer.say("also drawn: {what}", what=translated_choice("drawing", drawing or "nothing"))


def toggle_textures(viewer, step: int) -> None:
    """Toggle textures; without them, materials show only their colours."""
    view_renderer = viewer.view_renderer
    view_renderer.staging.show_textures(not view_renderer.settings.textures)
    viewer.say("textures: on" if view_renderer.settings.textures else "textures: off")


def cycle_culling(viewer, step: int) -> None:
    """Switch to the next culling method; the picture is the same."""
    appearance = viewer.view_renderer.appearance
    appearance.culling = following(appearance.culling, CHOICES["culling"], step)
    viewer.say(
        "culling {method}: {effect}",
        method=translated_choice("culling", appearance.culling),
        effect=translated(LEFT_OUT[appearance.culling]),
    )


def freeze_culling(viewer, step: int) -> None:
    """Freeze culling at this view, and the counters, until the key is released; or end that."""
    is_frozen = viewer.view_renderer.culling.camera is not None
    viewer.view_renderer.freeze_culling(None if is_frozen else viewer.view)
    viewer.say(
        "culling and counting for each view"
        if is_frozen
        else "culling and counting as from here, while C is held"
    )


def toggle_playing(viewer, step: int) -> None:
    """Pause or resume the animation."""
    viewer.playing = not viewer.playing
    viewer.say("playing" if viewer.playing else "paused")


def cycle_animations(viewer, step: int) -> None:
    """Play the model's next animation, or all of them together."""
    viewed = viewer.view_renderer.viewed
    if viewed.player is None:
        viewer.say("the model has no animations")
        return
    clips = viewed.player.clips
    numbers = (*range(len(clips)), -1) if len(clips) > 1 else (0,)
    playing = viewed.player.playing
    now = clips.index(playing[0]) if len(playing) == 1 else -1
    chosen = following(now, numbers, step)
    play_clips(viewed, chosen)
    viewer.time = 0.0
    if chosen < 0:
        viewer.say("all animations")
        return
    name = list(viewed.scene.animations)[chosen]
    viewer.say("animation {number}: {name}", number=chosen, name=name)


def _moving(step_sign: int):
    """Return an action that moves the time of an animation."""

    def move(viewer, step: int) -> None:
        viewed = viewer.view_renderer.viewed
        if viewed.update is None:
            viewer.say("nothing moves by itself here")
            return
        moved = viewer.time + step_sign * TIME_SHARE * viewed.period
        viewer.time = moved % viewed.period
        viewer.say("{time:.2f} of {period:.2f} s", time=viewer.time, period=viewed.period)

    return move


later, earlier = _moving(1), _moving(-1)


def _speeding(step_sign: int):
    """Return an action that changes the speed of the animation."""

    def change(viewer, step: int) -> None:
        faster = [speed for speed in SPEEDS if speed > viewer.speed]
        slower = [speed for speed in SPEEDS if speed < viewer.speed]
        if step_sign > 0:
            viewer.speed = faster[0] if faster else SPEEDS[-1]
        else:
            viewer.speed = slower[-1] if slower else SPEEDS[0]
        viewer.say("speed: {speed:g}×", speed=viewer.speed)

    return change


play_faster, play_slower = _speeding(1), _speeding(-1)


def toggle_grid(viewer, step: int) -> None:
    """Toggle the grid under the scene."""
    viewer.view_renderer.staging.show_grid(not viewer.view_renderer.settings.grid)


def _toggling(setting: str):
    """Return an action that toggles one of the `Settings`."""

    def toggle(viewer, step: int) -> None:
        settings = viewer.view_renderer.settings
        setattr(settings, setting, not getattr(settings, setting))

    return toggle


toggle_axes = _toggling("axes")
toggle_axes_grid = _toggling("axes_grid")
toggle_metadata = _toggling("metadata")


def cycle_statistics(viewer, step: int) -> None:
    """Switch the statistics: none, one line, or all."""
    viewer.statistics = following(viewer.statistics, STATISTICS, step)


def cycle_theme(viewer, step: int) -> None:
    """Switch between the dark and the light theme."""
    staging = viewer.view_renderer.staging
    staging.theme = following(staging.theme, THEMES, step)
    viewer.say("{name} theme", name=translated_choice("theme", staging.theme.name))


def cycle_lists(viewer, step: int) -> None:
    """Switch the list: objects, materials, or none."""
    shown = type(viewer.panel) if viewer.panel is not None else None
    panel = following(shown, (None, ObjectPanel, MaterialPanel), step)
    viewer.panel = None if panel is None else panel(viewer)


def _toggling_panel(panel: type):
    """Return an action that opens a panel, or ends what it does."""

    def toggle(viewer, step: int) -> None:
        if isinstance(viewer.panel, panel):
            viewer.panel.end()
        else:
            viewer.panel = panel(viewer)

    return toggle


toggle_section = _toggling_panel(SectionPanel)
toggle_explosion = _toggling_panel(ExplosionPanel)
toggle_measuring = _toggling_panel(MeasuringPanel)
toggle_pointing = _toggling_panel(PointingPanel)
toggle_dimensions = _toggling("dimensions")


def _toggle_dialog(viewer, panel: type) -> None:
    viewer.panel = None if isinstance(viewer.panel, panel) else panel(viewer, viewer.opening)
    viewer.held_positions.clear()


def open_file(viewer, step: int) -> None:
    """Toggle the file dialog; with Shift it shows recently opened files."""
    _toggle_dialog(viewer, FolderPanel if step > 0 else RecentPanel)


def next_file(viewer, step: int) -> None:
    """Show the next model of the folder."""
    viewer.opening.step(1)


def previous_file(viewer, step: int) -> None:
    """Show the previous model of the folder."""
    viewer.opening.step(-1)


def load_again(viewer, step: int) -> None:
    """Reload the file."""
    viewer.opening.load_again()


def toggle_help(viewer, step: int) -> None:
    """Toggle the list of all commands."""
    viewer.panel = None if isinstance(viewer.panel, CommandPanel) else CommandPanel(viewer)


def toggle_controls(viewer, step: int) -> None:
    """Toggle the bar, the ball of axes and the time line."""
    viewer.controls.shown = not viewer.controls.shown
    is_on = viewer.controls.shown
    viewer.say("bar, ball and time line: on" if is_on else "bar, ball and time line: off")


def toggle_fullscreen(viewer, step: int) -> None:
    """Toggle between full screen and a window."""
    viewer.window.toggle_fullscreen()


def save_screenshot(viewer, step: int) -> None:
    """Write a frame of the window's size, and nothing over it, to a numbered PNG in the folder."""
    path = numbered_path(
        Path.cwd(), f"{Path(viewer.view_renderer.viewed.title).stem}-screenshot", ".png"
    )
    viewer.view_renderer.samples = viewer.sampling.at_rest()
    viewer.view_renderer.resize(viewer.window.size)
    try:
        viewer.view_renderer.draw(viewer.view, viewer.time).save(path)
    except OSError as error:
        viewer.say(str(error))
        return
    viewer.say("saved {name}", name=path.name)


def save_turntable(viewer, step: int) -> None:
    """Write a turn around the scene, or its animation, to a numbered GIF; Escape cancels."""
    name = f"{Path(viewer.view_renderer.viewed.title).stem}-turntable"
    path = numbered_path(Path.cwd(), name, ".gif")
    viewer.say(record(viewer, path))


def quit(viewer, step: int) -> None:
    """Close the window."""
    viewer.running = False
