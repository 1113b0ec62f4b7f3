#!/usr/bin/env bash
# Tests of `espalier query` with spheres and other volumes, distances, sweeps and accuracies.
# Usage: query_shapes_test.sh PATH_TO_ESPALIER
# shellcheck source=query_blobs.sh
. "$(dirname "$0")/query_blobs.sh"

claim "a sphere lists what it touches, in storage order"
prints "12 triangles" query box.espl sphere 0.5 1 1.5 100
prints "0 triangles" query box.espl sphere 0.5 1 1.5 0.4
prints "overlaps" query box.espl sphere 0.5 1 1.5 0.5 --any
prints '"overlaps": false' query box.espl sphere -1 -1 -1 1 --any --json

claim "closest-point finds point and distance, or nothing beyond the limit"
prints "distance 2" query box.espl closest-point 0.25 1 5
out_has "point 0.25 1 3"
prints "nothing within" query box.espl closest-point 0.25 1 5 --max-distance 1.5
prints '"distance": 2.0' query box.espl closest-point 0.25 1 5 --json

claim "every volume lists the triangles that it touches"
counts() { # COUNT WORDS...
    local count=$1
    shift
    prints "$count triangle" query box.espl "$@"
    run 0 query box.espl "$@" --any --json
    [ "$count" = 0 ] && json '.overlaps == false' || json '.overlaps'
}
counts 2 sphere 0.5 1 -1 1
counts 0 sphere 0.5 1 -1 0.99
counts 2 capsule 0.2 1 5 0.8 1 5 2
counts 0 capsule 0.2 1 5 0.8 1 5 1.9
counts 2 box 0.2 0.2 -1 0.8 1.8 0
counts 0 box 0.2 0.2 1 0.8 1.8 2
counts 12 box -inf -inf -inf inf inf inf
counts 0 box 1 1 1 0 0 0
counts 2 oriented-box 0.5 1 4 0 0 1 0.2 0.2 0 0.2 -0.2 0
counts 0 oriented-box 0.5 1 4 0 0 0.9 0.2 0.2 0 0.2 -0.2 0
counts 2 cone 0.5 1 5 0 0 -2 0.1
counts 0 cone 0.5 1 5 0 0 -1.9 0.1
counts 1 triangle 0.6 0.2 3 0.9 0.3 3 0.9 0.2 4
counts 0 triangle 0.6 0.2 1 0.9 0.3 1 0.9 0.2 2
counts 10 convex-volume 0 0 1 0 # the bottom, and what ends at it
counts 0 convex-volume 0 0 1 -0.1
counts 8 convex-volume 1 0 0 0.5 -1 0 0 -0.5

claim "pages of what a volume touches make up the whole"
run 0 query sheet.espl sphere 20 0 20 9 --json
cp out whole
from=0
: >pages
for _ in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    run 0 query sheet.espl sphere 20 0 20 9 --limit 77 --from "$from"
    grep '^triangle' out >>pages
    from=$(sed -n 's/.*and there are more: --from \([0-9]*\) goes on/\1/p' out)
    [ -n "$from" ] || break
done
run 0 query sheet.espl sphere 20 0 20 9
grep '^triangle' out | cmp -s - pages || fail "the pages are not the whole"
[ "$(wc -l <pages)" -gt 200 ] || fail "only $(wc -l <pages) triangles: nothing is tested"
finds '.status == "output_full" and .count == 3 and .next > 2' query sheet.espl sphere 20 0 20 9 --limit 3
prints "and there are more: --from" query sheet.espl sphere 20 0 20 9 --limit 0
run 1 query sheet.espl sphere 20 0 20 9 --limit 3 --any
run 1 query sheet.espl sphere 20 0 20 9 --limit -3

claim "the nearest triangles come sorted"
run 0 query box.espl closest-point 0.25 1 5 --first 3 --json
json '.count == 3 and .triangles[0].distance == 2 and .triangles[1].distance >= 2 and .triangles[2].distance >= .triangles[1].distance'
finds '.count == 12' query box.espl closest-point 0.25 1 5 --first 100
finds '.count == 0' query box.espl closest-point 0.25 1 5 --first 100 --max-distance 0.5

claim "segments and boxes have a closest pair of points"
run 0 query box.espl closest-point-segment 0.25 1 5 0.75 1 4 --json
json '.found and .distance == 1 and .on_shape == [0.75, 1, 4] and .point == [0.75, 1, 3] and .feature == "face" and .face_normal == [0, 0, 1] and .side == "front"'
prints "distance 0" query box.espl closest-point-segment 0.2 1 5 0.2 1 2
finds '.distance == 2 and .on_shape[0] == 3 and .point[0] == 1 and .face_normal == [1, 0, 0]' query box.espl closest-point-box 3 0 0 4 1 1
prints "nothing within" query box.espl closest-point-box 3 0 0 4 1 1 --max-distance 1900mm
finds '.status == "ok" and .found == false' query box.espl closest-point-box 4 1 1 3 0 0

