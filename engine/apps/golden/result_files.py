"""Writes results as JSON, as reg-cli's lists, and as JUnit XML."""

from __future__ import annotations

import json
from typing import Any
from xml.etree import ElementTree

from ...base.files import json_records as shapes
from ...base.files.atomic_write import atomic_write
from ...errors import printable
from .results import CHANGED, DELETED, FAILED, NEW, PASSED, UNUSED, UPDATED, Result

_LISTS = {
    "failedItems": (CHANGED, FAILED),
    "newItems": (NEW,),
    "deletedItems": (DELETED, UNUSED),
    "passedItems": (PASSED, UPDATED),
}
_PATH = shapes.maybe(shapes.path_text)
_PICTURE = shapes.members(
    {"name": shapes.text, "status": shapes.one_of(*(s for held in _LISTS.values() for s in held))},
    {
        **dict.fromkeys(("message", "test", "digest"), shapes.text),
        **dict.fromkeys(("expected", "actual", "difference"), _PATH),
        **dict.fromkeys(("different", "total", "frame"), shapes.count),
        **dict.fromkeys(("largest", "flip"), shapes.maybe(shapes.number)),
        "box": shapes.maybe(shapes.listed(shapes.count, 4)),
    },
)
_OURS = shapes.members({"pictures": shapes.listed(_PICTURE)}, more=True)
_OF_REG_CLI = shapes.members(
    {
        **dict.fromkeys(_LISTS, shapes.listed(shapes.path_text)),
        **dict.fromkeys(("actualDir", "expectedDir", "diffDir"), shapes.path_text),
    },
    more=True,
)


def write_json(path: str, results: list[Result], folders: dict[str, str] | None = None) -> None:
    """Write reg-cli's lists of names, and all data on each picture.

    Parameters
    ----------
    path : str
    results : list of Result
    folders : dict, optional
        ``actualDir``, ``expectedDir`` and ``diffDir``.

    Raises
    ------
    FileAccessError
    """
    lists = {
        key: _names(result for result in results if result.status in statuses)
        for key, statuses in _LISTS.items()
    }
    document = {
        **lists,
        "expectedItems": _names(r for r in results if r.status != NEW),
        "actualItems": _names(r for r in results if r.status not in (DELETED, UNUSED)),
        "diffItems": _names(r for r in results if r.difference is not None),
        **(folders or {}),
        "pictures": [result.as_dict() for result in results],
    }
    with atomic_write(path) as file:
        file.write(json.dumps(document, indent=1).encode("ascii") + b"\n")


def _names(results) -> list[str]:
    return sorted({result.name for result in results})


def read_json(path: str) -> list[Result]:
    """Return the results from a file of `write_json` or reg-cli.

    Raises `FileAccessError`, or `FileFormatError` where the file is no such list.
    """
    document = shapes.read_json(path, shapes.members({}, more=True), regular=False)
    if "pictures" in document:
        shapes.checked(document, path, _OURS)
        return [Result(**picture) for picture in document["pictures"]]
    shapes.checked(document, path, _OF_REG_CLI)
    return list(_of_reg_cli(document))


def _of_reg_cli(document: dict[str, Any]):
    for key, (status, *_) in _LISTS.items():
        for name in document[key]:
            name = name.lstrip("/")
            result = Result(name, status)
            if status != DELETED:
                result.actual = f"{document['actualDir']}/{name}"
            if status != NEW:
                result.expected = f"{document['expectedDir']}/{name}"
            if status == CHANGED:
                result.difference = f"{document['diffDir']}/{name}"
            yield result


def write_junit(path: str, results: list[Result], failures: tuple[str, ...]) -> None:
    """Write a test case for each picture; failure statuses fail.

    Raises `FileAccessError`.
    """
    failed = sum(result.status in failures for result in results)
    counts = {"tests": str(len(results)), "failures": str(failed)}
    suites = ElementTree.Element("testsuites", {"name": "engine3d diff", **counts})
    suite = ElementTree.SubElement(suites, "testsuite", {"name": "pictures", **counts})
    for result in results:
        case = ElementTree.SubElement(
            suite, "testcase", classname="pictures", name=_of_xml(result.name)
        )
        properties = ElementTree.SubElement(case, "properties")
        for key in ("status", "different", "total", "largest", "expected", "actual", "difference"):
            value = getattr(result, key)
            if value is not None:
                ElementTree.SubElement(properties, "property", name=key, value=_of_xml(str(value)))
        if result.status in failures:
            message = _of_xml(result.message)
            ElementTree.SubElement(case, "failure", type=result.status, message=message)
    text = ElementTree.tostring(suites, encoding="utf-8", xml_declaration=True)
    with atomic_write(path) as file:
        file.write(text + b"\n")


def _of_xml(text: str) -> str:
    """Return a text without characters that XML cannot hold."""
    return printable(text).encode("utf-8", "backslashreplace").decode()
