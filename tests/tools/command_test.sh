#!/usr/bin/env bash
# Claims about the espalier command, made by running it over small meshes that this script writes itself.
# Usage: command_test.sh PATH_TO_ESPALIER
# shellcheck source=claims.sh
. "$(dirname "$0")/claims.sh"

# The bounds that stderr names, up to what the lattice may move them.
bounds_near() {
    sed -n 's/^bounds: \(.*\) to \(.*\), extent.*/\1 \2/p' err | awk -v expected="$*" '
        { n = split(expected, e, " "); for (i = 1; i <= 6; ++i) { size = e[i + 3] - e[i]; if (i > 3) size = e[i] - e[i - 3]
            d = $i - e[i]; if (d < 0) d = -d; if (d > 1e-3 * size) bad = 1 } } END { exit bad || NR != 1 }' ||
        fail "not near the bounds $*: $(grep bounds err)"
}
absent() { [ ! -e "$1" ] || fail "$1 is there"; }
# nothing but the given files
only() { [ "$(ls -A "$1" | tr '\n' ' ')" = "$2" ] || fail "$1 holds $(ls -A "$1" | tr '\n' ' ')"; }

# ---- meshes ---------------------------------------------------------------------------------------------------------
# The box of claims.sh in other formats.
write_box_ply() {
    printf 'ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n'
    printf 'element face 12\nproperty list uchar int vertex_indices\nend_header\n'
    printf '%s\n' "${corners[@]}"
    printf '3 %s\n' "${faces[@]}"
}
write_box_stl() {
    echo "solid box"
    for face in "${faces[@]}"; do
        echo "facet normal 0 0 0"
        echo "outer loop"
        for index in $face; do echo "vertex ${corners[$index]}"; done
        echo "endloop"
        echo "endfacet"
    done
    echo "endsolid box"
}
# The box in Collada, under a node with the given transform elements, unit in metres, up axis.
write_box_collada() { # TRANSFORM METRES UP
    local indices=${faces[*]} positions=${corners[*]}
    cat <<COLLADA
<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><created>2020-01-01T00:00:00Z</created><modified>2020-01-01T00:00:00Z</modified>
  <unit meter="$2" name="unit"/><up_axis>$3</up_axis></asset>
 <library_geometries><geometry id="box" name="box"><mesh>
  <source id="p"><float_array id="pa" count="24">$positions</float_array><technique_common>
   <accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
   <param name="Z" type="float"/></accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>$indices</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n">$1<instance_geometry url="#box"/></node>
 </visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
COLLADA
}
write_box_obj 0 >box.obj
write_box_obj 10 >far_box.obj
write_box_ply >box.ply
write_box_stl >box.stl
# A bumpy sheet, large enough for a tree of several levels.
awk 'BEGIN { n = 40
    for (i = 0; i <= n; ++i) for (j = 0; j <= n; ++j) printf "v %g %g %g\n", i, 3 * sin(i / 5) * cos(j / 7), j
    for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) { a = i * (n + 1) + j + 1
        printf "f %d %d %d\nf %d %d %d\n", a, a + 1, a + n + 2, a, a + n + 2, a + n + 1 } }' >sheet.obj
"$espalier" bake box.obj -o box.espl -q || fail "the box cannot be baked"
"$espalier" bake sheet.obj -o sheet.espl -q --ids --materials 8 || fail "the sheet cannot be baked"

# ---- usage ----------------------------------------------------------------------------------------------------------
claim "help goes to stdout and names the exit status, for the command and for every verb"
for verb in "" bake embed info verify query "query x ray" "query x sphere" "query x nearest" render trade dump; do
    # shellcheck disable=SC2086
    run 0 $verb --help
    out_has "0 ok, 1 usage, 2 file cannot be read or written, 3 invalid input, 4 internal, 5 unsupported"
    [ ! -s err ] || fail "help wrote to stderr"
done
run 0 --version
out_has "espalier "

claim "a command line that makes no sense is usage, and says on stderr what it did not understand"
run 1
run 1 fold box.obj
run 1 bake box.obj
run 1 bake -o x.espl
run 1 bake box.obj -o x.espl --bits 25
run 1 bake box.obj -o x.espl --bits 0
run 1 bake box.obj -o x.espl --profile huge
run 1 bake box.obj -o x.espl --materials 9
run 1 bake box.obj -o x.espl --edge-flags --flat-angle 90
run 1 bake box.obj -o x.espl --edge-flags --flat-angle wide
run 1 bake box.obj -o x.espl --flat-angle 5
run 1 bake box.obj -o x.espl --bounds obb,ball
run 1 bake box.obj -o x.espl --effort 10
run 1 bake box.obj -o x.espl --builder oak
run 1 bake box.obj -o x.espl --bits 12 --tolerance 1mm
run 1 bake box.obj -o x.espl --scale 0
run 1 bake box.obj -o x.espl --scale -1
run 1 bake box.obj -o x.espl --up w
run 1 bake box.obj -o x.espl --unit parsec
err_has "um, mm, cm, m, km, in and ft"
run 1 bake box.obj -o x.espl --nonsense
err_has "--nonsense"
absent x.espl

# ---- bake -----------------------------------------------------------------------------------------------------------
claim "a bake says bounds, unit, axes, lattice and size on stderr and nothing on stdout"
run 0 bake box.obj -o x.espl
[ ! -s out ] || fail "stdout is not empty"
err_has "box.obj: 12 triangles in 1 mesh"
err_has "unit: 1 = 1 m (not stated)"
err_has "axes: as imported"
err_has "bounds: 0 0 0 to 1 2 3, extent 3"
err_has "lattice: 16 bits, step "
err_has "max error "
err_has "12 triangles, 8 vertices, 1 node"
err_has "closed"
err_has "wrote x.espl"

claim "quiet bakes say nothing"
run 0 bake box.obj -o x.espl -q
[ ! -s out ] && [ ! -s err ] || fail "something was said"

claim "bake --json tells the same as one object on stdout"
run 0 bake box.obj -o x.espl -q --json
for key in '"schema": 1' '"triangles": 12' '"vertices": 8' '"source_triangles": 12' '"bits": 16' '"step": ' '"max_error": ' \
    '"extent": 3.0' '"bytes": ' '"bytes_per_triangle": ' '"depth": 1' '"nodes": 1' '"closed": true' '"profile": "balanced"' \
    '"lost_closed": false' '"bits_that_keep_closed": null' '"rays_rounded_coarsely": false' \
    '"checksum": "' '"zero_area"' '"collapsed"' '"duplicate"' '"not_finite"' '"index_out_of_range"' '"unit_origin": '; do
    out_has "$key"
