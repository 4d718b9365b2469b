"""The shape of the source: what depends on what, how large headers are, which lists stand twice.

A rule that the source breaks today has a list of these breaches, which may only shrink: a breach
that isn't listed fails, and so does a listed one that is gone, until its line is deleted here.
C is read by regular expressions, which suffices for the one style of this project.
"""

import ast
import functools
import re
from collections import Counter, defaultdict
from pathlib import Path, PurePosixPath
from typing import Literal, get_args, get_origin

import pytest

import engine3d
from engine3d import choices

ROOT = Path(__file__).resolve().parents[2]

# Which folders of csrc/ the files of one include headers of, besides their own and system headers.
FOLDERS = {
    "bloom": {"core", "include", "kernels", "reference"},
    "canvas": {"include"},
    "core": {"include"},
    "driver": {"include"},
    "environment": {"core", "include", "kernels"},
    "fuzz": {"driver", "images", "include", "loaders"},
    "images": {"core", "include"},
    "include": set(),
    "kernels": {"core", "include"},
    "loaders": {"core", "include"},
    "navigation": {"core", "include"},
    "occlusion": {"core", "include", "kernels", "reference"},
    "pipeline/cast": {"core", "include", "kernels", "pipeline/pass"},
    "pipeline/cull": {"core", "include", "kernels", "pipeline/pass"},
    "pipeline/frame": {
        *("core", "include", "kernels", "reference"),
        *(
            "pipeline/cast",
            "pipeline/cull",
            "pipeline/geometry",
            "pipeline/pass",
            "pipeline/shade",
            "pipeline/store",
        ),
        "pipeline/tile",
    },
    "pipeline/geometry": {"core", "include", "kernels", "pipeline/cull", "pipeline/pass"},
    "pipeline/pass": {"core", "include", "kernels"},
    "pipeline/shade": {"core", "include", "kernels", "pipeline/pass", "pipeline/store"},
    "pipeline/store": {"core", "include", "kernels", "pipeline/geometry", "pipeline/pass"},
    "pipeline/tile": {
        *("core", "include", "kernels", "pipeline/cull", "pipeline/geometry"),
        *("pipeline/pass", "pipeline/shade", "pipeline/store"),
    },
    "reference": {"core", "include"},
    "posing": {"core", "include", "scene"},
    "pyrender": {"core", "include"},
    "scene": {"core", "include"},
    "ui": {"core", "include", "kernels", "reference"},
    "windows": set(),
    "writers": {"include"},
}
MAX_HEADER_LINES = 260
MAX_INCLUDERS = 19  # files of a header's own folder

# Each file of these is a program of its own: they share how they take their input, and no state.
PROGRAMS = {"fuzz"}

# Imports inside functions without which no modules would import each other in a circle.
BACKWARD_IMPORTS = {
    "geometry.mesh -> rendering.thumbnail",  # in a notebook
    "scene.scene -> rendering.thumbnail",
    "geometry.mesh -> geometry.trimesh_conversion",
    "geometry.mesh -> writers",
    "scene.scene -> writers.scene",
}
# Lists that repeat a type of engine/choices.py.
COPIED_CHOICES = set()


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.S)


def read_sources():
    """The files of csrc/ by their path there."""
    folder = ROOT / "csrc"
    paths = [p for p in sorted(folder.rglob("*")) if p.suffix in (".c", ".h", ".inl")]
    return {p.relative_to(folder).as_posix(): p.read_text(encoding="utf-8") for p in paths}


SOURCES = read_sources()
CODE = {name: without_comments(text) for name, text in SOURCES.items()}


def folder_of(name):
    """The folder of a file, as far as what may include what depends on it."""
    parts = PurePosixPath(name).parts
    return "/".join(parts[:2] if parts[0] == "pipeline" else parts[:1])


def included_by(name):
    """The files of csrc/ that one includes."""
    here = PurePosixPath(name).parent.as_posix()
    found = set()
    for header in re.findall(r'^\s*#\s*include\s+"([^"]+)"', SOURCES[name], re.M):
        places = [header, f"include/{header}", f"{here}/{header}"]
        found.update([place for place in places if place in SOURCES][:1])
    return found


def with_parts(names):
    """Headers, and in place of those that only put others together, these."""
    parts = {name: included_by(name) for name in names if is_a_collection(name)}
    return names.union(*parts.values())


def is_a_collection(name):
    return not re.sub(r"^#.*", "", CODE[name], flags=re.M).strip()


INCLUDES = {name: with_parts(included_by(name)) for name in SOURCES}


def circles(graph):
    """The sets of nodes of a graph that all lead to each other, sorted; `graph`: successors."""
    reach = {node: reachable(graph, node) for node in graph}
    found = {frozenset(b for b in reach[a] if a in reach.get(b, ())) for a in graph}
    return [sorted(circle) for circle in found if len(circle) > 1]


