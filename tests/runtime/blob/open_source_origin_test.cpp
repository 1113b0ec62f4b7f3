// The section of the origin: the rules of `open`, and what it returns of sound ones.
#include "support/testing.hpp"

#include "open_blobs.hpp"

namespace espalier::tests::open_source_origin_test {
namespace {

using namespace espalier::tests::opening;

Bytes with_origin(BakeOptions options) {
    options.origin = Vec3d{1e6, -2.5, 0x1.fffffffffffffp-3};
    Mesh mesh = make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f});
    for (Vec3& position : mesh.positions) position.x += 1e6f;
    return bake_or_throw(mesh, options);
}

TEST_CASE("open: a blob keeps the origin of its source whatever other sections it has") {
    for (const Profile profile : every_profile) {
        BakeOptions options = {.profile = profile};
        const Blob plain = open(bake_or_throw(make_cube(0.0f, 1.0f), options));
        CHECK(plain.source_origin() == Vec3d{});
        for (const bool is_rich : {false, true}) {
            if (is_rich) {
                options.original_ids = true;
                options.flat_angle = 5.0;
                options.bounds = {true, true, true};
            }
            const Bytes bytes = with_origin(options);
            const Blob blob = open(bytes);
            REQUIRE(blob);
            CHECK(blob.source_origin() == Vec3d{1e6, -2.5, 0x1.fffffffffffffp-3});
            CHECK(open_unchecked(bytes).source_origin() == blob.source_origin());
            CHECK(get(bytes, at::version_minor_at, 2) == 2);
        }
    }
    BakeOptions deformable = {.profile = Profile::fast};
    deformable.deformation = Deformation{};
    CHECK(open(with_origin(deformable)).source_origin().y == -2.5);
    CHECK(Blob().source_origin() == Vec3d{});
}

TEST_CASE("open: each rule of the origin of the source is enforced") {
    const Bytes good = with_origin({.profile = Profile::balanced});
    const auto status_with_number = [&](std::size_t coordinate, std::uint64_t bits) {
        Bytes bytes = good;
        put(bytes, bytes.size() - 24 + 8 * coordinate, bits, 8);
        return status_at_end_of_memory(bytes);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(status_with_number(k, 0) == OpenStatus::ok);
        CHECK(status_with_number(k, 0x7FEFFFFFFFFFFFFFu) == OpenStatus::ok);
        CHECK(status_with_number(k, 0x7FF0000000000000u) == OpenStatus::bad_section);
        CHECK(status_with_number(k, 0xFFF0000000000000u) == OpenStatus::bad_section);
        CHECK(status_with_number(k, 0x7FF8000000000001u) == OpenStatus::bad_section);
    }
    Bytes old = good;
    put(old, at::version_minor_at, 1, 2);
    CHECK(status_at_end_of_memory(old) == OpenStatus::bad_header);
    Bytes without_feature = good;
    put(without_feature, at::features_at, get(good, at::features_at, 4) & ~std::uint64_t{feature::source_origin}, 4);
    CHECK(status_at_end_of_memory(without_feature) == OpenStatus::bad_section);
    Bytes shorter = without(good, good.size() - 4, 4);
    put(shorter, at::total_bytes_at, shorter.size(), 4);
    CHECK(status_at_end_of_memory(shorter) == OpenStatus::bad_section);
}

}  // namespace
}  // namespace espalier::tests::open_source_origin_test
