#!/usr/bin/env bash
# run_firmware.sh m0|m4f fast|balanced HOST_QUERY_ANSWERS BLOB_FOLDER BUILD_FOLDER CMAKE GENERATOR
# Builds bare-metal images, runs them under QEMU, compares their answers with this machine's and prints code and stack size.
# Exit status: 0 the same bits, 1 other bits or a failure, 77 a tool is missing.
set -euo pipefail

core=$1 profile=$2 host_program=$3 blobs=$4 build=$5
export CMAKE=$6 GENERATOR=$7
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
questions=50

# What the README promises for these cores, in bytes. The images read one profile alone.
stack_budget=2560
case $core in
    m0) ray_code_budget=20480 ;;
    m4f) ray_code_budget=12800 ;;
esac
case $profile in
    fast) blob=small ;;
    balanced) blob=strips ray_code_budget=$((ray_code_budget + 1024)) ;;
    *) echo "failed: no blob of profile $profile"; exit 1 ;;
esac
board=$(awk -v core="$core" '$1 == core { print $2 }' "$here/cores.txt")

run_image() {  # prints what the image prints; its exit status is the image's
    timeout 200 qemu-system-arm -M "$board" -nographic -monitor none -serial null \
        -semihosting-config enable=on,target=native -kernel "$build/$1.elf" </dev/null 2>&1
}
flash_bytes() {
    arm-none-eabi-size -A "$build/$1.elf" |
        awk '$1 == ".text" || $1 == ".ARM.exidx" || $1 == ".data" { sum += $2 } END { print sum }'
}

TARGETS="answers closest_ray empty" bash "$here/build_images.sh" "$core" "$profile" "$blobs/$blob.espl" "$build" \
    -DQUESTIONS="$questions"

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
