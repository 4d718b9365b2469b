"""The French texts of ``engine3d learn``: titles, captions and the keys.

In the texts below, {} stands for each number of a caption, in order. Captions are drawn with a font
for ASCII and French letters only.
"""

from __future__ import annotations

import re

STEP = "étape {} - flèches : étapes, N P : leçons"
KEYS = "Flèches : étapes. N et P : leçons. Q : quitter. Le programme : {}"

TITLES = (
    "Un modèle, ce sont des listes",
    "Des points",
    "Des lignes",
    "Le fil de fer",
    "Remplir des triangles : balayage et fonctions d'arête",
    "Des couleurs au hasard",
    "La lumière et les faces arrière",
    "L'algorithme du peintre",
    "Le y-buffer",
    "Le z-buffer",
    "Les textures",
    "La vitesse : images par seconde, options et SIMD",
    "Les rotations : 12, 9 et 6 multiplications",
    "Le cube : sommets, arêtes, faces",
    "Les fichiers ASCII de 3D Studio",
    "La perspective",
    "La lumière d'un point : E = I / d² · cos θ",
    "Quadrilatères, boîtes, sphères",
    "Une caméra, et la marche",
    "256 lumières : rendu direct et différé",
    "Les blocs et la pyramide de vue",
    "Un octree qui suit ce qui bouge",
    "Les ressources, les transformations, et Soleil–Terre–Lune",
    "Moins de travail : masquage, détail, fréquence, instances, regroupement",
)

