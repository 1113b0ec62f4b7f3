"""mutate.py BUILD --sample N [--seed S]: how many of the mutants that any test kills the quick tests kill.

Draws N mutants at random over the library. A smaller sample of the same seed is the beginning of a larger one, and a change of
one file leaves what is drawn of the others as it is.
Each meets the quick claims (claims.py); one that survives them meets the others. A mutant that no claim kills, and one
that a comment excuses, says nothing about the tiers: the base is what any claim kills. BUILD/sample_SEED.jsonl keeps the results,
and holds what it says until the mutant's file changes or the test that killed it is gone; --survivors runs the others again.
"""
import collections
import concurrent.futures
import hashlib
import json
import os

from claims import QUICK, full_claims_of
from judge import Judge, earlier_results, key_of
from programs import JOBS

LONGEST_QUICK = 20  # seconds of a processor, for a case
WHOLE_SECONDS = float(os.environ.get("MUTATION_WHOLE_SECONDS", "120"))  # for all other claims about one mutant


def drawn(mutants, count, seed):
    """By a hash of each one's place in its file."""
    def rank(mutant):
        return hashlib.sha256(f"{seed} {mutant['file']} {mutant['nth']} {mutant['change']}".encode()).digest()
    return sorted(mutants, key=rank)[:count]


def prepared(claims, folder, longest):
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        kept = list(pool.map(lambda claim: claim.prepare(folder, longest), claims))
    return [claim for claim, is_kept in zip(claims, kept) if is_kept]


def run(judge, mutants, earlier, path):
    """What is found is in the file at once, in case the command is ended; a later line overrules an earlier one."""
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool, path.open("a") as kept:
        for job in concurrent.futures.as_completed([pool.submit(judge, mutant) for mutant in mutants]):
            result = job.result()
            earlier[key_of(result)] = result
            kept.write(json.dumps(result) + "\n")
            kept.flush()


def sample(folder, mutants, claims, count, seed, again=False):
    """The results of the sample, each with its "outcome": quick, the part that alone kills it, none or excused."""
    path, chosen = folder / f"sample_{seed}.jsonl", drawn(mutants, count, seed)
    earlier, _ = earlier_results(path, mutants)
    if again:
        earlier = {key: result for key, result in earlier.items() if result["killed"] and result["tier"] == QUICK}
    # A test that is no longer there kills nothing.
    known = {claim.name for claim in claims + full_claims_of(folder, claims)}
    earlier = {key: result for key, result in earlier.items() if not result["killed"] or result["by"] in known}
    judged = [mutant for mutant in chosen if mutant["excuse"] is None]
    pending = [mutant for mutant in judged if key_of(mutant) not in earlier]
    if pending or any(waits(earlier[key_of(mutant)]) for mutant in judged):
        quick = prepared([claim for claim in claims if claim.tier == QUICK], folder, LONGEST_QUICK)
        print(f"{len(quick)} quick claims, {sum(claim.seconds for claim in quick):.0f} seconds", flush=True)
        run(Judge(quick, folder, earlier), pending, earlier, path)
        survivors = [mutant for mutant in judged if waits(earlier[key_of(mutant)])]
        print(f"{len(survivors)} survive the quick claims", flush=True)
        whole = prepared([claim for claim in claims if claim.tier not in (QUICK, None)], folder, WHOLE_SECONDS)
        whole += full_claims_of(folder, quick)
        judge = Judge(whole, folder, earlier, seconds=WHOLE_SECONDS, longest=WHOLE_SECONDS)
        run(lambda mutant: {**judge(mutant), "whole": True}, survivors, earlier, path)
    return [{**earlier.get(key_of(mutant), {}), **mutant, "outcome": outcome(mutant, earlier)} for mutant in chosen]


def waits(result):
    """For the claims that are not quick."""
    return result["killed"] is None and "whole" not in result


def outcome(mutant, earlier):
    if mutant["excuse"] is not None:
        return "excused"
    result = earlier[key_of(mutant)]
    return "none" if result["killed"] is None else result["tier"]


def report(results):
    """The share of the mutants that any claim kills which the quick ones kill."""
    for result in results:
        where = f"lib/{result['file']}:{result['line']}: {result['change']}    {result['text']}"
        if result["outcome"] == "none":
            unmet = f" ({result['unmet']} claims not asked, for their time)" if result["unmet"] else ""
            print(f"survived{unmet}: {where}")
        elif result["outcome"] not in (QUICK, "excused"):
            print(f"only {result['outcome']}, {result['killed']} by '{result['by']}': {where}")
    tally = collections.Counter(result["outcome"] for result in results)
    killed = len(results) - tally["none"] - tally["excused"]
    print(f"{len(results)} mutants: " + ", ".join(f"{number} {outcome}" for outcome, number in tally.most_common()))
    share = tally[QUICK] / max(killed, 1)
    print(f"the quick tests kill {tally[QUICK]} of {killed}, {100 * share:.1f} %")
    return share
