"""The public names of the top level, and of the modules whose names are unlike all others."""

import engine3d as e3d

#: Names of these modules are told from others by the module's name.
OWN_NAMES = ("batch", "choices", "datasets", "events", "linalg", "loaders", "plugins")
UNLIKE_OTHERS = tuple(module for module in e3d._MODULES if module not in OWN_NAMES)


def public_things():
    """Everything public outside of `OWN_NAMES`, by its name."""
    found = {name: getattr(e3d, name) for name in e3d._PUBLIC}
    for module in UNLIKE_OTHERS:
        package = getattr(e3d, module)
        found |= {name: getattr(package, name) for name in package.__all__}
    return found
