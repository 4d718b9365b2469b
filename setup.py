"""Builds the C core, the Cython extensions and the list of packages.

In:  csrc/ (the C core), engine/_native/*.pyx (its Python gateway), engine/ and data/ (packages).
Out: static libraries, one for each instruction set; the extension engine3d._native._core, which
     holds the core and the modules engine3d._native.*; the packages engine3d.*.

The flags and the core's files are in csrc/build_rules.py. A file is compiled again when its command
has changed or a file that it includes, which the compiler lists beside the object.
ENGINE3D_BUILD=release|debug|profile|asan|tsan|msan chooses the kind of build, each in its own
folder.
Everything that is not a rule of the build (name, version, extras) is in pyproject.toml; what the
package needs depends on the system, and its addresses on the repository: both are here.
"""

import json
import os
import re
import shlex
import subprocess
import sys
import sysconfig
import tempfile
import zlib
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from pathlib import Path

from setuptools import Extension, setup
from setuptools._distutils.sysconfig import get_python_inc
from setuptools.command.build import build
from setuptools.command.build_clib import build_clib
from setuptools.command.build_ext import build_ext

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "csrc"))
from build_rules import (
    BUILD,
    GATEWAY_FLAGS,
    INCLUDE_DIRS,
    IS_WINDOWS,
    SANITIZERS,
    STRIPPED,
    WINDOWS_FLAGS,
    hardened_flags,
    link_flags,
    static_libraries,
    usable_processors,
)
from mirrors import write_mirrors
from stubs import write_stub

# Before 11.2.1, Pillow wrote opaque GIFs wrong from the second frame on. Not those that mend holes,
# since others hold back the newest: `engine3d info --system` names the holes.
REQUIREMENTS = ["numpy>=1.23", "pillow>=11.2.1", "pysdl2>=0.9.16", "rich>=13"]
# The window's SDL. There is none for musl and for Windows on AArch64: the window wants the system's
# there, all else nothing.
SDL = "pysdl2-dll>=2.28"
WITHOUT_SDL = re.compile(r"musl|win-arm64")
NATIVE = "engine3d._native"
CORE_MODULE = f"{NATIVE}._core"
# What Cython would otherwise write into every module, such as the code of memoryviews.
COMMON_MODULE = f"{NATIVE}._common"
# Modules of CPython's limited API serve all later versions, too: one wheel for each machine. Typed
# memoryviews need that of 3.11. Interpreters without a global lock have no such API.
OLDEST = (3, 11)
IS_LIMITED = sys.version_info >= OLDEST and not sysconfig.get_config_var("Py_GIL_DISABLED")
LIMITED_API = [("Py_LIMITED_API", f"0x{OLDEST[0]:02X}{OLDEST[1]:02X}0000")] if IS_LIMITED else []
WHEEL = {"py_limited_api": f"cp{OLDEST[0]}{OLDEST[1]}"} if IS_LIMITED else {}
# The kernels called one by one, for tests and benchmarks: built in place only, or on request.
TESTING_MODULE = f"{NATIVE}.kernels_testing"


# What a package's page links to -> where GitHub has it below the repository.
PAGES = {
    "Source": "",
    "Documentation": "/blob/HEAD/docs/index.md",
    "Changelog": "/blob/HEAD/CHANGELOG.md",
    "Issues": "/issues",
}


def requirements():
    """The packages that engine3d needs at run time, where it is built for."""
    names = [sysconfig.get_config_var(name) or "" for name in ("SOABI", "HOST_GNU_TYPE")]
    has_sdl = not WITHOUT_SDL.search(" ".join([sysconfig.get_platform(), *names]))
    return [*REQUIREMENTS, SDL] if has_sdl else REQUIREMENTS


def repository():
    """The address of the repository that releases the package; empty if it is unknown.

    The source lies wherever it was copied to. ENGINE3D_REPOSITORY says where this copy does.
    """
    address = os.environ.get("ENGINE3D_REPOSITORY", "").rstrip("/")
    if address and not address.startswith("https://"):
        raise SystemExit(f"ENGINE3D_REPOSITORY={address}: expected https://...")
    return address


def project_urls():
    """The addresses that the package names."""
    address = repository()
    return {name: f"{address}{page}" for name, page in PAGES.items()} if address else {}


