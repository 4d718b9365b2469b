"""Actions on motion for menus, keys and panels; each is one undoable step.

In: the workspace. Out: commands, and the time.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable

from .....base.language import translated
from .....model.motion.node_motion import NodeMotion
from .....model.motion.orbits import Orbit
from .....model.motion.paths import Path
from .....model.scene.animation import Motions, Spin, Track
from .....model.scene.nodes import Node
from ...motion_commands import (
    SetMotions,
    added,
    key_near,
    label_of,
    new_orbit,
    new_path,
    new_spin,
    removed,
    with_key,
    without_key,
)
from ...motion_copies import motions_in
from ...node_commands import named
from ..workspace import Workspace

#: What is called what in panels.
TITLES: dict[type[NodeMotion], str] = {
    Spin: "Spin",
    Orbit: "Orbit",
    Path: "Path",
    Track: "Keyframes",
}
#: Seconds on the time line of a scene without motion.
USUAL_LENGTH = 4.0


def set_motions(
    workspace: Workspace,
    change: Callable[[Motions], Motions],
    label: str,
    node: Node,
    drag: Hashable = None,
) -> bool:
    """Change the motions of a node, as a step."""
    command = SetMotions(workspace.document.animator, workspace.scene, change, label, (node,))
    return workspace.do(command, drag=drag)


def put(
    workspace: Workspace, motion: NodeMotion, what: str = "Change", drag: Hashable = None
) -> bool:
    """Give a node a motion, in place of its motion of that kind."""
    return set_motions(workspace, added(motion), label_of(what, motion), motion.node, drag)


def remove(workspace: Workspace, motion: NodeMotion) -> bool:
    """Take a motion from its node."""
    return set_motions(workspace, removed(motion), label_of("Remove", motion), motion.node)


def time_of(workspace: Workspace) -> float:
    """Return the present time, in seconds."""
    animator = workspace.scene.animator
    return 0.0 if animator is None else animator.time


def seek(workspace: Workspace, time: float) -> None:
    """Go to a time, and stand still there."""
    workspace.plays = False
    workspace.document.animator.seek(max(time, 0.0))


def spin(workspace: Workspace) -> None:
    """Let the active node turn."""
    node = workspace.document.selection.active
    if node is not None:
        put(workspace, new_spin(node, time_of(workspace)), "Add")


def orbit(workspace: Workspace) -> None:
    """Let the active node circle the node selected before it, or else its parent."""
    node = workspace.document.selection.active
    if node is None:
        return
    others = [each for each in workspace.document.selection.nodes if each is not node]
    about = others[-1] if others else node.parent
    reach = workspace.bounds.radius
    made = new_orbit(node, about, time=time_of(workspace), reach=reach)
    put(workspace, made, "Add")


def path(workspace: Workspace) -> None:
    """Let the active node go along a path."""
    node = workspace.document.selection.active
    if node is not None:
        reach = workspace.bounds.radius
        put(workspace, new_path(node, time=time_of(workspace), reach=reach), "Add")


def track_of(workspace: Workspace, node: Node) -> Track | None:
    """Return the keyframes of a node."""
    return _track_in(motions_in(workspace.scene), node)


def set_key(workspace: Workspace) -> None:
    """Set a keyframe of where each selected node is, at the present time."""
    time = time_of(workspace)
    nodes = workspace.document.selection.nodes
    if not nodes:
        return

    def change(held: Motions) -> Motions:
        for node in nodes:
            held = added(with_key(node, _track_in(held, node), time))(held)
        return held

    things = named(nodes)
    label = translated("Set a key of {things} at {time:.2f} s", things=things, time=time)
    document = workspace.document
    workspace.do(SetMotions(document.animator, workspace.scene, change, label, nodes))


def delete_key(workspace: Workspace) -> None:
    """Delete the keyframes of the selected nodes at the present time."""
    time = time_of(workspace)
    found: list[tuple[Node, Track, Track | None]] = []
    for node in workspace.document.selection.nodes:
        track = track_of(workspace, node)
        number = None if track is None else key_near(track, time)
        if track is not None and number is not None:
            found.append((node, track, without_key(track, number)))
    if not found:
        return

    def change(held: Motions) -> Motions:
        for _, track, left in found:
            held = (removed(track) if left is None else added(left))(held)
        return held

    nodes = tuple(node for node, *_ in found)
    label = translated("Delete a key of {things}", things=named(nodes))
    workspace.do(SetMotions(workspace.document.animator, workspace.scene, change, label, nodes))


def remove_key(workspace: Workspace, track: Track, number: int) -> None:
    """Delete a keyframe; with the last one the motion ends."""
    left = without_key(track, number)
    if left is None:
        remove(workspace, track)
    else:
        put(workspace, left, "Delete a key of")


def go_to_key(workspace: Workspace, step: int) -> None:
    """Go to the next keyframe of the selected nodes, or all nodes; to the one before for -1."""
    chosen = set(workspace.document.selection.nodes)
    tracks = [track for track in motions_in(workspace.scene).tracks if track.node in chosen]
    times = {
        float(time)
        for track in tracks or motions_in(workspace.scene).tracks
        for time in track.times
    }
    now = time_of(workspace)
    ahead = [time for time in times if (time - now) * step > 1e-9]
    if ahead:
        seek(workspace, min(ahead, key=lambda time: abs(time - now)))


def _track_in(held: Motions, node: Node) -> Track | None:
    return next((track for track in held.tracks if track.node is node), None)


#: What is added to the active node, by title.
ADDED: dict[str, Callable[[Workspace], None]] = {
    TITLES[Spin]: spin,
    TITLES[Orbit]: orbit,
    TITLES[Path]: path,
    TITLES[Track]: set_key,
}
