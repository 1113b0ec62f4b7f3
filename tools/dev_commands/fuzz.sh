# libFuzzer and AFL++.

fuzz_targets=(open tree bake bake_c scene moving refit import)

fuzz() {
    local engine=libfuzzer small_code="" seconds target found=0
    case ${1-} in
        --afl | --minimise) engine=${1#--} && shift ;;
        --small-code) small_code=ON && shift ;;
    esac
    seconds=${1-60}
    [[ $seconds =~ ^[0-9]+$ ]] || fail "fuzz [--afl | --small-code | --minimise] [SECONDS [TARGET...]]: '$seconds' is no number"
    [[ $# -le 1 ]] || fuzz_targets=("${@:2}")
    install_missing "${build_packages[@]}" "${tool_packages[@]}" clang llvm libclang-rt-dev doctest-dev libeigen3-dev libgmp-dev python3
    [[ $engine != afl ]] || install_missing afl++
    check_cmake
    local folder=build/fuzz/libfuzzer${small_code:+_small} compiler=clang++
    [[ $engine != afl ]] || { folder=build/fuzz/afl compiler=afl-clang-fast++; }
    build "$folder" espalier_fuzz_targets -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O2 -g" \
        -DCMAKE_CXX_COMPILER="$compiler" -DESPALIER_SANITIZE=ON -DESPALIER_FUZZ=ON -DESPALIER_BENCH=OFF \
        -DESPALIER_SMALL_CODE="$small_code"
    local jobs=() job
    for target in "${fuzz_targets[@]}"; do
        [[ -x $folder/fuzz/espalier_fuzz_$target ]] || fail "there is no fuzz target '$target'"
        mkdir -p "build/fuzz/corpus/$target" "build/fuzz/findings" "fuzz/corpus/$target"
        "fuzz_with_$engine" "$folder/fuzz/espalier_fuzz_$target" "$target" "$seconds" &
        jobs+=($!)
        while [[ $(jobs -rp | wc -l) -ge $(nproc) ]]; do wait -n || true; done
    done
    for job in "${jobs[@]}"; do wait "$job" || found=1; done
    return "$found"
}

# fuzz_with_libfuzzer PROGRAM TARGET SECONDS
fuzz_with_libfuzzer() {
    local log=build/fuzz/$2.log status=0 max_len=4096 executions coverage
    [[ $2 != import ]] || max_len=16384  # mesh files are long
    "$1" -max_total_time="$3" -max_len="$max_len" -len_control=0 -timeout=60 -print_final_stats=1 \
        -artifact_prefix="build/fuzz/findings/$2-" "build/fuzz/corpus/$2" "fuzz/corpus/$2" >"$log" 2>&1 || status=$?
    executions=$(awk '/^stat::number_of_executed_units/ { print $2 }' "$log")
    coverage=$(grep -aoE 'cov: [0-9]+' "$log" | tail -n 1)
    if [[ $status -eq 0 ]]; then
        echo "$2: ${executions:-0} executions in $3 s, ${coverage:-cov: none} edges, no findings"
    else
        echo "$2: ${executions:-some} executions, ${coverage:-cov: none} edges, a finding: $(tail -n 1 "$log")"
        return 1
    fi
}

# fuzz_with_afl PROGRAM TARGET SECONDS
fuzz_with_afl() {
    local out=build/fuzz/afl_out/$2 stats findings
    rm -rf "$out"
    AFL_NO_UI=1 AFL_SKIP_CPUFREQ=1 AFL_NO_AFFINITY=1 AFL_I_DONT_CARE_ABOUT_MISSING_CRASHES=1 \
        afl-fuzz -V "$3" -m none -t 20000+ -i "fuzz/corpus/$2" -o "$out" -- "$1" >"build/fuzz/$2_afl.log" 2>&1 ||
        fail "afl-fuzz could not run; its words are in build/fuzz/$2_afl.log"
    stats=$out/default/fuzzer_stats
    findings=$(awk '/^saved_(crashes|hangs)/ { f += $3 } END { print f + 0 }' "$stats")
    awk -v target="$2" -v f="$findings" '/^execs_done/ { n = $3 } /^edges_found/ { e = $3 }
        END { printf "%s: %d executions, cov: %d edges, %d findings\n", target, n, e, f }' "$stats"
    [[ $findings -eq 0 ]]
}

# fuzz_with_minimise PROGRAM TARGET SECONDS: what fuzz/corpus has stays; of what was found, what covers more, small ones
fuzz_with_minimise() {
    local kept
    "$1" -merge=1 -max_len=1024 -timeout=60 "fuzz/corpus/$2" "build/fuzz/corpus/$2" >"build/fuzz/$2_merge.log" 2>&1
    kept=$(find "fuzz/corpus/$2" -type f | wc -l)
    echo "$2: $kept files, $(du -sb "fuzz/corpus/$2" | cut -f 1) bytes"
}

fuzz "$@"
