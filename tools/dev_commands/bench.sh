# Espalier and its peers, measured beside each other.

# bench OPTION... MESH...: rays alone, as a table. The program measures other queries too (docs/benchmarks.md).
bench() {
    local options=()
    if [[ ${1-} == --checkouts ]]; then
        [[ -d ${2-} ]] || fail "bench --checkouts FOLDER: there is no folder '${2-}'"
        options=("-DESPALIER_CHECKOUTS=$(realpath "$2")")
        shift 2
    fi
    install_missing "${build_packages[@]}" libcli11-dev libembree-dev libbullet-dev libode-dev libfcl-dev python3 >&2
    build_bench espalier_bench_peers "${options[@]}"
    case ${1-} in
        --all)
            [[ $# -eq 2 ]] || fail "bench --all MACHINE: a name for this one, as in epyc_avx512"
            bench_all "$2"
            ;;
        --help) $bench_folder/bench/espalier_bench_peers rays --help ;;
        *)
            $bench_folder/bench/espalier_bench_peers rays "$@" |
                bench/rows.py mesh triangles bits -- system profile step bytes_per_triangle bytes_per_triangle_20_bits \
                    bytes_per_triangle_with_ids {incoherent,coherent,any,build}_{ratio,spread} incoherent_mrays build_seconds \
                    disagreeing t_disagreeing any_contradictions
            ;;
    esac
}

# measure_peers NAME SUBJECT ARGUMENT...: NAME.jsonl of three runs, since a process may be lucky with its memory
measure_peers() {
    local rows=$bench_folder/$1.jsonl run
    : >"$rows"
    for run in 1 2 3; do
        echo "$2: run $run of 3" >&2
        $bench_folder/bench/espalier_bench_peers "${@:2}" >>"$rows"
    done
    publish_rows "$1" "$rows"
}

# bench_all MACHINE: every figure that a page shows, on a quiet machine: rays, points, pairs, sweeps, small bodies, scenes, engines, all of the
# guide, refits, accuracy and small cores. Then the pages.
bench_all() {
    local date meshes small subject target started
    for target in engines study accuracy; do build_bench "espalier_bench_$target"; done
    build_firmware "$PWD/build/firmware"
    started=$SECONDS
    date=$(date -u +%F)
    mapfile -t meshes < <(measured_meshes)
    mapfile -t small < <(smaller_meshes "${meshes[@]}")
    measure_peers "${date}_$1" rays --repetitions 3 "${meshes[@]}"
    for subject in points pairs scenes; do measure_peers "${date}_$subject" "$subject" "${meshes[@]}"; done
    measure_peers "${date}_sweeps" sweeps "${small[@]}"
    measure_peers "${date}_bodies" bodies
    $bench_folder/bench/espalier_bench_engines >$bench_folder/engines.jsonl
    publish_rows "${date}_engines" $bench_folder/engines.jsonl
    python3 bench/report.py "bench/results/${date}_$1.jsonl"
    tools/dev guide --name "${date}_guide" "${meshes[@]}"
    $bench_folder/bench/espalier_bench_study deformation "${small[@]}" >$bench_folder/deformation.jsonl
    publish_rows "${date}_deformation" $bench_folder/deformation.jsonl
    python3 bench/deformation_report.py "bench/results/${date}_deformation.jsonl"
    tools/dev accuracy --publish "${date}_accuracy" "${meshes[@]}" &  # these two count
    tools/dev firmware --publish "${date}_firmware" "$(dirname "${meshes[0]}")"
    wait $! || fail "the errors against the source could not be measured"
    echo "all figures: $((SECONDS - started)) s; tests/docs/prose.py names the sentences that are no longer true"
}

bench "$@"
