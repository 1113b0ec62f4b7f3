#!/usr/bin/env bash
# Tests of deformable blobs: `espalier bake --deformable` and `espalier refit`, and what other verbs print of such blobs.
# Usage: deformable_test.sh PATH_TO_ESPALIER
# shellcheck source=meshes.sh
. "$(dirname "$0")/meshes.sh"

# ---- meshes ---------------------------------------------------------------------------------------------------------
# A square cloth of 2 * 24 * 24 triangles in the plane z = 0, from 0 0 0 to 1 1 0, bent by a function of x, y and z in awk.
# The first vertex and the last are of no triangle, and the faces are in two groups, of which the second names earlier
# vertices than the first.
write_cloth() { # FUNCTION
    awk 'function deform() { '"$1"' }
        BEGIN { n = 24; m = (n + 1) * (n + 1); print "v 0.5 0.5 0"
            for (k = 0; k < m; ++k) { place = k; scramble = 0; deform(); if (scramble) place = k * 97 % m
                x = place % (n + 1) / n; y = int(place / (n + 1)) / n; z = 0; deform()
                printf "v %.9g %.9g %.9g\n", x, y, z }
            print "v 0.5 0.25 0"
            for (half = 1; half >= 0; --half) { print "g half" half
                for (i = half * n / 2; i < (half + 1) * n / 2; ++i) for (j = 0; j < n; ++j) { a = i * (n + 1) + j + 2
                    printf "f %d %d %d\nf %d %d %d\n", a, a + 1, a + n + 2, a, a + n + 2, a + n + 1 } } }'
}
write_cloth '' >cloth.obj
write_cloth 'z = 0.25 * sin(6 * x); x = 0.9 * x' >wave.obj
write_cloth 'r = x; x = 0.2 + 0.5 * sin(r); z = 0.3 - 0.3 * cos(r)' >bend.obj
write_cloth 'z = 0; x = 0.5; y = 0.5' >point.obj
write_cloth 'scramble = 1' >scrambled.obj
range=(-0.5 -0.5 -0.5 1.5 1.5 0.5)
bake_cloth() { run 0 bake cloth.obj -o "$1" --deformable --range "${range[@]}" "${@:2}"; }
bake_cloth cloth.espl

# ---- bake -----------------------------------------------------------------------------------------------------------
claim "a deformable bake keeps all vertices in the order of the file as one mesh"
bake_cloth x.espl --json
json '.source_vertices == 627 and .motion.positions == 627 and .inputs[0].meshes == 1 and .inputs[0].mesh_names == [""]'
json '.inputs[0].points_and_lines == 0 and .triangles == 1152 and .profile == "fast" and .deformable'
same x.espl cloth.espl
finds '.source_vertices == 650 and .inputs[0].meshes == 2 and (.deformable | not) and (has("motion") | not)' bake cloth.obj -o x.espl

claim "the report of a bake has the range and the positions and the bytes that move"
bake_cloth x.espl --json
err_has "motion: 627 positions in the range -0.5 -0.5 -0.5 to 1.5 1.5 0.5; "
err_has " bytes move, "
json '.bounds == {"min": [0, 0, 0], "max": [1, 1, 0]}'
json '.motion.range == {"min": [-0.5, -0.5, -0.5], "max": [1.5, 1.5, 0.5]} and .motion.moving_bytes_per_triangle < 11'

claim "without a range it is the box around the mesh and the poses with a tenth on each side"
finds '.motion.range.min[0] <= -0.1 and .motion.range.min[2] > -0.101 and .motion.range.max[2] < 0.101' bake cloth.obj -o x.espl --deformable
finds '.motion.range.min[2] <= -0.34 and .motion.range.max[2] >= 0.34' bake cloth.obj -o x.espl --deformable --poses wave.obj bend.obj

claim "a range grows to hold the mesh and the poses"
run 0 bake cloth.obj -o x.espl --deformable --range 0 0 0 0.5mm 1cm 0 --poses wave.obj --json
json '.motion.range.min[0] == 0 and .motion.range.max[0] >= 1 and .motion.range.min[2] < -0.2'

claim "poses change the tree"
bake_cloth posed.espl --poses wave.obj bend.obj scrambled.obj
cmp -s posed.espl cloth.espl && fail "the poses changed nothing"
bake_cloth x.espl --poses wave.obj --poses bend.obj --poses scrambled.obj
same x.espl posed.espl

