"""How long tests wait for what they start, by the clock: for ever, nearly.

Time by the clock says how loud the machine is; what a thing costs is measured in processor time.
"""

HUNG = 900  # seconds after which what was started counts as hung
