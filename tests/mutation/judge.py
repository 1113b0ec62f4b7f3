"""Shows a mutant to the claims that come by it, first those that are likely to notice it for the time that they take."""
import collections
import json
import shutil


def key_of(mutant):
    return mutant["file"], mutant["version"], mutant["nth"], mutant["change"]


class Judge:
    """most: so many claims; seconds: as many claims as take so long. The number of claims that this leaves out is "unmet"."""
    def __init__(self, claims, folder, earlier, hints={}, most=1_000_000, again=False, seconds=1e9, longest=None):
        self.claims, self.folder, self.earlier, self.hints = claims, folder, earlier, hints
        self.most, self.again, self.seconds, self.longest = most, again, seconds, longest
        self.by_name = {claim.name: claim for claim in claims}
        self.asked, self.noticed = collections.Counter(), collections.Counter()  # by file or folder, and claim
        for result in earlier.values():
            if result["killed"] is not None:
                self.count(self.asked, result, result["by"])
                self.count(self.noticed, result, result["by"])

    @staticmethod
    def count(counter, mutant, name):
        counter[mutant["file"], name] += 1
        counter[mutant["file"].rpartition("/")[0], name] += 1

    def worth(self, mutant, claim):
        places = mutant["file"], mutant["file"].rpartition("/")[0]
        is_near = claim.folder is not None and f"{places[1]}/".startswith(f"{claim.folder}/")
        noticed = sum(self.noticed[place, claim.name] for place in places) + (3 if is_near else 1)
        return noticed / (sum(self.asked[place, claim.name] for place in places) + 3) / (claim.seconds + 0.05)

    def __call__(self, mutant):
        """The mutant, the claim that noticed it and how, or the claims that did not."""
        number = mutant["number"]
        scratch = self.folder / "scratch" / f"{number}"
        met = list(self.earlier.get(key_of(mutant), {}).get("met", []))
        order = sorted(self.claims, key=lambda claim: -self.worth(mutant, claim))
        order.insert(0, self.by_name.get(self.hints.get((mutant["file"], mutant["text"], mutant["change"]))))
        met_now, unmet, left = [], 0, self.seconds
        for claim in order:
            if claim is None or claim.name in met_now or number not in claim.reached:
                continue
            if claim.name in met and not self.again:
                continue
            if len(met_now) == self.most or claim.seconds > left:
                unmet += 1
                continue
            if self.longest is not None and not claim.prepare(self.folder, self.longest):
                continue
            how = claim.kills(number, scratch)
            shutil.rmtree(scratch, ignore_errors=True)
            left -= claim.seconds
            self.count(self.asked, mutant, claim.name)
            if how is not None:
                self.count(self.noticed, mutant, claim.name)
                return {**mutant, "killed": how, "by": claim.name, "tier": claim.tier}
            met_now.append(claim.name)
        return {**mutant, "killed": None, "met": met + [name for name in met_now if name not in met], "unmet": unmet}


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
