# Which branches of the runtime the tests take.

# Few queries are enough to take a branch, and unoptimised code is slow: the tests run a fiftieth of the cases, without real
# meshes, and those that run every query at every change of a blob are left out. Tests of the number of cases fail then; the
# real test runs are `tools/dev test` and `tools/dev prove`.
coverage() {
    local build=build/coverage set program runtime='lib/runtime/.*' verifier='lib/runtime/open/.*'
    install_missing "${build_packages[@]}" "${test_packages[@]}" gcovr
    check_cmake
    local options=(-DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=g++ -DESPALIER_COVERAGE=ON -DESPALIER_TOOLS=OFF
        -DESPALIER_BENCH=OFF)
    build "$build" espalier_tests "${options[@]}"
    build "$build" espalier_query_answers "${options[@]}"
    build "$build" espalier_platform_blobs "${options[@]}"
    find "$build" -name '*.gcda' -delete
    for program in $(test_programs "$build"); do
        ESPALIER_TEST_SCALE=0.02 ESPALIER_MESHES=none "$program" \
            --source-file="*/tests/runtime/*,*/tests/promises/flush_*,*/tests/baker/spatial_*,*/tests/baker/edge_*" \
            --source-file-exclude="*hostile*,*weird*" \
            --test-case-exclude="$(patterns_of coverage | cut -d ' ' -f 2- | paste -sd ,)" \
            >"$build/tests.log" 2>&1 || true
        grep -q '^\[doctest\] Status' "$build/tests.log" || fail "the tests did not come to an end: $build/tests.log"
    done
    for set in scalar sse42 avx2 avx512; do
        (cd "$build/tests/platform/blobs" && ../espalier_query_answers --set "$set" 50 *.espl >/dev/null) || [[ $? -eq 77 ]]
    done
    gcovr --root . "$build/lib/runtime" --filter "$runtime" --branches --exclude-unreachable-branches --fail-under-branch 95
    gcovr --root . "$build/lib/runtime" --filter "$verifier" --branches --exclude-unreachable-branches --fail-under-branch 100
}

without_arguments coverage "$@"
coverage
