#!/usr/bin/env bash
# Claims about what a bake refuses: too much dropped, nothing left, an unexpected size, warnings, files without bound.
# Usage: policy_test.sh PATH_TO_ESPALIER
# shellcheck source=claims.sh
. "$(dirname "$0")/claims.sh"

# refused KIND WORDS ARGUMENTS...: exit status 3, the error's kind, the words on stderr, and no output
refused() {
    local kind=$1 words=$2
    shift 2
    rm -f x.espl x.d x.remap x.ply
    fails 3 ".error.kind == \"$kind\"" bake "$@" -o x.espl --depfile x.d --remap x.remap --reorder x.ply
    err_has "$words"
    absent x.espl x.d x.remap x.ply
}

write_box_obj 0 >box.obj
"$espalier" bake box.obj -o box.espl -q
# 12 triangles with area and 4 without: 25 percent.
{ write_box_obj 0; printf 'v 2 0 0\nv 3 0 0\nf 1 2 9\nf 1 2 10\nf 1 9 10\nf 2 9 10\n'; } >quarter.obj
printf 'v 0 0 0\nv 1 0 0\nl 1 2\n' >points.obj
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >line.obj

claim "more dropped triangles than --max-dropped are an error with their number and kind and duplicates do not count"
refused dropped "dropped 4 of 16 triangles: 4 without area (first: quarter.obj, mesh 0" quarter.obj
json '.error.file == "quarter.obj" and .error.mesh == 0 and .error.triangle == 12'
err_has "--max-dropped"
refused dropped "" box.obj quarter.obj
json '.error.file == "quarter.obj" and .error.triangle == 12'
refused dropped "" quarter.obj --max-dropped 24.9%
run 0 bake quarter.obj -o x.espl --max-dropped 25%
run 0 bake quarter.obj -o x.espl --max-dropped 25
{ write_box_obj 0; printf 'v 2 0 0\nf 1 2 9\n'; } >thirteenth.obj
run 0 bake thirteenth.obj -o x.espl
refused dropped "" thirteenth.obj --max-dropped 0
{ write_box_obj 0; write_box_obj 0 | grep '^f'; } >twice.obj
finds '.findings.duplicate.count == 12' bake twice.obj -o x.espl --max-dropped 0
# Of a box that is long in one direction, the lattice leaves little.
sed 's/^v 1 \(.*\)/v 1e6 \1/' box.obj >long.obj
refused dropped "without area on the lattice" long.obj --bits 4
json '.error.file == "long.obj" and .error.mesh == 0 and .error.triangle == 0'
err_has "a finer lattice"
refused dropped "" quarter.obj --max-bytes 10K
# Half of the triangles are so small that a coarse lattice flattens them: bytes for the other half alone are too few.
awk 'BEGIN { for (i = 0; i < 40; ++i) { s = i % 2 ? 1 : 100; x = 7 * i
    printf "v %d 0 %d\nv %d 0 %d\nv %d %d %d\nf -3 -2 -1\n", x, i, x + s, i, x, s, i + s } }' >uneven.obj
fails 5 '.error.kind == "unsupported"' bake uneven.obj -o x.espl --max-bytes 500
err_has "A coarser lattice drops more triangles than --max-dropped allows"
run 0 bake uneven.obj -o x.espl --max-bytes 500 --max-dropped 60
for percent in -1 101 nan ten ""; do run 1 bake box.obj -o x.espl --max-dropped "$percent"; done

claim "an empty result is an error unless it is allowed"
refused empty "" points.obj
err_has "the input has no triangles" "--allow-empty" "'points.obj'"
err_lacks "the blob is valid"
json '.error.file == "points.obj"'
refused empty "'points.obj': the input has no triangles" box.obj points.obj
run 0 bake box.obj points.obj -o x.espl --allow-empty
refused dropped "and give --allow-empty" line.obj
refused dropped "" line.obj --allow-empty
refused empty "'line.obj': no triangle is left" line.obj --max-dropped 100
err_lacks "the blob is valid"
json '.error.file == "line.obj"'
finds '.triangles == 0 and .warnings == []' bake points.obj -o x.espl --allow-empty --strict
run 0 bake line.obj -o x.espl --allow-empty --max-dropped 100 --strict

