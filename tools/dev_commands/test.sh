# Every test, and again under sanitizers.

passed=0
failed=0
skipped=0

# run_tests FOLDER CTEST_OPTION...: shows ctest's own summary and adds to the totals
run_tests() {
    local folder=$1 results=$PWD/$1/results.xml run not_run all
    shift
    rm -f "$results"
    ctest --test-dir "$folder" --output-on-failure --no-tests=error --output-junit "$results" \
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
    passed=$((passed + run))
    skipped=$((skipped + not_run))
    failed=$((failed + all - run - not_run))
}

run_all_tests() {
    local warnings_are_errors=OFF precompile_headers=ON
    export WERROR=-Wno-error  # for the tests that run a compiler
    case ${1-} in
        --strict)
            warnings_are_errors=ON precompile_headers=OFF WERROR=-Werror  # also at a missing include
            # A checkout is new each time and has another name; what did not change is compiled once, also by tests that build.
            if command -v ccache >/dev/null; then
                export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
                export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
            fi
            ;;
        ?*) fail "test [--strict]: '$1' is no option" ;;
    esac
    install_missing "${build_packages[@]}" "${tool_packages[@]}" "${test_packages[@]}"
    check_cmake
    # What only the tests use is installed while this machine compiles.
    install_missing "${late_test_packages[@]}" "${machine_packages[@]}" $(wasm_packages) $(formatter_packages) &
    local installation=$!
    local built=no
    if build build/release all --preset release -DESPALIER_WARNINGS_ARE_ERRORS="$warnings_are_errors" \
        -DESPALIER_PRECOMPILE_HEADERS="$precompile_headers"; then built=yes; fi
    wait "$installation" || fail "packages are missing"
    if [[ $built == yes ]]; then
        run_tests build/release -LE windows  # `tools/dev platforms` runs those
    else
        failed=$((failed + 1))
    fi
    if build build/sanitize all --preset sanitize -DESPALIER_WARNINGS_ARE_ERRORS="$warnings_are_errors"; then
        run_tests build/sanitize -LE emulated
    else
        failed=$((failed + 1))
    fi
    local summary="$passed passed, $failed failed"
    [[ $skipped -eq 0 ]] || summary+=", $skipped skipped"
    echo "$summary"
    [[ $failed -eq 0 ]]
}

run_all_tests "$@"
