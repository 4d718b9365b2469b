"""A lighthouse on an island, as a model on a stand: island.obj, .mtl, two textures.

Everything is arithmetic: the land is a sum of noises with two levelled places, the buildings are
profiles turned about an axis, boxes and lofts, the textures are painted by functions.
"""

from images import webp
from island_details import details_texture
from island_land import COTTAGE, SEA_RADIUS, TOWER, ground_texture, land_surface, sea_surface
from island_objects import (
    boat,
    cottage,
    gulls,
    jetty,
    lighthouse,
    plants,
    rock_spots,
    rocks,
    stand,
    tree_spots,
)
from model_files import mtl, obj

MATERIALS = {
    "ground": {"Kd": (1, 1, 1), "map_Kd": "island_ground.webp"},
    "sea": {"Kd": (1, 1, 1), "Ks": (0.35, 0.35, 0.35), "Ns": 60, "map_Kd": "island_ground.webp"},
    "details": {"Kd": (1, 1, 1), "map_Kd": "island_details.webp"},
    "lantern": {"Kd": (0.9, 0.8, 0.5), "Ke": (0.9, 0.65, 0.25), "Ks": (0.6, 0.6, 0.6), "Ns": 80},
}


def build():
    """Return the model's files, by name, as functions that make them."""
    title = "A lighthouse on an island"
    return {
        "island.obj": lambda: obj(title, surfaces(), "island.mtl", relative=True),
        "island.mtl": lambda: mtl(title, MATERIALS),
        "island_ground.webp": lambda: webp(ground_texture(standing())),
        "island_details.webp": lambda: webp(details_texture()),
    }


def surfaces():
    """Return everything that the model shows."""
    return [
        land_surface(),
        sea_surface(),
        *lighthouse(),
        *cottage(),
        *plants(),
        *rocks(),
        *jetty(),
        *boat(),
        *gulls(),
        *stand(SEA_RADIUS),
    ]


def standing():
    """Return what stands on the ground, as (x, z, radius)."""
    trees = [(x, z, 0.20 + 0.1 * size) for x, _, z, size, _ in tree_spots()]
    stones = [(x, z, 0.15 + 0.2 * size) for x, _, z, size, _ in rock_spots()]
    return trees + stones + [(TOWER[0], TOWER[1], 0.62), (COTTAGE[0], COTTAGE[1], 0.62)]
