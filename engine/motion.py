"""What moves: clips and their channels, skins, morph targets, robots."""

from .model.geometry.morph_targets import MorphTarget
from .model.motion.clips import AnimationClip, Channel
from .model.motion.properties import PropertyChannel
from .model.motion.robots import Joint, Robot
from .model.motion.skins import Skin

__all__ = ["AnimationClip", "Channel", "MorphTarget", "PropertyChannel", "Skin"]
__all__ += ["Joint", "Robot"]
