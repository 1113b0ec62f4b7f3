#!/usr/bin/env bash
# run_example.sh ESPALIER_COMMAND BUILD_FOLDER CMAKE GENERATOR: builds a copy of docs/examples/firmware as a newcomer would, runs
# it under QEMU, and looks for what it prints in docs/embedding.md.
# Exit status: 0 it says what the page says, 77 a tool is missing, other: a failure.
set -euo pipefail

command=$1 build=$2 cmake=$3 generator=$4
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

for tool in arm-none-eabi-g++ qemu-system-arm; do
    if ! command -v "$tool" >/dev/null; then
        echo "skipped: $tool is not installed (tools/dev prove firmware installs it)"
        exit 77
    fi
done
rm -rf "$build/copy"
mkdir -p "$build"
cp -r "$root/docs/examples/firmware" "$build/copy"
"$cmake" -S "$build/copy" -B "$build/build" -G "$generator" -DESPALIER_EXECUTABLE="$command" -DESPALIER_FOLDER="$root" \
    -DCMAKE_TOOLCHAIN_FILE="$root/lib/cmake/toolchains/cortex-m4f.cmake" >"$build/configure.log" 2>&1 ||
    { cat "$build/configure.log"; exit 1; }
"$cmake" --build "$build/build" --parallel 2 >"$build/build.log" 2>&1 || { tail -n 60 "$build/build.log"; exit 1; }
timeout 60 qemu-system-arm -M mps2-an386 -nographic -monitor none -serial null \
    -semihosting-config enable=on,target=native -kernel "$build/build/arm.elf" </dev/null >"$build/said.txt" 2>&1 ||
    { cat "$build/said.txt"; echo "failed: arm.elf ended badly"; exit 1; }
cat "$build/said.txt"
[[ -s $build/said.txt ]] || { echo "failed: arm.elf said nothing"; exit 1; }
[[ $(<"$root/docs/embedding.md") == *$'\n\n'"$(sed 's/^/    /' "$build/said.txt")"$'\n\n'* ]] ||
    { echo "failed: docs/embedding.md shows something else"; exit 1; }
