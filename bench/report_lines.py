"""Draws lines over a common horizontal axis as SVG: panels two abreast, a line for each mesh, in the style of report_plot."""

import dataclasses
import math

from report_picture import legend, shape, text
from report_plot import BOTTOM, HEIGHT, LAYOUT, LEFT, RIGHT, TOP, WIDTH

# As report_plot's: Okabe and Ito (2008), and shapes that say the same again.
STYLES = (("#D55E00", "diamond"), ("#0072B2", "circle"), ("#009E73", "square"), ("#8A5A83", "triangle"))


@dataclasses.dataclass
class Point:
    x: float
    y: float | None  # None: nothing to show but the range
    low: float | None = None
    high: float | None = None


@dataclasses.dataclass
class Line:
    name: str
    points: list
    dashed: bool = False


@dataclasses.dataclass
class Panel:
    title: str
    lines: list
    across: str
    logarithmic: bool = True
    floor: float | None = None  # of the vertical axis; a range below it is cut off there


class Scale:
    def __init__(self, panel):
        points = [point for line in panel.lines for point in line.points]
        values = [v for p in points for v in (p.y, p.low, p.high) if v is not None and (v > 0 or not panel.logarithmic)]
        self.logarithmic = panel.logarithmic
        self.left, self.right = min(p.x for p in points), max(p.x for p in points)
        self.low = panel.floor if panel.floor is not None else min(values) / (1.5 if self.logarithmic else 1) * 1.0
        self.high = max(values) * (1.5 if self.logarithmic else 1.05)
        if not self.logarithmic:
            self.low = 0.0

    def x(self, value):
        return LEFT + 14 + (value - self.left) / max(self.right - self.left, 1e-9) * (WIDTH - LEFT - RIGHT - 28)

    def y(self, value):
        if self.logarithmic:
            share = math.log(max(value, self.low) / self.low) / math.log(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM)

    def ticks(self):
        if self.logarithmic:
            powers = range(math.ceil(math.log10(self.low)), math.floor(math.log10(self.high)) + 1)
            return [(10.0 ** power, f"{10.0 ** power:g}") for power in powers]
        step = 10.0 ** math.floor(math.log10(self.high / 2))
        step *= next(f for f in (1, 2, 5, 10) if self.high / (step * f) <= 6)
        return [(i * step, f"{i * step:g}") for i in range(int(self.high / step) + 1)]


def draw_axes(panel, scale):
    bottom = HEIGHT - BOTTOM
    parts = [f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" height="{bottom - TOP}" fill="none" '
             'stroke="#888"/>']
    for value in sorted({point.x for line in panel.lines for point in line.points}):
        x = scale.x(value)
        parts.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{bottom}" stroke="#eee"/>')
        parts.append(text(x, bottom + 15, f"{value:g}", "middle"))
    for value, words in scale.ticks():
        y = scale.y(value)
        parts.append(f'<line x1="{LEFT}" y1="{y:.1f}" x2="{WIDTH - RIGHT}" y2="{y:.1f}" stroke="#e4e4e4"/>')
        parts.append(text(LEFT - 4, y + 4, words, "end"))
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 8, panel.across, "middle"))
    parts.append(text(LEFT, TOP - 9, panel.title, extra=' font-weight="bold"'))
    return parts


def draw_panel(panel, styles):
    scale = Scale(panel)
    parts = draw_axes(panel, scale)
    for line in panel.lines:
        colour, kind = styles[line.name]
        shown = [(scale.x(p.x), scale.y(p.y)) for p in line.points if p.y is not None and (p.y > 0 or not panel.logarithmic)]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in shown)
        dash = ' stroke-dasharray="5 3"' if line.dashed else ""
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.2"{dash}/>')
        for point in line.points:
            if point.low is not None and point.high is not None:
                x = scale.x(point.x)
                parts.append(f'<line x1="{x:.1f}" y1="{scale.y(point.low):.1f}" x2="{x:.1f}" '
                             f'y2="{scale.y(point.high):.1f}" stroke="{colour}" stroke-width="1.5"/>')
        parts += [shape(kind, x, y, colour, 3.5) for x, y in shown]
    return parts


def draw(title, panels):
    names = list(dict.fromkeys(line.name for panel in panels for line in panel.lines))
    styles = {name: STYLES[i % len(STYLES)] for i, name in enumerate(names)}
    header = [text(LEFT, 21, title, extra=' font-size="15" font-weight="bold"'), *legend(styles, LEFT)]
    return LAYOUT.draw(header, panels, lambda panel: draw_panel(panel, styles))
