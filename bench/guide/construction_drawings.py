"""Draws what builders do with the rectangles of planar_trees: the splits of top-down rules, and the steps of AAC."""

import charts
import planar_trees

WIDTH, HEIGHT = 430, 372  # of a panel
LEFT, TOP, SCALE = 62, 44, 4.8
SAH_NOTE = "sum of half perimeters {:.2f} × the root's"


def place(x, y):
    """Of a point of the plane, whose second axis goes up."""
    return LEFT + SCALE * x, TOP + SCALE * (planar_trees.SIDE - y)


def rectangle(box, colour, width=1.5, fill=None, dash="", margin=0.0):
    x, y = place(box.low[0] - margin, box.high[1] + margin)
    w, h = (SCALE * (box.high[k] - box.low[k] + 2 * margin) for k in (0, 1))
    inside = f'fill="{fill}" fill-opacity="0.18"' if fill else 'fill="none"'
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return charts.rect(x, y, w, h, f'{inside} stroke="{colour}" stroke-width="{width}" stroke-opacity="1.0"{dashes}')


def objects(boxes, colours=None, numbers=None):
    """The rectangles themselves, with a number in each where there are some."""
    parts = []
    for i, box in enumerate(boxes):
        colour = colours[i] if colours else charts.INK
        x, y = place(box.low[0], box.high[1])
        w, h = (SCALE * (box.high[k] - box.low[k]) for k in (0, 1))
        parts.append(charts.rect(x, y, w, h, f'fill="{colour}" fill-opacity="0.45"'))
        if numbers:
            parts.append(charts.text(x + w / 2, y + h / 2 + 4, str(numbers[i]), "middle"))
    return parts


def heading(title, note):
    """Two lines above a panel's square."""
    return [charts.bold(LEFT, 18, title), charts.text(LEFT, 34, note, extra=f' fill="{charts.GREY}"'),
            rectangle(planar_trees.Box((0, 0), (planar_trees.SIDE, planar_trees.SIDE)), charts.RULE, 1.0)]


# ---- top-down ----------------------------------------------------------------------------------------------------------

LEVELS = (3.4, 2.2, 1.2)  # widths of lines of the upper levels
RULES = (("Object median: equal numbers", planar_trees.object_median), ("Spatial median: the middle", planar_trees.spatial_median),
         ("Surface area heuristic: every split", planar_trees.sweep_sah), ("Linear: along the Morton curve", planar_trees.linear))


def tree_boxes(root):
    """The boxes of the levels below the root, the lowest first."""
    levels, nodes = [], list(root.children)
    for depth, width in enumerate(LEVELS):
        levels.append([rectangle(node.box, charts.colour(depth), width, charts.colour(depth) if depth == 0 else None,
                                 margin=0.9 - 0.35 * depth) for node in nodes if node.children])
        nodes = [child for node in nodes for child in node.children]
    return [part for level in reversed(levels) for part in level]


def draw_top_down():
    boxes = planar_trees.some_boxes()

    def panel(rule):
        title, build = rule
        root = build(boxes)
        return [*heading(title, SAH_NOTE.format(planar_trees.sah_cost(root))), *tree_boxes(root), *objects(boxes)]

    header = [charts.title(f"The same {len(boxes)} rectangles, split by four rules")]
    x = 12
    for depth, name in enumerate(("children of the root", "grandchildren", "third level")):
        header += [f'<line x1="{x}" y1="40" x2="{x + 22}" y2="40" stroke="{charts.colour(depth)}" stroke-width="{LEVELS[depth]}"/>',
                   charts.text(x + 28, 44, name)]
        x += 50 + int(6.2 * len(name))
    return charts.Layout(WIDTH, HEIGHT, header=56, font=11).draw(header, RULES, panel)


# ---- approximate agglomerative clustering ------------------------------------------------------------------------------

DELTA = 4
PHASES = ("#444444", "#0072B2", "#D55E00")  # joints of a lowest part, in between, at the root


def joint_label(order, x, y, colour):
    return [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="7" fill="#fff" stroke="{colour}"/>',
            charts.text(x, y + 3.5, str(order), "middle", f' fill="{colour}" font-size="9.5"')]


