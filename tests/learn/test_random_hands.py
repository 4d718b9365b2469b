"""Random hands on the course: pages fit, answers are told, nothing fails."""

import random

import pytest
from learn.random_hands import PROGRAMS, check_answers, play


@pytest.mark.parametrize("seed", range(4))
def test_hands_do_no_harm(seed):
    rng, done = random.Random(seed), []
    play(rng, PROGRAMS[:4], 20, done)
    assert len(done) > 15


@pytest.mark.parametrize("number", range(len(PROGRAMS)))
def test_any_answer_is_told(number):
    check_answers(random.Random(number), PROGRAMS[number])
