"""Writes a page as PDF 1.5 with layers (ISO 32000-1, 8.11), without any other package.

In: a `Page`. Out: bytes, the same for the same page: there is no date, and nothing is compressed:
compressors differ between machines. Texts are set in Helvetica, which every reader has; letters
beyond Latin-1 become question marks.
"""

from __future__ import annotations

from ...errors import printable
from .chains import STEPS
from .paper import Group, Page, Text
from .styles import Layer
from .svg import number

_POINTS = 72.0 / 25.4
#: Widths of Helvetica's letters from space on, in thousandths of its size (its AFM file).
_WIDTHS = (
    *(278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278),
    *(556,) * 10,
    *(278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278),
    *(500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667),
    *(611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222),
    *(222, 500, 222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500),
    *(500, 334, 260, 334, 584),
)


def text_width(text: str, size: float) -> float:
    """Return the width of a text in Helvetica, in the unit of its size."""
    codes = (ord(letter) - 32 for letter in text)
    return sum(_WIDTHS[c] if 0 <= c < len(_WIDTHS) else 556 for c in codes) * size / 1000.0


def pdf_of(page: Page) -> bytes:
    """Return a page as PDF."""
    names: dict[str, str] = {}  # of layers, and their titles
    content = _content(page, names)
    layers = list(names.items())
    first = 6  # the object of the first layer
    listed = " ".join(f"{first + k} 0 R" for k in range(len(layers)))
    properties = " ".join(f"/L{k} {first + k} 0 R" for k in range(len(layers)))
    box = f"0 0 {number(page.width * _POINTS)} {number(page.height * _POINTS)}"
    objects = [
        f"<< /Type /Catalog /Pages 2 0 R /OCProperties << /OCGs [{listed}] "
        f"/D << /Order [{listed}] /ON [{listed}] >> >> >>".encode(),
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        f"<< /Type /Page /Parent 2 0 R /MediaBox [{box}] /Contents 5 0 R /Resources "
        f"<< /Font << /F 4 0 R >> /Properties << {properties} >> >> >>".encode(),
        b"<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>",
        b"<< /Length %d >>\nstream\n%b\nendstream" % (len(content), content),
        *(b"<< /Type /OCG /Name %b >>" % _unicode(title) for _, title in layers),
        b"<< /Title %b /Producer (engine3d) >>" % _unicode(printable(page.title)),
    ]
    return _file(objects)


def _file(objects: list[bytes]) -> bytes:
    """Return a file of objects 1, 2, ...: the first is the catalogue, the last the information."""
    file = bytearray(b"%PDF-1.5\n%\xe2\xe3\xcf\xd3\n")
    places = []
    for place, held in enumerate(objects, 1):
        places.append(len(file))
        file += b"%d 0 obj\n%b\nendobj\n" % (place, held)
    table = len(file)
    file += b"xref\n0 %d\n0000000000 65535 f \n" % (len(objects) + 1)
    file += b"".join(b"%010d 00000 n \n" % place for place in places)
    file += b"trailer\n<< /Size %d /Root 1 0 R /Info %d 0 R >>\nstartxref\n%d\n%%%%EOF\n" % (
        len(objects) + 1,
        len(objects),
        table,
    )
    return bytes(file)


def _content(page: Page, names: dict[str, str]) -> bytes:
    height = number(page.height * _POINTS)
    words = [f"{_POINTS:.8f} 0 0 -{_POINTS:.8f} 0 {height} cm 1 j"]
    if page.background is not None:
        size = f"{number(page.width)} {number(page.height)}"
        words.append(f"{_color(page.background)} rg 0 0 {size} re f 0 0 0 rg")
    for group in page.groups:
        words += _group(group, names)
    return "\n".join(words).encode("latin-1", "replace")


def _group(group: Group, names: dict[str, str]) -> list[str]:
    words = [f"q 1 0 0 1 {number(group.x)} {number(group.y)} cm"]
    for layer, strokes in group.layers:
        place = list(names).index(layer.name) if layer.name in names else len(names)
        names[layer.name] = layer.title
        words += [f"/OC /L{place} BDC q", *_look(layer)]
        if group.clip is not None:
            words.append(f"0 0 {number(group.clip[0])} {number(group.clip[1])} re W n")
        words += [_path(line) for one in strokes for line in one.polylines]
        words.append("Q EMC")
    words += [_text(text) for text in group.texts]
    return [*words, "Q"]


def _look(layer: Layer) -> list[str]:
    style = layer.style
    dashes = "" if style.dashes is None else " ".join(map(number, style.dashes))
    cap = 1 if style.dashes is None else 0
    return [f"{number(style.width)} w {cap} J [{dashes}] 0 d {_color(style.color)} RG"]


def _color(color: str) -> str:
    return " ".join(number(int(color[k : k + 2], 16) / 255) for k in (1, 3, 5))


def _path(line: list[tuple[int, int]]) -> str:
    is_closed = len(line) > 2 and line[0] == line[-1]
    points = [f"{number(x / STEPS)} {number(y / STEPS)}" for x, y in line]
    if is_closed:
        return f"{points[0]} m {' '.join(f'{point} l' for point in points[1:-1])} s"
    return f"{points[0]} m {' '.join(f'{point} l' for point in points[1:])} S"


def _text(text: Text) -> str:
    shown = printable(text.text)
    back = {"start": 0.0, "middle": 0.5, "end": 1.0}[text.anchor] * text_width(shown, text.size)
    # The page's y runs down, and letters stand upright.
    if text.is_upward:
        matrix = f"0 -1 -1 0 {number(text.x)} {number(text.y + back)}"
    else:
        matrix = f"1 0 0 -1 {number(text.x - back)} {number(text.y)}"
    return f"BT /F {number(text.size)} Tf {matrix} Tm {_literal(shown)} Tj ET"


def _literal(text: str) -> str:
    held = text.encode("cp1252", "replace").decode("latin-1")
    for letter in "\\()":
        held = held.replace(letter, "\\" + letter)
    return f"({held})"


def _unicode(text: str) -> bytes:
    return b"<" + (b"\xfe\xff" + text.encode("utf-16-be", "replace")).hex().upper().encode() + b">"
