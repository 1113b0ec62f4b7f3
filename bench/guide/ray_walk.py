"""Draws how a ray finds its triangle: a small scene in the plane, a tree over it, and each step of the real walk."""

import dataclasses
import math
import textwrap

import charts


# Corners of the scene's triangles, in units of the drawing; up is up.
TRIANGLES = (
    ((2, 14), (5, 18.5), (7, 15)), ((5, 10), (8.5, 10.5), (7, 11)),
    ((11, 13), (14, 19), (16, 14)), ((14, 9.2), (18, 9), (17, 10)),
    ((2, 2), (6, 1), (4, 6)), ((6.5, 4), (9, 3), (8, 8)),
    ((11, 0.5), (13, 1.5), (12, 5)), ((14, 3), (18, 2), (16, 7.5)),
    ((21, 14), (24, 18), (25, 13.5)), ((25, 13), (28.5, 17), (29, 14)),
    ((21, 3), (24, 5), (22, 8)), ((24, 6), (29, 7), (26, 11.5)),
    ((32, 12), (36, 17), (37, 13)), ((34, 6), (38, 11), (39, 5)),
    ((32, 2), (35, 4), (33, 5)), ((38, 13), (40, 17), (40, 12)),
)
ORIGIN, TARGET = (0.0, 12.5), (40.0, 8.0)
LEAF = 2  # triangles, at most


@dataclasses.dataclass(eq=False)
class Node:
    low: tuple
    high: tuple
    triangles: tuple  # numbers
    children: tuple = ()
    number: int | None = None  # in the order of visits
    fate: str = "not reached"  # or entered, visited, missed, waiting, skipped


@dataclasses.dataclass(eq=False)
class Step:
    """One node that was visited or skipped, and the state behind it."""
    node: Node
    words: str
    fates: dict
    hit: tuple | None  # distance and triangle
    tested: tuple  # triangles


def build(triangles):
    """Splits at the middle triangle along the longer side, down to leaves."""
    corners = [corner for number in triangles for corner in TRIANGLES[number]]
    node = Node(tuple(min(c[k] for c in corners) for k in (0, 1)), tuple(max(c[k] for c in corners) for k in (0, 1)), tuple(triangles))
    if len(triangles) > LEAF:
        axis = 0 if node.high[0] - node.low[0] >= node.high[1] - node.low[1] else 1
        order = sorted(triangles, key=lambda number: (sum(corner[axis] for corner in TRIANGLES[number]), number))
        half = len(order) // 2
        node.children = (build(order[:half]), build(order[half:]))
    return node


def nodes_below(node):
    return [node, *(below for child in node.children for below in nodes_below(child))]


class Ray:
    def __init__(self, origin, target):
        length = math.dist(origin, target)
        self.origin, self.direction = origin, tuple((target[k] - origin[k]) / length for k in (0, 1))

    def at(self, distance):
        return tuple(self.origin[k] + distance * self.direction[k] for k in (0, 1))

    def entry(self, node):
        """The distance at which the ray enters the box, or None: the slab test (Kay, Kajiya 1986)."""
        begin, end = 0.0, math.inf
        for k in (0, 1):
            slab = sorted((side[k] - self.origin[k]) / self.direction[k] for side in (node.low, node.high))
            begin, end = max(begin, slab[0]), min(end, slab[1])
        return begin if begin <= end else None

    def hit(self, triangle):
        """The distance at which the ray meets the triangle's outline first, or None."""
        found = []
        for a, b in zip(triangle, (*triangle[1:], triangle[0])):
            side = (b[0] - a[0], b[1] - a[1])
            to_a = (a[0] - self.origin[0], a[1] - self.origin[1])
            area = self.direction[0] * side[1] - self.direction[1] * side[0]
            if area != 0:
                distance = (to_a[0] * side[1] - to_a[1] * side[0]) / area
                share = (to_a[0] * self.direction[1] - to_a[1] * self.direction[0]) / area
                if distance >= 0 and 0 <= share <= 1:
                    found.append(distance)
        return min(found, default=None)


