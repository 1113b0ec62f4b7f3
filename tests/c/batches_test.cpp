// Tests that no size and no null of c/batches does harm.
#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <c99.h>

#include "c/fixtures.hpp"
#include "support/base/profiles.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr std::size_t huge = std::numeric_limits<std::size_t>::max();

bool is_refused_as_invalid(const espalier_filled& filled) {
    return filled.status == ESPALIER_QUERY_INVALID_ARGUMENT && filled.count == 0;
}
bool is_refused_as_invalid(const espalier_filled_lists& filled) {
    return filled.status == ESPALIER_QUERY_INVALID_ARGUMENT && filled.count == 0 && filled.lists == 0;
}

}  // namespace

TEST_SUITE("batches") {
    TEST_CASE("c api: a batch refuses null arrays and sizes that no memory holds and writes nothing") {
        const OpenedBlob opened = blob_with_everything(Profile::fast);
        espalier_blob blob;
        REQUIRE(c99_open(opened.bytes.data(), opened.bytes.size(), &blob) == ESPALIER_OPEN_OK);
        const std::array<espalier_vec3, 2> vectors = {{{0, 0, 9}, {0, 0, -1}}};
        const espalier_strided_vec3 points = {vectors.data(), 0}, no_points = {nullptr, 12};
        const espalier_strided_float no_numbers = {nullptr, 4}, numbers = {vectors.data(), 0};
        const espalier_strided_triangle_id no_ids = {nullptr, 4}, ids = {vectors.data(), 0};
        const espalier_ray_arrays rays = {points, points, no_numbers, no_numbers, 0};
        const espalier_ray_arrays without_origins = {no_points, points, numbers, numbers, 0};
        const espalier_ray_arrays without_directions = {points, no_points, numbers, numbers, 0};
        const espalier_sphere_arrays spheres = {points, numbers}, no_centers = {no_points, numbers},
                                     no_radii = {points, no_numbers};
        const espalier_box_arrays boxes = {points, points}, no_min = {no_points, points}, no_max = {points, no_points};
        std::array<espalier_ray_hit, 4> hits = {};
        std::array<espalier_closest_point_result, 4> nearest = {};
        std::array<espalier_yes_no, 2> answers = {};
        std::array<espalier_filled, 2> found = {};
        std::array<espalier_query_status, 2> statuses = {};
        std::array<std::size_t, 3> offsets = {};
        std::array<espalier_triangle_id, 4> triangles = {};
        std::array<espalier_original_triangle_result, 2> originals = {};
        std::array<espalier_triangle_result, 2> corners = {};
        std::array<std::uint16_t, 2> materials = {};
        const auto untouched = [&] {
            return hits[0].status == 0 && nearest[0].status == 0 && answers[0].status == 0 && found[0].count == 0 &&
                   statuses[0] == 0 && offsets[2] == 0 && triangles[0] == 0 && originals[0].status == 0 &&
                   corners[0].status == 0 && materials[0] == 0;
        };
#define REFUSED(call)                                  \
    CHECK_MESSAGE(is_refused_as_invalid(call), #call); \
    CHECK(untouched())
        std::memset(hits.data(), 0, sizeof hits);
        for (const auto* broken : {&without_origins, &without_directions}) {
            REFUSED(c99_raycast_arrays(&blob, broken, hits.data(), 2));
            REFUSED(c99_occluded_arrays(&blob, broken, answers.data(), 2));
            REFUSED(c99_closest_hits_arrays(&blob, broken, hits.data(), 2, found.data(), 2));
            REFUSED(c99_collect_hits_arrays(&blob, broken, statuses.data(), offsets.data(), 2, hits.data(), 4));
            REFUSED(c99_collect_crossings_arrays(&blob, broken, statuses.data(), offsets.data(), 2, hits.data(), 4));
        }
        REFUSED(c99_raycast_arrays(&blob, &rays, nullptr, 2));
        REFUSED(c99_occluded_arrays(&blob, &rays, nullptr, 2));
        REFUSED(c99_closest_hits_arrays(&blob, &rays, nullptr, 2, found.data(), 2));
        REFUSED(c99_closest_hits_arrays(&blob, &rays, hits.data(), 2, nullptr, 2));
        REFUSED(c99_closest_hits_arrays(&blob, &rays, hits.data(), huge, found.data(), 2));
        REFUSED(c99_closest_hits_arrays(&blob, &rays, hits.data(), huge / 2 + 1, found.data(), 2));
        REFUSED(c99_closest_hits_arrays(&blob, &rays, hits.data(), 2, found.data(), huge));
        REFUSED(c99_collect_hits_arrays(&blob, &rays, nullptr, offsets.data(), 2, hits.data(), 4));
        REFUSED(c99_collect_hits_arrays(&blob, &rays, statuses.data(), nullptr, 2, hits.data(), 4));
        REFUSED(c99_collect_hits_arrays(&blob, &rays, statuses.data(), nullptr, 0, hits.data(), 4));
        REFUSED(c99_collect_hits_arrays(&blob, &rays, statuses.data(), offsets.data(), 2, nullptr, 4));
        REFUSED(c99_collect_hits_arrays(&blob, &rays, statuses.data(), offsets.data(), huge, hits.data(), 4));
        REFUSED(c99_closest_point_arrays(&blob, no_points, nearest.data(), 2, 1.0f));
        REFUSED(c99_closest_point_arrays(&blob, points, nullptr, 2, 1.0f));
        REFUSED(c99_signed_distance_arrays(&blob, no_points, nearest.data(), 2, 1.0f));
        REFUSED(c99_contains_arrays(&blob, no_points, answers.data(), 2));
        REFUSED(c99_contains_arrays(&blob, points, nullptr, 2));
        REFUSED(c99_closest_triangles_arrays(&blob, no_points, nearest.data(), 2, found.data(), 2, 1.0f));
        REFUSED(c99_closest_triangles_arrays(&blob, points, nearest.data(), huge, found.data(), 2, 1.0f));
        REFUSED(c99_overlaps_sphere_arrays(&blob, &no_centers, answers.data(), 2));
        REFUSED(c99_overlaps_sphere_arrays(&blob, &no_radii, answers.data(), 2));
        REFUSED(c99_overlaps_box_arrays(&blob, &no_min, answers.data(), 2));
        REFUSED(c99_overlaps_box_arrays(&blob, &no_max, answers.data(), 2));
        REFUSED(c99_collect_overlaps_sphere_arrays(&blob, &no_radii, statuses.data(), offsets.data(), 2,
                                                   triangles.data(), 4));
        REFUSED(
            c99_collect_overlaps_box_arrays(&blob, &no_max, statuses.data(), offsets.data(), 2, triangles.data(), 4));
        REFUSED(c99_collect_overlaps_box_arrays(&blob, &boxes, statuses.data(), offsets.data(), 2, nullptr, 4));
        REFUSED(c99_original_triangle_of_arrays(&blob, no_ids, originals.data(), 2));
        REFUSED(c99_material_arrays(&blob, no_ids, materials.data(), 2));
        REFUSED(c99_material_arrays(&blob, ids, nullptr, 2));
        REFUSED(c99_triangle_at_arrays(&blob, no_ids, corners.data(), 2));
#undef REFUSED
        // Batches of no queries need no arrays, but for the first offset.
        CHECK(c99_raycast_arrays(&blob, &without_origins, nullptr, 0).status == ESPALIER_QUERY_OK);
        CHECK(c99_closest_hits_arrays(&blob, &without_origins, nullptr, huge, nullptr, 0).status == ESPALIER_QUERY_OK);
        CHECK(c99_contains_arrays(&blob, no_points, nullptr, 0).status == ESPALIER_QUERY_OK);
        offsets[0] = 7;
        CHECK(c99_collect_overlaps_sphere_arrays(&blob, &no_centers, nullptr, offsets.data(), 0, nullptr, 0).status ==
              ESPALIER_QUERY_OK);
        CHECK(offsets[0] == 0);
        // No places hold no elements, and each query has its status.
        CHECK(c99_closest_hits_arrays(&blob, &rays, nullptr, 0, found.data(), 2).count == 2);
        CHECK(found[1].count == 0);
        CHECK(c99_collect_overlaps_sphere_arrays(&blob, &spheres, statuses.data(), offsets.data(), 2, nullptr, 0)
                  .status == ESPALIER_QUERY_OK);
    }
}
