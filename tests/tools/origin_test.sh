#!/usr/bin/env bash
# Tests of meshes with coordinates of maps, far from 0: `bake --origin`, and what every verb does with such a blob.
# Usage: origin_test.sh PATH_TO_ESPALIER
# shellcheck source=meshes.sh
. "$(dirname "$0")/meshes.sh"

# A house of 10 m by 8 m in UTM coordinates, closed; its faces have four and five corners.
x=500123.4567 y=5400321.123 z=612.3
write_house() { # METRES_TO_THE_EAST TIMES_AS_HIGH
    awk -v x=$x -v y=$y -v z=$z -v east="$1" -v high="$2" 'BEGIN {
        n = split("0 0 0 10 0 0 10 8 0 0 8 0 0 0 5 10 0 5 10 8 5 0 8 5 0 4 7 10 4 7", at, " ")
        for (i = 1; i < n; i += 3) printf "v %.4f %.4f %.4f\n", x + east + at[i], y + at[i + 1], z + high * at[i + 2] }'
    printf 'f %s\n' "1 4 3 2" "1 2 6 5" "2 3 7 10 6" "3 4 8 7" "4 1 5 9 8" "5 6 10 9" "7 8 9 10"
}
# A place of the house, by its distance from the first corner.
at() { awk -v x=$x -v y=$y -v z=$z -v a="$1" -v b="$2" -v c="$3" 'BEGIN { printf "%.4f %.4f %.4f", x + a, y + b, z + c }'; }
# Of the JSON in ./out: that the point is within 2 mm of that place.
near() { # FILTER A B C
    json "[$1, (\"$(at "${@:2}")\" | split(\" \") | map(tonumber))] | transpose | all((.[0] - .[1] | fabs) < 0.002)"
}
write_house 0 1 >house.obj
write_house 0 1.5 >higher.obj
write_house 10 1 >neighbour.obj

# ---- bake -----------------------------------------------------------------------------------------------------------
claim "coordinates of maps get an origin near the mesh and keep the tolerance"
finds '.max_error <= 0.001 and .max_error > 0 and .warnings == [] and .closed and .triangles == 16' bake house.obj -o house.espl --tolerance 1mm
err_has "origin: " " of the source is 0 0 0 of the blob"
json '.source_origin as [$x, $y, $z] | ($x - 500128 | fabs) < 16 and ($y - 5400325 | fabs) < 16 and ($z - 616 | fabs) < 16'
json '.bounds.min[0] > -16 and .bounds.max[0] < 16 and .extent > 9.99 and .extent < 10.01'

claim "a mesh near 0 gets none"
finds 'has("source_origin") | not' bake box.obj -o x.espl --tolerance 1mm
err_lacks "origin: "

claim "a mesh far away gets one also where float32 holds its numbers, since it does not hold places near them"
x=500123.5 y=5400321.5 z=612.25 write_house 0 1 >whole.obj
finds '.source_origin' bake whole.obj -o whole.espl --tolerance 1mm
run 0 query whole.espl ray 500128.507 5400325.503 700 0 0 -1 --json
json '.point[0] == 500128.507 and .point[1] == 5400325.503 and (.point[2] - 619.2474 | fabs) < 0.002'
finds '.source_origin' bake whole.obj -o whole.esps --instances all --tolerance 1mm
run 0 query whole.esps ray 500128.507 5400325.503 700 0 0 -1 --json
json '(.point[2] - 619.2474 | fabs) < 0.002'

claim "without an origin the bake warns that float32 is coarser than the lattice and reports the whole error"
finds '.warnings[0].kind == "step_below_float_spacing" and (has("source_origin") | not)' bake house.obj -o none.espl --step 2^-10 --origin none
err_has "finer than the spacing of float32 this far from the origin"
json '.max_error > 0.02'
run 3 bake house.obj -o refused.espl --step 2^-10 --origin none --strict
absent refused.espl

