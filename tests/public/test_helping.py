"""Whether jobs are shared out, by what helpers got done lately (csrc/base/helping.h)."""

import numpy as np
import pytest
from kernels.calls import of_core, record

MILLISECOND = 1_000_000


def shares_alone(*phases, jobs=2000):
    """Of each phase, the share done alone: 20 s of jobs of 10 ms.

    A phase is what a job gets of the CPUs with helpers, what its caller then has of its own as long
    as it does not wait, and what it gets alone.
    """
    rates = np.repeat(np.array(phases, np.float64), jobs, axis=0)
    alone, helping, passed = np.empty(len(rates), bool), record("helping"), 10 * MILLISECOND
    note = of_core("e3d_helping_note")
    for k, (helped, own, by_itself) in enumerate(rates):
        alone[k] = is_alone = bool(helping["alone"][0])
        working = passed if is_alone else passed // 2
        done = int((by_itself if is_alone else helped) * passed)
        given = {"own": done if is_alone else int(own * working), "all": done}
        times = record("job_times", **given, working=working, passed=passed)
        note(helping, times, (k + 1) * passed)
    return alone.reshape(len(phases), jobs).mean(axis=1)


@pytest.mark.parametrize(
    "rates", [(1.9, 1.0, 1.0), (1.0, 1.0, 1.0), (0.75, 1.0, 0.99), (0.6, 0.4, 0.9), (0.2, 0.1, 0.1)]
)
def test_helpers_that_help_are_never_done_without(rates):
    assert shares_alone(rates) == 0


def test_those_that_are_waited_for_are():
    """As where a thread alone has a CPU, and two together get half of what that does."""
    assert shares_alone((0.5, 0.5, 1.0)) > 0.95
    assert shares_alone((0.3, 0.6, 0.6)) > 0.95


def test_trying_costs_little():
    assert shares_alone((0.5, 0.5, 0.5)) < 0.08


def test_what_changes_is_noticed():
    """Others come and go: within four seconds of twenty all help again."""
    quiet, crowded = (1.9, 1.0, 1.0), (0.45, 0.5, 0.9)
    first, second, third = shares_alone(quiet, crowded, quiet)
    assert first == 0 and second > 0.9 and third < 0.2
