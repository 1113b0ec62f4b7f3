#!/usr/bin/env bash
# Which espalier bakes: what a project says, a target, one on the path, one that the build makes of sources.
# Usage: command_test.sh PATH_TO_ESPALIER SOURCE_FOLDER CMAKE GENERATOR
# Exit status 77: nothing is broken, and a generator or a cross compiler is missing.
# shellcheck source=projects.sh
. "$(dirname "$0")/projects.sh"

write_level level
version=$("$espalier" --version | sed 's/^espalier \([0-9.]*\).*/\1/')
# The function as installed: no sources around it.
cp "$espalier_sources/lib/cmake/espalier_add_blob.cmake" "$folder/espalier_add_blob.cmake"
cat >level/CMakeLists.txt <<CMAKE
cmake_minimum_required(VERSION 3.16)
project(consumer LANGUAGES CXX)
set(espalier_VERSION $version)
include("$folder/espalier_add_blob.cmake")
if(target)
  add_executable(espalier::espalier IMPORTED)
  set_target_properties(espalier::espalier PROPERTIES IMPORTED_LOCATION \${target})
endif()
espalier_add_blob(level MESH level.obj)
espalier_add_blob(arena MESH level.obj BITS 12)
CMAKE
# A command that says so when it is asked.
command_named() { # NAME VERSION
    mkdir -p "$1"
    cat >"$1/espalier" <<SCRIPT
#!/bin/sh
case \$1 in --*) echo "espalier $2, format 1.0" && exit ;; esac
echo $1 >>'$verbs'
exec '$espalier' "\$@"
SCRIPT
    chmod +x "$1/espalier"
}
command_named said "$version"
command_named imported "$version"
command_named found "$version"
command_named old 0.0.1
old_path=$PATH

claim "the command is what the project says, else the target, else the one on the path"
PATH=$folder/found:$old_path
baked_by() { # NAME OPTION...
    must configure level build "${@:2}"
    must build build --target level
    verbs_are "$1 $1"
}
baked_by said -DESPALIER_EXECUTABLE="$folder/said/espalier" -Dtarget="$folder/imported/espalier"
baked_by imported -DESPALIER_EXECUTABLE=
baked_by found -Dtarget=
PATH=$old_path

claim "without a command of this version the project is refused, with what can be done"
PATH=$folder/old:$old_path
must_not configure level build -DESPALIER_ON_PATH=ESPALIER_ON_PATH-NOTFOUND
tr -s ' \n' ' ' <log >lines && mv lines log
log_has "there is no command $version to bake with. Set ESPALIER_EXECUTABLE to one, install the component 'tools', or set ESPALIER_SOURCES"

# ---- of sources -----------------------------------------------------------------------------------------------------
# What stands for Espalier's sources compiles in a moment, on this machine only.
mkdir -p sources/tools
cat >sources/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(sources LANGUAGES CXX)
add_subdirectory(tools)
if(NOT DEFINED ESPALIER_COMMAND_PARTS)
  set(ESPALIER_COMMAND_PARTS all)
endif()
file(WRITE ${CMAKE_BINARY_DIR}/parts.txt "${ESPALIER_COMMAND_PARTS}\n")
CMAKE
cat >sources/tools/CMakeLists.txt <<'CMAKE'
add_executable(espalier_command main.cpp)
set_target_properties(espalier_command PROPERTIES OUTPUT_NAME espalier)
CMAKE
cat >sources/tools/main.cpp <<CPP
#include <unistd.h>
int main(int, char** values) { return execv("$counting", values); }
CPP
# from_sources BUILD GENERATOR OPTION...
from_sources() {
    local build=$1 generator=$2
    shift 2
    must configure level "$build" -DESPALIER_SOURCES="$folder/sources" "$@"
    for expected in "bake bake embed embed" "" "bake bake embed embed"; do
        must build "$build" --target level arena
        verbs_are "$expected"
        [ -n "$expected" ] || { sleep 0.05 && touch sources/tools/main.cpp; }
    done
}

claim "where there is no command, the build makes one of the sources, once for all blobs, and again when they change"
status=0
generators=()
for each in Ninja "Unix Makefiles"; do
    if has_generator "$each"; then generators+=("$each"); else status=77; fi
done
for each in "${generators[@]}"; do from_sources "own ${each::1}" "$each"; done

claim "it has the parts that ESPALIER_COMMAND_PARTS names: all of a list, none, and by default those of the sources"
# parts_are BUILD GENERATOR PARTS [OPTION]: the build makes a command of these parts
parts_are() {
    local build=$1 generator=$2 made
    must configure level "$build" "${@:4}"
    must build "$build" --target level
    made=$(cat "$build/espalier_for_this_machine/parts.txt")
    [ "$made" = "$3" ] || fail "$build: the parts are '$made', not '$3'"
}
for each in "${generators[@]}"; do
    parts_are "own ${each::1}" "$each" all
    for parts in "assimp;png" ""; do parts_are "own ${each::1}" "$each" "$parts" "-DESPALIER_COMMAND_PARTS=$parts"; done
done
rm -f "$verbs"

claim "a cross build makes it with the compiler of this machine, whatever the environment says"
if command -v arm-none-eabi-g++ >/dev/null; then
    export CXX=arm-none-eabi-g++ CXXFLAGS=-mthumb
    for each in "${generators[@]}"; do
        from_sources "cross ${each::1}" "$each" -DCMAKE_TOOLCHAIN_FILE="$espalier_sources/lib/cmake/toolchains/cortex-m4f.cmake"
        object=$(find "cross ${each::1}" -path '*level.dir*.obj')
        readelf -hW "$object" | grep -q 'Machine: *ARM' || fail "$object is for another machine"
    done
else
    echo "skipped: arm-none-eabi-g++ is not installed (tools/dev prove firmware installs it)"
    status=77
fi

finish || exit 1
exit $status
