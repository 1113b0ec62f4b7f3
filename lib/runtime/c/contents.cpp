// espalier/c/bounds.h, original.h and walk.h: what a blob contains, as a whole and triangle by triangle.
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

ESPALIER_C_FUNCTION(espalier_oriented_bounds, (blob), c(oriented_bounds(cpp(blob))))

espalier_k_dop_result espalier_k_dop_bounds(const espalier_blob* blob) { return c(k_dop_bounds(cpp(blob))); }

ESPALIER_C_FUNCTION(espalier_original_triangle_of, (blob, triangle), c(original_triangle(cpp(blob), cpp(triangle))))

ESPALIER_C_FUNCTION(espalier_original_triangle_of_batch, (blob, triangles, originals, count),
                    c(original_triangle(cpp(blob), cpp(triangles, count), cpp(originals, count))))

ESPALIER_C_FUNCTION(espalier_original_hit_of, (blob, hit), c(original_hit(cpp(blob), cpp(hit))))

ESPALIER_C_FUNCTION(espalier_original_hit_of_batch, (blob, hits, originals, count),
                    c(original_hit(cpp(blob), cpp(hits, count), cpp(originals, count))))

ESPALIER_C_FUNCTION(espalier_original_hit_by_remap, (remap, triangles, hit),
                    c(original_hit(cpp(remap, triangles), cpp(hit))))

ESPALIER_C_FUNCTION(espalier_read_remap, (file, size, blob, remap, triangles),
                    c(read_remap(cpp(file, size), cpp(blob), cpp(remap, triangles))))

ESPALIER_C_VISITING(espalier_for_each_triangle, (blob, visit, user),
                    c(for_each_triangle(cpp(blob), visitor(visit, user))))

ESPALIER_C_FUNCTION(espalier_triangle_at, (blob, triangle), c(triangle_at(cpp(blob), cpp(triangle))))

ESPALIER_C_VISITING(espalier_for_each_node, (blob, visit, user),
                    c(for_each_node(cpp(blob), visitor<espalier::NodeVisit>(visit, user))))
