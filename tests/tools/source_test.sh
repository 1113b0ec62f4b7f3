#!/usr/bin/env bash
# Tests of what `espalier bake` makes of its sources: units, axes, broken geometry; and of depfiles.
# Usage: source_test.sh PATH_TO_ESPALIER
# shellcheck source=meshes.sh
. "$(dirname "$0")/meshes.sh"

claim "unit, scale and up axis do what they say"
reports "unit: 1 = 0.001 m (--unit)" bake box.obj -o x.espl --unit mm
bounds_near 0 0 0 0.001 0.002 0.003
reports "bounds: 0 0 0 to 10 20 30" bake box.obj -o x.espl --scale 10
run 0 bake box.obj -o x.espl --unit cm --scale 100
bounds_near 0 0 0 1 2 3
reports "bounds: 0 0 -2 to 1 3 0" bake box.obj -o x.espl --up z
err_has "+Z of the input is +Y in the blob"
reports "bounds: -2 0 0 to 0 1 3" bake box.obj -o x.espl --up x
reports "bounds: 0 0 0 to 1 2 3" bake box.obj -o x.espl --up y

claim "an asset of surprising size is warned about, also when quiet"
reports "3000 m across" bake box.obj -o x.espl --scale 1000 -q
reports " m across" bake box.obj -o x.espl --scale 0.0001 -q

claim "node transforms, units and up axes of files are applied"
write_box_collada "<translate>10 20 30</translate><scale>2 2 2</scale>" 1 Y_UP >moved.dae
reports "bounds: 10 20 30 to 12 24 36" bake moved.dae -o moved.espl
write_box_collada "<translate>1 0 0</translate>" 0.01 Y_UP >centimetres.dae
run 0 bake centimetres.dae -o x.espl
bounds_near 0.01 0 0 0.02 0.02 0.03
write_box_collada "" 1 Z_UP >z_up.dae
reports "bounds: 0 0 -2 to 1 3 0" bake z_up.dae -o x.espl

claim "a mirrored mesh keeps its front outside"
write_box_collada "<scale>-1 1 1</scale>" 1 Y_UP >mirrored.dae
reports "bounds: -1 0 0 to 0 2 3" bake mirrored.dae -o mirrored.espl
prints "t 4" query mirrored.espl ray -5 1 1 1 0 0 --culling back
out_has "normal -1 0 0"
prints "t 10" query moved.espl ray 0 21 31 1 0 0 --culling back

claim "several files become one blob, in their order, with distinct materials"
reports "far_box.obj: 12 triangles in 1 mesh" bake box.obj far_box.obj -o two.espl --ids --materials
err_has "bounds: 0 0 0 to 11 2 3"
prints '"file": 0' query two.espl ray -1 1 1 1 0 0 --json
first=$(grep '"material"' out)
prints '"file": 1' query two.espl ray 20 1 1 -1 0 0 --json
[ "$first" != "$(grep '"material"' out)" ] || fail "both files have the material $first"

claim "broken geometry is refused with file, mesh and triangle, unless it is to be dropped; then it is counted"
refuses 3 "'not_finite.obj', line 3: vertex 3, counted from 1, has x = NaN" bake not_finite.obj -o broken.espl
err_has "triangle 1 of mesh 0" "--drop-bad-triangles"
absent broken.espl
run 0 bake not_finite.obj -o x.espl --drop-bad-triangles --max-dropped 50%
err_has "dropped 1 triangle with a corner that is NaN, infinite or beyond float32; first: not_finite.obj, mesh 0"
write_box_ply | sed 's/^3 0 2 3$/3 0 2 300/' >out_of_range.ply
refuses 3 "'out_of_range.ply', line 18: a face names vertex 300" bake out_of_range.ply -o broken.espl
absent broken.espl
reports "dropped 1 triangle with an index out of range" bake out_of_range.ply -o x.espl --drop-bad-triangles --json
out_has '"triangles": 11'

claim "triangles without area and repeated ones are dropped, counted and named"
{ write_box_obj 0; printf 'f 1 1 2\nf 1 3 4\nf 1 3 4\n'; } >untidy.obj
reports "dropped 1 triangle without area; first: untidy.obj, mesh 0" bake untidy.obj -o x.espl --json
err_has "triangle 12"
err_has "dropped 2 triangles with the corners of another one; first: untidy.obj, mesh 0"
out_has '"triangles": 12'

