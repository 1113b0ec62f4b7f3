#!/usr/bin/env bash
# Tests of `espalier query`: rays, arguments, pairs of blobs and lookups, with answers that can be found without a computer.
# Usage: query_test.sh PATH_TO_ESPALIER
# shellcheck source=query_blobs.sh
. "$(dirname "$0")/query_blobs.sh"

claim "a ray reports its closest hit, and negative numbers are numbers"
run 0 query box.espl ray 0.25 1 10 0 0 -1
out_has "hit triangle "
out_has "t 7"
out_has "point 0.25 1 3"
out_has "normal 0 0 1"
run 0 query box.espl ray -.5 1 1 2 -0.0 -.0
out_has "t 0.25"
run 0 query box.espl ray -5e-1 1 1 -1 0 0
out_has "no hit"
run 0 query box.espl ray 0.25 1 10 0 0 -1 --json
for key in '"schema": 1' '"query": "ray"' '"hit": true' '"t": 7.0' '"u": ' '"v": ' '"normal": ' '"point": ' '"triangle": '; do
    out_has "$key"
done
! grep -q original out || fail "a blob without ids names an original"

claim "a ray's range, sides, all hits and any hit"
run 0 query box.espl ray 0.25 1.5 10 0 0 -1 --t-min 8
out_has "t 10"
run 0 query box.espl ray 0.25 1.5 10 0 0 -1 --t-max 6.5
out_has "no hit"
run 0 query box.espl ray 0.25 1.5 10 0 0 -1 --culling front
out_has "t 10"
out_has "side back"
run 0 query box.espl ray 0.25 1.5 10 0 0 -1 --culling back --json
json '.t == 7 and .side == "front"'
run 0 query box.espl ray 0.25 1.5 10 0 0 -1 --all
out_has "2 hits"
run 0 query box.espl --json ray 0.25 1.5 10 0 0 -1 --all
out_has '"count": 2'
run 0 query box.espl ray 0 1 10 0 0 -1 --crossings
out_has "2 crossings"
run 0 query box.espl --json ray 0 1 10 0 0 -1 --crossings
json '(.crossings | length) == 2 and .crossings[0].side != .crossings[1].side'
run 1 query box.espl ray 0 1 10 0 0 -1 --crossings --all
run 0 query box.espl ray 0.25 1.5 10 0 0 -1 --any
out_has "occluded"
run 0 query box.espl ray 0.25 1.5 10 0 0 1 --any
out_has "not occluded"
run 1 query box.espl ray 0.25 1.5 10 0 0 -1 --any --all

claim "a ray names the original triangle and its material when the blob carries them"
run 0 query sheet.espl ray 0.6 10 0.3 0 -1 0 --json
out_has '"original": {'
out_has '"material": '

claim "segments end, and the first few hits come sorted"
run 0 query box.espl segment 0.25 1.5 10 0.25 1.5 -10
out_has "t 0.35"
run 0 query box.espl segment 0.25 1.5 10 0.25 1.5 4 --any
out_has "not occluded"
run 0 query box.espl ray 0.25 1.5 -10 0 0 2 --first 5 --json
json '.status == "ok" and .count == 2 and ([.hits[].t] == [5, 6.5])'
run 0 query box.espl ray 0.25 1.5 10 0 0 -1 --first 1 --json
json '.status == "output_full" and .count == 1 and .hits[0].t == 7'
run 0 query box.espl ray 0.25 1.5 10 0 0 -1 --first 0
out_has "and there are more"