def reachable(graph, start):
    """Where one comes from a node by at least one step."""
    found, todo = set(), [start]
    while todo:
        new = set(graph.get(todo.pop(), ())) - found
        found |= new
        todo += new
    return found


def enumerators(code):
    bodies = re.findall(r"\benum\s*\w*\s*\{([^}]*)\}", code)
    lists = [re.sub(r"\w*\([^()]*\)", "", body) for body in bodies]
    tables = re.findall(r"#define E3D_EACH.*", joined(code))
    of_tables = re.findall(r"\bX\((\w+),", " ".join(tables))
    return {*of_tables, *re.findall(r"(?:^|,)\s*([A-Za-z_]\w*)", ",".join(lists))}


def joined(code):
    """Code whose lines go on to where they end without a backslash."""
    return re.sub(r"\\\n", " ", code)


def macros(code):
    return set(re.findall(r"^\s*#\s*define\s+(\w+)", code, re.M))


def functions(code):
    """Functions with a body that begin in a line's first column, and whether each is static."""
    pattern = r"^(?!typedef|#|enum )((?:\w+[ *]+)+)(?!__)(\w+)\([^;{}]*\)\s*\{"
    return {name: "static" in kind.split() for kind, name in re.findall(pattern, code, re.M)}


def types(code):
    """What typedefs name, but for pointers to functions."""
    structs = re.findall(r"^(?:typedef .*)?\} (\w+);", code, re.M)
    return {*structs, *re.findall(r"^typedef [^{};()]*?(\w+)(?:\[[^]]*\])*;", code, re.M)}


def prototypes(code):
    return set(re.findall(r"^(?!typedef|static|#)\w[\w *]*?(\w+)\([^;{}]*\);", code, re.M))


def declared(code):
    """The names that including a file brings in."""
    of_functions = set(functions(code)) | prototypes(code)
    return types(code) | enumerators(code) | macros(code) | of_functions


def words(code):
    return set(re.findall(r"[A-Za-z_]\w*", code))


# ---- C ----


def test_folders_include_only_those_below_them():
    found = defaultdict(set)
    for name, headers in INCLUDES.items():
        found[folder_of(name)] |= {folder_of(header) for header in headers} - {folder_of(name)}
    assert found == FOLDERS
    assert circles(FOLDERS) == []


def test_headers_are_short():
    # The words of an instruction set are one list, however long.
    headers = [name for name in SOURCES if name.endswith(".h") and "/simd/" not in name]
    assert [name for name in headers if SOURCES[name].count("\n") > MAX_HEADER_LINES] == []


def test_no_header_is_included_all_over_its_folder():
    pairs = [(header, name) for name, headers in INCLUDES.items() for header in headers]
    own = [pair for pair in pairs if len({*map(folder_of, pair)}) == 1]
    counts = Counter(header for header, _ in own if folder_of(header) not in PROGRAMS)
    assert {header for header, count in counts.items() if count > MAX_INCLUDERS} == set()


def calls_within(folder):
    """The files of a folder, and of which others each names a function."""
    files = [name for name in CODE if folder_of(name) == folder and name.endswith(".c")]
    homes = {}
    for name in files:
        homes |= {f: name for f, is_static in functions(CODE[name]).items() if not is_static}
    return {
        name: {homes[word] for word in words(CODE[name]) & homes.keys()} - {name} for name in files
    }


def test_no_files_of_a_folder_call_each_other_in_a_circle():
    assert [circle for folder in FOLDERS for circle in circles(calls_within(folder))] == []


def unit_of(name):
    """A header and the .c file of its name are one unit; other files are one each."""
    return name.removesuffix(".c").removesuffix(".h")


def test_no_headers_with_their_c_files_include_each_other_in_a_circle():
    graph = defaultdict(set)
    for name, headers in INCLUDES.items():
        graph[unit_of(name)] |= {unit_of(header) for header in headers} - {unit_of(name)}
    assert circles(dict(graph)) == []


def test_stages_ask_what_is_planned_and_not_what_was_asked_for():
    files = {name for name, code in CODE.items() if re.search(r"\bE3D_ASKED_", code)}
    assert files == {"pipeline/pass/plan.c", "pipeline/pass/plan.h"}


def test_lights_are_told_apart_by_their_traits_alone():
    kinds = set(re.findall(r"\bX\((E3D_LIGHT_\w+),", SOURCES["include/e3d_light.h"]))
    assert len(kinds) >= 3
    assert {name for name, code in CODE.items() if words(code) & kinds} == {"include/e3d_light.h"}


