"""Whatever is handed to anything public: a result, or an error of those that are promised."""

import warnings

import pytest
from public.hostile_calls import CALLS, wrong_values

import engine3d as e3d

ALLOWED = (e3d.Engine3DError, TypeError)


def outcome(function, arguments):
    """What is wrong with how a call ends: an error that is not promised, a warning of NumPy's."""
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        try:
            function(**arguments)
        except ALLOWED:
            pass
        except Exception as error:
            return f"{type(error).__name__}: {error}"
    others = [w for w in seen if not issubclass(w.category, e3d.Engine3DWarning)]
    return f"{others[0].category.__name__}: {others[0].message}" if others else None


@pytest.mark.parametrize("name", CALLS)
def test_right_arguments_pass(name):
    function, arguments = CALLS[name]
    function(**arguments)


@pytest.mark.parametrize("name", CALLS)
def test_wrong_arguments_end_as_promised(name):
    function, arguments = CALLS[name]
    wrong = []
    for what, right in arguments.items():
        for kind, value in wrong_values(right).items():
            found = outcome(function, {**arguments, what: value})
            if found:
                wrong.append(f"{name}({what}={kind}): {found}")
    assert not wrong, "\n".join(wrong)
