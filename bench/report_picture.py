"""What all pictures of the reports share: SVG elements, and panels two abreast below a header."""

import dataclasses
from xml.sax.saxutils import escape

COLUMNS = 2


def shape(kind, x, y, colour, size=5.0):
    if kind == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{size:.1f}" fill="{colour}"/>'
    corners = {"diamond": [(0, -1.4), (1.4, 0), (0, 1.4), (-1.4, 0)],
               "square": [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
               "triangle": [(0, -1.2), (1.1, 0.8), (-1.1, 0.8)]}[kind]
    points = " ".join(f"{x + size * dx:.1f},{y + size * dy:.1f}" for dx, dy in corners)
    return f'<polygon points="{points}" fill="{colour}"/>'


def text(x, y, words, anchor="start", extra=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{extra}>{escape(words)}</text>'


def legend(styles, left):
    """A shape and a name for each entry of {name: (colour, kind)}, in one line."""
    parts, x = [], left
    for name, (colour, kind) in styles.items():
        parts += [shape(kind, x + 6, 38, colour), text(x + 17, 42, name)]
        x += 30 + 7 * len(name)
    return parts


@dataclasses.dataclass
class Layout:
    width: int  # of a panel
    height: int
    header: int
    font: int
    corner: int = 0  # radius

    def draw(self, header, panels, draw_panel):
        """The whole picture, as text. The same arguments give the same bytes. White ground: it is read on dark pages too."""
        rows = (len(panels) + COLUMNS - 1) // COLUMNS
        width, height = self.width * min(COLUMNS, max(1, len(panels))), self.header + self.height * rows
        corner = f' rx="{self.corner}"' if self.corner else ""
        parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
                 f'viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="{self.font}" fill="#222">',
                 f'<rect width="{width}" height="{height}"{corner} fill="#fff"/>', *header]
        for i, panel in enumerate(panels):
            parts.append(f'<g transform="translate({self.width * (i % COLUMNS)} '
                         f'{self.header + self.height * (i // COLUMNS)})">')
            parts += draw_panel(panel)
            parts.append("</g>")
        return "\n".join(parts + ["</svg>", ""])