done

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
run 0 bake mended.obj -o mended.espl --max-dropped 20% --bits 5 --json
err_has "the source is closed, but at 5 bits the baked surface is not"
err_has "because it lacks 1 triangle without area (first: mended.obj, mesh 0"
err_has " keeps it closed."
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
run 0 bake shared.obj -o shared.espl --json
err_has "because it lacks 1 triangle with the corners of another one (first: shared.obj, mesh 0"
err_has "No number of bits keeps it closed: bake parts that share triangles into separate blobs."
json '.lost_closed and .bits_that_keep_closed == null'
# Thinner than the finest lattice.
printf 'v 0 0 0\nv 1 0 0\nv 0 1e-9 0\nv 0 0 1e-9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >needle.obj
run 0 bake needle.obj -o needle.espl --json --allow-empty --max-dropped 100%
err_has "because no triangle is left"
err_has "No number of bits keeps it closed: it is too thin for its length."

claim "a bake at 23 bits warns that rays from outside are rounded coarsely and one at 22 does not"
run 0 bake box.obj -o x.espl --bits 23 --json
err_has "rounded to whole lattice steps"
json '.rays_rounded_coarsely'
run 0 bake box.obj -o x.espl --bits 22 --json
err_lacks "rounded to whole lattice steps"
json '.rays_rounded_coarsely | not'

claim "OBJ, PLY and STL of the same triangles give the same bytes"
run 0 bake box.ply -o ply.espl
run 0 bake box.stl -o stl.espl
same box.espl ply.espl
same box.espl stl.espl

claim "the bytes depend on nothing but the input: not on threads, time or folder"
for threads in 1 2 3 0; do
    run 0 bake sheet.obj -o t.espl --ids --materials 8 --threads $threads
    same sheet.espl t.espl
done
mkdir elsewhere
run 0 bake "$folder/sheet.obj" -o elsewhere/t.espl --ids --materials 8
same sheet.espl elsewhere/t.espl

claim "a tolerance is honoured, in every unit"
for length in 0.5mm 0.05cm 5e-4m 500um 0.0005; do
    run 0 bake sheet.obj -o tolerance_$length.espl --tolerance $length --json -q
    awk '/"max_error"/ { exit !($2 + 0 <= 0.0005 && $2 + 0 > 0.00005) }' out || fail "max error at $length: $(grep max_error out)"
    same tolerance_0.5mm.espl tolerance_$length.espl
done
run 0 bake sheet.obj -o x.espl --tolerance 1in
run 0 bake sheet.obj -o x.espl --tolerance 0.1ft
run 1 bake sheet.obj -o x.espl --tolerance 1parsec
err_has "'1parsec' is no length"
run 1 bake sheet.obj -o x.espl --tolerance -1mm
run 1 bake sheet.obj -o x.espl --tolerance 0
run 1 bake sheet.obj -o x.espl --tolerance nan
run 1 bake sheet.obj -o x.espl --tolerance inf

claim "a step is a power of two, written either way, and is that of the blob"
run 0 bake sheet.obj -o step.espl --step 2^-9 --json -q
json '.step == 0.001953125'
run 0 bake sheet.obj -o x.espl --step 0.001953125
same step.espl x.espl
for step in 0.3 2^ 2^x 2^-1.5 -0.5 0 nan inf 2^-9mm; do
    run 1 bake sheet.obj -o x.espl --step "$step"
    err_has "is no power of two"
done
run 1 bake sheet.obj -o x.espl --step 2^-101
err_has "from 2^-100 to 2^100"
run 1 bake sheet.obj -o x.espl --step 2^-9 --tolerance 1mm
run 1 bake sheet.obj -o x.espl --step 2^-9 --bits 12
run 1 bake sheet.obj -o x.espl --step 2^-9 --max-error 1mm
run 1 bake sheet.obj -o x.espl --step 2^-9 --lattice-of step.espl

claim "a step finer than the format is unsupported and says which one fits"
run 5 bake sheet.obj -o fine.espl --step 2^-60
err_has "the finest step is 2^"
absent fine.espl
finest=$(sed -n 's/.*the finest step is \(2^-*[0-9]*\).*/\1/p' err)
run 0 bake sheet.obj -o x.espl --step "$finest"

claim "the lattice of another blob fixes the step, and a depfile has that blob"
run 0 bake box.obj -o neighbour.espl --lattice-of step.espl --depfile neighbour.d --json -q
json '.step == 0.001953125'
grep -q 'step\.espl' neighbour.d || fail "neighbour.d: $(cat neighbour.d)"
run 3 bake box.obj -o x.espl --lattice-of box.obj
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >line.obj
run 0 bake line.obj -o none.espl --allow-empty --max-dropped 100%
run 3 bake box.obj -o from_none.espl --lattice-of none.espl
err_has "'none.espl' is a blob without triangles"
absent from_none.espl
run 1 bake box.obj -o x.espl --lattice-of step.espl --bits 12
run 1 bake box.obj -o step.espl --lattice-of step.espl
run 5 bake sheet.obj -o x.espl --step 2^-9 --max-bytes 100

claim "a tolerance finer than the format is unsupported, and leaves no file"
run 5 bake sheet.obj -o fine.espl --tolerance 1e-9
err_has "too fine"
absent fine.espl

# ---- picks ----------------------------------------------------------------------------------------------------------
claim "a pick keeps to its bytes, and says what it took and what it gave up"
for bytes in 1K 4K 10K 0.02M 65536; do
    run 0 bake sheet.obj -o picked.espl --max-bytes $bytes --max-dropped 100%
    err_has "picked: profile "
    err_has "  error: "
    err_has "  bytes: "
    err_has "  counted work: "
    allowed=$(echo $bytes | awk '/K/ { print $0 * 1024; next } /M/ { print int($0 * 1048576); next } { print $0 }')
    [ "$(stat -c %s picked.espl)" -le "$allowed" ] || fail "$(stat -c %s picked.espl) bytes in $bytes"
    "$espalier" verify picked.espl --deep --source sheet.obj >/dev/null || fail "the pick is not sound"
