#!/usr/bin/env bash
# measure.sh CORE PROFILE MESH|BLOB.espl [BAKE_OPTION...]: what queries of a mesh cost on an emulated core: instructions,
# bytes read of the blob, stack, writes outside the stack; and how much code they take. By hand:
#     bash tests/firmware/measure.sh m4f fast bunny.obj --bits 16
# Cores: cores.txt. The command that bakes is found in ../build/tools or build/tools, or by ESPALIER=...; images are made
# in build/measure/CORE_PROFILE, or in the folder BUILD=..., and compiled again when the library changes. ROWS=FILE: the
# figures are added to that file too, one row each. QUERIES=usual: open and the usual queries alone; scene: those of a scene; moving: steps of a
# moving scene of 64 instances; refit: refits of a cloth.
#     CORE PROFILE MESH QUERY calls, instructions mean max, blob bytes mean max, stack, writes elsewhere
#     CORE PROFILE code IMAGE bytes
#     CORE PROFILE blob MESH bytes
set -euo pipefail

core=$1 profile=$2 mesh=$3
shift 3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
source "$here/meter.sh"
image=measure
[[ ${QUERIES:-every} == every ]] || image=measure_$QUERIES
build=${BUILD:-$root/build/measure/${core}_$profile}

fail() {
    echo "failed: $*" >&2
    exit 1
}

# ---- the blob and the images

name=$(basename "${mesh%.*}" "_$profile")
mkdir -p "$build"
if [[ $mesh == *.espl ]]; then
    blob=$mesh
else
    for espalier in "${ESPALIER:-}" "$root/../build/tools/espalier" "$root/build/tools/espalier" ""; do
        [[ ! -x $espalier ]] || break
    done
    [[ -n $espalier ]] || fail "no espalier command: build it or say ESPALIER=..."
    blob=$build/baked.espl
    "$espalier" bake "$mesh" -o "$blob" --profile "$profile" --quiet "$@"
fi
parts="closest_ray scene_ray in_steps five_queries every_query"
[[ ${QUERIES:-every} != moving ]] || parts=moving_step
[[ ${QUERIES:-every} != refit ]] || parts=refit_mesh
TARGETS="$image $parts empty" \
    bash "$here/build_images.sh" "$core" "$profile" "$blob" "$build"

# ---- the run

read -r _ board _ < <(grep "^$core " "$here/cores.txt")
build_meter "$build"
run_metered "$board" "$build/$image.elf" "$build/query_meter.so" >"$build/measured.txt" ||
    { status=$?; cat "$build/measured.txt"; fail "$image.elf ended with status $status"; }

# ---- what it says

# Code, its constants and initial values: what lies in flash besides the blob.
flash_bytes() {
    arm-none-eabi-size -A "$build/$1.elf" |
        awk '$1 == ".text" || $1 == ".ARM.exidx" || $1 == ".data" { sum += $2 } END { print sum }'
}
empty=$(flash_bytes empty)
kinds=$(sed -nE '/kind_names\[/,/\};/p' "$here/measured_kinds.hpp" | grep -oE '"[a-z_]+"' | tr -d '"' | tr '\n' ' ')
rows=$build/rows.txt
{
    for part in $parts; do
        echo "$core $profile code $part $(($(flash_bytes "$part") - empty))"
    done
    echo "$core $profile blob $name $(stat -c %s "$blob")"
    awk -v prefix="$core $profile $name" -v kinds="$kinds" '
        BEGIN { split(kinds, kind, " ") }
        $1 == "measured" { print prefix, kind[$2 + 1], $4, $6, $7, $9, $10, $12, $14 }' "$build/measured.txt"
} >"$rows"
[[ -z ${ROWS:-} ]] || cat "$rows" >>"$ROWS"
answers=$(grep '^workload ' "$build/measured.txt") || fail "$image.elf printed no answers"
echo "$core, profile $profile, $name"
awk 'NF == 5 { print $3 " " $4 " " $5; next }
    ++row == 1 { printf "%-24s %6s %13s %10s %10s %8s %6s %9s\n",
        "query", "calls", "instructions", "max", "blob bytes", "max", "stack", "elsewhere" }
    { printf "%-24s %6d %13d %10d %10d %8d %6d %9d\n", $4, $5, $6, $7, $8, $9, $10, $11 }' "$rows"
echo "$answers"
