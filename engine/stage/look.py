"""Looks: how models are lit, and what they stand before.

In: a name, or a `Look` with some values replaced. Out: an immutable `Look`, which `Staging` applies
beside a scene that has no light of its own.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, fields
from typing import Any, Literal, TypeAlias, get_args

from ..base.calls import hints_keywords, refuse_unknown
from ..base.numbers import shown
from ..base.plugins.open_choices import OpenChoices
from ..base.plugins.registry import find_plugin
from ..base.validation import choose, flag, not_negative
from ..choices import Backdrop, ColorLike, LightSetup, LightShadow, LookName, ToneMapping
from ..errors import InvalidArgumentError
from ..model.environments.environment import Environment
from ..model.materials.colors import check_color
from ..model.scene.gradients import Gradient

LOOKS: tuple[LookName, ...] = get_args(LookName)
#: These, and the looks of plug-ins.
LOOK_CHOICES = OpenChoices("looks", LOOKS)
#: Backgrounds in the colours of a theme.
THEMED: tuple[str, ...] = ("auto", "dark", "light")
_BACKDROPS = get_args(Backdrop)
_TONE_MAPPINGS = get_args(ToneMapping)


@hints_keywords
@dataclass(frozen=True, kw_only=True)
class Look:
    """How models are lit, and what they stand before.

    `Look.studio`, whose values are the defaults, and `Look.plain` make looks; `replace` returns
    another one with other values. Looks are immutable, and can be compared, hashed, copied and
    pickled.

    Attributes
    ----------
    lights : {"studio", "headlight", "sun", "two colours"} or None
        A set of lights, most of which follow the camera, and soft light from above and below. With
        None, a white light shines from the camera, and the scene's own ambient light stays.
    light_intensity : float
        Factor on the intensities of these lights.
    background : {"auto", "dark", "light", "scene"}, colour, Gradient, Environment or None
        ``"dark"`` and ``"light"`` are gradients, of which ``"auto"`` takes the one that the model
        contrasts with; ``"scene"`` is the scene's own; None is transparent.
    ground : bool or "mirror"
        Whether the model casts a soft shadow on an invisible ground; ``"mirror"``: which also
        reflects it, as a polished floor does.
    environment : bool
        Whether surfaces reflect a studio if the scene has no environment: grey walls, a light
        floor, soft boxes.
    shadow : {"none", "map", "exact"}
        The shadows that the brightest of these lights cast: soft ones with ``"map"``. The scene's
        own lights keep theirs.
    feature_edges : bool or "auto"
        Whether the edges of faceted meshes are drawn thin: sharp ones and borders, those that show.
        ``"auto"`` draws them on meshes that state no material and whose faces mostly meet either
        flat or sharply, as those of machine parts do.
    tone_mapping, ambient_occlusion
        As in `RenderOptions`.
    """

    lights: LightSetup | None = "studio"
    light_intensity: float = 1.0
    background: Backdrop | ColorLike | Gradient | Environment | None = "auto"
    ground: bool | Literal["mirror"] = True
    environment: bool = True
    shadow: LightShadow = "map"
    feature_edges: bool | Literal["auto"] = "auto"
    tone_mapping: ToneMapping = "neutral"
    ambient_occlusion: bool = True

    def __post_init__(self) -> None:
        if self.lights is not None:
            choose(self.lights, get_args(LightSetup), "lights")
        not_negative(self.light_intensity, "light_intensity")
        choose(self.tone_mapping, _TONE_MAPPINGS, "tone_mapping")
        choose(self.shadow, get_args(LightShadow), "shadow")
        for name, word in (("ground", "mirror"), ("feature_edges", "auto")):
            chosen = choose(getattr(self, name), (True, False, word), name)
            vars(self)[name] = chosen if chosen == word else flag(chosen, name)
        for name in ("environment", "ambient_occlusion"):
            flag(getattr(self, name), name)
        vars(self)["background"] = _background(self.background)

    @classmethod
    def studio(cls, **changes: Any) -> Look:
        """Return the default look: three lights, soft shadows, a gradient.

        Parameters
        ----------
        **changes
            Attributes with other values.

        Raises
        ------
        InvalidArgumentError

        Examples
        --------
        >>> e3d.render(e3d.torus(), look=e3d.Look.studio(ground=False, background="dark"))
        """
        return _STUDIO.replace(**changes)

    @classmethod
    def plain(cls, **changes: Any) -> Look:
        """Return the look that adds nothing: a light at the camera, and the scene's background.

        Parameters
        ----------
        **changes
            Attributes with other values.

        Raises
        ------
        InvalidArgumentError
        """
        return _PLAIN.replace(**changes)

    def replace(self, **changes: Any) -> Look:
        """Return this look with other values of some attributes.

        Raises
        ------
        InvalidArgumentError
        """
        refuse_unknown("Look", changes, [one.name for one in fields(Look)])
        return dataclasses.replace(self, **changes)

    @property
    def options(self) -> dict[str, Any]:
        """The drawing options of the look, as keyword arguments of `Renderer.render`."""
        return {"tone_mapping": self.tone_mapping, "ambient_occlusion": self.ambient_occlusion}


#: What callers may give as a look; a str may also name a look that a package adds.
LookChoice: TypeAlias = LookName | str | Look


def check_look(value: LookChoice) -> Look:
    """Return the look that a name stands for; a `Look` is returned unchanged.

    Raises
    ------
    InvalidArgumentError
    PluginError
        The look of this name is a plug-in's, which is broken.
    """
    if isinstance(value, Look):
        return value
    if isinstance(value, str):
        if value in _SHIPPED:
            return _SHIPPED[value]
        if (plugin := find_plugin("looks", value)) is not None:
            look: Look = plugin.use()
            return look
    names = ", ".join(f'"{name}"' for name in LOOK_CHOICES)
    raise InvalidArgumentError(f"look must be {names} or a Look, not {shown(value)}")


def shipped_names() -> set[str]:
    """Return the names of the looks that engine3d itself has."""
    return set(LOOKS)


def _background(value: Any) -> Any:
    """Return a background, checked."""
    if value is None or isinstance(value, (Gradient, Environment)):
        return value
    if isinstance(value, str) and value in _BACKDROPS:
        return value
    return check_color(value, "background")


_STUDIO = Look()
_PLAIN = Look(
    lights=None,
    background="scene",
    ground=False,
    environment=False,
    shadow="none",
    feature_edges=False,
    tone_mapping="none",
    ambient_occlusion=False,
)
_SHIPPED: dict[str, Look] = {"studio": _STUDIO, "plain": _PLAIN}
