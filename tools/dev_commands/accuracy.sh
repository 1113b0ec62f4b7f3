# How far blobs are from their source.
accuracy() {
    local program=build/accuracy/bench/espalier_bench_accuracy name mesh process processes=() files=()
    install_missing "${build_packages[@]}" libcli11-dev python3 >&2
    check_cmake
    build build/accuracy espalier_bench_accuracy -DCMAKE_BUILD_TYPE=Release -DESPALIER_BENCH=ON -DESPALIER_TESTS=OFF -DESPALIER_TOOLS=OFF \
        -DESPALIER_BENCH_PEERS=OFF >&2
    if [[ ${1-} == --publish ]]; then
        [[ $# -ge 3 ]] || fail "accuracy --publish NAME MESH...: NAME is the date, as in 2026-11-20_accuracy"
        name=$2
        for mesh in "${@:3}"; do # beside each other, since nothing is timed
            files+=("build/accuracy/${#files[@]}.jsonl")
            "$program" "$mesh" >"${files[-1]}" &
            processes+=($!)
        done
        for process in "${processes[@]}"; do wait "$process" || fail "accuracy: a mesh could not be measured, see above"; done
        publish_rows "$name" "${files[@]}"
        python3 bench/accuracy_report.py "bench/results/$name.jsonl"
    else
        "$program" "$@"
    fi
}

accuracy "$@"
