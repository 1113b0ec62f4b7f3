// espalier.h: shapes that move.
#include <runtime/c/twins.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

bool espalier_sweep_sphere(const espalier_blob* blob, const espalier_sphere* sphere, espalier_vec3 displacement,
                           espalier_sweep_hit* hit) {
    return sweep(*twin(blob), *twin(sphere), twin_value(displacement), *twin(hit));
}

bool espalier_sweep_capsule(const espalier_blob* blob, const espalier_capsule* capsule, espalier_vec3 displacement,
                            espalier_sweep_hit* hit) {
    return sweep(*twin(blob), *twin(capsule), twin_value(displacement), *twin(hit));
}

bool espalier_sweep_box(const espalier_blob* blob, const espalier_box* box, espalier_vec3 displacement,
                        espalier_sweep_hit* hit) {
    return sweep(*twin(blob), *twin(box), twin_value(displacement), *twin(hit));
}

bool espalier_sweep_sphere_filtered(const espalier_blob* blob, const espalier_sphere* sphere,
                                    espalier_vec3 displacement, espalier_sweep_hit* hit,
                                    espalier_triangle_filter filter, void* user) {
    const Filter counts = {filter, user};
    return sweep(*twin(blob), *twin(sphere), twin_value(displacement), *twin(hit), counts);
}

bool espalier_sweep_capsule_filtered(const espalier_blob* blob, const espalier_capsule* capsule,
                                     espalier_vec3 displacement, espalier_sweep_hit* hit,
                                     espalier_triangle_filter filter, void* user) {
    const Filter counts = {filter, user};
    return sweep(*twin(blob), *twin(capsule), twin_value(displacement), *twin(hit), counts);
}

bool espalier_sweep_box_filtered(const espalier_blob* blob, const espalier_box* box, espalier_vec3 displacement,
                                 espalier_sweep_hit* hit, espalier_triangle_filter filter, void* user) {
    const Filter counts = {filter, user};
    return sweep(*twin(blob), *twin(box), twin_value(displacement), *twin(hit), counts);
}

espalier_query_status espalier_check_sweep_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                                  espalier_vec3 displacement) {
    return static_cast<espalier_query_status>(check_sweep(*twin(blob), *twin(sphere), twin_value(displacement)));
}

espalier_query_status espalier_check_sweep_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                                   espalier_vec3 displacement) {
    return static_cast<espalier_query_status>(check_sweep(*twin(blob), *twin(capsule), twin_value(displacement)));
}

espalier_query_status espalier_check_sweep_box(const espalier_blob* blob, const espalier_box* box,
                                               espalier_vec3 displacement) {
    return static_cast<espalier_query_status>(check_sweep(*twin(blob), *twin(box), twin_value(displacement)));
}

}  // extern "C"