claim "PLY has the vertices in its order as OBJ has"
{
    printf 'ply\nformat ascii 1.0\nelement vertex 627\nproperty float x\nproperty float y\nproperty float z\n'
    printf 'element face 1152\nproperty list uchar int vertex_indices\nend_header\n'
    sed -n 's/^v //p' cloth.obj
    awk '/^f/ { print 3, $2 - 1, $3 - 1, $4 - 1 }' cloth.obj
} >cloth.ply
finds '.inputs[0].points_and_lines == 0' bake cloth.ply -o x.espl --deformable --range "${range[@]}" --poses wave.obj
bake_cloth y.espl --poses wave.obj
same x.espl y.espl

claim "formats without an order of vertices are refused"
write_box_collada "" 1 Y_UP >box.dae
printf '0 0 0 1 0 0 0 1 0\n' >triangle.raw
for mesh in box.stl triangle.raw box.dae; do
    refuses 5 "'$mesh' is read without the order of its vertices" bake $mesh -o refused.espl --deformable --json
    err_has "Export it as OBJ, OFF, PLY, 3MF or glTF."
    json ".error.file == \"$mesh\""
    refuses 5 "'$mesh'" bake box.obj -o refused.espl --deformable --poses $mesh
    refuses 5 "'$mesh'" refit cloth.espl $mesh -o refused.espl
done
absent refused.espl

claim "options that exclude a deformable blob are refused by name with what to do"
excluded() { # WORDS_ON_STDERR OPTION...
    refuses 1 "--deformable excludes $1" bake cloth.obj -o refused.espl --deformable "${@:2}"
    absent refused.espl
}
for profile in balanced small tiny; do
    excluded "--profile $profile: the leaves of a deformable blob keep their size" --profile $profile
done
excluded "--builder spatial_splits" --builder spatial_splits
excluded "--drop-bad-triangles" --drop-bad-triangles
excluded "--flat-angle" --flat-angle 5
excluded "--bounds" --bounds sphere
excluded "--instances" --instances auto
bake_cloth x.espl --profile fast --builder sweep_sah --ids --materials
refuses 1 "--range needs --deformable" bake cloth.obj -o refused.espl --range 0 0 0 1 1 1
refuses 1 "--poses needs --deformable" bake cloth.obj -o refused.espl --poses wave.obj

claim "a range that is no box is refused"
run 1 bake cloth.obj -o refused.espl --deformable --range 0 0 0 1 1
run 1 bake cloth.obj -o refused.espl --deformable --range 0 0 0 1 1 1 --range 0 0 0 1 1 1
refuses 1 "--range: 'wide' is no length" bake cloth.obj -o refused.espl --deformable --range 0 0 0 1 1 wide
refuses 1 "--range: it goes from 0 to -1 on y" bake cloth.obj -o refused.espl --deformable --range 0 0 0 1 -1 1
refuses 1 "'1e39'" bake cloth.obj -o refused.espl --deformable --range 0 0 0 1 1 1e39
run 1 bake point.obj -o refused.espl --deformable --range 0 0 0 1 1 nan
grep '^v' cloth.obj >vertices.obj
run 3 bake vertices.obj -o refused.espl --deformable
absent refused.espl

claim "a deformable bake of a broken mesh names the place and does not offer to drop triangles"
sed '1s/.*/v 0.5 nan 0.5/' cloth.obj >unused_nan.obj
refuses 3 "unused_nan.obj, mesh 0, vertex 0 has y = NaN" bake unused_nan.obj -o refused.espl --deformable
err_lacks "drop"
sed '30s/.*/v 0.5 inf 0.5/' cloth.obj >used_nan.obj
refuses 3 "y = infinity" bake used_nan.obj -o refused.espl --deformable
err_lacks "drop"
absent refused.espl

claim "a pose with another number of vertices is refused with both numbers and both files"
sed '7d' cloth.obj >short.obj
run 3 bake cloth.obj -o refused.espl --deformable --poses wave.obj short.obj --json
err_has "the pose 'short.obj' has 626 vertices, and the mesh 'cloth.obj' has 627."
err_lacks "drop"
json '.error.file == "short.obj"'

claim "a pose that is not finite is refused with its file and the vertex"
sed '30s/.*/v 0.5 0.5 -inf/' wave.obj >infinite.obj
refuses 3 "infinite.obj, mesh 0, vertex 29 has z = -infinity." bake cloth.obj -o refused.espl --deformable --poses wave.obj infinite.obj --json
err_lacks "drop"
json '.error.file == "infinite.obj" and .error.mesh == 0'
refuses 2 "missing.obj" bake cloth.obj -o refused.espl --deformable --poses missing.obj
absent refused.espl

