"""What judges a mutant: each case of the ordinary programs of tests, the golden blobs and answers, and each replayed corpus.

The quick claims are those of `tools/dev test`: all cases at a small scale but those that tests/scales.txt leaves out of it,
a hundred questions, and the corpora. The others belong to parts of `tools/dev prove`: `cases`, the slow ones and each at its
full scale; `instruction_sets`, 2,000 questions; `small_code`, cases and as many questions for the code for microcontrollers.
"""
import fnmatch
import hashlib
import json
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import threading
import xml.etree.ElementTree

from programs import REPLAYED, ROOT, TESTS

LONGEST = float(os.environ.get("MUTATION_LONGEST_CLAIM", "2"))  # seconds of a processor
SCALE = os.environ.get("ESPALIER_TEST_SCALE", "0.05")  # enough for most mutants; survivors are worth more
QUESTIONS = [5, 100]  # of a kind and blob
MOST_QUESTIONS = 2000  # tests/platform/golden.txt has their answers
MOST_MEMORY = 4 << 30  # a loop that never ends may fill a list
QUICK = "quick"


class Claim:
    """One thing that must hold. What it prints, if anything is expected, is compared with what it prints unbroken."""
    def __init__(self, name, command, tier=QUICK, folder=None, scale=SCALE, compares_output=False, compares_folder=False,
                 lanes=1):
        self.name, self.command, self.tier, self.scale, self.lanes = name, command, tier, scale, lanes
        self.folder = folder  # of lib, which the folders of tests mirror
        self.compares_output, self.compares_folder = compares_output, compares_folder
        self.seconds, self.expected, self.reached = 0.0, None, set()
        self.prepared, self.preparing = None, threading.Lock()

    def run(self, scratch, limit, **environment):
        """Exit status, what is compared, and how many seconds of a processor it took; it is stopped at the limit."""
        # A mutant that crashes where doctest reports may wait for itself, which takes no processor's time. On a busy machine a
        # second of a processor may take a minute.
        command = ["timeout", "-s", "KILL", str(300 + 60 * limit), "prlimit", f"--cpu={limit}", f"--as={MOST_MEMORY}",
                   *(str(part) for part in self.command)]
        if self.compares_folder:
            shutil.rmtree(scratch, ignore_errors=True)
            scratch.mkdir(parents=True)
            command.append(str(scratch))
        started = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                   env=dict(os.environ, MUTANT_LANES=str(self.lanes), ESPALIER_TEST_SCALE=self.scale,
                                            ESPALIER_MESHES="none", **environment))
        output = started.stdout.read()
        _, status, usage = os.wait4(started.pid, 0)
        started.returncode = os.waitstatus_to_exitcode(status)
        if started.returncode > 128:  # as timeout tells the signal that ended the program
            started.returncode = 128 - started.returncode
        if self.compares_folder:
            output = b"".join(path.name.encode() + path.read_bytes() for path in sorted(scratch.glob("*.espl")))
        compared = hashlib.sha256(output).hexdigest() if self.compares_output or self.compares_folder else None
        return started.returncode, compared, usage.ru_utime + usage.ru_stime

    def prepare(self, folder, longest=LONGEST):
        """False when it takes too long to be asked about every mutant, or fails without one, as at a small scale."""
        with self.preparing:
            if self.prepared is None:
                self.prepared = self.run_unbroken(folder, longest)
            return self.prepared

    def run_unbroken(self, folder, longest):
        """What it found is kept, and holds until the program is built anew."""
        notes = folder / "reached" / hashlib.sha256(self.name.encode()).hexdigest()
        kept = notes.with_suffix(".json")
        notes.parent.mkdir(exist_ok=True)
        built = [str(part) for part in self.command] + [self.scale, os.stat(self.command[0]).st_mtime_ns, longest]
        known = json.loads(kept.read_text()) if kept.is_file() else {}
        if known.get("built") != built:
            notes.unlink(missing_ok=True)
            known = dict(zip(("status", "expected", "seconds"), self.run(
                folder / "scratch" / notes.name, math.ceil(longest), MUTANTS_REACHED=str(notes))), built=built)
            kept.write_text(json.dumps(known))
        status, self.expected, self.seconds = known["status"], known["expected"], known["seconds"]
        too_slow = status in (-signal.SIGXCPU, -signal.SIGKILL) or self.seconds > longest
        if status != 0 or too_slow:
            print(f"left out, {'too slow' if too_slow else f'status {status} with no mutant'}: {self.name}", flush=True)
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
    """The quick ones and the slow cases at the same scale, then those that a few questions about golden blobs are."""
    program, small_program = folder / "build", folder / "build_small_code"
    blobs = folder / "blobs"
    shutil.rmtree(blobs, ignore_errors=True)
    blobs.mkdir()
    subprocess.run([program / "tests/platform/espalier_make_blobs", blobs], check=True, stderr=subprocess.DEVNULL)
    claims = [Claim("the golden blobs", [program / "tests/platform/espalier_make_blobs"], compares_folder=True)]
    for lanes in (1, 4):
        claims += answer_claims(program, blobs, QUESTIONS, lanes, f"{lanes} lanes", QUICK)
    claims += answer_claims(small_program, blobs, QUESTIONS, 1, "small code", QUICK, kept=False)
    for subject in REPLAYED:
        claims.append(Claim(f"the corpus of {subject}", [program / "fuzz" / f"espalier_fuzz_{subject}",
                                                         folder / "source" / "fuzz" / "corpus" / subject]))
    for name in TESTS:
        claims += doctest_claims(program / "tests" / name, "", QUICK)
    return claims + doctest_claims(small_program / "tests/espalier_tests_runtime", ", small code", "small_code")


