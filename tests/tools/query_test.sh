#!/usr/bin/env bash
# Tests of `espalier query`: rays, arguments, pairs of blobs and lookups, with answers that can be found without a computer.
# Usage: query_test.sh PATH_TO_ESPALIER
# shellcheck source=query_blobs.sh
. "$(dirname "$0")/query_blobs.sh"

claim "a ray reports its closest hit, and negative numbers are numbers"
prints "hit triangle " query box.espl ray 0.25 1 10 0 0 -1
out_has "t 7" "point 0.25 1 3" "normal 0 0 1"
prints "t 0.25" query box.espl ray -.5 1 1 2 -0.0 -.0
prints "no hit" query box.espl ray -5e-1 1 1 -1 0 0
run 0 query box.espl ray 0.25 1 10 0 0 -1 --json
out_has '"schema": 1' '"query": "ray"' '"hit": true' '"t": 7.0' '"u": ' '"v": ' '"normal": ' '"point": ' '"triangle": '
! grep -q original out || fail "a blob without ids names an original"

claim "a ray's range, sides, all hits and any hit"
prints "t 10" query box.espl ray 0.25 1.5 10 0 0 -1 --t-min 8
prints "no hit" query box.espl ray 0.25 1.5 10 0 0 -1 --t-max 6.5
prints "t 10" query box.espl ray 0.25 1.5 10 0 0 -1 --culling front
out_has "side back"
finds '.t == 7 and .side == "front"' query box.espl ray 0.25 1.5 10 0 0 -1 --culling back
prints "2 hits" query box.espl ray 0.25 1.5 10 0 0 -1 --all
prints '"count": 2' query box.espl --json ray 0.25 1.5 10 0 0 -1 --all
prints "2 crossings" query box.espl ray 0 1 10 0 0 -1 --crossings
finds '(.crossings | length) == 2 and .crossings[0].side != .crossings[1].side' query box.espl ray 0 1 10 0 0 -1 --crossings
run 1 query box.espl ray 0 1 10 0 0 -1 --crossings --all
prints "occluded" query box.espl ray 0.25 1.5 10 0 0 -1 --any
prints "not occluded" query box.espl ray 0.25 1.5 10 0 0 1 --any
run 1 query box.espl ray 0.25 1.5 10 0 0 -1 --any --all

claim "a ray names the original triangle and its material when the blob carries them"
prints '"original": {' query sheet.espl ray 0.6 10 0.3 0 -1 0 --json
out_has '"material": '

claim "segments end, and the first few hits come sorted"
prints "t 0.35" query box.espl segment 0.25 1.5 10 0.25 1.5 -10
prints "not occluded" query box.espl segment 0.25 1.5 10 0.25 1.5 4 --any
finds '.status == "ok" and .count == 2 and ([.hits[].t] == [5, 6.5])' query box.espl ray 0.25 1.5 -10 0 0 2 --first 5
finds '.status == "output_full" and .count == 1 and .hits[0].t == 7' query box.espl ray 0.25 1.5 10 0 0 -1 --first 1
prints "and there are more" query box.espl ray 0.25 1.5 10 0 0 -1 --first 0

claim "contacts of a body, all and the few that support it"
run 0 query box.espl contacts-sphere 0.25 1 3.2 0.5 0 --json
json '.count >= 1 and ([.touches[].distance] | min) > -0.3001 and ([.touches[].distance] | min) < -0.2999'
json '[.touches[] | select(.feature == "face")][0].normal == [0, 0, 1]'
prints "4 touches" query box.espl contacts-oriented-box 0 1 3.25 0.1 0 0 0 0.1 0 0 0 0.25 0.01 --few
prints "0 touches" query box.espl contacts-capsule -0.1 1 3.5 0.1 1 3.5 0.25 0.1
run 0 query box.espl contacts-hull 0.4 1 2.99  0.6 1 2.99  0.5 1.1 2.99  0.5 1 3.5 --few --json
json '.count >= 3 and ([.touches[].distance] | min) > -0.0101 and ([.touches[].distance] | min) < -0.0099'
prints "0 touches" query box.espl contacts-hull 0.5 1 3.01  0.5 1 3.5
run 0 query box.espl contacts-hull 0.5 1 3.01  0.5 1 3.5 --max-distance 0.1 --json
json '.count >= 1 and .touches[0].distance > 0.0099 and .touches[0].distance < 0.0101'
run 1 query box.espl contacts-sphere 0 0 0 1

