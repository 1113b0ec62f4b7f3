#!/usr/bin/env bash
# measure.sh CORE PROFILE MESH|BLOB.espl [BAKE_OPTION...]: what queries of a mesh cost on an emulated core, by instructions,
# bytes read of the blob, stack and writes outside the stack; and how much code they take. By hand:
#     bash tests/firmware/measure.sh m4f fast bunny.obj --bits 16
# Cores: cores.txt. The command that bakes is found in ../build/tools or build/tools, or by ESPALIER=...; images and blobs
# are made in build/firmware/CORE_PROFILE, or in the folder BUILD=... Images are compiled again when the library changes.
set -euo pipefail

core=$1 profile=$2 mesh=$3
shift 3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${BUILD:-$root/build/firmware/${core}_$profile}

fail() {
    echo "failed: $*" >&2
    exit 1
}
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
TARGETS=${TARGETS:-"measure closest_ray five_queries every_query empty"} bash "$here/build_images.sh" "$core" "$profile" "$blob" "$build"

# The plugin for this QEMU: until version 9 it takes interface 1, since then 2 and later.
major=$(qemu-system-arm --version | sed -nE '1s/.*version ([0-9]+).*/\1/p')
plugin=$build/query_meter.so
if [[ ! $plugin -nt $here/plugin/query_meter.cpp ]]; then
    "${CXX:-c++}" -std=c++20 -O2 -shared -fPIC -DQUERY_METER_PLUGIN_VERSION=$((major < 9 ? 1 : 2)) -o "$plugin" "$here/plugin/query_meter.cpp"
fi

read -r _ board _ memory _ < <(grep "^$core " "$here/cores.txt")
address_of() { arm-none-eabi-nm "$build/measure.elf" | awk -v name="$1" '$3 == name { print "0x" $1 }'; }
stack_bottom=$(address_of image_bss_end) stack_top=$(address_of image_stack_top) blob_at=$(address_of firmware_blob)
timeout 600 qemu-system-arm -M "$board" -nographic -monitor none -serial null \
    -semihosting-config enable=on,target=native -kernel "$build/measure.elf" -d plugin \
    -plugin "$plugin,marks=$(address_of firmware_marks),blob=$blob_at,blob_size=$(stat -c %s "$blob"),stack=$stack_bottom,stack_size=$((stack_top - stack_bottom))" \
    </dev/null >"$build/measured.txt" 2>&1 || { cat "$build/measured.txt"; fail "measure.elf ended with status $?"; }

flash_bytes() { arm-none-eabi-size -A "$build/$1.elf" | awk '$1 == ".text" || $1 == ".ARM.exidx" || $1 == ".data" { sum += $2 } END { print sum }'; }
empty=$(flash_bytes empty)
echo "$core $profile $(basename "$mesh") $(stat -c %s "$blob") bytes"
for image in closest_ray five_queries every_query; do
    printf 'code %s %d\n' "$image" $(($(flash_bytes "$image") - empty))
done
# names of kinds, from the workload itself
names=$(sed -nE '/kind_names\[/,/\};/p' "$here/workload.hpp" | grep -oE '"[a-z_]+"' | tr -d '"')
awk -v names="$names" '
    BEGIN { split(names, name, "\n"); printf "%-24s %6s %14s %10s %10s %8s %6s %9s\n", "query", "calls", "instructions", "max", "blob_bytes", "max", "stack", "elsewhere" }
    $1 == "measured" { printf "%-24s %6d %14d %10d %10d %8d %6d %9d\n", name[$2 + 1], $4, $6, $7, $9, $10, $12, $14; next }
    { print }' "$build/measured.txt"
