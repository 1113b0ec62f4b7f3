# The bits of tests/platform/golden.txt on every machine, compiler and instruction set.
platforms() {
    local questions=2000 build=$PWD/build/platforms here=$PWD/build/release name set failures=0
    local other=(i686 armhf aarch64 riscv64 s390x wasm32 wasm32_simd128 windows) compiler level
    install_missing "${build_packages[@]}" "${machine_packages[@]}" doctest-dev libeigen3-dev
    install_missing $(wasm_packages) "${windows_packages[@]}" "${tool_packages[@]}" python3 jq
    check_cmake
    build build/release espalier_query_answers --preset release
    build build/release espalier_platform_blobs --preset release
    build build/release espalier_command --preset release
    for compiler in gcc clang; do
        for level in O0 O1 O2 O3 O3-native; do other+=("$compiler-$level"); done
    done
    mkdir -p "$build"
    printf '%-24s %-16s  %-16s  %8s  %7s  %s\n' platform blobs answers count seconds same
    for set in scalar sse42 avx2 avx512; do
        platform_row "here, $set" tests/platform/check_golden.sh tests/platform/golden.txt "$questions" "$here/tests/platform/blobs" \
            "$here/tests/platform/espalier_query_answers" --set "$set" || failures=$((failures + 1))
    done
    for name in "${other[@]}"; do
        platform_row "$name" tests/platform/run_platform.sh "$name" "$questions" "$build/$name" cmake Ninja ||
            failures=$((failures + 1))
    done
    ctest --test-dir build/release --label-regex '^windows$' --output-on-failure --no-tests=error || failures=$((failures + 1))
    [[ $failures -eq 0 ]] || fail "$failures platforms give other bits or none, or fail tests"
}

# platform_row NAME COMMAND...: runs it and prints a row of the table; fails where the bits are not those of golden.txt
platform_row() {
    local name=$1 output status=0 start=$SECONDS line
    shift
    output=$("$@" 2>&1) || status=$?
    line=$(grep '^questions .* blobs ' <<<"$output" | head -n 1 | tr -d ,) || true
    if [[ $status -eq 77 ]]; then
        printf '%-24s %s\n' "$name" "$(tail -n 1 <<<"$output")"
        return 0
    fi
    # questions 2000: 21 blobs HASH COUNT answers HASH
    set -- $line
    printf '%-24s %-16s  %-16s  %8s  %7d  %s\n' "$name" "${5-none}" "${8-none}" "${6-0}" $((SECONDS - start)) \
        "$([[ $status -eq 0 ]] && echo yes || echo NO)"
    [[ $status -eq 0 ]] || echo "$output" >&2
    return "$status"
}

without_arguments platforms "$@"
platforms
