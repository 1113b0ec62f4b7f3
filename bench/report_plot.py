"""Plots of docs/benchmarks.md and docs/accuracy.md: speed against bytes a triangle, and lines over a common axis."""

import dataclasses

import charts

FRAME = charts.Frame(46, 14, 30, 40, "#e4e4e4")
LAYOUT = charts.Layout(FRAME.width, FRAME.height, header=52)  # the header is title and legend
STYLES = {"espalier": ("#D55E00", "diamond"), "embree": ("#0072B2", "circle"), "bullet": ("#009E73", "square"),
          "ode": ("#8A5A83", "triangle"), "embree4": ("#56B4E9", "circle"), "tinybvh": ("#B8860B", "square"),
          "jolt": ("#CC79A7", "diamond"), "box3d": ("#333333", "triangle")}
OTHER = ("#444444", "circle")


def draw(words, panels, styles, draw_panel):
    """The picture, with a shape and a name for each entry of {name: (colour, kind)} in one line."""
    header, x = [charts.title(words, FRAME.left, 21)], FRAME.left
    for name, (colour, kind) in styles.items():
        header += [charts.shape(kind, x + 6, 38, colour), charts.text(x + 17, 42, name)]
        x += 30 + 7 * len(name)
    return LAYOUT.draw(header, panels, draw_panel)


# ---- a mark for each system and profile --------------------------------------------------------------------------------


@dataclasses.dataclass
class Mark:
    system: str
    profile: str
    bytes: float
    ratio: float
    low: float
    high: float


@dataclasses.dataclass
class Marks:
    """A panel."""
    title: str
    marks: list


def draw_marks(panel, across, up):
    step = 0.2 if up.high <= 2.4 else 0.5
    x_ticks = [(across.at(v), str(v)) for v in (2, 4, 8, 16, 32, 64, 128, 256, 512) if across.low <= v <= across.high]
    y_ticks = [(up.at(i * step), f"{i * step:.1f}", *(("#888", "4 3") if abs(i * step - 1) < 1e-9 else ()))
               for i in range(int(up.high / step) + 1)]
    parts = FRAME.draw(panel.title, "bytes a triangle, all that a query reads", "speed, Embree default = 1", x_ticks, y_ticks, 6, 8)
    points = [(mark, across.at(mark.bytes), up.at(mark.ratio)) for mark in panel.marks]
    taken = [(x - 7, y - 7, x + 7, y + 7) for _, x, y in points]
    for mark, x, y in points:
        colour, kind = STYLES.get(mark.system, OTHER)
        parts += [charts.line(x, up.at(mark.low), x, up.at(mark.high), colour, 1.5), charts.shape(kind, x, y, colour)]
    # Espalier's labels choose their places first.
    for mark, x, y in sorted(points, key=lambda point: point[0].system != "espalier"):
        free, _, places = FRAME.label(0.56 * LAYOUT.font * len(mark.profile), x, y, taken, 10, 56)
        label_x, label_y, anchor, box = free or places[0]
        taken.append(box)
        parts.append(charts.text(label_x, label_y + 4, mark.profile, anchor, f' fill="{STYLES.get(mark.system, OTHER)[0]}"'))
    return parts


def draw_mark_panels(words, panels):
    """All panels have the same axes, so that they can be compared."""
    marks = [mark for panel in panels for mark in panel.marks]
    left, top, right, bottom = FRAME.inner()
    across = charts.Axis(min([3.0] + [m.bytes / 1.15 for m in marks]), max([200.0] + [m.bytes * 1.15 for m in marks]), left, right, True)
    up = charts.Axis(0.0, max([1.2] + [m.high * 1.08 for m in marks]), bottom, top, False)
    styles = {mark.system: STYLES.get(mark.system, OTHER) for mark in marks}
    return draw(words, panels, styles, lambda panel: draw_marks(panel, across, up))


# ---- a line for each mesh ----------------------------------------------------------------------------------------------


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
class Lines:
    """A panel."""
    title: str
    lines: list
    across: str
    logarithmic: bool = True
    floor: float | None = None  # of the vertical axis; a range below it is cut off there


def line_axes(panel):
    points = [point for each in panel.lines for point in each.points]
    values = [v for p in points for v in (p.y, p.low, p.high) if v is not None and (v > 0 or not panel.logarithmic)]
    left, top, right, bottom = FRAME.inner()
    low = 0.0 if not panel.logarithmic else panel.floor if panel.floor is not None else min(values) / 1.5
    return (charts.Axis(min(p.x for p in points), max(p.x for p in points), left + 14, right - 14, False),
            charts.Axis(low, max(values) * (1.5 if panel.logarithmic else 1.05), bottom, top, panel.logarithmic))


def draw_lines(panel, styles):
    across, up = line_axes(panel)
    x_ticks = [(across.at(v), f"{v:g}") for v in sorted({point.x for each in panel.lines for point in each.points})]
    y_ticks = [(up.at(v), f"{v:g}") for v in (up.powers() if panel.logarithmic else up.even_ticks())]
    parts = FRAME.draw(panel.title, panel.across, "", x_ticks, y_ticks, 4, 8)
    for each in panel.lines:
        colour, kind = styles[each.name]
        shown = [(across.at(p.x), up.at(p.y)) for p in each.points if p.y is not None and (p.y > 0 or not panel.logarithmic)]
        parts.append(charts.polyline(shown, colour, dash="5 3" if each.dashed else ""))
        for point in each.points:
            if point.low is not None and point.high is not None:
                parts.append(charts.line(across.at(point.x), up.at(point.low), across.at(point.x), up.at(point.high), colour, 1.5))
        parts += [charts.shape(kind, x, y, colour, 3.5) for x, y in shown]
    return parts


def draw_line_panels(words, panels):
    names = dict.fromkeys(each.name for panel in panels for each in panel.lines)
    styles = dict(zip(names, [STYLES[system] for system in ("espalier", "embree", "bullet", "ode")] * len(names)))
    return draw(words, panels, styles, lambda panel: draw_lines(panel, styles))
