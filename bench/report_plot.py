"""Draws speed against bytes a triangle as SVG: a panel for each mesh, a mark for each system and profile."""

import dataclasses
import math

from report_picture import Layout, legend, shape, text


@dataclasses.dataclass
class Mark:
    system: str
    profile: str
    bytes: float
    ratio: float
    low: float
    high: float


@dataclasses.dataclass
class Panel:
    title: str
    marks: list


WIDTH, HEIGHT = 430, 330  # of a panel
LEFT, RIGHT, TOP, BOTTOM = 46, 14, 30, 40
LAYOUT = Layout(WIDTH, HEIGHT, header=52, font=11)  # the header is title and legend
# Okabe and Ito (2008): told apart by colour-blind readers; shapes say the same again.
STYLES = {"espalier": ("#D55E00", "diamond"), "embree": ("#0072B2", "circle"), "bullet": ("#009E73", "square"),
          "ode": ("#8A5A83", "triangle")}
OTHER = ("#444444", "circle")


class Scale:
    """Values to pixels, alike in all panels so that they can be compared."""

    def __init__(self, panels):
        marks = [mark for panel in panels for mark in panel.marks]
        self.low = min([3.0] + [m.bytes / 1.15 for m in marks])
        self.high = max([200.0] + [m.bytes * 1.15 for m in marks])
        self.top = max([1.2] + [m.high * 1.08 for m in marks])

    def x(self, value):
        share = math.log(value / self.low) / math.log(self.high / self.low)
        return LEFT + share * (WIDTH - LEFT - RIGHT)

    def y(self, value):
        return HEIGHT - BOTTOM - value / self.top * (HEIGHT - TOP - BOTTOM)


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def place(words, x, y, taken):
    """The first free place for a label around its mark; to the right when there is none."""
    width = 0.56 * LAYOUT.font * len(words)
    places = []
    for dy in (0, -11, 11, -20, 20, -29, 29, -38, 38, -47, 47, -56, 56):
        places.append((x + 10, y + dy, "start", (x + 10, y + dy - 5, x + 10 + width, y + dy + 5)))
        places.append((x - 10, y + dy, "end", (x - 10 - width, y + dy - 5, x - 10, y + dy + 5)))
    inside = [p for p in places if p[3][0] > LEFT and p[3][2] < WIDTH - RIGHT and TOP < p[3][1] and p[3][3] < HEIGHT - BOTTOM]
    for candidate in inside:
        if not any(overlap(candidate[3], box) for box in taken):
            return candidate
    return places[0]


def draw_axes(scale):
    parts = [f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" height="{HEIGHT - TOP - BOTTOM}" '
             'fill="none" stroke="#888"/>']
    bottom = HEIGHT - BOTTOM
    for value in (2, 4, 8, 16, 32, 64, 128, 256, 512):
        if scale.low <= value <= scale.high:
            x = scale.x(value)
            parts.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{bottom}" stroke="#e4e4e4"/>')
            parts.append(text(x, bottom + 15, str(value), "middle"))
    step = 0.2 if scale.top <= 2.4 else 0.5
    for i in range(int(scale.top / step) + 1):
        y = scale.y(i * step)
        colour, dash = ("#888", ' stroke-dasharray="4 3"') if abs(i * step - 1) < 1e-9 else ("#e4e4e4", "")
        parts.append(f'<line x1="{LEFT}" y1="{y:.1f}" x2="{WIDTH - RIGHT}" y2="{y:.1f}" stroke="{colour}"{dash}/>')
        parts.append(text(LEFT - 6, y + 4, f"{i * step:.1f}", "end"))
    middle = (TOP + bottom) / 2
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 8, "bytes a triangle, all that a query reads", "middle"))
    parts.append(text(12, middle, "speed, Embree default = 1", "middle", f' transform="rotate(-90 12 {middle:.1f})"'))
    return parts


def draw_panel(panel, scale):
    parts = draw_axes(scale)
    parts.append(text(LEFT, TOP - 9, panel.title, extra=' font-weight="bold"'))
    points = [(mark, scale.x(mark.bytes), scale.y(mark.ratio)) for mark in panel.marks]
    taken = [(x - 7, y - 7, x + 7, y + 7) for _, x, y in points]
    for mark, x, y in points:
        colour, kind = STYLES.get(mark.system, OTHER)
        parts.append(f'<line x1="{x:.1f}" y1="{scale.y(mark.low):.1f}" x2="{x:.1f}" y2="{scale.y(mark.high):.1f}" '
                     f'stroke="{colour}" stroke-width="1.5"/>')
        parts.append(shape(kind, x, y, colour))
    # Espalier's labels choose their places first.
    for mark, x, y in sorted(points, key=lambda point: point[0].system != "espalier"):
        label_x, label_y, anchor, box = place(mark.profile, x, y, taken)
        taken.append(box)
        parts.append(text(label_x, label_y + 4, mark.profile, anchor, f' fill="{STYLES.get(mark.system, OTHER)[0]}"'))
    return parts


def draw(title, panels):
    scale = Scale(panels)
    systems = dict.fromkeys(mark.system for panel in panels for mark in panel.marks)
    styles = {system: STYLES.get(system, OTHER) for system in systems}
    header = [text(LEFT, 21, title, extra=' font-size="15" font-weight="bold"'), *legend(styles, LEFT)]
    return LAYOUT.draw(header, panels, lambda panel: draw_panel(panel, scale))