claim "--strict refuses a bake with warnings and lists them and takes one without"
refused strict "warning: 'box.obj': the asset is 3000 m across" box.obj --strict --unit km
json '.error.file == "box.obj" and .warnings[0].file == "box.obj"'
err_has "'box.obj': --strict refuses 1 warning: unexpected_size"
json '[.warnings[].kind] == ["unexpected_size"]'
refused strict "" box.obj --strict --unit km --bits 23
json '[.warnings[].kind] == ["rays_rounded_coarsely", "unexpected_size"]'
cp box.obj same.obj
refused strict "'box.obj', 'same.obj': --strict refuses" box.obj same.obj --strict --unit km
json '.error.file == null'
run 0 bake box.obj -o x.espl --strict

claim "a blob among the meshes is named as one"
cp box.espl blob.obj
for blob in box.espl blob.obj; do
    refuses 5 "'$blob' is a blob already. Give the mesh" bake $blob -o x.espl
done

claim "errors about the whole bake list the warnings too"
{ write_box_obj 0; echo faces 7; } >unknown.obj
refused size "" unknown.obj --expect-size 5..6
json '[.warnings[].kind] == ["unknown_statement"]'
{ printf 'v 0 0 0\nv 1 0 0\nl 1 2\nfaces 7\n'; } >nothing.obj
refused empty "" nothing.obj
json '[.warnings[].kind] == ["unknown_statement"]'
err_has "'faces'"

claim "the standard output takes a blob or a document and not both"
for outputs in "bake box.obj -o /dev/stdout" "render box.espl -o /dev/stdout" "embed box.espl -o x.c --header /dev/stdout" \
    "trade box.obj --csv /dev/stdout"; do
    # shellcheck disable=SC2086  # words
    refuses 1 "standard output" $outputs --json
done
absent x.c
run 0 bake box.obj -o x.espl
"$espalier" bake box.obj -o /dev/stdout -q 2>err | cat >y.espl
same x.espl y.espl
"$espalier" bake box.obj -o /dev/stdout -q --json 2>err | cat >out
[ "${PIPESTATUS[0]}" = 1 ] || fail "a pipe takes a blob and a document"
json '.error.kind == "usage"'
echo before >log
{ cat log && cat x.espl; } >both
"$espalier" bake box.obj -o /dev/stdout -q >>log
same both log

claim "--expect-size refuses a size outside of it with the units that would fit and a size within it is no doubt"
refused size "'box.obj': the asset is 3 m across, outside of --expect-size 0.1m..2.9m" box.obj --expect-size 0.1m..2.9m
json '.error.file == "box.obj" and .warnings == []'
err_has "--unit ft makes it 0.9144 m"
refused size "--unit" box.obj --expect-size 3.1m..10m
refused size "--unit m makes it 3 m" box.obj --unit mm --expect-size 0.1m..10m
run_each 0 "bake box.obj -o x.espl" "--expect-size 3..3" "--expect-size 0.1mm..10m" "--unit km --expect-size 1km..10km --strict"
for size in 1m 10m..1m ..1m 1m.. -1m..1m a..b 1m..nan ""; do run 1 bake box.obj -o x.espl --expect-size "$size"; done

claim "--expect-size is about the source and not about the lattice or vertices that nothing uses"
printf 'v 0 0 0\nv 9.9 0 0\nv 0 9.9 0\nv 0 0 99\nf 1 2 3\n' >wide.obj
finds '.extent == 10' bake wide.obj -o x.espl --bits 3 --expect-size 9.9..9.9
refused size "the asset is 9.9 m across" wide.obj --bits 3 --expect-size 1m..9.8m
refused size "" wide.obj --bits 3 --expect-size 10m..11m
for size in 0.1 0.7 3.3 1000.1; do
    awk -v size=$size 'BEGIN { printf "v -%s 0 0\nv 0 0 0\nv 0 %g 0\nf 1 2 3\n", size, size / 2 }' >exact.obj
    run 0 bake exact.obj -o x.espl --unit mm --expect-size ${size}mm..${size}mm --bits 12
