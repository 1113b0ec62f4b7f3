// espalier.h: from triangles and hits back to the source.
#include <runtime/c/twins.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

bool espalier_get_original_triangle(const espalier_blob* blob, espalier_triangle triangle,
                                    espalier_original_triangle* original) {
    return original_triangle(*twin(blob), {triangle}, *twin(original));
}

espalier_query_status espalier_get_original_triangle_batch(const espalier_blob* blob,
                                                           const espalier_triangle* triangles,
                                                           espalier_original_triangle* originals, size_t count) {
    return static_cast<espalier_query_status>(
        original_triangle(*twin(blob), twins(triangles, count), twins(originals, count)));
}

espalier_original_hit espalier_get_original_hit(const espalier_blob* blob, const espalier_ray_hit* hit) {
    return twin_value(original_hit(*twin(blob), *twin(hit)));
}

espalier_query_status espalier_get_original_hit_batch(const espalier_blob* blob, const espalier_ray_hit* hits,
                                                      espalier_original_hit* originals, size_t count) {
    return static_cast<espalier_query_status>(original_hit(*twin(blob), twins(hits, count), twins(originals, count)));
}

espalier_original_hit espalier_get_original_hit_by_remap(const espalier_original_triangle* remap, size_t triangles,
                                                         const espalier_ray_hit* hit) {
    return twin_value(original_hit(twins(remap, triangles), *twin(hit)));
}

espalier_status espalier_read_remap(const void* file, size_t size, const espalier_blob* blob,
                                    espalier_original_triangle* remap, size_t triangles) {
    return static_cast<espalier_status>(
        read_remap({static_cast<const std::byte*>(file), size}, *twin(blob), twins(remap, triangles)));
}

}  // extern "C"
