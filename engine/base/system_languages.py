"""The languages that the user's settings prefer, on systems that tell them in no variable.

In: the settings of Windows or macOS. Out: names such as ``fr_FR`` or ``fr-FR``, the preferred one
first. Other systems tell them by variables, such as ``LANG``.
"""

from __future__ import annotations

import re
import sys

from .system import answer_of

_NAME = re.compile(r"\w+(?:-\w+)*")


def system_languages() -> list[str]:
    """Return the preferred languages; none where the system does not tell."""
    if sys.platform == "win32":
        return _of_windows()
    return _of_macos() if sys.platform == "darwin" else []


def _of_windows() -> list[str]:
    """Return the language of Windows' own windows, which need not be that of its formats."""
    import ctypes
    import locale

    number = ctypes.windll.kernel32.GetUserDefaultUILanguage()  # type: ignore[attr-defined]
    name = locale.windows_locale.get(number & 0xFFFF)
    return [] if name is None else [name]


def _of_macos() -> list[str]:
    # A short process is simpler than CoreFoundation's lists of its own strings.
    return _NAME.findall(answer_of("/usr/bin/defaults", "read", "-g", "AppleLanguages"))
