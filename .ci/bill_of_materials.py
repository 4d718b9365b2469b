"""The bill of materials of a release, as CycloneDX 1.6 has it: engine3d, its files, what it needs.

In:  the files of the release, with their hashes. Out: a text of JSON, the same for the same files.
Within a wheel's component stands what its compiler adds to engine3d's own source; the notices that
licences demand are in csrc/NOTICES.txt, which every wheel holds. `required` are the packages that
pip installs with it, of whichever version: pip chooses. The tools are of the very versions that
made the files.
"""

import json
import platform
import re
import uuid
import zipfile
from datetime import datetime, timezone
from email.parser import Parser
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

TOOLS = ("setuptools", "Cython", "ziglang")
# What is compiled into wheels: part of the file's name, component, package that brings it, licence.
COMPILED_IN = (
    (".whl", "compiler_rt of zig", "ziglang", "MIT"),
    # Its licence puts no condition on what its output holds of it.
    (".whl", "code that Cython adds", "Cython", "Apache-2.0"),
    ("-win_", "mingw-w64", "mingw-w64", "ZPL-2.1"),
    ("-win_", "winpthreads", "mingw-w64", "MIT"),
    ("-win_", "musl", "ziglang", "MIT"),
)
# Any name space will do, so long as it stays: the serial number is made of it and of the hashes.
NAMESPACE = uuid.uuid5(uuid.NAMESPACE_URL, "https://cyclonedx.org/")


def bill_of_materials(digests, wheels, seconds):
    """Return the text.

    digests: of each file's name its SHA-256. wheels: their paths. seconds: the release's time.
    """
    metadata = [metadata_of(wheel) for wheel in wheels]
    name, number = metadata[0]["Name"], metadata[0]["Version"]
    needs = {need for one in metadata for need in one.get_all("Requires-Dist", [])}
    required = sorted(need for need in needs if "extra ==" not in need)
    components = [component_of(need) for need in required]
    itself = {
        "type": "library",
        "bom-ref": f"pkg:pypi/{name}@{number}",
        "name": name,
        "version": number,
        "description": metadata[0]["Summary"],
        "licenses": [{"expression": metadata[0]["License-Expression"]}],
        "purl": f"pkg:pypi/{name}@{number}",
        "components": [file_component(file, digest) for file, digest in sorted(digests.items())],
    }
    content = {
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "serialNumber": f"urn:uuid:{uuid.uuid5(NAMESPACE, repr(sorted(digests.items())))}",
        "version": 1,
        "metadata": {
            "timestamp": datetime.fromtimestamp(seconds, timezone.utc).isoformat(),
            "tools": {"components": [tool(one, version(one)) for one in TOOLS] + [interpreter()]},
            "component": itself,
        },
        "components": components,
        "dependencies": [
            {"ref": itself["bom-ref"], "dependsOn": [one["bom-ref"] for one in components]},
        ],
    }
    return json.dumps(content, indent=2) + "\n"


def metadata_of(wheel):
    """Return the metadata that a wheel holds."""
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        return Parser().parsestr(archive.read(name).decode())


def component_of(need):
    """Return the component of a requirement, such as numpy>=1.23."""
    name = re.match(r"[\w.-]+", need)[0]
    purl = f"pkg:pypi/{re.sub(r'[-_.]+', '-', name).lower()}"
    versions = {"name": "engine3d:versions", "value": need.removeprefix(name) or "any"}
    return {
        "type": "library",
        "bom-ref": purl,
        "name": name,
        "scope": "required",
        "purl": purl,
        "properties": [versions],
    }


def file_component(name, digest):
    hashes = [{"alg": "SHA-256", "content": digest}]
    component = {"type": "file", "bom-ref": f"file:{name}", "name": name, "hashes": hashes}
    held = [compiled_in(*row) for part, *row in COMPILED_IN if part in name]
    return component | ({"components": held} if held else {})


def compiled_in(name, package, licence):
    """Return the component of what a compiler adds, as its package brings it."""
    number = mingw_version() if package == "mingw-w64" else version(package)
    return {
        "type": "library",
        "name": name,
        "version": number if name == package else f"of {package} {number}",
        "licenses": [{"license": {"id": licence}}],
    }


def mingw_version():
    """Return the version of the copy of mingw-w64 that ziglang brings, from its own header."""
    zig = Path(find_spec("ziglang").origin).parent
    header = zig / "lib" / "libc" / "include" / "any-windows-any" / "_mingw_mac.h"
    parts = ("MAJOR", "MINOR", "BUGFIX")
    found = [re.search(rf"MINGW64_VERSION_{part}\s+(\d+)", header.read_text()) for part in parts]
    return ".".join(number[1] for number in found)


def tool(name, number):
    return {"type": "application", "name": name, "version": number}


def interpreter():
    return tool(platform.python_implementation(), platform.python_version())
