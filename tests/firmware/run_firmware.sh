#!/usr/bin/env bash
# run_firmware.sh CORE HOST_PROGRAMS PLATFORM_PROGRAMS BUILD_FOLDER CMAKE GENERATOR
# Builds bare-metal images for a core of cores.txt, runs them under QEMU, compares their answers with this machine's,
# measures what queries cost and holds that to budgets.txt. HOST_PROGRAMS: where espalier_firmware_workload is, and the
# folder blobs that espalier_firmware_blobs filled; PLATFORM_PROGRAMS: where espalier_query_answers is, and its folder blobs.
# Environment: ROWS as in measure.sh; BUDGETS=none does not hold it to budgets.
# Exit status: 0 the same bits, within budgets; 77 a tool is missing; other: other bits, too costly, or a failure.
set -euo pipefail

core=$1 host=$2 platform=$3 build=$4
export CMAKE=$5 GENERATOR=$6
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
questions=50
failures=0

read -r _ board _ _ _ asked < <(grep "^$core " "$here/cores.txt") || { echo "failed: no such core: $core"; exit 1; }

# The awkward questions of tests/platform, to a small blob of the profile, and the script of a moving scene.
compare_answers() {  # PROFILE
    local blob=$platform/blobs/small.espl folder=$build/$1
    [[ $1 == fast ]] || blob=$platform/blobs/dense.espl
    TARGETS="answers without_floats" bash "$here/build_images.sh" "$core" "$1" "$blob" "$folder" -DQUESTIONS="$questions" ||
        return
    "$platform/espalier_query_answers" --moving "$questions" "$blob" | grep '^answers ' >"$folder/here.txt"
    timeout 200 qemu-system-arm -M "$board" -nographic -monitor none -serial null \
        -semihosting-config enable=on,target=native -kernel "$folder/answers.elf" </dev/null >"$folder/there.txt" 2>&1 ||
        { cat "$folder/there.txt"; echo "failed: answers.elf ended badly"; return 1; }
    diff "$folder/here.txt" "$folder/there.txt" || { echo "failed: < answers here, > answers on $core"; return 1; }
    # Arithmetic of floats by functions, as a core without an FPU has it: _f and _d, and what converts from and to them.
    if arm-none-eabi-nm "$folder/without_floats.elf" | grep -E ' (__aeabi_([fdi]|ui|l|ul)(2|add|sub|rsub|mul|div|cmp)[a-z0-9]*|__aeabi_c[fd][a-z]*|__[a-z]+[sd]f[a-z]*[0-9]*)$' |
        grep -vE ' __aeabi_(idiv|uidiv|ldiv|uldiv|lmul|lcmp|ulcmp)'; then
        echo "failed: queries in lattice steps link arithmetic of floats"
        return 1
    fi
    echo "$core, profile $1: the same bits as here, $(cat "$folder/there.txt")"
}

measure() {  # PROFILE BLOB every|usual
    local folder=$build/$1
    "$host/espalier_firmware_workload" "$3" "$2" >"$folder/here.txt"
    QUERIES=$3 ROWS=$build/rows.txt BUILD=$folder bash "$here/measure.sh" "$core" "$1" "$2" >"$folder/said.txt" ||
        { cat "$folder/said.txt"; return 1; }
    cat "$folder/said.txt"
    diff "$folder/here.txt" <(grep '^workload ' "$folder/said.txt") ||
        { echo "failed: < answers here, > answers on $core"; return 1; }
}

mkdir -p "$build"
: >"$build/rows.txt"
profile=
for one in $asked; do
    IFS=: read -r own_profile mesh queries <<<"$one"
    if [[ $profile != "$own_profile" ]]; then
        profile=$own_profile
        status=0
        compare_answers "$profile" || status=$?
        [[ $status -ne 77 ]] || exit 77
        [[ $status -eq 0 ]] || failures=$((failures + 1))
    fi
    blob=$host/blobs/${mesh}_$profile.espl
    if [[ -f $blob ]]; then
        measure "$profile" "$blob" "${queries:-every}" || failures=$((failures + 1))
    else
        echo "left out: $mesh, which the folder ESPALIER_MESHES does not have"
    fi
done
[[ -z ${ROWS:-} ]] || cat "$build/rows.txt" >>"$ROWS"
awk 'NF > 5 && $11 != 0 { print "failed: " $2 " " $3 " " $4 " wrote outside of the stack " $11 " times"; bad = 1 }
    END { exit bad }' "$build/rows.txt" || failures=$((failures + 1))
if [[ ${BUDGETS:-} != none ]]; then
    bash "$here/rows.sh" check "$build/rows.txt" || failures=$((failures + 1))
fi
[[ $failures -eq 0 ]]
