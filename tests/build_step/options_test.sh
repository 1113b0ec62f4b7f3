#!/usr/bin/env bash
# What espalier_add_blob takes and refuses when a project is configured.
# Usage: options_test.sh PATH_TO_ESPALIER SOURCE_FOLDER CMAKE GENERATOR
# shellcheck source=projects.sh
. "$(dirname "$0")/projects.sh"

write_level level
# A project without languages: what is refused is refused before anything is compiled.
refused() { # WORDS_OF_THE_LOG ARGUMENT...
    local words=$1
    shift
    printf 'cmake_minimum_required(VERSION 3.25)\nproject(consumer LANGUAGES NONE)\nset(espalier_VERSION %s)\n' "$version" >level/CMakeLists.txt
    echo "include(\"$espalier_sources/lib/cmake/espalier_add_blob.cmake\")" >>level/CMakeLists.txt
    echo "espalier_add_blob($*)" >>level/CMakeLists.txt
    rm -rf refused
    ! configure level refused -DESPALIER_EXECUTABLE="${executable:-$counting}" || fail "espalier_add_blob($*) is taken"
    tr -s ' \n' ' ' <log >lines && mv lines log # CMake breaks lines as it likes
    log_has "$words"
}
version=$("$espalier" --version | sed 's/^espalier \([0-9.]*\).*/\1/')

claim "every option of bake that shapes the blob is an option of the function, and the other way round"
run 0 bake --help
sed -n 's/^ *\(-[a-z],\)\{0,1\}--\([a-z-]*\).*/\2/p' out | grep -vxE 'help|output|depfile|json|quiet|verbose' | tr 'a-z-' 'A-Z_' | sed 's/^FORMAT$/MESH_FORMAT/' | sort >of_bake
sed -n '/ESPALIER_BAKE_\(FLAGS\|VALUES\|LISTS\)/,/)/p' "$espalier_sources/lib/cmake/espalier_add_blob.cmake" | sed '/get_property/d' |
    grep -oE '\b[A-Z_]+\b' | grep -vxE 'GLOBAL|PROPERTY|ESPALIER_BAKE_(FLAGS|VALUES|LISTS)' | sort >of_function
[ "$(wc -l <of_bake)" -gt 15 ] || fail "the help has only $(wc -l <of_bake) options"
diff of_bake of_function >differences || fail "$(cat differences)"

claim "the table in docs/embedding.md has every option and no other"
# shellcheck disable=SC2016  # backticks of the page
sed -n '/^## A blob as a build step/,/^## Firmware/p' "$espalier_sources/docs/embedding.md" | grep '^| `[A-Z]' | cut -d'|' -f2 |
    grep -oE '`[A-Z_]+`' | tr -d '`' | sort >of_page
printf '%s\n' MESH FORMAT SYMBOL SECTION ALIGNMENT OUTPUT DEPENDS | sort - of_bake >of_all
diff of_page of_all >differences || fail "$(cat differences)"

claim "an option that there is not is refused with the choices, wherever it stands"
refused "'TOLERENCE' is no option; the options are MESH, DEPENDS, TOLERANCE, BITS" level MESH level.obj TOLERENCE 0.5mm
refused "'0.5mm' is no option" level MESH level.obj BITS 12 0.5mm
refused "'TOLERENCE' is no option" level MESH level.obj DEPENDS level.mtl TOLERENCE 0.5mm
refused "'PROFIL' is no option" level PROFIL small MESH level.obj

claim "an option without its value is refused, also where a variable turns out empty"
refused "TOLERANCE needs a value" level MESH level.obj TOLERANCE
refused "TOLERANCE needs a value" level MESH level.obj TOLERANCE BITS 12
refused "TOLERANCE needs a value" level MESH level.obj TOLERANCE "\"\${tolerence}\""
refused "MESH and at least one mesh file are needed" level TOLERANCE 0.5mm
refused "MESH needs a value" level MESH TOLERANCE 0.5mm

claim "a range without six numbers is refused, and a range or poses of a blob that is not deformable"
refused "RANGE has 3 numbers; six are needed, X0 Y0 Z0 X1 Y1 Z1" level MESH level.obj DEFORMABLE RANGE 0 0 0
refused "RANGE needs a value" level MESH level.obj RANGE DEFORMABLE
refused "RANGE and POSES need DEFORMABLE" level MESH level.obj RANGE 0 0 0 1 1 1
refused "RANGE and POSES need DEFORMABLE" level MESH level.obj POSES level.obj
refused "'BITZ' is no option" level MESH level.obj DEFORMABLE POSES level.obj BITZ 12

claim "a name whose header would take the place of one of the C library is refused"
refused "espalier_add_blob(string): its header would hide <string.h>; give the target another name" string MESH level.obj

claim "a format that there is not, or whose language the project lacks, is refused with what to write"
refused "FORMAT 'rust' is neither c nor assembler" level MESH level.obj FORMAT rust
refused "FORMAT assembler needs ASM among the LANGUAGES of project()" level MESH level.obj FORMAT assembler
refused "FORMAT c needs C or CXX among the LANGUAGES of project()" level MESH level.obj

claim "a command that is not there, or of another version, is refused with its path"
executable=$folder/nothing refused "ESPALIER_EXECUTABLE is $folder/nothing, which does not run" level MESH level.obj
printf '#!/bin/sh\necho espalier 0.0.1, format 1.0\n' >old_espalier
chmod +x old_espalier
executable=$folder/old_espalier refused "of version '0.0.1'; this is $version" level MESH level.obj

