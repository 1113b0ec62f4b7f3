#!/usr/bin/env bash
# Tests of what the command does where calls of the system fail: reads in the middle of a file, and limits on importers.
# Usage: failing_calls_test.sh PATH_TO_ESPALIER
# Exit status 77: nothing is broken, and what needs a library that is preloaded was not tested.
# shellcheck source=meshes.sh
. "$(dirname "$0")/meshes.sh"

claim "a folder in place of a file is exit status 2, with its name and the reason"
mkdir folder folder.obj folder.espl
cp box.espl kept.espl
for arguments in "bake folder.obj -o kept.espl" "verify box.espl --source folder.obj" "bake box.obj -o kept.espl --lattice-of folder.espl" \
    "info folder.espl" "embed folder.espl -o x.c" "query folder.espl ray 0 0 0 1 0 0"; do
    # shellcheck disable=SC2086  # words
    run 2 $arguments
    grep -qE "cannot read 'folder.(obj|espl)': ([Ii]s a directory|it is a folder)" err || fail "espalier $arguments: $(cat err)"
done
"$espalier" info - <folder >out 2>err
[ $? = 2 ] || fail "a folder as standard input: $(cat err)"
err_has "cannot read '-': Is a directory"
printf '{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"folder"}],"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,0]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}' >beside.gltf
refuses 2 "cannot read 'folder'" bake beside.gltf -o kept.espl
printf 'mtllib folder\nmtllib .\n' | cat - box.obj >library.obj
makes library.espl box.espl bake library.obj -o library.espl -q
same kept.espl box.espl

# Calls fail in the command alone, by a library that it loads first. A sanitizer's own library would have to be the first.
calls=$tests_folder/failing_calls.c
if [ "$(uname -s)" != Linux ] || ! cc -shared -fPIC "$calls" -o failing_calls.so -ldl 2>log || grep -q __asan_init "$espalier"; then
    echo "skipped: no call can be made to fail here: $(tail -n 1 log)"
    finish || exit 1
    exit 77
fi
# failing VARIABLE ARGUMENTS...: runs the command with the calls that the variable names failing
failing() {
    local variable=$1
    shift
    env LD_PRELOAD="$PWD/failing_calls.so" "$variable" "$espalier" "$@" >out 2>err
}

claim "a read that fails, at once or in the middle, is exit status 2, with the file's name and the reason"
write_box_collada "" 1 Y_UP >failing.dae
cp sheet.obj failing.obj
cp sheet.espl failing.espl
cp box.ply failing.ply
cp box.stl failing.stl
sed -n 's/^v //p' box.obj | tr '\n' ' ' | awk '{ for (i = 0; i < 50; ++i) print $1, $2, $3, $4, $5, $6, $7, $8, $9 }' >failing.raw
python3 -B - "$tests_folder" <<'PYTHON' || fail "no glTF was made"
import json
import sys
sys.path.insert(0, sys.argv[1])
from gltf.builder import Gltf
gltf = Gltf()
points = [[(i * i * 31 + i * 7) % 97 for i in range(3 * k, 3 * k + 3)] for k in range(1200)]
gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(points)}}))
gltf.write("failing.glb")
gltf.write("mesh.gltf", ("failing.bin", "failing.bin"))
with open("failing.gltf", "w") as file:
    json.dump(gltf.document("failing.bin"), file, indent=60)
PYTHON
{ printf '\377\376' && iconv -t UTF-16LE failing.dae; } >failing_utf16.dae
printf 'mtllib failing.mtl\n' | cat - box.obj >materials.obj
printf 'newmtl stone\nKd 1 1 1\n' >failing.mtl
for mesh in failing.obj failing.ply failing.stl failing.raw failing.dae failing_utf16.dae failing.glb failing.gltf mesh.gltf materials.obj; do
    named=$mesh
    [ $mesh != mesh.gltf ] || named=failing.bin
    [ $mesh != materials.obj ] || named=failing.mtl
    run 0 bake $mesh -o x.espl -q
    failing FAILING_FROM=1000000 bake $mesh -o y.espl -q || fail "a library that makes no call fail changes the bake of $mesh: $(cat err)"
    same x.espl y.espl
    for from in 0 3 $(($(stat -c %s $named) / 2)) $(($(stat -c %s $named) - 1)); do
        failing FAILING_FROM="$from" bake $mesh -o kept.espl --json
        [ $? = 2 ] || fail "$mesh, reads fail from byte $from: $(cat err)"
        err_has "$named': Input/output error"
        json '.error.kind == "file_access"'
    done
done
for from in 0 100 $(($(stat -c %s failing.espl) - 1)); do
    for arguments in "info failing.espl" "verify failing.espl" "embed failing.espl -o x.c" "dump failing.espl --json" \
        "bake box.obj -o kept.espl --lattice-of failing.espl"; do
        # shellcheck disable=SC2086  # words
        failing FAILING_FROM="$from" $arguments
        [ $? = 2 ] || fail "$arguments, reads fail from byte $from: $(cat err)"
        err_has "cannot read 'failing.espl': Input/output error"
    done
done
same kept.espl box.espl

claim "a header whose old bytes cannot be read is written anew"
run 0 embed box.espl -o level.c --header failing.h -q
cp failing.h expected.h
touch -d '2020-01-01' failing.h
failing FAILING_FROM=10 embed box.espl -o level.c --header failing.h -q || fail "$(cat err)"
same failing.h expected.h
[ "$(stat -c %Y failing.h)" != "$(date -d '2020-01-01' +%s)" ] || fail "the header is the old one"

claim "a limit on importers that cannot be set is exit status 5, with its option and the reason"
failing FAILING_LIMITS=memory bake box.obj -o kept.espl --json
[ $? = 5 ] || fail "no limit on memory was set, and: $(cat err)"
err_has "'box.obj': the limit of --import-memory cannot be set: Operation not permitted. For files that you trust, --import-memory none"
json '.error.kind == "import_memory" and .error.file == "box.obj"'
failing FAILING_LIMITS=memory bake box.obj -o x.espl -q --import-memory none || fail "--import-memory none: $(cat err)"
same x.espl box.espl
failing FAILING_LIMITS=time bake box.obj -o kept.espl --json
[ $? = 5 ] || fail "no limit on time was set, and: $(cat err)"
err_has "'box.obj': the limit of --import-seconds cannot be set: Operation not permitted."
json '.error.kind == "import_seconds" and .error.file == "box.obj"'
same kept.espl box.espl

finish
