#!/usr/bin/env bash
# Tests of `espalier query` with spheres and other volumes, distances, sweeps and accuracies.
# Usage: query_shapes_test.sh PATH_TO_ESPALIER
# shellcheck source=query_blobs.sh
. "$(dirname "$0")/query_blobs.sh"

claim "a sphere lists what it touches, in storage order"
run 0 query box.espl sphere 0.5 1 1.5 100
out_has "12 triangles"
run 0 query box.espl sphere 0.5 1 1.5 0.4
out_has "0 triangles"
run 0 query box.espl sphere 0.5 1 1.5 0.5 --any
out_has "overlaps"
run 0 query box.espl sphere -1 -1 -1 1 --any --json
out_has '"overlaps": false'

claim "closest-point finds point and distance, or nothing beyond the limit"
run 0 query box.espl closest-point 0.25 1 5
out_has "distance 2"
out_has "point 0.25 1 3"
run 0 query box.espl closest-point 0.25 1 5 --max-distance 1.5
out_has "nothing within"
run 0 query box.espl closest-point 0.25 1 5 --json
out_has '"distance": 2.0'

claim "every volume lists the triangles that it touches"
counts() { # COUNT WORDS...
    local count=$1
    shift
    run 0 query box.espl "$@"
    out_has "$count triangle"
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
run 0 query sheet.espl sphere 20 0 20 9 --limit 3 --json
json '.status == "output_full" and .count == 3 and .next > 2'
run 0 query sheet.espl sphere 20 0 20 9 --limit 0
out_has "and there are more: --from"
run 1 query sheet.espl sphere 20 0 20 9 --limit 3 --any
run 1 query sheet.espl sphere 20 0 20 9 --limit -3

claim "the nearest triangles come sorted"
run 0 query box.espl closest-point 0.25 1 5 --first 3 --json
json '.count == 3 and .triangles[0].distance == 2 and .triangles[1].distance >= 2 and .triangles[2].distance >= .triangles[1].distance'
run 0 query box.espl closest-point 0.25 1 5 --first 100 --json
json '.count == 12'
run 0 query box.espl closest-point 0.25 1 5 --first 100 --max-distance 0.5 --json
json '.count == 0'

claim "segments and boxes have a closest pair of points"
run 0 query box.espl closest-point-segment 0.25 1 5 0.75 1 4 --json
json '.found and .distance == 1 and .on_shape == [0.75, 1, 4] and .point == [0.75, 1, 3] and .feature == "face" and .face_normal == [0, 0, 1] and .side == "front"'
run 0 query box.espl closest-point-segment 0.2 1 5 0.2 1 2
out_has "distance 0"
run 0 query box.espl closest-point-box 3 0 0 4 1 1 --json
json '.distance == 2 and .on_shape[0] == 3 and .point[0] == 1 and .face_normal == [1, 0, 0]'
run 0 query box.espl closest-point-box 3 0 0 4 1 1 --max-distance 1900mm
out_has "nothing within"
run 0 query box.espl closest-point-box 4 1 1 3 0 0 --json
json '.status == "ok" and .found == false'

claim "moving shapes stop at the first contact, and say when they start in one"
near() { json ".t <= $1 and .t > $1 - 0.0000002"; }
run 0 query box.espl sweep-sphere 0.5 1 6 1 0 0 -4 --json
json '.hit and .starts_overlapping == false and .normal == [0, 0, 1] and .face_normal == [0, 0, 1]'
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
run 0 query box.espl sweep-hull 0 0 -4
out_has "no contact"
run 1 query box.espl sweep-hull 0 0 -4 1
err_has "displacement x y z, vertex x y z; the last any number of times"
run 0 query box.espl sweep-sphere 0.5 1 3 1 0 0 0 # no displacement: whether it touches
out_has "starts_overlapping yes"
run 0 query box.espl sweep-sphere 0.5 1 6 1 0 0 -1.9
out_has "no contact"
run 0 query box.espl sweep-sphere 0.5 1 3 1 0 0 1 --json
json '.t == 0 and .starts_overlapping'
run 0 query box.espl sweep-sphere 0.5 1 3.5 1 0 0 1 --ignore-leaving --json
json '.status == "ok" and .hit == false'
run 0 query box.espl sweep-sphere 0.5 1 6 1 0 0 -4 --skin 0.5 --json
json '.t <= 0.375 and .t > 0.374999 and (.feature | startswith("edge"))'  # the middle of the top is on a diagonal
run 0 query box.espl sweep-sphere 0.5 1 6 1 0 0 4 --culling back
out_has "no contact"
run 6 query box.espl sweep-sphere 0.5 1 6 1 0 0 -4 --skin -1
run 6 query box.espl sweep-sphere 0.5 1 3 -1 0 0 1 --json
json '.status == "invalid_argument" and (has("hit") | not)'
run 6 query box.espl sweep-box 0 0 0 1 1 1 0 0 1e30
err_has "too far away or too large"
run 1 query box.espl sweep-box 0 0 0 1 1 1 0 0

claim "inside and outside have a sign"
run 0 query box.espl contains 0.5 1 1.5
out_has "inside"
run 0 query box.espl contains 0.5 1 3.5 --json
json '.inside == false'
run 0 query box.espl winding-number 0.5 1 1.5 16 --json
json '.winding == 1'
run 0 query box.espl winding-number 0.5 1 3.5 16 --json
json '.winding == 0'
run 1 query box.espl winding-number 0.5 1 3.5 1
err_has "directions is 1; it must be from 2 to 4096"
run 0 query box.espl signed-distance 0.5 1 2.75 --json
json '.found and .distance == -0.25 and .point == [0.5, 1, 3] and .on_shape == null and .side == "back"'
run 0 query box.espl signed-distance 0.5 1 3.25 --json
json '.distance == 0.25'
run 0 query box.espl signed-distance 0.5 1 1.5 --max-distance 0.125 --json
json '.found == false and .distance == -0.125'

claim "an accuracy makes answers that err on the safe side, and tells what they cost"
run 0 query sheet.espl sphere 20 0 20 0.5 --accuracy 0 --json
json '(.may_overlap | type) == "boolean" and .nodes_visited > 0'
exact=$(sed -n 's/.*"may_overlap": \(.*\),/\1/p' out)
run 0 query sheet.espl sphere 20 0 20 0.5 --any --json
json ".overlaps == $exact"
run 0 query box.espl box 0.2 0.2 1 0.8 1.8 2 --accuracy 10m
out_has "may overlap"
run 0 query box.espl box 9 9 9 10 10 10 --accuracy 1
out_has "does not overlap"
run 0 query box.espl ray 0.25 1.5 10 0 0 -1 --accuracy 1mm
out_has "may be occluded"
run 0 query box.espl segment 0.25 1.5 10 0.25 1.5 9 --accuracy 1mm
out_has "not occluded"
run 0 query box.espl closest-point 0.25 1 5 --accuracy 100mm --json
json '.found and .lower <= 2 and .upper >= 2 and .upper - .lower < 0.174'
run 0 query box.espl closest-point 0.25 1 5 --accuracy 100mm --max-distance 1
out_has "nothing within"
run 1 query box.espl capsule 0 0 0 1 1 1 1 --accuracy 1
run 1 query box.espl sphere 0 0 0 1 --accuracy 1 --any
run 1 query box.espl sphere 0 0 0 1 --accuracy wide

finish