claim "contacts of a body, all and the few that support it"
run 0 query box.espl contacts-sphere 0.25 1 3.2 0.5 0 --json
json '.count >= 1 and ([.touches[].distance] | min) > -0.3001 and ([.touches[].distance] | min) < -0.2999'
json '[.touches[] | select(.feature == "face")][0].normal == [0, 0, 1]'
run 0 query box.espl contacts-oriented-box 0 1 3.25 0.1 0 0 0 0.1 0 0 0 0.25 0.01 --few
out_has "4 touches"
run 0 query box.espl contacts-capsule -0.1 1 3.5 0.1 1 3.5 0.25 0.1
out_has "0 touches"
run 0 query box.espl contacts-hull 0.4 1 2.99  0.6 1 2.99  0.5 1.1 2.99  0.5 1 3.5 --few --json
json '.count >= 3 and ([.touches[].distance] | min) > -0.0101 and ([.touches[].distance] | min) < -0.0099'
run 0 query box.espl contacts-hull 0.5 1 3.01  0.5 1 3.5
out_has "0 touches"
run 0 query box.espl contacts-hull 0.5 1 3.01  0.5 1 3.5 --max-distance 0.1 --json
json '.count >= 1 and .touches[0].distance > 0.0099 and .touches[0].distance < 0.0101'
run 1 query box.espl contacts-sphere 0 0 0 1

claim "boxes and segments in lattice steps, and where the lattice is"
run 0 query box.espl lattice
out_has "step "
top=$(sed -nE 's/^lattice of [0-9]+ x [0-9]+ x ([0-9]+) steps$/\1/p' out)
run 0 query box.espl lattice --json
json ".extent[2] == $top"
run 0 query box.espl lattice-segment 20 30 $((2 * top)) 20 30 0
out_has "hit triangle "
out_has "t 0.5"
out_has "side front"
run 0 query box.espl lattice-segment 20 30 -1 20 30 $top --json
json '.hit and .side == "front"'
run 0 query box.espl lattice-segment 20 30 $((top / 2)) 20 30 $((top / 2 + 1)) --any
out_has "not occluded"
run 6 query box.espl lattice-segment 0 0 536870913 0 0 0 --json
json '.status == "out_of_range"'
run 1 query box.espl lattice-segment 0 0 0.5 0 0 0
run 1 query box.espl lattice-segment 0 0 2147483648 0 0 0
run 0 query box.espl lattice-box 0 0 0 0 0 0 --any
out_has "overlaps"
run 0 query box.espl lattice-box 1 1 1 2 2 2 --any
out_has "does not overlap"
run 0 query box.espl lattice-box -2147483648 -2147483648 -2147483648 2147483647 2147483647 2147483647
out_has "12 triangles"
run 0 query box.espl to-lattice 0 0 0 --json
json '.steps | length == 3'

claim "arguments are any numbers and lengths there are, and nothing else"
for number in nan -inf 1e999 -1e-999; do
    refused=6 && [[ $number != -1e-999 ]] || refused=0
    run $refused query box.espl ray $number 0 0 1 0 0
    run $refused query box.espl ray 0 0 0 1 0 $number
done
run 0 query box.espl closest-point 0 0 -1e-999
run 0 query box.espl closest-point 0 0 0 --max-distance 1e999
run 0 query box.espl closest-point 0 0 0 --max-distance -1e-999
run 1 query box.espl ray 0 0 zero 1 0 0
err_has "origin: 'zero' is no length"
run 1 query box.espl ray 0 0 0 1 0 1mm
err_has "direction: '1mm' is no number"
run 1 query box.espl ray 0 0 0 1 0 -1mm
err_has "direction: '-1mm' is no number"
run 1 query box.espl sphere 0 0 0 1parsec
run 1 query box.espl ray 0 0 0 1 0
run 1 query box.espl ray 0 0 0 1 0 0 0
run 1 query box.espl sphere 0 0 0
run 1 query box.espl box 0 0 0 1 1
run 1 query box.espl convex-volume 0 0 1
run 1 query box.espl convex-volume 0 0 1 0 0
err_has "normal x y z, offset; once or more"
run 1 query box.espl cone 0 0 0 1
run 1 query box.espl sphere 0 0 0 1 --depth 3
run 1 query box.espl

claim "lengths take units, negative ones too"
run 0 query box.espl closest-point 250mm 100cm 0.005km
out_has "distance 2"
run 0 query box.espl closest-point -1000mm -.5m -50cm --json
json '.distance > 1.2247 and .distance < 1.2248 and .feature[:6] == "vertex"'