done
run 0 bake sheet.obj -o picked.espl --max-bytes 1M
err_has "16 bits"
err_has "nothing given up"
run 0 bake sheet.obj -o picked.espl --max-bytes 7K
err_has "given up: "
err_has "at 16 bits"

claim "the same is picked twice and at any number of threads"
for pick in "--max-bytes 10K" "--fastest-under 30K" "--max-error 5mm" "--max-error 5mm --max-bytes 22K"; do
    # shellcheck disable=SC2086
    run 0 bake sheet.obj -o a.espl $pick --threads 1
    cp err first_err
    # shellcheck disable=SC2086
    run 0 bake sheet.obj -o b.espl $pick --threads 2
    same a.espl b.espl
    grep -v wrote first_err >first
    grep -v wrote err >second
    same first second
done

claim "the fastest under a limit works no harder than any other blobs under it, on the lattice that was asked for"
run 0 bake sheet.obj -o fast.espl --fastest-under 1M --json -q
if command -v jq >/dev/null; then
    jq -e '.bits == 16 and (.picked.tried | length) > 8 and
        (.picked.chosen.counted_cost == ([.picked.tried[].counted_cost] | min))' out >/dev/null || fail "$(jq -c .picked.chosen out)"
    size=$(jq '[.picked.tried[].bytes] | add / length | floor' out)
    run 0 bake sheet.obj -o fast.espl --fastest-under "$size" --json -q
    jq -e "(.bytes <= $size) and
        (.picked.chosen.counted_cost == ([.picked.tried[] | select(.bytes <= $size) | .counted_cost] | min))" out \
        >/dev/null || fail "$(jq -c .picked.chosen out)"
fi

claim "the lattice is kept when anything on it fits, be it the very last byte"
if command -v jq >/dev/null; then
    # Triangles apart from each other: builders fill leaves differently.
    awk 'BEGIN { n = 600; s = 1
        for (i = 0; i < 3 * n; ++i) {
            for (k = 0; k < 3; ++k) { s = s * 16807 % 2147483647; p[k] = s / 2147483647; if (i % 3 == 0) at[k] = 10 * p[k] }
            printf "v %g %g %g\n", at[0] + p[0], at[1] + p[1], at[2] + p[2] }
        for (i = 0; i < n; ++i) printf "f %d %d %d\n", 3 * i + 1, 3 * i + 2, 3 * i + 3 }' >soup.obj
    for bits in 10 11 12 13 14 15 16; do # until the first bake is not the smallest
        run 0 bake soup.obj -o x.espl --fastest-under 1G --bits $bits --profile fast --json -q
        size=$(jq '[.picked.tried[].bytes] | min' out)
        ! jq -e "$size < .picked.tried[0].bytes" out >/dev/null || break
    done
    jq -e "$size < .picked.tried[0].bytes" out >/dev/null || fail "the first bake is the smallest: nothing is tested"
    run 0 bake soup.obj -o x.espl --max-bytes "$size" --bits $bits --profile fast --json -q
    jq -e ".bits == $bits and .bytes == $size" out >/dev/null || fail "$(jq -c .picked.chosen out) in $size bytes"
fi

claim "an error that is allowed is kept, on the coarsest lattice that keeps it"
run 0 bake sheet.obj -o x.espl --tolerance 5mm --json -q
bits=$(grep '"bits"' out | head -n 1)
run 0 bake sheet.obj -o x.espl --max-error 5mm --json -q
[ "$bits" = "$(grep '"bits"' out | head -n 1)" ] || fail "$bits by tolerance, $(grep '"bits"' out | head -n 1) by max error"
awk '/"max_error"/ { exit !($2 + 0 <= 0.005) }' out || fail "$(grep max_error out)"

claim "what cannot be had is unsupported, names the smallest that was reached, and leaves no file"
for pick in "--max-bytes 100" "--fastest-under 5K" "--max-error 5mm --max-bytes 5K"; do
    # shellcheck disable=SC2086
    run 5 bake sheet.obj -o small.espl $pick
    err_has "nothing fits"
    err_has "The smallest of "
    absent small.espl
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >corner.obj
run 5 bake corner.obj -o small.espl --max-bytes 100 # one bit is enough for it
err_has "There is no coarser lattice"
printf 'v 0 0 0\nv 9 0 0\nv 9 1 0\nf 1 2 3\n' >sliver.obj
run 5 bake sliver.obj -o small.espl --max-bytes 100
err_has "A coarser lattice leaves no triangle"
for amount in 0 -5 64X K nan 1e99 ""; do run 1 bake sheet.obj -o small.espl --fastest-under "$amount"; done
run 1 bake sheet.obj -o small.espl --max-bytes 64Q
err_has "is no amount of bytes"
run 1 bake sheet.obj -o small.espl --max-bytes 64K --fastest-under 64K
run 1 bake sheet.obj -o small.espl --max-error 1mm --tolerance 1mm
run 1 bake sheet.obj -o small.espl --max-error 1mm --bits 12
run 1 bake sheet.obj -o small.espl --max-error 0
absent small.espl

claim "a pick leaves alone what the user chose, and an empty mesh is no trouble"
run 0 bake sheet.obj -o x.espl --fastest-under 1M --leaf-size 5 --profile fast
err_has "leaves of up to 5 triangles"
printf 'v 0 0 0\nv 1 0 0\nl 1 2\n' >line.obj
run 0 bake line.obj -o x.espl --max-bytes 1K --allow-empty
run 0 verify x.espl --deep

claim "leaves are as large as --leaf-size allows"
run 0 bake sheet.obj -o x.espl --leaf-size 1 --json -q
out_has '"leaves": 3200'
run 1 bake sheet.obj -o x.espl --leaf-size 0
run 1 bake sheet.obj -o x.espl --leaf-size 63

# ---- cost model -----------------------------------------------------------------------------------------------------
claim "a cost model shapes the tree; the defaults written out change nothing"
echo '{"node_visit": 1, "leaf_visit": 0.4, "leaf_group": 0.3, "triangle": 0, "byte_price": 5}' >default.json
run 0 bake sheet.obj -o x.espl --cost-model default.json --ids --materials 8
same x.espl sheet.espl
echo '{}' >default.json
run 0 bake sheet.obj -o x.espl --cost-model default.json --ids --materials 8
same x.espl sheet.espl
echo '{"byte_price": 0}' >free_bytes.json
run 0 bake sheet.obj -o x.espl --cost-model free_bytes.json --ids --materials 8
[ "$(stat -c %s x.espl)" -gt "$(stat -c %s sheet.espl)" ] || fail "free bytes make no larger blob"

