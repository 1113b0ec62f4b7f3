# Rays in WebAssembly: how much faster the runtime is with SIMD128 than without, and whether the answers are the same.
wasm() {
    [[ $# -gt 0 ]] || fail "wasm BLOB...: a blob is needed; 'espalier bake MESH -o BLOB' makes one"
    local blob build=$PWD/build/wasm
    for blob in "$@"; do [[ -f $blob ]] || fail "there is no blob $blob"; done
    install_missing "${build_packages[@]}" "${machine_packages[@]}" >&2
    install_missing $(wasm_packages) >&2
    check_cmake
    build_rays "$build/scalar" >&2
    CXXFLAGS=-msimd128 build_rays "$build/simd128" >&2
    grep -m 1 '^model name' /proc/cpuinfo || true
    node --no-liftoff bench/wasm/compare.mjs "$build/scalar/rays" "$build/simd128/rays" "$@"
}

# build_rays FOLDER: FOLDER/rays, with the compiler's flags of the environment
build_rays() {
    echo "building the runtime for WebAssembly in $1"
    mkdir -p "$1"
    { cmake -S bench/wasm -B "$1" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_TOOLCHAIN_FILE="$PWD/lib/cmake/toolchains/wasm32-wasi.cmake" && cmake --build "$1" --target rays; } \
        >"$1/build.log" 2>&1 || { tail -n 60 "$1/build.log" >&2; fail "the build in $1 failed; all of it is in $1/build.log"; }
}

wasm "$@"
