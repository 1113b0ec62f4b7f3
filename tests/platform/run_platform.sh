#!/usr/bin/env bash
# run_platform.sh PLATFORM QUESTIONS BUILD_FOLDER CMAKE GENERATOR
# Builds both libraries for the platform, bakes the blobs and asks them there (under an emulator if need be), and compares
# bytes and answers with golden.txt; asks the blobs of old format versions too. PLATFORM is another machine (i686 armhf
# aarch64 riscv64 s390x powerpc wasm32 wasm32_simd128) or system (windows), as released or by other options, as in
# powerpc-O1, or a compiler and its options for this machine, as in gcc-O2 and clang-O3-native.
# Exit status: 0 the same bits, 1 other bits or a failure, 77 a tool is missing.
set -euo pipefail

platform=$1 questions=$2 build=$3 cmake=$4 generator=$5
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

emulator=()
suffix=
options=()
needed=()
# no build type: these flags and no others, so that the compiler vectorises too where it likes
compile_by() { options+=(-DCMAKE_BUILD_TYPE=None "-DCMAKE_CXX_FLAGS_NONE=${1/-native/ -march=native}"); }
use_machine() {  # TOOLCHAIN COMPILER [EMULATOR...]
    options=(-DCMAKE_TOOLCHAIN_FILE="$here/../../lib/cmake/toolchains/$1.cmake")
    if [[ $platform == *-* ]]; then compile_by "-${platform#*-}"; else options+=(-DCMAKE_BUILD_TYPE=Release); fi
    needed=("$2" "${@:3:1}")
    emulator=("${@:3}")
}
machine=${platform%%-*}
case $machine in
    i686) use_machine i686-linux-gnu i686-linux-gnu-g++ ;;
    armhf) use_machine arm-linux-gnueabihf arm-linux-gnueabihf-g++ qemu-arm ;;
    powerpc) use_machine powerpc-linux-gnu powerpc-linux-gnu-g++ qemu-ppc ;;
    aarch64 | riscv64 | s390x) use_machine "$machine-linux-gnu" "$machine-linux-gnu-g++" "qemu-$machine" ;;
    wasm32 | wasm32_simd128)
        if [[ $machine == wasm32_simd128 ]]; then export CXXFLAGS=-msimd128; fi
        use_machine wasm32-wasi wasm-ld node --no-warnings "$here/other/run_wasm.mjs"
        needed+=(llvm-ar)
        ;;
    windows)
        use_machine x86_64-w64-mingw32 x86_64-w64-mingw32-g++-posix bash "$here/other/run_wine.sh" "$build/wine"
        suffix=.exe
        ;;
    gcc | clang)
        compiler=${machine/gcc/g}++
        needed=("$compiler")
        options=(-DCMAKE_CXX_COMPILER="$compiler")
        compile_by "-${platform#*-}"
        ;;
    *)
        echo "failed: no such platform: $platform"
        exit 1
        ;;
esac
for tool in "${needed[@]}"; do
    if ! command -v "$tool" >/dev/null; then
        echo "skipped: $tool is not installed (tools/dev prove installs it)"
        exit 77
    fi
done
mkdir -p "$build"
if [[ $machine == windows ]]; then "${emulator[@]}" || exit; fi  # whether there is a Wine, and it runs programs

"$cmake" -S "$here/other" -B "$build" -G "$generator" "${options[@]}" >"$build/configure.log" 2>&1 ||
    { cat "$build/configure.log"; exit 1; }
"$cmake" --build "$build" --parallel 2 >"$build/build.log" 2>&1 || { tail -n 60 "$build/build.log"; exit 1; }

rm -rf "$build/blobs"
mkdir -p "$build/blobs"
cd "$build"
programs=$PWD
# A kernel of x86-64 that does not execute programs of 32 bits (status 126) needs an emulator.
if [[ $machine == i686 ]]; then
    status=0
    ./query_answers >/dev/null 2>&1 || status=$?
    if [[ $status -eq 126 ]]; then emulator=(qemu-i386); fi
fi
(cd blobs && "${emulator[@]}" "$programs/make_blobs$suffix" . 2>/dev/null) || { echo "failed: nothing was baked"; exit 1; }
check() { "$here/check_golden.sh" "$@" "${emulator[@]}" "$programs/query_answers$suffix"; }
check "$here/golden.txt" "$questions" "$PWD/blobs"
check "$here/../format_versions/golden.txt" "$((questions < 100 ? questions : 100))" "$here/../format_versions"
