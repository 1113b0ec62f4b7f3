# From nothing to a picture and a million rays.
demo() {
    local cmake=build/demo/cmake mesh=build/demo/knot.obj blob=build/demo/knot.espl picture=build/demo/demo.png
    install_missing "${build_packages[@]}" "${tool_packages[@]}"
    check_cmake
    build "$cmake" espalier_demo -DCMAKE_BUILD_TYPE=Release -DESPALIER_TESTS=OFF -DESPALIER_BENCH=OFF
    "$cmake/tools/demo/espalier_demo_mesh" "$mesh"
    "$cmake/tools/espalier" bake "$mesh" -o "$blob" --tolerance 0.0005 --quiet
    "$cmake/tools/espalier" verify "$blob" --deep >/dev/null
    "$cmake/tools/espalier" render "$blob" -o "$picture" --quiet
    "$cmake/tools/demo/espalier_demo_rays" "$mesh" "$blob" "$picture"
}

without_arguments demo "$@"
demo
