#!/usr/bin/env bash
# Tests of the command line's help, and of `espalier bake`: what it reports, tolerances, steps.
# Usage: bake_test.sh PATH_TO_ESPALIER
# shellcheck source=meshes.sh
. "$(dirname "$0")/meshes.sh"

# ---- usage ----------------------------------------------------------------------------------------------------------
claim "help goes to stdout and names the exit status, for the command and for every verb"
for verb in "" bake refit embed info verify query "query x ray" "query x sphere" "query x closest-point" render trade dump; do
    # shellcheck disable=SC2086
    prints "0 ok, 1 usage, 2 file cannot be read or written, 3 invalid input, 4 internal, 5 unsupported" $verb --help
    [ ! -s err ] || fail "help wrote to stderr"
done
prints "espalier " --version

claim "a command line that makes no sense is usage, and says on stderr what it did not understand"
run 1
run 1 fold box.obj
run 1 bake box.obj
run 1 bake -o x.espl
run_each 1 "bake box.obj -o x.espl" "--bits 25" "--bits 0" "--profile huge" "--flat-angle 90" "--flat-angle wide" "--flat-angle" \
    "--bounds obb,ball" "--effort 5" "--byte-price -1" "--builder oak" "--bits 12 --tolerance 1mm" "--scale 0" "--scale -1" "--up w"
refuses 1 "um, mm, cm, m, km, in and ft" bake box.obj -o x.espl --unit parsec
refuses 1 "--nonsense" bake box.obj -o x.espl --nonsense
absent x.espl

# ---- bake -----------------------------------------------------------------------------------------------------------
claim "the meshes of a file are numbered from 0 and listed with their names"
{
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no unused\no house\ng walls\nf 1 2 3\ng roof\nf 1 2 4\n'
    printf 'o yard\ng\nf 1 3 4\no house\ng walls\nf 2 3 4\n'
} >named.obj
finds '.inputs[0].meshes == 3 and .inputs[0].mesh_names == ["house/walls", "house/roof", "yard"]' bake named.obj -o named.espl
err_has "  meshes: 0 house/walls, 1 house/roof, 2 yard"
finds '.inputs[0].mesh_names == [""]' bake box.obj -o x.espl
err_lacks "  meshes: "
for i in $(seq 0 20); do printf 'v 0 0 %d\nv 1 0 %d\nv 0 1 %d\ng part %d\nf -3 -2 -1\n' "$i" "$i" "$i" "$i"; done >parts.obj
finds '.inputs[0].mesh_names[20] == "part 20"' bake parts.obj -o x.espl
err_has "14 part 14, 15 part 15, ...; --json lists all of them"

claim "a bake says bounds, unit, axes, lattice and size on stderr and nothing on stdout"
run 0 bake box.obj -o x.espl
[ ! -s out ] || fail "stdout is not empty"
err_has "box.obj: 12 triangles in 1 mesh" "unit: 1 = 1 m (not stated)" "axes: as imported" "bounds: 0 0 0 to 1 2 3, extent 3"
err_has "lattice: 16 bits, step " "max error " "12 triangles, 8 vertices, 1 node" "closed" "wrote x.espl"

claim "quiet bakes say nothing"
run 0 bake box.obj -o x.espl -q
[ ! -s out ] && [ ! -s err ] || fail "something was said"

claim "bake --json tells the same as one object on stdout"
run 0 bake box.obj -o x.espl -q --json
out_has '"schema": 1' '"triangles": 12' '"vertices": 8' '"source_triangles": 12' '"bits": 16' '"step": ' '"max_error": ' \
    '"extent": 3.0' '"bytes": ' '"bytes_per_triangle": ' '"depth": 1' '"nodes": 1' '"closed": true' '"profile": "balanced"' \
    '"lost_closed": false' '"bits_that_keep_closed": null' '"rays_rounded_coarsely": false' \
    '"checksum": "' '"zero_area"' '"collapsed"' '"duplicate"' '"not_finite"' '"index_out_of_range"' '"unit_origin": '

