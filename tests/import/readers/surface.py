"""What a mesh file contains, as far as the tests compare it."""


class Unsupported(Exception):
    """The file uses something that the reader does not implement: nothing can be compared."""


class Broken(Exception):
    """The file contradicts its format."""


def area_vector(a, b, c):
    u = [b[i] - a[i] for i in range(3)]
    v = [c[i] - a[i] for i in range(3)]
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def without_repeats(indices):
    """The corners of a polygon; of one with more than 3, those that repeat the one before are left out."""
    if len(indices) <= 3:
        return indices
    kept = [index for place, index in enumerate(indices) if index != indices[place - 1]]
    return kept if len(set(kept)) >= 3 else []


class Surface:
    """Counts the triangles of polygons; the bounds are those of polygons with an area."""

    def __init__(self):
        self.triangles = 0
        self.low = [float("inf")] * 3
        self.high = [float("-inf")] * 3

    def add(self, corners):
        """Adds a polygon, given as its corners: n corners make n - 2 triangles, however they are cut."""
        self.triangles += len(corners) - 2
        a = corners[0]
        if not any(any(area_vector(a, corners[i - 1], corners[i])) for i in range(2, len(corners))):
            return
        for corner in corners:
            for axis in range(3):
                self.low[axis] = min(self.low[axis], corner[axis])
                self.high[axis] = max(self.high[axis], corner[axis])
