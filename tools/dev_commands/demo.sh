# The instruction sets that this machine runs, of those that the build can leave out.
instruction_sets_here() {
    case "$(grep -m 1 '^flags' /proc/cpuinfo 2>/dev/null) " in
        *" avx512_vbmi2 "*) echo "avx2;avx512" ;;
        *" avx2 "*) echo avx2 ;;
        *) echo sse42 ;;
    esac
}

# From nothing to a picture and a million rays, and a town.
demo() {
    local cmake=build/demo/cmake mesh=build/demo/knot.obj blob=build/demo/knot.espl picture=build/demo/demo.png
    local scene=build/demo/city.esps scene_picture=build/demo/city.png
    install_missing "${build_packages[@]}" python3 "${tool_packages[@]}"  # Python writes the single file
    check_cmake
    build "$cmake" espalier_demo -DCMAKE_BUILD_TYPE=Release -DESPALIER_TESTS=OFF -DESPALIER_BENCH=OFF -DESPALIER_UNITY=ON \
        -DESPALIER_PRECOMPILE_HEADERS=ON "-DESPALIER_SETS=$(instruction_sets_here)"
    "$cmake/tools/demo/espalier_demo_mesh" "$mesh"
    "$cmake/tools/espalier" bake "$mesh" -o "$blob" --tolerance 0.0005 --quiet
    "$cmake/tools/espalier" verify "$blob" --deep >/dev/null
    "$cmake/tools/espalier" render "$blob" -o "$picture" --quiet
    "$cmake/tools/demo/espalier_demo_rays" "$mesh" "$blob" "$picture"
    "$cmake/tools/demo/city/espalier_city" "$scene"
    "$cmake/tools/espalier" verify "$scene" --deep >/dev/null
    "$cmake/tools/demo/falling/espalier_falling" "$scene" | tail -n 2
    "$cmake/tools/demo/flag/espalier_flag" | tail -n 1
    "$cmake/tools/espalier" render "$scene" -o "$scene_picture" --up z --azimuth 200 --elevation 35 --quiet
    echo "picture  $scene_picture"
}

without_arguments demo "$@"
demo