claim "an origin may be given, also with units and below 0"
finds '.source_origin == [500000, 5400000, 0] and .max_error <= 0.001' bake house.obj -o given.espl --tolerance 1mm --origin 500000,5400000,0
finds '.source_origin == [500000, 5400000, 600]' bake house.obj -o x.espl --tolerance 1mm --origin 500km,5400km,60000cm
finds '.source_origin == [-0.5, 2, -3]' bake box.obj -o x.espl --origin -0.5,2,-3
json '.bounds == {"min": [0.5, -2, 3], "max": [1.5, 0, 6]}'
run_each 1 "bake house.obj -o refused.espl --origin" 1,2 1,2,3,4 here 1,2,wide 1,2, nan,0,0
refuses 1 "--origin: 'here' is none of auto, none and X,Y,Z" bake house.obj -o refused.espl --origin here
absent refused.espl

claim "--expect-size compares the numbers of the file, which float32 would round by half a metre"
run 0 bake house.obj -o x.espl --tolerance 1mm --expect-size 10m..10m
refuses 3 "the asset is 10 m across" bake house.obj -o x.espl --tolerance 1mm --expect-size 10.01m..11m
run 3 bake house.obj -o x.espl --tolerance 1mm --expect-size 9m..9.99m
run 0 bake house.obj -o x.espl --tolerance 1mm --unit cm --expect-size 10cm..10cm

claim "what is picked has the origin as well"
finds '.source_origin and .max_error <= 0.001 and .picked' bake house.obj -o x.espl --max-error 1mm
finds '.source_origin and .bytes <= 800' bake house.obj -o x.espl --max-bytes 800
run 0 trade house.obj --bits 12,22 --leaf-sizes 4 --profiles fast --rays 100 --repetitions 1 --json
json '[.points[] | select(.bits == 22) | .max_error < 1e-5 and .mean_error < 1e-5 and .triangles_per_ray > 0.1] | length > 0 and all'

# ---- what is in it --------------------------------------------------------------------------------------------------
claim "info and dump have the origin"
prints "source origin" info house.espl
finds '.source_origin and .features == ["closed", "source_origin"] and .sections.source_origin == 24 and .format_version == "2.2"' info house.espl
finds '.source_origin == [500000, 5400000, 0]' info given.espl
prints "source origin 500000 5400000 0 of the source is 0 0 0 of the blob" info given.espl
prints "x of the source where the blob has 0: 5" dump given.espl
dumps_all house.espl
run 0 verify house.espl --deep

claim "verify measures from the numbers of the file"
for blob in house given; do
    finds '.ok and .source.checked == 10 and .source.worst_distance <= 0.001 and .source.measuring_error < 1e-6' verify $blob.espl --source house.obj
done
finds '.ok and .source.worst_distance > 0.02' verify none.espl --source house.obj
fails 3 '.source.too_far == 5 and .source.worst_distance > 9' verify house.espl --source neighbour.obj
awk '/^v/ { $2 += 0.003 } { print }' OFMT=%.4f CONVFMT=%.4f house.obj >moved.obj
fails 3 '.source.too_far > 0 and .source.worst_distance > 0.0025 and .source.worst_distance < 0.0035' verify house.espl --source moved.obj

claim "the reordered source keeps its numbers"
for ending in obj ply; do
    run 0 bake house.obj -o x.espl --tolerance 1mm --reorder house_reordered.$ending
    finds '.ok and .source.worst_distance <= 0.001' verify house.espl --source house_reordered.$ending
done
grep -q "property double x" house_reordered.ply || fail "no PLY of float64"
grep '^v' house_reordered.obj | sort >found
grep '^v' house.obj | sed 's/0*$//' | sort >expected
[ "$(awk '{ print $2 + 0 }' CONVFMT=%.4f OFMT=%.4f found | sort)" = "$(awk '{ print $2 + 0 }' OFMT=%.4f expected | sort)" ] ||
    fail "$(diff found expected)"

