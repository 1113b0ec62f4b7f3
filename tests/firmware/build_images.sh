#!/usr/bin/env bash
# build_images.sh CORE PROFILE BLOB BUILD_FOLDER [CMAKE_OPTION...]: bare-metal images for the core, of a runtime that reads
# one profile, with the blob in them; prints nothing when all goes well. Environment: CMAKE, GENERATOR, TARGETS.
# Exit status: 0 built, 77 a tool is missing, other: failed.
set -euo pipefail

core=$1 profile=$2 blob=$3 build=$4
shift 4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cmake=${CMAKE:-cmake}

for tool in arm-none-eabi-g++ qemu-system-arm; do
    if ! command -v "$tool" >/dev/null; then
        echo "skipped: $tool is not installed (tools/dev prove firmware installs it)"
        exit 77
    fi
done
read -r _ _ flash memory blobs _ < <(grep "^$core " "$here/cores.txt") ||
    { echo "failed: no such core: $core"; exit 1; }

# Flags that the environment has for this machine are none for the core, and would change what is counted.
unset CXXFLAGS CPPFLAGS LDFLAGS CMAKE_BUILD_TYPE
mkdir -p "$build"
cmp --silent "$blob" "$build/blob.espl" || cp "$blob" "$build/blob.espl"
"$cmake" -S "$here/image" -B "$build" -G "${GENERATOR:-Ninja}" -DFLASH="$flash" -DRAM="$memory" -DBLOBS="$blobs" \
    -DESPALIER_PROFILES="$profile" -DCMAKE_TOOLCHAIN_FILE="$here/../../lib/cmake/toolchains/cortex-$core.cmake" "$@" \
    >"$build/configure.log" 2>&1 || { cat "$build/configure.log"; exit 1; }
"$cmake" --build "$build" --parallel 2 --target ${TARGETS:-all} >"$build/build.log" 2>&1 ||
    { tail -n 60 "$build/build.log"; exit 1; }
