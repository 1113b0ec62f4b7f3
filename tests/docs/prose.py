#!/usr/bin/env python3
"""Compares figures in prose with measured rows: a line with the mark <!-- rows: NAME --> must have the words of FIGURES[NAME].

Without it a sentence keeps its figures when the rows beside it are measured again. The mark stands at the end of a line: at its
beginning Markdown would end the paragraph there. Tables need none, because the reports in bench write them.
Standard library only.
"""

import re
import sys

from prose_rows import (DOCS, ROOT, bake_over_build, bakes_over_refits, balanced_over_deformable, beside_default, block_bytes,
                        build_over_blob, bytes_of, bytes_of_peers, code_budgets_over_rows, coherent_gains, counts,
                        deformable, engine, engines, fast_over_balanced, fast_over_small, firmware, is_noisy, machines,
                        more_pairs, of_fandisk, page_table, pair_speeds, peers_behind, ray_budget, sphere_speeds,
                        sweeps_over_ray, times_own_bytes, tiny_over_small)

PAGES = [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))]
MARK = re.compile(r" *<!-- rows: (\w+) -->")
FRACTIONS = {2: "half", 3: "a third", 4: "a quarter", 5: "a fifth", 6: "a sixth", 7: "a seventh", 8: "an eighth", 9: "a ninth", 10: "a tenth"}