def description():
    """README.md, in which links and pictures of the source lead to the repository, if it is known.

    PyPI shows it on a page of its own, beside which there are no other files.
    """
    text = Path("README.md").read_text("utf-8")
    address = repository()
    if not address:
        return text
    return re.sub(
        r"(!?)\[[^]]*\]\((?!\w+:|#)",
        lambda link: f"{link[0]}{address}/{'raw' if link[1] else 'blob'}/HEAD/",
        text,
    )


# Untested: setuptools' own choice on Windows does not know the flags of clang. This one calls what
# CC names.
DEFAULT_COMPILER = "mingw32" if os.name == "nt" else None

# What to install, by the name of a system and by what is missing.
COMPILERS = {
    "linux": "gcc or clang (Debian, Ubuntu: apt-get install gcc libc6-dev; "
    "Fedora: dnf install gcc; Alpine: apk add gcc musl-dev)",
    "darwin": "clang (xcode-select --install)",
    "win32": "clang of MSYS2 or llvm-mingw, and set CC=clang",
}
# Words of the error in csrc/base/windows/memory.h.
UNALIGNED = "does not align the stack"
HEADERS = "Debian, Ubuntu: apt-get install python3-dev; Fedora: dnf install python3-devel; "
HEADERS += "Alpine: apk add python3-dev"
# Compiles where a compiler, the headers of C and those of Python are there.
PROBE = "#include <Python.h>\n#include <math.h>\n"

PACKAGE_DIR = {"engine3d": "engine", "engine3d.data": "data", "engine3d.lessons": "lessons"}
DATA_PACKAGES = ["engine3d.data", "engine3d.lessons"]
DATA_SUFFIXES = ["obj", "mtl", "tga", "webp", "asc", "md", "ttf", "txt", "po"]
# What desktops and `man` look for below the prefix -> the file of data/desktop that goes there.
DESKTOP_FILES = {
    "share/applications": "engine3d.desktop",
    "share/icons/hicolor/scalable/apps": "engine3d.svg",
    "share/man/man1": "engine3d.1",
    "share/metainfo": "engine3d.metainfo.xml",
    "share/mime/packages": "engine3d.xml",
    "share/thumbnailers": "engine3d.thumbnailer",
}
# Models that nothing in the package draws: in the source, but not in the wheel.
SOURCE_ONLY = ["models/globe.obj", "models/globe.mtl", "models/globe_stand.*", "models/nautilus*"]


def build_base():
    """The build folder of this kind of build and compiler: none reuses another's objects."""
    names = ("CC", "CFLAGS", "CPPFLAGS", "LDFLAGS", "ENGINE3D_TARGET")
    settings = [os.environ.get(name, "") for name in names]
    suffix = f"-{zlib.crc32(repr(settings).encode()):08x}" if any(settings) else ""
    return f"build/{BUILD}{suffix}"


def extensions():
    """One extension of all .pyx files of engine/_native but one, which is another."""
    parts = {CORE_MODULE: []}
    for path in sorted(Path("engine/_native").glob("*.pyx")):
        name = TESTING_MODULE if module_of(path) == TESTING_MODULE else CORE_MODULE
        parts.setdefault(name, []).append(str(path))
    return [
        Extension(
            name,
            sources,
            include_dirs=INCLUDE_DIRS,
            define_macros=[("E3D_BUILD", f'"{BUILD}"'), *LIMITED_API],
            py_limited_api=IS_LIMITED,
            # build_ext lists the static libraries once more after these, so their order is free.
            libraries=[*(library for library, _ in static_libraries()), "m"],
            extra_compile_args=[*hardened_flags(), *GATEWAY_FLAGS.get(BUILD, [])],
            extra_link_args=[*link_flags(), *STRIPPED.get(BUILD, []), *SANITIZERS.get(BUILD, [])],
        )
        for name, sources in parts.items()
    ]


def module_of(source):
    """The name of the module that a .pyx file becomes."""
    return f"{NATIVE}.{Path(source).stem}"


def packages():
    """The folders of engine/ that hold an __init__.py, as engine3d.*, and what is data."""
    folders = sorted(path.parent for path in Path("engine").rglob("__init__.py"))
    return [".".join(("engine3d", *folder.parts[1:])) for folder in folders] + DATA_PACKAGES