CAPTIONS = {
    "{} vertices: x y z": "{} sommets : x y z",
    "{} texture coordinates: u v": "{} coordonnées de texture : u v",
    "{} normals: x y z": "{} normales : x y z",
    "{} faces as given: v, v/vt, v//vn or v/vt/vn of each corner": "{} faces telles "
    "qu'elles sont écrites : v, v/vt, v//vn ou v/vt/vn pour chaque coin",
    "one face, followed to its lists": "une face, suivie jusque dans les listes",
    "{} vertices, their x and y taken for pixels": "{} sommets, x et y pris pour des pixels",
    "scaled and moved, but y grows downward": "mis à l'échelle et déplacés, mais y va vers le bas",
    "y turned over": "y renversé",
    "z left out of the place, but shown as brightness": "z ne compte pas pour la position : c'est "
    "la luminosité qui le montre",
    "first try: {} directions from the middle": "premier essai : {} directions depuis le centre",
    "DDA: {} directions from the middle": "DDA : {} directions depuis le centre",
    "Bresenham: {} directions from the middle": "Bresenham : {} directions depuis le centre",
    "tutorial Line(): {} directions from the middle": "Line() des vieux tutoriels : {} directions "
    "depuis le centre",
    "DDA against Bresenham: in colour where they differ": "DDA et Bresenham : en couleur, là où "
    "ils diffèrent",
    "tutorial Line() against Bresenham: in colour where they differ": "Line() des vieux tutoriels "
    "et Bresenham : en couleur, là où ils diffèrent",
    "a house from the front": "une maison vue de face",
    "turned: {} edges of faces, {} lines": "tournée : {} arêtes de faces, {} lignes",
    "the model: {} edges of faces, {} lines": "le modèle : {} arêtes de faces, {} lignes",
    "the engine's, without the lines that faces hide": "celui du moteur, sans les lignes que les "
    "faces cachent",
    "the sweep: {} pixels, row by row": "le balayage : {} pixels, ligne par ligne",
    "edge functions: a colour for each edge; all three are positive inside": "fonctions d'arête : "
    "une couleur par arête ; à l'intérieur, toutes trois sont positives",
    "two triangles without the top-left rule: red pixels are drawn twice": "deux triangles sans la "
    "règle du bord haut-gauche : les pixels rouges sont dessinés deux fois",
    "with the rule: each pixel once, no holes": "avec la règle : chaque pixel une fois, aucun trou",
    "the first {} triangles of the file": "les {} premiers triangles du fichier",
    "the engine's mode 'random': only what is in front shows": "le mode 'random' du moteur : seul "
    "ce qui est devant se voit",
    "a cube, all {} triangles in the order of their list": "un cube, les {} triangles dans l'ordre "
    "de la liste",
    "only the {} that face us: {} pixels are wrong": "seulement les {} qui nous font face : "
    "{} pixels faux",
    "the model, all {} triangles": "le modèle, les {} triangles",
    "only the {} that face us": "seulement les {} qui nous font face",
    "{} pixels still show what is behind something else": "{} pixels montrent encore ce qui est "
    "derrière autre chose",
    "the farthest {}% of the triangles": "les {} % de triangles les plus éloignés",
    "all of them": "tous",
    "{} pixels are wrong": "{} pixels sont faux",
    "three triangles over each other in a circle, order [{}, {}, {}]": "trois triangles qui se "
    "recouvrent en cercle, dans l'ordre [{}, {}, {}]",
    "what it should be": "ce qu'il faudrait voir",
    "three triangles, and the plane that cuts them": "trois triangles, et le plan qui les coupe",
    "the cut from above: the viewer is below": "la coupe vue de dessus : l'observateur est en bas",
    "buffer and row after segment {}": "le tampon et la ligne après le segment {}",
    "the row, and below it that of the picture: {} pixels differ": "la ligne et, au-dessous, celle "
    "de l'image : {} pixels diffèrent",
    "after triangle {}: picture and buffer": "après le triangle {} : l'image et le tampon",
    "after {} triangles of the model": "après {} triangles du modèle",
    "{} pixels differ from the engine's": "{} pixels diffèrent de ceux du moteur",
    "the texture, every texel in {}": "la texture, un texel sur {}",
    "u as red, v as green": "u en rouge, v en vert",
    "the nearest texel of each pixel": "le texel le plus proche pour chaque pixel",
    "times the light": "multiplié par la lumière",
    "{} at a time: {} steps, {} pixels in vain": "par {} : {} pas, {} pixels pour rien",
    "the engine, one lane and one thread": "le moteur, une voie et un fil d'exécution",
    "the engine, all lanes and threads: {} pixels differ": "le moteur, toutes les voies et tous "
    "les fils d'exécution : {} pixels diffèrent",
    "{} multiplications: {} pixels differ from the first": "{} multiplications : {} pixels "
    "diffèrent de la première image",
    "{} vertices: each bit is a coordinate": "{} sommets : chaque bit est une coordonnée",
    "{} edges: numbers that differ in one bit; dark ones are hidden": "{} arêtes : des numéros qui "
    "diffèrent d'un bit ; les arêtes sombres sont cachées",
    "the {} that faces do not hide": "les {} que les faces ne cachent pas",
    "{} faces, of which {} look at us": "{} faces, dont {} nous regardent",
    "turned {} times": "après {} rotations",
    "a file in this format": "un fichier dans ce format",
    "all {} edges of the triangles": "les {} arêtes des triangles",
    "the {} whose flag is {}; the engine finds {}": "les {} dont l'indicateur vaut {} ; le moteur "
    "en trouve {}",
    "{} objects, all {} edges": "{} objets, {} arêtes en tout",
    "the {} edges of the model": "les {} arêtes du modèle",
    "without perspective: three cubes in a row": "sans perspective : trois cubes alignés",
    "on the virtual screen: divided by z": "sur l'écran virtuel : divisé par z",
    "a floor, u and v mixed as on the screen: bent": "un sol, u et v interpolés comme à l'écran : "
    "la texture se tord",
    "u/z, v/z and {}/z mixed, then divided: straight": "u/z, v/z et {}/z interpolés, "
    "puis divisés : la texture est droite",
    "the floor goes on behind the eye: corners there are mirrored": "le sol continue derrière "
    "l'œil : les coins y sont inversés",
    "cut off at the near plane first": "d'abord coupé au plan proche",
    "the engine's: {} of {} pixels differ": "celui du moteur : {} pixels sur {} diffèrent",
    "one E for each of {} x {} faces": "un E pour chacune des {} x {} faces",
    "{} x {} faces": "{} x {} faces",
    "more than {} does not fit into a byte: it wraps": "au-delà de {}, l'octet déborde et repart "
    "de zéro",
    "one E for each pixel, between {} and {}": "un E par pixel, entre {} et {}",
    "the engine's: off by {} at most": "celui du moteur : un écart d'au plus {}",
    "the engine's, one E for each of {} triangles": "celui du moteur, un E pour chacun des {} "
    "triangles",
    "three lights add up": "trois lumières s'additionnent",
    "a quad is two triangles: bent, they have two normals": "un quadrilatère, ce sont deux "
    "triangles : plié, il a deux normales",
    "one normal across both diagonals: one even shade": "une seule normale, par les deux "
    "diagonales : une teinte uniforme",
    "a box from {} points": "une boîte à partir de {} points",
    "any {} points; {} pixels differ from the engine's hexahedron": "{} points quelconques ; "
    "{} pixels diffèrent de l'hexaèdre du moteur",
    "{} x {}: {} triangles, the engine's has {}": "{} x {} : {} triangles, celle du moteur en a {}",
    "a map, and the path of one who walks": "un plan, et le chemin d'un promeneur",
    "after {} steps, at ({}, {})": "après {} pas, en ({}, {})",
    "the engine's Walker: {} m from there at most": "le Walker du moteur : à {} m de là au plus",
    "the G-buffer: depth, normal, albedo": "le G-buffer : profondeur, normale, albédo",
    "deferred, {} light": "différé, {} lumière",
    "deferred, {} lights": "différé, {} lumières",
    "forward, {} lights: {} shadings instead of {}; {} pixels differ": "direct, {} lumières : "
    "{} calculs d'éclairage au lieu de {} ; {} pixels diffèrent",
    "chunks of {} x {} by the centre: {} of {}, {} triangles; {} pixels lost": "blocs de {} x {}, "
    "d'après le centre : {} sur {}, {} triangles ; {} pixels perdus",
    "chunks of {} x {} by the corners: {} of {}, {} triangles; {} pixels lost": "blocs de "
    "{} x {}, d'après les coins : {} sur {}, {} triangles ; {} pixels perdus",
    "chunks of {} x {} by the p-vertex: {} of {}, {} triangles; {} pixels lost": "blocs de "
    "{} x {}, d'après le p-sommet : {} sur {}, {} triangles ; {} pixels perdus",
    "the engine, too, finds {} of {} chunks in the frustum": "le moteur aussi trouve {} blocs sur "
    "{} dans la pyramide de vue",
    "cut into {} chunks of {} x {}, a colour each": "découpé en {} blocs de {} x {}, une couleur "
    "chacun",
    "{} balls in an octree, from above": "{} boules dans un octree, vues de dessus",
    "time {}: {} seen by {} tests, the same as by {}; {} changes of cell": "instant {} : {} boules "
    "vues en {} tests, les mêmes qu'en {} ; {} changements de cellule",
    "day {}: {} products of matrices; the engine's poses agree": "jour {} : {} produits de "
    "matrices ; les poses du moteur sont les mêmes",
    "only the moon moved: {} products": "seule la Lune a bougé : {} produits",
    "the wall alone, drawn first": "le mur seul, dessiné d'abord",
    "{} of {} boxes may show; {} pixels differ from all of them": "{} boîtes sur {} peuvent se "
    "voir ; {} pixels diffèrent de l'image complète",
    "levels of detail: {} triangles instead of {}": "niveaux de détail : {} triangles "
    "au lieu de {}",
    "updates: {} moves in {} frames instead of {}": "mises à jour : {} mouvements en {} images au "
    "lieu de {}",
    "nodes one by one: {} draws; {} pixels differ": "nœuds un par un : {} appels de dessin ; "
    "{} pixels diffèrent",
    "nodes in a batch: {} draws; {} pixels differ": "nœuds regroupés : {} appels de dessin ; "
    "{} pixels diffèrent",
    "instances: {} draws; {} pixels differ": "instances : {} appels de dessin ; "
    "{} pixels diffèrent",
}
_NUMBER = re.compile(r"(?<![\w.-])-?\d+(?:\.\d+)?")


def title_in_french(number: int) -> str:
    """Return the French title of a lesson, by its index from 0."""
    return f"{number + 1:2}. {TITLES[number]}"


def caption_in_french(caption: str) -> str:
    """Return a caption in French; unknown ones are unchanged."""
    french = CAPTIONS.get(_NUMBER.sub("{}", caption))
    return caption if french is None else french.format(*_NUMBER.findall(caption))
