#!/usr/bin/env python3
"""mutate.py --check: checks that all of CLAIMS exist, that each test of the runtime is there or in LEFT_OUT, and each
excuse as `instrument.py --check` does.
mutate.py BUILD [PART...] [--files FILE...] [--since COMMIT] [--survivors] [--most N] [--claims TEXT...] [--publish]:
breaks the library in every way that instrument.py knows, one at a time, and prints what no claim noticed. PART is
verifier, decode, quantiser, traversal, rounding, small (what microcontrollers have of their own), queries (what they do
at nodes and leaves, batches), scenes (what opens them), ids (the section of original ids, as the baker writes it),
edges (the baker's table), moving (scenes whose instances move) or deformation (meshes whose vertices move). --files
chooses the mutants of some files of lib, --since those of files whose code has changed since a commit; all mutants when
nothing is chosen. Exit status 1 when a mutant survives that no comment in the code excuses (excuses.py). --publish
writes a row for each part that was run as a whole into the table of docs/testing.md.

All mutants are compiled once, into the same programs, and again as small code (ESPALIER_SMALL_CODE); they are chosen
when a program starts. A first run of every claim without any notes how long it takes and by which mutants it comes;
each mutant is then shown to the claims that come by it, first those that have noticed most of its file's mutants for the
time that they take, until one is red, crashes or takes far too long.

What was found is kept in BUILD/results.jsonl and holds as long as the mutant's file has the same code: a mutant
that was noticed is not asked about again, one that survived only by claims that it has not met. --survivors leaves out
all mutants that have not been run yet; --claims asks only those with one of these texts in their names, also where the
mutant has met them, since they may have changed; --most asks so many of each mutant, and leaves the others for another
run.
"""
import argparse
import collections
import concurrent.futures
import filecmp
import hashlib
import json
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys

from instrument import PARTS, check as check_excuses, version_of
from published import publish

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
JOBS = int(os.environ.get("MUTATION_JOBS", os.cpu_count() or 1))
LONGEST = float(os.environ.get("MUTATION_LONGEST_CLAIM", "2"))  # seconds of a processor
SCALE = os.environ.get("ESPALIER_TEST_SCALE", "0.05")  # enough for most mutants; survivors are worth more