claim "a cost model that makes no sense is refused with its file and its field"
refused_model() { # JSON FIELD_OR_WORDS
    echo "$1" >model.json
    run 3 bake sheet.obj -o model.espl --cost-model model.json
    err_has "'model.json'"
    err_has "$2"
    absent model.espl
}
refused_model '{"node_visits": 1}' "'node_visits' is not known"
refused_model '{"leaf_visit": -1}' "'leaf_visit'"
refused_model '{"triangle": "much"}' "'triangle'"
refused_model '{"byte_price": 1e9}' "'byte_price'"
refused_model '{"node_visit": null}' "'node_visit'"
refused_model '[1, 2]' "JSON object"
refused_model '{"node_visit": 1' "no JSON"
refused_model '' "no JSON"
run 2 bake sheet.obj -o model.espl --cost-model missing.json
err_has "missing.json"

claim "unit, scale and up axis do what they say"
run 0 bake box.obj -o x.espl --unit mm
err_has "unit: 1 = 0.001 m (--unit)"
bounds_near 0 0 0 0.001 0.002 0.003
run 0 bake box.obj -o x.espl --scale 10
err_has "bounds: 0 0 0 to 10 20 30"
run 0 bake box.obj -o x.espl --unit cm --scale 100
bounds_near 0 0 0 1 2 3
run 0 bake box.obj -o x.espl --up z
err_has "bounds: 0 0 -2 to 1 3 0"
err_has "+Z of the input is +Y in the blob"
run 0 bake box.obj -o x.espl --up x
err_has "bounds: -2 0 0 to 0 1 3"
run 0 bake box.obj -o x.espl --up y
err_has "bounds: 0 0 0 to 1 2 3"

claim "an asset of surprising size is warned about, also when quiet"
run 0 bake box.obj -o x.espl --scale 1000 -q
err_has "3000 m across"
run 0 bake box.obj -o x.espl --scale 0.0001 -q
err_has " m across"

claim "node transforms, units and up axes of files are applied"
write_box_collada "<translate>10 20 30</translate><scale>2 2 2</scale>" 1 Y_UP >moved.dae
run 0 bake moved.dae -o moved.espl
err_has "bounds: 10 20 30 to 12 24 36"
write_box_collada "<translate>1 0 0</translate>" 0.01 Y_UP >centimetres.dae
run 0 bake centimetres.dae -o x.espl
bounds_near 0.01 0 0 0.02 0.02 0.03
write_box_collada "" 1 Z_UP >z_up.dae
run 0 bake z_up.dae -o x.espl
err_has "bounds: 0 0 -2 to 1 3 0"

claim "a mirrored mesh keeps its front outside"
write_box_collada "<scale>-1 1 1</scale>" 1 Y_UP >mirrored.dae
run 0 bake mirrored.dae -o mirrored.espl
err_has "bounds: -1 0 0 to 0 2 3"
run 0 query mirrored.espl ray -5 1 1 1 0 0 --faces front
out_has "t 4"
out_has "normal -1 0 0"
run 0 query moved.espl ray 0 21 31 1 0 0 --faces front
out_has "t 10"

claim "several files become one blob, in their order, with distinct materials"
run 0 bake box.obj far_box.obj -o two.espl --ids --materials 16
err_has "far_box.obj: 12 triangles in 1 mesh"
err_has "bounds: 0 0 0 to 11 2 3"
run 0 query two.espl ray -1 1 1 1 0 0 --json
out_has '"file": 0'
first=$(grep '"material"' out)
run 0 query two.espl ray 20 1 1 -1 0 0 --json
out_has '"file": 1'
[ "$first" != "$(grep '"material"' out)" ] || fail "both files have the material $first"

claim "broken geometry is refused with file, mesh and triangle, unless it is to be repaired; then it is counted"
printf 'v 0 0 0\nv 1 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 3\n' >not_finite.obj
run 3 bake not_finite.obj -o broken.espl
err_has "not_finite.obj, mesh 0"
err_has "triangle 1"
err_has "--repair"
absent broken.espl
run 0 bake not_finite.obj -o x.espl --repair --max-dropped 50%
err_has "dropped 1 triangle with a corner that is NaN or infinite; first: not_finite.obj, mesh 0"
write_box_ply | sed 's/^3 0 2 3$/3 0 2 300/' >out_of_range.ply
run 3 bake out_of_range.ply -o broken.espl
err_has "out_of_range.ply, mesh 0, triangle 0"
absent broken.espl
run 0 bake out_of_range.ply -o x.espl --repair --json
err_has "dropped 1 triangle with an index out of range"
out_has '"triangles": 11'

claim "triangles without area and repeated ones are dropped, counted and named"
{ write_box_obj 0; printf 'f 1 1 2\nf 1 3 4\nf 1 3 4\n'; } >untidy.obj
run 0 bake untidy.obj -o x.espl --json
err_has "dropped 1 triangle without area; first: untidy.obj, mesh 0"
err_has "triangle 12"
err_has "dropped 2 triangles with the corners of another one; first: untidy.obj, mesh 0"
out_has '"triangles": 12'

claim "points and lines are skipped and counted; a scene without triangles is an empty blob, and says so"
printf 'v 0 0 0\nv 1 0 0\np 1\nl 1 2\n' >points.obj
run 0 bake points.obj -o empty.espl --allow-empty
err_has "skipped 2 points and lines"
err_has "the input has no triangles; the blob is valid and empty"
run 0 verify empty.espl --deep
run 0 info empty.espl --json
out_has '"triangles": 0'
run 0 query empty.espl ray 0 0 0 1 0 0
out_has "no hit"
run 0 query empty.espl nearest 0 0 0
run 0 query empty.espl sphere 0 0 0 inf
out_has "0 triangles"
run 0 dump empty.espl
run 0 render empty.espl -o empty.png --size 8x8
err_has "no triangles"

