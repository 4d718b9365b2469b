"""``engine3d info --system``: a report on machine and installation for bug reports.

In: this process. Out: JSON types, or lines of text. The report contains nothing private: no user or
machine names, and no paths.
"""

from __future__ import annotations

import locale
import os
import platform
import re
import sys
from collections.abc import Callable
from importlib import metadata

from ..._native import rasterizer
from ...base.system import usable_processors
from ...base.thread_count import resolve_threads
from ...errors import DisplayError, Engine3DError
from ...rendering.backend_selection import backends, resolve_backend
from ...version import __version__
from ..bench.figures import cpuinfo, machine
from ..viewer.sdl import find_screen, load_sdl

#: Older versions overrun their buffers when they read some damaged images.
SAFE_PILLOW = (12, 3, 0)
#: Extras for developers of engine3d only.
_FOR_DEVELOPERS = ("test", "fuzz", "bench")
_INSTRUCTION_SETS = re.compile(r"s?sse|avx|f?ma$|f16c|bmi|popcnt|asimd|neon|sve|rv|altivec|vsx")
_HARMLESS = re.compile(r"[\w.,:+-]{1,40}")


def describe_system() -> dict:
    """Return a description of machine and installation, as JSON types.

    Returns
    -------
    dict
        ``engine3d``, ``build``, ``system``, ``python``, ``processor``, ``backends``, ``packages``,
        ``extras`` (of each that is installed its packages), ``missing_extras``, ``window``,
        ``locale``, ``environment``, ``warnings``.
    """
    needed, extras = _requirements()
    packages = {name: _version(name) for name in needed}
    installed = {extra: {n: _version(n) for n in names} for extra, names in extras.items()}
    complete = {extra: found for extra, found in installed.items() if all(found.values())}
    return {
        "engine3d": __version__,
        "build": dict(zip(("kind", "compiler"), rasterizer.BUILD, strict=True)),
        "system": _system(),
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "processor": _processor(),
        "backends": _backends(),
        "packages": packages,
        "extras": complete,
        "missing_extras": sorted(set(installed) - set(complete)),
        "window": _window(),
        "locale": _locale(),
        "environment": _environment(),
        "warnings": _warnings(packages),
    }


def _requirements() -> tuple[list[str], dict[str, list[str]]]:
    """Return the requirements, and the purpose of each extra, from the installed metadata."""
    needed: list[str] = []
    extras: dict[str, list[str]] = {}
    try:
        lines = metadata.requires("engine3d") or []
    except metadata.PackageNotFoundError:  # a copy of the source that is not installed
        lines = []
    for line in lines:
        name = re.match(r"[\w.-]+", line)[0]
        extra = re.search(r"extra == ['\"]([\w-]+)", line)
        if extra is None:
            needed.append(name)
        elif extra[1] not in _FOR_DEVELOPERS:
            extras.setdefault(extra[1], []).append(name)
    return needed, extras


def _version(package: str) -> str | None:
    """Return the version of an installed package."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


def _system() -> dict:
    return {
        "name": platform.system(),
        "release": platform.release(),
        "machine": platform.machine(),
        "distribution": _distribution(),
        "libc": " ".join(platform.libc_ver()).strip() or None,
    }


def _distribution() -> str | None:
    """Return the name and version by which users know their system."""
    if sys.platform == "darwin":  # its release is that of the kernel
        return f"macOS {platform.mac_ver()[0]}".strip()
    if sys.platform == "win32":  # 10 and 11 differ in the last number only
        return f"Windows {platform.version()}".strip()
    try:
        return platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, KeyError):
        return None


def _processor() -> dict:
    flags = re.search(r"^(?:flags|Features)\s*:(.*)", cpuinfo(), re.MULTILINE)
    return {
        "name": machine()["processor"],
        "processors": os.cpu_count(),
        "usable": usable_processors(),
        "features": [f for f in flags[1].split() if _INSTRUCTION_SETS.match(f)] if flags else [],
    }


def _backends() -> dict:
    """Return the default backend; if the environment's choice is refused, say why."""
    names = {number: name for name, number in rasterizer.BACKENDS.items()}
    auto = _told(lambda: names[resolve_backend()])
    threads = _told(lambda: resolve_threads() or usable_processors())
    return {"available": backends(), "auto": auto, "threads": threads}


