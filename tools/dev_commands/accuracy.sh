# How far blobs are from their source.
accuracy() {
    local program=$bench_folder/bench/espalier_bench_accuracy name mesh process processes=() files=()
    install_missing "${build_packages[@]}" libcli11-dev python3 >&2
    build_bench espalier_bench_accuracy
    if [[ ${1-} == --publish ]]; then
        [[ $# -ge 3 ]] || fail "accuracy --publish NAME MESH...: NAME is the date, as in 2026-11-20_accuracy"
        name=$2
        for mesh in "${@:3}"; do # beside each other, since nothing is timed
            files+=("$bench_folder/accuracy_${#files[@]}.jsonl")
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