claim "boxes and segments in lattice steps, and where the lattice is"
prints "step " query box.espl lattice
top=$(sed -nE 's/^lattice of [0-9]+ x [0-9]+ x ([0-9]+) steps$/\1/p' out)
finds ".extent[2] == $top" query box.espl lattice
prints "hit triangle " query box.espl lattice-segment 20 30 $((2 * top)) 20 30 0
out_has "t 0.5" "side front"
finds '.hit and .side == "front"' query box.espl lattice-segment 20 30 -1 20 30 $top
prints "not occluded" query box.espl lattice-segment 20 30 $((top / 2)) 20 30 $((top / 2 + 1)) --any
fails 6 '.status == "out_of_range"' query box.espl lattice-segment 0 0 536870913 0 0 0
run 1 query box.espl lattice-segment 0 0 0.5 0 0 0
run 1 query box.espl lattice-segment 0 0 2147483648 0 0 0
prints "overlaps" query box.espl lattice-box 0 0 0 0 0 0 --any
prints "does not overlap" query box.espl lattice-box 1 1 1 2 2 2 --any
prints "12 triangles" query box.espl lattice-box -2147483648 -2147483648 -2147483648 2147483647 2147483647 2147483647
finds '.steps | length == 3' query box.espl to-lattice 0 0 0

claim "arguments are any numbers and lengths there are, and nothing else"
for number in nan -inf 1e999 -1e-999; do
    refused=6 && [[ $number != -1e-999 ]] || refused=0
    run $refused query box.espl ray $number 0 0 1 0 0
    run $refused query box.espl ray 0 0 0 1 0 $number
done
run_each 0 "query box.espl closest-point 0 0" -1e-999 "0 --max-distance 1e999" "0 --max-distance -1e-999"
refuses 1 "origin: 'zero' is no length" query box.espl ray 0 0 zero 1 0 0
refuses 1 "direction: '1mm' is no number" query box.espl ray 0 0 0 1 0 1mm
refuses 1 "direction: '-1mm' is no number" query box.espl ray 0 0 0 1 0 -1mm
run_each 1 "query box.espl" "sphere 0 0 0 1parsec" "ray 0 0 0 1 0" "ray 0 0 0 1 0 0 0" "sphere 0 0 0" "box 0 0 0 1 1" \
    "convex-volume 0 0 1"
refuses 1 "normal x y z, offset; once or more" query box.espl convex-volume 0 0 1 0 0
run_each 1 "query box.espl" "cone 0 0 0 1" "sphere 0 0 0 1 --depth 3" ""

claim "lengths take units, negative ones too"
prints "distance 2" query box.espl closest-point 250mm 100cm 0.005km
finds '.distance > 1.2247 and .distance < 1.2248 and .feature[:6] == "vertex"' query box.espl closest-point -1000mm -.5m -50cm

