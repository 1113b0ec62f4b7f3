# Espalier and its peers, measured beside each other: rays. The program measures other queries too (docs/benchmarks.md).
bench() {
    install_missing "${build_packages[@]}" libcli11-dev libembree-dev libbullet-dev libode-dev libfcl-dev >&2
    check_cmake
    build build/bench espalier_bench_peers -DCMAKE_BUILD_TYPE=Release -DESPALIER_BENCH=ON -DESPALIER_TESTS=OFF -DESPALIER_TOOLS=OFF \
        >&2
    if [[ ${1-} == --publish ]]; then
        [[ $# -ge 3 ]] || fail "bench --publish NAME MESH...: NAME is the date and the machine, as in 2026-11-20_epyc_avx2"
        publish_bench "${@:2}"
    elif [[ ${1-} == --help ]]; then
        build/bench/bench/espalier_bench_peers rays --help
    else
        install_missing python3 >&2
        build/bench/bench/espalier_bench_peers rays "$@" |
            bench/rows.py mesh triangles bits -- system profile step bytes_per_triangle bytes_per_triangle_20_bits \
                bytes_per_triangle_with_ids {incoherent,coherent,any,build}_{ratio,spread} incoherent_mrays build_seconds \
                disagreeing t_disagreeing any_contradictions
    fi
}

# publish_bench NAME ARGUMENT...: three runs, since a process may be lucky with its memory; then the tables and plots
publish_bench() {
    local name=$1 rows=build/bench/rows.jsonl run
    shift
    install_missing python3
    : >"$rows"
    for run in 1 2 3; do
        echo "run $run of 3" >&2
        build/bench/bench/espalier_bench_peers rays "$@" >>"$rows"
    done
    publish_rows "$name" "$rows"
    python3 bench/report.py --add "bench/results/$name.jsonl"
}

bench "$@"
