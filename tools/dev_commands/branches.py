"""branches.py EXPORT FOLDER=PERCENT...: reads what `llvm-cov export` wrote and prints for each file of the first folder how many of the
outcomes of its conditions were taken, and which were not. Exit status 1 where a folder has a smaller share.

An outcome counts once, in however many templates, inlined copies and programs its condition is compiled. A line with the comment
"not counted" is left out.
"""
import collections
import json
import pathlib
import sys

export, *limits = sys.argv[1:]
outcomes = collections.defaultdict(lambda: [0, 0])
for function in json.load(open(export))["data"][0]["functions"]:
    for line, column, _, _, if_true, if_false, file, *_ in function["branches"]:
        taken = outcomes[pathlib.Path(function["filenames"][file]).resolve(), line, column]
        taken[0] += if_true
        taken[1] += if_false

files = collections.defaultdict(list)
for (path, line, column), taken in sorted(outcomes.items()):
    path = path.relative_to(pathlib.Path.cwd()) if path.is_relative_to(pathlib.Path.cwd()) else path
    if "// not counted" not in path.read_text().split("\n")[line - 1]:
        files[str(path)] += [(count > 0, f"{line}:{column} {'false' if nth else 'true'}") for nth, count in enumerate(taken)]

failed = False
for number, limit in enumerate(limits):
    folder, least = limit.split("=")
    counted = {file: taken for file, taken in files.items() if file.startswith(folder)}
    for file, taken in counted.items() if number == 0 else ():
        missing = [place for is_taken, place in taken if not is_taken]
        print(f"{len(taken) - len(missing):5} of {len(taken):5}  {file}  {', '.join(missing)}")
    every = [is_taken for taken in counted.values() for is_taken, _ in taken]
    share = 100 * sum(every) / len(every)
    print(f"TOTAL {folder}: {sum(every)} of {len(every)}, {share:.1f} %")
    failed = failed or share < float(least)
sys.exit(1 if failed else 0)