# Claims by file. Those of files and query answers are asked too: tests/platform.
CLAIMS = [f"{name}_test.cpp" for name in (
    "runtime/blob/open", "runtime/blob/open_codecs", "runtime/blob/open_rules", "runtime/blob/open_tree",
    "runtime/blob/open_sections", "runtime/blob/open_ids", "runtime/blob/open_leaves",
    "runtime/blob/open_predicted_strips", "runtime/blob/open_deformable", "runtime/blob/open_unchecked",
    "runtime/blob/weird_blob",
    "runtime/traversal/statistics", "runtime/traversal/work", "runtime/traversal/node_boxes",
    "runtime/rays/traversal", "runtime/lattice/round_ray", "runtime/lattice/round_point",
    "runtime/lattice/step_queries", "runtime/lattice/steps", "runtime/asset/identity", "runtime/asset/bounds",
    "runtime/asset/contact", "runtime/asset/contents", "runtime/proximity/nearest", "runtime/proximity/triangle_gap",
    "runtime/proximity/inside", "runtime/proximity/inside_loop", "runtime/proximity/mean_winding",
    "runtime/overlap/overlap", "runtime/overlap/volume", "runtime/overlap/volume_edges", "runtime/overlap/cone",
    "runtime/traversal/approximate", "runtime/traversal/walk", "runtime/lattice/rounding",
    "runtime/lattice/rounding_error", "runtime/lattice/rounding_formula", "runtime/rays/rounded_ray",
    "runtime/rays/rounded_ray_borders", "runtime/rays/seam_rays", "runtime/rays/seen_ray",
    "runtime/traversal/small_boxes", "runtime/rays/leaf_filter", "runtime/rays/ray", "runtime/rays/batch",
    "runtime/batches/arrays",
    "runtime/rays/closest_hits", "runtime/rays/far_query", "runtime/rays/every_hit", "runtime/rays/extreme_rays",
    "runtime/rays/leak", "runtime/rays/crossing", "runtime/sweeps/slide", "runtime/sweeps/bounds",
    "runtime/sweeps/start",
    "runtime/contacts/touch", "runtime/contacts/touch_hull", "runtime/contacts/touch_pair", "runtime/contacts/find",
    "runtime/contacts/pair_touches", "runtime/scenes/scene", "runtime/scenes/hostile",
    "runtime/scenes/gap", "runtime/scenes/tiles", "runtime/scenes/metamorphic",
    "runtime/scenes/modes", "runtime/scenes/rules", "runtime/scenes/sweeps",
    "runtime/moving_scenes/tree", "runtime/moving_scenes/hilbert", "runtime/moving_scenes/steps_box",
    "runtime/moving_scenes/steps_boxes",
    "runtime/moving_scenes/pairs", "runtime/moving_scenes/loop", "runtime/moving_scenes/sweeps",
    "runtime/moving_scenes/scene",
    "runtime/moving_scenes/colliding", "runtime/moving_scenes/view",
    "runtime/moving_scenes/hostile", "runtime/moving_scenes/rules", "runtime/moving_scenes/borders",
    "runtime/moving_scenes/changes", "runtime/moving_scenes/calls",
    "runtime/deformation/refit", "runtime/deformation/refusals", "runtime/deformation/loop",
    "runtime/deformation/scenes",
    "runtime/pairs/pair", "runtime/pairs/distance_work", "runtime/pairs/frame", "runtime/pairs/loop",
    "runtime/pairs/pages", "runtime/pairs/counters", "runtime/moving_scenes/counters",
    "runtime/proximity/closest_pair", "runtime/sweeps/sweep", "runtime/transforms/transform",
    "runtime/base/float_bits", "runtime/base/wide_integer", "runtime/kernels/ray_triangle",
    "runtime/kernels/point_triangle", "runtime/kernels/segment_triangle", "runtime/kernels/triangle_triangle",
    "runtime/kernels/triangle_distance", "runtime/kernels/volume_triangle", "runtime/kernels/box_distance",
    "runtime/kernels/moving_sphere", "runtime/kernels/moving_capsule", "runtime/kernels/moving_box",
    "runtime/kernels/moving_hull",
    "runtime/blob/duplicate_references", "runtime/overlap/duplicate_references",
    "runtime/traversal/packed_walk", "baker/quantise/lattice", "baker/quantise/lattice_borders",
    "baker/error/fit_lattice", "baker/build/tree", "baker/collapse/strip", "baker/collapse/leaf_size",
    "baker/sections/bounds",
    "baker/sections/edge_flags", "baker/base/edge_table", "baker/error/error", "baker/quantise/drop",
    "baker/deformation/motion", "baker/input/check_deformation", "baker/deformation/steered_tree",
    "baker/build/spatial", "baker/few_triangles", "baker/input/input", "baker/quantise/closed", "baker/quantise/seams",
    "baker/encode/remap", "baker/encode/id_kinds", "oracle/slab_test")]
# The other tests of the runtime, and why no mutant is shown to them.
LEFT_OUT = {
    "runtime/blob/hostile_test.cpp": "takes a minute",
    "runtime/scenes/cost_test.cpp": "measures stacks, and the programs here have other frames",
    "runtime/pairs/real_meshes_test.cpp": "takes half a minute, and reads meshes that the programs here do not find",
    "runtime/contacts/character_test.cpp": "judges an example, not the library",
    "runtime/traversal/triangle_loop_test.cpp": "judges the loop that other tests use, not the library"}
QUESTIONS = [5, 100]  # of a kind and blob
BUILDS = {"build": "", "build_small_code": "ON"}


