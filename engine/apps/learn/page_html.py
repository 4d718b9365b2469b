"""The page of a lesson as one file of HTML, with its pictures in it.

In: a lesson's program and a language. Out: HTML that needs no other file and no network. Without
scripts it shows all steps, one below the other; with them, one at a time, like the window. Values
of the parameters are drawn beforehand, those of one parameter at a time.
"""

from __future__ import annotations

import base64
import html
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from string import Template

import numpy as np

from .captions import number
from .code_colors import COLORS, colored
from .lesson_file import Parameter
from .lesson_programs import Listing, Step, first_values, steps_of, texts_of
from .rich_text import paragraphs
from .words import say

_TAGS = {"plain": "{}", "bold": "<b>{}</b>", "italic": "<i>{}</i>", "code": "<code>{}</code>"}


def lesson_html(program: Path, language: str) -> str:
    """Return a lesson as HTML.

    Parameters
    ----------
    program : Path
        Of the lesson.
    language : {"en", "fr"}
    """
    texts = texts_of(program)
    page = files(__package__).joinpath("page.html").read_text(encoding="utf-8")
    spoken = ("right", "wrong", "none")
    data = {"name": texts.name, "check": texts.check, "place": say("step", language, "{}", "{}")}
    data |= {word: say(word, language) for word in spoken}
    return Template(page).substitute(
        language=language,
        title=html.escape(texts.title(language)),
        colors="\n".join(f".{kind} {{ color: rgb{color}; }}" for kind, color in COLORS.items()),
        steps="\n".join(_figures(program, language)),
        parameters="".join(_menu(one, program, language) for one in texts.parameters),
        idea=_prose(texts.texts["idea", language]),
        code=_code(texts.code),
        exercise=_prose(texts.texts["exercise", language]),
        answer_label=html.escape(say("answer", language)),
        check_label=html.escape(say("check", language)),
        data=json.dumps(data, ensure_ascii=False).replace("</", "<\\/"),
        **{f"{part}_heading": html.escape(say(part, language)) for part in _HEADINGS},
    )


_HEADINGS = ("idea", "code", "exercise")


def _figures(program: Path, language: str) -> Iterator[str]:
    """Yield the steps with the usual values, then with each other value of each parameter."""
    usual = first_values(program)
    yield from _figures_of("", steps_of(program, language, usual))
    for parameter in texts_of(program).parameters:
        for value in parameter.values:
            if value != usual[parameter.name]:
                steps = steps_of(program, language, {**usual, parameter.name: value})
                yield from _figures_of(f"{parameter.name}={value}", steps)


def _figures_of(variant: str, steps: Iterator[Step]) -> Iterator[str]:
    # Without scripts, one choice of values is enough to read.
    hidden = " hidden" if variant else ""
    for step in steps:
        marked = f"{step.marked.start}-{step.marked.stop}"
        shown = "".join(map(_shown, step.shown))
        yield (
            f'<figure data-variant="{html.escape(variant)}" data-marked="{marked}"{hidden}>'
            f'<div class="beside">{shown}</div>'
            f"<figcaption>{html.escape(step.caption)}</figcaption></figure>"
        )


def _shown(one: np.ndarray | Listing) -> str:
    if isinstance(one, Listing):
        return f"<pre>{html.escape(chr(10).join(one.lines))}</pre>"
    return f'<img alt="" src="data:image/png;base64,{_png(one)}">'


def _png(picture: np.ndarray) -> str:
    from PIL import Image

    written = io.BytesIO()
    Image.fromarray(picture).save(written, "PNG", optimize=True)
    return base64.b64encode(written.getvalue()).decode()


def _menu(parameter: Parameter, program: Path, language: str) -> str:
    """Return the values of a parameter to choose from; the usual one is that of no variant."""
    words = texts_of(program).words(language)
    usual = first_values(program)[parameter.name]
    options = ""
    for value in parameter.values:
        variant = "" if value == usual else f"{parameter.name}={value}"
        chosen = " selected" if value == usual else ""
        shown = html.escape(_value(value, language, words))
        options += f'<option value="{html.escape(variant)}"{chosen}>{shown}</option>'
    label = html.escape(parameter.labels[language])
    return f"<p><label>{label} <select>{options}</select></label></p>"


def _value(value: float | str, language: str, words: Mapping[str, str]) -> str:
    return words.get(value, value) if isinstance(value, str) else number(value, "", language)


def _prose(text: str) -> str:
    spans = ("".join(_TAGS[k].format(html.escape(t)) for t, k in one) for one in paragraphs(text))
    return "\n".join(f"<p>{one}</p>" for one in spans)


def _code(lines: Sequence[str]) -> str:
    """Return lines of code, each a span that can be marked."""
    return "".join(
        '<span class="line">'
        + ("".join(f'<span class="{k}">{html.escape(t)}</span>' for t, k in parts) or " ")
        + "</span>"
        for parts in colored(lines)
    )