claim "what is no mesh is invalid input with the importer's reason; what is not there cannot be read"
echo "not a mesh" >junk.obj
{ printf '\177ELF\002\001\001' && head -c 5000 /dev/zero; } >junk.glb # fixed bytes: any program's own may look like an OBJ
cp junk.glb junk.unknown
: >nothing.ply
printf 'OFF\n1000 6 0\n0 0 0\n0 0 1\n0 1 0\n3 0 1 2\n' >boastful.off # fails an assertion of assimp 5.2
write_box_collada "$(yes '<node>' | head -n 200000)$(yes '</node>' | head -n 200000)" 1 Y_UP >deep.dae # uses up its stack
for mesh in junk.glb nothing.ply boastful.off deep.dae; do
    run 3 bake $mesh -o broken.espl
    err_has "$mesh"
    absent broken.espl
done
run 5 bake junk.unknown -o broken.espl # a format without an importer
err_has "junk.unknown"
absent broken.espl
"$espalier" bake junk.obj -o broken.espl 2>/dev/null # a file of unknown lines is an OBJ without faces to some importers
rm -f broken.espl
run 2 bake missing.obj -o broken.espl
err_has "cannot read 'missing.obj': No such file or directory"
run 2 bake . -o broken.espl
err_has "folder"
mkfifo pipe.obj
run 2 bake pipe.obj -o broken.espl # and does not wait for a writer
err_has "no pipes or devices"
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
run 0 bake "a b#\$c/box.obj" far_box.obj -o "with space.espl" -q --depfile box.d --cost-model free_bytes.json
printf '%s\n' 'with\ space.espl: \' ' a\ b\#$$c/box.obj \' ' a\ b\#$$c/box.mtl \' ' far_box.obj \' ' free_bytes.json' >expected.d
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
run 1 bake box.obj -o x.espl --depfile ./x.espl
err_has "--depfile and -o name the same file"
cp box.obj "$(printf 'two\nlines.obj')"
run 5 bake "$(printf 'two\nlines.obj')" -o failed.espl --depfile failed.d
err_has "line break"
absent failed.d
absent failed.espl
run 0 bake "$(printf 'two\nlines.obj')" -o x.espl

# ---- embed ----------------------------------------------------------------------------------------------------------
claim "what is embedded says its name, size, section and alignment, and is the same in any folder"
run 0 embed box.espl -o level.c --header level.h
err_has "wrote level.c: level, $(stat -c %s box.espl) bytes in .rodata.level, aligned to 16"
run 0 embed box.espl -o level.c --header level.h -q --json
[ ! -s err ] || fail "something was said"
json ".symbol == \"level\" and .bytes == $(stat -c %s box.espl) and .section == \".rodata.level\" and .header == \"level.h\""
mkdir embedded
cp box.espl embedded/other.espl
run 0 embed embedded/other.espl -o embedded/level.c --header embedded/level.h -q
same level.c embedded/level.c
same level.h embedded/level.h
run 0 embed box.espl -o x.S --symbol arena --section .flash_blobs --alignment 64 -q
for words in '.section .flash_blobs, "a"' '.balign 64' '.global arena' '"box.espl"'; do
    grep -qF "$words" x.S || fail "x.S lacks $words"
done

claim "a header that stays the same is not touched"
touch -d '2020-01-01' level.h
run 0 embed box.espl -o level.c --header level.h -q
[ "$(stat -c %Y level.h)" = "$(date -d '2020-01-01' +%s)" ] || fail "the header has a new time"
run 0 embed sheet.espl -o level.c --header level.h -q
[ "$(stat -c %Y level.h)" != "$(date -d '2020-01-01' +%s)" ] || fail "the header of another blob is the old one"

claim "what cannot be embedded is refused, and nothing is written"
run 1 embed box.espl -o bad.txt
err_has ".c or .cpp an array, .S assembler"
for name in 2nd new a-b _x a__b linux; do run 1 embed box.espl -o bad.c --symbol $name; done
run 1 embed box.espl -o new.c
err_has "'new' cannot name a variable"
for alignment in 0 3 131072 -16; do run 1 embed box.espl -o bad.c --alignment $alignment; done
run 1 embed box.espl -o bad.c --section '.rodata,"aw"'
run 1 embed box.espl -o bad.c --header bad.c
run 1 embed box.espl -o bad.c --header "$PWD/./bad.c"
err_has "--header and -o name the same file"
run 3 embed box.obj -o bad.c --header bad.h
err_has "'box.obj' is refused"
run 2 embed missing.espl -o bad.c --header bad.h
cp box.espl blob.c
run 1 embed blob.c -o blob.c
same box.espl blob.c
for file in bad.c bad.h new.c; do absent $file; done

# ---- writing --------------------------------------------------------------------------------------------------------
claim "outputs that cannot be written are exit status 2, name the file, and leave nothing behind"
run 2 bake box.obj -o missing_folder/x.espl
err_has "missing_folder/x.espl"
mkdir occupied occupied/x.espl
run 2 bake box.obj -o occupied/x.espl
only occupied "x.espl "
if [ -c /dev/full ]; then
    run 2 bake box.obj -o /dev/full
    run 2 render box.espl -o /dev/full --size 8x8
    "$espalier" info box.espl >/dev/full 2>err
    [ $? = 2 ] || fail "a full stdout went unnoticed"
    "$espalier" dump box.espl --json >/dev/full 2>err
    [ $? = 2 ] || fail "a full stdout went unnoticed"
fi
if [ "$(id -u)" != 0 ]; then
    mkdir locked
    chmod a-w locked
    run 2 bake box.obj -o locked/x.espl
    chmod u+w locked
    only locked ""
fi
(ulimit -f 1 && trap '' XFSZ && "$espalier" bake sheet.obj -o limited.espl 2>err)
[ $? = 2 ] || fail "a disk that fills up in the middle is not exit status 2: $(cat err)"
absent limited.espl

claim "a failed bake leaves the old blob and the folder as they were"
mkdir kept
cp box.espl kept/x.espl
run 3 bake not_finite.obj -o kept/x.espl
run 5 bake junk.unknown -o kept/x.espl
(cd kept && ulimit -f 1 && trap '' XFSZ && "$espalier" bake ../sheet.obj -o x.espl 2>/dev/null)
same box.espl kept/x.espl
only kept "x.espl "
run 0 bake sheet.obj -o kept/x.espl --ids --materials 8
same sheet.espl kept/x.espl
only kept "x.espl "

