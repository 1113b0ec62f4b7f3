"""What the sections on memory and on the degree of trees share: cells and panels of the rows of espalier_bench_study ladder."""

import charts
from report_page import fail

FIELDS = ("tree", "degree", "leaf_triangles", "nodes", "node_bytes", "bytes_per_triangle", "all_bytes_per_triangle", "rays", "nodes_per_ray",
          "leaves_per_ray", "box_tests_per_ray", "triangle_tests_per_ray", "ns_per_ray", "boxes", "nodes_per_box", "leaves_per_box",
          "box_tests_per_box", "triangle_tests_per_box", "touching_per_box", "ns_per_box", "rays_that_differ", "boxes_that_differ",
          "counted_twice", "rounds")


def cell(row, query):
    work = "; ".join(charts.number(row[f"{field}_per_{query}"]) for field in ("nodes", "box_tests", "triangle_tests"))
    return f"{work}; {charts.time(row[f'ns_per_{query}'])}"


def ray_cell(row):
    return cell(row, "ray")


def box_cell(row):
    return cell(row, "box")


def range_of(rows, field):
    """The least and the greatest value over the meshes, or the only one."""
    low, high = (f"{end(row[field] for row in rows):.1f}" for end in (min, max))
    return low if low == high else f"{low} to {high}"


def recounted(rows):
    """How many queries were counted by both counters, and how many answers of blobs differ."""
    numbers = {row["counted_twice"] for row in rows}
    if len(numbers) != 1:
        fail("rows were counted twice for different numbers of queries")
    most = max(row["rays_that_differ"] for row in rows)
    boxes = max(row["boxes_that_differ"] for row in rows)
    differing = f"of a blob, whose tests are exact, those of at most {most} rays and {boxes} boxes of a mesh differ"
    return (f"A second counter, which shares no code with the walks, has the same counts for the first {numbers.pop()} rays and boxes of each tree;\n"
            "rays of a blob are counted by the library alone, a node again when the ray returns to it, and boxes by a walk over the blob's nodes.\n"
            f"All textbook trees have the same answers; {differing}.")


def bar(label, name, values):
    return charts.mean_bar(label, values, 1 if name.startswith("espalier") else 0)


def value_panel(rows, measures, title, field, trees):
    return charts.Bars(title, [bar(label, name, [row[field] for row in rows.of(measures, tree=name)]) for name, _, label in trees])


def ratio_panel(rows, measures, title, field, trees, reference):
    """Values over those of one tree on the same mesh."""
    return charts.Bars(title, [bar(label, name, rows.ratios(measures, field, {"tree": reference}, tree=name)) for name, _, label in trees])
