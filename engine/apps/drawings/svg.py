"""Writes a page as SVG 1.1: in millimetres, with a group for each view, layer and part.

In: a `Page`. Out: text, the same for the same page. Layers are those of Inkscape, too.
"""

from __future__ import annotations

from collections.abc import Iterator
from xml.sax.saxutils import escape, quoteattr

from ...errors import printable
from .chains import STEPS
from .paper import Group, Page, Strokes, Text
from .styles import Layer

_HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" '
    'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" version="1.1" '
    'width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}">'
)


def svg_of(page: Page) -> str:
    """Return a page as SVG."""
    return "\n".join(_lines(page)) + "\n"


def number(value: float) -> str:
    """Return a number with up to three decimals."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _lines(page: Page) -> Iterator[str]:
    yield '<?xml version="1.0" encoding="UTF-8"?>'
    yield _HEAD.format(width=number(page.width), height=number(page.height))
    yield f"<title>{_text(page.title)}</title>"
    if page.background is not None:
        yield f'<rect width="100%" height="100%" fill="{page.background}"/>'
    yield from dict.fromkeys(_frame(one.clip) for one in page.groups if one.clip is not None)
    yield '<g fill="none" stroke-linecap="round" stroke-linejoin="round">'
    for group in page.groups:
        yield from _group(group)
    yield "</g>"
    yield "</svg>"


def _group(group: Group) -> Iterator[str]:
    place = f' transform="translate({number(group.x)} {number(group.y)})"'
    place = place if group.x or group.y else ""
    clip = "" if group.clip is None else f' clip-path="url(#{_frame_name(group.clip)})"'
    yield f'<g id="{group.name}"{place}>'
    if group.title:
        yield f"<title>{_text(group.title)}</title>"
    for layer, strokes in group.layers:
        yield from _layer(f"{group.name}-{layer.name}", layer, strokes, clip)
    for text in group.texts:
        yield _text_element(text)
    yield "</g>"


def _frame(size: tuple[float, float]) -> str:
    """Return the rectangle beyond which views of a size show nothing."""
    width, height = map(number, size)
    rectangle = f'<rect width="{width}" height="{height}"/>'
    return f'<clipPath id="{_frame_name(size)}">{rectangle}</clipPath>'


def _frame_name(size: tuple[float, float]) -> str:
    """Return the identifier of a frame.

    A web page that holds several drawings takes the first frame of a name for all of them: those of
    one name are alike.
    """
    width, height = (f"{side:.3f}".replace(".", "") for side in size)
    return f"frame-{width}-{height}"


def _layer(name: str, layer: Layer, strokes: list[Strokes], clip: str) -> Iterator[str]:
    style = layer.style
    dashes = ""
    if style.dashes is not None:
        dashes = f' stroke-dasharray="{" ".join(map(number, style.dashes))}" stroke-linecap="butt"'
    yield (
        f'<g id="{name}" inkscape:groupmode="layer" inkscape:label={quoteattr(layer.title)} '
        f'stroke="{style.color}" stroke-width="{number(style.width)}"{dashes}{clip}>'
    )
    for place, part in enumerate(strokes):
        title = f"<title>{_text(part.part)}</title>" if part.part else ""
        path = "".join(map(_path, part.polylines))
        yield (
            f'<path id="{name}-{place}" d="{path}">{title}</path>'
            if title
            else (f'<path id="{name}-{place}" d="{path}"/>')
        )
    yield "</g>"


def _path(line: list[tuple[int, int]]) -> str:
    is_closed = len(line) > 2 and line[0] == line[-1]
    x, y = line[0]
    words = [f"M{_steps(x)} {_steps(y)}"]
    for after_x, after_y in line[1:-1] if is_closed else line[1:]:
        words.append(f"l{_steps(after_x - x)} {_steps(after_y - y)}")
        x, y = after_x, after_y
    return "".join(words) + ("z" if is_closed else "")


def _steps(steps: int) -> str:
    return number(steps / STEPS)


def _text_element(text: Text) -> str:
    x, y = number(text.x), number(text.y)
    turn = f' transform="rotate(-90 {x} {y})"' if text.is_upward else ""
    return (
        f'<text x="{x}" y="{y}"{turn} font-family="Helvetica, Arial, sans-serif" '
        f'font-size="{number(text.size)}" text-anchor="{text.anchor}" fill="#000000">'
        f"{_text(text.text)}</text>"
    )


def _text(text: str) -> str:
    """Return text that XML may hold: without control characters and lone surrogates."""
    held = printable(text).encode("utf-8", "backslashreplace").decode()
    return escape("".join(c for c in held if c not in "\ufffe\uffff"))