class CompilerError(SystemExit):
    """What ends a build, in one line."""

    def __init__(self, text):
        super().__init__(f"error: engine3d cannot be compiled: {text}")


def no_compiler(name, error):
    """Return the error that tells what to install where a program does not run."""
    advice = COMPILERS.get(sys.platform, "gcc or clang (cc of this system)")
    return CompilerError(f"{name!r}: {error.strerror}. Install {advice}")


def run_compiler(command, **_):
    """Run a compiler, an archiver or a linker: prints what it says, and not the command."""
    try:
        done = subprocess.run(command, capture_output=True, encoding="utf-8", errors="replace")
    except OSError as error:
        raise no_compiler(command[0], error) from None
    sys.stderr.write(done.stdout + done.stderr)
    if done.returncode != 0:
        if "Python.h" in done.stderr:
            raise CompilerError(f"Python's header files are missing. {HEADERS}")
        if UNALIGNED in done.stderr:
            raise CompilerError(f"gcc {UNALIGNED} on Windows. Install {COMPILERS['win32']}")
        files = ", ".join(word for word in command if word.endswith((".c", ".a", ".so")))
        raise CompilerError(f"{command[0]!r} failed at {files}; what it said stands above")


def prepare(compiler):
    """Let one of setuptools' compilers run its commands with `run_compiler`."""
    compiler.call = compiler.spawn = run_compiler  # older ones say spawn


def check_compiler(compiler):
    """Raise `CompilerError` unless a file compiles that includes what all need."""
    includes = {f"-I{get_python_inc(plat_specific=specific)}" for specific in (False, True)}
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, "probe.c")
        source.write_text(PROBE, "utf-8")
        output = ["-o", os.path.join(folder, "probe.o")]
        flags = [*sorted(includes), *(WINDOWS_FLAGS if IS_WINDOWS else [])]
        run_compiler([*compiler.compiler_so, *flags, "-c", str(source), *output])


class Build(build):
    """Keeps each kind of build in its own folder, and nothing there of modules since deleted."""

    def initialize_options(self):
        super().initialize_options()
        self.build_base = build_base()

    def finalize_options(self):
        # An editable install would have its objects in a folder that is thrown away.
        self.build_temp = os.path.join(self.build_base, f"objects-{sys.implementation.cache_tag}")
        super().finalize_options()

    def run(self):
        # First, or a thousand lines about files that are copied would stand before what it says.
        self.run_command("build_clib")
        super().run()
        # A wheel takes the whole folder, with what an earlier build left there.
        commands = [self.get_finalized_command(name) for name in ("build_py", "build_ext")]
        made = {os.path.abspath(path) for command in commands for path in command.get_outputs()}
        for path in Path(self.build_lib).absolute().rglob("*"):
            if path.is_file() and str(path) not in made:
                path.unlink()


class BuildStaticLibraries(build_clib):
    """Compiles only the files that are out of date, in parallel."""

    def finalize_options(self):
        super().finalize_options()
        self.compiler = self.compiler or DEFAULT_COMPILER

    def run(self):
        try:
            super().run()
        except FileNotFoundError as error:  # MinGW is asked for its version at once
            raise no_compiler(error.filename, error) from None

    def build_libraries(self, libraries):
        prepare(self.compiler)
        check_compiler(self.compiler)
        jobs = [(source, info) for _, info in libraries for source in info["sources"]]
        run_in_parallel(self.compile_one, sorted(jobs, key=lambda job: "kernels" not in job[0]))
        for name, build_info in libraries:
            self.archive(name, build_info["sources"])

    def compile_one(self, source, build_info):
        compile_changed(
            self.compiler,
            source,
            self.build_temp,
            macros=build_info["macros"],
            include_dirs=build_info["include_dirs"],
            flags=build_info["cflags"],
        )

    def archive(self, name, sources):
        # ar adds to an archive that exists: one made anew holds no object of a file since deleted.
        archive = Path(self.compiler.library_filename(name, output_dir=self.build_clib))
        objects = self.compiler.object_filenames(sources, output_dir=self.build_temp)
        command = [*self.compiler.archiver, *objects]
        if not is_current(archive, objects, command):
            archive.unlink(missing_ok=True)
            self.compiler.create_static_lib(objects, name, output_dir=self.build_clib)
            note_command(archive, command)


