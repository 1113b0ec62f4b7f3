# The npm package: two WebAssembly modules with their JavaScript, tested in Node and Chromium; and how fast it is.

wasm_package() {
    local build=$PWD/build/wasm machine
    install_missing "${build_packages[@]}" "${wasm_tools[@]}" "${javascript_packages[@]}" doctest-dev libeigen3-dev libgmp-dev python3
    install_missing $(wasm_packages)
    check_cmake
    # The modules, and the programs that give the golden bits.
    for machine in wasm32 wasm32_simd128; do
        echo "building for $machine in $build/$machine"
        bash tests/platform/run_platform.sh "$machine" 100 "$build/$machine" cmake Ninja || fail "$machine: other bits than golden.txt"
    done
    # What C++ answers here.
    build build/wasm/here espalier_wasm_answers -DCMAKE_BUILD_TYPE=Release -DESPALIER_TOOLS=OFF -DESPALIER_BENCH=OFF -DESPALIER_INSTALL=OFF
    bash tests/wasm/run.sh "$build/wasm32_simd128" "$build/wasm32" "$build/here/tests/wasm/espalier_wasm_answers" "$build"
    echo "package  $build/node_modules/espalier"
    echo "tarball  $(ls "$build"/node_modules/espalier-*.tgz)"
}

# Needs the package that `tools/dev wasm` builds.
wasm_bench() {
    local package=$PWD/build/wasm/node_modules/espalier
    [[ -d $package ]] || fail "there is no package in $package: 'tools/dev wasm' builds it"
    grep -m 1 '^model name' /proc/cpuinfo || true
    node --no-warnings --no-liftoff bench/wasm/compare.mjs "$package" "$@"
}

case ${1-} in
    --bench) wasm_bench "${@:2}" ;;
    *)
        without_arguments wasm "$@"
        wasm_package
        ;;
esac
