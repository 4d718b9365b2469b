"""Steer the ball with the arrow keys, and collect all coins before the time is over."""

import numpy as np

import engine3d as e3d
from engine3d import events, linalg

SIZE = 480, 300
TABLE, BALL, COIN, COINS, SECONDS = 6.0, 0.5, 0.45, 12, 40.0


def painted(mesh, **material):
    mesh.materials = [e3d.Material(**material)]
    return mesh


TOP = painted(e3d.cylinder(TABLE, 0.4, 96), color="#3f7d5c")
RIM = painted(e3d.torus(TABLE, 0.25, (96, 16)), color="#7a4a2a", roughness=0.4, metallic=0.0)
GLOBE = painted(e3d.icosphere(BALL, 1), color="#e0552f", flat_shading=True)
GOLD = painted(e3d.cylinder(COIN, 0.1, 32), color="#ffb52e", roughness=0.25, metallic=0.0)


class Game:
    def __init__(self):
        self.scene = e3d.Scene(background=e3d.Gradient("#8fb4d0", "#dfe9f0"), ambient="#8f99a6")
        self.scene.add(e3d.DirectionalLight((-0.5, -1.0, -0.4), "#fff0d8", 2.4, shadow="map"))
        pose = e3d.look_at((0, 10.5, 14), (0, -0.9, 0))
        self.scene.add(e3d.PerspectiveCamera(0.53), pose=pose)
        self.scene.add(TOP, translation=(0, -0.2, 0))
        self.scene.add(RIM, pose=linalg.rotation_x(np.pi / 2))
        self.ball = self.scene.add(GLOBE, translation=(0, BALL, 0))
        self.speed, self.time = np.zeros(3), 0.0
        random = np.random.default_rng(4)
        self.coins: list[e3d.Node] = []
        while len(self.coins) < COINS:
            place = random.uniform(-TABLE, TABLE, 3) * (1, 0, 1)
            if 1.5 < linalg.length(place) < TABLE - 1.0:
                self.coins.append(self.scene.add(GOLD, translation=place + (0, 0.6, 0)))

    @property
    def left(self):
        return sum(coin.visible for coin in self.coins)


def advance(game, dt, keys):
    game.time += dt
    push = ("Right" in keys) - ("Left" in keys), 0, ("Down" in keys) - ("Up" in keys)
    game.speed = (game.speed + 14 * dt * np.array(push)) * (1 - 0.9 * dt)
    way = game.speed * dt
    flat = (game.ball.translation + way) * (1, 0, 1)
    out = flat / max(linalg.length(flat), 1e-9)
    over = linalg.length(flat) - (TABLE - BALL - 0.2)
    if over > 0:  # the rim
        game.speed = game.speed - 1.7 * max(0.0, linalg.dot(game.speed, out)) * out
        way = way - over * out
    roll(game.ball, way)
    for coin in game.coins:
        coin.euler = np.pi / 2, 3 * game.time % (2 * np.pi), 0
        if linalg.length(coin.translation - game.ball.translation) < BALL + COIN:
            coin.visible = False


def roll(ball, way):
    ball.translation = ball.translation + way
    far = linalg.length(way)
    if far > 0:
        turn = linalg.quaternion_from_axis_angle((way[2], 0, -way[0]), far / BALL)
        ball.rotation = linalg.quaternion_multiply(turn, ball.rotation)


def draw(game, renderer):
    canvas = renderer.render(game.scene).canvas()
    seconds = max(0.0, SECONDS - game.time)
    canvas.text(10, 8, f"{game.left} coins   {seconds:.0f} s", "white", background=(0, 0, 0, 120))
    if game.left == 0 or seconds == 0:
        words = "Well done!" if game.left == 0 else "Time is over."
        canvas.text(SIZE[0] // 2 - 8 * len(words), 120, words, "white", scale=2)
    return canvas


def main():
    game = Game()
    with (
        e3d.Window((2 * SIZE[0], 2 * SIZE[1]), "Coins") as window,
        e3d.Renderer(SIZE, samples=4, antialiasing="msaa") as renderer,
    ):
        for event in window:
            match event:
                case events.KeyDown("Escape"):
                    window.close()
                case events.KeyDown("R"):
                    game = Game()
                case events.Tick(dt):
                    if game.left and game.time < SECONDS:
                        advance(game, min(dt, 0.05), window.keys)
                    window.present(draw(game, renderer))


if __name__ == "__main__":
    main()