claim "a bake that is killed at any moment leaves the old blob or the new one, never a part"
awk 'BEGIN { n = 150
    for (i = 0; i <= n; ++i) for (j = 0; j <= n; ++j) printf "v %g %g %g\n", i, 3 * sin(i / 5) * cos(j / 7), j
    for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) { a = i * (n + 1) + j + 1
        printf "f %d %d %d\nf %d %d %d\n", a, a + 1, a + n + 2, a, a + n + 2, a + n + 1 } }' >large.obj
run 0 bake large.obj -o large.espl -q --effort 0
mkdir killed
start_baking() { # a shell has what it starts in the background ignore interrupts
    cp box.espl killed/x.espl
    env --default-signal=INT "$espalier" bake large.obj -o killed/x.espl -q --effort 0 &
    baking=$!
}
# As soon as there is a file beside the output; false when the bake was faster.
kill_in_the_middle() { # SIGNAL
    while kill -0 $baking 2>/dev/null && [ -z "$(find killed -name '.*' -type f)" ]; do :; done
    kill "-$1" $baking 2>/dev/null
    wait $baking 2>/dev/null
    [ $? -gt 128 ]
}
in_the_middle=0
for try in $(seq 24); do
    start_baking
    if [ $((try % 2)) = 0 ]; then
        kill_in_the_middle KILL && in_the_middle=$((in_the_middle + 1))
    else
        sleep "0.$((RANDOM % 3))$((RANDOM % 10))"
        kill -KILL $baking 2>/dev/null
        wait $baking 2>/dev/null
    fi
    cmp -s killed/x.espl box.espl || cmp -s killed/x.espl large.espl || fail "killed: neither the old blob nor the new one"
    rm -f killed/.x.espl.*
done
[ $in_the_middle -gt 0 ] || fail "no bake was killed in the middle of writing"
for signal in INT TERM HUP; do
    for try in $(seq 20) never; do
        start_baking
        kill_in_the_middle $signal && break
    done
    [ $try != never ] || fail "no bake was stopped by $signal in the middle of writing"
    only killed "x.espl "
    rm -f killed/.x.espl.*
done

claim "an input that cannot be read is exit status 2 or 3, names the file, and leaves the old blob"
if [ -e /proc/self/mem ]; then
    ln -s /proc/self/mem unreadable.obj # opens, and every read fails
    ln -s /proc/self/mem unreadable.espl
    cp box.espl killed/x.espl
    "$espalier" bake unreadable.obj -o killed/x.espl >out 2>err
    code=$?
    [ $code = 2 ] || [ $code = 3 ] || fail "an input whose reads fail ended with $code: $(head -c 400 err)"
    err_has "unreadable.obj"
    same killed/x.espl box.espl
    run 2 info unreadable.espl
    err_has "unreadable.espl"
fi
mkdir folder.obj
"$espalier" bake folder.obj -o killed/x.espl >out 2>err
code=$?
[ $code = 2 ] || [ $code = 3 ] || fail "a folder as input ended with $code"
err_has "folder.obj"
only killed "x.espl "

claim "an input is never replaced by its own output"
run 1 bake box.obj -o box.obj
err_has "itself"
run 1 bake sheet.obj box.obj -o ./box.obj
run 1 render box.espl -o box.espl
run 0 bake box.obj -o x.espl
same x.espl box.espl

claim "a link is written through, and a device stays a device"
ln -s target.espl link.espl
cp box.espl target.espl
run 0 bake sheet.obj -o link.espl --ids --materials 8
[ -L link.espl ] || fail "the link was replaced"
same target.espl sheet.espl
run 0 bake box.obj -o /dev/null
[ -c /dev/null ] || fail "/dev/null was replaced"
run 0 bake box.obj -o /dev/stdout -q
same out box.espl

# ---- info, verify ---------------------------------------------------------------------------------------------------
claim "info tells what is inside, for people and for scripts"
run 0 info sheet.espl
for word in "format" "triangles     3200" "vertices" "lattice" "max error" "original_ids, materials_8" "depth" "checksum" "nodes" \
    "leaves" "guard" "sources" "per triangle"; do
    out_has "$word"
done
run 0 info sheet.espl --json
for key in schema format_version triangles vertices bytes bytes_per_triangle sections bits step extent max_error depth profile \
    checksum bounds nodes leaves features closed; do
    out_has "\"$key\": "
done
out_has '"format_version": "2.'
out_has "\"bytes\": $(stat -c %s sheet.espl)"

claim "edge flags and bounds are there on request, and the report tells how much space the bounds take"
run 0 bake sheet.obj -o extras.espl --edge-flags --bounds obb,sphere,kdop
err_has "volume: axis-aligned box "
err_has "oriented box "
err_has "26-DOP "
run 0 bake sheet.obj -o extras5.espl -q --edge-flags --flat-angle 5 --bounds sphere --bounds kdop,obb --json
out_has '"volumes": {'
same extras.espl extras5.espl
run 0 verify extras.espl --deep
run 0 info extras.espl
for word in "format        2.0" "edge_flags, oriented_box, bounding_sphere, k_dop" "half axis" "radius"; do
    out_has "$word"
done
run 0 info extras.espl --json
for key in oriented_box half_axes sphere radius k_dop direction; do
    out_has "\"$key\": "
done
run 0 dump extras.espl
for word in "squared sine of what is flat: 127441 / 2^24" "quaternion w x y z" "radius, in steps / 16" "along 1 -1 -1: low and high"; do
    out_has "$word"
done

claim "verify accepts what bake wrote, deep and against its source"
run 0 verify sheet.espl --deep --source sheet.obj
out_has "ok, 3200 triangles"
run 0 verify two.espl --deep --source box.obj far_box.obj
run 0 verify box.espl --deep --json
out_has '"ok": true'
out_has '"deep": true'
run 0 bake box.obj -o inches.espl --unit in --up z
run 0 verify inches.espl --source box.obj --unit in --up z

claim "verify names a box that ends far from the asset, which only --deep asks about"
run 0 bake sheet.obj -o near.espl --profile balanced
{ head -c 12 near.espl; printf '\0\0\0\0'; tail -c +17 near.espl | head -c 152; printf '\377'; tail -c +170 near.espl; } >unsigned.espl
{ head -c 12 unsigned.espl; gzip -c unsigned.espl | tail -c 8 | head -c 4; tail -c +17 unsigned.espl; } >far.espl # CRC-32
run 0 verify near.espl --deep
run 0 verify far.espl
run 3 verify far.espl --deep
err_has "node 0 (byte 128) has a box that ends too far beyond the asset: on x"
err_has ". Bake it again."

