// espalier.h: how far a query moves when it is rounded.
#include <runtime/c/twins.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

espalier_float_result espalier_rounding_error_point(const espalier_blob* blob, espalier_vec3 point) {
    return twin_value(rounding_error(*twin(blob), twin_value(point)));
}

espalier_float_result espalier_rounding_error_ray(const espalier_blob* blob, const espalier_ray* ray) {
    return twin_value(rounding_error(*twin(blob), *twin(ray)));
}

espalier_float_result espalier_rounding_error_segment(const espalier_blob* blob, const espalier_segment* segment) {
    return twin_value(rounding_error(*twin(blob), *twin(segment)));
}

espalier_float_result espalier_rounding_error_sphere(const espalier_blob* blob, const espalier_sphere* sphere) {
    return twin_value(rounding_error(*twin(blob), *twin(sphere)));
}

espalier_float_result espalier_rounding_error_capsule(const espalier_blob* blob, const espalier_capsule* capsule) {
    return twin_value(rounding_error(*twin(blob), *twin(capsule)));
}

espalier_float_result espalier_rounding_error_box(const espalier_blob* blob, const espalier_box* box) {
    return twin_value(rounding_error(*twin(blob), *twin(box)));
}

espalier_float_result espalier_rounding_error_oriented_box(const espalier_blob* blob,
                                                           const espalier_oriented_box* box) {
    return twin_value(rounding_error(*twin(blob), *twin(box)));
}

espalier_float_result espalier_rounding_error_triangle(const espalier_blob* blob, const espalier_corners* triangle) {
    return twin_value(rounding_error(*twin(blob), *twin(triangle)));
}

}  // extern "C"
