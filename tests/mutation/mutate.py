#!/usr/bin/env python3
"""mutate.py BUILD [PART...]: breaks the library in every way that instrument.py knows, one at a time, and prints what no
claim noticed. PART is verifier, decode, quantiser or traversal; all of them when none is named.

All mutants are compiled once, into the same programs, and chosen when a program starts. A first run of every claim
without any notes how long it takes and by which mutants it comes; each mutant is then shown to the claims that come by
it, the quickest first, until one is red, crashes or takes far too long.
"""
import collections
import concurrent.futures
import filecmp
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
JOBS = int(os.environ.get("MUTATION_JOBS", os.cpu_count() or 1))

# Claims by file. Those of files and query answers are asked too: tests/platform.
CLAIMS = ["runtime/open_test.cpp", "runtime/open_rules_test.cpp", "runtime/weird_blob_test.cpp",
          "runtime/hostile_test.cpp", "runtime/statistics_test.cpp", "runtime/traversal_test.cpp",
          "runtime/lattice_ray_test.cpp", "baker/lattice_test.cpp", "baker/tree_test.cpp", "baker/strip_test.cpp",
          "baker/bounds_test.cpp", "baker/error_test.cpp", "baker/spatial_test.cpp", "runtime/identity_test.cpp"]
QUESTIONS = [5, 100]  # of a kind and blob
LONGEST = float(os.environ.get("MUTATION_LONGEST_CLAIM", "12"))  # seconds


def build(folder):
    """The programs with all mutants in them, and the list of mutants."""
    source, fresh = folder / "source", folder / "fresh"
    shutil.rmtree(fresh, ignore_errors=True)
    fresh.mkdir(parents=True)
    shutil.copy(ROOT / "CMakeLists.txt", fresh)
    shutil.copytree(ROOT / "tests", fresh / "tests")
    shutil.copytree(ROOT / "lib", fresh / "lib")
    with open(fresh / "CMakeLists.txt", "a") as top:
        top.write("add_subdirectory(tests/mutation)\n")
    subprocess.run([sys.executable, HERE / "instrument.py", ROOT / "lib", fresh / "lib", folder / "mutants.jsonl"],
                   check=True)
    # Lanes of one: what is mutated is what all instruction sets have in common. The others are held to its bits.
    for part in (fresh / "lib", fresh / "tests" / "support"):
        for path in part.rglob("*.[chi][pn][pl]"):
            text = path.read_text()
            if re.search(r"__x86_64__|__i386__", text):
                path.write_text(re.sub(r"defined\(__(x86_64|i386)__\)", "0", text))
    # Only what changed is touched, and compiled again.
    for path in fresh.rglob("*"):
        old = source / path.relative_to(fresh)
        if path.is_file() and not (old.is_file() and filecmp.cmp(path, old, shallow=False)):
            old.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, old)
    mutants = [json.loads(line) for line in (folder / "mutants.jsonl").open()]
    flags = f"-std=c++20 -O1 -w -include {source}/tests/mutation/mutants.hpp"
    subprocess.run(["cmake", "-S", source, "-B", folder / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                    "-DESPALIER_TESTS=OFF", "-DESPALIER_TOOLS=OFF", "-DESPALIER_BENCH=OFF",
                    f"-DCMAKE_CXX_FLAGS={flags}", f"-DMUTANT_COUNT={len(mutants)}",
                    f"-DMUTANT_CLAIMS={';'.join(CLAIMS)}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder / "build", "--target", "mutant_blobs", "mutant_answers",
                    "mutant_claims"], check=True, stdout=subprocess.DEVNULL)
    return mutants