# ---- queries --------------------------------------------------------------------------------------------------------
for blob in house given; do
    claim "queries of $blob.espl take and print places of the source"
    # shellcheck disable=SC2046  # words
    finds '.hit | not' query $blob.espl ray $(at 10.2 -5 2) 0 1 0
    # shellcheck disable=SC2046
    run 0 query $blob.espl ray $(at 9.8 -5 2) 0 1 0 --json
    json '.hit and .normal == [0, -1, 0] and .t > 4.998 and .t < 5.002'
    near .point 9.8 0 2
    # shellcheck disable=SC2046
    run 0 query $blob.espl ray $(at 5 4 100) 0 0 -1 --json
    near .point 5 4 7
    # shellcheck disable=SC2046
    prints "point 50012" query $blob.espl ray $(at 5 4 100) 0 0 -1
    # shellcheck disable=SC2046
    run 0 query $blob.espl segment $(at 3 -2 1) $(at 3 2 1) --json
    near .point 3 0 1
    json '.t > 0.499 and .t < 0.501'
    # shellcheck disable=SC2046
    run 0 query $blob.espl closest-point $(at 10.5 4 2) --json
    near .point 10 4 2
    json '.distance > 0.498 and .distance < 0.502'
    # shellcheck disable=SC2046
    run 0 query $blob.espl closest-point-segment $(at 11 4 1) $(at 12 4 1) --json
    near .on_shape 11 4 1
    near .point 10 4 1
    # shellcheck disable=SC2046
    finds '.distance < -0.998' query $blob.espl signed-distance $(at 5 4 1)
    # shellcheck disable=SC2046
    prints "inside" query $blob.espl contains $(at 5 4 1)
    # shellcheck disable=SC2046
    prints "outside" query $blob.espl contains $(at 10.1 4 1)
    # shellcheck disable=SC2046
    finds '.winding > 0.9' query $blob.espl winding-number $(at 5 4 1) 64
    # shellcheck disable=SC2046
    finds '.overlaps' query $blob.espl sphere $(at 10.1 4 1) 0.11 --any
    # shellcheck disable=SC2046
    finds '.overlaps | not' query $blob.espl sphere $(at 10.1 4 1) 9cm --any
    # shellcheck disable=SC2046
    finds '.overlaps' query $blob.espl box $(at 9.9 3 1) $(at 10.1 4 2) --any
    # shellcheck disable=SC2046
    finds '.overlaps | not' query $blob.espl oriented-box $(at 10.2 4 2) 0.15 0 0 0 0.2 0 0 0 0.3 --any
    # shellcheck disable=SC2046
    finds '.overlaps' query $blob.espl oriented-box $(at 10.2 4 2) 0.25 0 0 0 0.2 0 0 0 0.3 --any
    # shellcheck disable=SC2046
    finds '.overlaps' query $blob.espl cone $(at 11 4 2) -1.1 0 0 0.1 --any
    # shellcheck disable=SC2046
    finds '.overlaps | not' query $blob.espl cone $(at 11 4 2) -0.9 0 0 0.1 --any
    # All that is east of a plane: x >= that of the eastern wall, less or more 5 mm.
    finds '.count > 0' query $blob.espl convex-volume -1 0 0 "-$(at 9.995 0 0 | cut -d' ' -f1)"
    finds '.count == 0' query $blob.espl convex-volume -1 0 0 "-$(at 10.005 0 0 | cut -d' ' -f1)"
    # shellcheck disable=SC2046
    run 0 query $blob.espl sweep-sphere $(at 12 4 2) 0.5 -4 0 0 --json
    json '.t > 0.374 and .t < 0.376'
    near .point 10 4 2
    # shellcheck disable=SC2046
    run 0 query $blob.espl contacts-sphere $(at 10.4 4 2) 0.5 0 --json
    near '.touches[0].point' 10 4 2
    # shellcheck disable=SC2046
    fails 6 '.error.message | contains("radius is -1")' query $blob.espl sphere $(at 0 0 0) -1
    finds '.box.min[0] > 500123 and .box.max[1] < 5400330' query $blob.espl bounds
    near .box.min 0 0 0
    finds '.origin[0] > 500123' query $blob.espl lattice
    near .origin 0 0 0
    # shellcheck disable=SC2046
    run 0 query $blob.espl to-lattice $(at 10 8 7) --json
    near .point 10 8 7
    finds '[.triangles[] | .a, .b, .c | .[0]] | min > 500123.45 and max < 500133.46' query $blob.espl triangles
    finds '[.nodes[].children[].box.min[1]] | min > 5400321' query $blob.espl tree
