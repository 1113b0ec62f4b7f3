# The quick check: the runtime and the baker with their unit tests, at a twentieth of the random cases of tools/dev test, without meshes
# from files and without the slow tests that tests/scales.txt lists.

check() {
    local left_out
    install_missing "${build_packages[@]}" doctest-dev libeigen3-dev
    check_cmake
    build build/check espalier_unit_tests --preset check
    left_out=$(patterns_of check | cut -d ' ' -f 2- | sed 's/[.+^]/\\&/g; s/\*/.*/g' | paste -sd '|')
    ctest --preset check --exclude-regex "^($left_out)\$" --no-tests=error --parallel "$(nproc)" >build/check/tests.log 2>&1 ||
        { tail -n 60 build/check/tests.log >&2; fail "tests failed; all output is in build/check/tests.log"; }
    grep ' tests passed' build/check/tests.log
}

without_arguments check "$@"
check
