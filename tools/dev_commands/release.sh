# The files of a release: Debian packages, checked by lintian, and the command in archives that need no packages: for Linux,
# and for Windows without the optional parts that Debian does not have for it.

release() {
    local folder=$PWD/build/packages version
    install_missing "${build_packages[@]}" "${tool_packages[@]}" "${windows_packages[@]}" dpkg-dev file gzip lintian zip
    check_cmake
    # The same commit gives the same files.
    SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || stat -c %Y CMakeLists.txt)
    export SOURCE_DATE_EPOCH
    rm -rf "$folder"
    build "$folder/build" espalier_command "${release_options[@]}" -DCMAKE_INSTALL_PREFIX=/usr
    version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$folder/build/CMakeCache.txt")
    debian_packages "$folder"
    linux_archive "$folder" "espalier-$version-linux-$(uname -m)"
    windows_archive "$folder" "espalier-$version-windows-x86_64"
    (cd "$folder" && sha256sum -- *.deb *.tar.gz *.zip >SHA256SUMS)
    echo "in $folder:"
    (cd "$folder" && ls -l -- *.deb *.tar.gz *.zip SHA256SUMS)
}

documents=(LICENSE README.md docs/changelog.md)
release_options=(-DCMAKE_BUILD_TYPE=Release -DESPALIER_TESTS=OFF -DESPALIER_BENCH=OFF)

# debian_packages FOLDER
debian_packages() {
    local folder=$1
    cpack -G DEB -B "$folder" --config "$folder/build/CPackConfig.cmake" >"$folder/build/cpack.log" 2>&1 ||
        { tail -n 20 "$folder/build/cpack.log" >&2; fail "there are no Debian packages; all output is in $folder/build/cpack.log"; }
    rm -rf "$folder/_CPack_Packages"
    echo "checking the Debian packages"
    # They are built by no Debian developer and close no bug of Debian.
    lintian --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs "$folder"/*.deb || fail "lintian has findings"
}

# linux_archive FOLDER NAME: NAME.tar.gz with the command and all libraries that it is linked to, but for those of the C library
linux_archive() {
    local folder=$1 name=$2 stage=$1/build/$2 library
    # An RPATH, unlike a RUNPATH, counts for the libraries of the libraries too.
    build "$folder/build" espalier_command "${release_options[@]}" "-DCMAKE_INSTALL_RPATH=\$ORIGIN/../lib" \
        -DCMAKE_EXE_LINKER_FLAGS=-Wl,--disable-new-dtags
    rm -rf "$stage"
    cmake --install "$folder/build" --prefix "$stage" --component tools --strip >"$folder/build/install.log"
    rm -rf "$stage"/lib*
    mkdir -p "$stage/lib" "$stage/share/doc" "$stage/share/man/man1"
    cp "${documents[@]}" "$stage/share/doc"
    cp tools/espalier.1 "$stage/share/man/man1"
    while read -r library; do
        cp -L "$library" "$stage/lib"
        add_licence "$library" "$stage/share/doc"
    done < <(linked_libraries "$folder/build/tools/espalier")
    try_linux_command "$folder/build/trial" "$stage"
    tar -C "$folder/build" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" -cf - "$name" |
        gzip -9n >"$folder/$name.tar.gz"
}

# linked_libraries PROGRAM: the files of the libraries that it loads, but for those of the C library
linked_libraries() {
    local loaded
    loaded=$(env -i ldd "$1") || fail "ldd does not read $1"
    awk '$3 ~ /^\// && $3 !~ /\/lib(c|m|dl|rt|pthread)\.so/ { print $3 }' <<<"$loaded"
}

# add_licence LIBRARY FOLDER: copies the copyright file of the package that the library belongs to
add_licence() {
    local package file
    file=$(realpath "$1")
    # Where /lib is a link to /usr/lib, dpkg has either name.
    package=$(dpkg -S "$file" 2>/dev/null || dpkg -S "${file#/usr}") || fail "no package has $file"
    package=${package%%:*}
    cp -L "/usr/share/doc/$package/copyright" "$2/$package.copyright"
}

# windows_archive FOLDER NAME: NAME.zip with the command, which needs no library but those of Windows
windows_archive() {
    local folder=$1 name=$2 cross=$1/windows stage=$1/build/$2 package
    bash lib/cmake/toolchains/header_libraries.sh "$folder/headers" || fail "the command cannot be built for Windows"
    build "$cross" espalier_command "${release_options[@]}" -DESPALIER_INSTALL=OFF -DESPALIER_COMMAND_PARTS= \
        "-DCMAKE_TOOLCHAIN_FILE=$PWD/lib/cmake/toolchains/x86_64-w64-mingw32.cmake" "-DCMAKE_FIND_ROOT_PATH=$folder/headers"
    rm -rf "$stage"
    mkdir -p "$stage/licences"
    cp "${documents[@]}" "$stage"
    # These are part of the program: the headers, and the libraries of the compiler.
    for package in libcli11-dev nlohmann-json3-dev g++-mingw-w64-x86-64-posix mingw-w64-x86-64-dev; do
        cp -L "/usr/share/doc/$package/copyright" "$stage/licences/$package.copyright"
    done
    x86_64-w64-mingw32-strip -o "$stage/espalier.exe" "$cross/tools/espalier.exe"
    bake_and_query "$folder/build/windows_trial" "$stage" bash "$PWD/tests/platform/other/run_wine.sh" "$cross/wine" ./moved/espalier.exe
    find "$stage" -exec touch --no-dereference "--date=@$SOURCE_DATE_EPOCH" {} +
    (cd "$folder/build" && find "$name" | LC_ALL=C sort | TZ=UTC zip -q -9 -X -@ "$folder/$name.zip")
}

# bake_and_query FOLDER STAGE COMMAND...: bakes, verifies and queries with a command of STAGE, moved to FOLDER/moved
bake_and_query() {
    local folder=$1 stage=$2
    shift 2
    rm -rf "$folder"
    mkdir -p "$folder"
    cp -r "$stage" "$folder/moved"
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$folder/triangle.obj"
    (cd "$folder" && "$@" bake triangle.obj -o triangle.espl --quiet && "$@" verify --deep triangle.espl &&
        "$@" query triangle.espl ray 0.2 0.2 1 0 0 -1) \
        >"$folder/output.txt" 2>&1 || { cat "$folder/output.txt" >&2; fail "the packed command does not run"; }
}

# try_linux_command FOLDER STAGE: with no library of this machine
try_linux_command() {
    local folder=$1 libraries
    bake_and_query "$folder" "$2" env -i moved/bin/espalier
    libraries=$(linked_libraries "$folder/moved/bin/espalier")
    [[ $libraries == *libassimp* ]] || fail "the packed command loads no libassimp"
    ! grep -v "^$folder/moved/" <<<"$libraries" || fail "the packed command loads these libraries of this machine"
}

without_arguments release "$@"
release
