"""Packages that extend engine3d: readers, writers, data sets, commands, scenes, looks."""

from .base.plugins.groups import API
from .base.plugins.plugin import Plugin
from .base.plugins.registration import register, unregister
from .base.plugins.registry import listed
from .io.plugins.plugin_files import PluginFile

__all__ = ["API", "Plugin", "PluginFile", "listed", "register", "unregister"]
