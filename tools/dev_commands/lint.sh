# clang-tidy and cppcheck.

# sources_to_lint BUILD: those that include all files of a folder, since headers take most of the time of each; and the files that the
# build has in none of them. Nothing else includes sources. The files of lib/wasm are for another machine.
sources_to_lint() {
    local compiled
    compiled=$(sed -nE 's/^ *"file": "(.*)",?$/\1/p' "$1/compile_commands.json" | grep -E "^$PWD/($1/)?(lib|tools)/" | sort -u)
    echo "$compiled"
    git ls-files 'lib/*.cpp' 'tools/*.cpp' ':!lib/wasm' | sed "s#^#$PWD/#" |
        grep -vxF -f <(echo "$compiled"; echo "$compiled" | grep '/Unity/' | xargs sed -nE 's/^#include "(.*)"$/\1/p') || true
}

lint() {
    local build=build/lint
    install_missing "${build_packages[@]}" "${tool_packages[@]}" clang clang-tidy cppcheck
    check_cmake
    mkdir -p "$build"
    cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ -DESPALIER_UNITY=ON \
        -DESPALIER_TESTS=OFF -DESPALIER_BENCH=OFF >"$build/configure.log"
    cppcheck --enable=warning,performance,portability --std=c++20 --language=c++ --quiet --error-exitcode=1 -j "$(nproc)" \
        --suppress=missingIncludeSystem --suppressions-list=.cppcheck -Ilib -Itools -D__x86_64__ -D__SSE2__ -D__STDCPP_THREADS__ \
        -DESPALIER_PLAIN_LEAVES=1 -DESPALIER_STRIP_LEAVES=1 -DESPALIER_PREDICTED_STRIPS=1 lib tools || fail "cppcheck found something"
    sources_to_lint "$build" | xargs -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet \
        --checks=-bugprone-suspicious-include 2>"$build/tidy.log" || fail "clang-tidy found something"
    echo "nothing found"
}

without_arguments lint "$@"
lint
