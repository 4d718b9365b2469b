"""Circles of graphs."""


def circles(graph):
    """The sets of nodes of a graph that all lead to each other, sorted; `graph`: successors."""
    reach = {node: reachable(graph, node) for node in graph}
    found = {frozenset(b for b in reach[a] if a in reach.get(b, ())) for a in graph}
    return [sorted(circle) for circle in found if len(circle) > 1]


def reachable(graph, start):
    """Where one comes from a node by at least one step."""
    found, todo = set(), [start]
    while todo:
        new = set(graph.get(todo.pop(), ())) - found
        found |= new
        todo += new
    return found
