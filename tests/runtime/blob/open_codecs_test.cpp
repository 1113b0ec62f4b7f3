// The verifier's rules for nodes, leaves, edge flags and bounds.
#include "support/testing.hpp"

#include "support/exercise/exercise.hpp"
#include "support/machine/exact_buffer.hpp"
#include "support/meshes/strip_shapes.hpp"

namespace espalier::tests::open_codecs_test {
namespace {

Mesh first_triangle_of_a_cube() {
    Mesh mesh = make_cube(0.0f, 1.0f);
    mesh.triangles.resize(1);
    return mesh;
}

TEST_CASE("open: each rule of edge flags and bounds is enforced and any flags are safe") {
    for_each_profile([](Profile profile) {
        const BakeOptions options = {.profile = profile, .flat_angle = 5.0, .bounds = {true, true, true}};
        const Bytes bytes = bake_or_throw(first_triangle_of_a_cube(), options);
        REQUIRE(status_of(bytes) == OpenStatus::ok);
        // From the end: 80 bytes of 26-DOP, 16 of sphere, 32 of oriented box, 8 of edge flags.
        const std::size_t box = bytes.size() - format::bounds::bytes(format::feature::bounds);
        const std::size_t flags = box - 8;
        const auto is_bad = [&](std::size_t at, std::int64_t value, unsigned size) {
            return status_with(bytes, at, static_cast<std::uint64_t>(value), size) == OpenStatus::bad_section;
        };
        const auto is_good = [&](std::size_t at, std::int64_t value, unsigned size) {
            return status_with(bytes, at, static_cast<std::uint64_t>(value), size) == OpenStatus::ok;
        };
        CHECK(is_good(flags, 1 << 24, 4));
        CHECK(is_bad(flags, (1 << 24) + 1, 4));
        for (std::int64_t any = 0; any < 64; ++any) CHECK(is_good(flags + 4, any, 4));
        CHECK(is_bad(flags + 4, 64, 4));
        CHECK(is_bad(flags + 4, 1 << 30, 4));
        CHECK(is_good(box, 2047, 2));
        CHECK(is_good(box, -2047, 2));
        CHECK(is_bad(box, 2048, 2));
        CHECK(is_bad(box + 6, -2048, 2));
        CHECK(is_bad(box, 0, 8));  // no rotation
        for (std::size_t at = box + 8; at < bytes.size(); at += 4) {
            CHECK(is_good(at, 1 << 29, 4));
            CHECK(is_good(at, -(1 << 29), 4));
            CHECK(is_bad(at, (1 << 29) + 1, 4));
            CHECK(is_bad(at, -(1 << 29) - 1, 4));
        }
        // Sections that the features do not tell of, or the other way round.
        const std::uint64_t features = get(bytes, format::header::features_at, 4);
        for (unsigned bit = 5; bit <= 8; ++bit)
            CHECK(status_with(bytes, format::header::features_at, features ^ 1u << bit, 4) == OpenStatus::bad_section);
        // An empty blob carries none.
        const Bytes empty = bake_or_throw({}, with_profile(profile));
        for (unsigned bit = 5; bit <= 8; ++bit)
            CHECK(status_with(empty, format::header::features_at, 1u << bit, 4) == OpenStatus::bad_header);
    });
}

TEST_CASE("open: false edge flags and bounds leave queries safe") {
    Random random(77);
    for_each_profile([&](Profile profile) {
        const BakeOptions options = {.profile = profile, .flat_angle = 5.0, .bounds = {true, true, true}};
        const Bytes good = bake_or_throw(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), options);
        unsigned opened = 0;
        for (std::uint64_t i = 0; i < scaled_share(3'000); ++i) {
            Bytes bad = good;
            for (unsigned changes = 1 + random.below(4); changes != 0; --changes)
                bad[good.size() - 1 - random.below(128 + 240)] = static_cast<std::byte>(random.next());
            repair_checksum(bad);
            const ExactBuffer buffer(bad);
            const Blob blob = open(buffer.bytes());
            if (!blob) continue;
            ++opened;
            Random same(i);
            exercise(blob, same, 2);
        }
        CHECK(opened > 0);
    });
}

TEST_CASE("open: each rule of packed nodes is enforced") {
    namespace node = format::packed_node;
    constexpr std::size_t root = format::header::bytes;
    for (const Profile profile : {Profile::balanced, Profile::small}) {
        CAPTURE(name_of(profile));
        const Bytes bytes = bake_or_throw(make_plane_grid(1), with_profile(profile));  // one node with one leaf
        REQUIRE(status_of(bytes) == OpenStatus::ok);
        const auto is_refused = [&](std::size_t at, std::uint64_t value, unsigned size) {
            return status_with(bytes, root + at, value, size) == OpenStatus::bad_node;
        };
        CHECK(is_refused(node::children_at, 1u << 28 | 1u, 4));             // a first child
        CHECK(is_refused(node::children_at, 1u << 28 | 1u << 24 | 1u, 4));  // no such
        CHECK(is_refused(node::children_at, 0, 4));                         // no child at all
        CHECK(is_refused(node::children_at, 9u << 28, 4));                  // nine leaves
        CHECK(is_refused(node::leaf_block_at, 1, 4));                       // not the next block
        CHECK(is_refused(node::lo_at + 1, 1, 1));                           // an unused plane
        CHECK(is_refused(node::hi_at + 7, 1, 1));
        CHECK(is_refused(node::lo_at, 255, 1));  // above the high plane
        CHECK(is_refused(node::shifts_at, node::max_shift + 1, 2));
        CHECK(is_refused(node::shifts_at + 1, 0x80, 1));
    }
}

TEST_CASE("open: each rule of plain nodes is enforced") {
    namespace node = format::plain_node;
    constexpr std::size_t root = format::header::bytes;
    for (const unsigned bits : {12u, 20u}) {
        CAPTURE(bits);
        const BakeOptions options = {.resolution = Resolution::bits(bits), .profile = Profile::fast};
        const Bytes bytes = bake_or_throw(make_plane_grid(1), options);  // one node with one leaf
        REQUIRE(status_of(bytes) == OpenStatus::ok);
        REQUIRE(get(bytes, format::header::bits_at, 1) == bits);
        const auto is_refused = [&](std::size_t at, std::uint64_t value, unsigned size) {
            return status_with(bytes, root + at, value, size) == OpenStatus::bad_node;
        };
        CHECK(is_refused(node::children_at, 1, 4));              // a first child
        CHECK(is_refused(node::children_at, 1u << 24, 4));       // no such
        CHECK(is_refused(node::children_at, 1u << 24 | 1u, 4));  // no such
        CHECK(is_refused(node::children_at + 3, 255, 1));        // 256 children
        CHECK(is_refused(node::children_at + 3, 16, 1));         // 17
        CHECK(is_refused(node::leaf_children_at, 0, 1));         // no child at all
        CHECK(is_refused(node::leaf_children_at, 17, 1));        // 17 leaves
        CHECK(is_refused(node::leaf_children_at, 255, 1));
        CHECK(is_refused(node::leaf_block_at, 1, 4));  // not the next block
        for (std::size_t axis = 0; axis < 3; ++axis) {
            CAPTURE(axis);
            const std::size_t low_at = node::lo_at + node::row_bytes * axis;
            const std::size_t high_at = node::hi_at + node::row_bytes * axis;
            const std::uint64_t extent = get(bytes, format::header::extent_at + 4 * axis, 4);
            const std::uint64_t most = extent >> format::unit_shift(bits);
            REQUIRE(get(bytes, root + low_at, 2) == 0);
            REQUIRE(get(bytes, root + high_at, 2) == most);
            CHECK(is_refused(high_at, most + 1, 2));  // beyond the extent
            CHECK(is_refused(high_at, 0xFFFF, 2));
            CHECK(is_refused(low_at, most + 1, 2));  // above the high plane
            CHECK(status_with(bytes, root + low_at, most, 2) == OpenStatus::ok);
            for (std::size_t child = 1; child < node::max_children; ++child) {  // unused planes
                CHECK(is_refused(low_at + 2 * child, 1, 2));
                CHECK(is_refused(high_at + 2 * child, 1, 2));
                CHECK(is_refused(high_at + 2 * child, 0x100, 2));
            }
        }
        for (std::size_t at = node::reserved_at; at < node::bytes; ++at) CHECK(is_refused(at, 1, 1));
        for (std::size_t leaf = 1; leaf < node::max_children; ++leaf)  // a descriptor of no leaf
            for (unsigned bit = 0; bit < 24; ++bit)
                CHECK(status_with(bytes, root + node::leaves_at + 3 * leaf, 1u << bit, 3) == OpenStatus::bad_leaf);
    }
}

TEST_CASE("open: each rule of plain leaves is enforced") {
    // Two triangles over four vertices: one node with one leaf.
    const Bytes bytes = bake_or_throw(make_plane_grid(1), with_profile(Profile::fast));
    REQUIRE(status_of(bytes) == OpenStatus::ok);
    namespace leaf = format::plain_leaf;
    constexpr std::size_t block = format::header::bytes + format::plain_node::bytes;
    constexpr std::size_t descriptor_at = format::header::bytes + format::plain_node::leaves_at;
    const auto descriptor = static_cast<std::uint32_t>(get(bytes, descriptor_at, 3));
    REQUIRE((descriptor >> leaf::triangles_shift & 15u) == 1);
    REQUIRE((descriptor >> leaf::vertices_shift & 31u) == 3);
    CHECK(status_with(bytes, descriptor_at, descriptor, 3) == OpenStatus::ok);
    CHECK(status_with(bytes, descriptor_at, descriptor + 1, 3) == OpenStatus::bad_leaf);  // data somewhere else
    CHECK(status_with(bytes, descriptor_at, descriptor + (1u << leaf::triangles_shift), 3) == OpenStatus::bad_leaf);
    CHECK(status_with(bytes, descriptor_at, descriptor - (1u << leaf::triangles_shift), 3) == OpenStatus::bad_leaf);
    CHECK(status_with(bytes, descriptor_at, descriptor | 31u << leaf::vertices_shift, 3) == OpenStatus::bad_leaf);
    for (std::uint32_t size = 0; size < 16; ++size) {
        const std::uint32_t others = descriptor & ~(15u << leaf::size_shift);
        const bool is_right = others + (size << leaf::size_shift) == descriptor;
        CHECK(status_with(bytes, descriptor_at, others | size << leaf::size_shift, 3) ==
              (is_right ? OpenStatus::ok : OpenStatus::bad_leaf));
    }
    for (const std::uint32_t first : {1u, 2u, 1u << 31})  // another first triangle
        CHECK(status_with(bytes, block + leaf::first_at, first, 4) == OpenStatus::bad_leaf);

    constexpr std::size_t corners_at = block + leaf::words_at + 4 * 6;
    for (std::size_t corner = 0; corner < 6; ++corner) {
        CHECK(status_with(bytes, corners_at + corner, 3, 1) == OpenStatus::ok);  // another mesh, no harm
        for (const unsigned no_vertex : {4u, 32u, 255u})
            CHECK(status_with(bytes, corners_at + corner, no_vertex, 1) == OpenStatus::bad_leaf);
    }
    CHECK(status_with(bytes, corners_at + 6, 1, 1) == OpenStatus::bad_leaf);  // padding
    const std::uint64_t extent = get(bytes, format::header::extent_at, 4);
    Bytes smaller = bytes;  // so that its box ends in the asset and a vertex does not
    put(smaller, format::header::bytes + format::plain_node::hi_at, extent - 1, 2);
    CHECK(status_with(smaller, format::header::extent_at, extent - 1, 4) == OpenStatus::bad_leaf);
}

TEST_CASE("open: each rule of strip leaves is enforced") {
    namespace leaf = format::strip_leaf;
    constexpr std::size_t block = format::header::bytes + format::packed_node::bytes;
    constexpr std::size_t descriptor_at = block + leaf::descriptors_at;
    constexpr std::size_t marks_at = descriptor_at + leaf::descriptor_bytes;
    // Two tetrahedra, each a path of 4 triangles over 4 vertices: one node with one leaf of 12 entries.
    Mesh mesh = {
        .positions = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}, {50, 0, 0}, {59, 0, 0}, {50, 9, 0}, {50, 0, 9}},
        .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {4, 6, 5}, {4, 5, 7}, {4, 7, 6}, {5, 6, 7}}};
    for (const Profile profile : {Profile::balanced, Profile::small}) {
        CAPTURE(name_of(profile));
        const Bytes bytes = bake_or_throw(mesh, {.profile = profile, .build = {.byte_price = 1000.0f}});
        REQUIRE(status_of(bytes) == OpenStatus::ok);
        REQUIRE(get(bytes, format::header::node_count_at, 4) == 1);
        REQUIRE(get(bytes, format::packed_node::children_at + format::header::bytes, 4) == 1u << 28);
        const auto descriptor = static_cast<std::uint32_t>(get(bytes, descriptor_at, 4));
        REQUIRE((descriptor >> leaf::entries_shift & 63u) == 12 - 3);
        const auto with_descriptor = [&](std::uint32_t changed) {
            return status_with(bytes, descriptor_at, changed, 4);
        };
        CHECK(with_descriptor(descriptor) == OpenStatus::ok);
        CHECK(with_descriptor(descriptor + 1) == OpenStatus::bad_leaf);  // data somewhere else
        CHECK(with_descriptor(descriptor | 1u << (leaf::offset_bits - 1)) == OpenStatus::bad_leaf);
        CHECK(with_descriptor(descriptor + (1u << leaf::first_shift)) ==
              OpenStatus::bad_leaf);  // another first triangle
        for (unsigned bit = leaf::first_shift + 9; bit < 32; ++bit)
            CHECK(with_descriptor(descriptor | 1u << bit) == OpenStatus::bad_leaf);
        for (std::uint32_t entries = 3; entries < 3 + 64; ++entries) {
            const std::uint32_t others = descriptor & ~(63u << leaf::entries_shift);
            const OpenStatus status = with_descriptor(others | (entries - 3) << leaf::entries_shift);
            CHECK(status == (entries == 12 ? OpenStatus::ok : OpenStatus::bad_leaf));
        }

        // 9 marks of pivots, 9 of windows, 9 of first uses, and 4 references of 3 bits: 39 bits.
        const std::uint64_t marks = get(bytes, marks_at, 8);
        const auto with_marks = [&](std::uint64_t changed) { return status_with(bytes, marks_at, changed, 8); };
        const auto bit = [](unsigned place) { return std::uint64_t{1} << place; };
        const std::uint64_t first_uses = marks >> 18 & 511u;
        REQUIRE(first_uses == 0b001111001);  // entries 4 and 5 are references, and the last two
        CHECK(with_marks(marks) == OpenStatus::ok);
        CHECK(with_marks(marks | bit(39)) == OpenStatus::bad_leaf);     // padding
        CHECK(with_marks(marks ^ bit(9)) == OpenStatus::bad_leaf);      // a triangle less
        CHECK(with_marks(marks ^ bit(9 + 3)) == OpenStatus::bad_leaf);  // a triangle more: the joint's
        CHECK(with_marks(marks ^ bit(18)) == OpenStatus::bad_leaf);     // a vertex less
        CHECK(with_marks(marks ^ bit(19)) == OpenStatus::bad_leaf);     // a vertex more
        CHECK(with_marks(marks ^ bit(0)) == OpenStatus::ok);            // another pivot: another mesh, no harm
        const auto with_reference = [&](unsigned number, std::uint64_t vertex) {
            return with_marks((marks & ~(std::uint64_t{7} << (27 + 3 * number))) | vertex << (27 + 3 * number));
        };
        for (std::uint64_t vertex = 0; vertex < 8; ++vertex) {
            CHECK(with_reference(0, vertex) ==
                  (vertex < 4 ? OpenStatus::ok : OpenStatus::bad_leaf));  // 4 vertices so far
            CHECK(with_reference(1, vertex) == (vertex < 4 ? OpenStatus::ok : OpenStatus::bad_leaf));
            CHECK(with_reference(2, vertex) == OpenStatus::ok);
            CHECK(with_reference(3, vertex) == OpenStatus::ok);
        }
        for (unsigned axis = 0; axis < 3; ++axis) {
            const std::size_t extent_at = format::header::extent_at + 4 * axis;
            CHECK(status_with(bytes, extent_at, get(bytes, extent_at, 4) - 1, 4) == OpenStatus::bad_leaf);
        }
        // The leaf section is cut short below its data, whatever the header makes of it.
        const std::uint64_t leaf_bytes = get(bytes, format::header::leaf_bytes_at, 4);
        for (std::uint64_t fewer = 4; fewer <= leaf_bytes; fewer += 4) {
            Bytes shorter = bytes;
            const auto end = shorter.begin() + static_cast<std::ptrdiff_t>(block + leaf_bytes);
            shorter.erase(end - static_cast<std::ptrdiff_t>(fewer), end);
            put(shorter, format::header::leaf_bytes_at, leaf_bytes - fewer, 4);
            CHECK(status_with(shorter, format::header::total_bytes_at, shorter.size(), 4) != OpenStatus::ok);
        }
        const std::uint64_t other = profile == Profile::small ? 1 : 2;
        CHECK(status_with(bytes, format::header::profile_at, other, 1) == OpenStatus::ok);
        CHECK(status_with(bytes, format::header::profile_at, 0, 1) == OpenStatus::bad_section);  // other nodes
    }
}

TEST_CASE("open: a strip leaf may be as long as its profile allows and no longer") {
    const BakeOptions options = {.profile = Profile::small, .build = {.byte_price = 1000.0f}};
    const Bytes fits = bake_or_throw(make_fan(format::strip_leaf::max_balanced_entries - 2, false), options);
    const Bytes too_long = bake_or_throw(make_fan(format::strip_leaf::max_balanced_entries - 1, false), options);
    for (const Bytes* bytes : {&fits, &too_long}) {
        REQUIRE(status_of(*bytes) == OpenStatus::ok);
        REQUIRE(get(*bytes, format::header::bytes + format::packed_node::children_at, 4) == 1u << 28);  // one leaf
        CHECK(status_with(*bytes, format::header::profile_at, 1, 1) ==
              (bytes == &fits ? OpenStatus::ok : OpenStatus::bad_leaf));
    }
}

}  // namespace
}  // namespace espalier::tests::open_codecs_test
