"""Builds trees over a few rectangles in the plane, as the builders do over triangles in space: for drawings.

In the plane the half perimeter takes the place of the area. Every run makes the same trees.
"""

import dataclasses

SIDE = 64  # of the square in which the rectangles lie
EXPONENT = 0.1  # e of Gu et al. 2013, which the library uses too


@dataclasses.dataclass(frozen=True)
class Box:
    low: tuple
    high: tuple

    def joined(self, other):
        return Box(tuple(map(min, self.low, other.low)), tuple(map(max, self.high, other.high)))

    def half_perimeter(self):
        return sum(self.high) - sum(self.low)

    def center(self, axis):
        return self.low[axis] + self.high[axis]  # twice


@dataclasses.dataclass
class Node:
    box: Box
    children: tuple = ()
    number: int = -1  # of the rectangle, in a leaf
    order: int = 0  # when it was made, from 1 on
    members: int = 1  # rectangles below

    def inner(self):
        """The nodes with children, the root first."""
        return [self, *self.children[0].inner(), *self.children[1].inner()] if self.children else []

    def leaves(self):
        return [leaf for child in self.children for leaf in child.leaves()] or [self]


def bounds(boxes):
    whole = boxes[0]
    for box in boxes[1:]:
        whole = whole.joined(box)
    return whole


def join(left, right, order=0):
    return Node(left.box.joined(right.box), (left, right), order=order, members=left.members + right.members)


def some_boxes(count=22):
    """Rectangles in three crowds and a few apart, none upon another: a fixed sequence of pseudo-random numbers."""
    state, boxes = 20, []

    def below(end):
        nonlocal state
        state = (state * 1103515245 + 12345) % 2 ** 31
        return (state >> 12) % end

    crowds = ((13, 47, 12), (46, 42, 13), (36, 12, 10), (32, 32, 31))
    while len(boxes) < count:
        x, y, reach = crowds[len(boxes) % len(crowds)]
        low = (x + below(2 * reach) - reach, y + below(2 * reach) - reach)
        box = Box(low, (low[0] + 2 + below(5), low[1] + 2 + below(5)))
        inside = min(box.low) >= 1 and max(box.high) <= SIDE - 1
        apart = all(any(box.low[k] > old.high[k] + 1 or old.low[k] > box.high[k] + 1 for k in (0, 1)) for old in boxes)
        if inside and apart:
            boxes.append(box)
    return boxes


def sah_cost(root):
    """The sum of all nodes' half perimeters over the root's."""
    return sum(node.box.half_perimeter() for node in [*root.inner(), *root.leaves()]) / root.box.half_perimeter()


# ---- the space-filling curve -------------------------------------------------------------------------------------------


def morton_code(box):
    """The bits of the centre's coordinates, interlaced, x first (Morton 1966)."""
    code = 0
    for bit in reversed(range(2 * SIDE - 1)):
        code = code << 2 | (box.center(0) >> bit & 1) << 1 | box.center(1) >> bit & 1
    return code


def morton_split(codes):
    """How many of the codes, which ascend, lie before the highest bit in which they differ."""
    different = codes[0] ^ codes[-1]
    if different == 0:
        return len(codes) // 2
    highest = 1 << different.bit_length() - 1
    return sum(1 for code in codes if not code & highest)


def linear(boxes):
    codes = [morton_code(box) for box in boxes]
    order = sorted(range(len(boxes)), key=lambda i: (codes[i], i))

    def build(numbers):
        if len(numbers) == 1:
            return Node(boxes[numbers[0]], number=numbers[0])
        left = morton_split([codes[i] for i in numbers])
        return join(build(numbers[:left]), build(numbers[left:]))

    return build(order)


# ---- from the top down -------------------------------------------------------------------------------------------------


