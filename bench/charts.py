"""Charts of the reports as SVG: elements, axes, and panels of points and of bars, two abreast below a header.

The same values give the same bytes. White ground: they are read on dark pages too.
"""

import dataclasses
import math
import statistics
from xml.sax.saxutils import escape

# Okabe and Ito (2008): told apart by colour-blind readers; shapes say the same again.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#8A5A83", "#E69F00", "#56B4E9", "#444444", "#A3A500")
SHAPES = ("circle", "diamond", "square", "triangle")
GREY, RULE, INK = "#666", "#ddd", "#222"
COLUMNS = 2
LETTER = 6.0  # width, in pixels


def colour(i):
    return COLOURS[i % len(COLOURS)]


def kind(i):
    return SHAPES[i % len(SHAPES)]


def number(value):
    """Three significant digits, with thousands separated."""
    if value is None:
        return "–"
    size = abs(value)
    if size >= 1e6:
        return f"{value / 1e6:.3g} M"
    if size >= 100 or value == 0:
        return f"{value:,.0f}"
    return f"{value:.1f}" if size >= 10 else f"{value:.2f}" if size >= 0.1 else f"{value:.2g}"


def time(ns):
    unit, size = next(((unit, size) for unit, size in (("s", 1e9), ("ms", 1e6), ("µs", 1e3)) if ns >= size), ("ns", 1))
    return f"{number(ns / size)} {unit}"


# ---- elements ----------------------------------------------------------------------------------------------------------


def text(x, y, words, anchor="start", extra=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{extra}>{escape(words)}</text>'


def bold(x, y, words, size=""):
    return text(x, y, words, extra=(f' font-size="{size}"' if size else "") + ' font-weight="bold"')


def title(words, x=12, y=22):
    """Of a whole picture."""
    return bold(x, y, words, 15)


def line(x1, y1, x2, y2, stroke, width="", dash=""):
    extra = (f' stroke-width="{width}"' if width else "") + (f' stroke-dasharray="{dash}"' if dash else "")
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{stroke}"{extra}/>'


def rect(x, y, width, height, extra):
    return f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" {extra}/>'


def circle(x, y, radius, extra):
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}" {extra}/>'


def points_of(places):
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in places)


def polygon(places, extra):
    return f'<polygon points="{points_of(places)}" {extra}/>'


def polyline(places, stroke, width=1.2, dash=""):
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<polyline points="{points_of(places)}" fill="none" stroke="{stroke}" stroke-width="{width}"{dashes}/>'


def shape(name, x, y, fill, size=5.0):
    if name == "circle":
        return circle(x, y, size, f'fill="{fill}"')
    corners = {"diamond": [(0, -1.4), (1.4, 0), (0, 1.4), (-1.4, 0)],
               "square": [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
               "triangle": [(0, -1.2), (1.1, 0.8), (-1.1, 0.8)]}[name]
    return polygon([(x + size * dx, y + size * dy) for dx, dy in corners], f'fill="{fill}"')


def upright(x, y, words):
    """Beside a vertical axis."""
    return text(x, y, words, "middle", f' transform="rotate(-90 {x} {y:.1f})"')


@dataclasses.dataclass
class Layout:
    width: int  # of a panel
    height: int
    header: int
    font: int = 11
    corner: int = 0  # radius

    def draw(self, header, panels, draw_panel):
        """The whole picture, as text."""
        rows = (len(panels) + COLUMNS - 1) // COLUMNS
        parts = list(header)
        for i, panel in enumerate(panels):
            parts.append(f'<g transform="translate({self.width * (i % COLUMNS)} {self.header + self.height * (i // COLUMNS)})">')
            parts += [*draw_panel(panel), "</g>"]
        return picture(self.width * min(COLUMNS, max(1, len(panels))), self.header + self.height * rows, parts, self.font, self.corner)


def picture(width, height, parts, font=11, corner=0):
    rounded = f' rx="{corner}"' if corner else ""
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
        f'font-family="sans-serif" font-size="{font}" fill="{INK}">', f'<rect width="{width}" height="{height}"{rounded} fill="#fff"/>',
        *parts, "</svg>", ""])


# ---- axes and labels ---------------------------------------------------------------------------------------------------