def write_sources(folder):
    """The library with all mutants in it, and the list of mutants."""
    source, fresh = folder / "source", folder / "fresh"
    shutil.rmtree(fresh, ignore_errors=True)
    fresh.mkdir(parents=True)
    shutil.copy(ROOT / "CMakeLists.txt", fresh)
    shutil.copytree(ROOT / "tests", fresh / "tests")
    shutil.copytree(ROOT / "lib", fresh / "lib")
    with open(fresh / "CMakeLists.txt", "a") as top:
        top.write("add_subdirectory(tests/mutation)\n")
    written = subprocess.run([sys.executable, HERE / "instrument.py", ROOT / "lib", fresh / "lib",
                              folder / "mutants.jsonl"])
    if written.returncode != 0:
        raise SystemExit(written.returncode)
    leave_out_wide_lanes(fresh)
    # Only what changed is touched, and compiled again.
    for path in fresh.rglob("*"):
        old = source / path.relative_to(fresh)
        if path.is_file() and not (old.is_file() and filecmp.cmp(path, old, shallow=False)):
            old.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, old)
    return [json.loads(line) for line in (folder / "mutants.jsonl").open()]


def build(folder, mutants):
    """The programs that judge the mutants."""
    source = folder / "source"
    flags = f"-std=c++20 -O1 -w -include {source}/tests/mutation/mutants.hpp"
    for name, small_code in BUILDS.items():
        claims = [claim for claim in CLAIMS if not small_code or claim.startswith("runtime/")]
        subprocess.run(["cmake", "-S", source, "-B", folder / name, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                        "-DESPALIER_TESTS=OFF", "-DESPALIER_TOOLS=OFF", "-DESPALIER_BENCH=OFF",
                        "-DESPALIER_INSTALL=OFF", "-DESPALIER_COUNT_STEPS=ON", f"-DESPALIER_SMALL_CODE={small_code}",
                        f"-DCMAKE_CXX_FLAGS={flags}", f"-DMUTANT_COUNT={mutants[-1]['number'] + 1}",
                        f"-DMUTANT_CLAIMS={';'.join(claims)}"], check=True, stdout=subprocess.DEVNULL)
        built = subprocess.run(["cmake", "--build", folder / name, "-j", str(JOBS), "--target", "mutant_blobs",
                                "mutant_answers", "mutant_claims"], stdout=subprocess.PIPE, text=True)
        if built.returncode != 0:
            raise SystemExit(built.stdout)


def leave_out_wide_lanes(fresh):
    """One lane and four have between them all that is mutated; what is wider is held to their bits elsewhere."""
    for path in fresh.glob("lib/runtime/instruction_sets/avx*.cpp"):
        path.write_text("")
    dispatch = fresh / "lib/runtime/lanes/select.hpp"
    text = dispatch.read_text().replace("defined(__x86_64__)", "0")
    dispatch.write_text(text.replace("avx2::query", "sse42::query"))
    paths = fresh / "tests/support/machine/instruction_paths.cpp"
    text = paths.read_text().replace("defined(__x86_64__)", "0")
    paths.write_text(re.sub(r".*ESPALIER_PATH\(avx2\).*\n", "", text))


