"""Draws points over two axes as SVG: panels two abreast, a labelled mark for each point, lines for paths."""

import dataclasses
import math

import palette
from report_picture import Layout, shape, text


@dataclasses.dataclass
class Point:
    name: str  # empty: no label
    x: float
    y: float
    group: int = 0  # selects colour and shape


@dataclasses.dataclass
class Panel:
    title: str
    points: list
    across: str
    up: str
    logarithmic: bool = True  # both axes
    path: bool = False  # joins the points of a group in their order
    diagonal: bool = False  # the line on which both values are equal


WIDTH, HEIGHT = 430, 330  # of a panel
LEFT, RIGHT, TOP, BOTTOM = 56, 16, 30, 42
LETTER = 6.0


class Axis:
    def __init__(self, values, logarithmic, begin, end):
        self.logarithmic, self.begin, self.end = logarithmic, begin, end
        low, high = min(values), max(values)
        if logarithmic:
            self.low, self.high = low / 1.25, high * 1.35
        else:
            self.low, self.high = 0.0, high * 1.1 or 1.0

    def at(self, value):
        if self.logarithmic:
            share = math.log(value / self.low) / math.log(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return self.begin + share * (self.end - self.begin)

    def ticks(self):
        if self.logarithmic:
            powers = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
            steps = (1, 2, 5) if self.high / self.low < 200 else (1,)
            return [v for p in powers for f in steps if self.low <= (v := f * 10.0 ** p) <= self.high]
        step = 10.0 ** math.floor(math.log10(self.high / 2))
        step *= next(f for f in (1, 2, 5, 10) if self.high / (step * f) <= 6)
        return [i * step for i in range(int(self.high / step) + 1)]


def tick(value):
    return f"{value:,.0f}" if value >= 1000 else f"{value:.4g}"


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def label(name, x, y, taken):
    """The first free place around a mark; to the right when there is none."""
    width, places = LETTER * len(name), []
    for dy in (0, -11, 11, -20, 20, -29, 29, -38, 38):
        places.append((x + 9, y + dy, "start", (x + 9, y + dy - 5, x + 9 + width, y + dy + 5)))
        places.append((x - 9, y + dy, "end", (x - 9 - width, y + dy - 5, x - 9, y + dy + 5)))
    inside = [p for p in places if p[3][0] > LEFT and p[3][2] < WIDTH - RIGHT and TOP < p[3][1] and p[3][3] < HEIGHT - BOTTOM]
    return next((p for p in inside if not any(overlap(p[3], box) for box in taken)), (inside or places)[0])


def draw_axes(panel, across, up):
    bottom = HEIGHT - BOTTOM
    parts = [text(LEFT, TOP - 9, panel.title, extra=' font-weight="bold"')]
    for value in across.ticks():
        x = across.at(value)
        parts.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{bottom}" stroke="#eee"/>')
        parts.append(text(x, bottom + 15, tick(value), "middle"))
    for value in up.ticks():
        y = up.at(value)
        parts.append(f'<line x1="{LEFT}" y1="{y:.1f}" x2="{WIDTH - RIGHT}" y2="{y:.1f}" stroke="#eee"/>')
        parts.append(text(LEFT - 5, y + 4, tick(value), "end"))
    parts.append(f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" height="{bottom - TOP}" fill="none" stroke="#888"/>')
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 9, panel.across, "middle"))
    middle = (TOP + bottom) / 2
    parts.append(text(12, middle, panel.up, "middle", f' transform="rotate(-90 12 {middle:.1f})"'))
    return parts


def draw_panel(panel):
    both = [v for p in panel.points for v in (p.x, p.y)] if panel.diagonal else []
    across = Axis([p.x for p in panel.points] + both, panel.logarithmic, LEFT, WIDTH - RIGHT)
    up = Axis([p.y for p in panel.points] + both, panel.logarithmic, HEIGHT - BOTTOM, TOP)
    parts = draw_axes(panel, across, up)
    if panel.diagonal:
        low, high = max(across.low, up.low), min(across.high, up.high)
        parts.append(f'<line x1="{across.at(low):.1f}" y1="{up.at(low):.1f}" x2="{across.at(high):.1f}" y2="{up.at(high):.1f}" '
                     'stroke="#888" stroke-dasharray="4 3"/>')
    placed = [(p, across.at(p.x), up.at(p.y)) for p in panel.points]
    if panel.path:
        for group in sorted({p.group for p in panel.points}):
            line = " ".join(f"{x:.1f},{y:.1f}" for p, x, y in placed if p.group == group)
            parts.append(f'<polyline points="{line}" fill="none" stroke="{palette.colour(group)}" stroke-width="1.2"/>')
    taken = [(x - 6, y - 6, x + 6, y + 6) for _, x, y in placed]
    for point, x, y in placed:
        parts.append(shape(palette.kind(point.group), x, y, palette.colour(point.group), 4.0))
        if point.name:
            label_x, label_y, anchor, box = label(point.name, x, y, taken)
            taken.append(box)
            parts.append(text(label_x, label_y + 4, point.name, anchor, f' fill="{palette.colour(point.group)}"'))
    return parts


def draw(title, panels, legend=()):
    """The picture, as text; legend names the groups."""
    header, x = [text(12, 22, title, extra=' font-size="15" font-weight="bold"')], 12
    for i, name in enumerate(legend):
        header += [shape(palette.kind(i), x + 6, 40, palette.colour(i), 4.0), text(x + 16, 44, name)]
        x += 34 + int(LETTER * len(name))
    return Layout(WIDTH, HEIGHT, header=58 if legend else 36, font=11).draw(header, panels, draw_panel)
