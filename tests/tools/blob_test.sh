#!/usr/bin/env bash
# Tests of `espalier info` and `verify`, and of the ways back to the source.
# Usage: blob_test.sh PATH_TO_ESPALIER
# shellcheck source=meshes.sh
. "$(dirname "$0")/meshes.sh"

# ---- info, verify ---------------------------------------------------------------------------------------------------
claim "info tells what is inside, for people and for scripts"
run 0 info sheet.espl
out_has "format" "triangles     3200" "vertices" "lattice" "max error" "original_ids, materials_8" "depth" "checksum" "nodes" \
    "leaves" "guard" "sources" "per triangle"
run 0 info sheet.espl --json
for key in schema format_version triangles vertices bytes bytes_per_triangle sections bits step extent max_error depth profile \
    checksum bounds nodes leaves features closed; do
    out_has "\"$key\": "
done
out_has '"format_version": "2.' "\"bytes\": $(stat -c %s sheet.espl)"

claim "info --histogram prints how good a tree is, of a blob and of each mesh of a scene"
run 0 info sheet.espl --histogram
out_has "areas so far" "all " "a random line through the whole box" "leaves at depth" "children a node" "triangles in a leaf" "####"
run 0 info sheet.espl --histogram --json
for key in tree_quality levels node_areas shared_areas leaf_depth leaf_sizes; do
    out_has "\"$key\": "
done
run 0 info sheet.espl
if grep -qF "areas so far" out; then fail "info prints a histogram without being asked"; fi

claim "edge flags and bounds are there on request, and the report tells how much space the bounds take"
reports "volume: axis-aligned box " bake sheet.obj -o extras.espl --flat-angle 5 --bounds obb,sphere,kdop
err_has "oriented box " "26-DOP "
prints "flat angle    5 degrees" info extras.espl
prints '"volumes": {' bake sheet.obj -o extras5.espl -q --flat-angle 5 --bounds sphere --bounds kdop,obb --json
same extras.espl extras5.espl
run 0 verify extras.espl --deep
run 0 info extras.espl
out_has "format        2.0" "edge_flags, oriented_box, bounding_sphere, k_dop" "half axis" "radius"
run 0 info extras.espl --json
for key in oriented_box half_axes sphere radius k_dop direction; do
    out_has "\"$key\": "
done
run 0 dump extras.espl
out_has "squared sine of what is flat: 127441 / 2^24" "quaternion w x y z" "radius, in steps / 16" "along 1 -1 -1: low and high"

claim "info has the flat angle of edge flags in degrees, as it was given to the bake"
for angle in 0 0.1 7.25 30 45 89.5; do
    run 0 bake box.obj -o angle.espl -q --flat-angle $angle
    finds ".flat_angle == $angle" info angle.espl
done
finds 'has("flat_angle") | not' info box.espl
run 0 bake box.obj far_box.obj -o angle.esps -q --flat-angle 5 --instances all
prints ", flat angle 5 degrees" info angle.esps
finds '.meshes[0].flat_angle == 5' info angle.esps

claim "verify accepts what bake wrote, deep and against its source"
prints "ok, 3200 triangles" verify sheet.espl --deep --source sheet.obj
run 0 verify two.espl --deep --source box.obj far_box.obj
prints '"ok": true' verify box.espl --deep --json
out_has '"deep": true'
run 0 bake box.obj -o inches.espl --unit in --up z
run 0 verify inches.espl --source box.obj --unit in --up z

claim "verify names a box that ends far from the asset, which only --deep asks about"
run 0 bake sheet.obj -o near.espl --profile balanced
{ head -c 12 near.espl; printf '\0\0\0\0'; tail -c +17 near.espl | head -c 152; printf '\377'; tail -c +170 near.espl; } >unsigned.espl
{ head -c 12 unsigned.espl; gzip -c unsigned.espl | tail -c 8 | head -c 4; tail -c +17 unsigned.espl; } >far.espl # CRC-32
run 0 verify near.espl --deep
run 0 verify far.espl
refuses 3 "node 0 (byte 128) has a box that ends too far beyond the asset: on x" verify far.espl --deep
err_has ". Bake it again."