class Claim:
    """One thing that must hold. What it prints, if anything is expected, is compared with what it prints unbroken."""
    def __init__(self, name, command, compares_output=False, compares_folder=False, lanes=1):
        self.name, self.command = name, command
        self.compares_output, self.compares_folder = compares_output, compares_folder
        self.lanes = lanes
        self.seconds, self.expected, self.reached = 0.0, None, set()

    def run(self, scratch, limit, **environment):
        """Exit status, what is compared, and how many seconds of a processor it took; it is stopped at the limit."""
        # A mutant that crashes where doctest reports may wait for itself, which takes no processor's time.
        command = ["timeout", "-s", "KILL", str(60 + 20 * limit), "prlimit", f"--cpu={limit}",
                   *(str(part) for part in self.command)]
        if self.compares_folder:
            shutil.rmtree(scratch, ignore_errors=True)
            scratch.mkdir(parents=True)
            command.append(str(scratch))
        started = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                   env=dict(os.environ, MUTANT_LANES=str(self.lanes), ESPALIER_TEST_SCALE=SCALE,
                                            **environment))
        output = started.stdout.read()
        _, status, usage = os.wait4(started.pid, 0)
        started.returncode = os.waitstatus_to_exitcode(status)
        if started.returncode > 128:  # as timeout tells the signal that ended the program
            started.returncode = 128 - started.returncode
        if self.compares_folder:
            output = [(path.name, hashlib.sha256(path.read_bytes()).hexdigest())
                      for path in sorted(scratch.glob("*.espl"))]
        return (started.returncode, output if self.compares_output or self.compares_folder else None,
                usage.ru_utime + usage.ru_stime)

    def prepare(self, folder):
        """False when it takes too long to be asked about every mutant, or says nothing with so few questions."""
        notes = folder / "reached" / hashlib.sha256(self.name.encode()).hexdigest()
        notes.parent.mkdir(exist_ok=True)
        notes.unlink(missing_ok=True)
        status, self.expected, self.seconds = self.run(folder / "scratch" / notes.name, math.ceil(LONGEST),
                                                       MUTANTS_REACHED=str(notes))
        too_slow = status in (-signal.SIGXCPU, -signal.SIGKILL) or self.seconds > LONGEST
        if not too_slow and (status < 0 or status >= 128):
            raise SystemExit(f"mutate.py: '{self.name}' crashes with no mutant at all")
        if status != 0 or too_slow:
            print(f"left out, {'too slow' if too_slow else 'red'}: {self.name}", flush=True)
            return False
        self.reached = {int(line) for line in notes.open()}
        return True

    def kills(self, number, scratch):
        status, output, _ = self.run(scratch, math.ceil(1 + 5 * self.seconds), MUTANT=str(number))
        if status in (-signal.SIGXCPU, -signal.SIGKILL):
            return "too slow"
        if status < 0 or status >= 128:
            return "crash"
        return "red" if status != 0 or output != self.expected else None


def claims_of(folder):
    programs = folder / "build" / "tests" / "mutation"
    small_programs = folder / "build_small_code" / "tests" / "mutation"
    blobs = folder / "blobs"
    shutil.rmtree(blobs, ignore_errors=True)
    blobs.mkdir()
    subprocess.run([programs / "mutant_blobs", blobs], check=True, stderr=subprocess.DEVNULL)
    files = sorted(blobs.glob("*.espl"), key=lambda path: path.name.encode())
    old = sorted((ROOT / "tests" / "format_versions").glob("*.espl"), key=lambda path: path.name.encode())
    claims = [Claim("the golden blobs", [programs / "mutant_blobs"], compares_folder=True)]
    for lanes in (1, 4):
        claims.append(Claim(f"kept blobs answer as they did, {lanes} lanes",
                            [programs / "mutant_answers", 20, *old], compares_output=True, lanes=lanes))
        for questions in QUESTIONS:
            claims.append(Claim(f"the golden answers, {questions} questions, {lanes} lanes",
                                [programs / "mutant_answers", questions, *files], compares_output=True, lanes=lanes))
    claims.append(Claim("kept blobs answer as they did, small code",
                        [small_programs / "mutant_answers", 20, *old], compares_output=True))
    for questions in QUESTIONS:
        claims.append(Claim(f"the golden answers, {questions} questions, small code",
                            [small_programs / "mutant_answers", questions, *files], compares_output=True))
    return claims + doctest_claims(programs, "") + doctest_claims(small_programs, ", small code")


def doctest_claims(programs, code):
    program = programs / "mutant_claims"
    listed = subprocess.run([program, "-ltc", "-nv"], stdout=subprocess.PIPE, text=True, check=True)
    names = [name for name in listed.stdout.splitlines() if not name.startswith(("[doctest]", "==="))]
    return [Claim(f"{name}, times {SCALE}{code}", [program, f"-tc={name}", "-aa=1", "-m"]) for name in names]


