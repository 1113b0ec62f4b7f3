# Which Debian packages there are to install, and how.

build_packages=(g++ cmake ninja-build)
tool_packages=(libassimp-dev libcli11-dev libdraco-dev libexpat1-dev libmeshoptimizer-dev libpng-dev nlohmann-json3-dev zlib1g-dev)
test_packages=(clang libclang-rt-dev doctest-dev libeigen3-dev libgmp-dev python3)
# Tests run these or compile with them; configuring and building do not need them.
late_test_packages=(jq python3-jsonschema assimp-testmodels gltfpack qemu-user g++-powerpc-linux-gnu)
package_test_packages=(make pkgconf dpkg-dev file gzip gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib)
firmware_packages=(gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib qemu-system-arm)
python_packages=(pybind11-dev python3-pybind11 python3-dev python3-numpy python3-pytest python3-matplotlib python3-pip python3-setuptools
    python3-wheel python3-venv python3-distributed)
javascript_packages=(chromium node-typescript)  # the npm package is tested with them; compiling it does not need them
wasm_tools=(clang lld llvm nodejs wasi-libc)
windows_packages=(g++-mingw-w64-x86-64-posix wine64)

is_installed() { [[ $(dpkg-query -W -f '${Status}' "$1" 2>/dev/null || true) == "install ok installed" ]]; }

lists_are_new=no

install_missing() {
    local missing=() package
    command -v dpkg-query >/dev/null ||
        fail "this is no Debian or Ubuntu; install the equivalents of: $*; then use cmake as in 'tools/dev help'"
    for package in "$@"; do
        is_installed "$package" || missing+=("$package")
    done
    [[ ${#missing[@]} -eq 0 ]] && return
    local as_root=()
    if [[ $(id -u) -ne 0 ]]; then
        if sudo -n true 2>/dev/null; then
            as_root=(sudo -n DEBIAN_FRONTEND=noninteractive)
        else
            echo "tools/dev: packages are missing and there is no root to install them. Run this, then try again:" >&2
            echo "sudo apt-get update && sudo apt-get install -y --no-install-recommends ${missing[*]}" >&2
            exit 1
        fi
    fi
    echo "installing ${missing[*]}"
    mkdir -p build
    [[ $lists_are_new == yes ]] || flock build/apt.lock "${as_root[@]}" apt-get -q -o DPkg::Lock::Timeout=300 update >/dev/null ||
        fail "apt-get update failed (no network?)"
    lists_are_new=yes
    flock build/apt.lock "${as_root[@]}" apt-get -q -y -o DPkg::Lock::Timeout=300 install --no-install-recommends "${missing[@]}" >/dev/null ||
        fail "apt-get could not install: ${missing[*]}"
}

# The C++ library for WebAssembly: 16 is the first that has what the baker uses, later ones want a later clang.
wasm_packages() {
    local clang_version library_version
    clang_version=$(clang --version | sed -n '1s/.*version \([0-9]*\).*/\1/p')
    for library_version in 16 17 18 19; do
        if is_installed "libc++-$library_version-dev-wasm32" ||
            apt-cache show "libc++-$library_version-dev-wasm32" >/dev/null 2>&1; then
            echo "libclang-rt-$clang_version-dev-wasm32 libc++-$library_version-dev-wasm32 libc++abi-$library_version-dev-wasm32"
            return
        fi
    done
    fail "no libc++ for wasm32 among the packages"
}

# clang-format 14 where the system has it; without it the test of the format is skipped.
formatter_packages() {
    if is_installed clang-format-14 || apt-cache show clang-format-14 >/dev/null 2>&1; then echo clang-format-14; fi
}

check_cmake() {
    local version
    version=$(cmake --version | awk 'NR == 1 { print $3 }')
    [[ $(printf '%s\n3.25\n' "$version" | sort -V | head -n 1) == 3.25 ]] ||
        fail "CMake 3.25 or later is needed, this is $version (Ubuntu 22.04: snap install cmake --classic)"
}