claim "unit and scale and axis apply to the poses as to the mesh"
transformed=(--unit mm --scale 2 --up z)
run 0 bake cloth.obj -o small.espl --deformable --poses wave.obj "${transformed[@]}" --json
json '.bounds.max[0] < 0.0021 and .motion.range.max[0] < 0.0025 and .motion.range.max[1] > 0.0005 and .motion.range.max[1] < 0.001'
json '.motion.range.min[2] < -0.002'

claim "a pose without faces is one, and is listed in the depfile, and no output replaces it"
grep '^v' wave.obj >wave_vertices.obj
bake_cloth x.espl --poses wave_vertices.obj --depfile x.d
bake_cloth y.espl --poses wave.obj
same x.espl y.espl
grep -q 'wave_vertices\.obj' x.d || fail "x.d: $(cat x.d)"
refuses 1 "which it would replace" bake cloth.obj -o wave_vertices.obj --deformable --poses wave_vertices.obj

claim "what is picked within a number of bytes is deformable as well"
bake_cloth x.espl --max-bytes 16K --json
json '.deformable and .profile == "fast" and .bytes <= 16384 and ([.picked.tried[].profile] | unique == ["fast"])'

# ---- refit ----------------------------------------------------------------------------------------------------------
claim "a refit to the pose of the bake gives the baked bytes"
run 0 refit cloth.espl cloth.obj -o x.espl
[ ! -s out ] || fail "stdout is not empty"
err_has "bounds: 0 0 0 to 1 1 0" "quality: an average ray costs 1 times as much as at rest" "wrote x.espl"
same x.espl cloth.espl
makes x.espl posed.espl refit posed.espl cloth.obj -o x.espl
makes x.espl cloth.espl refit cloth.espl cloth.ply -o x.espl

claim "a refitted blob is sound and lies within its error of the pose"
for pose in wave bend point scrambled; do
    for blob in cloth posed; do
        run 0 refit $blob.espl $pose.obj -o $blob.$pose.espl -q
        case $pose in
            wave | bend) [ ! -s err ] || fail "something was said: $(cat err)" ;;
        esac
        run 0 verify $blob.$pose.espl --deep --source $pose.obj
    done
    cmp -s cloth.$pose.espl cloth.espl && fail "the refit to $pose changed nothing"
done
run 3 verify cloth.wave.espl --source cloth.obj

claim "the same pose by another path gives the same bytes"
for step in bend point scrambled cloth; do
    makes x.espl cloth.wave.espl refit cloth.$step.espl wave.obj -o x.espl -q
    [ $step != scrambled ] || run 0 refit cloth.wave.espl cloth.obj -o cloth.cloth.espl -q
done
same cloth.cloth.espl cloth.espl

claim "a refit reports its figures as JSON"
run 0 refit cloth.espl wave.obj -o x.espl --json -q
json '.file == "cloth.espl" and .pose == "wave.obj" and .output == "x.espl" and .positions == 627 and .warnings == []'
json '.bounds.min[2] < -0.2 and .bounds.max[0] <= 0.9001 and .quality > 0.5 and .quality < 1.5'

claim "a pose that costs much more than the baked ones gets the advice to bake it in, and strict refuses it"
reports "warning: scrambled.obj: in this pose the tree costs an average ray " refit cloth.espl scrambled.obj -o x.espl --json
err_has "Bake the blob once with this pose among --poses"
json '.quality >= 1.5 and .warnings[0].kind == "costly_pose" and .warnings[0].file == "scrambled.obj"'
fails 3 '.error.kind == "strict" and .warnings[0].kind == "costly_pose"' refit cloth.espl scrambled.obj -o refused.espl --strict
absent refused.espl
run 0 refit posed.espl wave.obj -o x.espl --strict
err_lacks "warning"

claim "a refit takes unit and scale and axis as the bake did"
makes x.espl small.espl refit small.espl cloth.obj -o x.espl "${transformed[@]}"
run 0 refit small.espl wave.obj -o x.espl "${transformed[@]}"
run 0 verify x.espl --deep --source wave.obj "${transformed[@]}"
refuses 3 "outside of the range of motion" refit small.espl wave.obj -o refused.espl
absent refused.espl

claim "a pose that is refused names the first bad vertex and leaves an output as it is"
refused() { # EXIT_CODE POSE
    cp cloth.wave.espl kept.espl
    run "$1" refit cloth.espl "$2" -o kept.espl --json
    json ".error.file == \"$2\""
    same kept.espl cloth.wave.espl
}
sed '30s/.*/v 0.5 1.625 0.25/; 40s/.*/v 9 9 9/' wave.obj >far.obj
refused 3 far.obj
err_has "far.obj, mesh 0, vertex 29 is at 0.5 1.625 0.25, outside of the range of motion of 'cloth.espl', -0.5 -0.5 -0.5 to 1.5 1.5 0.5."
err_has "Bake it with a larger --range, or with this pose among --poses."
json '.error.kind == "out_of_range" and .error.mesh == 0'
refused 3 infinite.obj
err_has "infinite.obj, mesh 0, vertex 29 has z = -infinity."
json '.error.kind == "invalid_input" and .error.mesh == 0'
sed '627s/.*/v nan 0 0/' wave.obj >last.obj
refused 3 last.obj
err_has "last.obj, mesh 0, vertex 626 has x = NaN."
refused 3 short.obj
err_has "'short.obj' has 626 vertices, and the mesh of 'cloth.espl' has 627."
refused 3 points.obj
refused 2 missing.obj

