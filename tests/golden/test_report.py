"""The report is one page that shows every picture, loads nothing, and runs nothing of others."""

import base64
import io
import re
from html.parser import HTMLParser

import numpy as np
import pytest
from golden.samples import changed, colors, write_png
from PIL import Image

import engine3d as e3d
from engine3d.apps.golden.compared_folders import Rules, compare_files, pairs
from engine3d.apps.golden.html_report import Report
from engine3d.apps.golden.result_files import read_json, write_json, write_junit
from engine3d.apps.golden.results import CHANGED, NEW, PASSED, UNUSED, Result


class Page(HTMLParser):
    """The elements of a page, in their order, and that they are closed as they were opened."""

    VOID = ("meta", "img", "input", "br")

    def __init__(self, text):
        super().__init__()
        self.elements, self.open, self.text = [], [], ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data

    def all(self, tag):
        return [attributes for name, attributes in self.elements if name == tag]


@pytest.fixture
def results(tmp_path):
    """A changed picture, one of another size, a new, an unused and a passed one."""
    old = colors(20, 30)
    for name, actual in (("a", changed(old, by=40)), ("b", colors(22, 28)), ("ok", old)):
        write_png(tmp_path / "old" / f"{name}.png", old)
        write_png(tmp_path / "new" / f"{name}.png", actual)
    write_png(tmp_path / "new" / "c.png", np.dstack([old[..., :3], old[..., 3] // 2]))
    found = pairs(*(str(tmp_path / name) for name in ("new", "old", "out")))
    listed = [compare_files(pair, Rules()) for pair in found]
    return [
        *listed,
        Result("d", UNUSED, "no test asks for it", expected=str(tmp_path / "old/a.png")),
    ]


def pictures(page):
    for image in page.all("img"):
        head, _, data = image["src"].partition(",")
        assert head == "data:image/png;base64"
        with Image.open(io.BytesIO(base64.b64decode(data))) as decoded:
            assert decoded.size == (int(image["width"]), int(image["height"]))
            yield image["alt"], np.asarray(decoded)


def test_every_picture_is_in_the_page(results, tmp_path):
    Report("A title", "before", "after").write(str(tmp_path / "r.html"), results)
    text = (tmp_path / "r.html").read_text("utf-8")
    page = Page(text)
    assert page.open == ["html"] and "@" not in re.sub(r"@(media|keyframes)", "", text)
    states = [card["class"].split()[1] for card in page.all("article")]
    assert states == ["changed", "changed", "new", "unused"]
    shown = list(pictures(page))
    three = ["before", "after", "difference"]
    assert [label for label, _ in shown] == [*three, *three, "after", "before"]
    assert np.array_equal(shown[0][1], colors(20, 30))
    assert np.array_equal(shown[1][1], changed(colors(20, 30), by=40))
    assert shown[5][1].shape == (22, 30, 4)
    assert "1 of 600 pixels differ" in page.text and "it is 28x22 RGBA" in page.text
    assert "1 passed" in page.text and "ok" in page.text


def test_a_small_difference_is_marked(results):
    page = Page(Report("t", "a", "b").page(results))
    (marker,) = [div for div in page.all("div") if div.get("class") == "marker"]
    assert marker["style"] == "left:10.000%;top:10.000%;width:3.333%;height:5.000%"


def test_nothing_comes_from_elsewhere(results):
    page = Page(Report("t", "a", "b").page(results))
    for _, attributes in page.elements:
        for key in ("src", "href", "action", "srcset", "data"):
            assert attributes.get(key, "data:").startswith("data:")
    (policy,) = [m["content"] for m in page.all("meta") if "http-equiv" in m]
    assert policy.startswith("default-src 'none'; img-src data:;")
    assert not page.all("link") and "http" not in page.text and "url(" not in page.text


def test_names_are_text(tmp_path):
    evil = '<script>alert("x")</script>&\'"@TITLE@'
    result = Result(evil, CHANGED, evil, test=evil)
    passed = Result(f"folder/{evil}", PASSED)
    page = Page(Report(evil, evil, evil).page([result, passed]))
    assert len(page.all("script")) == 1
    assert page.text.count(evil) >= 5


def test_a_picture_that_is_gone_or_damaged_is_left_out(tmp_path):
    (tmp_path / "a.png").write_bytes(b"no picture")
    paths = {"expected": str(tmp_path / "a.png"), "actual": str(tmp_path / "b.png")}
    page = Page(Report("t", "a", "b").page([Result("n", CHANGED, "damaged", **paths)]))
    assert not page.all("img") and "damaged" in page.text


def test_nothing_differs():
    page = Page(Report("t", "a", "b").page([Result("n", PASSED)]))
    assert "Nothing differs." in page.text


def test_json_is_read_back(results, tmp_path):
    path = str(tmp_path / "r.json")
    write_json(path, results, {"actualDir": "new"})
    assert read_json(path) == results


def test_json_of_reg_cli_is_read(tmp_path):
    path = tmp_path / "reg.json"
    path.write_text(
        '{"failedItems": ["/a.png"], "newItems": ["b.png"], "deletedItems": ["c.png"],'
        '"passedItems": [], "actualDir": "./new", "expectedDir": "./old", "diffDir": "./out"}'
    )
    a, b, c = read_json(str(path))
    assert (a.name, a.status, a.actual, a.expected, a.difference) == (
        *("a.png", CHANGED, "./new/a.png"),
        *("./old/a.png", "./out/a.png"),
    )
    assert (b.status, b.actual, b.expected) == (NEW, "./new/b.png", None)
    assert (c.status, c.actual, c.expected) == ("deleted", None, "./old/c.png")


@pytest.mark.parametrize(
    "text", ["", "[]", "7", "{}", '{"pictures": [{"x": 1}]}', '{"pictures": 1}']
)
def test_other_json_is_an_error(text, tmp_path):
    path = tmp_path / "reg.json"
    path.write_text(text)
    with pytest.raises(e3d.FileFormatError, match="reg.json"):
        read_json(str(path))


def test_junit(results, tmp_path):
    from xml.etree import ElementTree

    path = tmp_path / "r.xml"
    results[0].name = "a\x00\x1b<&\ud800"
    write_junit(str(path), results, (CHANGED, NEW))
    root = ElementTree.parse(path).getroot()
    assert (root.get("tests"), root.get("failures")) == ("5", "3")
    cases = list(root.iter("testcase"))
    assert cases[0].get("name") == "a\\x00\\x1b<&\\ud800"
    assert [case.find("failure") is not None for case in cases] == [True, True, True, False, False]
    values = {one.get("name"): one.get("value") for one in cases[0].iter("property")}
    assert (values["status"], values["different"], values["total"]) == ("changed", "1", "600")