class Walk:
    """The closest hit, nearer children first, with the steps that led to it."""

    def __init__(self, root, ray):
        self.root, self.ray, self.steps, self.hit, self.stack, self.visits = root, ray, [], None, [], 0
        self.box_tests, self.triangle_tests = 1, 0
        node, words = root, ""
        while node:
            self.visit(node, words)
            node, words = self.next_node()

    def next_node(self):
        """The node to visit next, and where it comes from. Boxes that begin behind the hit are skipped."""
        if self.steps[-1].node.children and any(child.fate == "entered" for child in self.steps[-1].node.children):
            return self.stack.pop()[1], ""
        while self.stack:
            entry, node = self.stack.pop()
            if not self.hit or entry <= self.hit[0]:
                return node, f"Back to the stack, where box {self.visits + 1} waits. "
            node.fate = "skipped"
            self.record(node, f"Back to the stack. The box that waits there begins at {entry:.1f}, behind the hit at {self.hit[0]:.1f}. "
                              "Nothing in it can be closer: it is skipped, unopened.")
        return None, ""

    def visit(self, node, words):
        self.visits += 1
        node.number, node.fate = self.visits, "visited"
        if node.children:
            self.open(node, words)
        else:
            self.test_leaf(node, words)

    def open(self, node, words):
        self.box_tests += 2
        entries = [(self.ray.entry(child), child) for child in node.children]
        entered = sorted(((entry, child) for entry, child in entries if entry is not None and not (self.hit and entry > self.hit[0])),
                         key=lambda pair: pair[0])
        for entry, child in entries:
            child.fate = "missed" if entry is None else "skipped"
        for place_in_order, (_, child) in enumerate(entered):
            child.fate = "waiting" if place_in_order else "entered"
        self.stack += reversed(entered)
        words += f"Box {node.number}{', the root' if node is self.root else ''}: test the boxes of its two children. "
        if len(entered) == 2:
            words += (f"The ray enters both, at distances {entered[0][0]:.1f} and {entered[1][0]:.1f}. The nearer one is next; "
                      "the other waits on the stack.")
        elif entered:
            words += f"The ray enters one, at {entered[0][0]:.1f}, and misses the other: no triangle in there is tested."
        else:
            words += "The ray enters neither of them before its end."
        self.record(node, words)

    def test_leaf(self, node, words):
        self.triangle_tests += len(node.triangles)
        found = min(((distance, number) for number in node.triangles
                     if (distance := self.ray.hit(TRIANGLES[number])) is not None), default=None)
        words += f"Box {node.number} is a leaf: test its {len(node.triangles)} triangles. "
        if found is None:
            words += "The ray enters the box, but passes between them: no hit."
        elif self.hit is None or found < self.hit:
            self.hit = found
            words += f"It hits one, at {found[0]:.1f}. Only closer hits count from here on: the ray ends there."
        else:
            words += "Their hit is behind the one that was found."
        self.record(node, words, node.triangles)

    def record(self, node, words, tested=()):
        fates = {below: below.fate for below in nodes_below(self.root)}
        self.steps.append(Step(node, words, fates, self.hit, tested))


# ---- drawing ----------------------------------------------------------------------------------------------------------

WIDTH, HEIGHT, SCALE, LEFT, TOP = 430, 290, 9.9, 16, 26
CAPTION, LINE = 242, 15  # where the words begin, and from line to line
LETTERS = 72  # in a line
FATES = {"visited": charts.COLOURS[0], "entered": charts.COLOURS[0], "waiting": charts.COLOURS[4], "skipped": charts.COLOURS[1], "missed": "#aaa"}
WORDS = {"visited": "entered, with its number in order of visits", "waiting": "waits on the stack", "skipped": "skipped: begins behind the hit", "missed": "missed by the ray"}
HIT = charts.COLOURS[2]


def place(point):
    return LEFT + SCALE * point[0], TOP + SCALE * (19.7 - point[1])


def outline(node):
    """The sides of the box as it is drawn, left, top, right, bottom: around those of its children, which may share its sides."""
    (left, bottom), (right, top) = place(node.low), place(node.high)
    grow = 3.0 * (math.ceil(math.log2(len(node.triangles) / LEAF)) if node.children else 0)
    return left - grow, top - grow, right + grow, bottom + grow


def draw_box(node, fate, is_current):
    left, top, right, bottom = outline(node)
    dash = {"waiting": ' stroke-dasharray="6 3"', "skipped": ' stroke-dasharray="2 3"', "missed": ' stroke-dasharray="1 3"'}.get(fate, "")
    shade = 0.13 if is_current else 0.2 if fate == "missed" else 0
    look = f'fill="{FATES[fate]}" fill-opacity="{shade}" stroke="{FATES[fate]}" stroke-width="{2.6 if is_current else 1.3}"{dash}'
    return charts.rect(left, top, right - left, bottom - top, look)