class Axis:
    """Values to pixels from `begin` to `end`."""

    def __init__(self, low, high, begin, end, logarithmic):
        self.low, self.high, self.begin, self.end, self.logarithmic = low, high, begin, end, logarithmic

    def at(self, value):
        if self.logarithmic:
            share = math.log(max(value, self.low) / self.low) / math.log(self.high / self.low)
        else:
            share = (value - self.low) / max(self.high - self.low, 1e-9)
        return self.begin + share * (self.end - self.begin)

    def even_ticks(self):
        """Of an axis from 0 on."""
        step = 10.0 ** math.floor(math.log10(self.high / 2))
        step *= next(f for f in (1, 2, 5, 10) if self.high / (step * f) <= 6)
        return [i * step for i in range(int(self.high / step) + 1)]

    def powers(self, factors=(1,)):
        exponents = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        return [v for e in exponents for f in factors if self.low <= (v := f * 10.0 ** e) <= self.high]


@dataclasses.dataclass
class Frame:
    """Where the axes of a panel are, and how their grid looks."""
    left: int
    right: int
    top: int
    bottom: int
    grid: str
    width: int = 430  # of a panel
    height: int = 330

    def inner(self):
        return self.left, self.top, self.width - self.right, self.height - self.bottom

    def draw(self, words, across, up, x_ticks, y_ticks, beside=5, below=9):
        """Title, grid, border, and what stands along the axes. Ticks are (pixel, words), or (pixel, words, colour, dash)."""
        left, top, right, bottom = self.inner()
        parts = [bold(left, top - 9, words)]
        for x, word, *_ in x_ticks:
            parts += [line(x, top, x, bottom, self.grid), text(x, bottom + 15, word, "middle")]
        for y, word, *look in y_ticks:
            parts += [line(left, y, right, y, *(look or [self.grid])[:1], dash=look[1] if len(look) > 1 else ""),
                      text(left - beside, y + 4, word, "end")]
        parts += [rect(left, top, right - left, bottom - top, 'fill="none" stroke="#888"'),
                  text((left + right) / 2, self.height - below, across, "middle")]
        return [*parts, upright(12, (top + bottom) / 2, up)] if up else parts

    def label(self, width, x, y, taken, beside=9, reach=38):
        """The first free place around a mark for a label of this width; to the right when there is none."""
        left, top, right, bottom = self.inner()
        places = []
        for dy in [0] + [sign * d for d in range(11, reach + 1, 9) for sign in (-1, 1)]:
            places.append((x + beside, y + dy, "start", (x + beside, y + dy - 5, x + beside + width, y + dy + 5)))
            places.append((x - beside, y + dy, "end", (x - beside - width, y + dy - 5, x - beside, y + dy + 5)))
        inside = [p for p in places if p[3][0] > left and p[3][2] < right and top < p[3][1] and p[3][3] < bottom]
        return next((p for p in inside if not any(overlap(p[3], box) for box in taken)), None), inside, places


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


# ---- points over two axes ----------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Point:
    name: str  # empty: no label
    x: float
    y: float
    group: int = 0  # selects colour and shape


@dataclasses.dataclass
class Points:
    """A panel: a labelled mark for each point, lines for paths."""
    title: str
    points: list
    across: str
    up: str
    logarithmic: bool = True  # both axes
    path: bool = False  # joins the points of a group in their order
    diagonal: bool = False  # the line on which both values are equal


FRAME = Frame(56, 16, 30, 42, "#eee")


def point_axis(values, logarithmic, begin, end):
    low, high = min(values), max(values)
    return Axis(low / 1.25, high * 1.35, begin, end, True) if logarithmic else Axis(0.0, high * 1.1 or 1.0, begin, end, False)


def axes_of(points, logarithmic=True, both=()):
    left, top, right, bottom = FRAME.inner()
    return (point_axis([p.x for p in points] + list(both), logarithmic, left, right),
            point_axis([p.y for p in points] + list(both), logarithmic, bottom, top))


def ticks_of(axis):
    values = axis.powers((1, 2, 5) if axis.high / axis.low < 200 else (1,)) if axis.logarithmic else axis.even_ticks()
    return [(axis.at(v), f"{v:,.0f}" if v >= 1000 else f"{v:.4g}") for v in values]


def place_label(name, x, y, taken):
    free, inside, places = FRAME.label(LETTER * len(name), x, y, taken)
    chosen = free or (inside or places)[0]
    taken.append(chosen[3])
    return chosen[:3]


