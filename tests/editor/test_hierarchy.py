"""Rows of the tree: what is open, what a search finds, and how long looking again takes."""

import sys

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor.hierarchy import Hierarchy


def plain_rows(scene, opened, search=""):
    """The rows, found by plain recursion."""
    search = search.casefold()

    def holds(node):
        return search in node.name.casefold() or any(map(holds, node.children))

    def below(node, depth):
        if search and not holds(node):
            return
        is_open = node in opened or bool(search)
        children = node.children
        match = bool(search) and search in node.name.casefold()
        yield node, depth, bool(children), bool(children) and is_open, match
        if is_open:
            for child in children:
                yield from below(child, depth + 1)

    return [row for node in scene.nodes if node.parent is None for row in below(node, 0)]


@pytest.mark.parametrize("seed", range(4))
def test_rows_are_those_of_plain_recursion(seed):
    random = np.random.default_rng(seed)
    scene = e3d.Scene()
    hierarchy = Hierarchy(scene)
    opened, gone, seen = set(), [], set()
    for step in range(150):
        nodes = scene.nodes
        node = nodes[random.integers(len(nodes))] if nodes else None
        action = int(random.integers(8)) if len(nodes) > 2 else 0
        if action <= 2:
            scene.add(name=f"N{step}", parent=node if random.random() < 0.7 else None)
        elif action == 3:
            scene.remove(node)
            gone.append(node)
        elif action == 4 and gone:
            scene.restore(gone.pop())
        elif action == 5:
            other = nodes[random.integers(len(nodes))]
            try:
                node.reparent(other, before=other.children[0] if other.children else None)
            except e3d.InvalidArgumentError:
                node.reparent(None)
        elif action == 6:
            node.name = f"other {random.integers(9)}"
        elif node is not None:
            is_open = bool(random.random() < 0.7)
            hierarchy.set_open(node, is_open)
            (opened.add if is_open else opened.discard)(node)
        for search in ("", "1", "OTHER"):
            hierarchy.search = search
            rows = plain_rows(scene, opened, search)
            assert [tuple(row) for row in hierarchy.rows()] == rows
            seen.update((bool(search), len(rows) > 3, row[3]) for row in rows)
    assert len(seen) > 5


def test_the_same_rows_until_something_changes():
    scene = e3d.Scene()
    top = scene.add(name="top")
    child = scene.add(name="child", parent=top)
    hierarchy = Hierarchy(scene)
    rows = hierarchy.rows()
    child.translation = (1, 2, 3)
    child.visible = False
    child.name = "renamed"
    assert hierarchy.rows() is rows
    hierarchy.reveal(child)
    assert hierarchy.is_open(top)
    assert [row.node for row in hierarchy.rows()] == [top, child]
    assert hierarchy.rows().place(child) == 1 and rows.place(child) is None
    hierarchy.search = " Renamed "
    found = hierarchy.rows()
    assert [(row.node, row.is_match) for row in found] == [(top, False), (child, True)]
    child.translation = (0, 0, 0)
    assert hierarchy.rows() is found
    child.name = "else"
    assert len(hierarchy.rows()) == 0
    hierarchy.search = ""
    scene.remove(top)
    assert len(hierarchy.rows()) == 0
    scene.restore(top)
    assert [row.node for row in hierarchy.rows()[:1]] == [top]


def test_a_range_of_rows_is_selected():
    scene = e3d.Scene()
    nodes = [scene.add(name=f"{k}") for k in range(5)]
    hidden = scene.add(parent=nodes[2])
    hierarchy = Hierarchy(scene)
    assert hierarchy.rows().between(nodes[3], nodes[1]) == tuple(nodes[1:4])
    assert hierarchy.rows().between(nodes[3], hidden) == (nodes[3],)
    assert hierarchy.rows().between(hidden, hidden) == ()
    hierarchy.set_open(nodes[2], True, below=True)
    assert hidden in hierarchy.rows().between(nodes[0], nodes[4])
    hierarchy.set_open(nodes[2], False, below=True)
    assert hidden not in hierarchy.rows().between(nodes[0], nodes[4])


def calls(do):
    """How many functions are called: what goes through all nodes calls at least one for each."""
    count = 0

    def profile(frame, event, argument):
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(profile)
    try:
        do()
    finally:
        sys.setprofile(before)
    return count


def test_a_scene_of_39304_nodes_stays_fluid():
    scene = e3d.Scene()
    groups = [scene.add(name=f"layer {k}") for k in range(34)]
    mesh = e3d.box()
    for k in range(34**3 - 34):
        scene.add(mesh, parent=groups[k % 34], name=f"node {k}")
    hierarchy = Hierarchy(scene)
    for group in groups:
        hierarchy.set_open(group, True)
    assert len(hierarchy.rows()) == len(scene.nodes) == 39_304

    def look():
        rows = hierarchy.rows()
        return [rows[k] for k in range(1000, 1060)]

    def rename():
        groups[3].name += "x"
        look()

    def move():
        groups[3].translation = (1, 2, 3)
        look()

    def add():
        scene.add(parent=groups[5])
        look()

    assert all(calls(do) < 1000 for do in (look, move, rename))
    assert calls(add) < 3 * len(scene.nodes)
    hierarchy.search = "7"
    assert calls(add) < 3 * len(scene.nodes)
    assert calls(look) < 1000
