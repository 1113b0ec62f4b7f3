#!/usr/bin/env bash
# run_firmware.sh m0|m4f fast|balanced HOST_QUERY_ANSWERS BLOB_FOLDER BUILD_FOLDER CMAKE GENERATOR
# Builds bare-metal images, runs them under QEMU, compares their answers with this machine's and prints code and stack size.
# Exit status: 0 the same bits, 1 other bits or a failure, 77 a tool is missing.
set -euo pipefail

core=$1 profile=$2 host_program=$3 blobs=$4 build=$5 cmake=$6 generator=$7
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
questions=50

# What the README promises for these cores, in bytes. The images read one profile alone.
stack_budget=2560
case $core in
    m0) board=microbit ray_code_budget=20480 ;;
    m4f) board=mps2-an386 ray_code_budget=12800 ;;
    *) echo "failed: no such core: $core"; exit 1 ;;
esac
case $profile in
    fast) blob=small ;;
    balanced) blob=strips ray_code_budget=$((ray_code_budget + 1024)) ;;
    *) echo "failed: no blob of profile $profile"; exit 1 ;;
esac
for tool in arm-none-eabi-g++ qemu-system-arm; do
    if ! command -v "$tool" >/dev/null; then
        echo "skipped: $tool is not installed (tools/dev test installs it)"
        exit 77
    fi
done

run_image() {  # prints what the image prints; its exit status is the image's
    timeout 200 qemu-system-arm -M "$board" -nographic -monitor none -serial null \
        -semihosting-config enable=on,target=native -kernel "$build/$1.elf" </dev/null 2>&1
}
flash_bytes() { arm-none-eabi-size "$build/$1.elf" | awk 'NR == 2 { print $1 + $2 }'; }

mkdir -p "$build"
"$cmake" -S "$here/image" -B "$build" -G "$generator" -DBLOB="$blobs/$blob.inc" -DESPALIER_PROFILES="$profile" -DQUESTIONS="$questions" \
    -DCMAKE_TOOLCHAIN_FILE="$here/../../lib/cmake/toolchains/cortex-$core.cmake" >"$build/configure.log" 2>&1 ||
    { cat "$build/configure.log"; exit 1; }
"$cmake" --build "$build" --parallel 2 >"$build/build.log" 2>&1 || { cat "$build/build.log"; exit 1; }

for image in empty closest_ray; do
    run_image "$image" || { echo "failed: the image $image.elf ended with status $?"; exit 1; }
done
"$host_program" "$questions" "$blobs/$blob.espl" | grep '^answers ' >"$build/host.txt"
run_image answers >"$build/$core.txt" || { cat "$build/$core.txt"; echo "failed: answers.elf ended badly"; exit 1; }

ray_code=$(($(flash_bytes closest_ray) - $(flash_bytes empty)))
cat "$build/$core.txt"
echo "code open+raycast $ray_code"
echo "code everything $(($(flash_bytes answers) - $(flash_bytes empty)))"
if ! diff "$build/host.txt" <(grep '^answers ' "$build/$core.txt"); then
    echo "failed: $core answers with other bits than this machine (< this machine, > $core)"
    exit 1
fi
echo "the same bits on $core as here, profile $profile"
if [[ $ray_code -gt $ray_code_budget ]]; then
    echo "failed: open and raycast take more than $ray_code_budget bytes of code"
    exit 1
fi
awk -v budget="$stack_budget" '
    $1 == "stack" { queries++; if ($3 > budget) { print "failed: " $2 " takes more than " budget " bytes of stack"; bad = 1 } }
    END { exit bad || queries == 0 }' "$build/$core.txt"
