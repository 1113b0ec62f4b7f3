// The verifier's rules for the header and for what it counts: each, broken alone, is the reason of the refusal.
// open_tree_test.cpp, open_codecs_test.cpp and open_sections_test.cpp have the others.
#include "support/testing.hpp"

#include "open_blobs.hpp"

namespace espalier::tests::open_rules_test {
namespace {

using namespace espalier::tests::opening;

TEST_CASE("open: each rule of the header is enforced") {
    for_each_profile([](Profile profile) {
        const Bytes bytes = plain_blob(profile);
        REQUIRE(status_of(bytes) == OpenStatus::ok);
        const std::uint64_t features = get(bytes, at::features_at, 4);
        const auto refused = [&](std::size_t field, std::uint64_t value, unsigned size) {
            return status_with(bytes, field, value, size) == OpenStatus::bad_header;
        };
        CHECK(refused(at::triangle_count_at, std::uint64_t{format::max_triangles} + 1, 4));
        CHECK(refused(at::node_count_at, std::uint64_t{format::max_nodes} + 1, 4));
        CHECK_FALSE(refused(at::triangle_count_at, format::max_triangles, 4));  // wrong, but not for the header
        CHECK_FALSE(refused(at::node_count_at, format::max_nodes, 4));
        CHECK(refused(at::triangle_count_at, 0, 4));  // no triangles, and all the rest
        CHECK(refused(at::node_count_at, 0, 4));
        CHECK(refused(at::leaf_bytes_at, 0, 4));
        CHECK(refused(at::vertex_count_at, 0, 4));
        CHECK(refused(at::depth_at, 0, 1));
        CHECK(refused(at::leaf_bytes_at, get(bytes, at::leaf_bytes_at, 4) + 2, 4));  // no whole words
        CHECK(refused(at::features_at, features | feature::materials_8 | feature::materials_16, 4));
        CHECK((refused(at::features_at, features | feature::split_references, 4) || profile == Profile::fast));
        CHECK(refused(at::max_error_at, 0x7F800000u, 4));
        CHECK_FALSE(refused(at::max_error_at, 0x7F7FFFFFu, 4));
        CHECK(refused(at::id_kind_bits_at, 1, 1));  // ids that are not there
        CHECK(refused(at::source_count_at, 1, 4));
        CHECK(refused(at::id_step_bytes_at, 1, 4));
        CHECK(refused(at::id_kind_bits_at + 1, 1, 1));
        CHECK(refused(at::id_kind_bits_at + 2, 1, 1));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            CHECK(refused(at::origin_at + 4 * axis, 0x00000001u, 4));  // a subnormal number
            CHECK(refused(at::origin_at + 4 * axis, 0x80000000u, 4));  // -0
            CHECK(refused(at::origin_at + 4 * axis, 0x7F800000u, 4));
            CHECK(refused(at::extent_at + 4 * axis, std::uint64_t{1} << get(bytes, at::bits_at, 1), 4));
        }
        Bytes at_zero = bytes;
        put(at_zero, at::origin_at, 0, 4);
        put(at_zero, at::origin_at + 4, 0, 4);
        put(at_zero, at::origin_at + 8, 0, 4);
        CHECK(status_with(three_sources(profile), at::id_kind_bits_at, 8, 1) == OpenStatus::bad_header);
        const auto with_step = [&](int exponent) {
            return status_with(at_zero, at::step_exponent_at, static_cast<std::uint16_t>(exponent), 2);
        };
        CHECK(with_step(format::min_step_exponent) == OpenStatus::ok);
        CHECK(with_step(format::min_step_exponent - 1) == OpenStatus::bad_header);
        CHECK(with_step(format::max_step_exponent) == OpenStatus::ok);
        CHECK(with_step(format::max_step_exponent + 1) == OpenStatus::bad_header);
        // An origin of 1.5 steps, of 3 and of 2^24 + 2: the last is the step's multiple in its last place.
        const int step = static_cast<std::int16_t>(get(bytes, at::step_exponent_at, 2));
        for (const auto& [steps, expected] :
             {std::pair(1.5f, OpenStatus::bad_header), std::pair(3.0f, OpenStatus::ok),
              std::pair(0x1p-1f, OpenStatus::bad_header), std::pair(-0x1.8p0f, OpenStatus::bad_header),
              std::pair(-8388609.0f, OpenStatus::ok), std::pair(-4194304.5f, OpenStatus::bad_header),
              std::pair(0x1p24f + 2.0f, OpenStatus::ok)}) {
            const auto origin = std::bit_cast<std::uint32_t>(std::ldexp(steps, step));
            CHECK(status_with(at_zero, at::origin_at + 4, origin, 4) == expected);
        }

        const Bytes empty = bake_or_throw(Mesh{}, with_profile(profile));
        REQUIRE(status_of(empty) == OpenStatus::ok);
        for (const std::size_t field :
             {at::triangle_count_at, at::node_count_at, at::leaf_bytes_at, at::vertex_count_at}) {
            CHECK(status_with(empty, field, 4, 4) == OpenStatus::bad_header);
        }
        CHECK(status_with(empty, at::depth_at, 1, 1) == OpenStatus::bad_header);
        CHECK(status_with(empty, at::bits_at, 0, 1) == OpenStatus::bad_header);
        CHECK(status_with(empty, at::features_at, feature::closed, 4) == OpenStatus::bad_header);
    });
}

TEST_CASE("open: a vertex just outside the extent is refused along each axis") {
    for_each_profile([](Profile profile) {
        const Bytes bytes = plain_blob(profile);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t extent_at = at::extent_at + 4 * axis;
            const std::uint64_t extent = get(bytes, extent_at, 4);
            CHECK(status_with(bytes, extent_at, extent - 1, 4) ==
                  (profile == Profile::fast ? OpenStatus::bad_node : OpenStatus::bad_leaf));
        }
    });
}

