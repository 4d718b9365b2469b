"""ROS's calibrations in YAML: what ``camera_calibration`` saves and ``ros2 topic echo`` prints."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..base.optional_packages import needed
from ..errors import InvalidArgumentError

_LARGEST = 1 << 16  # bytes; they have 1 kB


def is_calibration(data: bytes) -> bool:
    """Return whether text that is not JSON holds a ROS calibration."""
    return any(line.startswith(b"distortion_model:") for line in data[:_LARGEST].splitlines())


def calibration(data: bytes) -> Any:
    """Return the first document of a calibration.

    Raises
    ------
    InvalidArgumentError
        The text is no YAML, or much longer than a calibration; or PyYAML is not installed.
    """
    if len(data) > _LARGEST:
        raise InvalidArgumentError(f"a calibration of ROS has {_LARGEST} bytes at most")
    try:
        yaml = import_module("yaml")
    except ModuleNotFoundError:
        message = needed("a calibration of ROS in YAML needs", "PyYAML")
        raise InvalidArgumentError(message) from None
    try:
        # Aliases of aliases make a few bytes billions of numbers.
        if any(isinstance(token, yaml.AliasToken) for token in yaml.scan(data)):
            raise InvalidArgumentError("a calibration of ROS has no aliases")
        return next(yaml.safe_load_all(data))
    # PyYAML's constructors of tagged scalars raise what Python's do.
    except (yaml.YAMLError, ValueError, LookupError, AttributeError, RecursionError) as error:
        said = " ".join(str(error).split())
        raise InvalidArgumentError(f"damaged YAML: {said}") from None
