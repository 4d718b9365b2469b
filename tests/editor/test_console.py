"""The log and its filter; lines of Python, what they print, and what of them is undone."""

import pytest

import engine3d as e3d
from engine3d.apps.editor.console import LEVELS, Console
from engine3d.apps.editor.document import SceneDocument


def test_entries_are_filtered_by_level_and_text():
    console = Console()
    console.write("message", "Hello\tthere")
    console.write("warning", "hello again\x1b[2J\nand more")
    assert [entry.text for entry in console.filtered()] == [
        "Hello   there",
        "hello again\\x1b[2J",
        "and more",
    ]
    assert [entry.text for entry in console.filtered(["warning"], "HELLO")] == [
        "hello again\\x1b[2J"
    ]
    found = console.filtered(["message"])
    assert console.filtered(["message"]) is found
    console.write("message", "more")
    assert len(console.filtered(["message"])) == 2
    console.clear()
    assert console.filtered() == console.entries == ()


def test_old_entries_are_forgotten():
    console = Console()
    for k in range(10_100):
        console.write("message", f"{k}")
    assert len(console.entries) == 10_000
    assert console.entries[-1].text == "10099" and console.entries[-1].number == 10_099


def texts(document, level):
    assert level in LEVELS
    return [entry.text for entry in document.console.entries if entry.level == level]


def test_lines_see_the_scene_and_print_to_the_console(capsys):
    document = SceneDocument()
    ball = document.scene.add(e3d.icosphere(1, 1), name="ball")
    document.selection.set([ball])
    for line in ("node.name, len(scene.nodes), selection[0] is node", "print('so', end='')"):
        assert not document.prompt.push(line)
    assert document.prompt.push("for k in range(2):") and document.prompt.is_open
    assert document.prompt.push("    print(k)")
    assert not document.prompt.push("")
    assert texts(document, "output") == ["('ball', 1, True)", "so", "0", "1"]
    assert texts(document, "input")[2:] == [
        ">>> for k in range(2):",
        "...     print(k)",
        "... ",
    ]
    assert capsys.readouterr() == ("", "")
    assert document.history.position == 0


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("1 / 0", "ZeroDivisionError"),
        ("if:", "SyntaxError"),
        ("raise KeyboardInterrupt", "KeyboardInterrupt"),
        ("scene.add(3)", "InvalidArgumentError"),
        ("'\\ud800'.encode()", "UnicodeEncodeError"),
        ("def f(): f()\n\nf()", "SyntaxError"),
    ],
)
def test_errors_are_told(line, says):
    document = SceneDocument()
    assert not document.prompt.push(line)
    assert any(says in text for text in texts(document, "error"))


def test_the_editor_goes_on_after_exit():
    document = SceneDocument()
    document.prompt.push("import sys; scene.add(name='x'); sys.exit(3)")
    assert "goes on" in texts(document, "warning")[0]
    assert document.scene.find("x") is not None
    document.undo()
    assert document.scene.nodes == ()


def test_what_lines_did_is_one_step_each():
    document = SceneDocument()
    scene = document.scene
    mesh = e3d.box()
    node = scene.add(mesh)
    positions = mesh.positions
    document.prompt.push("a = scene.add(node_object := scene.nodes[0].object, name='a')")
    document.prompt.push("scene.nodes[0].object.positions *= 2")  # a message, not a change
    document.prompt.push("node_object.positions = node_object.positions * 2")
    document.prompt.push("node_object.materials[0].color = 255, 0, 0")
    document.prompt.push("node_object.materials.append(e3d.Material())")
    document.prompt.push("x = 3")
    assert document.history.position == 4 and len(texts(document, "error")) > 0
    for _ in range(4):
        document.undo()
    assert scene.nodes == (node,) and len(mesh.materials) == 1
    assert (mesh.positions == positions).all() and mesh.bounds[1, 0] == 0.5
    assert mesh.materials[0].color == (1, 1, 1)
    for _ in range(4):
        document.redo()
    assert mesh.bounds[1, 0] == 1 and len(mesh.materials) == 2
    assert mesh.materials[0].color == (255, 0, 0) and scene.find("a").object is mesh


def test_completion_finds_names_and_attributes():
    document = SceneDocument()
    assert "scene.nodes" in document.prompt.completions("scene.no")
    assert "document" in document.prompt.completions("docu")
    assert document.prompt.completions("nothing.like.this") == ()


def test_a_block_may_be_given_up():
    document = SceneDocument()
    assert document.prompt.push("while True:")
    document.prompt.reset()
    assert not document.prompt.push("print('free')")
    assert texts(document, "output") == ["free"]
