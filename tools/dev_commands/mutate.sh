# Breaking the library in every place, and what no test notices.
mutate() {
    install_missing "${build_packages[@]}" doctest-dev libeigen3-dev libgmp-dev python3 >&2
    check_cmake
    python3 tests/mutation/mutate.py build/mutation "$@"
}

mutate "$@"