claim "verify refuses another source, or the same in another unit"
refuses 3 "farther from the baked surface" verify sheet.espl --source far_box.obj
run 3 verify inches.espl --source box.obj
run 3 verify empty.espl --source box.obj
run 2 verify box.espl --source missing.obj

claim "verify compares triangles: a source with the same vertices and other triangles is another one"
square=$(printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1')
write_square() { printf '%s\n' "$square" && printf 'f %s\n' "$@"; }
write_square "1 2 3" "1 3 4" >square.obj
write_square "1 2 3" >half.obj
write_square "1 2 3" "2 3 4" >diagonal.obj
write_square "1 2 3" "1 4 3" >turned.obj
write_square "1 2 3" "1 3 4" "1 2 4" >third.obj
run 0 bake square.obj -o square.espl -q
run 0 verify square.espl --source square.obj
out_has "the source and the blob have the same 2 triangles"
refuses 3 "'square.espl': 1 of 2 triangles of the blob is not in the source, the first: triangle " verify square.espl --source half.obj
refuses 3 "1 of 3 triangles of the source is not in the blob, the first: third.obj, mesh 0, triangle 2" verify square.espl --source third.obj
for other in diagonal turned; do
    fails 3 '.source.triangles_missing == 1 and .source.triangles_without_source == 1 and .source.too_far == 0' verify square.espl --source $other.obj
    json ".error.file == \"$other.obj\" and .error.mesh == 0 and .error.triangle == 1"
done
sed 's/^f 1 3 4/f 1 3 2/' box.obj >folded.obj
fails 3 '.source.triangles_missing == 1 and .source.triangles == 24 and .error.file == "folded.obj"' verify box.espl --source box.obj folded.obj

claim "verify takes triangles as dropped that a bake drops, and counts them"
write_square "1 2 3" "1 3 4" "2 2 3" "3 1 2" "1 2 5" >flat.obj
sed -i 's/^v 0 0 1$/v 0.5 0.00001 0/' flat.obj # too near to an edge for a lattice of 8 bits
run 0 bake flat.obj -o flat.espl -q --bits 8 --max-dropped 90
finds '.source.triangles_dropped == {"not_finite": 0, "index_out_of_range": 0, "zero_area": 1, "collapsed": 1, "duplicate": 1}' verify flat.espl --source flat.obj
printf 'v nan 0 0\nf 6 1 2\nf 1 2 99\n' | cat square.obj - >broken.obj
run 0 bake broken.obj -o broken.espl -q --drop-bad-triangles --max-dropped 90
finds '.source.triangles_dropped | .not_finite == 1 and .index_out_of_range == 1' verify broken.espl --source broken.obj
prints "dropped: 1 triangle that the lattice flattened to no area" verify flat.espl --source flat.obj

claim "verify finds triangles of a source that was written with fewer digits"
awk '/^v/ { printf "v %.3f %.3f %.3f\n", $2 + 0.0004, $3, $4; next } { print }' sheet.obj >rewritten.obj
run 0 bake sheet.obj -o coarse.espl -q --bits 8
run 0 verify coarse.espl --source rewritten.obj
run 3 verify sheet.espl --source rewritten.obj

claim "a blob that is cut short, changed, newer or none at all is refused by every verb, and the status says why"
size=$(stat -c %s sheet.espl)
head -c $((size - 1)) sheet.espl >short.espl
{ cat sheet.espl; printf 'x'; } >long.espl
{ head -c 4 sheet.espl; printf '\011\000'; tail -c +7 sheet.espl; } >newer.espl
: >none.espl
for verb in info verify dump "query|ray 0 0 0 1 0 0" render; do
    for blob in short stub long changed none; do
        case $verb in
            query*) arguments="query $blob.espl ${verb#*|}" ;;
            render) arguments="render $blob.espl -o refused.png" ;;
            *) arguments="$verb $blob.espl" ;;
        esac
        # shellcheck disable=SC2086
        refuses 3 "'$blob.espl' is refused: " $arguments
    done