def key_of(mutant):
    return mutant["number"], mutant["version"], mutant["change"]


class Judge:
    def __init__(self, claims, scratch, earlier, hints, most, again):
        self.claims, self.scratch, self.earlier, self.hints = claims, scratch, earlier, hints
        self.most, self.again = most, again
        self.by_name = {claim.name: claim for claim in claims}
        self.asked, self.noticed = collections.Counter(), collections.Counter()  # by file and claim
        for result in earlier.values():
            if result["killed"] is not None:
                self.asked[result["file"], result["by"]] += 1
                self.noticed[result["file"], result["by"]] += 1

    def worth(self, file, claim):
        share = (self.noticed[file, claim.name] + 1) / (self.asked[file, claim.name] + 3)
        return share / (claim.seconds + 0.05)

    def __call__(self, mutant):
        """The mutant, the claim that noticed it and how, or the claims that did not."""
        number, file = mutant["number"], mutant["file"]
        scratch = self.scratch / f"{number}"
        met = list(self.earlier.get(key_of(mutant), {}).get("met", []))
        order = sorted(self.claims, key=lambda claim: -self.worth(file, claim))
        order.insert(0, self.by_name.get(self.hints.get((file, mutant["text"], mutant["change"]))))
        met_now = []
        for claim in order:
            if claim is None or claim.name in met_now or number not in claim.reached:
                continue
            if claim.name in met and not self.again:
                continue
            if len(met_now) == self.most:
                break
            how = claim.kills(number, scratch)
            shutil.rmtree(scratch, ignore_errors=True)
            self.asked[file, claim.name] += 1
            if how is not None:
                self.noticed[file, claim.name] += 1
                return {**mutant, "killed": how, "by": claim.name}
            met_now.append(claim.name)
        return {**mutant, "killed": None, "met": met + [name for name in met_now if name not in met]}


def earlier_results(path, mutants):
    """Of mutants that are as they were; and for those whose file changed, which claim noticed them."""
    kept, hints = {}, {}
    now = {key_of(mutant) for mutant in mutants}
    for line in path.open() if path.is_file() else []:
        result = json.loads(line)
        if result["killed"] is not None:
            hints[result["file"], result["text"], result["change"]] = result["by"]
        if key_of(result) in now:
            kept[key_of(result)] = result
    return kept, hints


def report(results):
    """How many mutants of each part had which outcome: how they were killed, or the kind of their excuse."""
    tally = collections.defaultdict(collections.Counter)
    for result in results:
        outcome = result["killed"] or (result["excuse"] or "not explained").split(":")[0]
        tally[result["part"]][outcome] += 1
        where = f"lib/{result['file']}:{result['line']}: {result['change']}    {result['text']}"
        if outcome == "not explained":
            print(f"{'survived' if result['met'] else 'no claim comes by'}: {where}")
        elif result["killed"] and result["excuse"]:
            print(f"excused in vain: {where}")
    for part, outcomes in tally.items():
        print(f"{part}: {sum(outcomes.values())} mutants: " + ", ".join(f"{n} {how}" for how, n in outcomes.items()))
    return tally


def chosen_mutants(mutants, asked):
    """Those of the parts and files that were named; all when none was."""
    files = {str(file).removeprefix("lib/") for file in asked.files}
    unknown = files - {mutant["file"] for mutant in mutants}
    if unknown:
        raise SystemExit(f"mutate.py: no mutants in {', '.join(sorted(unknown))}; instrument.py lists the files")
    if asked.since is not None:
        files |= changed_since(asked.since, {mutant["file"] for mutant in mutants})
    if not asked.parts and not asked.files and asked.since is None:
        return mutants
    return [mutant for mutant in mutants if mutant["part"] in asked.parts or mutant["file"] in files]


