"""What agents make with build123d, seen, cut and measured by the tools."""

import numpy as np
import pytest
from agents.conftest import Agent

pytest.importorskip("build123d", exc_type=ImportError)

CODE = """
import build123d as b
def build():
    plate = b.Box(40, 60, 20) - b.Cylinder(10, 40)
    plate.label, plate.color = "plate", b.Color("orange")
    pin = b.Cylinder(9, 50)
    pin.label = "pin"
    return b.Compound(label="both", children=[plate, pin])
"""


def test_an_assembly_is_seen_cut_and_measured(tmp_path):
    agent = Agent(tmp_path, allow_scripts=True)
    told = agent.told("script", code=CODE, name="both")
    assert told["parts"] == ["both/plate", "both/pin"]
    assert (told["unit"], told["up"]) == ("mm", "+Z")
    _, drawn = agent.picture("render", section={"axis": "y", "at": 0}, view={"azimuth": 20})
    areas = {one["name"]: one["area"] for one in drawn["cut"]}
    assert areas == {
        "both/plate": pytest.approx(20 * 20, rel=0.02),
        "both/pin": pytest.approx(18 * 50, rel=0.02),
    }
    assert agent.told("measure", objects="both/plate")["watertight"]
    gap = agent.told("distance", a="both/plate", b="both/pin")
    assert gap["distance"] == pytest.approx(1, abs=0.1) and not gap["touching"]
    agent.told("export", path="both.glb")
    again = agent.told("load", path="both.glb", name="again")
    np.testing.assert_allclose(again["bounds"], told["bounds"], atol=1e-3)
