"""A chart of horizontal bars in groups.

In:  rows of (label, one value for each series or None), names of the series.
Out: a file; its suffix says whether it is SVG text or an image.
"""

from __future__ import annotations

from chart import COLORS, GRID, Chart

BAR, GAP, LEFT, TOP, PLOT, RIGHT = 12, 12, 236, 46, 480, 60


def lay_out(title, rows, series):
    """Arrange a chart: a group of bars for each row, one bar a series, its value beside it."""
    group = len(series) * BAR + GAP
    most = max(value for _, values in rows for value in values if value is not None)
    chart = Chart(LEFT + PLOT + RIGHT, TOP + len(rows) * group + GAP)
    step = next(s for s in (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if most / s <= 10)
    for tick in range(int(most / step) + 1):
        x = LEFT + PLOT * tick * step / most
        chart.rectangle(x, TOP - 4, 1, len(rows) * group + 4, GRID)
        chart.text(x - 3, TOP - 14, f"{tick * step:g}")
    chart.text(8, 8, title)
    for number, name in enumerate(series):
        chart.rectangle(LEFT + 110 * number, 22, BAR, BAR, COLORS[number % len(COLORS)])
        chart.text(LEFT + 110 * number + BAR + 4, 22, name)
    for row, (label, values) in enumerate(rows):
        y = TOP + row * group + GAP // 2
        chart.text(8, y + (len(series) * BAR) // 2 - 4, label)
        for number, value in enumerate(values):
            if value is not None:
                bar = PLOT * value / most
                color = COLORS[number % len(COLORS)]
                chart.rectangle(LEFT, y + number * BAR, bar, BAR - 1, color)
                chart.text(LEFT + bar + 4, y + number * BAR + 1, f"{value:.1f}")
    return chart


def save(path, title, rows, series):
    """Write the chart of rows [(label, values)] to a file, whole or not at all."""
    lay_out(title, rows, series).save(path)