done
absent refused.png
run 5 info newer.espl
run 5 verify newer.espl --json
out_has '"ok": false' '"status": 4'
refuses 3 "espalier bake" info box.obj
run 2 info missing.espl
run 2 info .
run 3 verify changed.espl --deep --json
out_has '"ok": false'

claim "blobs and junk may come through a pipe"
if on_windows; then input=-; else input=/dev/stdin; fi
"$espalier" info $input <sheet.espl >out 2>err || fail "redirected blob"
cat sheet.espl | "$espalier" info $input >out 2>err || fail "piped blob"
out_has "triangles     3200"
awk 'BEGIN { for (i = 0; i < 9999; ++i) printf "junk" }' | "$espalier" info $input >out 2>err
[ $? = 3 ] || fail "piped junk is not exit status 3"

# ---- which triangle was that ----------------------------------------------------------------------------------------
claim "a remap file and a source in the blob's order lead back without ids in the blob"
run 0 bake sheet.obj -o lean.espl --profile small
makes lean.espl lead.espl bake sheet.obj -o lead.espl --profile small --remap order.bin --reorder order.ply
[ "$(head -c 4 order.bin)" = ESPR ] || fail "a remap file begins otherwise"
triangles=$(("($(stat -c %s order.bin) - 16) / 16"))
grep -aq "element face $triangles" order.ply || fail "the reordered source has other triangles than the remap file"
run 0 bake sheet.obj -o lead.espl --profile small --reorder order.obj
[ "$(grep -c '^f ' order.obj)" = "$triangles" ] || fail "an OBJ in the blob's order has other triangles than a PLY"
# The first triangle of the blob, corner for corner.
for corner in 2 3 4; do
    vertex=$(grep -m 1 '^f ' order.obj | cut -d ' ' -f $corner)
    grep '^v ' order.obj | sed -n "${vertex}p" | cut -d ' ' -f 2-
done >corners
run 0 query lead.espl show 0 --json
if command -v jq >/dev/null; then
    jq -r '[.a, .b, .c][] | join(" ")' out | paste -d ' ' - corners |
        awk '{ for (i = 1; i < 4; ++i) if (($i - $(i + 3)) ^ 2 > 1e-6) exit 1 } END { if (NR != 3) exit 1 }' ||
        fail "the first triangle of the reordered source is not the blob's"
fi
run 1 bake sheet.obj -o lead.espl --reorder order.stl
run 1 bake sheet.obj -o lead.espl --remap same.bin --reorder same.bin

claim "no output replaces a file that is read, and empty values are refused"
printf 'mtllib own.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n' >own.obj
printf 'newmtl red\nKd 1 0 0\n' >own.mtl
for output in -o --remap --depfile; do
    others="-o own.espl"
    [ "$output" != -o ] || others=
    # shellcheck disable=SC2086  # words
    refuses 1 "'own.mtl' is the input" bake own.obj $others $output own.mtl
    err_has "Give another name to $output"
done
run 0 bake own.obj -o own.espl -q
run 1 bake own.obj -o new.espl --lattice-of own.espl --remap own.espl
for option in --step --lattice-of --remap --reorder; do
    run 1 bake own.obj -o new.espl "$option" ""
done
absent new.espl
printf 'v 0 0 0\nv nan 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\nf 1 4 3\n' >half.obj
run 0 bake half.obj -o half.espl -q --drop-bad-triangles --max-dropped 50% --reorder whole.obj
! grep -qi nan whole.obj || fail "the reordered source has a vertex that no triangle uses"
run 1 bake sheet.obj -o lead.espl --remap sheet.obj

finish