class Aac:
    def __init__(self):
        self.boxes = planar_trees.some_boxes()
        self.clustering = planar_trees.Clustering(self.boxes, DELTA)
        self.place_on_curve = {number: i + 1 for i, number in enumerate(self.clustering.curve)}
        self.parts = self.clustering.top.parts()
        self.lowest = [part for part in self.parts if not part.children]
        self.between = [part for part in self.parts if part.children and part is not self.clustering.top]
        self.group_of = {number: i for i, part in enumerate(self.lowest) for number in part.numbers}
        self.colours = [charts.colour(self.group_of[i]) for i in range(len(self.boxes))]

    def numbers(self):
        return [self.place_on_curve[i] for i in range(len(self.boxes))]

    def curve(self):
        centers = [place(*(self.boxes[i].center(k) / 2 for k in (0, 1))) for i in self.clustering.curve]
        return charts.polyline(centers, charts.GREY, dash="4 3")

    def groups(self):
        parts = []
        for i, part in enumerate(self.lowest):
            box = planar_trees.bounds([self.boxes[number] for number in part.numbers])
            parts.append(rectangle(box, charts.colour(i), 1.0, charts.colour(i), dash="3 2", margin=0.8))
        return parts

    def joints(self, parts, colour):
        """The boxes of what the parts join, each with the number of the joint at its upper right or left of that."""
        lines, labels, taken = [], [], []
        for node in (node for part in parts for node in part.joined):
            lines.append(rectangle(node.box, colour, 1.8, margin=0.5))
            x, y = place(node.box.high[0] + 0.5, node.box.high[1] + 0.5)
            while any(abs(x - old_x) < 14 and abs(y - old_y) < 14 for old_x, old_y in taken):
                x -= 4
            taken.append((x, y))
            labels += joint_label(node.order, x, y, colour)
        return lines + labels

    def given(self, parts):
        """The clusters that the parts start with, where these are more than one rectangle."""
        return [rectangle(node.box, charts.GREY, 1.2, margin=0.4) for part in parts for node in part.given if node.children]

    def phase(self, order):
        """Which of PHASES a joint belongs to."""
        for i, parts in enumerate((self.lowest, self.between, [self.clustering.top])):
            if any(node.order == order for part in parts for node in part.joined):
                return i
        raise ValueError(order)


def draw_tree(aac):
    """The tree over the rectangles in the order of its leaves; each joint as high as its subtree."""
    root, parts = aac.clustering.root, []
    room, bottom = SCALE * planar_trees.SIDE, TOP + SCALE * planar_trees.SIDE - 34
    leaves = root.leaves()
    across = {leaf.number: LEFT + room * (i + 0.5) / len(leaves) for i, leaf in enumerate(leaves)}

    def height(node):
        return 1 + max(map(height, node.children)) if node.children else 0

    step = (bottom - TOP - 14) / height(root)

    def draw(node):
        if not node.children:
            x = across[node.number]
            parts.append(charts.line(x, bottom, x, bottom + 12, charts.GREY))
            parts.append(charts.text(x, bottom + 24, str(aac.place_on_curve[node.number]), "middle",
                              f' fill="{aac.colours[node.number]}" font-weight="bold" font-size="9.5"'))
            return x, bottom
        ends = [draw(child) for child in node.children]
        x, y = sum(end[0] for end in ends) / 2, bottom - step * height(node)
        colour = PHASES[aac.phase(node.order)]
        for end_x, end_y in ends:
            parts.append(charts.polyline([(end_x, end_y), (end_x, y), (x, y)], colour, 1.5))
        parts.extend(joint_label(node.order, x, y, colour))
        return x, y

    draw(root)
    return parts


def draw_aac():
    aac = Aac()
    clustering = aac.clustering
    targets = {}
    for part in sorted(aac.between, key=lambda part: len(part.numbers)):
        targets.setdefault(clustering.clusters_of(len(part.numbers)), []).append(len(part.numbers))
    kept = ", ".join(f"{clusters} of {min(counts)} to {max(counts)}" if len(set(counts)) > 1 else f"{clusters} of {counts[0]}"
                     for clusters, counts in targets.items())
    curve_note = "each number is the place of the centre's Morton code"
    steps = [
        ("1. Sort along the Morton curve", curve_note, lambda: [aac.curve(), *objects(aac.boxes, numbers=aac.numbers())]),
        (f"2. Divide until parts have fewer than δ = {DELTA}", "at the highest bit in which the codes of a part differ",
         lambda: [*aac.groups(), aac.curve(), *objects(aac.boxes, aac.colours, aac.numbers())]),
        ("3. In each part, join the nearest two", f"until f(δ) = {clustering.clusters_of(DELTA)} clusters are left",
         lambda: [*objects(aac.boxes, aac.colours, aac.numbers()), *aac.joints(aac.lowest, PHASES[0])]),
        ("4. Two parts put their clusters together", f"and join until f(n) are left: {kept}",
         lambda: [*objects(aac.boxes, aac.colours), *aac.given(aac.between), *aac.joints(aac.between, PHASES[1])]),
        ("5. At the root, join until one is left", f"of the {len(clustering.top.given)} clusters that both halves return",
         lambda: [*objects(aac.boxes, aac.colours), *aac.given([clustering.top]), *aac.joints([clustering.top], PHASES[2])]),
        ("6. The tree, with the joints of 3, 4 and 5", SAH_NOTE.format(planar_trees.sah_cost(clustering.root)),
         lambda: draw_tree(aac)),
    ]

    def panel(step):
        title, note, draw = step
        return [*heading(title, note), *draw()]

    header = [charts.title(f"Approximate agglomerative clustering of {len(aac.boxes)} rectangles")]
    return charts.Layout(WIDTH, HEIGHT, header=36, font=11).draw(header, steps, panel)