def changed_since(commit, files):
    """Those whose code differs from the commit's, comments and blanks aside."""
    if subprocess.run(["git", "rev-parse", "--quiet", "--verify", f"{commit}^{{commit}}"], cwd=ROOT,
                      stdout=subprocess.DEVNULL).returncode != 0:
        raise SystemExit(f"mutate.py: there is no commit '{commit}'")
    changed = set()
    for file in files:
        then = subprocess.run(["git", "show", f"{commit}:lib/{file}"], cwd=ROOT, capture_output=True, text=True)
        if version_of(then.stdout) != version_of((ROOT / "lib" / file).read_text()):
            changed.add(file)
    print(f"changed since {commit}: {', '.join(sorted(changed)) or 'nothing'}", flush=True)
    return changed


def check():
    missing = [claim for claim in CLAIMS if not (ROOT / "tests" / claim).exists()]
    if missing:
        raise SystemExit(f"mutate.py, CLAIMS: no such file in tests: {', '.join(missing)}")
    there = {str(path.relative_to(ROOT / "tests")) for path in (ROOT / "tests" / "runtime").rglob("*_test.cpp")}
    unlisted = there - LEFT_OUT.keys() - set(CLAIMS)
    if unlisted:
        raise SystemExit(f"mutate.py: neither in CLAIMS nor in LEFT_OUT: {', '.join(sorted(unlisted))}")
    needless = LEFT_OUT.keys() & set(CLAIMS) | LEFT_OUT.keys() - there
    if needless:
        raise SystemExit(f"mutate.py, LEFT_OUT: in CLAIMS, or no such file: {', '.join(sorted(needless))}")
    check_excuses(ROOT / "lib")


def main():
    if sys.argv[1:] == ["--check"]:
        return check()
    asked = argparse.ArgumentParser()
    asked.add_argument("build")
    asked.add_argument("parts", nargs="*")
    asked.add_argument("--files", nargs="+", default=[])
    asked.add_argument("--since")
    asked.add_argument("--publish", action="store_true")
    asked.add_argument("--survivors", action="store_true")
    asked.add_argument("--claims", nargs="+", default=[""])
    asked.add_argument("--most", type=int, default=1_000_000)
    asked = asked.parse_args()
    for part in asked.parts:
        if part not in PARTS:
            raise SystemExit(f"mutate.py: there is no part '{part}', only {', '.join(PARTS)}")
    folder = pathlib.Path(asked.build).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    mutants = write_sources(folder)
    chosen = chosen_mutants(mutants, asked)
    if not chosen:
        return 0
    build(folder, mutants)
    earlier, hints = earlier_results(folder / "results.jsonl", mutants)
    claims = [claim for claim in claims_of(folder) if any(text in claim.name for text in asked.claims)]
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        claims = [claim for claim, kept in zip(claims, pool.map(lambda claim: claim.prepare(folder), claims)) if kept]
    print(f"{len(claims)} claims, {sum(claim.seconds for claim in claims):.0f} seconds", flush=True)
    judge = Judge(claims, folder / "scratch", earlier, hints, asked.most, asked.claims != [""])
    pending = [mutant for mutant in chosen
               if (earlier[key_of(mutant)]["killed"] is None if key_of(mutant) in earlier else not asked.survivors)]
    pending.sort(key=lambda mutant: key_of(mutant) in earlier)
    # The file only grows: a later line overrules an earlier one.
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool, (folder / "results.jsonl").open("a") as kept:
        for job in concurrent.futures.as_completed([pool.submit(judge, mutant) for mutant in pending]):
            result = job.result()
            earlier[key_of(result)] = result
            kept.write(json.dumps(result) + "\n")
            kept.flush()
    # Where it is and its excuse are of now: a comment may have changed since it was run.
    done = [{**earlier[key_of(mutant)], **mutant} for mutant in chosen if key_of(mutant) in earlier]
    if len(done) < len(chosen):
        print(f"not run: {len(chosen) - len(done)}")
    tally = report(done)
    if asked.publish:
        publish(tally, collections.Counter(mutant["part"] for mutant in mutants))
    return 1 if len(done) < len(chosen) or any(outcomes["not explained"] for outcomes in tally.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
