#!/usr/bin/env bash
# names.sh CTEST BUILD_FOLDER: each test name is `area: behaviour` with an area of tests/README.md, in plain words and without
# commas, and names one test; each pattern of tests/scales.txt selects a test, and `tools/dev prove` runs each label of its parts.
set -euo pipefail
ctest=$1 build=$(realpath "$2")
cd "$(dirname "${BASH_SOURCE[0]}")"
failures=0
complain() {
    echo "$*"
    failures=$((failures + 1))
}

mapfile -t areas < <(sed -nE 's/^\| `([a-z ]+)` \|.*/\1/p' README.md)
declare -A is_area
for area in "${areas[@]}"; do is_area[$area]=1; done
# From the sources, since some tests exist in some builds only.
mapfile -t cases < <(grep -rhoE --include='*.[ch]pp' 'TEST_CASE[A-Z_]*\(.*' . | sed -E 's/^[A-Z_]*\("([^"]*)".*/\1/')
# The others. A program that was not built has no names yet.
mapfile -t others < <("$ctest" --test-dir "$build" --show-only |
    sed -nE 's/ \(Disabled\)$//; s/^ *Test +#[0-9]+: //p' | grep -vE '^[a-z_]+_(NOT_BUILT|is_built)(-|$)')
[[ ${#areas[@]} -gt 0 && ${#cases[@]} -gt 0 && ${#others[@]} -gt 0 ]] || complain "no areas, no test cases or no tests in $build"

for name in "${cases[@]}" "${others[@]}"; do
    [[ $name =~ ^[a-z\ ]+:\ [A-Za-z0-9_.+^\ -]+$ ]] || complain "not 'area: behaviour' in plain words without commas: $name"
    area=${name%%:*}
    [[ -v is_area[$area] ]] || complain "no area of tests/README.md: $name"
done
while read -r name; do complain "two tests have one name: $name"; done < <(printf '%s\n' "${cases[@]}" | sort | uniq -d)

while read -r command factor pattern; do
    selected=0
    for name in "${cases[@]}"; do
        # shellcheck disable=SC2053  # a pattern
        [[ $name != $pattern ]] || selected=$((selected + 1))
    done
    [[ $selected -gt 0 ]] || complain "tests/scales.txt: '$command $factor $pattern' selects no test"
done < <(sed -E '/^(#|$)/d' scales.txt)

while read -r label; do
    grep -q "prove_labelled ${label#prove_}\b" ../tools/dev_commands/prove.sh || complain "no part of tools/dev prove runs the label $label"
done < <("$ctest" --test-dir "$build" --print-labels | sed -n 's/^ *\(prove_\)/\1/p')

[[ $failures -eq 0 ]]
