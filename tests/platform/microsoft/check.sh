#!/usr/bin/env bash
# check.sh: parses the runtime and all public headers by clang in its Microsoft mode, where long has 32 bits, structures are laid out
# as by Visual C++, and _MSC_VER is defined. The headers of libraries are LLVM's for C++ and those of MinGW-w64 for C.
# Exit status: 77 where a part of that is missing.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$here/../../.."
library=$(find /usr/lib/llvm-*/include/wasm32-wasi/c++/v1 -maxdepth 0 2>/dev/null | sort -V | tail -n 1) || true
c_headers=/usr/x86_64-w64-mingw32/include
if ! command -v clang++ >/dev/null || [[ ! -d $library || ! -d $c_headers ]]; then
    echo "skipped: clang++, a libc++ for wasm32 or the headers of MinGW-w64 are not installed (tools/dev prove installs them)"
    exit 77
fi

# no_unique_address has no effect in that mode; it only saves room.
warnings=(-Wall -Wextra -Wconversion -Wsign-conversion -Wdouble-promotion -Wcast-align -Wundef -Werror -Wno-unknown-attributes)
mode=(--target=x86_64-pc-windows-msvc -fsyntax-only -nostdlibinc -Ilib -ffp-contract=off "${warnings[@]}")
cpp=(clang++ "${mode[@]}" -std=c++20 -nostdinc++ -D_LIBCPP_NO_VCRUNTIME -include "$here/c_headers.hpp" -isystem "$library"
    -isystem "$c_headers")
find lib/runtime -name '*.cpp' -print0 | xargs -0 -n 8 -P 2 "${cpp[@]}"
find lib/espalier -name '*.hpp' -print0 | xargs -0 -n 1 -P 2 "${cpp[@]}" -xc++ -Wno-pragma-once-outside-header
for header in lib/espalier/*.h; do
    clang "${mode[@]}" -std=c99 -xc -isystem "$c_headers" "$header"
done
