"""Draws Terdiman's ladder: the nodes that each step keeps over the same eight triangles, and the bytes of one node."""

import charts


WIDTH, HEIGHT = 430, 232  # of a panel
LEFT, TOP, LEVEL = 14, 58, 30
ROOM = WIDTH - 2 * LEFT
TRIANGLES = 8
WIDE = 1.15  # pixels of a byte of a node in the tree
BYTE = 6.0  # pixels of a byte of the node below it
BOX, LINK, DROPPED, TRIANGLE = charts.COLOURS[0], charts.COLOURS[1], charts.GREY, charts.COLOURS[2]


def middle(first, count):
    """Where a node over these triangles is."""
    return LEFT + ROOM * (first + count / 2) / TRIANGLES


class Step:
    """A step: its nodes' fields as (name, bytes, colour), and how many triangles are in a leaf."""

    def __init__(self, title, note, fields, leaf_triangles, leaves_have_nodes, degree=2):
        self.title, self.note, self.fields, self.degree = title, note, fields, degree
        self.leaf_triangles, self.leaves_have_nodes = leaf_triangles, leaves_have_nodes
        self.node_bytes = sum(size for _, size, _ in fields)
        self.nodes = 0


def triangle_mark(x, y):
    return charts.polygon(((x - 5, y + 8), (x + 5, y + 8), (x, y - 1)), f'fill="{TRIANGLE}"')


def node_mark(step, x, y):
    """A node as wide as its bytes, in the colours of its fields."""
    parts, left = [], x - WIDE * step.node_bytes / 2
    for _, size, colour in step.fields:
        parts.append(f'<rect x="{left:.1f}" y="{y:.1f}" width="{WIDE * size:.1f}" height="11" fill="{colour}" fill-opacity="0.75"/>')
        left += WIDE * size
    return parts


def draw_leaf(step, first, count, x, y, parts):
    """The triangles of a leaf below its node, or where the node was dropped."""
    if step.leaves_have_nodes:
        step.nodes += 1
        parts += node_mark(step, x, y)
    else:
        parts.append(f'<rect x="{x - 14:.1f}" y="{y:.1f}" width="28" height="11" fill="none" stroke="{DROPPED}" stroke-dasharray="3 2"/>')
    bottom = TOP + 3 * LEVEL + 19
    for i in range(count):
        at = middle(first + i, 1)
        parts += [charts.line(x, y + 11, at, bottom, charts.GREY), triangle_mark(at, bottom)]


def draw_subtree(step, first, count, y, parts):
    x = middle(first, count)
    if count <= step.leaf_triangles:
        draw_leaf(step, first, count, x, y, parts)
        return
    step.nodes += 1
    children = 2 if step.degree == 2 else count // step.leaf_triangles
    below = y + LEVEL
    for i in range(children):
        share = count // children
        child = middle(first + i * share, share)
        parts.append(charts.line(x, y + 11, child, below, charts.GREY))
        draw_subtree(step, first + i * share, share, below, parts)
    parts += node_mark(step, x, y)


def draw_fields(step):
    """The bytes of one node, in a row, each field with its name below it or beside the name before."""
    parts, x, y, free = [], LEFT, HEIGHT - 36, LEFT
    for name, size, colour in step.fields:
        width = BYTE * size
        parts.append(f'<rect x="{x:.1f}" y="{y}" width="{width:.1f}" height="15" fill="{colour}" fill-opacity="0.75" stroke="#fff"/>')
        words = f"{name}: {size}"
        at = max(x, free)
        parts.append(charts.text(at, y + 27, words, extra=f' font-size="9.5" fill="{colour}"'))
        free = at + 5.6 * len(words) + 8
        x += width
    return parts


def draw_panel(step):
    parts = []
    step.nodes = 0
    draw_subtree(step, 0, TRIANGLES, TOP, parts)
    word = "node" if step.nodes == 1 else "nodes"
    size = f"{step.nodes} {word} of {step.node_bytes} bytes: {step.nodes * step.node_bytes} bytes"
    return [charts.bold(LEFT, 18, step.title), charts.text(WIDTH - LEFT, 18, size, "end"),
            charts.text(LEFT, 34, step.note, extra=f' fill="{charts.GREY}"'), *parts, *draw_fields(step)]


def draw():
    box, quantised, one, two = ("box, 6 floats", 24, BOX), ("box, 6 × 16 bits", 12, BOX), ("link", 4, LINK), ("2 links", 8, LINK)
    steps = [
        Step("1. Complete", "a node for each inner node and for each triangle: 2n − 1", (box, one), 1, True),
        Step("2. Several triangles a leaf", "here two: fewer leaves, and fewer nodes above them", (box, one), 2, True),
        Step("3. No leaf nodes", "of step 1: a leaf is a link in its parent, without a box: n − 1", (box, two), 1, False),
        Step("4. Quantised", "step 3 with boxes on a grid over the whole mesh", (quantised, two), 1, False),
        Step("5. Quantised, several a leaf", "steps 2, 3 and 4 at once", (quantised, two), 2, False),
        Step("7. Espalier, profile small", "boxes of 8 children on a grid of the node's own; siblings are neighbours",
             (("grid", 8, charts.COLOURS[4]), ("links", 8, LINK), ("8 boxes of 6 bytes", 48, BOX)), 2, False, degree=8),
    ]
    header = [charts.title("The same eight triangles, step by step: nodes and their bytes")]
    return charts.Layout(WIDTH, HEIGHT, header=36, font=11).draw(header, steps, draw_panel)
