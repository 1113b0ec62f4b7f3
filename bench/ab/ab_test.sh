#!/usr/bin/env bash
# ab_test.sh PROGRAM SIDE: runs the program on one shared object as both sides and checks every row. No speed is checked.
set -euo pipefail
program=$1 side=$2

fail() {
    echo "$*" >&2
    exit 1
}

rows=$("$program" --base "$side" --other "$side" --base-name one --other-name two \
    --seconds 0.02 --slice 0.01 --loads 2 torus)
printf '%s\n' "$rows"
for profile in fast balanced small tiny; do
    for questions in closest_hit_incoherent closest_hit_coherent any_hit_incoherent closest_hit_batch_incoherent \
        closest_hit_batch_coherent any_hit_batch_incoherent closest_point overlaps_sphere all_overlaps_sphere overlaps_box \
        all_overlaps_box overlaps_{capsule,oriented_box}{,_touching} contacts_{sphere,capsule,oriented_box} \
        sweep_sphere sweep_capsule sweep_box \
        sweep_{sphere,capsule,box}_{short,long} collides all_contacts minimum_distance open; do
        row=$(grep "\"profile\":\"$profile\"" <<<"$rows" | grep "\"questions\":\"$questions\"") ||
            fail "no row for $questions in $profile"
        grep -q '"differing":0}' <<<"$row" || fail "different answers: $row"
        grep -q '"found":[1-9]' <<<"$row" || fail "nothing found: $row"
        grep -Eq '"ratio":[0-9]+\.[0-9]+,"ratio_low":[0-9]+\.[0-9]+,"ratio_high":[0-9]+\.[0-9]+' <<<"$row" ||
            fail "no ratio: $row"
        grep -q '"same_bytes":true' <<<"$row" || fail "two bakes of one mesh differ: $row"
    done
done
[[ $(wc -l <<<"$rows") -eq 124 ]] || fail "other rows than those expected"

# The table, in another instruction set; and a file that is no side.
table=$("$program" --base "$side" --other "$side" --profile fast --questions closest_point --seconds 0.02 --slice 0.01 --loads 1 \
    --set scalar torus | "$(dirname "${BASH_SOURCE[0]}")/../rows.py" mesh triangles profile instruction_set -- questions ratio)
grep -q 'mesh torus; triangles 60000; profile fast; instruction_set scalar' <<<"$table" || fail "no heading: $table"
grep -Eq '^closest_point +[0-9.]+$' <<<"$table" || fail "no ratio: $table"
# The 99th percentile is at least the median.
slow=$("$program" --base "$side" --other "$side" --profile fast --questions sweep_box_short --seconds 0.02 --slice 0.01 --loads 1 \
    --slow-cases 200 torus)
awk -F '[:,}]' '{ for (i = 1; i < NF; ++i) { if ($i ~ /other_median_ns/) median = $(i + 1); if ($i ~ /other_percentile_99_ns/) slow = $(i + 1) } }
    END { exit !(0 < median && median + 0 <= slow + 0) }' <<<"$slow" || fail "no slow cases: $slow"
if "$program" --base "$side" --other "$program" torus 2>/dev/null; then fail "a program was taken for a side"; fi
