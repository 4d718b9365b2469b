"""Writes what desktops and `man` know of engine3d; a wheel installs it below PREFIX/share.

    python data/desktop/make.py            write the files
    python data/desktop/make.py --check    exit with 1 if one is out of date

In: the formats that engine3d reads and the options of its commands; plug-ins are left out.
Out: in this folder, a desktop entry, a thumbnailer, MIME types, AppStream's metadata, a manual
page. engine3d.svg is drawn by hand.
"""

from __future__ import annotations

import sys
from pathlib import Path

from manual_page import manual_page

from engine3d.apps.cli.plugin_switch import NO_PLUGINS, plugins_as_asked
from engine3d.io.loaders import formats
from engine3d.version import RELEASED, __version__

FOLDER = Path(__file__).resolve().parent
SUMMARY = "Look at 3D models"
AUTHORS = "engine3d authors"
#: Format -> its MIME type. What only optional packages read is left to the programs made for it.
TYPES = {
    "3mf": "model/3mf",
    "dae": "model/vnd.collada+xml",
    "glb": "model/gltf-binary",
    "gltf": "model/gltf+json",
    "obj": "model/obj",
    "off": "model/x-off",
    "ply": "model/x-ply",
    "stl": "model/stl",
    "urdf": "model/x-urdf+xml",
}
#: Names that other programs have more reason to claim: of keys, of any JSON.
NOT_CLAIMED = ("asc", "e3d")
#: Types that shared-mime-info lacks -> whatever tells them besides the extension.
NEW_TYPES = {
    "dae": """\
    <sub-class-of type="application/xml"/>
    <root-XML namespaceURI="http://www.collada.org/2005/11/COLLADASchema" localName="COLLADA"/>
""",
    "off": "",
    "ply": """\
    <magic><match type="string" offset="0" value="ply\\n"/></magic>
    <magic><match type="string" offset="0" value="ply\\r"/></magic>
""",
    "urdf": """\
    <sub-class-of type="application/xml"/>
""",
}


def types() -> str:
    return "".join(f"{one};" for one in TYPES.values())


def desktop_entry() -> str:
    return f"""\
[Desktop Entry]
Type=Application
Name=engine3d
GenericName=3D Model Viewer
Comment={SUMMARY}
Keywords=3D;model;mesh;viewer;STL;glTF;OBJ;
TryExec=engine3d
Exec=engine3d run %F
Icon=engine3d
Terminal=false
Categories=Graphics;3DGraphics;Viewer;
MimeType={types()}
"""


def thumbnailer() -> str:
    # A file manager may keep the empty file open that it made for the picture, and would not see
    # the new file that `render -o FILE` puts in its place: hence the shell, which fills it.
    command = f'engine3d render --quiet {NO_PLUGINS} --no-background --size "$1x$1" -o - "$2"'
    return f"""\
[Thumbnailer Entry]
TryExec=engine3d
Exec=sh -c '{command} >"$3"' sh %s %i %o
MimeType={types()}
"""


def mime_types() -> str:
    known = {item.name: item for item in formats()}
    return "".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>\n',
            '<mime-info xmlns="http://www.freedesktop.org/standards/shared-mime-info">\n',
            *(mime_type(known[name], told) for name, told in NEW_TYPES.items()),
            "  <!-- A drawing program's .obj has signs of its own in the first bytes. -->\n",
            f'  <mime-type type="{TYPES["obj"]}">\n',
            '    <glob pattern="*.obj" weight="60"/>\n',
            "  </mime-type>\n",
            "</mime-info>\n",
        ]
    )


def mime_type(item, told: str) -> str:
    globs = "".join(
        f'    <glob pattern="*{extension}"/>\n'
        for extension in item.extensions
        if item.name != "urdf" or extension == ".urdf"  # .xacro is a language of macros
    )
    head = f'  <mime-type type="{TYPES[item.name]}">\n    <comment>{item.description}</comment>\n'
    return f"{head}{told}{globs}  </mime-type>\n"


def metadata() -> str:
    media = "".join(f"    <mediatype>{one}</mediatype>\n" for one in TYPES.values())
    return f"""\
<?xml version="1.0" encoding="UTF-8"?>
<component type="desktop-application">
  <id>engine3d.desktop</id>
  <metadata_license>MIT</metadata_license>
  <project_license>MIT AND OFL-1.1</project_license>
  <name>engine3d</name>
  <summary>{SUMMARY}</summary>
  <developer>
    <name>{AUTHORS}</name>
  </developer>
  <description>
    <p>
      engine3d draws 3D models on the processor alone: it needs no graphics card and no driver. It
      shows models in a window, writes pictures, turntables and line drawings of them, compares
      pictures byte by byte, and draws thumbnails for file managers.
    </p>
  </description>
  <launchable type="desktop-id">engine3d.desktop</launchable>
  <icon type="stock">engine3d</icon>
  <categories>
    <category>Graphics</category>
    <category>3DGraphics</category>
  </categories>
  <content_rating type="oars-1.1"/>
  <releases>
    <release version="{__version__}" date="{RELEASED}"/>
  </releases>
  <provides>
    <binary>engine3d</binary>
{media}  </provides>
</component>
"""


def files() -> dict[str, str]:
    """Return the text of each file."""
    with plugins_as_asked([NO_PLUGINS]):
        return {
            "engine3d.desktop": desktop_entry(),
            "engine3d.thumbnailer": thumbnailer(),
            "engine3d.xml": mime_types(),
            "engine3d.metainfo.xml": metadata(),
            "engine3d.1": manual_page(__version__, RELEASED),
        }


def main(arguments: list[str]) -> int:
    if "--check" not in arguments:
        for name, text in files().items():
            Path(FOLDER, name).write_text(text, "utf-8")
        return 0
    old = [n for n, text in files().items() if Path(FOLDER, n).read_text("utf-8") != text]
    if old:
        print(f"out of date: {', '.join(old)}: run `python data/desktop/make.py`", file=sys.stderr)
    return bool(old)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