class BuildExtensions(build_ext):
    """Translates the .pyx files that are out of date, compiles and links them, in parallel."""

    def finalize_options(self):
        super().finalize_options()
        self.compiler = self.compiler or DEFAULT_COMPILER
        self.stubs = []
        # build_ext would compile an extension after the other, and translate .pyx files itself.
        self.parallel = False
        if not (self.inplace or os.environ.get("ENGINE3D_TESTING")):
            self.extensions = [e for e in self.extensions if e.name != TESTING_MODULE]

    def run(self):
        self.run_command("build_clib")
        super().run()

    def build_extensions(self):
        prepare(self.compiler)
        write_mirrors(self.mirrors())
        jobs = [(e, module_of(source), source) for e in self.extensions for source in e.sources]
        jobs.sort(key=lambda job: -os.path.getsize(job[2]))
        for _, _, source in jobs:
            write_stub(source, self.stub_of(source))
            self.stubs.append(self.stub_of(source))
        common = [(e, COMMON_MODULE, None) for e in self.extensions if e.name == CORE_MODULE]
        run_in_parallel(self.make_object, [*common, *jobs])
        for extension in self.extensions:
            extension.sources = []
            extension.extra_objects.sort()
        super().build_extensions()

    def get_outputs(self):
        # With the stubs, which are made before the extensions forget their sources.
        return [*super().get_outputs(), *self.stubs]

    def copy_extensions_to_source(self):
        # Those of a single version of Python, from an earlier build, would be imported instead.
        for extension in self.extensions:
            for path in Path("engine/_native").glob(f"{extension.name.rpartition('.')[2]}.*.so"):
                path.unlink()
        super().copy_extensions_to_source()
        for stub in self.stubs:
            self.copy_file(stub, "engine/_native")

    def stub_of(self, source):
        """Where the stub of a .pyx file goes: beside the library that holds its module."""
        library = self.get_ext_fullpath(CORE_MODULE)
        return os.path.join(os.path.dirname(library), f"{Path(source).stem}.pyi")

    def mirrors(self):
        """The folder of what Cython knows of the core's headers."""
        return os.path.join(self.build_temp, "mirrors")

    def make_object(self, extension, name, source):
        """Add the object of module `name` to those that `extension` links."""
        folder = Path(self.build_temp, "engine", "_native")
        target = folder / f"{name.rpartition('.')[2]}.c"
        translated = translate_changed(name, source, target, ["engine/_native/pxd", self.mirrors()])
        target = compile_changed(
            self.compiler,
            str(translated),
            "",
            macros=extension.define_macros,
            include_dirs=[*extension.include_dirs, *self.include_dirs, self.mirrors()],
            flags=extension.extra_compile_args,
        )
        extension.extra_objects.append(target)

    def get_ext_filename(self, fullname):
        # setuptools takes the name that the building machine's Python would look for.
        name = super().get_ext_filename(fullname)
        return f"{name.partition('.')[0]}.pyd" if IS_WINDOWS and IS_LIMITED else name

    def build_extension(self, extension):
        library = self.get_finalized_command("build_clib")
        archives = [
            library.compiler.library_filename(name, output_dir=library.build_clib)
            for name, _ in self.distribution.libraries
        ]
        module = self.get_ext_fullpath(extension.name)
        # The linker is called where an object is newer than the module, or there is no module.
        if not is_newer(
            module, [*extension.extra_objects, *archives, "setup.py", "csrc/build_rules.py"]
        ):
            Path(module).unlink(missing_ok=True)
        try:
            super().build_extension(extension)
        except BaseException:
            Path(module).unlink(missing_ok=True)  # a linker may leave an empty file
            raise


def run_in_parallel(function, jobs):
    """Call `function(*job)` for each job, on all processors; raise what the first one raises."""
    with ThreadPoolExecutor(usable_processors()) as pool:
        jobs = [pool.submit(function, *job) for job in jobs]
        done, others = wait(jobs, return_when=FIRST_EXCEPTION)
        for job in others:
            job.cancel()
        for job in done:
            job.result()