claim "what a query refuses it does not answer: exit status 6, the argument and its range on stderr, the status in JSON"
refused() { # REASON WORDS...
    local reason=$1
    shift
    run 6 query box.espl "$@"
    err_has "query $1: $reason."
    [ ! -s out ] || fail "$*: an answer: $(head -c 200 out)"
    run 6 query box.espl "$@" --json
    json '.status == "invalid_argument" and (has("count") or has("overlaps") or has("inside") or has("found") or has("hit") | not)'
}
finite="it must be finite"
size="it must be 0 or more, which may be inf"
finite_size="it must be 0 or more, and finite"
number="it must be a number, which may be inf or -inf"
direction="it must be finite, and long enough not to round to length zero"
apart="it must be finite, and another point than the one before"
refused "origin is nan 0 0; $finite" ray nan 0 0 0 0 1
refused "direction is 0 -0 0; $direction" ray 1 2 3 0 -0 0
refused "direction is inf 0 0; $direction" ray 1 2 3 inf 0 0 --all
refused "--t-min is nan; $number" ray 1 2 3 0 0 1 --t-min nan
refused "to is 1 1 1; $apart" segment 1 1 1 1 1 1
refused "to is 5 6 7; $apart" lattice-segment 5 6 7 5 6 7
refused "center is 0 nan 0; $finite" sphere 0 nan 0 1
refused "radius is -1; $size" sphere 0 0 0 -1
refused "radius is -1mm; $size" sphere 0 0 0 -1mm --any
refused "center is -inf 0 0; $finite" sphere -inf 0 0 1 --any
refused "from is inf 0 0; $finite" capsule inf 0 0 0 0 0 1
refused "max is 1 1 nan; $number" box 0 0 0 1 1 nan
refused "half axis 2 of 3 is 0 inf 0; $finite" oriented-box 0 0 0 1 0 0 0 inf 0 0 0 1
refused "axis is 0 0 0; $direction" cone 0 0 0 0 0 0 1
refused "axis is 0 1e-30 0; $direction" cone 0 0 0 0 1e-30 0 1
refused "radius is inf; $finite_size" cone 0 0 0 0 1 0 inf
refused "c is 0 nan 0; $finite" triangle 0 0 0 1 0 0 0 nan 0
refused "normal is 0 0 0; $direction" convex-volume 0 0 0 1
refused "offset 2 of 2 is nan; $number" convex-volume 0 0 1 1 0 1 0 nan
# shellcheck disable=SC2046
refused "normal is given 33 times; 32 is the most" convex-volume $(printf '0 0 1 %s ' $(seq 33))
refused "point is nan 0 0; $finite" contains nan 0 0
refused "--max-distance is -1; $size" signed-distance 0 0 0 --max-distance -1
refused "point is 0 0 1e999; $finite" closest-point 0 0 1e999
refused "--max-distance is -inf; $size" closest-point 0 0 0 --max-distance -inf
refused "point is nan 0 0; $finite" closest-point nan 0 0 --first 2
refused "--max-distance is nan; $size" closest-point 0 0 0 --max-distance nan --accuracy 1
refused "min is 0 0 nan; $finite" closest-point-box 0 0 nan 1 1 1
refused "point is nan 0 0; $finite" to-lattice nan 0 0
refused "radius is -1; $finite_size" contacts-sphere 0 0 0 -1 0
refused "margin is -1; $finite_size" contacts-capsule 0 0 0 1 0 0 1 -1
refused "half_axis_c is 0 0 nan; $finite" contacts-oriented-box 0 0 0 1 0 0 0 1 0 0 0 nan 0
refused "--max-distance is -1; $size" contacts-hull 0 0 0 --max-distance -1
# shellcheck disable=SC2046
refused "vertex is given 65 times; 64 is the most" contacts-hull $(printf '0 0 %s ' $(seq 65))
refused "displacement is 0 nan -1; $finite" sweep-sphere 0 0 0 1 0 nan -1
refused "radius is -1; $finite_size" sweep-capsule 0 0 0 1 1 1 -1 0 0 1
refused "--skin is -1; $finite_size" sweep-box 0 0 0 1 1 1 0 0 1 --skin -1
refused "half axis 3 of 3 is 0 0 nan; $finite" sweep-oriented-box 0 0 0 1 0 0 0 1 0 0 0 nan 0 0 1
refused "vertex 2 of 3 is 0 inf 0; $finite" sweep-hull 0 0 -1 0 0 0 0 inf 0 0 0 1
# shellcheck disable=SC2046
refused "vertex is given 65 times; 64 is the most" sweep-hull 0 0 -1 $(printf '0 0 %s ' $(seq 65))
# Out of range: what reaches farthest.
run 6 query box.espl sweep-sphere 0 0 0 1 0 0 -1e30
err_has "; displacement is 0 0 -1e30."
run 6 query box.espl capsule 1e30 0 0 1e30 1 0 1 --json
json '.status == "out_of_range"'
run 6 query sheet.espl contains 0 0 0
err_has "not closed"