claim "what a query refuses it does not answer: exit status 6, the argument and its range on stderr, the status in JSON"
refused() { # REASON WORDS...
    local reason=$1
    shift
    refuses 6 "query $1: $reason." query box.espl "$@"
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
refuses 6 "; displacement is 0 0 -1e30." query box.espl sweep-sphere 0 0 0 1 0 0 -1e30
fails 6 '.status == "out_of_range"' query box.espl capsule 1e30 0 0 1e30 1 0 1
refuses 6 "not closed" query sheet.espl contains 0 0 0

claim "a blob with duplicate references lists each triangle once, in pages too"
finds '.status == "ok" and .count > 0 and ([.hits[].triangle] | length == (unique | length))' query split.espl ray 0.7 0.5 9 0 0 -1 --all
finds '.status == "ok" and .count > 1 and ([.triangles[].triangle] | length == (unique | length))' query split.espl sphere 0 0 0.5 0.5
finds '.status == "output_full" and .count == 1 and .next > 0' query split.espl sphere 0 0 0.5 0.5 --limit 1
prints "overlaps" query split.espl sphere 0 0 0.5 0.5 --any

claim "two blobs touch or not, wherever the other stands"
prints "overlaps" query box.espl overlaps box.espl
prints "overlaps" query box.espl overlaps box.espl --move 0 0 3
finds '.overlaps == false' query box.espl overlaps box.espl --move 0 0 3001mm
prints "does not overlap" query box.espl overlaps box.espl --move 0.25 0.5 0.5 --scale 0.5
prints "does not overlap" query box.espl overlaps box.espl --move -1 -1 -1 --scale 0.25 --rotate 0 0 0 1
prints "does not overlap" query box.espl overlaps box.espl --rotate 0 0 1 0 --move 0 0 4 # half a turn about z
finds '.found and .a.original.file == 0 and (.b.triangle | type) == "number"' query full.espl first-contact box.espl --move 0.9 0 0
prints "no contact" query box.espl first-contact box.espl --move 9 0 0
finds '.status == "ok" and .count == (.contacts | length) and .count > 10' query box.espl contacts box.espl --move 0.9 0 0
prints "2 contacts, and there are more" query box.espl contacts box.espl --move 0.9 0 0 --limit 2
run 0 query box.espl touches box.espl --move 0.9 0 0 --json
json '.status == "ok" and .count == (.places | length) and .count > 10 and ([.places[].points | length] | min) >= 1 and ([.places[].depth] | min) >= 0'
prints "2 places, and there are more" query box.espl touches box.espl --move 0.9 0 0 --limit 2
finds '.distance == 2 and .on_a[2] == 3 and .on_b[2] == 5' query box.espl distance box.espl --move 0 0 5
prints "nothing within" query box.espl distance box.espl --move 0 0 5 --max-distance 1
prints "within that distance" query box.espl within-distance box.espl 2 --move 0 0 5
prints "farther apart" query box.espl within-distance box.espl 1999mm --move 0 0 5

claim "two blobs refuse what cannot be placed, and tell when the work was limited"
fails 6 '.status == "invalid_argument" and (has("overlaps") | not)' query box.espl overlaps box.espl --rotate 0 0 0 0
refused "--rotate is 0 0 0 0; $direction" distance box.espl --rotate 0 0 0 0
refused "--scale is -1; it must be above 0, and finite" distance box.espl --scale -1
refused "--move is 0 inf 0; $finite" touches box.espl --move 0 inf 0
refused "distance is nan; $size" within-distance box.espl nan
refuses 6 "too far away" query box.espl overlaps box.espl --move 1e38 0 0
err_has "; --move is 1e38 0 0."
prints "3 contacts, and there are more" query split.espl contacts split.espl --limit 3 # with duplicate references
run 0 query split.espl overlaps split.espl
fails 6 '.status == "work_limit" and .count >= 0' query sheet.espl contacts sheet.espl --work-limit 5
refuses 6 "limit of work" query sheet.espl distance sheet.espl --move 0 9 0 --work-limit 1
run_each 1 "query box.espl" overlaps "overlaps box.espl --rotate 0 0 1" "overlaps box.espl --scale big"
run 2 query box.espl overlaps missing.espl
run 3 query box.espl overlaps box.obj

claim "what a blob holds: bounds, triangles with source and edges, nodes"
finds '.box == {min: [0, 0, 0], max: [1, 2, 3]} and (has("sphere") or has("oriented_box") or has("k_dop") | not)' query box.espl bounds
finds '.sphere.radius > 1.87 and .sphere.radius < 1.88 and (.oriented_box.half_axes | length) == 3 and (.k_dop | length) == 13' query full.espl bounds
prints "along 1 1 1: " query full.espl bounds
finds '.original.file == 0 and (.a | length) == 3 and ([.edge_ab, .edge_bc, .edge_ca] | sort) == ["convex", "convex", "flat"]' query full.espl show 11
refuses 6 "query show: triangle is 12; the blob has 12 triangles, counted from 0." query full.espl show 12
fails 6 '.status == "invalid_argument"' query full.espl fix-internal-edge-normal 12 face 0 0 1
run 1 query full.espl show 1.5
refuses 1 "'-1' is no whole number" query full.espl show -1
finds '.count == 12 and ([.triangles[].triangle] == [range(12)])' query full.espl triangles
prints "1 triangle, and there are more: --from 11 goes on" query full.espl triangles --from 10 --limit 1
finds '(.nodes | length) > 20 and .nodes[0].depth == 1 and ([.nodes[].children[] | .triangles // 0] | add) == 3200' query sheet.espl tree
prints "1 node" query sheet.espl tree --depth 1
prints "0 nodes" query empty.espl tree

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
refuses 1 "is none of face, edge_ab" query full.espl fix-internal-edge-normal 0 edge 0 0 1
refuses 6 "--flat-angle" query box.espl fix-internal-edge-normal 0 face 0 0 1
fails 6 '.status == "no_data" and .error.kind == "no_answer"' query box.espl fix-internal-edge-normal 0 face 0 0 1

claim "a miss has the keys of a hit, which are null"
# The options of a query of which one is a hit and one a miss.
misses_like_hits() { # FILE HIT_WORDS MISS_WORDS
    # shellcheck disable=SC2086  # words
    run 0 query $1 $2 --json
    cp out hit
    # shellcheck disable=SC2086
    run 0 query $1 $3 --json
    command -v jq >/dev/null || return 0
    jq -e '(.hit // .found) == true' hit >/dev/null || fail "no hit: $2"
    jq -s -e '(.[0] | keys) == (.[1] | keys)' hit out >/dev/null || fail "$3: $(jq -s -c '(.[0] | keys) - (.[1] | keys)' hit out) are missing"
    json 'del(.schema, .query, .status, .hit, .found, .nodes_visited, .leaves_visited) | length > 1 and all(. == null)'
}
"$espalier" bake box.obj far_box.obj -o two.esps -q --ids --materials --instances all || fail "no scene"
for file in box.espl two.espl two.esps; do
    misses_like_hits $file "ray 0.25 1.5 9 0 0 -1" "ray 0.25 1.5 9 0 0 1"
    misses_like_hits $file "segment 0.25 1.5 9 0.25 1.5 -9" "segment 0.25 1.5 9 0.25 1.5 8"
    misses_like_hits $file "closest-point 0 0 9" "closest-point 0 0 9 --max-distance 1"
    misses_like_hits $file "sweep-sphere 0.5 1 6 1 0 0 -4" "sweep-sphere 0.5 1 6 1 0 0 4"
    [ $file != two.esps ] || continue
    misses_like_hits $file "closest-point 0 0 9 --accuracy 1" "closest-point 0 0 9 --accuracy 1 --max-distance 1"
    misses_like_hits $file "closest-point-segment 0 0 9 1 0 9" "closest-point-segment 0 0 9 1 0 9 --max-distance 1"
    misses_like_hits $file "closest-point-box 0 0 9 1 1 9" "closest-point-box 0 0 9 1 1 9 --max-distance 1"
    misses_like_hits $file "lattice-segment 20 30 -1 20 30 99999" "lattice-segment 20 30 -1 20 30 -2"
    misses_like_hits $file "distance box.espl --move 0 0 9" "distance box.espl --move 0 0 9 --max-distance 1"
    misses_like_hits $file "first-contact box.espl" "first-contact box.espl --move 0 0 9"
done

claim "a coordinate that is zero is printed as 0"
run 0 query box.espl touches box.espl --move 0.5 0.5 0.5
! grep -qE '(^| )-0( |,|$)' out || fail "-0: $(grep -m1 -E '(^| )-0( |,|$)' out)"
run 0 query box.espl touches box.espl --move 0.5 0.5 0.5 --json
! grep -qE -- '-0(\.0)?,?$' out || fail "-0 in JSON"
run 0 query full.espl fix-internal-edge-normal 0 face -0 -0 1
! grep -q -- '-0' out || fail "-0: $(cat out)"

claim "an empty blob answers everything with nothing"
prints "0 hits" query empty.espl ray 0 0 0 1 0 0 --first 3
prints "0 triangles" query empty.espl closest-point 0 0 0 --first 3
for volume in "sphere 0 0 0 inf" "capsule 0 0 0 1 1 1 1" "box 0 0 0 1 1 1" "convex-volume 0 0 1 0" "triangle 0 0 0 1 0 0 0 1 0"; do
    # shellcheck disable=SC2086
    prints "0 triangles" query empty.espl $volume
done

claim "help lists every kind, and each kind has help that names its words"
run 0 query --help
sed -n 's/^  \([a-z][a-z-]*\)  *[A-Z].*/\1/p' out >kinds
[ "$(wc -l <kinds)" -ge 26 ] || fail "$(wc -l <kinds) kinds"
while read -r kind; do
    prints "--json" query x "$kind" --help
done <kinds
prints "from x y z, to x y z, radius" query x capsule --help
out_has "  from x y z: a place in the coordinates of the source; each takes a unit" \
    "  radius: a length, which takes a unit; 0 or more, which may be inf" "a bare number is in the unit of the blob, metres"
prints "  direction x y z: a direction, without units; finite, and long enough" query x ray --help
prints "  displacement x y z: a displacement; each length takes a unit" query x sweep-box --help
prints "  feature: where the contact is: face, edge_ab" query x fix-internal-edge-normal --help
prints "  OTHER: the file of the other blob" query x overlaps --help

finish
