# The quick check: the runtime and the baker with their unit tests, and whether the runtime in one file compiles.

single_file_compiles() {
    rm -rf build/check/single
    python3 tools/single_file.py build/check/single
    (cd build/check/single && g++ -std=c++20 -fsyntax-only -Wall -Wextra -Werror espalier.cpp)
}

check() {
    local single_file
    unset ESPALIER_SET
    install_missing "${build_packages[@]}" doctest-dev libeigen3-dev libgmp-dev python3
    check_cmake
    build build/check espalier_unit_tests --preset check
    single_file_compiles &
    single_file=$!
    quick_cases quick check run_tests build/check --label-regex '^unit$' >build/check/tests.log 2>&1
    [[ $failed -eq 0 ]] || { tail -n 60 build/check/tests.log >&2; fail "tests failed; all output is in build/check/tests.log"; }
    wait "$single_file" || fail "what tools/single_file.py makes of lib/runtime does not compile"
    summarise
}

without_arguments check "$@"
check
