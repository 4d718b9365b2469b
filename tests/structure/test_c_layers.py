"""The shape of the C source: what depends on what, how large headers are.

C is read by regular expressions, which suffices for the one style of this project.
"""

import re
from collections import Counter, defaultdict
from pathlib import Path, PurePosixPath

import pytest
from structure.graphs import circles

ROOT = Path(__file__).resolve().parents[2]

# Which folders of csrc/ the files of one include headers of, besides their own and system headers.
FOLDERS = {
    "base": {"include"},
    "base/windows": set(),
    "check/driver": {"include"},
    "check/fuzz": {"check/driver", "include", "io/images", "io/loaders"},
    "data": {"base", "include"},
    "extras/canvas": {"include"},
    "extras/drawing": {"base", "include"},
    "extras/mujoco": {"base", "include", "kernels"},
    "extras/pybullet": {"base", "include"},
    "extras/pyrender": {"base", "data", "include"},
    "frame/cast": {"base", "data", "frame/pass", "include", "kernels"},
    "frame/cull": {"base", "data", "frame/pass", "include", "kernels"},
    "frame/geometry": {"base", "data", "frame/cull", "frame/pass", "include", "kernels"},
    "frame/pass": {"base", "data", "include", "kernels"},
    "frame/run": {
        "base",
        "data",
        "frame/cast",
        "frame/cull",
        "frame/geometry",
        "frame/pass",
        "frame/shade",
        "frame/store",
        "frame/tile",
        "include",
        "kernels",
        "reference",
    },
    "frame/shade": {"base", "data", "frame/pass", "frame/store", "include", "kernels"},
    "frame/store": {"base", "data", "frame/geometry", "frame/pass", "include", "kernels"},
    "frame/tile": {
        "base",
        "data",
        "frame/cull",
        "frame/geometry",
        "frame/pass",
        "frame/shade",
        "frame/store",
        "include",
        "kernels",
    },
    "include": set(),
    "io/images": {"base", "include"},
    "io/loaders": {"base", "include"},
    "io/writers": {"include"},
    "kernels": {"base", "data", "include"},
    "light": {"base", "include", "kernels"},
    "post": {"base", "data", "include", "kernels", "reference"},
    "post/ui": {"base", "include", "kernels", "reference"},
    "reference": {"base", "data", "include"},
    "scene": {"base", "data", "include"},
    "scene/navigation": {"base", "include"},
    "scene/posing": {"base", "data", "include", "scene"},
}
MAX_HEADER_LINES = 260
MAX_INCLUDERS = 22  # files of a header's own folder

# Each file of these is a program of its own: they share how they take their input, and no state.
PROGRAMS = {"check/fuzz"}


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
    folders = PurePosixPath(name).parts[:-1]
    whole = ("data", "include", "kernels", "reference")
    return "/".join(folders[:1] if folders[0] in whole else folders[:2])


def include_lines(name):
    """What one includes, as it is written there; system headers in their brackets."""
    return re.findall(r'^\s*#\s*include\s+("[^"]+"|<[^>]+>)', SOURCES[name], re.M)


def included_by(name):
    """The files of csrc/ that one includes."""
    here = PurePosixPath(name).parent.as_posix()
    found = set()
    for header in [line.strip('"') for line in include_lines(name)]:
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


def homes_of_functions(sources):
    """The .c files in which each function that is not static is defined, but for programs."""
    homes = defaultdict(set)
    for name, code in sources.items():
        if name.endswith(".c") and folder_of(name) not in PROGRAMS:
            for function, is_static in functions(code).items():
                if not is_static:
                    homes[function].add(name)
    return homes


def test_no_two_files_define_a_function_of_one_name():
    # Libraries are static: the linker takes the first of two, and does not tell.
    homes = homes_of_functions(CODE)
    assert len(homes) > 500
    assert {name: files for name, files in homes.items() if len(files) > 1} == {}


def test_homes_of_functions_are_found():
    text = "static int one(void)\n{\n}\n\nint *two(const int *a,\n         int b)\n{\n}\n"
    both = {"scene/a.c": text, "post/b.c": text}
    programs = {"check/fuzz/c.c": text, "scene/d.h": text}
    assert homes_of_functions({**both, **programs}) == {"two": set(both)}


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


def test_c_files_include_nothing_that_their_own_headers_include():
    pairs = [(name, f"{unit_of(name)}.h") for name in SOURCES if name.endswith(".c")]
    together = [(name, own) for name, own in pairs if own in SOURCES]
    assert len(together) > 100
    shared = {name: {*include_lines(name)} & {*include_lines(own)} for name, own in together}
    assert {name: both for name, both in shared.items() if both} == {}


def test_stages_ask_what_is_planned_and_not_what_was_asked_for():
    files = {name for name, code in CODE.items() if re.search(r"\bE3D_ASKED_", code)}
    assert files == {"frame/pass/plan.c", "frame/pass/plan.h"}


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
FRAME_FILES = [n for n in SOURCES if re.match(r"frame/|kernels/(?!simd/|each_kernel)", n)]


@pytest.mark.parametrize("name", FRAME_FILES)
def test_files_that_draw_a_frame_include_what_they_use(name):
    folder, used = folder_of(name), words(CODE[name])
    homes = defaultdict(set)
    for other in DECLARED:
        below = folder_of(other) in FOLDERS[folder] and other.endswith(".h")
        if below or folder_of(other) == folder:
            for word in DECLARED[other] & used:
                homes[word].add(other)
    # What a .c file's own header includes is there for the file, too.
    has = INCLUDES[name] | {name} | INCLUDES.get(f"{unit_of(name)}.h", set())
    assert {word for word in homes if not homes[word] & has} == set()
