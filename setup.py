"""Builds the C core, the Cython extensions and the list of packages.

In:  csrc/ (the C core), engine/_native/*.pyx (its Python gateway), engine/ and data/ (packages).
Out: static libraries, one for each instruction set; the extension engine3d._native._core, which
     holds the core and the modules engine3d._native.*; the packages engine3d.*.

Every backend must give the same bytes, hence these rules. The flags below come after the user's
CFLAGS. The baseline is plain x86-64, so that only the ISA files hold code that an old CPU lacks.
A file is compiled again when its command has changed or a file that it includes, which the compiler
lists beside the object.
ENGINE3D_BUILD=release|debug|profile|asan|tsan|msan chooses the kind of build, each in its own
folder.
Everything that is not a rule of the build (name, version, extras) is in pyproject.toml; what the
package needs depends on the system, and is here.
"""

import json
import os
import re
import shlex
import subprocess
import sys
import sysconfig
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build import build
from setuptools.command.build_clib import build_clib
from setuptools.command.build_ext import build_ext

# A release has nothing that only debuggers and profilers read: neither unwind tables nor symbols.
BUILDS = {
    "release": ["-O3", "-g0", "-DNDEBUG", "-fno-asynchronous-unwind-tables"],
    "debug": ["-Og", "-g", "-UNDEBUG"],
    "profile": ["-O3", "-g", "-DNDEBUG", "-fno-omit-frame-pointer"],
    "asan": ["-O1", "-g", "-UNDEBUG", "-fno-omit-frame-pointer"],
    "tsan": ["-O1", "-g", "-UNDEBUG", "-fno-omit-frame-pointer"],
    "msan": ["-O1", "-g", "-UNDEBUG", "-fno-omit-frame-pointer"],
}
# What Cython writes checks arguments and calls the core: optimised for speed, it would be little
# faster and much larger.
GATEWAY_FLAGS = {"release": ["-Os"], "profile": ["-Os"]}
SANITIZERS = {
    "asan": ["-fsanitize=address,undefined", "-fno-sanitize-recover=undefined"],
    "tsan": ["-fsanitize=thread"],
    "msan": ["-fsanitize=memory"],
}
WARNINGS = ["-Wall", "-Wextra"]
INCLUDE_DIRS = ["csrc/include", "csrc"]
# What CFLAGS may hold that would change results is taken back: -ffast-math, -Ofast, -march=native,
# contraction to FMA, and link-time optimisation (which mixes the ISAs).
EXACT = ["-fno-fast-math", "-fno-unsafe-math-optimizations", "-ffp-contract=off", "-fno-math-errno"]
# Python's own flags let signed numbers wrap around. Here they must not, which sanitizers check.
HYGIENE = [
    "-std=gnu11",
    "-fstrict-overflow",
    "-fPIC",
    "-fvisibility=hidden",
    "-fno-lto",
    "-pthread",
]
# Outside the kernels, where files and callers' arrays are read.
HARDENING = ["-fstack-protector-strong", "-U_FORTIFY_SOURCE", "-D_FORTIFY_SOURCE=2"]
LINK_FLAGS = ["-pthread"]
ELF_LINK_FLAGS = ["-Wl,-z,relro,-z,now"]
STRIPPED = {"release": ["-s"]}
REQUIREMENTS = ["numpy>=1.23", "pillow>=12.3", "pysdl2>=0.9.16", "rich>=13"]
# The window's SDL. There is none for musl: the window wants the system's there, all else nothing.
SDL = "pysdl2-dll>=2.28"
NATIVE = "engine3d._native"
CORE_MODULE = f"{NATIVE}._core"
# What Cython would otherwise write into every module, such as the code of memoryviews.
COMMON_MODULE = f"{NATIVE}._common"
# The kernels called one by one, for tests and benchmarks: built in place only, or on request.
TESTING_MODULE = f"{NATIVE}.kernels_testing"


def isa_flags(machine):
    """The flags of each set of SIMD kernels for `machine`, from the core's own list of backends.

    machine: as in `MACHINE`.
    """
    header = Path(__file__).with_name("csrc") / "include" / "e3d_backends.h"
    _, _, rows = header.read_text("utf-8").partition(f"#define E3D_EACH_{machine}_BACKEND(X)")
    rows = rows.partition("\n\n")[0].split("X(E3D_BACKEND_")[1:]
    flags = {}
    for row in rows:
        name = re.match(r"\w+, (\w+)", row)[1]
        flags[name] = [f"-m{instructions}" for instructions in re.findall(r'HAS\("(.+?)"\)', row)]
    return flags