def full_claims_of(folder, quick):
    """What `tools/dev prove` adds to them. A case at full scale is asked about the mutants that it reaches at the small one."""
    claims = []
    for build, lanes, code, part in (("build", 1, "1 lanes", "instruction_sets"), ("build", 4, "4 lanes", "instruction_sets"),
                                     ("build_small_code", 1, "small code", "small_code")):
        claims += answer_claims(folder / build, folder / "blobs", [MOST_QUESTIONS], lanes, code, part, kept=False)
    for claim in quick:
        if claim.name.endswith(f", times {SCALE}"):
            full = Claim(claim.name.replace(f", times {SCALE}", ", times 1"), claim.command, "cases", claim.folder, "1")
            full.reached, full.seconds = claim.reached, claim.seconds / float(SCALE)
            claims.append(full)
    return claims


def answer_claims(build, blobs, questions, lanes, code, tier, kept=True):
    program = build / "tests/platform/espalier_query_answers"
    asked = [(f"the golden answers, {number} questions, {code}", number, blobs) for number in questions]
    if kept:
        asked.append((f"kept blobs answer as they did, {code}", 20, ROOT / "tests" / "format_versions"))
    return [Claim(name, [program, number, *sorted(folder.glob("*.espl"), key=lambda path: path.name.encode())], tier,
                  compares_output=True, lanes=lanes) for name, number, folder in asked]


def slow_cases():
    """The patterns of those that the quick tier leaves out."""
    lines = (ROOT / "tests" / "scales.txt").read_text()
    return re.findall(r"^quick 0 (.*)$", lines, re.MULTILINE)


def doctest_claims(program, code, tier):
    listed = subprocess.run([program, "--list-test-cases", "--reporters=xml"], stdout=subprocess.PIPE, text=True, check=True)
    slow, claims = slow_cases(), []
    small = (ROOT / "tests" / "small_code" / "CMakeLists.txt").read_text()
    for case in xml.etree.ElementTree.fromstring(listed.stdout).iter("TestCase"):
        name, file = case.get("name"), case.get("filename").split("/source/tests/")[-1]
        if tier == QUICK:
            part = "cases" if any(fnmatch.fnmatchcase(name, pattern) for pattern in slow) else QUICK
        else:  # of the other cases no part runs the code for microcontrollers
            part = tier if re.search(rf"\b{file.removesuffix('_test.cpp')}\b", small) else None
        claims.append(Claim(f"{name}, times {SCALE}{code}", [program, f"-tc={name}", "-aa=1", "-m"], part,
                            str(pathlib.Path(file).parent)))
    return claims