claim "moving shapes stop at the first contact, and say when they start in one"
near() { json ".t <= $1 and .t > $1 - 0.0000002"; }
finds '.hit and .starts_overlapping == false and .normal == [0, 0, 1] and .face_normal == [0, 0, 1]' query box.espl sweep-sphere 0.5 1 6 1 0 0 -4
near 0.5
run 0 query box.espl sweep-capsule 0.5 1 6 0.6 1 7 1 0 0 -4 --json
near 0.5
run 0 query box.espl sweep-box 0.2 0.8 5 0.4 1.2 6 0mm 0 -8 --json
near 0.25
json '.normal == [0, 0, 1]'
run 0 query box.espl sweep-oriented-box 0.5 1 5 0 0 1 0.2 0.2 0 0.2 -0.2 0 0 0 -2 --json
near 0.5
run 0 query box.espl sweep-hull 0 0 -4 0.5 1 5 0.4 1 6 0.6 1 6 0.5 1.2 6 --json
near 0.5
json '.normal == [0, 0, 1]'
prints "no contact" query box.espl sweep-hull 0 0 -4
refuses 1 "displacement x y z, vertex x y z; the last any number of times" query box.espl sweep-hull 0 0 -4 1
prints "starts_overlapping yes" query box.espl sweep-sphere 0.5 1 3 1 0 0 0 # no displacement: whether it touches
prints "no contact" query box.espl sweep-sphere 0.5 1 6 1 0 0 -1.9
finds '.t == 0 and .starts_overlapping' query box.espl sweep-sphere 0.5 1 3 1 0 0 1
finds '.status == "ok" and .hit == false' query box.espl sweep-sphere 0.5 1 3.5 1 0 0 1 --ignore-leaving
run 0 query box.espl sweep-sphere 0.5 1 6 1 0 0 -4 --skin 0.5 --json
json '.t <= 0.375 and .t > 0.374999 and (.feature | startswith("edge"))'  # the middle of the top is on a diagonal
prints "no contact" query box.espl sweep-sphere 0.5 1 6 1 0 0 4 --culling back
run 6 query box.espl sweep-sphere 0.5 1 6 1 0 0 -4 --skin -1
fails 6 '.status == "invalid_argument" and (has("hit") | not)' query box.espl sweep-sphere 0.5 1 3 -1 0 0 1
refuses 6 "too far away or too large" query box.espl sweep-box 0 0 0 1 1 1 0 0 1e30
run 1 query box.espl sweep-box 0 0 0 1 1 1 0 0

claim "inside and outside have a sign"
prints "inside" query box.espl contains 0.5 1 1.5
finds '.inside == false' query box.espl contains 0.5 1 3.5
finds '.winding == 1' query box.espl winding-number 0.5 1 1.5 16
finds '.winding == 0' query box.espl winding-number 0.5 1 3.5 16
refuses 6 "query winding-number: directions is 1; it must be from 2 to 4096." query box.espl winding-number 0.5 1 3.5 1
finds '.found and .distance == -0.25 and .point == [0.5, 1, 3] and .on_shape == null and .side == "back"' query box.espl signed-distance 0.5 1 2.75
finds '.distance == 0.25' query box.espl signed-distance 0.5 1 3.25
finds '.found == false and .distance == -0.125' query box.espl signed-distance 0.5 1 1.5 --max-distance 0.125

claim "an accuracy makes answers that err on the safe side, and tells what they cost"
finds '(.may_overlap | type) == "boolean" and .nodes_visited > 0' query sheet.espl sphere 20 0 20 0.5 --accuracy 0
exact=$(sed -n 's/.*"may_overlap": \(.*\),/\1/p' out)
finds ".overlaps == $exact" query sheet.espl sphere 20 0 20 0.5 --any
prints "may overlap" query box.espl box 0.2 0.2 1 0.8 1.8 2 --accuracy 10m
prints "does not overlap" query box.espl box 9 9 9 10 10 10 --accuracy 1
prints "may be occluded" query box.espl ray 0.25 1.5 10 0 0 -1 --accuracy 1mm
prints "not occluded" query box.espl segment 0.25 1.5 10 0.25 1.5 9 --accuracy 1mm
finds '.found and .lower <= 2 and .upper >= 2 and .upper - .lower < 0.174' query box.espl closest-point 0.25 1 5 --accuracy 100mm
prints "nothing within" query box.espl closest-point 0.25 1 5 --accuracy 100mm --max-distance 1
run 1 query box.espl capsule 0 0 0 1 1 1 1 --accuracy 1
run 1 query box.espl sphere 0 0 0 1 --accuracy 1 --any
run 1 query box.espl sphere 0 0 0 1 --accuracy wide

finish
