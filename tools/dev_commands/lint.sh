# clang-tidy and cppcheck.

# tidy ARGUMENTS...: what clang-tidy finds in each file of its input
tidy() { xargs -P "$(nproc)" -I{} clang-tidy --quiet --checks=-bugprone-suspicious-include {} "$@" 2>/dev/null; }

lint() {
    local build=build/lint compiled python
    install_missing "${build_packages[@]}" "${tool_packages[@]}" python3-dev pybind11-dev clang clang-tidy cppcheck
    check_cmake
    mkdir -p "$build"
    cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ -DESPALIER_UNITY=ON \
        -DESPALIER_TESTS=OFF -DESPALIER_BENCH=OFF >"$build/configure.log"
    cppcheck --enable=warning,performance,portability --std=c++20 --language=c++ --quiet --error-exitcode=1 -j "$(nproc)" \
        --suppress=missingIncludeSystem --suppressions-list=.cppcheck -Ilib -Itools -D__x86_64__ -D__SSE2__ -D__STDCPP_THREADS__ \
        -DESPALIER_PLAIN_LEAVES=1 -DESPALIER_STRIP_LEAVES=1 -DESPALIER_PREDICTED_STRIPS=1 lib tools || fail "cppcheck found something"
    # Those that include all files of a folder, since headers take most of the time of each.
    compiled=$(sed -nE 's/^ *"file": "(.*)",?$/\1/p' "$build/compile_commands.json" | grep -E "^$PWD/($build/)?(lib|tools)/" | sort -u)
    tidy -p "$build" <<<"$compiled" || fail "clang-tidy found something"
    # What this build has in none of them. Some files of lib/wasm and lib/import/platform are for other machines.
    python=$(python3 -c 'import sysconfig; print(sysconfig.get_path("include"))')
    git ls-files 'lib/*.cpp' 'tools/*.cpp' ':!lib/wasm' ':!lib/import/platform/windows' | sed "s#^#$PWD/#" |
        grep -vxF -f <(echo "$compiled"; echo "$compiled" | grep '/Unity/' | xargs sed -nE 's/^#include "(.*)"$/\1/p') |
        tidy -- -std=c++20 -Ilib -Ilib/python/src -Itools -isystem "$python" || fail "clang-tidy found something"
    echo "nothing found"
}

without_arguments lint "$@"