# ---- what is taken --------------------------------------------------------------------------------------------------
configure_with() { # LINE_OF_THE_PROJECT
    echo "$1" >>level/CMakeLists.txt
    must configure level build
}
write_main level
write_head level C
cat >>level/CMakeLists.txt <<'CMAKE'
espalier_add_blob(level MESH level.obj level.obj MAX_BYTES 64K BUILDER sweep_sah LEAF_SIZE 2 MATERIALS IDS FLAT_ANGLE 7
  BOUNDS obb,sphere MESH_FORMAT obj UNIT cm SCALE 3 UP z DROP_BAD_TRIANGLES EFFORT best THREADS 1 BYTE_PRICE 0
  OUTPUT blobs/all.espl REMAP all.remap REORDER models/all.ply)
get_target_property(blob level ESPALIER_BLOB)
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/blob.txt" "${blob}")
espalier_add_blob(arena-2 MESH level.obj SYMBOL arena)
espalier_add_blob(tile-1 MESH level.obj STEP 2^-9)
espalier_add_blob(tile-2 MESH level.obj LATTICE_OF tile-1)
add_executable(game main.c)
target_link_libraries(game PRIVATE level)
CMAKE

claim "options arrive: the blob is the one that the command bakes with them, and lies where OUTPUT says"
must configure level build -DESPALIER_EXECUTABLE="$espalier"
must build build --target game arena-2
run 0 bake level/level.obj level/level.obj -o expected.espl -q --max-bytes 64K --builder sweep_sah --leaf-size 2 --materials \
    --ids --flat-angle 7 --bounds obb,sphere --unit cm --scale 3 --up z --drop-bad-triangles --effort best --byte-price 0 \
    --remap expected.remap --reorder expected.ply
same expected.espl build/blobs/all.espl
same expected.remap build/all.remap
same expected.ply build/models/all.ply
[ "$(cat build/blob.txt)" = "$folder/build/blobs/all.espl" ] || fail "the target says $(cat build/blob.txt)"
build/game >game.bytes
same game.bytes expected.espl

claim "a deformable blob is baked with its range and its poses, and again when a pose changes"
cp level/level.obj level/bent.obj
cp level/CMakeLists.txt kept.txt
configure_with 'espalier_add_blob(cloth MESH level.obj DEFORMABLE RANGE -1 -1 -0.5 2 2mm 2 POSES bent.obj level.obj BITS 12)'
for top in 0.5 0.75; do
    sed "s/^v 0 0 1/v 0 $top 1/" level/level.obj >level/bent.obj
    must build build --target cloth
    run 0 bake level/level.obj -o cloth.espl -q --deformable --range -1 -1 -0.5 2 2mm 2 --poses level/bent.obj level/level.obj --bits 12
    same cloth.espl build/espalier_blobs/cloth/cloth.espl
    sleep 0.05 # a file system may count time in steps
done
sed 's/^v 0 0 1/v nan 0 1/' level/level.obj >level/bent.obj
fails_with "bent.obj, mesh 0, vertex 3 has x = NaN" build build --target cloth
cp kept.txt level/CMakeLists.txt
must configure level build

claim "a blob takes the step that is given, or that of another target, which is baked before it"
must build build --target tile-2
run 0 bake level/level.obj -o tile.espl -q --step 2^-9
same tile.espl build/espalier_blobs/tile-1/tile-1.espl
same tile.espl build/espalier_blobs/tile-2/tile-2.espl
echo 'espalier_add_blob(tile-3 MESH level.obj LATTICE_OF game)' >>level/CMakeLists.txt
fails_with "LATTICE_OF game is a target without a blob" configure level build
sed -i '$d' level/CMakeLists.txt
must configure level build

claim "a symbol names everything that the header declares"
for word in "arena[" "arena_size" "arena_bytes()"; do
    grep -qF "$word" build/espalier_blobs/arena-2/arena-2.h || fail "arena-2.h lacks $word"
done

claim "two blobs of one symbol are refused, as are symbols that no program can say"
echo 'espalier_add_blob(arena_2 MESH level.obj SYMBOL arena)' >>level/CMakeLists.txt
fails_with "another blob has the symbol arena" configure level build
sed -i '$d' level/CMakeLists.txt
configure_with 'espalier_add_blob(new MESH level.obj)'
fails_with "'new' cannot name a variable in C and C++" build build --target new

claim "STRICT makes a warning end the build, whose log names it"
configure_with 'espalier_add_blob(huge MESH level.obj UNIT km SCALE 2)'
must build build --target huge
sed -i '$d' level/CMakeLists.txt
configure_with 'espalier_add_blob(huge MESH level.obj UNIT km SCALE 2 STRICT)'
fails_with "--strict refuses 1 warning: unexpected_size" build build --target huge

claim "a library that carries a blob can be installed for other projects"
write_head level C
cat >>level/CMakeLists.txt <<'CMAKE'
espalier_add_blob(level MESH level.obj)
add_library(engine STATIC main.c)
target_link_libraries(engine PRIVATE level)
install(TARGETS engine level EXPORT engine)
install(EXPORT engine DESTINATION lib/cmake/engine)
CMAKE
must configure level exporting -DESPALIER_EXECUTABLE="$espalier"

finish