claim "points and lines are skipped and counted; a scene without triangles is an empty blob, and says so"
reports "skipped 2 points and lines" bake points.obj -o empty.espl --allow-empty
err_has "the input has no triangles; the blob is valid and empty"
run 0 verify empty.espl --deep
prints '"triangles": 0' info empty.espl --json
prints "no hit" query empty.espl ray 0 0 0 1 0 0
run 0 query empty.espl closest-point 0 0 0
prints "0 triangles" query empty.espl sphere 0 0 0 inf
run 0 dump empty.espl
reports "no triangles" render empty.espl -o empty.png --size 8x8

claim "triangles with two corners in one point have no surface to lose"
{ write_box_obj 0 && printf 'v 0 0 0\n' && yes 'f 1 1 2' | head -n 20 && yes 'f 1 9 2' | head -n 20; } >folded.obj
finds '.triangles == 12 and .findings.zero_area.count == 40' bake folded.obj -o x.espl --max-dropped 0
run 0 bake folded.obj -o x.espl --max-dropped 0 --max-bytes 10K
{ cat folded.obj && echo 'v 2 0 0' && echo 'f 1 2 10'; } >flat.obj
refuses 3 "dropped 1 of 13 triangles: 1 without area" bake flat.obj -o x.espl --max-dropped 0

claim "a file that is no blob is called none however short it is and a pointer of Git LFS by its name"
echo hello >hello.espl
refuses 3 "not an Espalier blob" info hello.espl
printf 'version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n' >pointer.espl
for verb in info verify dump; do refuses 3 "git lfs pull" $verb pointer.espl; done

claim "what is no mesh is invalid input with the importer's reason; what is not there cannot be read"
echo "not a mesh" >junk.obj
: >nothing.ply
write_box_collada "$(yes '<node>' | head -n 200000)$(yes '</node>' | head -n 200000)" 1 Y_UP >deep.dae # uses up its stack
for mesh in junk.glb nothing.ply deep.dae; do
    refuses 3 "$mesh" bake $mesh -o broken.espl
    absent broken.espl
done
refuses 5 "junk.unknown" bake junk.unknown -o broken.espl # a format without an importer
absent broken.espl
"$espalier" bake junk.obj -o broken.espl 2>/dev/null # a file of unknown lines is an OBJ without faces to some importers
rm -f broken.espl
refuses 2 "cannot read 'missing.obj': No such file or directory" bake missing.obj -o broken.espl
refuses 2 "folder" bake . -o broken.espl
mkfifo pipe.obj
refuses 2 "no pipes or devices" bake pipe.obj -o broken.espl # and does not wait for a writer
run 5 bake box.obj junk.unknown -o broken.espl
absent broken.espl

claim "control characters in names do not reach the terminal"
cp box.obj "$(printf 'red\033[31m.obj')"
run 0 bake "$(printf 'red\033[31m.obj')" -o x.espl
! grep -q "$(printf '\033')" err || fail "an escape sequence came through"

# ---- depfiles -------------------------------------------------------------------------------------------------------
claim "a depfile names what was read, side files included, and not what was not; as Make and Ninja read it"
mkdir -p "a b#\$c"
printf 'mtllib box.mtl missing.mtl\n' | cat - box.obj >"a b#\$c/box.obj"
printf 'newmtl stone\nmap_Kd stone.png\n' >"a b#\$c/box.mtl"
touch "a b#\$c/stone.png"
run 0 bake "a b#\$c/box.obj" far_box.obj -o "with space.espl" -q --depfile box.d
printf '%s\n' 'with\ space.espl: \' ' a\ b\#$$c/box.obj \' ' a\ b\#$$c/box.mtl \' ' far_box.obj' >expected.d
same expected.d box.d
run 0 bake box.obj -o plain.espl -q --depfile /dev/stdout
printf 'plain.espl: \\\n box.obj\n' >expected.d
same expected.d out
base64 -d >triangle.bin <<<'AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA'
cat >triangle.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "buffers": [{"uri": "triangle.bin", "byteLength": 36}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}]}
GLTF
run 0 bake triangle.gltf -o triangle.espl -q --depfile triangle.d
printf 'triangle.espl: \\\n triangle.gltf \\\n triangle.bin\n' >expected.d
same expected.d triangle.d

claim "a depfile is written with the blob or not at all, and over neither mesh nor blob"
run 3 bake not_finite.obj -o failed.espl --depfile failed.d
absent failed.d
run 1 bake box.obj -o x.espl --depfile box.obj
run 1 bake box.obj -o x.espl --depfile x.espl
refuses 1 "--depfile and -o name the same file" bake box.obj -o x.espl --depfile ./x.espl
cp box.obj "$(printf 'two\nlines.obj')"
refuses 5 "line break" bake "$(printf 'two\nlines.obj')" -o failed.espl --depfile failed.d
absent failed.d failed.espl
run 0 bake "$(printf 'two\nlines.obj')" -o x.espl

finish
