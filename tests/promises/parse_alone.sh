#!/usr/bin/env bash
# parse_alone.sh CLANG LIBRARY_FOLDER: clang parses each header of the folder as a file by itself, as clangd
# does in an editor. Files of one kind of processor are parsed for that kind.
set -euo pipefail
export clang=$1 library=$2
command -v "$clang" >/dev/null || { echo "skipped: there is no clang++"; exit 77; }

# The options for a file of one kind of processor, or that compiles what its user names; .clangd has the same.
options_for() {
    case $1 in
        *neon*) echo --target=aarch64-linux-gnu ;;
        *simd128*) echo --target=wasm32-wasi -msimd128 ;;
        */for_each_set.hpp) echo '--target=x86_64-linux-gnu -DESPALIER_FRAGMENT=<runtime/lanes/contract.hpp>' ;;
        */lanes/* | *avx*) echo --target=x86_64-linux-gnu ;;
    esac
}
parse_alone() (
    set -e
    file=$1
    read -ra options < <(options_for "$file"; echo)
    if [[ ${#options[@]} -gt 0 ]] && ! echo '#include <span>' | "$clang" "${options[@]}" -std=c++20 -fsyntax-only -x c++ - 2>/dev/null; then
        echo "not parsed, since there are no headers for ${options[*]}: $file"
        exit
    fi
    "$clang" "${options[@]}" -std=c++20 -I "$library" -fsyntax-only -Werror -x c++-header "$file"
    if [[ $file == *.h ]]; then "$clang" -std=c99 -pedantic -I "$library" -fsyntax-only -Werror -x c-header "$file"; fi
)
export -f options_for parse_alone

# The package for Python includes headers of Python, which are there only where it is built.
mapfile -t files < <(find "$library" -path "$library/python" -prune -o \( -name '*.h' -o -name '*.hpp' \) -print)
[[ ${#files[@]} -gt 200 ]] || { echo "only ${#files[@]} headers in $library: is it lib?"; exit 1; }
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" bash -c 'parse_alone "$1"; [[ $? -eq 0 ]] || { echo "does not parse alone: $1"; exit 1; }' -
