#!/usr/bin/env bash
# The programs of docs/examples/c, built by a C compiler alone and built by CMake from an installed package.
# example_test.sh PROJECT RUNTIME_ARCHIVE BUILD_FOLDER CMAKE CC FOLDER
set -euo pipefail
project=$1 archive=$2 build=$3 cmake=$4 cc=$5 folder=$6

fail() {
    echo "example_test: $*" >&2
    exit 1
}

# Each way of building gives a program that says this.
check() {
    local program=$1 blob=$project/tests/format_versions/2.0_everything_fast.espl said
    said=$("$program" "$blob" 0.1 0.2 -100 0 0 1)
    [[ $said == "hit triangle 68 at t = 100.039, normal 0.0114835 -0.199047 0.979923" ]] || fail "$program says: $said"
    said=$("$program" "$blob" 0.1 0.2 100 0 0 1)
    [[ $said == "no hit" ]] || fail "$program beside the mesh says: $said"
    said=$("$program" "$blob" 0.1 0.2 100 0 0 0 2>&1) && fail "$program answers a ray without a direction"
    [[ $said == "cast_ray: an argument is invalid: "* ]] || fail "$program of a ray without a direction says: $said"
    said=$("$program" "$blob" 0.1 oops 100 0 0 1 2>&1) && fail "$program takes oops for a number"
    [[ $said == 'cast_ray: "oops" is not a number' ]] || fail "$program of oops says: $said"
    said=$("$program" "$project/README.md" 0 0 0 0 0 1 2>&1) && fail "$program opens what is no blob"
    [[ $said == *"README.md: these bytes are not an Espalier blob"* ]] || fail "$program of what is no blob says: $said"
    said=$("$program" "$folder/none" 0 0 0 0 0 1 2>&1) && fail "$program opens what is not there"
    [[ $said == *"cannot be read" ]] || fail "$program of what is not there says: $said"
}

rm -rf "$folder"
mkdir -p "$folder"

# No C++ library, no flags: a C compiler, the header and the archive.
"$cc" -std=c99 -pedantic -Wall -Wextra -Wconversion "${WERROR:--Werror}" -I "$project/lib" "$project/docs/examples/c/main.c" "$archive" \
    -o "$folder/alone"
check "$folder/alone"
needed=$(readelf -d "$folder/alone" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -v '^libc\.so' || true)
[[ -z $needed ]] || fail "a C program that links the runtime needs: $needed"

# What the page about it shows is C too.
{
    printf '#include <espalier/espalier.h>\n#include <stdio.h>\nvoid page(const void* bytes, size_t size);\n'
    printf 'void page(const void* bytes, size_t size) {\n'
    sed -n '/^ *static espalier_\(blob\|moving_scene\)/,/^ \{0,2\}[^ ]/p' "$project/docs/embedding.md" | grep '^    '
    printf '(void)hit;\n}\n'
} >"$folder/page.c"
{
    printf '#include <espalier/c/bake.h>\n#include <espalier/espalier.h>\n#include <stdio.h>\n'
    printf 'void page(const void* positions, size_t position_count, const void* triangles, size_t triangle_count);\n'
    printf 'void page(const void* positions, size_t position_count, const void* triangles, size_t triangle_count) {\n'
    printf 'static espalier_blob blob;\n'
    for first in 'espalier_vec3 origins' 'espalier_mesh_view mesh;'; do
        sed -n "/^ *$first/,/^ \{0,2\}[^ ]/p" "$project/docs/embedding.md" | grep '^    '
    done
    printf '}\n'
} >"$folder/baking_page.c"
for call in espalier_collect_hits_arrays espalier_bake; do
    grep -q "$call" "$folder/baking_page.c" || fail "docs/embedding.md shows no C of $call"
done
for call in espalier_overlaps_box espalier_scene_raycast espalier_moving_scene_view espalier_collect_candidate_pairs; do
    grep -q "$call" "$folder/page.c" || fail "docs/embedding.md shows no C of $call"
done
for page in page baking_page; do
    "$cc" -std=c99 -pedantic -Wall -Wextra "${WERROR:--Werror}" -I "$project/lib" -fsyntax-only "$folder/$page.c" ||
        fail "docs/embedding.md shows what is no C"
done

"$cmake" --install "$build" --prefix "$folder/package" --component runtime >"$folder/install.log"
[[ ! -e $folder/package/include/espalier/c/bake.h ]] || fail "the runtime installs the header of the baker"
"$cmake" --install "$build" --prefix "$folder/package" --component baker >>"$folder/install.log"
"$cmake" -S "$project/docs/examples/c" -B "$folder/example" -DCMAKE_PREFIX_PATH="$folder/package" -DCMAKE_C_COMPILER="$cc" \
    >"$folder/configure.log" || fail "CMake does not configure the example: $(cat "$folder/configure.log")"
"$cmake" --build "$folder/example" >"$folder/build.log" 2>&1 ||
    fail "the example does not build: $(cat "$folder/build.log")"
check "$folder/example/cast_ray"
said=$("$folder/example/bake_and_cast")
[[ $said == "8192 triangles in 44376 bytes, within 0.000976563 of the source
1000 of 1000 rays hit, the highest point is at 16" ]] || fail "bake_and_cast says: $said"