def draw_points(panel):
    both = [v for p in panel.points for v in (p.x, p.y)] if panel.diagonal else []
    across, up = axes_of(panel.points, panel.logarithmic, both)
    parts = FRAME.draw(panel.title, panel.across, panel.up, ticks_of(across), ticks_of(up))
    if panel.diagonal:
        low, high = max(across.low, up.low), min(across.high, up.high)
        parts.append(line(across.at(low), up.at(low), across.at(high), up.at(high), "#888", dash="4 3"))
    placed = [(p, across.at(p.x), up.at(p.y)) for p in panel.points]
    if panel.path:
        for group in sorted({p.group for p in panel.points}):
            parts.append(polyline([(x, y) for p, x, y in placed if p.group == group], colour(group)))
    taken = [(x - 6, y - 6, x + 6, y + 6) for _, x, y in placed]
    for point, x, y in placed:
        parts.append(shape(kind(point.group), x, y, colour(point.group), 4.0))
        if point.name:
            label_x, label_y, anchor = place_label(point.name, x, y, taken)
            parts.append(text(label_x, label_y + 4, point.name, anchor, f' fill="{colour(point.group)}"'))
    return parts


def group_legend(names):
    parts, x = [], 12
    for i, name in enumerate(names):
        parts += [shape(kind(i), x + 6, 40, colour(i), 4.0), text(x + 16, 44, name)]
        x += 34 + int(LETTER * len(name))
    return parts


def draw_point_panels(words, panels, legend=(), draw_panel=draw_points):
    """The picture, as text; legend names the groups."""
    return Layout(FRAME.width, FRAME.height, 58 if legend else 36).draw([title(words), *group_legend(legend)], panels, draw_panel)


# ---- horizontal bars ---------------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Bar:
    name: str
    value: float | None  # None: a dash
    low: float | None = None  # the spread, where there is one
    high: float | None = None
    group: int = 0  # selects the colour


def mean_bar(name, values, group=0):
    """The geometric mean, of ratios the one that does not depend on which is the divisor, and the least and the greatest."""
    return Bar(name, statistics.geometric_mean(values), min(values), max(values), group)


@dataclasses.dataclass
class Bars:
    """A panel: a bar for each name, its value at its end."""
    title: str
    bars: list
    unit: str = ""
    logarithmic: bool = False


BAR_TOP, BAR, GAP, BAR_BOTTOM, VALUES = 30, 15, 5, 12, 62  # the last is the room for the values


def bar_ends(panel):
    """The least and the greatest value that an axis spans."""
    values = [v for bar in panel.bars for v in (bar.value, bar.high) if v is not None]
    high = max(values, default=1.0)
    if not panel.logarithmic:
        return 0.0, high or 1.0
    return 10.0 ** math.floor(math.log10(min((v for v in values if v > 0), default=1.0)) - 0.3), high


def draw_bars(panel, left):
    axis = Axis(*bar_ends(panel), left, FRAME.width - VALUES, panel.logarithmic)
    heading = f"{panel.title}, {panel.unit}" if panel.unit else panel.title
    parts = [bold(12, BAR_TOP - 10, heading + (" (logarithmic)" if panel.logarithmic else ""))]
    for i, bar in enumerate(panel.bars):
        y = BAR_TOP + i * (BAR + GAP)
        parts.append(text(left - 6, y + 12, bar.name, "end"))
        if bar.value is None:
            parts.append(text(left + 4, y + 12, "–", extra=f' fill="{GREY}"'))
            continue
        end = axis.at(bar.value)
        parts.append(rect(left, y, max(end - left, 1), BAR, f'fill="{colour(bar.group)}" fill-opacity="0.85"'))
        if bar.low is not None and bar.high is not None:
            parts.append(line(axis.at(bar.low), y + BAR / 2, axis.at(bar.high), y + BAR / 2, INK, 1.5))
            end = max(end, axis.at(bar.high))
        parts.append(text(end + 5, y + 12, number(bar.value)))
    return [*parts, line(left, BAR_TOP - 4, left, BAR_TOP + len(panel.bars) * (BAR + GAP), "#888")]


def draw_bar_panels(words, panels, legend=()):
    """The picture, as text; legend names the groups."""
    left = 18 + int(LETTER * max(len(bar.name) for panel in panels for bar in panel.bars))
    height = BAR_TOP + BAR_BOTTOM + max(len(panel.bars) for panel in panels) * (BAR + GAP)
    header, x = [title(words)], 12
    for i, name in enumerate(legend):
        header += [rect(x, 33, 11, 11, f'fill="{colour(i)}" fill-opacity="0.85"'), text(x + 16, 43, name)]
        x += 34 + int(LETTER * len(name))
    return Layout(FRAME.width, height, 56 if legend else 36).draw(header, panels, lambda panel: draw_bars(panel, left))
