#!/usr/bin/env bash
# any_peers.sh COMPILER: compiles the files that depend on installed peers without any, with each alone and with all, warnings
# as errors. The build itself compiles them with the peers of one machine. Nothing is linked, so no peer has to be installed.
set -euo pipefail

compiler=$1
cd "$(dirname "${BASH_SOURCE[0]}")/.."
peers=(EMBREE BULLET ODE FCL EMBREE4 TINYBVH JOLT BOX3D)

failures=0
# compile FILE PEER...
compile() {
    "$compiler" -std=c++20 -Wall -Wextra -Wconversion -Wshadow "${WERROR:--Werror}" -fsyntax-only -I lib -I tests \
        -DESPALIER_BENCH_VERSION='""' "${@:2}" "$1" || { echo "failed: $*"; failures=$((failures + 1)); }
}

mapfile -t files < <(grep -rlE "ESPALIER_BENCH_($(IFS="|" && echo "${peers[*]}"))\b" bench --include=*.cpp)
[[ ${#files[@]} -gt 0 ]] || { echo "failed: no file depends on a peer"; exit 1; }
for file in "${files[@]}"; do
    defined=()
    for peer in "${peers[@]}"; do
        grep -q "ESPALIER_BENCH_$peer\b" "$file" && defined+=("-DESPALIER_BENCH_$peer")
    done
    compile "$file"
    [[ ${#defined[@]} -lt 2 ]] || compile "$file" "${defined[@]}"
    for one in "${defined[@]}"; do compile "$file" "$one"; done
done
[[ $failures -eq 0 ]]