def draw_ray(ray, hit):
    end = hit[0] if hit else min((40.6 - ray.origin[0]) / ray.direction[0], 60.0)
    (x0, y0), (x1, y1) = place(ray.origin), place(ray.at(end))
    parts = [charts.line(x0, y0, x1, y1, charts.INK, 1.8), charts.circle(x0, y0, 3.5, f'fill="{charts.INK}"')]
    if hit:
        return [*parts, charts.circle(x1, y1, 5, f'fill="none" stroke="{HIT}" stroke-width="2.4"')]
    dx, dy = ray.direction[0], -ray.direction[1]
    tip = [(x1, y1), (x1 - 9 * dx + 4 * dy, y1 - 9 * dy - 4 * dx), (x1 - 9 * dx - 4 * dy, y1 - 9 * dy + 4 * dx)]
    return [*parts, charts.polygon(tip, f'fill="{charts.INK}"')]


def draw_triangle(number, step):
    is_hit = step.hit is not None and step.hit[1] == number
    fill = HIT if is_hit else FATES["visited"] if number in step.tested else "#ddd"
    opacity = 0.85 if is_hit or number in step.tested else 1
    return charts.polygon(map(place, TRIANGLES[number]), f'fill="{fill}" fill-opacity="{opacity}" stroke="#999" stroke-width="0.7"')


def tag(x, y, words, colour):
    width = 6 + 6.5 * len(words)
    return [f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="14" rx="3" fill="{colour}"/>',
            charts.text(x + width / 2, y + 11, words, "middle", ' fill="#fff" font-weight="bold"')]


def caption(lines):
    return [charts.text(LEFT, CAPTION + LINE * i, line) for i, line in enumerate(lines)]


def draw_step(walk, number, step):
    parts = [charts.bold(LEFT, 15, f"Step {number}")]
    parts += [draw_triangle(i, step) for i in range(len(TRIANGLES))]
    shown = [(node, fate) for node, fate in step.fates.items() if fate in FATES]
    for node, fate in shown:
        parts.append(draw_box(node, fate, node is step.node))
    parts += draw_ray(walk.ray, step.hit)
    taken = []  # where numbers are
    for node, fate in shown:
        if fate == "visited":
            left, top, _, _ = outline(node)
            while any(abs(left - x) < 15 and abs(top - y) < 16 for x, y in taken):
                left += 4
            taken.append((left, top))
            parts += tag(left, top, str(node.number), FATES["visited"])
    return parts + caption(textwrap.wrap(step.words, LETTERS))


def draw_tree(walk):
    """The whole tree, each node coloured by what became of it."""
    leaves = [node for node in nodes_below(walk.root) if not node.children]
    across = {leaf: LEFT + 26 + i * (WIDTH - 2 * LEFT - 52) / (len(leaves) - 1) for i, leaf in enumerate(leaves)}

    def lay(node, depth, places):
        for child in node.children:
            lay(child, depth + 1, places)
        x = across[node] if not node.children else sum(places[child][0] for child in node.children) / 2
        places[node] = (x, TOP + 26 + depth * 46)
        return places

    places = lay(walk.root, 0, {})
    parts = [charts.bold(LEFT, 15, "The tree, when the walk is over")]
    parts += [charts.line(*places[n], *places[c], "#bbb") for n in places for c in n.children]
    for node, (x, y) in places.items():
        is_hit = not node.children and walk.hit and walk.hit[1] in node.triangles
        colour = HIT if is_hit else FATES.get(node.fate, "#e4e4e4")
        parts.append(charts.circle(x, y, 11, f'fill="{colour}"'))
        if node.number is not None:
            parts.append(charts.text(x, y + 4, str(node.number), "middle", ' fill="#fff" font-weight="bold"'))
    return parts + caption([
        "Nothing waits any more: the green triangle is the closest hit.",
        f"Tested: {walk.box_tests} of {len(places)} boxes, {walk.triangle_tests} of {len(TRIANGLES)} triangles.",
        "Light grey: below a box that was missed or skipped, and never reached."])


def draw():
    """The picture, as text."""
    walk = Walk(build(tuple(range(len(TRIANGLES)))), Ray(ORIGIN, TARGET))
    header, x = [charts.title("How a ray finds its triangle")], 12
    for fate, words in WORDS.items():
        header += [f'<rect x="{x}" y="34" width="11" height="11" fill="{FATES[fate]}"/>', charts.text(x + 16, 44, words)]
        x += 40 + 6 * len(words)
    panels = [*enumerate(walk.steps, 1), None]
    return charts.Layout(WIDTH, HEIGHT, header=56, font=11).draw(
        header, panels, lambda panel: draw_tree(walk) if panel is None else draw_step(walk, *panel))
