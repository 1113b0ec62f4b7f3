// The verifier's rules for the tree: nodes in order, leaves within their blocks. Each, broken alone, is the reason of
// the refusal.
#include "support/testing.hpp"

#include "open_blobs.hpp"

namespace espalier::tests::open_tree_test {
namespace {

using namespace espalier::tests::opening;

/// Makes a leaf one of 56 vertices, all but three of them predicted, whose bytes are those up to the end of the
/// section.
void put_widest_predicted_strip(Bytes& bytes, std::size_t descriptor_at, std::size_t data) {
    constexpr unsigned entries = format::predicted_strip::max_vertices;
    const std::size_t left = leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4) - data;
    put(bytes, descriptor_at, left | (entries - 3) << format::predicted_strip::entries_shift, 2);
    for (unsigned entry = 3; entry < entries; ++entry) {
        const std::size_t bit = format::predicted_strip::marks_at + (entries - 3) + (entry - 3);
        put(bytes, data + bit / 8, get(bytes, data + bit / 8, 1) | 1u << bit % 8, 1);
    }
}

TEST_CASE("open: a node without a parent is refused") {
    for_each_profile([](Profile profile) {
        Bytes bytes = plain_blob(profile);
        const std::size_t end = leaves_of(bytes);
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(end), format::node_bytes(profile), std::byte{});
        put(bytes, at::node_count_at, get(bytes, at::node_count_at, 4) + 1, 4);
        CHECK(status_resized(bytes) == OpenStatus::bad_node);
    });
}

TEST_CASE("open: a node with children behind the last node is refused before they are read") {
    for_each_profile([](Profile profile) {
        // A root with nodes for children, and those with leaves only. One node fewer, and the last becomes leaves.
        unsigned found = 0;
        for (unsigned side = 4; side <= 16; ++side) {
            const Bytes bytes = bake_or_throw(make_plane_grid(side), with_profile(profile));
            const std::uint64_t nodes = get(bytes, at::node_count_at, 4);
            const std::uint64_t of_root = counts_of(bytes, at::bytes).nodes;
            if (of_root == 0 || nodes != 1 + of_root) continue;
            ++found;
            Bytes changed = bytes;
            put(changed, at::node_count_at, nodes - 1, 4);
            put(changed, at::leaf_bytes_at, get(bytes, at::leaf_bytes_at, 4) + format::node_bytes(profile), 4);
            CHECK(status_resized(changed) == OpenStatus::bad_node);
        }
        CHECK(found > 0);
    });
}

TEST_CASE("open: a node without children is refused also without planes") {
    for_each_profile([](Profile profile) {
        Bytes bytes = bake_or_throw(make_plane_grid(1), with_profile(profile));
        put_counts(bytes, at::bytes, {});
        const NodeLayout layout = layout_of(profile);
        for (std::size_t plane = layout.lo_at; plane < layout.hi_at + 3 * layout.row_bytes; ++plane)
            put(bytes, at::bytes + plane, 0, 1);
        CHECK(status_resized(bytes) == OpenStatus::bad_node);
    });
}

TEST_CASE("open: a tree deeper than its header is refused on the way down") {
    for_each_profile([](Profile profile) {
        constexpr std::uint32_t nodes = 100000;  // so many levels are no part of any stack
        Bytes bytes = bake_or_throw(make_plane_grid(1), with_profile(profile));
        bytes.insert(bytes.begin() + at::bytes, nodes * format::node_bytes(profile), std::byte{});
        for (std::uint32_t i = 0; i < nodes; ++i) put_counts(bytes, node_of(bytes, i), {i + 1, 1, 0});
        put(bytes, at::node_count_at, nodes + 1, 4);
        put(bytes, at::depth_at, format::max_depth, 1);
        CHECK(status_resized(bytes) == OpenStatus::bad_node);
    });
}

