"""What the views of a lesson say besides its own texts; catalogues have it in other languages."""

from __future__ import annotations

from ...base.language import speaking, translated

#: Texts in English.
WORDS = {
    "step": "step {} of {}",
    "idea": "The idea",
    "code": "The lines that matter",
    "parameters": "To play with",
    "exercise": "Exercise",
    "answer": "Your answer:",
    "type": "type a number, then Enter",
    "check": "Check",
    "right": "Right!",
    "wrong": "Not yet: try again.",
    "none": "That is no number.",
    "copied": "The code is in the clipboard.",
    "print": "engine3d learn {} --code prints the code.",
    "next": "Next: {}",
    "keys": (
        "`Left Right` steps · `Up Down` value · `N P` lessons · `Home End` · `0–9 "
        "Enter` answer · `C` copy · `H` help · `Q` quit"
    ),
    "help": "Keys",
    "end": "The end of the course",
    "after": (
        "You have seen how a 3D engine works, from the lists of a file to a world that "
        "one walks through. What comes next:\n"
        "• your own pictures: engine3d render model.glb -o picture.png\n"
        "• a world to walk in: engine3d run --scene city --camera fps\n"
        "• scenes made by hand: engine3d edit\n"
        "• scenes and games made by programs: the tutorials of the documentation\n"
        "• the real engine, which does all this quickly: its page on architecture"
    ),
}
#: The keys and what they do, for the help.
KEYS = (
    ("Right  Space  Enter", "next step; after the last one the next lesson"),
    ("Left  Backspace", "step before"),
    ("Home  End", "first and last step"),
    ("N  P", "next lesson, the one before"),
    ("Up  Down", "another value of the parameter"),
    ("Tab", "the next parameter"),
    ("0–9  .  −", "write the answer to the exercise"),
    ("Enter", "check the answer"),
    ("C", "copy the code"),
    ("J  K  wheel", "move the page"),
    ("H", "this list"),
    ("Q  Esc", "leave"),
)


def say(word: str, language: str, *values: object) -> str:
    """Return a text in a language, with values in their places."""
    with speaking(language):
        return translated(WORDS[word]).format(*values)


def told_keys(language: str) -> list[tuple[str, str]]:
    """Return the keys and what they do, in a language."""
    with speaking(language):
        return [(translated(keys), translated(meaning)) for keys, meaning in KEYS]