def translate_changed(name, source, target, include_dirs):
    """Translate `source`, the .pyx file of module `name`, unless it was; return the C file.

    include_dirs: where .pxd files are. The module of what the others have in common has no source.
    """
    import Cython

    command = [sys.executable, "-m", "cython", "--module-name", name]
    if source is None:
        command += ["--generate-shared", str(target)]
    else:
        # Annotations are for stubs alone: what C cannot say of a type is not checked.
        command += ["-3", "-X", "embedsignature=True", "-X", "annotation_typing=False", "--depfile"]
        # Plain methods of C: those that look like Python's take longer to call.
        command += ["-X", "binding=False"]
        command += [word for folder in include_dirs for word in ("-I", folder)]
        command += ["--shared", COMMON_MODULE, source, "-o", str(target)]
    # A build in isolation has a Cython of its own each time, so its version stands for its files.
    noted = [Cython.__version__, *command[1:]]
    needs = [path for path in prerequisites(f"{target}.dep") if not path.startswith("..")]
    if not is_current(target, needs, noted):
        target.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(command, check=True)
        note_command(target, noted)
    return target


def compile_changed(compiler, source, folder, *, macros, include_dirs, flags):
    """Compile the C file `source`, unless it was; return the path of the object."""
    (target,) = compiler.object_filenames([source], output_dir=folder)
    flags = [*flags, "-MMD", "-MF", f"{target}.dep"]
    command = [*compiler.compiler_so, *map(str, macros), *include_dirs, *flags]
    if not is_current(target, prerequisites(f"{target}.dep"), command):
        Path(target).parent.mkdir(parents=True, exist_ok=True)
        compiler.compile(
            [source],
            output_dir=folder,
            macros=macros,
            include_dirs=include_dirs,
            extra_postargs=flags,
        )
        note_command(target, command)
    return target


def prerequisites(rule):
    """The files that a rule for make, as compilers write them, names; none if it isn't there."""
    if not os.path.exists(rule):
        return []
    text = Path(rule).read_text("utf-8").replace("\\\n", " ")
    return shlex.split(text.partition(": ")[2])


def is_newer(target, needs):
    """Whether the file `target` is there, and nothing that `needs` names was changed after it."""
    try:
        made = os.path.getmtime(target)
        return all(os.path.getmtime(path) <= made for path in needs)
    except FileNotFoundError:
        return False


def is_current(target, needs, command):
    """Whether `target` was made by `command` from what `needs` names, unchanged since."""
    noted = Path(f"{target}.command")
    made_so = noted.exists() and noted.read_text("utf-8") == json.dumps(command)
    return made_so and is_newer(target, needs)


def note_command(target, command):
    """Note beside `target` how it was made, for `is_current`."""
    Path(f"{target}.command").write_text(json.dumps(command), "utf-8")


if __name__ == "__main__":
    setup(
        packages=packages(),
        package_dir=PACKAGE_DIR,
        package_data={
            "engine3d": ["py.typed", "*.pyi"],
            "engine3d._native": ["*.pyi"],
            "engine3d.apps.golden": ["*.html"],
            "engine3d.apps.learn": ["*.html"],
            "engine3d.data": [f"**/*.{suffix}" for suffix in DATA_SUFFIXES],
            # Text only: their pictures are in docs/course, and are drawn anew by whoever runs them.
            "engine3d.lessons": ["*.c", "*.obj", "*.asc", "[0-9]*.md"],
        },
        data_files=[
            (folder, [f"data/desktop/{name}"])
            for folder, name in DESKTOP_FILES.items()
            if not IS_WINDOWS
        ],
        include_package_data=False,
        exclude_package_data={
            "engine3d._native": ["kernels_testing.pyi"],
            "engine3d.data": SOURCE_ONLY,
        },
        long_description=description(),
        long_description_content_type="text/markdown",
        install_requires=requirements(),
        project_urls=project_urls(),
        options={"bdist_wheel": WHEEL},
        libraries=static_libraries(),
        ext_modules=extensions(),
        cmdclass={
            "build": Build,
            "build_clib": BuildStaticLibraries,
            "build_ext": BuildExtensions,
        },
    )
