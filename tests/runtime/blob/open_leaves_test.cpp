// Claims about where leaves lie: what open says of one that is misplaced, and that those far back in their block are
// read from there.
#include "support/testing.hpp"

#include "open_blobs.hpp"

namespace espalier::tests::open_leaves_test {
namespace {

using namespace espalier::tests::opening;
/// 16 triangles about two corners of which one is 0 0 0, in a box of 15 steps.
PlainLeaf make_fan(Profile profile) {
    PlainLeaf leaf;
    leaf.vertices = {{15, 15, 15}, {0, 0, 1}, {0, 1, 0}};
    for (std::int32_t i = 3; i < 18; ++i) leaf.vertices.push_back({0, 0, 0});
    if (profile == Profile::fast) {
        for (std::uint8_t i = 0; i < 16; ++i) leaf.triangles.push_back({0, 1, static_cast<std::uint8_t>(2 + i % 2)});
    } else {
        for (unsigned i = 0; i < 18; ++i) leaf.entries.push_back({i, i == 0, i + 2 < 18});
    }
    return leaf;
}

TEST_CASE("open: the highest bit of the offset of a leaf is checked") {
    for_each_profile([](Profile profile) {
        Bytes bytes = bake_or_throw(make_plane_grid(1), with_profile(profile));
        // Of predicted strips it is the number of bytes.
        const unsigned offset_bits = profile == Profile::fast   ? format::plain_leaf::offset_bits
                                     : profile == Profile::tiny ? format::predicted_strip::entries_shift
                                                                : format::strip_leaf::offset_bits;
        const std::size_t descriptor = descriptor_of(bytes, at::bytes, 0);
        const unsigned size = descriptor_bytes_of(bytes);
        put(bytes, descriptor, get(bytes, descriptor, size) | 1u << (offset_bits - 1), size);
        CHECK(status_at_end_of_memory(bytes) == OpenStatus::bad_leaf);
    });
}

TEST_CASE("open: a strip of three entries on one point is refused and one of four is not") {
    for (const Profile profile : {Profile::balanced, Profile::small}) {
        for (const unsigned entries : {3u, 4u}) {
            PlainBlob blob = plain_blob_of(profile, 4);
            PlainLeaf leaf;
            for (unsigned i = 0; i < entries; ++i) {
                leaf.vertices.push_back({2, 3, 4});
                leaf.entries.push_back({i, i == 0, i + 2 < entries});
            }
            blob.nodes.resize(1);
            blob.nodes[0].children = {{{2, 3, 4}, {2, 3, 4}, 0, leaf}};
            CHECK(status_of(encode(blob)) == (entries == 3 ? OpenStatus::bad_leaf : OpenStatus::ok));
        }
    }
}

TEST_CASE("open: a leaf that reaches into the guard is the reason of the refusal") {
    for_each_profile([](Profile profile) {
        PlainBlob blob = plain_blob_of(profile, 4);
        blob.nodes.resize(3);
        for (std::size_t i = 1; i < 3; ++i) {
            blob.nodes[0].children.push_back({{0, 0, 0}, {15, 15, 15}, i, {}});
            blob.nodes[i].children = {{{0, 0, 0}, {15, 15, 15}, 0, make_fan(profile)}};
        }
        const Bytes bytes = encode(blob);
        REQUIRE(status_of(bytes) == OpenStatus::ok);
        // The section ends before the first leaf does, and of the leaf's last words, zeros, the guard has as many
        // as a block's head takes: nothing of it is missing. The second node is broken too.
        const std::uint64_t block = get(bytes, at::leaf_bytes_at, 4) / 2;
        for (const std::size_t missing : {4u, 8u}) {
            Bytes changed = bytes;
            const auto end = changed.begin() + static_cast<std::ptrdiff_t>(leaves_of(bytes));
            changed.erase(end + static_cast<std::ptrdiff_t>(block - missing),
                          end + static_cast<std::ptrdiff_t>(2 * block));
            put(changed, at::leaf_bytes_at, block - missing, 4);
            CHECK(status_resized(changed) == OpenStatus::bad_leaf);
            break_node(changed, node_of(changed, 2));
            CHECK(status_resized(changed) == OpenStatus::bad_leaf);
        }
    });
}

TEST_CASE("open: the last of a node of largest leaves is read at its place") {
    // In profile fast its offset is more than half of the largest one. The fields of a strip are as wide as the
    // lattice, and count from its box's low corner all the same.
    for_each_profile([](Profile profile) {
        constexpr std::int32_t most = (1 << 24) - 1, low = 1 << 17;
        PlainBlob blob = plain_blob_of(profile, 24);
        blob.nodes.resize(1);
        blob.nodes[0].shift = {17, 17, 17};
        const bool is_fast = profile == Profile::fast;
        for (std::int32_t number = 0; number < (is_fast ? 16 : 8); ++number) {
            PlainLeaf leaf;
            const auto add_vertices = [&](std::int32_t count) {
                for (std::int32_t i = 0; i < count; ++i)
                    leaf.vertices.push_back({most - i * i, low + i + 100 * number, low + i % 3 * (most / 4)});
            };
            if (is_fast) {
                add_vertices(32);
                for (std::uint8_t i = 0; i < 16; ++i)
                    leaf.triangles.push_back({i, static_cast<std::uint8_t>(i + 1), static_cast<std::uint8_t>(31 - i)});
            } else {
                const unsigned entries = profile == Profile::balanced ? format::strip_leaf::max_balanced_entries
                                                                      : format::strip_leaf::max_small_entries;
                add_vertices(static_cast<std::int32_t>(entries));
                for (unsigned i = 0; i < entries; ++i) leaf.entries.push_back({i, i == 0, i + 2 < entries});
            }
            const std::uint16_t high = is_fast ? 0xFFFF : 128;
            blob.nodes[0].children.push_back({{1, 1, 1}, {high, high, high}, 0, std::move(leaf)});
        }
        const Bytes bytes = encode(blob);
        if (is_fast) {
            const std::uint64_t last = get(bytes, descriptor_of(bytes, at::bytes, 15), 3);
            REQUIRE((last >> (format::plain_leaf::offset_bits - 1) & 1) != 0);
        }
        check_triangles(blob);
    });
}

TEST_CASE("open: each rule of predicted strips is checked") {
    using namespace format::predicted_strip;
    // Two paths of three triangles over ten vertices, joined at windows 3 and 4.
    PlainBlob blob = plain_blob_of(Profile::tiny, 4);
    PlainLeaf leaf;
    for (unsigned i = 0; i < 10; ++i) {
        const auto x = static_cast<std::int32_t>(i);
        leaf.vertices.push_back({x, x % 2, i == 9 ? 8 : 0});
        leaf.entries.push_back({i, i == 0 || i == 5, i + 2 < 10 && i != 3 && i != 4});
    }
    blob.decoded.vertex_count = 10;
    blob.nodes.resize(1);
    blob.nodes[0].children = {{{0, 0, 0}, {15, 1, 8}, 0, leaf}};
    const Bytes good = encode(blob);
    REQUIRE(status_of(good) == OpenStatus::ok);
    const std::size_t descriptor = descriptor_of(good, at::bytes, 0);
    const std::size_t data = leaf_data_of(good, at::bytes, 0);
    const auto field = [&](const Bytes& bytes, unsigned bit, unsigned width) {
        return static_cast<unsigned>(get(bytes, data + bit / 8, 4) >> bit % 8) & ((1u << width) - 1u);
    };
    const auto with = [&](unsigned bit, unsigned width, unsigned value) {
        return status_with_bits(good, bit, width, value);
    };
    const unsigned joint_at = marks_at + 2 * 7;
    const unsigned predicted = 4, raw = 6, large = field(good, 0, width_bits), small = field(good, width_bits, 5);
    REQUIRE(field(good, joint_at, place_bits) == 3);
    REQUIRE(small < large);
    for (const unsigned window : {0u, 6u, 7u, 63u}) CHECK(with(joint_at, place_bits, window) == OpenStatus::bad_leaf);
    CHECK(with(joints_at, joint_count_bits, 0) == OpenStatus::bad_leaf);  // more predicted vertices, so another size
    CHECK(with(0, width_bits, 7) == OpenStatus::bad_leaf);
    CHECK(with(width_bits, width_bits, large + 1) == OpenStatus::bad_leaf);
    const unsigned numbers_at = choices_at(10, 1, 10) + 3 * predicted;
    CHECK(with(numbers_at + 4, 1, 1) == OpenStatus::bad_leaf);  // y of the first pivot: the third vertex leaves the box
    CHECK(status_with(good, at::extent_at, 8, 4) == OpenStatus::bad_leaf);
    // One more byte, one less, more entries than there may be, and a bit behind the last number.
    const std::uint64_t stated = get(good, descriptor, 2);
    for (const std::uint64_t other : {stated + 1, stated - 1, stated | std::uint64_t{63} << entries_shift})
        CHECK(status_with(good, descriptor, other, 2) == OpenStatus::bad_leaf);
    unsigned end = numbers_at + raw * (4 + 1 + 4);
    for (unsigned axis = 0; axis < 3; ++axis) {
        const unsigned widths[] = {field(good, 10 * axis + 5, 5), field(good, 10 * axis, 5)};
        for (unsigned i = 0; i < predicted; ++i) end += widths[field(good, choices_at(10, 1, 10) + 3 * i + axis, 1)];
    }
    REQUIRE(end % 8 != 0);
    CHECK(with(end, 1, 1) == OpenStatus::bad_leaf);
}

}  // namespace
}  // namespace espalier::tests::open_leaves_test
