// Memory that runs out in the middle of a bake.
#include "support/testing.hpp"

#include <new>

#include "baking_support.hpp"
#include "support/base/sanitized.hpp"
#include "support/machine/allocation_counter.hpp"

namespace espalier::tests::allocation_test {
namespace {

/// Makes each allocation of a bake fail in turn, but for every `stride`-th alone. What comes out is std::bad_alloc, and
/// no block is left behind; or, where the baker could do without (a thread that did not start), the blob as ever.
std::uint64_t fail_each_allocation(const Mesh& mesh, const BakeOptions& options, std::uint64_t stride) {
    const auto bake_once = [&] { return bake_mesh(mesh, options); };
    const std::vector<std::byte> expected = [&] {
        auto baked = bake_once();
        REQUIRE(baked);
        return std::move(baked.bytes);
    }();
    std::uint64_t thrown = 0;
    for (std::uint64_t n = 0;; n += stride) {
        const std::int64_t live = live_allocations();
        bool failed = false, reached = false, same = false;
        std::int64_t left = 0;
        {
            const FailingAllocation failing(n);
            try {
                const auto baked = bake_once();
                same = baked && baked.bytes == expected;
            } catch (const std::bad_alloc&) {
                failed = true;
            }
            reached = failing.was_reached();
            left = live_allocations() - live;
        }
        CAPTURE(n);
        REQUIRE((failed || same));
        REQUIRE(left == 0);
        thrown += failed ? 1 : 0;
        if (!reached) return thrown;
    }
}

TEST_CASE("baker: an allocation that fails raises bad_alloc and leaks no block") {
    Mesh mesh = make_soup(20, 4);
    mesh.materials.assign(20, 3);
    BakeOptions options = {.threads = 1};
    const std::uint64_t stride = sanitized || !takes_every_case() ? 7 : 1;
    for (const Builder builder : {Builder::binned_sah, Builder::sweep_sah, Builder::agglomerative, Builder::linear,
                                  Builder::insertion, Builder::spatial_splits}) {
        options.build.builder = builder;
        CHECK(fail_each_allocation(mesh, with_profile(Profile::fast, options), stride) > 30 / stride);
    }
    options = {};
    options.threads = 1;
    for_each_profile([&](Profile profile) {
        CHECK(fail_each_allocation(mesh, with_profile(profile, options), stride) > 30 / stride);
    });
    options.original_ids = true;
    options.flat_angle = 5.0;
    options.bounds = {true, true, true};
    CHECK(fail_each_allocation(first_triangles(mesh, 6), options, stride) > 30 / stride);
    options = {};
    options.threads = 1;
    options.resolution = Resolution::tolerance(0.001);
    CHECK(fail_each_allocation(make_icosphere(0, 1.0, {}), options, stride) > 30 / stride);
}

TEST_CASE("baker: an allocation that fails in a thread of the baker raises in the calling thread") {
    const Mesh mesh = make_terrain(60, 2);  // 7,200 triangles: enough for two threads
    for (const Builder builder : {Builder::binned_sah, Builder::sweep_sah, Builder::agglomerative, Builder::linear}) {
        const BakeOptions options = {.threads = 2, .build = {.builder = builder}};
        // Which allocation is the n-th differs from run to run: that each is met is a matter of many runs.
        const std::uint64_t before = allocation_count();
        REQUIRE(bake_mesh(mesh, options));
        const std::uint64_t allocations = allocation_count() - before;
        CHECK(fail_each_allocation(mesh, options, allocations / (sanitized || !takes_every_case() ? 10 : 40) + 1) > 2);
    }
}

}  // namespace
}  // namespace espalier::tests::allocation_test