TEST_CASE("open: a leaf beyond the blob is refused before it is read") {
    for_each_profile([](Profile profile) {
        namespace plain = format::plain_leaf;
        namespace strips = format::strip_leaf;
        const Bytes bytes = bake_or_throw(make_plane_grid(1), {.resolution = Resolution::bits(24), .profile = profile});
        const std::size_t descriptor_at = descriptor_of(bytes, at::bytes, 0);
        const unsigned size = descriptor_bytes_of(bytes);
        const auto descriptor = static_cast<std::uint32_t>(get(bytes, descriptor_at, size));
        const std::size_t data = leaf_data_of(bytes, at::bytes, 0);
        const auto is_refused = [](const Bytes& changed) {
            return status_at_end_of_memory(changed) == OpenStatus::bad_leaf;
        };
        const bool has_strips = profile != Profile::fast;
        if (!has_strips) {  // a corner that is just no vertex
            Bytes changed = bytes;
            put(changed, data + plain::words_at + 6 * 4, 4, 1);
            CHECK(is_refused(changed));
        }
        // Its data far behind the end.
        Bytes elsewhere = bytes;
        put(elsewhere, descriptor_at, descriptor | ((1u << plain::offset_bits) - 1u), size);
        CHECK(is_refused(elsewhere));
        // More data than there is, of the widest vertices, all of them in one corner.
        Bytes longer = bytes;
        for (std::size_t i = data; i < leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4); ++i) put(longer, i, 0, 1);
        if (profile == Profile::tiny) {
            put_widest_predicted_strip(longer, descriptor_at, data);
        } else if (has_strips) {
            put(longer, descriptor_at, std::uint64_t{strips::max_balanced_entries - 3} << strips::entries_shift, 4);
            for (std::size_t i = 0; i < 11; ++i) put(longer, data + i, 0xFF, 1);
            put(longer, data + 11, 0x1F, 1);  // 3 * 31 marks
        } else {
            put(longer, descriptor_at, (descriptor & ~(15u << plain::size_shift)) | 31u << plain::vertices_shift, size);
        }
        CHECK(is_refused(longer));
        // No data at all: in its place is the guard, which would do for a few vertices in one corner.
        Bytes shorter = bytes;
        if (!has_strips) put(shorter, descriptor_at, descriptor & ~(15u << plain::size_shift), size);
        const std::size_t end = leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4);
        // Of a predicted strip two bytes, since a section is whole words.
        const std::size_t kept_end = !has_strips ? data + plain::words_at : profile == Profile::tiny ? data + 2 : data;
        put(shorter, at::leaf_bytes_at, kept_end - leaves_of(bytes), 4);
        if (has_strips) put(shorter, at::triangle_count_at, 1, 4);
        shorter = without(shorter, kept_end, end - kept_end);
        CHECK(status_resized(shorter) == OpenStatus::bad_leaf);
        // More leaves than there are, and the first descriptor states much data.
        put_counts(shorter, at::bytes, {0, 0, 8});
        for (std::size_t axis = 0; axis < 3 && !has_strips; ++axis)
            for (std::size_t leaf = 1; leaf < 8; ++leaf)
                put(shorter, at::bytes + format::plain_node::hi_at + 32 * axis + 2 * leaf,
                    get(shorter, at::bytes + format::plain_node::hi_at + 32 * axis, 2), 2);
        put(shorter, descriptor_at, descriptor | 31u << plain::vertices_shift, size);
        put(shorter, at::total_bytes_at, shorter.size(), 4);
        CHECK((has_strips || is_refused(shorter)));
    });
}

TEST_CASE("open: the last of many leaves beyond the blob is refused before it is read") {
    for_each_profile([](Profile profile) {
        namespace plain = format::plain_leaf;
        namespace strips = format::strip_leaf;
        const Bytes bytes = bake_or_throw(make_icosphere(3, 1.0, {0.0f, 0.0f, 0.0f}),
                                          {.resolution = Resolution::bits(24), .profile = profile});
        std::size_t block = 0, last = 0;  // the block that lies last, and its node
        for (std::size_t node = at::bytes; node < leaves_of(bytes); node += format::node_bytes(profile)) {
            if (counts_of(bytes, node).leaves == 0 || leaf_block_of(bytes, node) < block) continue;
            block = leaf_block_of(bytes, node);
            last = node;
        }
        REQUIRE(block > leaves_of(bytes));
        const std::size_t leaves = counts_of(bytes, last).leaves;
        REQUIRE(leaves > 1);
        const std::size_t descriptor_at = descriptor_of(bytes, last, leaves - 1);
        const unsigned size = descriptor_bytes_of(bytes);
        auto descriptor = static_cast<std::uint32_t>(get(bytes, descriptor_at, size));
        const std::size_t data = leaf_data_of(bytes, last, leaves - 1);
        Bytes longer = bytes;
        const bool has_strips = profile != Profile::fast;
        for (std::size_t i = data; i < leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4); ++i) put(longer, i, 0, 1);
        if (profile == Profile::tiny) {
            put_widest_predicted_strip(longer, descriptor_at, data);
            descriptor = static_cast<std::uint32_t>(get(longer, descriptor_at, 2));
        } else if (has_strips) {
            descriptor &= ~(63u << strips::entries_shift);
            descriptor |= (strips::max_balanced_entries - 3) << strips::entries_shift;
            for (std::size_t i = 0; i < 11; ++i) put(longer, data + i, 0xFF, 1);
            put(longer, data + 11, 0x1F, 1);
        } else {
            descriptor = (descriptor & ~(15u << plain::size_shift)) | 31u << plain::vertices_shift;
        }
        put(longer, descriptor_at, descriptor, size);
        CHECK(status_at_end_of_memory(longer) == OpenStatus::bad_leaf);
    });
}

