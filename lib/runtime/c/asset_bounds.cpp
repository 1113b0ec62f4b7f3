// espalier/c/bounds.h: bounds of the whole asset.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

constexpr espalier_vec3 espalier_k_dop_directions[ESPALIER_K_DOP_COUNT] = {
    {1, 0, 0}, {0, 1, 0},  {0, 0, 1}, {1, 1, 0},  {1, -1, 0}, {1, 0, 1},  {1, 0, -1},
    {0, 1, 1}, {0, 1, -1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
static_assert([] {
    for (unsigned k = 0; k < espalier::KDop::count; ++k)
        if (cpp(espalier_k_dop_directions[k]) != espalier::KDop::directions[k]) return false;
    return true;
}());

espalier_sphere_result espalier_bounding_sphere(const espalier_blob* blob) { return c(bounding_sphere(cpp(blob))); }

espalier_oriented_box_result espalier_oriented_bounds(const espalier_blob* blob) {
    return c(oriented_bounds(cpp(blob)));
}

espalier_k_dop_result espalier_k_dop_bounds(const espalier_blob* blob) { return c(k_dop_bounds(cpp(blob))); }
