# The quick check: runtime and baker with their unit tests, which compare fewer random cases than tools/dev test does.

check() {
    install_missing "${build_packages[@]}" doctest-dev libeigen3-dev
    check_cmake
    build build/check espalier_unit_tests --preset check
    ESPALIER_TEST_SCALE=${ESPALIER_TEST_SCALE-0.05} ctest --test-dir build/check --label-regex '^unit$' --no-tests=error \
        --output-on-failure --parallel "$(nproc)" >build/check/tests.log 2>&1 ||
        { grep -vE ' +Passed | Start +[0-9]+:' build/check/tests.log >&2; fail "all of it is in build/check/tests.log"; }
    grep ' tests passed' build/check/tests.log
}

check