def _told(ask: Callable[[], str | int]) -> str | int:
    try:
        return ask()
    except Engine3DError as error:
        return str(error)


def _window() -> dict:
    """Return SDL's version or load error; and why there is no screen, or None."""
    try:
        sdl = load_sdl()
        version = sdl.SDL_version()
        sdl.SDL_GetVersion(version)
        found = f"{version.major}.{version.minor}.{version.patch}"
    except DisplayError as error:
        found = _without_home(str(error))
    try:
        find_screen()
        missing = None
    except DisplayError as error:
        missing = str(error)
    return {"sdl": found, "missing": missing}


def _without_home(text: str) -> str:
    """Return a text with the user's folder replaced by ``~``."""
    home = os.path.expanduser("~")
    return text.replace(home, "~") if len(home) > 1 else text


def _locale() -> dict:
    return {
        "name": locale.setlocale(locale.LC_CTYPE),
        "files": sys.getfilesystemencoding(),
        "output": sys.stdout.encoding,
    }


def _environment() -> dict:
    """Return engine3d's environment variables; for possible paths, only that they are set."""
    names = sorted(name for name in os.environ if name.startswith("ENGINE3D_"))
    values = {name: os.environ[name] for name in [*names, "SDL_VIDEODRIVER"] if name in os.environ}
    return {n: value if _HARMLESS.fullmatch(value) else "(set)" for n, value in values.items()}


def _warnings(packages: dict[str, str | None]) -> list[str]:
    """Return the known problems of installed packages."""
    found = [f"{name} is missing: pip install {name}" for name, v in packages.items() if v is None]
    pillow = packages.get("pillow")
    if pillow and tuple(map(int, re.findall(r"\d+", pillow)[:3])) < SAFE_PILLOW:
        safe = ".".join(map(str, SAFE_PILLOW))
        found.append(
            f"pillow {pillow} has known holes, through which a damaged image may do harm: "
            f"pip install 'pillow>={safe}'"
        )
    return found


def system_lines(report: dict) -> list[str]:
    """Return the report as lines of text."""
    build, system, processor = report["build"], report["system"], report["processor"]
    drawn, window, texts = report["backends"], report["window"], report["locale"]
    extras = [f"{extra} ({_listed(found)})" for extra, found in report["extras"].items()]
    rows = [
        ("engine3d", f"{report['engine3d']}, {build['kind']} build, compiler {build['compiler']}"),
        ("system", ", ".join(filter(None, system.values()))),
        ("python", report["python"]),
        ("processor", f"{processor['name']}, {processor['usable']} of {processor['processors']}"),
        ("features", " ".join(processor["features"]) or "unknown"),
        ("backends", " ".join(drawn["available"])),
        ("auto", f"{drawn['auto']}, threads: {drawn['threads']}"),
        ("packages", _listed(report["packages"])),
        ("extras", ", ".join(extras) or "none"),
        ("not there", " ".join(report["missing_extras"]) or "none"),
        ("window", f"SDL {window['sdl']}; {window['missing'] or 'a screen is named'}"),
        ("locale", f"{texts['name']}, files {texts['files']}, output {texts['output']}"),
        ("variables", " ".join(f"{k}={v}" for k, v in report["environment"].items()) or "none"),
    ]
    lines = [f"{name:<12}{text}" for name, text in rows]
    return lines + [f"warning: {text}" for text in report["warnings"]]


def _listed(versions: dict[str, str | None]) -> str:
    return ", ".join(f"{name} {version or 'missing'}" for name, version in versions.items())
