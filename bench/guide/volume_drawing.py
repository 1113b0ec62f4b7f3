"""Draws two shapes in the plane inside of bounding volumes of each kind, and what a test of the two volumes computes."""

import itertools
import math

import charts


WIDTH, HEIGHT = 430, 312  # of a panel
SCALE, LEFT, BASE = 19.0, 42, 262  # pixels of a unit, and where the origin is
# Two slanted shapes that are apart; the second lies below and to the right of the first.
SHAPES = (((1.0, 2.6), (2.0, 2.0), (4.6, 3.9), (8.0, 8.3), (7.4, 9.2), (6.4, 8.9), (3.6, 6.4)),
          ((6.2, 1.6), (7.4, 1.2), (9.4, 3.0), (12.2, 6.2), (12.0, 7.2), (10.8, 7.0), (8.2, 4.6)))
DIAGONAL = math.sqrt(0.5)
AXES, DIAGONALS = ((1.0, 0.0), (0.0, 1.0)), ((DIAGONAL, DIAGONAL), (DIAGONAL, -DIAGONAL))


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def interval(points, direction):
    along = [dot(direction, p) for p in points]
    return min(along), max(along)


def clipped(polygon, direction, limit):
    """The part of a convex polygon with dot(direction, p) <= limit."""
    kept = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        a, b = dot(direction, p) - limit, dot(direction, q) - limit
        if a <= 0:
            kept.append(p)
        if (a < 0 < b) or (b < 0 < a):
            kept.append(tuple(p[k] + a / (a - b) * (q[k] - p[k]) for k in (0, 1)))
    return kept


def slabs(points, directions):
    """The polygon between the slabs of these directions."""
    polygon = [(-50.0, -50.0), (50.0, -50.0), (50.0, 50.0), (-50.0, 50.0)]
    for d in directions:
        low, high = interval(points, d)
        polygon = clipped(clipped(polygon, d, high), (-d[0], -d[1]), -low)
    return polygon


def area(polygon):
    return 0.5 * abs(sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(polygon, polygon[1:] + polygon[:1])))


def box_axes(points):
    """The axes of the box of least area: one of its sides lies on a side of the convex hull (Freeman and Shapira 1975)."""
    best = None
    for p, q in itertools.combinations(points, 2):
        length = math.dist(p, q)
        d = ((q[0] - p[0]) / length, (q[1] - p[1]) / length)
        axes = (d, (-d[1], d[0]))
        size = area(slabs(points, axes))
        if best is None or size < best[0] - 1e-9:
            best = (size, axes)
    return best[1]


def circle(points):
    """The least circle around the points: two of them are its diameter, or three lie on it."""
    found = []
    for p, q in itertools.combinations(points, 2):
        found.append((((p[0] + q[0]) / 2, (p[1] + q[1]) / 2), math.dist(p, q) / 2))
    for p, q, r in itertools.combinations(points, 3):
        b, c = (q[0] - p[0], q[1] - p[1]), (r[0] - p[0], r[1] - p[1])
        twice = 2 * (b[0] * c[1] - b[1] * c[0])
        if abs(twice) > 1e-9:
            x, y = (c[1] * dot(b, b) - b[1] * dot(c, c)) / twice, (b[0] * dot(c, c) - c[0] * dot(b, b)) / twice
            found.append(((p[0] + x, p[1] + y), math.hypot(x, y)))
    return min((f for f in found if all(math.dist(f[0], p) <= f[1] + 1e-9 for p in points)), key=lambda f: f[1])


# ---- pictures ----------------------------------------------------------------------------------------------------------


def place(p):
    return LEFT + SCALE * p[0], BASE - SCALE * p[1]


def polygon_of(points, colour, opacity, width=1.5):
    return charts.polygon(map(place, points), f'fill="{colour}" fill-opacity="{opacity}" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round"')


def line(p, q, colour, width=1.5, dash=""):
    return charts.line(*place(p), *place(q), colour, width, dash)


def intervals(volumes, direction, offset):
    """The intervals of both volumes on a line with this direction, which lies `offset` to its left."""
    across = (-direction[1], direction[0])

    def point(along, beside=0.0):
        return tuple(along * direction[k] + (offset + beside) * across[k] for k in (0, 1))

    ranges = [interval(volume, direction) for volume in volumes]
    low, high = min(r[0] for r in ranges) - 0.6, max(r[1] for r in ranges) + 0.6
    parts = [line(point(low), point(high), charts.GREY, 0.8)]
    for i, (begin, end) in enumerate(ranges):
        beside = 0.14 if i == 0 else -0.14
        parts.append(line(point(begin, beside), point(end, beside), charts.colour(i), 4.0))
    return parts


def draw_spheres():
    parts, circles = [], [circle(shape) for shape in SHAPES]
    for i, (center, radius) in enumerate(circles):
        x, y = place(center)
        parts += [charts.circle(x, y, SCALE * radius, f'fill="{charts.colour(i)}" fill-opacity="0.1" stroke="{charts.colour(i)}" stroke-width="1.5"'),
                  charts.circle(x, y, 3, f'fill="{charts.colour(i)}"')]
    return [*parts, line(circles[0][0], circles[1][0], charts.INK, 1.2, "3 2")]


def draw_slabs(directions_of, tested):
    volumes = [slabs(shape, directions_of(shape)) for shape in SHAPES]
    parts = [polygon_of(volume, charts.colour(i), 0.1) for i, volume in enumerate(volumes)]
    for direction, offset in tested:
        parts += intervals(volumes, direction, offset)
    return parts


def along_first_box():
    """The short axis of the first OBB, which separates the two."""
    axes = box_axes(SHAPES[0])
    lengths = [high - low for low, high in (interval(SHAPES[0], axis) for axis in axes)]
    short = axes[0] if lengths[0] < lengths[1] else axes[1]
    return short if short[0] > 0 else (-short[0], -short[1])


PANELS = (
    ("Sphere: 4 numbers", "Are the centers farther apart than both radii in sum? No: it goes on.", draw_spheres),
    ("AABB: 6 numbers", "Is there a gap between the intervals on one of 3 axes? No: it goes on.",
     lambda: draw_slabs(lambda shape: AXES, ((AXES[0], 0.3), (AXES[1], 0.0)))),
    ("OBB: 15 numbers", "Is there a gap along one of 15 axes? Yes: the shapes are apart.",
     lambda: draw_slabs(box_axes, ((along_first_box(), 2.0),))),
    ("k-DOP: k numbers (in the plane an 8-DOP)", "Is there a gap along one of k / 2 fixed directions? Yes.",
     lambda: draw_slabs(lambda shape: AXES + DIAGONALS, ((DIAGONALS[1], 1.9),))),
)


def draw_panel(panel):
    title, question, volumes = panel
    shapes = [polygon_of(shape, charts.colour(i), 0.5, 1.0) for i, shape in enumerate(SHAPES)]
    return [charts.bold(14, 18, title), charts.text(14, 34, question, extra=f' fill="{charts.GREY}"'),
            *volumes(), *shapes]


def draw():
    header = [charts.title("The same two shapes in volumes of four kinds", 14, 24)]
    return charts.Layout(WIDTH, HEIGHT, header=36, font=11).draw(header, PANELS, draw_panel)
