"""Whatever is handed to anything public, found by looking: a result, or an error of the project's.

Nothing bare of Python's or NumPy's, no warning of NumPy's, and no success with what is of no use.
"""

import warnings
from importlib.util import find_spec

import pytest
from public.every_callable import OBJ, PPM, every_call, hostile_values

import engine3d as e3d
from engine3d.apps.viewer import show

CALLS = {call.name: call for call in every_call()}
#: What nothing takes but parameters of which each is right.
OF_NO_USE = ("object", "complex", "a module")
TAKE_ANYTHING = ("FileAccessError", "FileFormatError")  # an error of an error helps nobody
MANIFEST = '{"version": 1, "tasks": [{"name": "a", "script": "a.py"}]}'


def no_screen(*size, **options):
    raise e3d.errors.DisplayError("there is no screen")


def no_scheduler(address, **options):
    raise OSError("nobody answers")


@pytest.fixture(autouse=True)
def apart(tmp_path, monkeypatch):
    """A folder with files to read, a screen that is none, and no window that stays open."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    for window in ("Window", "ProgramWindow"):
        monkeypatch.setattr(show, window, no_screen)
    if find_spec("distributed"):
        monkeypatch.setattr("distributed.Client", no_scheduler)
    (tmp_path / "there.obj").write_bytes(OBJ)
    (tmp_path / "there.ppm").write_bytes(PPM)
    (tmp_path / "there.json").write_text(MANIFEST)


def outcome(call, parameter, kind, value):
    """What is wrong with how a call ends; None if nothing is."""
    owner, arguments = call.right()
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        try:
            call.function(*owner, **{**arguments, parameter: value})
        except e3d.Engine3DError as error:
            named = parameter if parameter != "value" else call.name.rpartition(".")[2][:-2]
            return None if kind != "object" or named in str(error) else f"does not name it: {error}"
        except ImportError as error:  # of an optional package
            return None if "engine3d[" in str(error) else str(error)
        except Exception as error:
            return f"{type(error).__name__}: {error}"
    others = [w for w in seen if not issubclass(w.category, e3d.Engine3DWarning)]
    if others:
        return f"{others[0].category.__name__}: {others[0].message}"
    of_no_use = kind in OF_NO_USE and call.name not in TAKE_ANYTHING
    return "passes in silence" if of_no_use else None


@pytest.mark.parametrize("name", CALLS)
def test_wrong_arguments_end_as_promised(name):
    call = CALLS[name]
    wrong = []
    for parameter in call.parameters:
        for kind, value in hostile_values().items():
            found = outcome(call, parameter, kind, value)
            if found:
                wrong.append(f"{name}({parameter}={kind}): {found}")
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("name", [name for name, call in CALLS.items() if call.parameters])
def test_right_arguments_pass(name):
    """Else nothing would be tried by wrong ones in their places."""
    owner, arguments = CALLS[name].right()
    if name.endswith(" ="):
        return  # of what an attribute is now, tests of its class tell
    try:
        CALLS[name].function(*owner, **arguments)
    except (e3d.errors.DisplayError, ImportError) as error:
        assert "screen" in str(error) or "engine3d[" in str(error)


def test_the_public_names_are_tried():
    modules = [getattr(e3d, name) for name in e3d._MODULES]
    names = {name for module in (e3d, *modules) for name in module.__all__}
    tried = {part for name in CALLS for part in name.split(".")}
    assert {"render", "Mesh", "orbit", "load_scene", "Generator", "run", "look_at"} <= names & tried
    assert len(CALLS) > 400
