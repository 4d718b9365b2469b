"""``engine3d edit``: opens the editor window with its panels."""

from __future__ import annotations

import argparse

from ....base.language import speaking
from ....errors import Engine3DError
from ..options.language_options import language_of


def edit(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    from ...viewer.sdl import find_screen

    find_screen()
    try:
        from ...editor.ui.editor_window import EditorWindow
    except ImportError as error:
        if (error.name or "").partition(".")[0] != "imgui_bundle":
            raise
        # For other errors the package exists, but a system library is missing.
        is_there = not isinstance(error, ModuleNotFoundError)
        lacks = f"it does not load: {error}" if is_there else "pip install 'engine3d[editor]'"
        raise Engine3DError(f"the editor needs Dear ImGui: {lacks}") from None
    with (
        speaking(language_of(args)),
        EditorWindow(args.model or "", size=args.size, ui_scale=args.ui_scale) as editor,
    ):
        return editor.run()
