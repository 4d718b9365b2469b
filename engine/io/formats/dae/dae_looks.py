"""The materials of a COLLADA file.

In: ``<material>`` elements. Out: materials with the colour, texture, emission and opacity of their
effects. Colours are display values. Highlights, and effects besides the common profile, are left
out.
"""

from __future__ import annotations

from ....errors import Engine3DError
from ....model.materials.material import Material
from ....model.materials.textures import Texture
from ...addresses.linked_urls import linked_files
from ...reading.linked_files import LinkedFileError
from ...reading.linked_textures import TextureCache
from ...reading.text import shown
from ...reading.xml_elements import Element
from .dae_file import DaeFile

_SHADERS = ("phong", "blinn", "lambert", "constant")


class Looks:
    """Reads the materials of a file, each once."""

    def __init__(self, file: DaeFile) -> None:
        self._file = file
        self._textures = TextureCache(linked_files(file.source, file.warnings))
        self._made: dict[int, Material] = {}

    @property
    def materials(self) -> tuple[Material, ...]:
        """All materials that were asked for."""
        return tuple(self._made.values())

    def material(self, url: str) -> Material | None:
        """Return the material of a URL; None if there is none."""
        element = self._file.find(url, "material")
        if element is None:
            return None
        if id(element) not in self._made:
            self._made[id(element)] = self._read(element)
        return self._made[id(element)]

    def _read(self, element: Element) -> Material:
        material = Material(name=element.attributes.get("name") or element.attributes.get("id", ""))
        used = element.first("instance_effect")
        effect = None if used is None else self._file.find(used.attributes.get("url", ""), "effect")
        profile = None if effect is None else effect.first("profile_COMMON")
        technique = None if profile is None else profile.first("technique")
        shader = (
            None
            if technique is None
            else next((child for child in technique.children if child.name in _SHADERS), None)
        )
        if effect is None or profile is None or technique is None or shader is None:
            self._file.warn(f"material {shown(material.name)} has no common effect", element)
            return material
        self._fill(material, shader, profile)
        for extra in (*technique.all("extra"), *profile.all("extra"), *effect.all("extra")):
            for one in extra.all("technique"):
                sided = one.first("double_sided")
                if sided is not None and sided.text.strip() in ("1", "true"):
                    material.two_sided = True
        return material

    def _fill(self, material: Material, shader: Element, profile: Element) -> None:
        """Give a material what its shader states."""
        base = "emission" if shader.name == "constant" else "diffuse"
        color, texture = self._color(shader, base), shader.first(base, "texture")
        if texture is not None:
            material.texture = self._texture(texture, profile)
        elif color is not None:
            material.color = color[:3]
        if shader.name == "constant":
            material.unlit = True
        elif (glow := self._color(shader, "emission")) is not None:
            material.emissive = glow[:3]
        opacity = self._opacity(shader)
        if opacity < 1.0:
            material.color = (*(color or (1.0, 1.0, 1.0))[:3], opacity)
            material.alpha_mode = "blend"
        elif texture is not None and shader.first("transparent", "texture") is not None:
            material.alpha_mode = "blend"

    def _color(self, shader: Element, name: str) -> tuple[float, ...] | None:
        held = shader.first(name, "color")
        values = self._file.numbers(held)[:4].tolist()
        if held is None or len(values) < 3:
            return None
        return tuple(min(max(value, 0.0), 1.0) for value in values)

    def _opacity(self, shader: Element) -> float:
        """Return the opacity: 1 for what would not be seen, as some programs wrote it inverted."""
        factor = shader.first("transparency", "float")
        amount = self._file.numbers(factor)[:1].tolist() if factor is not None else [1.0]
        transparent = shader.first("transparent")
        color = self._color(shader, "transparent")
        if transparent is None or color is None:
            opacity = amount[0] if amount else 1.0
        elif transparent.attributes.get("opaque", "A_ONE") == "RGB_ZERO":
            opacity = 1.0 - amount[0] * sum(color[:3]) / 3.0 if amount else 1.0
        else:
            opacity = amount[0] * (color[3] if len(color) > 3 else 1.0) if amount else 1.0
        return opacity if 0.0 < opacity < 1.0 else 1.0

    def _texture(self, used: Element, profile: Element) -> Texture | None:
        """Return the texture of an effect: by sampler and surface, or by the image itself."""
        name = used.attributes.get("texture", "")
        for _ in range(2):
            param = next(
                (p for p in profile.all("newparam") if p.attributes.get("sid") == name), None
            )
            if param is None:
                break
            inner = (
                param.first("sampler2D", "source")
                or param.first("surface", "init_from")
                or param.first("sampler2D", "instance_image")
            )
            if inner is None:
                break
            name = inner.text.strip() or inner.attributes.get("url", "")
        image = self._file.find(name, "image")
        held = None if image is None else image.first("init_from")
        if held is None:
            self._file.warn(f"texture {shown(name)} is left out: it names no image", used)
            return None
        file = (held.text.strip() or (ref.text.strip() if (ref := held.first("ref")) else "")) or ""
        try:
            texture, note = self._textures.get(file, None, "repeat")
        except (LinkedFileError, Engine3DError) as error:
            self._file.warn(f"{shown(file)}: {error}", held)
            return None
        if note:
            self._file.warn(f"{shown(file)}: {note}", held)
        return texture
