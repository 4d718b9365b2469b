"""Every text of the windows has a translation, and every translation is of such a text."""

import string

import pytest
from languages import listed_texts
from languages.drawn_texts import (
    counted_texts,
    texts_in_source,
    untranslatable,
    untranslated_labels,
)

from engine3d.base.catalogue import read_entries
from engine3d.base.language import _folder, languages

OTHERS = languages()[1:]


@pytest.fixture(params=OTHERS)
def entries(request):
    path = _folder() / f"{request.param}.po"
    return [one for one in read_entries(path.read_text("utf-8"), str(path)) if one.text]


def found():
    """Where each text that windows draw was found, by context and text."""
    places = {(one.context, one.text): one.place for one in texts_in_source()}
    lists = listed_texts
    for function in (lists.of_viewer, lists.of_pictures, lists.of_editor, lists.of_lessons):
        places |= dict.fromkeys(function(), f"listed_texts.{function.__name__}")
    return {key: place for key, place in places.items() if any(map(str.isalpha, key[1]))}


def test_every_text_has_a_translation(entries):
    known = {(entry.context, entry.text) for entry in entries}
    known |= {(entry.context, entry.plural) for entry in entries}
    missing = {f"{place}: {key}" for key, place in found().items() if key not in known}
    assert not missing, "add these to the catalogue:\n" + "\n".join(sorted(missing))


def test_texts_that_count_have_all_plurals(entries):
    plurals = {entry.text: entry.plural for entry in entries}
    without = [place for one, many, place in counted_texts() if plurals.get(one, many) != many]
    assert not without, "in the catalogue these have no msgid_plural:\n" + "\n".join(without)


def test_every_translation_is_of_a_text_that_is_drawn(entries):
    drawn = found()
    unused = [entry for entry in entries if (entry.context, entry.text) not in drawn]
    assert not unused, [(entry.line, entry.context, entry.text) for entry in unused]


def test_translations_have_the_fields_of_their_texts(entries):
    for entry in entries:
        needed = set(map(_fields, filter(None, (entry.text, entry.plural))))
        assert {_fields(text) for text in entry.translations} <= needed, entry


def _fields(text):
    return tuple(sorted(name for _, name, *_ in string.Formatter().parse(text) if name is not None))


def test_texts_are_put_together_by_templates():
    found = list(untranslatable())
    assert not found, "use translated('… {name}', name=…):\n" + "\n".join(found)


def test_the_editor_takes_imgui_from_the_module_that_translates():
    """Modules that draw no label may take it as it is."""
    assert not sorted(untranslated_labels())
