// espalier/c/original.h: from triangles and hits back to the source.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

espalier_original_triangle_result espalier_original_triangle_of(const espalier_blob* blob,
                                                                espalier_triangle_id triangle) {
    return c(original_triangle(cpp(blob), cpp(triangle)));
}

espalier_filled espalier_original_triangle_of_batch(const espalier_blob* blob, const espalier_triangle_id* triangles,
                                                    espalier_original_triangle_result* originals, size_t count) {
    return c(original_triangle(cpp(blob), cpp(triangles, count), cpp(originals, count)));
}

espalier_original_hit espalier_original_hit_of(const espalier_blob* blob, const espalier_ray_hit* hit) {
    return c(original_hit(cpp(blob), cpp(hit)));
}

espalier_filled espalier_original_hit_of_batch(const espalier_blob* blob, const espalier_ray_hit* hits,
                                               espalier_original_hit* originals, size_t count) {
    return c(original_hit(cpp(blob), cpp(hits, count), cpp(originals, count)));
}

espalier_original_hit espalier_original_hit_by_remap(const espalier_original_triangle* remap, size_t triangles,
                                                     const espalier_ray_hit* hit) {
    return c(original_hit(cpp(remap, triangles), cpp(hit)));
}

espalier_open_status espalier_read_remap(const void* file, size_t size, const espalier_blob* blob,
                                         espalier_original_triangle* remap, size_t triangles) {
    return c(read_remap(cpp(file, size), cpp(blob), cpp(remap, triangles)));
}