def top_down(boxes, split):
    """split(boxes of a node, their numbers) returns those numbers sorted, and how many go left."""

    def build(numbers):
        if len(numbers) == 1:
            return Node(boxes[numbers[0]], number=numbers[0])
        numbers, left = split(numbers)
        return join(build(numbers[:left]), build(numbers[left:]))

    return build(list(range(len(boxes))))


def along(boxes, axis, numbers):
    return sorted(numbers, key=lambda i: (boxes[i].center(axis), i))


def widest(boxes, numbers):
    spread = [max(boxes[i].center(k) for i in numbers) - min(boxes[i].center(k) for i in numbers) for k in (0, 1)]
    return 0 if spread[0] >= spread[1] else 1


def object_median(boxes):
    return top_down(boxes, lambda numbers: (along(boxes, widest(boxes, numbers), numbers), len(numbers) // 2))


def spatial_median(boxes):
    def split(numbers):
        axis = widest(boxes, numbers)
        ordered = along(boxes, axis, numbers)
        middle = (boxes[ordered[0]].center(axis) + boxes[ordered[-1]].center(axis)) / 2
        left = sum(1 for i in ordered if boxes[i].center(axis) < middle)
        return ordered, left if 0 < left < len(ordered) else len(ordered) // 2

    return top_down(boxes, split)


def sweep_sah(boxes):
    def split(numbers):
        orders = [along(boxes, axis, numbers) for axis in (0, 1)]
        candidates = [(cost([boxes[i] for i in order], left), axis, left)
                      for axis, order in enumerate(orders) for left in range(1, len(order))]
        _, axis, left = min(candidates)
        return orders[axis], left

    def cost(ordered, left):
        return (left * bounds(ordered[:left]).half_perimeter()
                + (len(ordered) - left) * bounds(ordered[left:]).half_perimeter())

    return top_down(boxes, split)


# ---- from the bottom up ------------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Part:
    """A part of the curve in approximate agglomerative clustering, and what happens in it."""
    numbers: list  # of rectangles, in their order on the curve
    children: tuple
    given: list  # clusters, before
    joined: list  # clusters that are made here, in their order
    kept: list  # clusters that the part returns

    def height(self):
        return 1 + max(child.height() for child in self.children) if self.children else 0

    def parts(self):
        return [part for child in self.children for part in child.parts()] + [self]


class Clustering:
    """"Efficient BVH construction via approximate agglomerative clustering" (Gu, He, Fatahalian, Blelloch 2013)."""

    def __init__(self, boxes, delta):
        self.boxes, self.delta, self.made = boxes, delta, 0
        self.codes = [morton_code(box) for box in boxes]
        self.curve = sorted(range(len(boxes)), key=lambda i: (self.codes[i], i))
        self.top = self.part(self.curve)
        self.root = self.top.kept[0]

    def clusters_of(self, count):
        """How many clusters a part of so many rectangles returns."""
        return int(self.delta ** (0.5 + EXPONENT) / 2 * count ** (0.5 - EXPONENT) + 1e-9)

    def part(self, numbers):
        if len(numbers) < self.delta:
            given = [Node(self.boxes[i], number=i) for i in numbers]
            return self.reduced(numbers, (), given, self.clusters_of(self.delta))
        left = morton_split([self.codes[i] for i in numbers])
        children = self.part(numbers[:left]), self.part(numbers[left:])
        given = [*children[0].kept, *children[1].kept]
        is_root = len(numbers) == len(self.boxes)
        return self.reduced(numbers, children, given, 1 if is_root else self.clusters_of(len(numbers)))

    def reduced(self, numbers, children, given, target):
        """Joins the two clusters with the smallest box around both, until only so many are left."""
        kept, joined = list(given), []
        while len(kept) > target:
            _, a, b = min((kept[a].box.joined(kept[b].box).half_perimeter(), a, b)
                          for a in range(len(kept)) for b in range(a + 1, len(kept)))
            self.made += 1
            kept[a] = join(kept[a], kept[b], self.made)
            joined.append(kept[a])
            del kept[b]
        return Part(numbers, children, given, joined, kept)