done

claim "verify and trade refuse a file without triangles among others unless it is allowed"
for verb in "verify box.espl --source box.obj points.obj" \
    "trade box.obj points.obj --bits 12 --leaf-sizes 16 --byte-prices 1 --profiles small --rays 100 --repetitions 1"; do
    # shellcheck disable=SC2086  # words
    fails 3 '.error.kind == "empty" and .error.file == "points.obj"' $verb
    # shellcheck disable=SC2086  # words
    run 0 $verb --allow-empty
done

claim "verify and trade refuse warnings of the import under --strict and take it without any"
run 0 verify box.espl --source box.obj --strict
run 0 trade box.obj --strict --bits 12 --leaf-sizes 16 --byte-prices 1 --profiles small --rays 100 --repetitions 1

# An AC3D file that claims more vertices than there is memory for.
# The address sanitizer needs more address space than any limit, and ends the process where an allocation fails.
if ! grep -q __asan_init "$espalier"; then
    claim "a file that needs more memory than --import-memory is refused by that name and leaves nothing"
    printf '%s\n' AC3Db 'MATERIAL "" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0' 'OBJECT world' 'kids 1' 'OBJECT poly' \
        'numvert 20000000' '0 0 0' >huge.ac
    refused import_memory "'huge.ac': reading it takes more than 128 MiB of memory, the limit of --import-memory" huge.ac --import-memory 128M
    json '.error.file == "huge.ac"'
    run 0 bake box.obj -o x.espl --import-memory 512M
    run 0 bake box.obj -o x.espl --import-memory none
    run 3 verify box.espl --source huge.ac --import-memory 128M --json
    run 3 trade huge.ac --import-memory 128M --json
    for amount in 0 -1 many 12 512 1023K ""; do run 1 bake box.obj -o x.espl --import-memory "$amount"; done
    refuses 1 "'12' is 12 bytes, too few to read any file. Write 1M or more" bake box.obj -o x.espl --import-memory 12

    claim "memory that a reader takes from malloc counts too"
    awk 'BEGIN { printf "<amf>"
        for (k = 0; k < 3000; ++k) {
            printf "<object id=\"%d\"><mesh><vertices>", k
            for (i = 0; i < 3; ++i) printf "<vertex><coordinates><x>%d</x><y>%d</y><z>%d</z></coordinates></vertex>", i == 1, i == 2, k
            printf "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></object>"
        }
        print "</amf>" }' >many.amf
    for memory in 2M 3M 5M; do refused import_memory "" many.amf --import-memory $memory; done
    finds '.source_triangles == 3000' bake many.amf -o x.espl --import-memory 512M
fi

claim "a file that takes longer than --import-seconds is refused by that name and leaves nothing"
write_sheet 300 'i * j % 7' >slow.obj
refused import_seconds "'slow.obj': reading it took more than 0.002 s of processor time, the limit of --import-seconds" slow.obj --import-seconds 0.002
fails 3 '.error.kind == "import_seconds" and [.warnings[].kind] == ["unknown_statement"]' bake unknown.obj slow.obj -o x.espl --import-seconds 0.002
run 0 bake slow.obj -o x.espl --effort fast -q
for seconds in 0 -1 nan long; do run 1 bake box.obj -o x.espl --import-seconds "$seconds"; done

claim "--verbose prints what the importers report and quiet runs do not"
{ echo '<amf>' && echo '</amf>'; } >none.amf
run 3 bake none.amf -o x.espl --verbose
err_has "importer: "
run 3 bake none.amf -o x.espl
err_lacks "importer: "

finish