def test_no_macro_is_an_enumerator_too():
    # Files that no other includes keep their names to themselves.
    shared = [CODE[name] for name in CODE if not name.endswith(".c")]
    of_enums = set().union(*map(enumerators, CODE.values()))
    of_macros = set().union(*map(macros, CODE.values()))
    known = set().union(*map(declared, shared))
    assert of_enums & of_macros & known == set()


# What may be included; the words of the vectors come with the instruction set, which is chosen
# outside of the kernels.
DECLARED = {
    name: declared(code)
    for name, code in CODE.items()
    if not name.endswith(".c") and "/simd/" not in name
}
# each_kernel.inl is rows, of which whoever includes it makes something.
FRAME_FILES = [n for n in SOURCES if re.match(r"pipeline/|kernels/(?!simd/|each_kernel)", n)]


@pytest.mark.parametrize("name", FRAME_FILES)
def test_files_that_draw_a_frame_include_what_they_use(name):
    folder, used = folder_of(name), words(CODE[name])
    homes = defaultdict(set)
    for other in DECLARED:
        below = folder_of(other) in FOLDERS[folder] and other.endswith(".h")
        if below or folder_of(other) == folder:
            for word in DECLARED[other] & used:
                homes[word].add(other)
    has = INCLUDES[name] | {name}
    assert {word for word in homes if not homes[word] & has} == set()


# ---- Python ----


def is_for_type_checkers(node):
    return isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)


def run_time_nodes(tree):
    """The nodes of a syntax tree, without what only type checkers read."""
    for node in ast.iter_child_nodes(tree):
        if not is_for_type_checkers(node):
            yield node
            yield from run_time_nodes(node)


def python_modules():
    """The modules of engine/ by their names within it."""
    folder = ROOT / "engine"
    paths = {path.relative_to(folder).with_suffix("").parts: path for path in folder.rglob("*.py")}
    return {".".join(part for part in p if part != "__init__"): path for p, path in paths.items()}


MODULES = python_modules()


@functools.cache
def imported_by(name):
    """The modules of engine/ that one imports, at once or in a function."""
    tree = ast.parse(MODULES[name].read_text(encoding="utf-8"))
    package = MODULES[name].relative_to(ROOT / "engine").parent.parts
    found = set()
    for node in run_time_nodes(tree):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = [*package[: len(package) - node.level + 1], *filter(None, [node.module])]
            for alias in node.names:
                longest = ".".join([*base, alias.name])
                found.add(longest if longest in MODULES else ".".join(base))
    return found & MODULES.keys() - {name}


def test_modules_import_each_other_in_no_circle():
    graph = {name: imported_by(name) for name in MODULES}
    backward = {tuple(line.split(" -> ")) for line in BACKWARD_IMPORTS}
    rest = {a: {b for b in graph[a] if (a, b) not in backward} for a in graph}
    assert circles(rest) == []
    for importer, imported in backward:
        assert imported in graph[importer], "it is gone: delete it from the list"
        assert importer in reachable(rest, imported), "it closes no circle: delete it from the list"


# Packages that tell by an underscore which of their modules nobody else needs. In the others, which
# offer what their __init__ lists or a command runs, all modules are their own business.
PACKAGES = {"files", "geometry", "lod", "materials", "navigation", "rendering", "scene", "spatial"}


def outsiders(name):
    """The modules that import one, but for those of its package; its __init__ counts as one."""
    package = name.rpartition(".")[0]
    importers = {other for other in MODULES if name in imported_by(other)}
    return {other for other in importers if not other.startswith(f"{package}.")}


@pytest.mark.parametrize("package", sorted(PACKAGES))
def test_an_underscore_tells_what_a_package_keeps_to_itself(package):
    names = [name for name in MODULES if name.rpartition(".")[0] == package]
    offered = {name for name in names if name in engine3d._PUBLIC.values() or outsiders(name)}
    assert len(names) >= 3
    assert {name for name in names if "._" not in name} == offered


def test_the_top_of_the_package_holds_no_helpers():
    top = {name for name, path in MODULES.items() if path.parent == ROOT / "engine"}
    assert top == {"", "__main__", "canvas", "choices", "errors", "notebook", "start", "version"}


def module_lists(path):
    """The lists of three and more constants that a module assigns, by name."""
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and isinstance(node.value, (ast.Tuple, ast.List, ast.Set)):
            if all(isinstance(element, ast.Constant) for element in node.value.elts):
                values = {element.value for element in node.value.elts}
                if len(values) >= 3:
                    yield ast.unparse(node.targets[0]), values


def test_choices_are_listed_once():
    types = [getattr(choices, name) for name in vars(choices)]
    known = [set(get_args(t)) for t in types if get_origin(t) is Literal]
    found = {
        f"{path.relative_to(ROOT / 'engine').as_posix()}: {name}"
        for path in MODULES.values()
        for name, values in module_lists(path)
        if values in known
    }
    assert found == COPIED_CHOICES