TEST_CASE("open: more triangles than in the header are refused at their leaves") {
    for_each_profile([](Profile profile) {
        Bytes bytes = plain_blob(profile);
        put_counts(bytes, leaves_of(bytes) - format::node_bytes(profile), {});  // behind them
        CHECK(status_resized(bytes) == OpenStatus::bad_node);
        put(bytes, at::triangle_count_at, 1, 4);
        CHECK(status_resized(bytes) == OpenStatus::bad_leaf);
    });
}

TEST_CASE("open: each part that ends too early is refused") {
    for_each_profile([](Profile profile) {
        for (const std::uint32_t material : {7u, 700u}) {  // in 8 and in 16 bits
            Mesh mesh = make_cube(0.0f, 1.0f);
            mesh.materials.assign(mesh.triangles.size(), material);
            const BakeOptions options = {.profile = profile, .flat_angle = 5.0, .bounds = {true, true, true}};
            const Bytes bytes = bake_or_throw(mesh, options);
            REQUIRE(status_of(bytes) == OpenStatus::ok);
            for (std::size_t end = at::bytes; end < bytes.size(); end += 4)
                CHECK(status_resized(without(bytes, end, bytes.size() - end)) == OpenStatus::bad_section);
        }
    });
}

TEST_CASE("open: an empty map of copies is refused") {
    Bytes bytes = plain_blob(Profile::fast);
    const std::uint32_t triangles = static_cast<std::uint32_t>(get(bytes, at::triangle_count_at, 4));
    const std::size_t section = bytes.size();
    bytes.resize(section + format::copies::blocks_at + format::copies::blocks_bytes(triangles));
    put(bytes, at::features_at, get(bytes, at::features_at, 4) | feature::split_references, 4);
    CHECK(status_resized(bytes) == OpenStatus::bad_section);
    // With one it is a blob: the last triangle as a copy of the first.
    put(bytes, section, 1, 4);
    const std::size_t block = bytes.size() - format::copies::block_bytes;
    const unsigned last = (triangles - 1) % format::copies::block_indices;
    put(bytes, block + format::copies::bits_at + last / 8, 1u << last % 8, 1);
    bytes.resize(bytes.size() + format::copies::owner_bytes);
    CHECK(status_resized(bytes) == OpenStatus::ok);
}

}  // namespace
}  // namespace espalier::tests::open_rules_test
