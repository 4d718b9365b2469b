"""Builds the C core, the Cython extensions and the list of packages.

In:  csrc/ (the C core), engine/_native/*.pyx (its Python gateway), engine/ and data/ (packages).
Out: static libraries, one for each instruction set; engine3d._native.*, each extension linked with
     all of them; the packages engine3d.*.

Every backend must give the same bytes, hence these rules. The flags below come after the user's
CFLAGS. The baseline is plain x86-64, so that only the ISA files hold code that an old CPU lacks.
Every file of csrc/ is a dependency of every object: an edited .inl rebuilds what includes it.
ENGINE3D_BUILD=release|debug|profile|asan|tsan chooses the kind of build, each in its own folder.
Everything that is not a rule of the build (name, version, dependencies) is in pyproject.toml.
"""

import os
import sysconfig
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build import build
from setuptools.command.build_clib import build_clib
from setuptools.command.build_ext import build_ext

BUILDS = {
    "release": ["-O3", "-g0", "-DNDEBUG"],
    "debug": ["-Og", "-g", "-UNDEBUG"],
    "profile": ["-O3", "-g", "-DNDEBUG", "-fno-omit-frame-pointer"],
    "asan": ["-O1", "-g", "-UNDEBUG", "-fno-omit-frame-pointer"],
    "tsan": ["-O1", "-g", "-UNDEBUG", "-fno-omit-frame-pointer"],
}
SANITIZERS = {
    "asan": ["-fsanitize=address,undefined", "-fno-sanitize-recover=undefined"],
    "tsan": ["-fsanitize=thread"],
}
ISA_FLAGS = {
    "sse41": ["-msse4.1"],
    "avx2": ["-mavx2"],
    "avx512": ["-mavx512f", "-mavx512cd", "-mavx512bw", "-mavx512dq", "-mavx512vl"],
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

BUILD = os.environ.get("ENGINE3D_BUILD") or "release"
IS_X86_64 = sysconfig.get_platform().endswith(("x86_64", "amd64"))

PACKAGE_DIR = {"engine3d": "engine", "engine3d.data": "data"}
DATA_SUFFIXES = ["obj", "mtl", "tga", "png", "jpg", "asc", "json", "txt", "md"]


def common_flags():
    """The flags of every C file, whichever library or extension it belongs to."""
    if BUILD not in BUILDS:
        raise SystemExit(f"ENGINE3D_BUILD={BUILD}: expected one of {', '.join(BUILDS)}")
    baseline = ["-march=x86-64", "-mtune=generic"] if IS_X86_64 else []
    return [*baseline, *BUILDS[BUILD], *EXACT, *HYGIENE, *SANITIZERS.get(BUILD, [])]


def build_base():
    """The build folder of this kind of build and compiler: none reuses another's objects."""
    settings = [os.environ.get(name, "") for name in ("CC", "CFLAGS", "CPPFLAGS", "LDFLAGS")]
    suffix = f"-{zlib.crc32(repr(settings).encode()):08x}" if any(settings) else ""
    return f"build/{BUILD}{suffix}"


def c_dependencies():
    """Every file of csrc/, and this file, whose flags the objects depend on."""
    return ["setup.py", *sorted(str(path) for path in Path("csrc").rglob("*") if path.is_file())]


def static_libraries():
    """The (name, build_info) pairs that `build_clib` compiles; the ISA files only on x86-64."""
    sources = {
        "e3d_core": ["csrc/core/*.c", "csrc/pipeline/*.c", "csrc/kernels/dispatch.c"],
        "e3d_reference": ["csrc/reference/*.c"],
        "e3d_canvas": ["csrc/canvas/*.c"],
        "e3d_images": ["csrc/images/*.c"],
        "e3d_navigation": ["csrc/navigation/*.c"],
        "e3d_scene": ["csrc/scene/*.c"],
        "e3d_loaders": ["csrc/loaders/*.c"],
        "e3d_writers": ["csrc/writers/*.c"],
    }
    sources["e3d_core"].append("csrc/kernels/isa_portable.c")
    isa_flags = {}
    if IS_X86_64:
        sources.update({f"e3d_{isa}": [f"csrc/kernels/isa_{isa}.c"] for isa in ISA_FLAGS})
        isa_flags = {f"e3d_{isa}": flags for isa, flags in ISA_FLAGS.items()}
    libraries = []
    for name, patterns in sources.items():
        files = sorted(str(path) for pattern in patterns for path in Path().glob(pattern))
        if not files:
            continue
        build_info = {
            "sources": files,
            "include_dirs": INCLUDE_DIRS,
            "macros": [("E3D_HAVE_X86", "1")] if IS_X86_64 else [],
            "obj_deps": {"": c_dependencies()},
            "cflags": [*WARNINGS, *common_flags(), *isa_flags.get(name, [])],
        }
        libraries.append((name, build_info))
    return libraries


def extensions():
    """One extension for each .pyx of engine/_native, before Cython has translated it."""
    return [
        Extension(
            f"engine3d._native.{path.stem}",
            [str(path)],
            include_dirs=INCLUDE_DIRS,
            # build_ext lists the static libraries once more after these, so their order is free.
            libraries=[*(name for name, _ in static_libraries()), "m"],
            extra_compile_args=common_flags(),
            extra_link_args=["-pthread", *SANITIZERS.get(BUILD, [])],
            depends=c_dependencies(),
        )
        for path in sorted(Path("engine/_native").glob("*.pyx"))
    ]


def packages():
    """The folders of engine/ that hold an __init__.py, as engine3d.*, and engine3d.data."""
    folders = sorted(path.parent for path in Path("engine").rglob("__init__.py"))
    return [".".join(("engine3d", *folder.parts[1:])) for folder in folders] + ["engine3d.data"]


class Build(build):
    """Keeps each kind of build in its own folder, and nothing there of modules since deleted."""

    def initialize_options(self):
        super().initialize_options()
        self.build_base = build_base()

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

    def build_libraries(self, libraries):
        with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
            jobs = [
                pool.submit(self.compile_one, source, build_info)
                for _, build_info in libraries
                for source in build_info["sources"]
            ]
            for job in jobs:
                job.result()
        for name, build_info in libraries:
            self.archive(name, build_info["sources"])

    def compile_one(self, source, build_info):
        (target,) = self.compiler.object_filenames([source], output_dir=self.build_temp)
        if not self.force and is_newer(target, [source, *build_info["obj_deps"][""]]):
            return
        Path(target).parent.mkdir(parents=True, exist_ok=True)
        self.compiler.compile(
            [source],
            output_dir=self.build_temp,
            macros=build_info["macros"],
            include_dirs=build_info["include_dirs"],
            extra_postargs=build_info["cflags"],
        )

    def archive(self, name, sources):
        # ar adds to an archive that exists: one made anew holds no object of a file since deleted.
        archive = self.compiler.library_filename(name, output_dir=self.build_clib)
        Path(archive).unlink(missing_ok=True)
        objects = self.compiler.object_filenames(sources, output_dir=self.build_temp)
        self.compiler.create_static_lib(objects, name, output_dir=self.build_clib)


class BuildExtensions(build_ext):
    """Translates the .pyx files, and builds the static libraries first also when run by itself."""

    def finalize_options(self):
        from Cython.Build import cythonize

        if self.distribution.ext_modules:
            self.distribution.ext_modules = cythonize(
                self.distribution.ext_modules,
                include_path=["csrc/pxd"],
                build_dir="build/cython",
                compiler_directives={"language_level": "3", "embedsignature": True},
            )
        super().finalize_options()
        self.parallel = self.parallel or len(os.sched_getaffinity(0))

    def run(self):
        self.run_command("build_clib")
        super().run()


def is_newer(target, sources):
    """Whether the file `target` exists and none of the `sources` was changed after it."""
    if not os.path.exists(target):
        return False
    made = os.path.getmtime(target)
    return all(os.path.getmtime(source) <= made for source in sources)


if __name__ == "__main__":
    setup(
        packages=packages(),
        package_dir=PACKAGE_DIR,
        package_data={
            "engine3d": ["py.typed", "*.pyi"],
            "engine3d._native": ["*.pyi"],
            "engine3d.data": [f"**/*.{suffix}" for suffix in DATA_SUFFIXES],
        },
        include_package_data=False,
        libraries=static_libraries(),
        ext_modules=extensions(),
        cmdclass={
            "build": Build,
            "build_clib": BuildStaticLibraries,
            "build_ext": BuildExtensions,
        },
    )