def span(values, digits=0):
    low, high = (f"{value:,.{digits}f}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def percent(values, digits=0):
    return f"{span([100 * value for value in values], digits)} %"


def below_one(times):
    """What is saved of a time or a size."""
    return percent([1 - value for value in times])


def above_one(times):
    return percent([value - 1 for value in times])


def less_or_longer(times):
    return f"{percent([abs(times - 1)])} {'less' if times < 1 else 'longer'}"


def fraction(value):
    return FRACTIONS.get(round(1 / value), f"{value:.2f}")


def names(each):
    return f"{', '.join(each[:-1])} and {each[-1]}" if len(each) > 1 else "".join(each)


def more_or_fewer(mesh, more):
    if abs(more) < 0.00005:
        return f"as many on the {mesh}"
    digits = 1 if abs(more) >= 0.0005 else 2
    return f"{100 * abs(more):.{digits}f} % {'more' if more > 0 else 'fewer'} on the {mesh}"


def cheaper_with_fast(queries):
    return names([words for query, words in queries.items() if max(fast_over_small(core, "level", query) for core in ("m0", "m4f")) < 1])


FIGURES = {
    # README.md
    "bytes_of_others": lambda: [f"{span(bytes_of('jolt', 'mesh shape'))} bytes a triangle in Jolt",
                                f"{min(bytes_of('embree', 'default')):.0f} in Embree"],
    "bytes_of_balanced": lambda: [f"{span(bytes_of('espalier', 'balanced'))} bytes a triangle"],
    "bytes_of_fast": lambda: [f"{span(fast_over_balanced(), 1)} times the bytes"],
    "fast_rays": lambda: [f"{span(fast_over_balanced(), 1)} times the bytes", f"{span(beside_default('fast'), 2)} of the speed"],
    "tiny_rays": lambda: [f"{span(tiny_over_small(), 1)} times as long"],
    "ray_budget": lambda: ["{:,} bytes of code and {} bytes of stack".format(*ray_budget())],
    "sweeps": lambda: [f"{span(sweeps_over_ray())} times the instructions of a ray"],
    # benchmarks.md: rays, bytes and builds
    "memory": lambda: [f"{span(bytes_of('espalier', 'balanced'), 1)} bytes", f"peers take {span(bytes_of_peers())}"],
    "busy": lambda: ["a busy machine" if any(map(is_noisy, machines())) else "an idle machine"],
    "rays": lambda: [f"`fast` reaches {span(beside_default('fast'), 2)} of its speed", f"`balanced` {span(beside_default(), 2)}"],
    "bakes": lambda: [f"{span([1 / speed for speed in beside_default(kind='build')], 1)} times as long"],
    "batches": lambda: [f"up to {percent([max(coherent_gains())])} faster"],
    "peers_behind": lambda: [f"{names(peers_behind())} are slower"],
    "fandisk": lambda: ["{:.0f} KB".format(*of_fandisk("espalier", "fast")), "{1:.0f} ns in `fast`".format(*of_fandisk("espalier", "fast")),
                        "{1:.0f} ns in Embree".format(*of_fandisk("embree", "default"))],
    # benchmarks.md: spheres and two meshes
    "spheres": lambda: [f"{span(sphere_speeds('house'), 2)} of Embree's speed"],
    "touching": lambda: [f"{percent([count / 200 for count in counts('yes_no', 'espalier', 'fast')])} of the poses"],
    "fcl_touching": lambda: ["the same" if counts("yes_no", "espalier", "fast") == counts("yes_no", "fcl", "obbrss double") else "another"],
    "all_pairs": lambda: [f"{span(pair_speeds('all'), 1)} times as fast as ODE"],
    "fcl_pairs": lambda: [more_or_fewer(mesh, more) for mesh, more in more_pairs("fcl", "obbrss double").items()],
    "ode_pairs": lambda: [f"{percent([-more for more in more_pairs('ode', 'opcode').values()])} fewer"],
    # benchmarks.md and benchmarks/load.md: from disk to the first ray
    "load": lambda: [f"{span(build_over_blob('Embree, medium', 'open', 'load_ms'))} times as early as Embree's default build"],
    "load_beside_fastest": lambda: [f"{span(build_over_blob('Embree, low', 'open', 'load_ms'))} times as early as its fastest"],
    "load_mapped": lambda: [f"{span(build_over_blob('Embree, medium', 'map, open_unchecked', 'load_ms'))} times as early"],
    "load_memory": lambda: [f"{span(build_over_blob('Embree, medium', 'open', 'memory_bytes'))} times a blob's bytes"],
    "bake_at_load": lambda: [f"{span([times for p in ('fast', 'balanced') for times in bake_over_build(p, 'load_ms')], 1)} times as long"],
    "baked_memory": lambda: [f"{percent(bake_over_build(p, 'memory_bytes'))} of the bytes in `{p}`" for p in ("fast", "balanced")],
    # engines.md
    "bullet_fast": lambda: [f"{below_one([engine('Bullet', 'fast', 'times')])} less time",
                            f"{span(times_own_bytes('Bullet', 'fast'), 1)} times fewer bytes"],
    "bullet_balanced": lambda: [less_or_longer(engine("Bullet", "balanced", "times")),
                                f"{span(times_own_bytes('Bullet', 'balanced'), 1)} times fewer bytes"],
    "bullet_small": lambda: [f"{span(times_own_bytes('Bullet', 'small'), 1)} times fewer",
                             less_or_longer(engine("Bullet", "small", "times"))],
    "bullet_rest": lambda: [f"{span([100 * metres for metres in engines('Bullet', 'metres')])} centimetres"],
    "ode": lambda: [f"{above_one(engines('ODE', 'times'))} longer"],
    "jolt": lambda: [f"{below_one(engines('Jolt', 'times'))} less time", f"{span(times_own_bytes('Jolt'), 1)} times the bytes"],
    # small_cores.md
    "budgets_of_code": lambda: [f"{above_one(code_budgets_over_rows())} more"],
    "ray_of_fast": lambda: [f"{fraction(fast_over_small('m4f', 'bunny', 'raycast'))} the instructions"],
    "blob_of_fast": lambda: [f"{firmware().blobs['fast', 'bunny'] / firmware().blobs['small', 'bunny']:.1f} times the bytes"],
    "ray_of_fast_on_m0": lambda: [f"{fraction(1 - fast_over_small('m0', 'level', 'raycast'))} fewer instructions"],
    "cheaper_with_fast": lambda: [
        cheaper_with_fast({"overlaps_box": "Boxes", "overlaps_sphere": "spheres", "closest_point": "the closest point"})],
    "without_sections": lambda: [f"{page_table('small_cores.md', 'core | profile | bytes less')[0][2] / 1024:.1f} KB less"],
    "level": lambda: ["{:,} bytes".format(firmware().blobs["small", "level"]),
                      "{:.1f} bytes a triangle".format(firmware().blobs["small", "level"] / 5_002)],
    "cloth": lambda: ["{:,} bytes".format(firmware().blobs["fast", "cloth"])],
    # moving.md
    "bakes_in_refits": lambda: ["hundreds of refits" if 100 < min(bakes_over_refits()) and max(bakes_over_refits()) < 1000 else
                                f"{span(bakes_over_refits())} refits"],
    "balanced_of_deformable": lambda: [" or ".join(dict.fromkeys(map(fraction, balanced_over_deformable()))) + " of the bytes"],
    "moving_bytes": lambda: [f"{span(deformable('moving_bytes'), 1)} bytes a triangle move"],
    "still_bytes": lambda: [f"{span(deformable('source_bytes', 'still_bytes'), 1)}"],
    "position_bytes": lambda: [f"about {span(deformable('positions', scale=12))}"],
    # scenes.md
    "block": lambda: [f"{span(block_bytes(1) + block_bytes(2))} bytes an instance"],
    "block_for_any_order": lambda: [f"about {max(block_bytes(1)):.0f} bytes"],
    "least_block": lambda: [f"about {max(block_bytes(2)):.0f}"],
}


def has(line, words):
    """The words stand alone: "4.1" is neither in 14.1 nor in 4.15."""
    return re.search(rf"(?<![\w.,]){re.escape(words)}(?!\w|[.,]\d)", line) is not None


def check(line, name):
    """What the line lacks."""
    if name not in FIGURES:
        return [f"{name} is no name in FIGURES of {sys.argv[0]}"]
    return [f"{name}\n    written:  {MARK.sub('', line).strip()}\n    the rows: {words}" for words in FIGURES[name]() if not has(line, words)]


def main():
    for other in ("14.1 to 8.6 times", "4.1 to 8.65", "4.1 to 8.6k"):
        if has(other, "4.1 to 8.6") or not has("It is 4.1 to 8.6.", "4.1 to 8.6"):
            sys.exit(f"failed: 4.1 to 8.6 is taken for a part of {other}, or not found at the end of a sentence")
    problems, marked = [], set()
    for page in PAGES:
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
            for name in MARK.findall(line):
                marked.add(name)
                problems += [f"{page.relative_to(ROOT)}:{number}: {problem}" for problem in check(line, name)]
    problems += [f"no page has the mark {name}" for name in FIGURES if name not in marked]
    if problems:
        sys.exit("\n".join(["failed: prose and rows differ", *problems]))


main()