claim "verify refuses another source, or the same in another unit"
run 3 verify sheet.espl --source far_box.obj
err_has "farther from the baked surface"
run 3 verify inches.espl --source box.obj
run 3 verify empty.espl --source box.obj
run 2 verify box.espl --source missing.obj

claim "a blob that is cut short, changed, newer or none at all is refused by every verb, and the status says why"
size=$(stat -c %s sheet.espl)
head -c $((size - 1)) sheet.espl >short.espl
head -c 20 sheet.espl >stub.espl
{ cat sheet.espl; printf 'x'; } >long.espl
{ head -c 4 sheet.espl; printf '\011\000'; tail -c +7 sheet.espl; } >newer.espl
{ head -c 200 sheet.espl; printf '\377\377'; tail -c +203 sheet.espl; } >changed.espl
: >none.espl
for verb in info verify dump "query|ray 0 0 0 1 0 0" render; do
    for blob in short stub long changed none; do
        case $verb in
            query*) arguments="query $blob.espl ${verb#*|}" ;;
            render) arguments="render $blob.espl -o refused.png" ;;
            *) arguments="$verb $blob.espl" ;;
        esac
        # shellcheck disable=SC2086
        run 3 $arguments
        err_has "'$blob.espl' is refused: "
    done
done
absent refused.png
run 5 info newer.espl
run 5 verify newer.espl --json
out_has '"ok": false'
out_has '"status": 4'
run 3 info box.obj
err_has "espalier bake"
run 2 info missing.espl
run 2 info .
run 3 verify changed.espl --deep --json
out_has '"ok": false'

claim "blobs and junk may come through a pipe"
"$espalier" info /dev/stdin <sheet.espl >out 2>err || fail "redirected blob"
cat sheet.espl | "$espalier" info /dev/stdin >out 2>err || fail "piped blob"
out_has "triangles     3200"
awk 'BEGIN { for (i = 0; i < 9999; ++i) printf "junk" }' | "$espalier" info /dev/stdin >out 2>err
[ $? = 3 ] || fail "piped junk is not exit status 3"

# ---- which triangle was that ----------------------------------------------------------------------------------------
claim "a remap file and a source in the blob's order lead back without ids in the blob"
run 0 bake sheet.obj -o lean.espl --profile small
run 0 bake sheet.obj -o lead.espl --profile small --remap order.bin --reorder order.ply
same lean.espl lead.espl
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
printf '{"byte_price": 0}' >own.json
for output in -o --remap --depfile; do
    others="-o own.espl"
    [ "$output" != -o ] || others=
    # shellcheck disable=SC2086  # words
    run 1 bake own.obj $others $output own.mtl
    err_has "'own.mtl' is the input"
    err_has "Give another name to $output"
done
run 0 bake own.obj -o own.espl -q
run 1 bake own.obj -o new.espl --lattice-of own.espl --remap own.espl
run 1 bake own.obj -o new.espl --cost-model own.json --remap own.json
for option in --step --lattice-of --remap --reorder; do
    run 1 bake own.obj -o new.espl "$option" ""
done
absent new.espl
printf 'v 0 0 0\nv nan 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\nf 1 4 3\n' >half.obj
run 0 bake half.obj -o half.espl -q --repair --max-dropped 50% --reorder whole.obj
! grep -qi nan whole.obj || fail "the reordered source has a vertex that no triangle uses"
run 1 bake sheet.obj -o lead.espl --remap sheet.obj

# ---- dump, render ---------------------------------------------------------------------------------------------------
claim "dump shows every byte once and in order"
"$espalier" bake sheet.obj -o strips.espl -q --ids --materials 16 --profile balanced || fail "no strips"
"$espalier" bake sheet.obj -o split.espl -q --ids --profile fast --builder spatial_splits || fail "no splits"
run 0 dump split.espl
for word in "low x 0" "node children" "leaf 0: data at 4 x 0 of the block" "no more leaves" "first triangle 0" "corner a, 8 bits: 0" \
    "ids of triangles from 0:"; do
    out_has "$word"
done
for blob in box sheet two empty strips split; do
    "$espalier" dump $blob.espl | grep -v '^--' | cut -c 11-57 | tr -d ' \n' >dumped
    od -A n -v -t x1 $blob.espl | tr -d ' \n' >expected
    same dumped expected
done
run 0 dump sheet.espl
for word in 'magic "ESPL"' "lattice bits 16" "node 0: base 0" "leaf block at" "first triangle 0" "bits:" "source 0: ids from 0" \
    "materials of triangles from 0:"; do
    out_has "$word"
done
run 0 dump strips.espl
for word in "profile 1" "entries, triangles from 0 + 0" "entries (* pivot): 0* " "; triangles: 0-1-2" "ids.first corners of triangles from 0:"; do
    out_has "$word"
done
run 0 verify strips.espl --deep

claim "a limited dump says what it leaves out; a refused blob shows its header"
run 0 dump sheet.espl --limit 10
[ "$(wc -l <out)" = 11 ] || fail "$(wc -l <out) lines"
out_has "-- left out: "
run 0 dump sheet.espl --limit 10 --json
out_has '"bytes_left_out": '
run 3 dump changed.espl
out_has 'magic "ESPL"'
run 3 dump stub.espl
out_has "cut short"

claim "render writes a PNG of the asked size, the same at any number of threads"
run 0 render sheet.espl -o a.png --size 64x48 --threads 1
run 0 render sheet.espl -o b.png --size 64x48 --threads 3 --json
out_has '"width": 64'
same a.png b.png
[ "$(od -A n -t x1 -N 8 a.png | tr -d ' ')" = 89504e470d0a1a0a ] || fail "no PNG signature"
[ "$(od -A n -t x1 -j 16 -N 8 a.png | tr -d ' ')" = 0000004000000030 ] || fail "not 64 x 48"
for size in 0x5 5x0 64 64x 64x48x2 x -5x5 99999x5; do run 1 render sheet.espl -o c.png --size=$size; done
absent c.png

