#!/usr/bin/env bash
# run_emulated.sh MACHINE HOST_QUERY_ANSWERS BLOB_FOLDER BUILD_FOLDER CMAKE GENERATOR
# Builds both libraries for MACHINE, bakes and asks the blobs under QEMU, and compares bytes and answers with this machine's.
# Exit status: 0 the same bits, 1 other bits or a failure, 77 a tool is missing.
set -euo pipefail

machine=$1 host_program=$2 blobs=$3 build=$4 cmake=$5 generator=$6
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
questions=3000

for tool in "$machine-linux-gnu-g++" "qemu-$machine"; do
    if ! command -v "$tool" >/dev/null; then
        echo "skipped: $tool is not installed (tools/dev test installs it)"
        exit 77
    fi
done

mkdir -p "$build"
"$cmake" -S "$here/emulated" -B "$build" -G "$generator" \
    -DCMAKE_TOOLCHAIN_FILE="$here/../../lib/cmake/toolchains/$machine-linux-gnu.cmake" >"$build/configure.log" 2>&1 ||
    { cat "$build/configure.log"; exit 1; }
"$cmake" --build "$build" --parallel 2 >"$build/build.log" 2>&1 || { cat "$build/build.log"; exit 1; }

mkdir -p "$build/blobs"
"qemu-$machine" "$build/make_blobs" "$build/blobs" 2>/dev/null
blob_files=()
for blob in small fine coarse strips dense; do
    blob_files+=("$blobs/$blob.espl")
    cmp "$blobs/$blob.espl" "$build/blobs/$blob.espl" ||
        { echo "failed: $machine bakes other bytes than this machine"; exit 1; }
done

"$host_program" "$questions" "${blob_files[@]}" >"$build/host.txt"
"qemu-$machine" "$build/query_answers" "$questions" "${blob_files[@]}" >"$build/$machine.txt"

cat "$build/$machine.txt"
if ! diff "$build/host.txt" "$build/$machine.txt"; then
    echo "failed: $machine answers with other bits than this machine (< this machine, > $machine)"
    exit 1
fi
echo "the same bytes and answers on $machine as here"
