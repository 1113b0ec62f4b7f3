"""Draws the same triangles of a plane in a uniform grid, in a k-d tree and in a hierarchy of boxes, as SVG."""

import charts


WIDTH, SIDE, TOP, GAP, LEFT = 880, 250, 62, 40, 20
TRIANGLES = (
    ((6, 10), (30, 4), (22, 26)), ((22, 26), (30, 4), (44, 20)), ((44, 20), (30, 4), (58, 8)), ((10, 60), (18, 44), (30, 62)),
    ((30, 62), (18, 44), (40, 48)), ((60, 88), (94, 60), (90, 92)), ((64, 40), (70, 36), (68, 46)), ((70, 36), (78, 42), (68, 46)),
    ((78, 42), (80, 50), (68, 46)), ((4, 30), (96, 55), (40, 46)), ((12, 90), (20, 82), (26, 94)), ((74, 12), (92, 6), (88, 24)),
)
CELLS = 5
TRIANGLE_COST = 5.0  # over that of a node: high, so that the tree is deep enough to be seen


def box_of(points):
    return (min(x for x, _ in points), min(y for _, y in points), max(x for x, _ in points), max(y for _, y in points))


def clip(points, axis, at, is_low):
    """The part of a convex polygon on one side of a line across an axis."""
    kept = []
    for i, p in enumerate(points):
        q = points[(i + 1) % len(points)]
        p_in, q_in = ((a[axis] < at) == is_low for a in (p, q))
        if p_in:
            kept.append(p)
        if p_in != q_in:
            share = (at - p[axis]) / (q[axis] - p[axis])
            kept.append(tuple(a + share * (b - a) for a, b in zip(p, q)))
    return kept


def touches(points, box):
    part = list(points)
    for axis, at, is_low in ((0, box[0], False), (0, box[2], True), (1, box[1], False), (1, box[3], True)):
        part = clip(part, axis, at, is_low)
        if not part:
            return False
    return True


def inside(box):
    return [i for i, triangle in enumerate(TRIANGLES) if touches(triangle, box)]


def grid():
    step = 100 / CELLS
    return [((x * step, y * step, (x + 1) * step, (y + 1) * step), 0) for y in range(CELLS) for x in range(CELLS)]


def kd_cells(box=(0, 0, 100, 100), depth=0):
    """Leaves, by the plane with the least expected cost of those beside the ends of triangles."""
    found = inside(box)
    sides = (box[2] - box[0], box[3] - box[1])

    def half(part):
        return (part[2] - part[0]) + (part[3] - part[1])

    best = (len(found) * TRIANGLE_COST * half(box), None)
    for axis in (0, 1):
        for i in found:
            ends = box_of(TRIANGLES[i])
            for at in (ends[axis] - 0.2, ends[axis + 2] + 0.2):
                if not box[axis] < at < box[axis + 2]:
                    continue
                low, high = list(box), list(box)
                low[axis + 2] = high[axis] = at
                cost = half(box) + TRIANGLE_COST * sum(half(part) * len(inside(part)) for part in (low, high))
                if cost < best[0] - 1e-9:
                    best = (cost, (tuple(low), tuple(high)))
    if best[1] is None or depth == 6 or min(sides) < 4:
        return [(box, depth)]
    return [leaf for part in best[1] for leaf in kd_cells(part, depth + 1)]


def boxes(numbers, depth=0):
    """The boxes of a hierarchy that is split at the object median of the longest side."""
    box = box_of([p for i in numbers for p in TRIANGLES[i]])
    made = [(box, depth)]
    if len(numbers) > 2:
        axis = 0 if box[2] - box[0] > box[3] - box[1] else 1
        ordered = sorted(numbers, key=lambda i: (sum(p[axis] for p in TRIANGLES[i]), i))
        made += boxes(ordered[:len(ordered) // 2], depth + 1) + boxes(ordered[len(ordered) // 2:], depth + 1)
    return made


def polygon(points, left):
    places = [(left + x * SIDE / 100, TOP + y * SIDE / 100) for x, y in points]
    return charts.polygon(places, f'fill="{charts.colour(5)}" fill-opacity="0.55" stroke="{charts.INK}" stroke-width="0.8"')


def rectangle(box, left, style):
    x, y, right, bottom = (value * SIDE / 100 for value in box)
    return charts.rect(left + x, TOP + y, right - x, bottom - y, style)


def panel(number, title, rectangles, words, is_space):
    left = LEFT + number * (SIDE + GAP)
    parts = [charts.bold(left, TOP - 10, title)]
    for box, depth in rectangles:
        if is_space:
            found = len(inside(box))
            shade = ("none", "#f3f0e8", "#e9dfc4", "#dcc890", "#cfae5a")[min(found, 4)]
            parts.append(rectangle(box, left, f'fill="{shade}" stroke="{charts.colour(1)}" stroke-width="1"'))
        else:
            parts.append(rectangle(box, left, f'fill="none" stroke="{charts.colour(2)}" stroke-width="{max(2.4 - 0.5 * depth, 0.8):.1f}"'))
    parts += [polygon(triangle, left) for triangle in TRIANGLES]
    if is_space:
        for box, _ in rectangles:
            found = len(inside(box))
            if found:
                parts.append(charts.text(left + (box[0] + 1.5) * SIDE / 100, TOP + (box[1] + 5.5) * SIDE / 100, str(found), extra=f' font-size="10" fill="{charts.colour(1)}"'))
    parts.append(charts.text(left, TOP + SIDE + 18, words))
    return parts


def draw():
    cells, leaves, nodes = grid(), kd_cells(), boxes(list(range(len(TRIANGLES))))
    parts = [charts.title(f"{len(TRIANGLES)} triangles in cells, with their number in each cell, and in boxes", LEFT, 24)]

    def references(of):
        return sum(len(inside(box)) for box, _ in of)

    parts += panel(0, "Uniform grid", cells, f"{len(cells)} cells, {references(cells)} references", True)
    parts += panel(1, "k-d tree", leaves, f"{len(leaves)} leaves, {references(leaves)} references", True)
    parts += panel(2, "Hierarchy of boxes", nodes, f"{len(nodes)} boxes, {len(TRIANGLES)} references", False)
    return charts.picture(WIDTH, TOP + SIDE + 32, parts)
