"""The papers of a release tell one version, one date, one licence: those of the package."""

import datetime
import re
import xml.etree.ElementTree as ElementTree

from engine3d.version import PICTURES, RELEASED, __version__


def text_of(source_tree, name):
    return (source_tree / name).read_text("utf-8")


def test_the_changelog_begins_with_this_version(source_tree):
    """What comes after a release stands above it, under Unreleased."""
    headings = re.findall(r"^## (.+)$", text_of(source_tree, "CHANGELOG.md"), re.MULTILINE)
    released = [heading for heading in headings if not heading.startswith("Unreleased")]
    assert released[0] == f"{__version__} ({RELEASED})"
    assert datetime.date.fromisoformat(RELEASED)


def test_the_citation_names_this_version(source_tree):
    text = text_of(source_tree, "CITATION.cff")
    assert f"\nversion: {__version__}\n" in text and f"\ndate-released: {RELEASED}\n" in text


def test_desktops_are_told_of_this_version(source_tree):
    root = ElementTree.fromstring(text_of(source_tree, "data/desktop/engine3d.metainfo.xml"))
    releases = [(one.get("version"), one.get("date")) for one in root.iter("release")]
    assert releases[0] == (__version__, RELEASED)
    page = text_of(source_tree, "data/desktop/engine3d.1")
    assert page.startswith(f'.TH ENGINE3D 1 "{RELEASED}" "engine3d {__version__}" ')


def test_the_number_of_the_pictures_has_its_release(source_tree):
    text = text_of(source_tree, "docs/versions.md")
    rows = re.findall(r"^\| (\d+) \| ([\d.]+) \|", text.partition("`PICTURES` | Rel")[2], re.M)
    number, release = rows[-1]
    since, now = ([*map(int, one.split(".")[:2])] for one in (release, __version__))
    assert int(number) == PICTURES and since <= now
    assert not re.search(r"\| after \d", text), "a number is of a release"


def test_no_page_installs_what_is_not_published(source_tree):
    """Until the package is on PyPI, its name there may be somebody else's; a wheel is a file."""
    pages = [source_tree / "README.md", *(source_tree / "docs").rglob("*.md")]
    by_name = re.compile(
        r"\b(?:pipx?|uv tool|uv pip) install (?!-)[^\n`&;]*?\bengine3d(?![-\[\w/.])"
    )
    found = [
        (page.name, line) for page in pages for line in by_name.findall(page.read_text("utf-8"))
    ]
    assert "not on PyPI yet" in text_of(source_tree, "docs/start.md")
    assert found == [("start.md", "pip install engine3d")]  # which says never to
