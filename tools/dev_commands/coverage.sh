# Which branches of the runtime the tests take.

# Few queries are enough to take a branch, and unoptimised code is slow: the tests run a fiftieth of the cases, without real
# meshes, and those that run every query at every change of a blob are left out, as are stacks of unoptimised code. Tests of the number
# of cases fail then; the real test runs are `tools/dev test` and `tools/dev prove`.
coverage() {
    local build=$PWD/build/coverage set program objects=() options=(-DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++
        -DESPALIER_COVERAGE=ON -DESPALIER_TOOLS=OFF -DESPALIER_BENCH=OFF)
    install_missing "${build_packages[@]}" "${test_packages[@]}" llvm
    check_cmake
    build build/coverage espalier_tests --fresh "${options[@]}"
    build build/coverage espalier_query_answers "${options[@]}"
    build build/coverage espalier_platform_blobs "${options[@]}"
    rm -rf "$build/profiles"
    export LLVM_PROFILE_FILE=$build/profiles/%p.profraw
    for program in $(test_programs "$build"); do
        ESPALIER_TEST_SCALE=0.02 ESPALIER_MESHES=none "$program" \
            --source-file="*/tests/runtime/*,*/tests/c/*,*/tests/promises/flush_*,*/tests/baker/spatial_*,*/tests/baker/edge_*" \
            --source-file-exclude="*hostile*,*weird*,*scenes/cost*" \
            --test-case-exclude="$(patterns_of coverage | cut -d ' ' -f 2- | paste -sd ,)" \
            >"$build/tests.log" 2>&1 || true
        grep -q '^\[doctest\] Status' "$build/tests.log" || fail "the tests did not come to an end: $build/tests.log"
        objects+=(-object "$program")
    done
    for set in scalar sse42 avx2 avx512; do
        (cd "$build/tests/platform/blobs" && ../espalier_query_answers --set "$set" 50 *.espl >/dev/null) || [[ $? -eq 77 ]]
    done
    llvm-profdata merge -sparse "$build"/profiles/*.profraw -o "$build/all.profdata"
    llvm-cov export -skip-expansions -instr-profile="$build/all.profdata" "$build/tests/platform/espalier_query_answers" "${objects[@]}" \
        >"$build/branches.json"
    python3 tools/dev_commands/branches.py "$build/branches.json" lib/runtime/=97 lib/runtime/open/=100
}

without_arguments coverage "$@"
coverage
