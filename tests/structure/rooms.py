"""The rooms on the ground floor: what each holds, what it may import, who may skip it.

Rooms stand in storeys: one imports those that its row names, which all stand in rows above it. The
few imports that run up are façades: methods of a class that hand over to another room.
"""

from typing import NamedTuple


class Room(NamedTuple):
    holds: str
    imports: tuple[str, ...]
    skipped_by: str


#: Of engine/, from the ground up; its modules beside the rooms are the first row.
ENGINE = {
    "": Room("errors, types of choices, the public list, aliases", (), "nobody"),
    "_native": Room("the gate to the C core", ("",), "who changes no C"),
    "base": Room(
        "algebra with the same bits everywhere, checks, atomic files", ("", "_native"), "nobody"
    ),
    "model": Room(
        "what is drawn: meshes, materials, scenes, motion", ("", "_native", "base"), "nobody"
    ),
    "rendering": Room("a model to arrays", ("", "_native", "base", "model"), "nobody"),
    "io": Room("files, both ways", ("", "_native", "base", "model", "rendering"), "who only draws"),
    "stage": Room(
        "how a model is presented: light, frame, ground, labels",
        ("", "_native", "base", "model", "rendering", "io"),
        "who makes scenes of one's own",
    ),
    "extras": Room(
        "worlds, levels of detail",
        ("", "_native", "base", "model", "rendering", "io"),
        "nearly everybody",
    ),
    "apps": Room(
        "programs",
        ("", "_native", "base", "model", "rendering", "io", "stage", "extras"),
        "who uses the library",
    ),
    "compat": Room(
        "names of other libraries",
        ("", "_native", "base", "model", "rendering", "io", "stage", "extras", "apps"),
        "nearly everybody",
    ),
}

#: Imports that run up: a class offers what another room does.
FACADES = {
    "base.notebook_pictures -> stage.thumbnail",
    "model.environments.environment -> io.formats.radiance_pictures",
    "model.environments.environment -> io.reading.sources",
    "model.geometry._polygons -> io.reading.triangulation",
    "model.geometry.mesh -> io.trimesh_conversion",
    "model.geometry.mesh -> io.writers",
    "model.scene._queries -> rendering.frame",
    "model.scene._queries -> rendering.picking",
    "model.scene.scene -> io.writing.scene_saving",
}
#: Of programs, those that use another.
ARROWS = {
    "agents -> golden",
    "agents -> sheet",
    "batch -> datasets",
    "bench -> scenes",
    "cli -> agents",
    "cli -> batch",
    "cli -> bench",
    "cli -> desktop",
    "cli -> drawings",
    "cli -> editor",
    "cli -> golden",
    "cli -> learn",
    "cli -> scenes",
    "cli -> sheet",
    "cli -> terminal",
    "cli -> viewer",
    "drawings -> sheet",
    "editor -> desktop",
    "editor -> events",
    "editor -> imgui_painter",
    "editor -> scenes",
    "editor -> viewer",
    "learn -> events",
    "learn -> terminal",
    "notebook -> events",
    "notebook -> viewer",
    "terminal -> events",
    "viewer -> desktop",
    "viewer -> events",
}
