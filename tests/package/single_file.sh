#!/usr/bin/env bash
# single_file.sh PYTHON FOLDER BLOBS COMPILER C_COMPILER [--every-macro]: makes espalier.hpp and espalier.cpp, compiles them by the C++ compiler
# without any of the library's flags, links them to the program that asks blobs everything, and compares its answers with those that
# all machines give (tests/platform), by the instruction sets of the default, and links them to a program in C. With --every-macro it
# compares every set that this machine has, parses the file under each macro, and links what is left without any family to a program
# that casts rays.
set -euo pipefail

python=$1 folder=$2 blobs=$3 compiler=$4 c_compiler=$5 every_macro=${6-}
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
warnings=(${WERROR:--Werror} -Wall -Wextra -Wconversion -Wsign-conversion -Wdouble-promotion -Wshadow -Wcast-align -Wundef)
command -v "$compiler" >/dev/null || { echo "skipped: there is no $compiler"; exit 77; }

rm -rf "$folder"
"$python" "$project/tools/single_file.py" "$folder/single"
cd "$folder/single"
"$compiler" -std=c++20 -O1 "${warnings[@]}" -c espalier.cpp -o ../espalier.o
! nm -u ../espalier.o | grep -w sqrtf || { echo "failed: it asks for libm"; exit 1; }
families=(OVERLAPS DISTANCES SWEEPS CONTACTS PAIRS SCENES MOVING_SCENES BATCHES DEFORMATION C)
if [[ $every_macro ]]; then
    for macro in PLAIN_LEAVES=0 STRIP_LEAVES=0 PREDICTED_STRIPS=0 SMALL_CODE=1 SET_AVX2=0 FAST_SCALAR=1 "${families[@]/%/=0}"; do
        "$compiler" -std=c++20 -fsyntax-only -fno-exceptions -fno-rtti "${warnings[@]}" "-DESPALIER_$macro" espalier.cpp
    done
    case $compiler in  # the lanes of another machine
        g++*) other=aarch64-linux-gnu-g++ ;;
        *) other="clang++ --target=wasm32-wasi -msimd128" ;;
    esac
    read -ra other <<<"$other"
    if echo '#include <span>' | "${other[@]}" -std=c++20 -fsyntax-only -x c++ - 2>/dev/null; then
        "${other[@]}" -std=c++20 -fsyntax-only "${warnings[@]}" espalier.cpp
    fi
fi
! "$compiler" -std=c++20 -fsyntax-only -ffast-math espalier.cpp 2>/dev/null || { echo "failed: -ffast-math passes"; exit 1; }
# Nothing is left that needs the library's own files.
"$compiler" -std=c++20 -MM espalier.cpp >../espalier.d
! grep -F "$project/lib" ../espalier.d || { echo "failed: it includes files of the library"; exit 1; }

# The program includes parts of the library by their names: all of them are the one header.
cd ..
mkdir -p include/espalier/{base,scenes,batches}
ln -s ../../single/espalier.h include/espalier/espalier.h
for header in "$project"/lib/espalier/*.hpp; do
    echo '#include "../../single/espalier.hpp"' >"include/espalier/${header##*/}"
done
for header in "$project"/lib/espalier/{base,scenes,batches}/*.hpp; do
    echo '#include "../../../single/espalier.hpp"' >"include/${header#"$project"/lib/}"
done
ln -s "$project/lib/runtime" include/runtime  # it chooses instruction sets
answers_by() {  # OBJECT MACRO...: query_answers, by the sets of that object
    "$compiler" -std=c++20 -O1 -Iinclude "${@:2}" "$project/tests/platform/query_answers.cpp" "$1" -o query_answers
}
check() { "$project/tests/platform/check_golden.sh" "$project/tests/platform/golden.txt" 100 "$blobs" "$PWD/query_answers" "$@"; }
without_others=(-DESPALIER_SET_SSE42=0 -DESPALIER_SET_AVX512=0)
answers_by espalier.o "${without_others[@]}"
check
for set in scalar avx2; do
    check --set "$set" || [[ $? -eq 77 ]]
done
for set in sse42 avx512; do
    status=0
    ./query_answers --set "$set" 1 2>/dev/null || status=$?
    [[ $status -eq 77 ]] || { echo "failed: $set is not left out"; exit 1; }
done
if [[ $every_macro ]]; then
    with_others=("${without_others[@]/%=0/=1}")
    "$compiler" -std=c++20 -O1 "${with_others[@]}" -c single/espalier.cpp -o every_set.o
    answers_by every_set.o "${with_others[@]}"
    for set in sse42 avx512; do
        check --set "$set" || [[ $? -eq 77 ]]
    done
fi

"$c_compiler" -std=c99 -pedantic -Wall -Wextra "${WERROR:--Werror}" -c "$project/docs/examples/c/main.c" -Iinclude -o cast_ray.o
"$compiler" cast_ray.o espalier.o -o cast_ray
hit=$(./cast_ray "$project/tests/format_versions/2.0_everything_fast.espl" 0.1 0.2 -100 0 0 1)
[[ $hit == "hit triangle 68 at t = 100.039,"* ]] || { echo "failed: from C: $hit"; exit 1; }

if [[ $every_macro ]]; then
    # Each macro leaves out what it names, and all that needs it: what is left links.
    defined=("${families[@]/#/-DESPALIER_}")
    "$compiler" -std=c++20 -O1 "${defined[@]/%/=0}" -c single/espalier.cpp -o rays.o
    names=$(nm -C --defined-only rays.o)
    for name in overlaps closest_point sweep find_contacts collides scene_raycast MovingScene::refit collect_hits refit espalier_raycast; do
        ! grep -E "espalier::$name[(<]|T $name$" <<<"$names" || { echo "failed: $name is not left out"; exit 1; }
    done
    cat >ray.cpp <<'PROGRAM'
#include "single/espalier.hpp"

int main() { return espalier::raycast(espalier::open({}), {.origin = {3, 10, 1}, .direction = {0, -1, 0}}) ? 1 : 0; }
PROGRAM
    "$compiler" -std=c++20 ray.cpp rays.o -o ray
    ./ray
fi
echo "$compiler: $(wc -l <single/espalier.cpp) lines compile without a warning and give everybody's answers"