claim "a blob with duplicate references lists each triangle once, in pages too"
run 0 query split.espl ray 0.7 0.5 9 0 0 -1 --all --json
json '.status == "ok" and .count > 0 and ([.hits[].triangle] | length == (unique | length))'
run 0 query split.espl sphere 0 0 0.5 0.5 --json
json '.status == "ok" and .count > 1 and ([.triangles[].triangle] | length == (unique | length))'
run 0 query split.espl sphere 0 0 0.5 0.5 --limit 1 --json
json '.status == "output_full" and .count == 1 and .next > 0'
run 0 query split.espl sphere 0 0 0.5 0.5 --any
out_has "overlaps"

claim "two blobs touch or not, wherever the other stands"
run 0 query box.espl overlaps box.espl
out_has "overlaps"
run 0 query box.espl overlaps box.espl --move 0 0 3
out_has "overlaps"
run 0 query box.espl overlaps box.espl --move 0 0 3001mm --json
json '.overlaps == false'
run 0 query box.espl overlaps box.espl --move 0.25 0.5 0.5 --scale 0.5
out_has "does not overlap"
run 0 query box.espl overlaps box.espl --move -1 -1 -1 --scale 0.25 --rotate 0 0 0 1
out_has "does not overlap"
run 0 query box.espl overlaps box.espl --rotate 0 0 1 0 --move 0 0 4 # half a turn about z
out_has "does not overlap"
run 0 query full.espl first-contact box.espl --move 0.9 0 0 --json
json '.found and .a.original.file == 0 and (.b.triangle | type) == "number"'
run 0 query box.espl first-contact box.espl --move 9 0 0
out_has "no contact"
run 0 query box.espl contacts box.espl --move 0.9 0 0 --json
json '.status == "ok" and .count == (.contacts | length) and .count > 10'
run 0 query box.espl contacts box.espl --move 0.9 0 0 --limit 2
out_has "2 contacts, and there are more"
run 0 query box.espl touches box.espl --move 0.9 0 0 --json
json '.status == "ok" and .count == (.places | length) and .count > 10 and ([.places[].points | length] | min) >= 1 and ([.places[].depth] | min) >= 0'
run 0 query box.espl touches box.espl --move 0.9 0 0 --limit 2
out_has "2 places, and there are more"
run 0 query box.espl distance box.espl --move 0 0 5 --json
json '.distance == 2 and .on_a[2] == 3 and .on_b[2] == 5'
run 0 query box.espl distance box.espl --move 0 0 5 --max-distance 1
out_has "nothing within"
run 0 query box.espl within-distance box.espl 2 --move 0 0 5
out_has "within that distance"
run 0 query box.espl within-distance box.espl 1999mm --move 0 0 5
out_has "farther apart"

claim "two blobs refuse what cannot be placed, and tell when the work was limited"
run 6 query box.espl overlaps box.espl --rotate 0 0 0 0 --json
json '.status == "invalid_argument" and (has("overlaps") | not)'
refused "--rotate is 0 0 0 0; $direction" distance box.espl --rotate 0 0 0 0
refused "--scale is -1; it must be above 0, and finite" distance box.espl --scale -1
refused "--move is 0 inf 0; $finite" touches box.espl --move 0 inf 0
refused "distance is nan; $size" within-distance box.espl nan
run 6 query box.espl overlaps box.espl --move 1e38 0 0
err_has "too far away"
err_has "; --move is 1e38 0 0."
run 0 query split.espl contacts split.espl --limit 3 # with duplicate references
out_has "3 contacts, and there are more"
run 0 query split.espl overlaps split.espl
run 6 query sheet.espl contacts sheet.espl --work-limit 5 --json
json '.status == "work_limit" and .count >= 0'
run 6 query sheet.espl distance sheet.espl --move 0 9 0 --work-limit 1
err_has "limit of work"
run 1 query box.espl overlaps
run 1 query box.espl overlaps box.espl --rotate 0 0 1
run 1 query box.espl overlaps box.espl --scale big
run 2 query box.espl overlaps missing.espl
run 3 query box.espl overlaps box.obj

