"""Draws the README's chart as SVG: bytes per triangle against speed, a panel for each processor, a bar for each system.

A bar spans the slowest and the fastest mesh of a system; a dot on it is one mesh.
"""

import dataclasses
import statistics

import charts


@dataclasses.dataclass
class Mark:
    system: str
    profile: str
    mesh: str
    bytes: float
    ratio: float


@dataclasses.dataclass
class Panel:
    title: str
    marks: list


@dataclasses.dataclass
class Style:
    label: str
    colour: str
    side: str = "below"  # where the label is, seen from the bar


WIDTH, HEIGHT = 430, 320  # of a panel
LEFT, RIGHT, TOP, BOTTOM = 48, 22, 34, 48
LAYOUT = charts.Layout(WIDTH, HEIGHT, header=54, font=12, corner=8)
LOW, HIGH = 3.0, 128.0  # bytes per triangle
OWN, EMBREE, BULLET, ODE = "#D55E00", "#0072B2", "#007A59", "#8A5A83"
# Systems in the chart; others would repeat these or have no query for rays.
STYLES = {
    ("espalier", "small"): Style("small", OWN, "below left"),
    ("espalier", "balanced"): Style("balanced", OWN, "further below"),
    ("espalier", "fast"): Style("fast", OWN, "below left"),
    ("embree", "default"): Style("default", EMBREE, "above"),
    ("embree", "robust"): Style("robust", EMBREE),
    ("embree", "compact"): Style("Embree compact", EMBREE, "left"),
    ("bullet", "quantised"): Style("Bullet", BULLET, "left"),
    ("ode", "opcode"): Style("ODE", ODE, "right"),
}
NAMED_MESHES = ("espalier", "fast")  # the bar whose dots are labelled with their meshes
HEADINGS = {"espalier": "Espalier", "embree": "Embree"}  # over bars whose labels do not name the system


def axes_of(panels):
    """Bytes across, and speeds up to a little above the fastest."""
    top = max([1.2] + [mark.ratio * 1.12 for panel in panels for mark in panel.marks])
    return charts.Axis(LOW, HIGH, LEFT, WIDTH - RIGHT, True), charts.Axis(0.0, top, HEIGHT - BOTTOM, TOP, False)


@dataclasses.dataclass
class Bar:
    """All meshes of one system, at the geometric mean of their bytes."""
    key: tuple
    marks: list

    x: float
    high: float
    low: float


def bars_of(panel, across, up):
    bars = []
    for key in STYLES:
        marks = [mark for mark in panel.marks if (mark.system, mark.profile) == key]
        if marks:
            ratios = [mark.ratio for mark in marks]
            bars.append(Bar(key, marks, across.at(statistics.geometric_mean(mark.bytes for mark in marks)),
                            up.at(max(ratios)), up.at(min(ratios))))
    return bars


def coloured(colour, weight="normal"):
    """With a white rim, which keeps letters apart from the lines behind them."""
    return f' fill="{colour}" font-weight="{weight}" stroke="#fff" stroke-width="3" paint-order="stroke"'


def draw_axes(panel, across, up):
    bottom = HEIGHT - BOTTOM
    parts = [charts.bold(LEFT, TOP - 12, panel.title)]
    for value in (4, 8, 16, 32, 64, 128):
        x = across.at(value)
        parts += [charts.line(x, bottom, x, bottom + 4, "#888"), charts.text(x, bottom + 18, str(value), "middle", coloured(charts.GREY))]
    for i in range(int(up.high / 0.5) + 1):
        y = up.at(0.5 * i)
        parts += [charts.line(LEFT, y, WIDTH - RIGHT, y, "#888" if i in (0, 2) else "#ddd", dash="4 3" if i == 2 else ""),
                  charts.text(LEFT - 7, y + 4, f"{0.5 * i:.1f}", "end", coloured(charts.GREY))]
    return [*parts, charts.text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 10, "bytes per triangle, vertices included", "middle"),
            charts.upright(14, (TOP + bottom) / 2, "rays per second, Embree default = 1")]


def draw_bar(bar, up):
    colour = STYLES[bar.key].colour
    parts = []
    if bar.low - bar.high > 1:
        parts.append(f'<line x1="{bar.x:.1f}" y1="{bar.high:.1f}" x2="{bar.x:.1f}" y2="{bar.low:.1f}" stroke="{colour}" '
                     'stroke-width="7" stroke-opacity="0.3" stroke-linecap="round"/>')
    return parts + [charts.circle(bar.x, up.at(mark.ratio), 3.5, f'fill="{colour}"') for mark in bar.marks]


def draw_label(bar):
    style = STYLES[bar.key]
    middle = (bar.high + bar.low) / 2 + 4
    x, y, anchor = {"below": (bar.x, bar.low + 19, "middle"), "below left": (bar.x + 5, bar.low + 19, "end"),
                    "further below": (bar.x, bar.low + 39, "middle"), "above": (bar.x, bar.high - 10, "middle"),
                    "left": (bar.x - 9, middle, "end"), "right": (bar.x + 9, middle, "start")}[style.side]
    parts = [charts.text(x, y, style.label, anchor, coloured(style.colour))]
    if style.side == "further below":
        parts.append(charts.line(bar.x, bar.low + 8, bar.x, y - 12, style.colour, 0.8))
    return parts


def draw_headings(bars):
    parts = []
    for system, heading in HEADINGS.items():
        own = [bar for bar in bars if bar.key[0] == system and STYLES[bar.key].label[0].islower()]
        if own:
            x = sum(bar.x for bar in own) / len(own)
            above = any(STYLES[bar.key].side == "above" for bar in own)
            y = min(bar.high for bar in own) - (26 if above else 12)
            parts.append(charts.text(x, y, heading, "middle", coloured(STYLES[own[0].key].colour, "bold")))
    return parts


def draw_meshes(bar, up):
    """Names beside the dots, moved down where they would overlap."""
    parts, free = [], 0.0
    for mark in sorted(bar.marks, key=lambda mark: -mark.ratio):
        y = max(up.at(mark.ratio) + 4, free)
        parts.append(charts.text(bar.x + 10, y, mark.mesh, extra=coloured(charts.GREY)))
        free = y + 13
    return parts


def draw_panel(panel, across, up):
    bars = bars_of(panel, across, up)
    parts = draw_axes(panel, across, up)
    for bar in bars:
        parts += draw_bar(bar, up)
    for bar in bars:
        parts += draw_label(bar)
    parts += draw_headings(bars)
    for bar in bars:
        if bar.key == NAMED_MESHES:
            parts += draw_meshes(bar, up)
    return parts


def draw(panels):
    across, up = axes_of(panels)
    # Two lines: one panel is no wider.
    header = [charts.bold(LEFT, 24, "Closest hits, one ray at a time", 14),
              charts.text(LEFT, 44, "Left is smaller, up is faster; each dot is one mesh.")]
    return LAYOUT.draw(header, panels, lambda panel: draw_panel(panel, across, up))
