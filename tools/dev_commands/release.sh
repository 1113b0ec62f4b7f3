# The files of a release: Debian packages, checked by lintian, and the command in an archive that needs no packages.

release() {
    local folder=$PWD/build/packages version
    install_missing "${build_packages[@]}" "${tool_packages[@]}" dpkg-dev file gzip lintian
    check_cmake
    # The same commit gives the same files.
    SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || stat -c %Y CMakeLists.txt)
    export SOURCE_DATE_EPOCH
    rm -rf "$folder"
    build "$folder/build" espalier_command "${release_options[@]}" -DCMAKE_INSTALL_PREFIX=/usr
    version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$folder/build/CMakeCache.txt")
    debian_packages "$folder"
    linux_archive "$folder" "espalier-$version-linux-$(uname -m)"
    (cd "$folder" && sha256sum -- *.deb *.tar.gz >SHA256SUMS)
    echo "in $folder:"
    (cd "$folder" && ls -l -- *.deb *.tar.gz SHA256SUMS)
}

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
    cp LICENSE README.md docs/changelog.md "$stage/share/doc"
    cp tools/espalier.1 "$stage/share/man/man1"
    while read -r library; do
        cp -L "$library" "$stage/lib"
        add_licence "$library" "$stage/share/doc"
    done < <(linked_libraries "$folder/build/tools/espalier")
    try_command "$folder/build/trial" "$stage"
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

# try_command FOLDER STAGE: bakes, verifies and queries with the command as it was packed, moved elsewhere
try_command() {
    local folder=$1 libraries
    rm -rf "$folder"
    mkdir -p "$folder"
    cp -r "$2" "$folder/moved"
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$folder/triangle.obj"
    (cd "$folder" && env -i moved/bin/espalier bake triangle.obj -o triangle.espl --quiet &&
        env -i moved/bin/espalier verify --deep triangle.espl && env -i moved/bin/espalier query triangle.espl ray 0.2 0.2 1 0 0 -1) \
        >"$folder/output.txt" 2>&1 || { cat "$folder/output.txt" >&2; fail "the packed command does not run"; }
    libraries=$(linked_libraries "$folder/moved/bin/espalier")
    [[ $libraries == *libassimp* ]] || fail "the packed command loads no libassimp"
    ! grep -v "^$folder/moved/" <<<"$libraries" || fail "the packed command loads these libraries of this machine"
}

without_arguments release "$@"
release
