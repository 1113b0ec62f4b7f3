#!/usr/bin/env bash
# shared_test.sh PROJECT CMAKE GENERATOR COMPILER PYTHON FOLDER: builds libespalier unoptimised, installs it, compares its symbols with
# the functions that the headers of C declare, and has Python load it, bake and query.
set -euo pipefail
project=$1 cmake=$2 generator=$3 compiler=$4 python=$5 folder=$6

fail() {
    echo "shared_test: $*" >&2
    exit 1
}

mkdir -p "$folder"
"$cmake" -S "$project" -B "$folder/build" -G "$generator" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DESPALIER_SHARED=ON -DESPALIER_PRECOMPILE_HEADERS=ON \
    -DESPALIER_{TESTS,BENCH,TOOLS}=OFF >"$folder/configure.log" 2>&1 || fail "it does not configure: $(tail -n 20 "$folder/configure.log")"
"$cmake" --build "$folder/build" --parallel 2 >"$folder/build.log" 2>&1 || fail "it does not build: $(tail -n 40 "$folder/build.log")"
rm -rf "$folder/installed"
for component in runtime baker shared; do
    "$cmake" --install "$folder/build" --prefix "$folder/installed" --component $component >>"$folder/install.log"
done
library=$(echo "$folder"/installed/lib*/libespalier.so)
[[ -e $library ]] || library=$(echo "$folder"/installed/lib*/*/libespalier.so)
[[ -e $library ]] || fail "libespalier.so is not installed"

version=$(sed -n 's/.*define ESPALIER_VERSION "\(.*\)"/\1/p' "$project/lib/espalier/c/abi.h")
soname=$(readelf -d "$library" | sed -n 's/.*(SONAME).*\[\(.*\)\]/\1/p')
[[ $soname == libespalier.so.${version%.*} ]] || fail "the library is called $soname"

# What the installed headers declare, without what they define, and the symbols of the library.
find "$folder/installed/include/espalier/c" -name '*.h' -exec cat {} + | sed 's/static inline.*//' | tr '\n' ' ' |
    sed 's/\/\*[^*]*\*\+\([^/*][^*]*\*\+\)*\///g' >"$folder/headers.txt"
{
    grep -oE '\bespalier_[a-z_0-9]+\(' "$folder/headers.txt" | tr -d '(' | grep -vxE 'espalier_(yes|no|is_refused)'
    grep -oE '\bextern const [^;]*' "$folder/headers.txt" | grep -oE 'espalier_[a-z_0-9]+\[' | tr -d '['
} | sort -u >"$folder/declared.txt"
nm -D --defined-only "$library" | awk '{ print $3 }' | sort -u >"$folder/exported.txt"
[[ $(wc -l <"$folder/declared.txt") -gt 200 ]] || fail "only $(wc -l <"$folder/declared.txt") names in the headers"
diff "$folder/declared.txt" "$folder/exported.txt" >"$folder/symbols.diff" ||
    fail "declared (<) and exported (>) differ: $(head -n 20 "$folder/symbols.diff")"

# A program in C that finds the package and links it needs no C++ compiler.
mkdir -p "$folder/consumer"
cat >"$folder/consumer/CMakeLists.txt" <<EOF
cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES C)
find_package(espalier REQUIRED COMPONENTS shared)
add_executable(consumer "$project/docs/examples/c/bake_and_cast.c")
target_link_libraries(consumer PRIVATE espalier::shared)
EOF
"$cmake" -S "$folder/consumer" -B "$folder/consumer/build" -G "$generator" -DCMAKE_PREFIX_PATH="$folder/installed" \
    >"$folder/consumer.log" 2>&1 && "$cmake" --build "$folder/consumer/build" >>"$folder/consumer.log" 2>&1 ||
    fail "no program links it: $(tail -n 20 "$folder/consumer.log")"
said=$("$folder/consumer/build/consumer")
[[ $said == "8192 triangles in 44376 bytes"* ]] || fail "a program that links it says: $said"

if [[ -n $python ]]; then
    "$python" -B "$project/tests/c/shared/bake_and_cast.py" "$library" || fail "Python does not bake and cast with it"
fi
echo "$soname: $(wc -l <"$folder/exported.txt") symbols, all of which the headers declare"