claim "what a blob holds: bounds, triangles with source and edges, nodes"
run 0 query box.espl bounds --json
json '.box == {min: [0, 0, 0], max: [1, 2, 3]} and (has("sphere") or has("oriented_box") or has("k_dop") | not)'
run 0 query full.espl bounds --json
json '.sphere.radius > 1.87 and .sphere.radius < 1.88 and (.oriented_box.half_axes | length) == 3 and (.k_dop | length) == 13'
run 0 query full.espl bounds
out_has "along 1 1 1: "
run 0 query full.espl show 11 --json
json '.original.file == 0 and (.a | length) == 3 and ([.edge_ab, .edge_bc, .edge_ca] | sort) == ["convex", "convex", "flat"]'
run 1 query full.espl show 12
err_has "the blob has 12 triangles"
run 1 query full.espl show 1.5
run 1 query full.espl show -1
err_has "'-1' is no whole number"
run 0 query full.espl triangles --json
json '.count == 12 and ([.triangles[].triangle] == [range(12)])'
run 0 query full.espl triangles --from 10 --limit 1
out_has "1 triangle, and there are more: --from 11 goes on"
run 0 query sheet.espl tree --json
json '(.nodes | length) > 20 and .nodes[0].depth == 1 and ([.nodes[].children[] | .triangles // 0] | add) == 3200'
run 0 query sheet.espl tree --depth 1
out_has "1 node"
run 0 query empty.espl tree
out_has "0 nodes"

claim "a contact on a flat edge gets the normal of its triangle, on a ridge it keeps its own"
run 0 query full.espl show 0 --json
for edge in ab bc ca; do
    kind=$(sed -n "s/.*\"edge_$edge\": \"\(.*\)\".*/\1/p" out)
    "$espalier" query full.espl fix-internal-edge-normal 0 edge_$edge 0.6 0 0.8 >contact || fail "contact on $edge"
    case $kind in
        flat) grep -q '^fixed, on an internal edge' contact && ! grep -q 'normal 0.6 0 0.8' contact || fail "flat $edge: $(cat contact)" ;;
        *) grep -q '^unchanged' contact && grep -q 'normal 0.6 0 0.8' contact || fail "$kind $edge: $(cat contact)" ;;
    esac
done
run 1 query full.espl fix-internal-edge-normal 0 edge 0 0 1
err_has "is none of face, edge_ab"
run 5 query box.espl fix-internal-edge-normal 0 face 0 0 1
err_has "--flat-angle"

claim "an empty blob answers everything with nothing"
run 0 query empty.espl ray 0 0 0 1 0 0 --first 3
out_has "0 hits"
run 0 query empty.espl closest-point 0 0 0 --first 3
out_has "0 triangles"
for volume in "sphere 0 0 0 inf" "capsule 0 0 0 1 1 1 1" "box 0 0 0 1 1 1" "convex-volume 0 0 1 0" "triangle 0 0 0 1 0 0 0 1 0"; do
    # shellcheck disable=SC2086
    run 0 query empty.espl $volume
    out_has "0 triangles"
done

claim "help lists every kind, and each kind has help that names its words"
run 0 query --help
sed -n 's/^  \([a-z][a-z-]*\)  *[A-Z].*/\1/p' out >kinds
[ "$(wc -l <kinds)" -ge 26 ] || fail "$(wc -l <kinds) kinds"
while read -r kind; do
    run 0 query x "$kind" --help
    out_has "--json"
done <kinds
run 0 query x capsule --help
out_has "from x y z, to x y z, radius"

finish