claim "a bake that opens a closed mesh warns of the reason and of the bits that keep it"
# A corner on the edge from 0 0 0 to 35 -3 0, in a triangle without area that rounding would give one.
cat >mended.obj <<'END'
v 0 0 0
v 35 -3 0
v 7 40 0
v 3 5 50
v 13.125 -1.125 0
f 1 3 2
f 1 5 4
f 5 2 4
f 1 2 5
f 2 3 4
f 3 1 4
END
reports "the source is closed, but at 5 bits the baked surface is not" bake mended.obj -o mended.espl --max-dropped 20% --bits 5 --json
err_has "because it lacks 1 triangle without area (first: mended.obj, mesh 0" " keeps it closed."
out_has '"closed": false'
json '.lost_closed and (.closed | not) and .bits_that_keep_closed > 5'
run 0 bake mended.obj -o mended.espl --max-dropped 20% --bits 5 --max-bytes 100000 --json
err_has "the source is closed, but at 5 bits the baked surface is not"
json '.lost_closed and .bits_that_keep_closed > 5'
run 0 bake mended.obj -o mended.espl --max-dropped 20% --bits 16 --json
err_lacks "the source is closed"
json '.closed and (.lost_closed | not) and .bits_that_keep_closed == null'
# Two tetrahedra on the same side of a common face, which both need and a blob holds once.
cat >shared.obj <<'END'
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
v 0 0 2
f 1 3 2
f 1 2 4
f 2 3 4
f 3 1 4
f 1 3 2
f 1 2 5
f 2 3 5
f 3 1 5
END
reports "because it lacks 1 triangle with the corners of another one (first: shared.obj, mesh 0" bake shared.obj -o shared.espl --json
err_has "No number of bits keeps it closed: bake parts that share triangles into separate blobs."
json '.lost_closed and .bits_that_keep_closed == null'
# Thinner than the finest lattice.
printf 'v 0 0 0\nv 1 0 0\nv 0 1e-9 0\nv 0 0 1e-9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >needle.obj
reports "because no triangle is left" bake needle.obj -o needle.espl --json --allow-empty --max-dropped 100%
err_has "No number of bits keeps it closed: it is too thin for its length."

claim "a bake at 23 bits warns that rays from outside are rounded coarsely and one at 22 does not"
reports "rounded to whole lattice steps" bake box.obj -o x.espl --bits 23 --json
json '.rays_rounded_coarsely'
run 0 bake box.obj -o x.espl --bits 22 --json
err_lacks "rounded to whole lattice steps"
json '.rays_rounded_coarsely | not'

claim "OBJ, PLY and STL of the same triangles give the same bytes"
run 0 bake box.ply -o ply.espl
makes box.espl ply.espl bake box.stl -o stl.espl
same box.espl stl.espl

claim "the bytes depend on nothing but the input: not on threads, time or folder"
for threads in 1 2 3 0; do
    makes sheet.espl t.espl bake sheet.obj -o t.espl --ids --materials --threads $threads
done
mkdir elsewhere
makes sheet.espl elsewhere/t.espl bake "$folder/sheet.obj" -o elsewhere/t.espl --ids --materials

claim "a tolerance is honoured, in every unit"
for length in 0.5mm 0.05cm 5e-4m 500um 0.0005; do
    run 0 bake sheet.obj -o tolerance_$length.espl --tolerance $length --json -q
    awk '/"max_error"/ { exit !($2 + 0 <= 0.0005 && $2 + 0 > 0.00005) }' out || fail "max error at $length: $(grep max_error out)"
    same tolerance_0.5mm.espl tolerance_$length.espl
done
run 0 bake sheet.obj -o x.espl --tolerance 1in
run 0 bake sheet.obj -o x.espl --tolerance 0.1ft
refuses 1 "'1parsec' is no length" bake sheet.obj -o x.espl --tolerance 1parsec
run_each 1 "bake sheet.obj -o x.espl --tolerance" -1mm 0 nan inf

claim "a step is a power of two, written either way, and is that of the blob"
finds '.step == 0.001953125' bake sheet.obj -o step.espl --step 2^-9 -q
makes step.espl x.espl bake sheet.obj -o x.espl --step 0.001953125
for step in 0.3 2^ 2^x 2^-1.5 -0.5 0 nan inf 2^-9mm; do
    refuses 1 "is no power of two" bake sheet.obj -o x.espl --step "$step"
done
refuses 1 "from 2^-100 to 2^100" bake sheet.obj -o x.espl --step 2^-101
run_each 1 "bake sheet.obj -o x.espl --step 2^-9" "--tolerance 1mm" "--bits 12" "--max-error 1mm" "--lattice-of step.espl"

claim "a step finer than the format is unsupported and says which one fits"
refuses 5 "the finest step is 2^" bake sheet.obj -o fine.espl --step 2^-60
absent fine.espl
finest=$(sed -n 's/.*the finest step is \(2^-*[0-9]*\).*/\1/p' err)
run 0 bake sheet.obj -o x.espl --step "$finest"

claim "the lattice of another blob fixes the step, and a depfile has that blob"
finds '.step == 0.001953125' bake box.obj -o neighbour.espl --lattice-of step.espl --depfile neighbour.d -q
grep -q 'step\.espl' neighbour.d || fail "neighbour.d: $(cat neighbour.d)"
run 3 bake box.obj -o x.espl --lattice-of box.obj
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >line.obj
run 0 bake line.obj -o none.espl --allow-empty --max-dropped 100%
refuses 3 "'none.espl' is a blob without triangles" bake box.obj -o from_none.espl --lattice-of none.espl
absent from_none.espl
run 1 bake box.obj -o x.espl --lattice-of step.espl --bits 12
run 1 bake box.obj -o step.espl --lattice-of step.espl
run 5 bake sheet.obj -o x.espl --step 2^-9 --max-bytes 100

claim "a tolerance finer than the format is unsupported, and leaves no file"
refuses 5 "too fine" bake sheet.obj -o fine.espl --tolerance 1e-9
absent fine.espl

finish
