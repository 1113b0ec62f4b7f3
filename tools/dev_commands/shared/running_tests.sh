# Running tests by ctest, and counting them.

passed=0
failed=0
skipped=0
skipped_tests=0  # of the skipped, those of ctest

# count_cases LOG: adds the cases of the programs of tests, and those of them that skipped themselves
count_cases() {
    local run
    run=$(awk '/test cases: +[0-9]+ [|] +[0-9]+ passed/ { sub(/.*test cases:/, ""); all += $3 } END { print all + 0 }' "$1")
    passed=$((passed + run))
    skipped=$((skipped + $(grep -ac 'SKIPPED: ' "$1" || true)))
}

# run_tests FOLDER CTEST_OPTION...: shows ctest's own summary and adds to the totals
run_tests() {
    local folder=$1 results=$PWD/$1/results.xml run not_run all
    shift
    rm -f "$results"
    ctest --test-dir "$folder" --output-on-failure --no-tests=error --output-junit "$results" --test-output-size-passed 1000000 \
        --parallel "$(nproc)" "$@" || true
    if [[ ! -s $results ]]; then
        failed=$((failed + 1))
        return
    fi
    all=$(grep -c '<testcase ' "$results" || true)
    run=$(grep -c '<testcase .* status="run"' "$results" || true)
    # a test whose program is missing is reported as skipped too: only those count that skipped themselves or are disabled
    not_run=$(grep -cE '<skipped message="SKIP_|<testcase .* status="disabled"' "$results" || true)
    [[ $all -gt 0 ]] || failed=$((failed + 1))
    passed=$((passed + run - $(grep -c '<testcase name="cases: .* status="run"' "$results" || true)))
    skipped=$((skipped + not_run))
    skipped_tests=$((skipped_tests + not_run))
    failed=$((failed + all - run - not_run))
    count_cases "$results"
}

# summarise: prints the totals; fails if a test failed or none passed
summarise() {
    local summary="$passed passed, $failed failed"
    [[ $skipped -eq 0 ]] || summary+=", $skipped skipped"
    echo "$summary"
    [[ $failed -eq 0 && $passed -gt 0 ]]
}

# one_at_a_time: two that test or prove in one checkout would write each other's files
one_at_a_time() {
    mkdir -p build
    exec {lock}>build/lock
    flock --nonblock "$lock" || fail "another tools/dev test or prove runs in this checkout"
}

# quick_cases TIER... COMMAND...: with a twentieth of the random cases, without the slow ones that tests/scales.txt lists for these tiers
# (quick, check) and without meshes from files
quick_cases() {
    local left_out=()
    while [[ $1 == quick || $1 == check ]]; do
        mapfile -t -O "${#left_out[@]}" left_out < <(patterns_of "$1" | cut -d ' ' -f 2-)
        shift
    done
    ESPALIER_TEST_SCALE=0.05 ESPALIER_MESHES=none ESPALIER_TEST_LEAVE_OUT=$(IFS=,; echo "${left_out[*]}") "$@"
}

# compile_by_ccache: where that is installed. A checkout is new each time and has another name; what did not change is compiled once.
compile_by_ccache() {
    command -v ccache >/dev/null || return 0
    export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
    export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
}