claim "a refit of what is no deformable blob is refused"
refuses 5 "'sheet.espl' is not deformable. Bake it with 'espalier bake --deformable'." refit sheet.espl sheet.obj -o refused.espl --json
json '.error.kind == "unsupported" and .error.file == "sheet.espl"'
run 3 refit cloth.obj cloth.obj -o refused.espl
run 0 bake box.obj far_box.obj -o boxes.esps --instances all -q
run 5 refit boxes.esps box.obj -o refused.espl
run_each 1 "refit cloth.espl" "-o refused.espl" cloth.obj "cloth.obj -o cloth.espl" "cloth.obj -o cloth.obj"
run 2 refit cloth.espl cloth.obj -o missing/x.espl
absent refused.espl

claim "a blob on the standard input is refitted"
"$espalier" refit - wave.obj -o x.espl -q <cloth.espl || fail "not refitted"
same x.espl cloth.wave.espl

claim "a blob of several files takes the vertices of all in a row"
finds '.motion.positions == 16' bake box.obj far_box.obj -o boxes.espl --deformable
{ grep -h '^v' box.obj far_box.obj; } >boxes.obj
makes x.espl boxes.espl refit boxes.espl boxes.obj -o x.espl
run 3 bake box.obj far_box.obj -o refused.espl --deformable --poses box.obj
err_has "the pose 'box.obj' has 8 vertices, and the mesh 'box.obj', 'far_box.obj' has 16."

# ---- other verbs ----------------------------------------------------------------------------------------------------
claim "info prints how the vertices may move and how large each part is"
run 0 info cloth.wave.espl
out_has "format        2.1, profile fast" "features      deformable" "range         -0.5 -0.5 -0.5 to 1.5 1.5 0.5" \
    "positions     627" "moving bytes  " "per triangle; the rest may stay in flash" "corners " "vertex_sources "
finds '.deformable and .motion.positions == 627 and .motion.range.min == [-0.5, -0.5, -0.5] and .features == ["deformable"]' info cloth.wave.espl
json '.sections.corners == 3 * 1152 + 64 and .sections.vertex_sources >= 2 * 625 and .sections.vertex_sources % 4 == 0'
json '.motion.moving_bytes == .sections.header + .sections.nodes + .sections.leaves + .sections.guard'
json '.bounds.min[2] < -0.2 and .extent <= 1 and .extent > 0.9 and .format_version == "2.1"'
finds '(.deformable | not) and (has("motion") | not) and .format_version == "2.2"' info sheet.espl

claim "dump has every byte of a deformable blob once and in order"
run 0 dump cloth.wave.espl
out_has "positions 627" "vertices of all leaves together " "cost of the tree at rest " "low corner of the pose in steps " \
    "high corner of the pose in steps " "-- corners" "-- vertex_sources" "  corner a: " "positions of leaf 0 of node "
for blob in cloth.wave boxes; do dumps_all $blob.espl; done
awk '/^-- vertex_sources/ { on = 1; next } on && /positions of leaf/ { sub(/.*: */, ""); for (i = 1; i <= NF; ++i) print $i }' \
    <("$espalier" dump boxes.espl --json | jq -r '.lines[] | (.heading // .meaning)' | sed 's/^vertex_sources/-- &/') |
    sort -n | uniq | tr '\n' ' ' >positions
[ "$(cat positions)" = "0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 " ] || fail "the positions are $(cat positions)"

claim "a query of a refitted blob meets the pose"
finds '.hit and .t > 9 - 0.26 and .t < 9 + 0.26' query cloth.wave.espl ray 0.45 0.5 9 0 0 -1
finds '.hit and .t == 9' query cloth.espl ray 0.95 0.5 9 0 0 -1
finds '.hit | not' query cloth.wave.espl ray 0.95 0.5 9 0 0 -1
finds '.hit | not' query cloth.point.espl ray 0.5 0.5 9 0 0 -1
on_windows || run 0 render cloth.wave.espl -o x.png --size 16x16 -q

finish
