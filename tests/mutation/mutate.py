#!/usr/bin/env python3
"""mutate.py BUILD [PART...] [--files FILE...] [--since COMMIT] [--survivors] [--most N] [--claims TEXT...] [--publish]:
breaks the library in every way that instrument.py knows, one at a time, and prints what no claim noticed. PART is one of
those whose survivors must have an excuse, as verifier, decode, quantiser, traversal, rounding, small (what
microcontrollers have of their own), queries (what they do at nodes and leaves, batches), scenes (what opens them), ids
(the section of original ids, as the baker writes it), edges (the baker's table), moving (scenes whose instances move) or
deformation (meshes whose vertices move), or a folder of lib, as runtime/kernels: its files that are in none of those.
--files chooses the mutants of some files of lib, --since those of files whose code has changed since a commit; the parts
with excuses when nothing is chosen. Exit status 1 when a mutant of those survives that no comment in the code excuses
(excuses.py). --publish writes a row for each part that was run as a whole into the table of docs/testing.md.

mutate.py BUILD --sample N [--seed S] [--least SHARE] [--survivors] [--publish]: how many of the mutants that any test kills the quick
tests kill, of N drawn at random over lib (sample.py). Exit status 1 below the least share. --publish writes that table.

All mutants are compiled once, into the same programs, and again as small code (programs.py); they are chosen when a
program starts. A claim is one test, or a corpus, or a list of golden answers (claims.py). A first run of each without a mutant
notes how long it takes and the code of which mutants it executes; each mutant is then shown to those claims (judge.py), until one is red, crashes or takes far too long.

What was found is kept in BUILD/results.jsonl and holds as long as the mutant's file has the same code: a mutant
that was noticed is not asked about again, one that survived only by claims that it has not met. --survivors leaves out
all mutants that have not been run yet, and of a sample those that a quick claim has killed; --claims asks only those with
one of these texts in their names, also where the mutant has met them, since they may have changed; --most asks so many of
each mutant, and leaves the others for another run.
"""
import argparse
import collections
import json
import pathlib
import subprocess
import sys

import sample
from claims import LONGEST, claims_of
from instrument import EXCUSED_PARTS, version_of
from judge import Judge, earlier_results, key_of
from programs import ROOT, build, write_sources
from published import publish, publish_sample

LEAST_SHARE = 0.97  # of the mutants that any test kills, by the quick ones


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
    """Those of the parts and files that were named; those with excuses when none was."""
    files = {str(file).removeprefix("lib/") for file in asked.files}
    unknown = files - {mutant["file"] for mutant in mutants}
    if unknown:
        raise SystemExit(f"mutate.py: no mutants in {', '.join(sorted(unknown))}; instrument.py lists the files")
    if asked.since is not None:
        files |= changed_since(asked.since, {mutant["file"] for mutant in mutants})
    if not asked.parts and not asked.files and asked.since is None:
        return [mutant for mutant in mutants if mutant["part"] in EXCUSED_PARTS]
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


def judged(folder, mutants, chosen, asked):
    """What is known of the chosen ones, after each has met what it had not."""
    path = folder / "results.jsonl"
    earlier, hints = earlier_results(path, mutants)
    claims = [claim for claim in claims_of(folder) if any(text in claim.name for text in asked.claims)]
    claims = sample.prepared(claims, folder, LONGEST)
    print(f"{len(claims)} claims, {sum(claim.seconds for claim in claims):.0f} seconds", flush=True)
    judge = Judge(claims, folder, earlier, hints, asked.most, asked.claims != [""])
    pending = [mutant for mutant in chosen
               if (earlier[key_of(mutant)]["killed"] is None if key_of(mutant) in earlier else not asked.survivors)]
    pending.sort(key=lambda mutant: key_of(mutant) in earlier)
    sample.run(judge, pending, earlier, path)
    # Where it is and its excuse are of now: a comment may have changed since it was run.
    return [{**earlier[key_of(mutant)], **mutant} for mutant in chosen if key_of(mutant) in earlier]


def main():
    asked = argparse.ArgumentParser()
    asked.add_argument("build")
    asked.add_argument("parts", nargs="*")
    asked.add_argument("--files", nargs="+", default=[])
    asked.add_argument("--since")
    asked.add_argument("--publish", action="store_true")
    asked.add_argument("--survivors", action="store_true")
    asked.add_argument("--claims", nargs="+", default=[""])
    asked.add_argument("--most", type=int, default=1_000_000)
    asked.add_argument("--sample", type=int)
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument("--least", type=float, default=LEAST_SHARE)
    asked = asked.parse_args()
    if asked.sample is not None and (asked.parts or asked.files or asked.since):
        raise SystemExit("mutate.py: --sample draws from the whole library; leave out the parts, --files and --since")
    folder = pathlib.Path(asked.build).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    mutants = write_sources(folder)
    counts = collections.Counter(mutant["part"] for mutant in mutants)
    for part in asked.parts:
        if part not in counts:
            raise SystemExit(f"mutate.py: there is no part '{part}', only {', '.join(counts)}")
    if asked.sample is not None:
        build(folder, mutants)
        results = sample.sample(folder, mutants, claims_of(folder), asked.sample, asked.seed, asked.survivors)
        share = sample.report(results)
        if asked.publish:
            publish_sample(results, asked.seed)
        return 0 if share >= asked.least else 1
    chosen = chosen_mutants(mutants, asked)
    if not chosen:
        return 0
    build(folder, mutants)
    done = judged(folder, mutants, chosen, asked)
    if len(done) < len(chosen):
        print(f"not run: {len(chosen) - len(done)}")
    tally = report(done)
    if asked.publish:
        publish(tally, counts)
    unexplained = any(outcomes["not explained"] for part, outcomes in tally.items() if part in EXCUSED_PARTS)
    return 1 if len(done) < len(chosen) or unexplained else 0


if __name__ == "__main__":
    sys.exit(main())