class Claim:
    """One thing that must hold. What it prints, if anything is expected, is compared with what it prints unbroken."""
    def __init__(self, name, command, compares_output=False, compares_folder=False):
        self.name, self.command = name, command
        self.compares_output, self.compares_folder = compares_output, compares_folder
        self.seconds, self.expected, self.reached = 0.0, None, set()

    def run(self, scratch, limit, **environment):
        """Exit status and what is compared; None instead of a status when it took too long."""
        command = [str(part) for part in self.command]
        if self.compares_folder:
            shutil.rmtree(scratch, ignore_errors=True)
            scratch.mkdir(parents=True)
            command.append(str(scratch))
        try:
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=limit,
                                  env=dict(os.environ, **environment))
        except subprocess.TimeoutExpired:
            return None, None
        if self.compares_output:
            return done.returncode, done.stdout
        if self.compares_folder:
            return done.returncode, [(path.name, hashlib.sha256(path.read_bytes()).hexdigest())
                                     for path in sorted(scratch.glob("*.espl"))]
        return done.returncode, None

    def prepare(self, folder):
        """False when it takes too long to be asked about every mutant."""
        notes = folder / "reached" / hashlib.sha256(self.name.encode()).hexdigest()
        notes.parent.mkdir(exist_ok=True)
        notes.unlink(missing_ok=True)
        start = time.monotonic()
        status, self.expected = self.run(folder / "scratch" / notes.name, LONGEST, MUTANTS_REACHED=str(notes))
        self.seconds = time.monotonic() - start
        if status is None:
            print(f"left out, too slow: {self.name}", flush=True)
            return False
        if status != 0:
            raise SystemExit(f"mutate.py: '{self.name}' is red with no mutant at all")
        self.reached = {int(line) for line in notes.open()}
        return True

    def kills(self, number, scratch):
        status, output = self.run(scratch, 3 + 5 * self.seconds, MUTANT=str(number))
        if status is None:
            return "too slow"
        if status < 0 or status >= 128:
            return "crash"
        return "red" if status != 0 or output != self.expected else None


def claims_of(folder):
    programs = folder / "build" / "tests" / "mutation"
    blobs = folder / "blobs"
    shutil.rmtree(blobs, ignore_errors=True)
    blobs.mkdir()
    subprocess.run([programs / "mutant_blobs", blobs], check=True, stderr=subprocess.DEVNULL)
    files = sorted(blobs.glob("*.espl"), key=lambda path: path.name.encode())
    old = sorted((ROOT / "tests" / "format_versions").glob("*.espl"), key=lambda path: path.name.encode())
    claims = [Claim("the golden blobs", [programs / "mutant_blobs"], compares_folder=True),
              Claim("blobs of old versions answer as they did", [programs / "mutant_answers", 20, *old], True)]
    for questions in QUESTIONS:
        claims.append(Claim(f"the golden answers, {questions} questions",
                            [programs / "mutant_answers", questions, *files], compares_output=True))
    listed = subprocess.run([programs / "mutant_claims", "-ltc", "-nv"], stdout=subprocess.PIPE, text=True, check=True)
    for name in listed.stdout.splitlines():
        if name.startswith("[doctest]") or name.startswith("==="):
            continue
        pattern = name.replace("\\", "\\\\").replace(",", "\\,")
        claims.append(Claim(name, [programs / "mutant_claims", f"-tc={pattern}", "-aa=1", "-m"]))
    return claims


def judge(number, mutant, claims, scratch):
    """The claim that noticed the mutant and how; None when no claim did."""
    came_by = [claim for claim in claims if number in claim.reached]
    for claim in sorted(came_by, key=lambda claim: claim.seconds):
        how = claim.kills(number, scratch / f"{number}")
        shutil.rmtree(scratch / f"{number}", ignore_errors=True)
        if how is not None:
            return {**mutant, "number": number, "killed": how, "by": claim.name}
    return {**mutant, "number": number, "killed": None, "claims": len(came_by)}


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    parts = sys.argv[2:]
    folder.mkdir(parents=True, exist_ok=True)
    mutants = build(folder)
    claims = claims_of(folder)
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        claims = [claim for claim, kept in zip(claims, pool.map(lambda claim: claim.prepare(folder), claims)) if kept]
    print(f"{len(claims)} claims, {sum(claim.seconds for claim in claims):.0f} seconds", flush=True)
    chosen = [(number, mutant) for number, mutant in enumerate(mutants) if not parts or mutant["part"] in parts]
    tally = collections.defaultdict(collections.Counter)
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool, (folder / "results.jsonl").open("w") as results:
        jobs = [pool.submit(judge, number, mutant, claims, folder / "scratch") for number, mutant in chosen]
        for job in concurrent.futures.as_completed(jobs):
            result = job.result()
            results.write(json.dumps(result) + "\n")
            results.flush()
            outcome = result["killed"] or ("survived" if result["claims"] else "no claim comes by")
            tally[result["part"]][outcome] += 1
            if result["killed"] is None:
                print(f"{outcome}: {result['file']}:{result['line']}: {result['change']}    {result['text']}", flush=True)
    for part, outcomes in tally.items():
        print(f"{part}: {sum(outcomes.values())} mutants: " + ", ".join(f"{n} {how}" for how, n in outcomes.items()))


if __name__ == "__main__":
    main()
