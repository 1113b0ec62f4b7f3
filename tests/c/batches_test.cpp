// Tests that no size and no null of c/batches does harm.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstring>
#include <limits>
#include <string>

#include "both.hpp"
#include "fixtures.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr std::size_t huge = std::numeric_limits<std::size_t>::max();

}  // namespace

TEST_CASE("c api: a batch refuses null arrays and sizes that no memory holds and writes nothing") {
    const OpenedBlob opened = blob_with_everything(Profile::fast);
    Both both;
    REQUIRE(both.open(opened.bytes) == OpenStatus::ok);
    Pool& pool = *both.c;
    question asked = {};
    asked.directions[0] = {0.0f, 0.0f, -1.0f};
    // Calls a function of C with arguments of which some are spoiled. Returns whether it refuses them.
    const auto refuses = [&](const Entry& entry, auto spoil) {
        both.prepare(asked, false, false);
        pool.count = 2;
        pool.capacity = 4;
        pool.places = 2;
        pool.null_array = pool.arrays = -1;
        spoil();
        Arguments before;
        std::memcpy(static_cast<void*>(&before), static_cast<Arguments*>(&pool), sizeof before);
        entry.c(pool);
        if (pool.status != ESPALIER_QUERY_INVALID_ARGUMENT) return false;
        CHECK(std::memcmp(&before, static_cast<Arguments*>(&pool), sizeof before) == 0);
        return true;
    };
    const void** const inputs[] = {&pool.strided_vec3[0].first,          &pool.strided_triangle_id[0].first,
                                   &pool.ray_arrays[0].origins.first,    &pool.ray_arrays[0].directions.first,
                                   &pool.ray_arrays[0].t_min.first,      &pool.ray_arrays[0].t_max.first,
                                   &pool.sphere_arrays[0].centers.first, &pool.sphere_arrays[0].radii.first,
                                   &pool.box_arrays[0].min.first,        &pool.box_arrays[0].max.first};
    int batches = 0, without_inputs = 0;
    for (const Entry& entry : entries) {
        const std::string name = entry.name;
        if (!name.ends_with("_arrays")) continue;
        CAPTURE(name);
        ++batches;
        CHECK_FALSE(refuses(entry, [] {}));
        const int outputs = pool.arrays + 1;
        CHECK(outputs > 0);
        for (int output = 0; output < outputs; ++output) CHECK(refuses(entry, [&] { pool.null_array = output; }));
        for (const void** const input : inputs) without_inputs += refuses(entry, [&] { *input = nullptr; }) ? 1 : 0;
        if (outputs == 1) continue;  // rows and lists
        CHECK(refuses(entry, [&] { pool.count = huge; }));
        if (name.starts_with("collect")) {
            CHECK(refuses(entry, [&] { pool.count = 0, pool.null_array = 1; }));  // the first offset
            continue;
        }
        for (const std::size_t places : {huge, huge / 2 + 1}) CHECK(refuses(entry, [&] { pool.places = places; }));
        CHECK_FALSE(refuses(entry, [&] { pool.places = huge, pool.count = 0; }));
    }
    CHECK(batches == 17);
    CHECK(without_inputs == 5 * 2 + 2 * 2 + 2 * 2 + 4 + 4);  // of rays, spheres, boxes, points and triangles
}
