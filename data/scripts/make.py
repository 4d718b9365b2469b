"""Make the models of engine3d.data: all of them, or only some models or files.

    python data/scripts/make.py [--output FOLDER] [teapot island.obj ...]

engine3d must be installed: the scripts use its `linalg`, so that the files come out the same, byte
for byte, on every machine. Each model is a module with a function `build`, which returns a dict of
file name to a function that makes the contents.
"""

import argparse
import importlib
from pathlib import Path

MODELS = ("teapot", "island", "globe", "nautilus", "train")


def main():
    """Write the files that the command line names."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"{', '.join(MODELS)}, or a file")
    parser.add_argument(
        "--output", type=Path, default=Path(__file__).parents[1] / "models", metavar="FOLDER"
    )
    arguments = parser.parse_args()
    files = {model: importlib.import_module(model).build() for model in MODELS}
    makers = {name: maker for model in MODELS for name, maker in files[model].items()}
    wanted = []
    for name in arguments.names or MODELS:
        if name not in files and name not in makers:
            parser.error(f"unknown model or file {name!r}")
        wanted += files.get(name, [name])
    arguments.output.mkdir(parents=True, exist_ok=True)
    for name in wanted:
        contents = makers[name]()
        (arguments.output / name).write_bytes(contents)
        print(f"{name}: {len(contents):,} bytes")


if __name__ == "__main__":
    main()
