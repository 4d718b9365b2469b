"""What the viewer inspects: a section, and how far the parts are moved apart.

In: choices of the panels. Out: the model in the viewer, or a copy that is spread and cut. Where one
looks from, the lights and what is hidden stay.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ....base.language import translated
from ....model.measuring.cutting import Plane
from ....stage.inspection.taken_apart import TakenApart

if TYPE_CHECKING:
    from ....stage.viewed_scene import ViewedScene
    from ..state import ViewerState


class Inspector:
    """Cuts and spreads the model of a viewer.

    Parameters
    ----------
    viewer : ViewerState

    Attributes
    ----------
    is_cut : bool
        Whether there is a section.
    axis : int
        The axis across which the plane lies.
    share : float
        Where it is in the box of what is shown, from 0 to 1.
    from_above : bool
        Whether what has greater coordinates is cut off.
    amount : float
        How far parts are moved: 1 doubles their distances.
    """

    def __init__(self, viewer: ViewerState) -> None:
        self._viewer = viewer
        self.forget()

    def forget(self) -> None:
        """Begin anew with another model."""
        self.is_cut, self.axis, self.share, self.from_above = False, 0, 0.5, True
        self.amount = 0.0
        self._viewer.view_renderer.settings.measured = ()
        self._apart: TakenApart | None = None
        self._bounds = np.zeros((2, 3))

    @property
    def place(self) -> float:
        """Where the plane is, in the file's coordinates."""
        low, high = self._bounds[:, self.axis].tolist()
        origin = self._viewer.view_renderer.viewed.origin[self.axis]
        return low + (high - low) * self.share + origin

    @property
    def parts(self) -> int:
        """How many parts the model has; 0 while nothing was spread or cut."""
        return 0 if self._apart is None else self._apart.count

    def state_of_cuts(self) -> str:
        """Return whether the cuts are closed, as a text."""
        if self._apart is None or not self.is_cut:
            return ""
        if self._apart.uncut:
            return translated("too many instances: {names}", names=", ".join(self._apart.uncut))
        if self._apart.open_cuts:
            return translated("open: {names}", names=", ".join(self._apart.open_cuts))
        return translated("all cuts are closed")

    def arrange(self) -> None:
        """Show the model as it is chosen; what moves apart keeps its share of the picture."""
        viewer = self._viewer
        before = viewer.view_renderer.bounds.radius
        if self.is_cut or self.amount:
            self._spread()
        else:
            self._restore()
        growth = viewer.view_renderer.bounds.radius / before  # uncut: a section moves no camera
        if self.is_cut:
            self._cut()
        if viewer.walker is None:
            viewer.view.distance *= growth
        viewer.redraw()

    def _spread(self) -> None:
        if self._apart is None:
            self._apart = TakenApart(self._viewer.view_renderer.viewed)
            self._show(self._apart.viewed)
        before = self._bounds
        self._apart.spread(self.amount)
        self._bounds = np.array(self._apart.viewed.scene.bounds, np.float64)
        if not np.array_equal(before, self._bounds):
            self._renew()

    def _cut(self) -> None:
        at = self.place - self._apart.viewed.origin[self.axis]
        hidden = self._viewer.view_renderer.visibility.hidden_nodes
        self._apart.cut(Plane(self.axis, at, self.from_above), hidden)

    def _restore(self) -> None:
        if self._apart is not None:
            whole, self._apart = self._apart.whole, None
            self._bounds = np.zeros((2, 3))
            self._show(whole)

    def _show(self, viewed: ViewedScene) -> None:
        """Show another scene as the one before was shown; it stands still."""
        view_renderer = self._viewer.view_renderer
        theme, hidden = view_renderer.theme, view_renderer.visibility
        view_renderer.show(viewed, keep_appearance=True)
        view_renderer.staging.theme = theme
        view_renderer.visibility.take_over(hidden)
        self._viewer.selected = None
        self._viewer.playing = False

    def _renew(self) -> None:
        """Stand the stage around parts that moved, with the same background."""
        view_renderer = self._viewer.view_renderer
        theme = view_renderer.theme
        view_renderer.renew()
        view_renderer.staging.theme = theme
