#!/usr/bin/env bash
# consume.sh KIND STAGE BUILD CMAKE GENERATOR COMPILER: builds a consumer of the package that install.sh has put into STAGE, runs it
# on the blob baked there, and compares what it says. KIND is find_package, refusals, fetch_content, pkg_config, or
# game, city, falling or flag, the examples.
set -euo pipefail

kind=$1 stage=$2 build=$3 cmake=$4 generator=$5 compiler=$6
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
blob=$stage/table.espl
source=$here/$kind
[[ -d $source ]] || source=$here/../../docs/examples/$kind
answers=$here/${kind}_answers.txt
[[ -f $answers ]] || answers=$here/program/answers.txt
rm -rf "$build"
mkdir -p "$build"

# quietly COMMAND...: its words only if it fails
quietly() { "$@" >"$build/log" 2>&1 || { tail -n 60 "$build/log"; echo "failed: $*"; exit 1; }; }
configure() {
    quietly "$cmake" -S "$source" -B "$build/build" -G "$generator" -DCMAKE_CXX_COMPILER="$compiler" "$@"
}
compare() { diff "$answers" - || { echo "failed: other answers than $answers"; exit 1; }; }
# build_example NAME: leaves its program in the build folder
build_example() {
    source=$here/../../docs/examples/$1
    rm -rf "$build/build"
    configure -DCMAKE_PREFIX_PATH="$stage/installed" -DCMAKE_BUILD_TYPE=Release
    quietly "$cmake" --build "$build/build"
    cp "$build/build/espalier_$1" "$build"
}
# on_page COUNT: the page of the example that was built last shows the last lines of the answers
on_page() {
    tail -n "$1" "$answers" | while read -r line; do
        grep -qF "$line" "$source/README.md" || { echo "failed: the example's page does not show: $line"; exit 1; }
    done
}

# imports PROGRAM: it reads the file that was baked, and states why it does not read another one
imports() {
    [[ $("$1" "$here/program/table.obj") == "baked "*" triangles of Wavefront OBJ" ]] || { echo "failed: $("$1" "$here/program/table.obj")"; exit 1; }
    [[ $("$1" "$here/none.obj") == "cannot read "* ]] || { echo "failed: a missing file is imported"; exit 1; }
}

case $kind in
    find_package)
        # An installation may have no importers.
        with_import=OFF
        [[ ! -e $(echo "$stage/installed/lib"*/cmake/espalier/espalier-import.cmake) ]] || with_import=ON
        configure -DCMAKE_PREFIX_PATH="$stage/installed" -DCMAKE_BUILD_TYPE=Debug -DWITH_IMPORT=$with_import
        quietly "$cmake" --build "$build/build"
        "$build/build/consumer" "$blob" | compare
        [[ $("$build/build/baking") == "baked 1 triangle" ]] || { echo "failed: the baker does not bake"; exit 1; }
        if [[ $with_import == ON ]]; then imports "$build/build/importing"; fi
        cmp "$blob" "$build/build/table.espl"
        ;;
    refusals)
        configure -DCMAKE_PREFIX_PATH="$stage/installed" -DRUNTIME_ALONE="$stage/runtime alone"
        ;;
    fetch_content)
        configure -DFETCHCONTENT_SOURCE_DIR_ESPALIER="$here/../.."
        quietly "$cmake" --build "$build/build" --parallel 2
        "$build/build/consumer" "$blob" | compare
        quietly "$cmake" --install "$build/build" --prefix "$build/installed"
        installed=$(cd "$build/installed" && find . -type f)
        [[ $installed == ./bin/consumer ]] || { echo "failed: it installs things of ours: $installed"; exit 1; }
        [[ -z $(find "$build/build" -name 'libespalier_baker*') ]] || { echo "failed: nobody links the baker"; exit 1; }
        ;;
    pkg_config)
        pkg_config() { PKG_CONFIG_PATH=$(echo "$stage/installed/lib"*/pkgconfig) pkg-config "$@"; }
        eval "$compiler -std=c++20 '$here/program/main.cpp' $(pkg_config --cflags --libs espalier) -o '$build/consumer'"
        "$build/consumer" "$blob" | compare
        eval "$compiler -std=c++20 '$here/find_package/baking.cpp' $(pkg_config --cflags --libs espalier-baker) -o '$build/baking'"
        [[ $("$build/baking") == "baked 1 triangle" ]]
        eval "$compiler -std=c++20 '$here/find_package/importing.cpp' $(pkg_config --cflags --libs espalier-import) -o '$build/importing'"
        imports "$build/importing"
        [[ $(pkg_config --modversion espalier) == $(sed -n 's/.*version //p' "$here/program/answers.txt") ]]
        # Some systems give every package absolute folders.
        source=$here/../..
        configure -DESPALIER_{TOOLS,TESTS,BENCH,BAKER}=OFF -DCMAKE_INSTALL_{PREFIX=/a,LIBDIR=/b/lib,INCLUDEDIR=/c/include}
        flags=$(PKG_CONFIG_PATH=$build/build/package pkg-config --cflags --libs espalier)
        [[ ${flags% } == "-I/c/include -L/b/lib -lespalier_runtime" ]] || { echo "failed: absolute folders become $flags"; exit 1; }
        ;;
    game)
        # as a part of the project it would compile the library and the command; that is fetch_content's claim, and a build step's
        configure -DCMAKE_DISABLE_FIND_PACKAGE_espalier=ON
        rm -rf "$build/build"
        # a copy, as those make who start from it: where Espalier is, it must be told
        source=$build/game
        cp -r "$here/../../docs/examples/game" "$source"
        said=$(configure -DCMAKE_DISABLE_FIND_PACKAGE_espalier=ON) && { echo "failed: a copy finds Espalier nowhere and goes on"; exit 1; }
        for option in CMAKE_PREFIX_PATH ESPALIER_FOLDER; do
            [[ $said == *-D$option=* ]] || { echo "failed: a copy does not say that -D$option=... helps: $said"; exit 1; }
        done
        configure -DCMAKE_DISABLE_FIND_PACKAGE_espalier=ON -DESPALIER_FOLDER="$here/../.."
        rm -rf "$build/build"
        configure -DCMAKE_PREFIX_PATH="$stage/installed"
        quietly "$cmake" --build "$build/build"
        "$build/build/game" | compare
        ;;
    city)
        build_example city
        "$build/espalier_city" "$build/city.esps" >"$build/said.txt" || { echo "failed: espalier_city $build/city.esps"; exit 1; }
        grep -E '^(city|sight|fall) ' "$build/said.txt" | compare
        ;;
    falling)
        build_example city
        build_example falling
        quietly "$build/espalier_city" "$build/city.esps"
        "$build/espalier_falling" "$build/city.esps" | compare
        on_page 3
        ;;
    flag)
        build_example flag
        "$build/espalier_flag" | compare
        on_page 2
        ;;
    *)
        echo "failed: no such kind of consumer: $kind"
        exit 1
        ;;
esac
echo "$kind: built, run, the same answers"
