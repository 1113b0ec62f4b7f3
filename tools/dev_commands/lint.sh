# clang-tidy and cppcheck.
lint() {
    local build=build/lint
    install_missing "${build_packages[@]}" "${tool_packages[@]}" clang clang-tidy cppcheck
    check_cmake
    mkdir -p "$build"
    cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ \
        -DESPALIER_TESTS=OFF -DESPALIER_BENCH=OFF >"$build/configure.log"
    cppcheck --enable=warning,performance,portability --std=c++20 --language=c++ --quiet --error-exitcode=1 -j "$(nproc)" \
        --suppress=missingIncludeSystem --suppressions-list=.cppcheck -Ilib -D__x86_64__ -D__SSE2__ -D__STDCPP_THREADS__ \
        -DESPALIER_PLAIN_LEAVES=1 -DESPALIER_STRIP_LEAVES=1 -DESPALIER_PREDICTED_STRIPS=1 lib tools || fail "cppcheck found something"
    # The files of lib/wasm are for another machine.
    git ls-files 'lib/*.cpp' 'tools/*.cpp' ':!lib/wasm' | xargs -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet 2>"$build/tidy.log" ||
        fail "clang-tidy found something"
    echo "nothing found"
}

without_arguments lint "$@"
lint
