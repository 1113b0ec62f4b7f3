# What queries cost on emulated Cortex-M cores.
firmware() {
    local name="" build=$PWD/build/firmware rows=$PWD/build/firmware/rows.txt core mesh failures=0
    if [[ ${1-} == --publish ]]; then
        [[ $# -eq 3 ]] || fail "firmware --publish NAME FOLDER: NAME is the date, as in 2026-11-20_firmware"
        name=$2
        shift 2
        install_missing python3 >&2
        for mesh in bunny.obj fandisk.obj dragon.ply; do
            [[ -f $1/$mesh ]] || fail "there is no $1/$mesh, which the page is about"
        done
    fi
    [[ $# -eq 0 || -d $1 ]] || fail "there is no folder $1"
    build_firmware "$build"
    ESPALIER_MESHES=${1:-none} "$build/tests/firmware/espalier_firmware_blobs" "$build/tests/firmware/blobs" >&2
    : >"$rows"
    for core in $(awk '!/^#/ { print $1 }' tests/firmware/cores.txt); do
        ROWS=$rows BUDGETS=none bash tests/firmware/run_firmware.sh "$core" "$build/tests/firmware" "$build/tests/platform" \
            "$build/images/$core" cmake Ninja || failures=$((failures + 1))
    done
    [[ $failures -eq 0 ]] || fail "$failures cores gave other answers, or none"
    [[ -n $name ]] || return 0
    bash tests/firmware/rows.sh json "$rows" >"$rows.json"
    publish_rows "$name" "$rows.json"
    bash tests/firmware/rows.sh budgets "$rows" >tests/firmware/budgets.txt
    python3 bench/firmware_report.py "bench/results/$name.jsonl"
}

firmware "$@"