TEST_CASE("open: bad planes of the first absent child are refused") {
    for_each_profile([](Profile profile) {
        const Bytes bytes = bake_or_throw(make_plane_grid(1), with_profile(profile));  // one leaf
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const NodeLayout layout = layout_of(profile);
            const std::size_t plane = at::bytes + layout.row_bytes * axis + layout.plane_bytes;
            Bytes changed = bytes;
            put(changed, plane + layout.lo_at, 1, 1);
            put(changed, plane + layout.hi_at, 1, 1);
            CHECK(status_resized(changed) == OpenStatus::bad_node);
        }
    });
}

TEST_CASE("open: each rule of plain leaves is enforced in each leaf") {
    namespace leaf = format::plain_leaf;
    for (const unsigned bits : {12u, 20u}) {
        const BakeOptions options = {.resolution = Resolution::bits(bits), .profile = Profile::fast};
        const Bytes bytes = bake_or_throw(make_icosphere(4, 1.0, {0.0f, 0.0f, 0.0f}), options);
        REQUIRE(get(bytes, at::bits_at, 1) == bits);
        std::size_t blocks = 0, without_block = 0, gaps = 0, later = 0;
        for (std::size_t node = at::bytes; node < leaves_of(bytes); node += format::plain_node::bytes) {
            const std::size_t leaves = counts_of(bytes, node).leaves;
            if (leaves == 0) {  // then it has no block either
                CHECK(status_with(bytes, node + format::plain_node::leaf_block_at, 1, 4) == OpenStatus::bad_node);
                ++without_block;
                continue;
            }
            if (++blocks % 8 != 0 && !takes_every_case()) continue;
            for (std::size_t number = 0; number < leaves; ++number) {
                const std::size_t descriptor_at = descriptor_of(bytes, node, number);
                const auto descriptor = static_cast<std::uint32_t>(get(bytes, descriptor_at, 3));
                const std::size_t vertices = (descriptor >> leaf::vertices_shift & 31u) + 1;
                const std::size_t slots = (descriptor >> leaf::triangles_shift & 15u) + 1;
                const std::size_t begin = leaf_data_of(bytes, node, number);
                for (const unsigned shift : {0u, leaf::size_shift}) {
                    CHECK(status_with(bytes, descriptor_at, descriptor + (1u << shift), 3) == OpenStatus::bad_leaf);
                    CHECK(status_with(bytes, descriptor_at, descriptor - (1u << shift), 3) == OpenStatus::bad_leaf);
                }
                const std::uint64_t first = get(bytes, begin + leaf::first_at, 4);
                CHECK(status_with(bytes, begin + leaf::first_at, first + 1, 4) == OpenStatus::bad_leaf);
                CHECK(status_with(bytes, begin + leaf::first_at, first - 1, 4) == OpenStatus::bad_leaf);
                if (number != 0) ++later;
                const std::size_t corners = begin + leaf::words_at + 6 * vertices;
                for (const std::size_t corner : {std::size_t{0}, slots - 1, 3 * slots - 1})
                    CHECK(status_with(bytes, corners + corner, vertices, 1) == OpenStatus::bad_leaf);
                const std::size_t leaf_end = corners + 3 * slots + (bits > 16 ? 3 * vertices : 0);
                const std::size_t padding = (4 - (leaf_end - begin) % 4) % 4;  // to the next leaf or the end
                gaps += padding;
                for (std::size_t i = 0; i < padding; ++i)
                    CHECK(status_with(bytes, leaf_end + i, 1, 1) == OpenStatus::bad_leaf);
            }
        }
        CHECK(blocks > 4);
        CHECK(without_block > 0);
        CHECK(later > 4);
        CHECK(gaps > 4);
    }
}

TEST_CASE("open: a plain leaf wholly beyond the extent is refused in each bit") {
    namespace leaf = format::plain_leaf;
    for (const unsigned bits : {7u, 16u, 17u, 24u}) {
        const BakeOptions options = {.resolution = Resolution::bits(bits), .profile = Profile::fast};
        const Bytes bytes = bake_or_throw(make_plane_grid(1), options);  // 4 vertices whose z is 0, 2 triangles
        REQUIRE(get(bytes, at::bits_at, 1) == bits);
        REQUIRE(get(bytes, at::extent_at + 8, 4) == 0);
        const std::size_t data = leaf_data_of(bytes, at::bytes, 0) + leaf::words_at;
        const std::size_t bytes_above = data + 6 * 4 + 3 * 2;
        for (unsigned bit = 0; bit < (bits > 16 ? 24u : 16u); ++bit) {
            Bytes moved = bytes;
            for (std::size_t vertex = 0; vertex < 4; ++vertex) {
                if (bit < 16) put(moved, data + 2 * (8 + vertex), 1u << bit, 2);
                else put(moved, bytes_above + 8 + vertex, 1u << (bit - 16), 1);
            }
            CHECK(status_resized(moved) == OpenStatus::bad_leaf);
            put(moved, at::extent_at + 8, 1u << bit, 4);
            CHECK(status_resized(moved) == (bit < bits ? OpenStatus::ok : OpenStatus::bad_header));
        }
    }
}

}  // namespace
}  // namespace espalier::tests::open_tree_test