def machine_of(platform):
    """X86 or AARCH64, as the core calls them, or an empty text: of a name of a platform."""
    names = {"X86": r"x86_64|amd64", "AARCH64": r"aarch64(?!_be)|arm64"}
    return next((name for name, pattern in names.items() if re.search(pattern, platform)), "")


def is_windows(platform):
    """Whether a name of a platform, as Python or a compiler has it, is one of Windows."""
    return platform.startswith("win") or "windows" in platform or "mingw" in platform


def requirements():
    """The packages that engine3d needs at run time, where it is built for."""
    names = [sysconfig.get_config_var(name) or "" for name in ("SOABI", "HOST_GNU_TYPE")]
    return REQUIREMENTS if "musl" in "".join(names) else [*REQUIREMENTS, SDL]


BUILD = os.environ.get("ENGINE3D_BUILD") or "release"
# What the built code runs on: of the rest, the kernels are portable only.
MACHINE = machine_of(sysconfig.get_platform())
IS_WINDOWS = is_windows(sysconfig.get_platform())

# Untested: setuptools' own choice on Windows does not know the flags of gcc and clang.
DEFAULT_COMPILER = "mingw32" if IS_WINDOWS else None

PACKAGE_DIR = {"engine3d": "engine", "engine3d.data": "data", "engine3d.lessons": "lessons"}
DATA_PACKAGES = ["engine3d.data", "engine3d.lessons"]
DATA_SUFFIXES = ["obj", "mtl", "tga", "webp", "asc", "md"]
# Models that nothing in the package draws: in the source, but not in the wheel.
SOURCE_ONLY = ["models/globe.obj", "models/globe.mtl", "models/globe_stand.*", "models/nautilus*"]


def common_flags():
    """The flags of every C file, the kernels too."""
    if BUILD not in BUILDS:
        raise SystemExit(f"ENGINE3D_BUILD={BUILD}: expected one of {', '.join(BUILDS)}")
    baseline = ["-march=x86-64", "-mtune=generic"] if MACHINE == "X86" else []
    if IS_WINDOWS:
        baseline += ["-include", "csrc/windows/memory.h"]
    return [*baseline, *BUILDS[BUILD], *EXACT, *HYGIENE, *SANITIZERS.get(BUILD, [])]


def hardened_flags():
    """The flags of what isn't a kernel; sanitizers watch the same and more by themselves."""
    return [*common_flags(), *([] if BUILD in SANITIZERS else HARDENING)]


def link_flags():
    """The flags of the linker; those of ELF are for Linux."""
    is_elf = sysconfig.get_platform().startswith("linux")
    return [*LINK_FLAGS, *(ELF_LINK_FLAGS if is_elf else [])]


def build_base():
    """The build folder of this kind of build and compiler: none reuses another's objects."""
    names = ("CC", "CFLAGS", "CPPFLAGS", "LDFLAGS", "ENGINE3D_TARGET")
    settings = [os.environ.get(name, "") for name in names]
    suffix = f"-{zlib.crc32(repr(settings).encode()):08x}" if any(settings) else ""
    return f"build/{BUILD}{suffix}"


def static_libraries():
    """The (name, build_info) pairs that `build_clib` compiles; the ISA files of one machine."""
    sources = {
        "e3d_core": [
            "csrc/core/*.c",
            "csrc/pipeline/*/*.c",
            "csrc/kernels/dispatch.c",
            "csrc/ui/*.c",
            "csrc/posing/*.c",
            "csrc/bloom/*.c",
            "csrc/occlusion/*.c",
        ],
        "e3d_portable": ["csrc/kernels/isa_portable.c"],
        "e3d_reference": ["csrc/reference/*.c"],
        "e3d_canvas": ["csrc/canvas/*.c"],
        "e3d_environment": ["csrc/environment/*.c"],
        "e3d_images": ["csrc/images/*.c"],
        "e3d_navigation": ["csrc/navigation/*.c"],
        "e3d_pyrender": ["csrc/pyrender/*.c"],
        "e3d_scene": ["csrc/scene/*.c"],
        "e3d_loaders": ["csrc/loaders/*.c"],
        "e3d_writers": ["csrc/writers/*.c"],
    }
    kernel_flags = {"e3d_portable": []}
    for isa, flags in isa_flags(MACHINE).items():
        sources[f"e3d_{isa}"] = [f"csrc/kernels/isa_{isa}.c"]
        kernel_flags[f"e3d_{isa}"] = flags
    libraries = []
    for name, patterns in sources.items():
        files = sorted(str(path) for pattern in patterns for path in Path().glob(pattern))
        if not files:
            continue
        is_kernel = name in kernel_flags
        flags = [*common_flags(), *kernel_flags[name]] if is_kernel else hardened_flags()
        build_info = {
            "sources": files,
            "include_dirs": INCLUDE_DIRS,
            "macros": [(f"E3D_HAVE_{MACHINE}", "1")] if MACHINE else [],
            "cflags": [*WARNINGS, *flags],
        }
        libraries.append((name, build_info))
    return libraries


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

    def build_libraries(self, libraries):
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
        if not is_current(archive, objects, objects):
            archive.unlink(missing_ok=True)
            self.compiler.create_static_lib(objects, name, output_dir=self.build_clib)
            note_command(archive, objects)