claim "the heat map says how much work its colours stand for"
run 0 render sheet.espl -o heat.png --size 64x48 --heatmap steps
err_has "steps a ray: "
run 0 render sheet.espl -o heat.png --size 64x48 --heatmap steps --json -q
out_has '"mean": '
run 1 render sheet.espl -o heat.png --heatmap joy
cmp -s a.png heat.png && fail "the heat map looks like the shaded picture"

# ---- trade ----------------------------------------------------------------------------------------------------------
claim "trade writes a row for each combination, with what was chosen and what came out"
quick="--rays 300 --repetitions 1"
# shellcheck disable=SC2086
run 0 trade sheet.obj --bits 10,16 --leaf-sizes 4,16,20 --byte-prices 5 --builders binned_sah,linear --profiles fast $quick
[ "$(wc -l <out)" = 9 ] || fail "$(wc -l <out) lines for 8 combinations"
for column in mesh profile builder bits leaf_size byte_price triangles bytes bytes_per_triangle max_error mean_error closest_ns \
    any_ns overlap_ns nodes_per_ray leaves_per_ray triangles_per_ray counted_cost bake_seconds pareto_closest; do
    head -n 1 out | tr ',' '\n' | grep -qx $column || fail "no column $column"
done
awk -F , 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; columns = NF; next }
    { if (NF != columns) { print "columns"; exit }
      if (!($at["bytes"] > 0 && $at["closest_ns"] > 0 && $at["any_ns"] > 0 && $at["overlap_ns"] > 0 && $at["nodes_per_ray"] >= 1))
          print "no measurement in row " NR
      if (!($at["mean_error"] > 0 && $at["mean_error"] <= $at["max_error"] * 1.001)) print "mean error in row " NR
      front += $at["pareto_closest"] }
    END { if (front < 2) print "no front" }' out >complaints
[ ! -s complaints ] || fail "$(cat complaints)"

claim "trade counts the same twice, whatever the clock says"
counts() { awk -F , 'NR == 1 { for (i = 1; i <= NF; ++i) keep[i] = $i !~ /_ns|seconds|pareto/ }
    { line = ""; for (i = 1; i <= NF; ++i) if (keep[i]) line = line "," $i; print line }' "$1"; }
# shellcheck disable=SC2086
run 0 trade sheet.obj --bits 12 $quick --csv a.csv
[ ! -s out ] || fail "the numbers went to a file and to stdout"
# shellcheck disable=SC2086
run 0 trade sheet.obj --bits 12 $quick --csv b.csv --threads 2
counts a.csv >a.counts
counts b.csv >b.counts
same a.counts b.counts

claim "trade draws a picture that is well-formed, names what it shows, and survives odd file names"
cp sheet.obj "$(printf 'a<b>&"\377c.obj')"
# shellcheck disable=SC2086
run 0 trade "$(printf 'a<b>&"\377c.obj')" -o trade.svg --csv trade.csv $quick
grep -q "a&lt;b&gt;&amp;&quot;?c.obj" trade.svg || fail "the name is not escaped"
for word in "closest hit" "any hit" "sphere overlap" "bytes a triangle" "lattice of 16 bits: error at most" "profile fast" "profile small" "<polygon\|<circle" \
    "The front of closest hits"; do
    grep -q "$word" trade.svg || fail "the picture lacks '$word'"
done
if command -v xmllint >/dev/null; then
    xmllint --noout trade.svg 2>err || fail "no XML: $(head -c 300 err)"
else
    # every tag is closed, in itself or by the line's end, but the outermost
    grep -v '^<?xml\|^<svg\|^</svg>$' trade.svg | grep -qv '^<[a-z]*\( [a-zA-Z0-9-]*="[^"<]*"\)*\(/>\|>[^<]*</text>\)$' && fail "a line is no element"
    [ "$(tail -n 1 trade.svg)" = "</svg>" ] || fail "the picture is cut short"
fi

claim "trade leaves out what does not go together, and refuses when nothing is left"
run 0 trade box.obj --bits 8 --builders binned_sah,spatial_splits --profiles small $quick --csv some.csv
[ "$(grep -c binned_sah some.csv)" -gt 0 ] || fail "nothing is measured"
grep -q spatial_splits some.csv && fail "what cannot be baked is measured"
run 1 trade box.obj --bits 8 --builders spatial_splits --profiles balanced,small $quick -o refused.svg
err_has "spatial splits need the profile fast"
absent refused.svg

claim "trade refuses lists that make no sense, and what cannot be measured"
for list in "--bits 0" "--bits 12,25" "--bits 12.5" "--bits many" "--bits 12,," "--leaf-sizes 63" "--byte-prices -1" "--profiles huge" \
    "--builders quick" "--rays 5" "--repetitions 0"; do
    # shellcheck disable=SC2086
    run 1 trade box.obj $list -o refused.svg
done
run 1 trade box.obj -o box.obj
run 2 trade missing.obj
run 3 trade points.obj
run 3 trade box.obj --cost-model model.json
err_has "model.json"
absent refused.svg

# ---- JSON -----------------------------------------------------------------------------------------------------------
claim "every --json is one JSON object with a schema"
if command -v jq >/dev/null; then
    cp box.obj "$(printf 'l\303\251vel \377.obj')"
    for arguments in "bake box.obj $(printf 'l\303\251vel') -o x.espl" "bake box.obj -o x.espl" "bake box.obj -o x.espl --max-bytes 1K" "info sheet.espl" \
        "verify sheet.espl --deep --source sheet.obj" "query box.espl ray 0 0 0 nan 0 0" "query box.espl ray 0 1 9 0 0 -1 --all" \
        "query box.espl sphere 0 0 0 inf" "query box.espl nearest 0 0 9" "render box.espl -o x.png --size 8x8" \
        "trade box.obj --rays 100 --bits 9,16" "dump sheet.espl" "dump changed.espl"; do
        # shellcheck disable=SC2086
        "$espalier" $arguments --json 2>/dev/null >out
        [ ! -s out ] || jq -e '.schema == 1' out >/dev/null || fail "$arguments"
    done
    run 0 bake "$(printf 'l\303\251vel \377.obj')" -o x.espl --json
    jq -e '.inputs[0].triangles == 12' out >/dev/null || fail "a name that is no UTF-8"
else
    echo "note: without jq only the keys of the JSON were looked at"
fi

only . "$(ls -A . | tr '\n' ' ')"
ls -A . | grep -q '\.espl\.......$' && fail "a temporary was left behind"
finish