done

claim "a printed place is the same place in the blob again"
# shellcheck disable=SC2046
run 0 query house.espl ray $(at 9.3 -5 2) 0.1 1 0.3
place=$(sed -n 's/^ *point //p' out)
# shellcheck disable=SC2086
finds '.distance < 1e-5' query house.espl closest-point $place

claim "two blobs are placed by the difference of their origins"
run 0 bake neighbour.obj -o neighbour.espl --tolerance 1mm
finds '.overlaps' query house.espl overlaps neighbour.espl
for other in neighbour given; do
    run 0 query house.espl distance $other.espl --move 0 20 0 --json
    json '.found and .distance > 11.99 and .distance < 12.01 and .on_a[1] > 5400329 and .on_b[1] > 5400341'
done
# A quarter turn about z moves the house by its distance from 0: back over itself by the way between.
run 0 query house.espl distance given.espl --rotate 0 0 1 0 --move "$(awk "BEGIN { printf \"%.4f\", 2 * $x + 10 }")" \
    "$(awk "BEGIN { printf \"%.4f\", 2 * $y + 8 + 20 }")" 0 --json
json '.found and .distance > 11.9 and .distance < 12.1'

claim "tiles that share vertices share them with an origin each"
for tile in house neighbour; do
    run 0 bake $tile.obj -o tile_$tile.espl --step 2^-12 --json
    json .source_origin
    run 0 query tile_$tile.espl triangles --json
    command -v jq >/dev/null && jq -c '.triangles[] | .a, .b, .c | select((.[0] - 500133.4567 | fabs) < 0.01)' out | sort -u >corners_$tile
done
same corners_house corners_neighbour

# ---- meshes that change, and scenes ---------------------------------------------------------------------------------
claim "a deformable blob takes an origin and a range and poses in the coordinates of the source"
# shellcheck disable=SC2046
run 0 bake house.obj -o soft.espl --deformable --bits 16 --origin 500128,5400325,612 --range $(at -5 -5 -5) $(at 15 13 15) --poses higher.obj --json
json '.source_origin == [500128, 5400325, 612] and .max_error < 0.001 and .motion.range.max[0] < 16'
run 0 refit soft.espl higher.obj -o higher.espl
run 0 verify higher.espl --deep --source higher.obj
# shellcheck disable=SC2046
run 0 query higher.espl ray $(at 5 4 100) 0 0 -1 --json
near .point 5 4 10.5
finds 'has("source_origin") | not' bake house.obj -o x.espl --deformable
awk '/^v/ { $2 += 20 } { print }' CONVFMT=%.4f OFMT=%.4f house.obj >gone.obj
refuses 3 "vertex 0 is at 500143.45" refit soft.espl gone.obj -o refused.espl
absent refused.espl

claim "a scene keeps an origin, and its queries take places of the source"
run 0 bake house.obj neighbour.obj -o houses.esps --instances all --origin none
for origin in auto 500000,5400000,0; do
    finds '.source_origin and .total_error < 0.001' bake house.obj neighbour.obj -o houses.esps --instances all --tolerance 1mm --origin "$origin"
    finds '.source_origin' info houses.esps
    # shellcheck disable=SC2046
    run 0 query houses.esps ray $(at 5 4 100) 0 0 -1 --json
    near .point 5 4 7
    run 0 verify houses.esps --deep --source house.obj --source neighbour.obj
done
finds '.warnings[] | select(.kind == "step_below_float_spacing") | .message | contains("instance 0")' \
    bake house.obj neighbour.obj -o houses.esps --instances all --tolerance 1mm --origin 0,0,5000

finish
