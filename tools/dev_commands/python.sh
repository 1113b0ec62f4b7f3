# The Python package: a wheel, installed in an environment of its own, with its tests and its example.

# Debian's python3, for which the packages are: another one in front of it in the PATH has none of them.
python=/usr/bin/python3

python_package() {
    local folder=build/python environment=build/python/environment
    install_missing "${build_packages[@]}" "${tool_packages[@]}" "${python_packages[@]}"
    check_cmake
    # The wheel's build folder, with the shared library and the command that the tests compare the package with.
    build "$folder" espalier_shared -DCMAKE_BUILD_TYPE=Release -DESPALIER_PYTHON=ON -DESPALIER_SHARED=ON \
        -DESPALIER_PYTHON_INTERPRETER="$python" -DESPALIER_TOOLS=ON -DESPALIER_IMPORT=ON -DESPALIER_TESTS=OFF -DESPALIER_BENCH=OFF \
        -DESPALIER_INSTALL=OFF
    build "$folder" espalier_command
    echo "building the wheel"
    rm -rf "$folder/wheel" "$folder/setup" "$environment"
    ESPALIER_PYTHON_BUILD=$PWD/$folder "$python" -m pip wheel --quiet --no-index --no-build-isolation --no-deps \
        --wheel-dir "$folder/wheel" lib/python >"$folder/wheel.log" 2>&1 ||
        { tail -n 60 "$folder/wheel.log" >&2; fail "the wheel was not built; all output is in $folder/wheel.log"; }
    rm -rf lib/python/build lib/python/espalier.egg-info
    "$python" -m venv --system-site-packages "$environment"
    "$environment/bin/pip" install --quiet --no-index --no-deps "$folder"/wheel/espalier-*.whl
    # Without folders in the path: what is tested is what was installed.
    env -u PYTHONPATH ESPALIER_LIBRARY="$PWD/$folder/lib/shared/libespalier.so" ESPALIER_COMMAND="$PWD/$folder/tools/espalier" \
        "$environment/bin/python" -B -m pytest -q -p no:cacheprovider tests/python
    env -u PYTHONPATH "$environment/bin/python" -B docs/examples/python/terrain.py "$folder/terrain.png"
    echo "wheel    $(ls "$folder"/wheel/espalier-*.whl)"
    echo "picture  $folder/terrain.png"
}

without_arguments python "$@"
python_package
