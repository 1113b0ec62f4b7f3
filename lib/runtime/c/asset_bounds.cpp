// espalier.h: bounds of the whole asset.
#include <runtime/c/twins.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

constexpr espalier_vec3 espalier_k_dop_directions[ESPALIER_K_DOP_COUNT] = {
    {1, 0, 0}, {0, 1, 0},  {0, 0, 1}, {1, 1, 0},  {1, -1, 0}, {1, 0, 1},  {1, 0, -1},
    {0, 1, 1}, {0, 1, -1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
static_assert([] {
    for (unsigned k = 0; k < KDop::count; ++k)
        if (twin_value(espalier_k_dop_directions[k]) != KDop::directions[k]) return false;
    return true;
}());

bool espalier_bounding_sphere(const espalier_blob* blob, espalier_sphere* sphere) {
    return bounding_sphere(*twin(blob), *twin(sphere));
}

bool espalier_oriented_bounds(const espalier_blob* blob, espalier_oriented_box* box) {
    return oriented_bounds(*twin(blob), *twin(box));
}

bool espalier_k_dop_bounds(const espalier_blob* blob, espalier_k_dop* k_dop) {
    return k_dop_bounds(*twin(blob), *twin(k_dop));
}

bool espalier_is_outside_bounds_sphere(const espalier_blob* blob, const espalier_sphere* sphere) {
    return is_outside_bounds(*twin(blob), *twin(sphere));
}

bool espalier_is_outside_bounds_box(const espalier_blob* blob, const espalier_box* box) {
    return is_outside_bounds(*twin(blob), *twin(box));
}

}  // extern "C"
