#!/usr/bin/env bash
# A project is baked again exactly when it has to be.
# Usage: rebuild_test.sh PATH_TO_ESPALIER SOURCE_FOLDER CMAKE GENERATOR
# Exit status 77: the generator's tool is missing.
# shellcheck source=projects.sh
. "$(dirname "$0")/projects.sh"

has_generator "$generator" || exit 77

project="$folder/my game"
build="$folder/my build"
blob="$build/espalier_blobs/level/level.espl"
write_level "$project/assets"
write_main "$project"
write_head "$project" "C CXX"
cat >>"$project/CMakeLists.txt" <<'CMAKE'
espalier_add_blob(level MESH assets/level.obj BITS ${bits} MATERIALS ALIGNMENT ${alignment}
  DEPENDS assets/reason.txt REMAP level.remap REORDER models/level.ply)
add_executable(game main.c)
target_link_libraries(game PRIVATE level)
CMAKE
touch "$project/assets/reason.txt"
options=(-Dbits=12 -Dalignment=16 -DESPALIER_EXECUTABLE="$counting")
# A file system may count time in steps; what was built must be older than what is touched.
touch_later() { sleep 0.05 && touch "$1"; }
# builds VERBS...: a build asks for them, one after each other build
builds() {
    local verbs_of_one
    for verbs_of_one in "$@"; do
        must build "$build" --target game
        verbs_are "$verbs_of_one"
    done
}
holds() { # FILE: what the program holds is this blob
    "$build/game" >game.bytes
    same game.bytes "$1"
}

claim "a build bakes once, and the program holds the blob byte for byte"
must configure "$project" "$build" "${options[@]}"
builds "bake embed"
holds "$blob"
run 0 verify "$blob" --deep

claim "the files beside the blob are those of its bake, also after the mesh changed"
cp "$project/assets/level.obj" first.obj
for change in "" "f 2 4 3"; do
    echo "$change" >>"$project/assets/level.obj"
    must build "$build" --target game
    rm -f "$verbs"
    run 0 bake "$project/assets/level.obj" -o expected.espl -q --bits 12 --materials \
        --remap expected.remap --reorder expected.ply
    same expected.espl "$blob"
    same expected.remap "$build/level.remap"
    same expected.ply "$build/models/level.ply"
done
cp first.obj "$project/assets/level.obj"
must build "$build" --target game
rm -f "$verbs"

claim "a build of what is built already bakes nothing"
builds "" ""

claim "a side file that the mesh refers to is looked at: touched, it bakes once; so does the mesh"
for file in level.mtl level.obj; do
    touch_later "$project/assets/$file"
    builds "bake embed" ""
done

claim "what DEPENDS names bakes once when it is touched"
touch_later "$project/assets/reason.txt"
builds "bake embed" ""

claim "a side file that goes away bakes once, without it"
mv "$project/assets/level.mtl" away.mtl
builds "bake embed" ""
mv away.mtl "$project/assets/level.mtl"
touch_later "$project/assets/level.obj"
builds "bake embed"

claim "what includes the header is compiled again only when the header changes"
object=$(find "$build" -name 'main.c.o')
cp -p "$object" before.o
touch_later "$project/assets/level.mtl"
builds "bake embed"
[ ! "$object" -nt before.o ] || fail "main.c was compiled although level.h is the same"
echo "f 2 3 4" >>"$project/assets/level.obj"
builds "bake embed"
[ "$object" -nt before.o ] || fail "main.c was not compiled although level.h is another"
holds "$blob"

claim "another option bakes once; one of the embedding embeds once and bakes nothing"
cp "$blob" before.espl
must configure "$project" "$build" -Dbits=13
builds "bake embed"
must_not cmp -s "$blob" before.espl
must configure "$project" "$build" -Dalignment=64
builds "embed"
must configure "$project" "$build"
builds ""

claim "another espalier bakes again"
touch_later "$counting"
builds "bake embed"

claim "a bake that fails says file, mesh and triangle in the build's log, and leaves the old blob and program"
cp "$blob" before.espl
cp "$project/assets/level.obj" good.obj
sed -i 's/^v 1 0 0/v nan 0 0/' "$project/assets/level.obj"
for _ in 1 2; do
    must_not build "$build" --target game
    verbs_are "bake"
    log_has "level.obj', line 4" "triangle 0 of mesh 0"
done
same "$blob" before.espl
holds before.espl
cp good.obj "$project/assets/level.obj"
builds "bake embed"
same "$blob" before.espl

claim "a mesh that is not there stops the build and is named"
mv "$project/assets/level.obj" away.obj
fails_with "level.obj" build "$build" --target game
mv away.obj "$project/assets/level.obj"
must build "$build" --target game
rm -f "$verbs"

claim "the same sources give the same bytes in any folder: blob, source, header"
cp -r "$project" "$folder/elsewhere"
must configure "$folder/elsewhere" "$folder/elsewhere/build" -Dbits=13 -Dalignment=64 -DESPALIER_EXECUTABLE="$espalier"
must build "$folder/elsewhere/build" --target game
for file in level.espl level.c level.h; do
    same "$build/espalier_blobs/level/$file" "$folder/elsewhere/build/espalier_blobs/level/$file"
done

if [ "$generator" = Ninja ]; then
    claim "two configurations of one build share the blob: it is baked once"
    generator="Ninja Multi-Config"
    must configure "$project" several "${options[@]}"
    for configuration in Debug Release Debug; do must build several --config $configuration --target game; done
    verbs_are "bake embed"
    for configuration in Debug Release; do
        several/$configuration/game >game.bytes
        same game.bytes several/espalier_blobs/level/level.espl
    done
fi

finish
