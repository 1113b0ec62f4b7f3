"""Draws horizontal bars as SVG: panels two abreast, a bar for each name, its value at its end."""

import dataclasses
import math

import palette
from report_picture import Layout, text


@dataclasses.dataclass
class Bar:
    name: str
    value: float | None  # None: a dash
    low: float | None = None  # the spread, where there is one
    high: float | None = None
    group: int = 0  # selects the colour


@dataclasses.dataclass
class Panel:
    title: str
    bars: list
    unit: str = ""
    logarithmic: bool = False


WIDTH = 430  # of a panel
TOP, BAR, GAP, BOTTOM = 30, 15, 5, 12
RIGHT = 62  # room for the values
LETTER = 6.0  # width, in pixels


def ends(panel):
    """The least and the greatest value that an axis spans."""
    values = [v for bar in panel.bars for v in (bar.value, bar.high) if v is not None]
    high = max(values, default=1.0)
    if not panel.logarithmic:
        return 0.0, high or 1.0
    least = min((v for v in values if v > 0), default=1.0)
    return 10.0 ** math.floor(math.log10(least) - 0.3), high


def draw_panel(panel, left):
    low, high = ends(panel)
    room = WIDTH - left - RIGHT

    def x(value):
        if panel.logarithmic:
            return left + room * max(0.0, math.log(max(value, low) / low) / math.log(high / low))
        return left + room * value / high

    heading = f"{panel.title}, {panel.unit}" if panel.unit else panel.title
    parts = [text(12, TOP - 10, heading + (" (logarithmic)" if panel.logarithmic else ""), extra=' font-weight="bold"')]
    for i, bar in enumerate(panel.bars):
        y = TOP + i * (BAR + GAP)
        parts.append(text(left - 6, y + 12, bar.name, "end"))
        if bar.value is None:
            parts.append(text(left + 4, y + 12, "–", extra=f' fill="{palette.GREY}"'))
            continue
        parts.append(f'<rect x="{left}" y="{y}" width="{max(x(bar.value) - left, 1):.1f}" height="{BAR}" '
                     f'fill="{palette.colour(bar.group)}" fill-opacity="0.85"/>')
        end = x(bar.value)
        if bar.low is not None and bar.high is not None:
            parts.append(f'<line x1="{x(bar.low):.1f}" y1="{y + BAR / 2}" x2="{x(bar.high):.1f}" y2="{y + BAR / 2}" '
                         f'stroke="{palette.INK}" stroke-width="1.5"/>')
            end = max(end, x(bar.high))
        parts.append(text(end + 5, y + 12, palette.number(bar.value)))
    bottom = TOP + len(panel.bars) * (BAR + GAP)
    parts.append(f'<line x1="{left}" y1="{TOP - 4}" x2="{left}" y2="{bottom}" stroke="#888"/>')
    return parts


def draw(title, panels, legend=()):
    """The picture, as text; legend names the groups."""
    left = 18 + int(LETTER * max(len(bar.name) for panel in panels for bar in panel.bars))
    height = TOP + BOTTOM + max(len(panel.bars) for panel in panels) * (BAR + GAP)
    header = [text(12, 22, title, extra=' font-size="15" font-weight="bold"')]
    x = 12
    for i, name in enumerate(legend):
        header.append(f'<rect x="{x}" y="33" width="11" height="11" fill="{palette.colour(i)}" fill-opacity="0.85"/>')
        header.append(text(x + 16, 43, name))
        x += 34 + int(LETTER * len(name))
    layout = Layout(WIDTH, height, header=56 if legend else 36, font=11)
    return layout.draw(header, panels, lambda panel: draw_panel(panel, left))
