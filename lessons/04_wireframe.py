"""Wireframe: the edges of the faces as lines, first twice each, then once."""

import engine3d as e3d
from lesson import MODELS, blank, earlier, main, told

lists = earlier("01_lists")
points = earlier("02_points")
lines = earlier("03_lines")
HOUSE, TEAPOT = lists.HOUSE, MODELS / "teapot.obj"
LINE = (255, 200, 0)
YAW, PITCH = 0.5, 0.35  # radians


def corners_of(face, model):
    """Return the vertex indices of a face, from 0."""
    return [lists.resolve(corner, model)[0] for corner in face]


def all_edges(model):
    """Return the edges as the faces name them: from each corner to the next."""
    edges = []
    for face in model["f"]:
        corners = corners_of(face, model)
        edges += zip(corners, corners[1:] + corners[:1], strict=True)
    return edges


def unique_edges(model):
    """Return each edge once, whichever way the faces go round it."""
    seen = {}
    for a, b in all_edges(model):
        seen[min(a, b), max(a, b)] = None
    return list(seen)


def turn(vertices, yaw, pitch):
    """Return the vertices turned about the vertical axis, then about the horizontal one."""
    cos_yaw, sin_yaw = e3d.linalg.cos(yaw), e3d.linalg.sin(yaw)
    cos_pitch, sin_pitch = e3d.linalg.cos(pitch), e3d.linalg.sin(pitch)
    turned = []
    for x, y, z in vertices:
        x, z = x * cos_yaw + z * sin_yaw, z * cos_yaw - x * sin_yaw
        y, z = y * cos_pitch - z * sin_pitch, z * cos_pitch + y * sin_pitch
        turned.append((x, y, z))
    return turned


def draw_edges(vertices, edges, width, height, color=LINE):
    """Return a picture of the edges, scaled so that all fits."""
    picture = blank(width, height)
    scale, middle = points.fit(vertices, width, height)
    pixels = []
    for vertex in vertices:
        x, y = points.to_screen(vertex, scale, middle, width, height)
        pixels.append((int(x // 1), int(y // 1)))
    for a, b in edges:
        lines.draw(picture, lines.bresenham(*pixels[a], *pixels[b]), color)
    return picture


def engine_view(path, width, height, yaw=YAW):
    """Return a scene of the engine with the model turned alike, and a camera that sees it so."""
    turned = turn(lists.read_lists(path)["v"], yaw, PITCH)
    scale, (x, y) = points.fit(turned, width, height)
    scene = e3d.Scene(background=(30, 33, 40))
    pitch = scene.add(euler=(PITCH, 0.0, 0.0))
    scene.add(e3d.load_mesh(path), parent=pitch, euler=(0.0, yaw, 0.0))
    camera = e3d.OrthographicCamera(height / 2 / scale)
    return scene, (camera, e3d.look_at((x, y, 50.0), (x, y, 0.0)))


def lines_drawn(pattern, model, edges):
    """Return a caption that counts edges of faces, and lines."""
    return told(pattern, edges=len(all_edges(model)), lines=len(edges))


def steps(width=240, height=180, model=TEAPOT, yaw=YAW):
    house = lists.read_lists(HOUSE)
    edges = unique_edges(house)
    yield "a house from the front", draw_edges(house["v"], edges, width, height)
    turned = turn(house["v"], yaw, PITCH)
    caption = lines_drawn("turned: {edges} edges of faces, {lines} lines", house, edges)
    yield caption, draw_edges(turned, edges, width, height)

    lists_of_it = lists.read_lists(model)
    edges = unique_edges(lists_of_it)
    turned = turn(lists_of_it["v"], yaw, PITCH)
    caption = lines_drawn("the model: {edges} edges of faces, {lines} lines", lists_of_it, edges)
    yield caption, draw_edges(turned, edges, width, height)

    view = engine_view(model, width, height, yaw)
    frame = e3d.render(
        *view,
        size=(width, height),
        wireframe="only",
        line_color=LINE,
        look="plain",
        samples=1,
        cull="back",
    )
    yield "the engine's, without the lines that faces hide", frame.color[:, :, :3]


if __name__ == "__main__":
    main(__file__, steps)
