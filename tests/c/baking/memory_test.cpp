// Claims about c/bake.h: memory that runs out, callbacks, and who owns what.
#include <doctest/doctest.h>

#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "c/baking/given.hpp"
#include "support/base/sanitized.hpp"
#include "support/machine/allocation_counter.hpp"
#include "support/meshes/makers.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

/// Counts blocks, and returns them at addresses that no type but char suits.
struct Allocator {
    std::size_t live = 0, calls = 0, bytes = 0;
    bool is_empty = false, throws = false;
    int* stage = nullptr;

    static void* allocate(std::size_t size, void* user) {
        auto& self = *static_cast<Allocator*>(user);
        ++self.calls;
        if (self.throws) throw std::runtime_error("thrown by a callback");
        if (self.is_empty) return nullptr;
        ++self.live;
        self.bytes += size;
        return static_cast<char*>(std::malloc(size + 1)) + 1;
    }
    static void release(void* memory, std::size_t size, void* user) {
        auto& self = *static_cast<Allocator*>(user);
        --self.live;
        self.bytes -= size;
        std::free(static_cast<char*>(memory) - 1);
    }
    [[nodiscard]] espalier_bake_options options() {
        espalier_bake_options options = default_options_of_c();
        options.allocate = allocate;
        options.release = release;
        options.memory_user = this;
        return options;
    }
};

espalier_visit throw_something(const char*, double, void*) { throw 7; }

espalier_visit count_down(const char*, double, void* left) {
    return --*static_cast<int*>(left) < 0 ? ESPALIER_VISIT_STOP : ESPALIER_VISIT_NEXT;
}

}  // namespace

TEST_CASE("c api: a result is one block of the callbacks and its release gives it back") {
    Allocator allocator;
    const espalier_bake_options options = allocator.options();
    GivenMesh good(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}));
    Mesh broken_mesh = make_cube(-1.0f, 1.0f);
    broken_mesh.triangles[3][0] = 99;
    GivenMesh broken(broken_mesh);
    {
        const BakedFromC baked = bake_from_c(good.view(), options);
        REQUIRE(baked->status == ESPALIER_BAKE_OK);
        CHECK(reinterpret_cast<std::uintptr_t>(baked->bytes) % 64 == 0);
        CHECK(allocator.live == 1);
        CHECK(allocator.bytes < baked->byte_count + 2048);
        const BakedFromC refused = bake_from_c(broken.view(), options);
        CHECK(refused->status == ESPALIER_BAKE_INVALID_MESH);
        CHECK(allocator.live == 2);
    }
    CHECK(allocator.live == 0);
    CHECK(allocator.bytes == 0);
    CHECK(allocator.calls == 2);
}

TEST_CASE("c api: a callback without memory and one that throws give a result without memory") {
    GivenMesh given(make_cube(-1.0f, 1.0f));
    for (const bool throws : {false, true}) {
        Allocator allocator;
        allocator.is_empty = true;
        allocator.throws = throws;
        const BakedFromC none = bake_from_c(given.view(), allocator.options());
        REQUIRE(none->status == ESPALIER_BAKE_NO_MEMORY);
        CHECK(none->bytes == nullptr);
        CHECK(none->report->triangles == 0);
        CHECK(std::string(none->report->collapsed.first).empty());
        CHECK(std::string(none->message).find("memory") != std::string::npos);
        CHECK(allocator.live == 0);
    }
}

TEST_CASE("c api: each allocation of a bake that fails gives a result without memory and leaks no block") {
    Mesh mesh = make_soup(20, 4);
    mesh.materials.assign(20, 3);
    mesh.name = "a name that is longer than what a string holds without the heap";
    GivenMesh given(mesh);
    espalier_bake_options options = default_options_of_c();
    const std::uint64_t stride = sanitized ? 7 : 1;
    std::uint64_t failed = 0;
    for (const bool is_broken : {false, true}) {
        if (is_broken) options.profile = 9;
        const BakedFromC expected = bake_from_c(given.view(), options);
        for (std::uint64_t n = 0;; n += stride) {
            const std::int64_t live = live_allocations();
            bool reached = false;
            espalier_bake_status status = ESPALIER_BAKE_INTERNAL;
            {
                const FailingAllocation failing(n);
                const BakedFromC result = bake_from_c(given.view(), options);
                status = result->status;
                reached = failing.was_reached();
            }
            const std::int64_t left = live_allocations() - live;
            CAPTURE(n);
            REQUIRE(left == 0);
            REQUIRE((status == ESPALIER_BAKE_NO_MEMORY || status == expected->status));
            failed += status == ESPALIER_BAKE_NO_MEMORY ? 1u : 0u;
            if (!reached) break;
        }
    }
    CHECK(failed > (sanitized ? 5 : 20));
}

TEST_CASE("c api: progress stops a bake at each of its calls and what it throws is a status") {
    GivenMesh given(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}));
    espalier_bake_options options = default_options_of_c();
    options.progress = count_down;
    int stops = 0;
    for (int calls = 0;; ++calls) {
        int left = calls;
        options.progress_user = &left;
        const BakedFromC result = bake_from_c(given.view(), options);
        if (result->status == ESPALIER_BAKE_OK) break;
        REQUIRE(result->status == ESPALIER_BAKE_STOPPED);
        REQUIRE(result->bytes == nullptr);
        REQUIRE(std::string(result->message).find("progress") != std::string::npos);
        REQUIRE(left == -1);
        ++stops;
    }
    CHECK(stops > 7);
    options.progress = throw_something;
    CHECK(bake_from_c(given.view(), options)->status == ESPALIER_BAKE_INTERNAL);
}
