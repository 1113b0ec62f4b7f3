#!/usr/bin/env bash
# Tests of what is different on Windows: names, line ends, replaced files, and the parts that this build lacks.
# Usage: system_test.sh PATH_TO_ESPALIER PATH_TO_ESPALIER_OF_THIS_SYSTEM
# shellcheck source=../meshes.sh
. "$(dirname "$0")/../meshes.sh"
native=$(realpath "$2")

claim "blobs have the bytes that this system bakes"
for mesh in box.obj box.ply box.stl sheet.obj; do
    run 0 bake $mesh -o windows.espl --ids -q
    "$native" bake $mesh -o here.espl --ids -q || fail "this system does not bake $mesh"
    same windows.espl here.espl
done

claim "answers and documents have the bytes of this system, line ends included"
for arguments in "info sheet.espl" "info sheet.espl --json" "dump box.espl" "verify sheet.espl --deep" \
    "query sheet.espl ray 3.5 9 3.5 0 -1 0" "query sheet.espl closest-point 1 2 3 --json" "bake --help" "--version"; do
    # shellcheck disable=SC2086
    run 0 $arguments
    # shellcheck disable=SC2086
    "$native" $arguments >expected 2>/dev/null
    same out expected
done
makes out box.espl bake box.obj -o /dev/stdout -q

claim "names with letters of any language, spaces and backslashes are read and written"
mkdir -p 'Höhle/δοκιμή 試験'
cp box.obj 'Höhle/δοκιμή 試験/кость.obj'
reports 'Höhle\出力.espl' bake 'Höhle\δοκιμή 試験\кость.obj' -o 'Höhle\出力.espl' --json
out_has 'Höhle\\δοκιμή 試験\\кость.obj'
same 'Höhle/出力.espl' box.espl
run 0 info 'Höhle/出力.espl'
run 0 info - <'Höhle/出力.espl'
refuses 2 'Höhle\missing.espl' info 'Höhle\missing.espl'
cp box.obj 'Höhle/with.obj'
printf 'mtllib δ.mtl\n' | cat - box.obj >'Höhle/with.obj'
echo 'newmtl stone' >'Höhle/δ.mtl'
run 0 bake 'Höhle\with.obj' -o x.espl -q --depfile x.d
grep -q 'δ.mtl' x.d || fail "the depfile lacks the library of materials: $(cat x.d)"

claim "a file is replaced whole or not at all, and no temporary stays"
mkdir replaced
cp sheet.espl replaced/x.espl
makes replaced/x.espl box.espl bake box.obj -o 'replaced\x.espl' -q
only replaced "x.espl "
run 3 bake not_finite.obj -o 'replaced\x.espl'
same replaced/x.espl box.espl
refuses 2 'missing\x.espl' bake box.obj -o 'missing\x.espl'
mkdir replaced/folder.espl
run 2 bake box.obj -o 'replaced\folder.espl'
refuses 1 "itself" bake box.obj -o '.\box.obj'
only replaced "folder.espl x.espl "

claim "a link as an output is written through"
mkdir linked
cp sheet.espl linked/target.espl
ln -s linked/target.espl link.espl
run 0 bake box.obj -o link.espl -q
[ -L link.espl ] || fail "the link was replaced"
same linked/target.espl box.espl
only linked "target.espl "
cp sheet.espl linked/target.espl
chmod a-w linked/target.espl
run 2 bake box.obj -o link.espl --depfile link.d
absent link.d
same linked/target.espl sheet.espl
chmod u+w linked/target.espl

claim "names in files that are no UTF-8 are those of missing files"
{ printf 'mtllib H\366hle.mtl\n'; cat box.obj; } >latin.obj
makes latin.espl box.espl bake latin.obj -o latin.espl -q

claim "a file that must not be replaced is refused before the work begins"
cp sheet.espl kept.espl
chmod a-w kept.espl
run 2 bake box.obj -o kept.espl --depfile kept.d
absent kept.d
same kept.espl sheet.espl
chmod u+w kept.espl

claim "what this build cannot read or write is refused by name, with the remedy"
write_box_collada "" 1 Y_UP >box.dae
refuses 5 "'box.dae' cannot be imported" bake box.dae -o refused.espl --json
err_has "has no assimp. Convert it"
printf 'PK\3\4' >box.3mf  # as a zip archive begins
refuses 5 "has no expat and zlib" bake box.3mf -o refused.espl
refuses 5 "has no libpng" render box.espl -o refused.png --size 8x8
for extension in KHR_draco_mesh_compression EXT_meshopt_compression; do
    printf '%s' "$extension" >name
    python3 - "$extension" <<'PYTHON' >packed.gltf || fail "no glTF was made"
import json
import sys
extension = sys.argv[1]
primitive = {"attributes": {"POSITION": 0}, "indices": 1}
view = {"buffer": 0, "byteLength": 36}
if extension.startswith("KHR"):
    primitive["extensions"] = {extension: {"bufferView": 0, "attributes": {"POSITION": 0}}}
else:
    view["extensions"] = {extension: {"buffer": 0, "byteLength": 36, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}}
print(json.dumps({
    "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "extensionsRequired": [extension], "extensionsUsed": [extension], "meshes": [{"primitives": [primitive]}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + "A" * 48}], "bufferViews": [view],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]},
                  {"bufferView": 0, "componentType": 5125, "count": 3, "type": "SCALAR"}]}))
PYTHON
    refuses 5 "packed.gltf" bake packed.gltf -o refused.espl
    err_has "which this build does not read"
done
absent refused.espl refused.png

claim "a file that takes longer than --import-seconds is refused by that name"
awk 'BEGIN { for (i = 0; i < 600000; ++i) print "v 0 0 0"; for (i = 1; i < 590000; ++i) print "f", i, i + 1, i + 2 }' >slow.obj
run 3 bake slow.obj -o refused.espl --import-seconds 0.02 --json
err_has "'slow.obj': reading it took more than 0.02 s of processor time, the limit of --import-seconds"
absent refused.espl

finish
