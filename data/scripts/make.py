"""Make the models of engine3d.data, all or some of them.

    python data/scripts/make.py [NAME ...] [--output FOLDER]

engine3d must be installed: the scripts use its `linalg`, so that the files come out the same, byte
for byte, on every machine. Each model is a module with a function `build`, which returns a dict
of file name to contents.
"""

import argparse
import importlib
from pathlib import Path

MODELS = ("teapot", "island")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"any of {', '.join(MODELS)}")
    parser.add_argument(
        "--output", type=Path, default=Path(__file__).parents[1] / "models", metavar="FOLDER"
    )
    arguments = parser.parse_args()
    for name in arguments.names or MODELS:
        if name not in MODELS:
            parser.error(f"unknown model {name!r}")
        for file_name, contents in importlib.import_module(name).build().items():
            arguments.output.mkdir(parents=True, exist_ok=True)
            (arguments.output / file_name).write_bytes(contents)
            print(f"{file_name}: {len(contents):,} bytes")


if __name__ == "__main__":
    main()