class BuildExtensions(build_ext):
    """Translates the .pyx files that are out of date, compiles and links them, in parallel."""

    def finalize_options(self):
        super().finalize_options()
        self.compiler = self.compiler or DEFAULT_COMPILER
        # build_ext would compile an extension after the other, and translate .pyx files itself.
        self.parallel = False
        if not (self.inplace or os.environ.get("ENGINE3D_TESTING")):
            self.extensions = [e for e in self.extensions if e.name != TESTING_MODULE]

    def run(self):
        self.run_command("build_clib")
        super().run()

    def build_extensions(self):
        jobs = [(e, module_of(source), source) for e in self.extensions for source in e.sources]
        jobs.sort(key=lambda job: -os.path.getsize(job[2]))
        common = [(e, COMMON_MODULE, None) for e in self.extensions if e.name == CORE_MODULE]
        run_in_parallel(self.make_object, [*common, *jobs])
        for extension in self.extensions:
            extension.sources = []
            extension.extra_objects.sort()
        super().build_extensions()

    def make_object(self, extension, name, source):
        """Add the object of module `name` to those that `extension` links."""
        folder = Path(self.build_temp, "engine", "_native")
        translated = translate_changed(name, source, folder / f"{name.rpartition('.')[2]}.c")
        target = compile_changed(
            self.compiler,
            str(translated),
            "",
            macros=extension.define_macros,
            include_dirs=[*extension.include_dirs, *self.include_dirs],
            flags=extension.extra_compile_args,
        )
        extension.extra_objects.append(target)

    def build_extension(self, extension):
        library = self.get_finalized_command("build_clib")
        archives = [
            library.compiler.library_filename(name, output_dir=library.build_clib)
            for name, _ in self.distribution.libraries
        ]
        module = self.get_ext_fullpath(extension.name)
        # The linker is called where an object is newer than the module, or there is no module.
        if not is_newer(module, [*extension.extra_objects, *archives, "setup.py"]):
            Path(module).unlink(missing_ok=True)
        super().build_extension(extension)


def run_in_parallel(function, jobs):
    """Call `function(*job)` for each job, on all processors; raise what one of them raises."""
    affinity = getattr(os, "sched_getaffinity", None)
    with ThreadPoolExecutor(len(affinity(0)) if affinity else os.cpu_count()) as pool:
        for done in [pool.submit(function, *job) for job in jobs]:
            done.result()


def translate_changed(name, source, target):
    """Translate `source`, the .pyx file of module `name`, unless it was; return the C file.

    The module of what the others have in common has no source.
    """
    import Cython

    command = [sys.executable, "-m", "cython", "--module-name", name]
    if source is None:
        command += ["--generate-shared", str(target)]
    else:
        command += ["-3", "-X", "embedsignature=True", "--depfile", "-I", "csrc/pxd"]
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
            "engine3d.golden": ["*.html"],
            "engine3d.data": [f"**/*.{suffix}" for suffix in DATA_SUFFIXES],
            # Text only: their pictures are in docs/course, and are drawn anew by whoever runs them.
            "engine3d.lessons": ["*.c", "*.obj", "*.asc"],
        },
        include_package_data=False,
        exclude_package_data={
            "engine3d._native": ["kernels_testing.pyi"],
            "engine3d.data": SOURCE_ONLY,
        },
        install_requires=requirements(),
        libraries=static_libraries(),
        ext_modules=extensions(),
        cmdclass={
            "build": Build,
            "build_clib": BuildStaticLibraries,
            "build_ext": BuildExtensions,
        },
    )
