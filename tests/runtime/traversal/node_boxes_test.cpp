// Claims about the tests of a node's children at their borders: what just touches is let through, what is just beyond
// is not.
#include "support/testing.hpp"

#include <type_traits>

#include <runtime/traversal/box_nodes.hpp>

namespace espalier::tests::node_boxes_test {
namespace {

/// A node with one leaf in a box of planes a step apart; what lies behind it is zero.
template <class NodeKind>
struct OneChild {
    using Node = NodeKind;
    std::array<std::byte, Node::size + 16> bytes{};
    Node node{bytes.data()};

    OneChild(std::array<unsigned, 3> low, std::array<unsigned, 3> high) {
        constexpr bool is_packed = std::is_same_v<Node, detail::PackedNode>;
        if constexpr (is_packed) bytes[Node::children_at + 3] = std::byte{0x10};
        else bytes[format::plain_node::leaf_children_at] = std::byte{1};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t low_at =
                is_packed ? format::packed_node::lo_at + 8 * k : format::plain_node::lo_at + 32 * k;
            const std::size_t high_at =
                is_packed ? format::packed_node::hi_at + 8 * k : format::plain_node::hi_at + 32 * k;
            bytes[low_at] = static_cast<std::byte>(low[k]);
            bytes[high_at] = static_cast<std::byte>(high[k]);
            if constexpr (!is_packed) {
                bytes[low_at + 1] = static_cast<std::byte>(low[k] >> 8);
                bytes[high_at + 1] = static_cast<std::byte>(high[k] >> 8);
            }
        }
    }
    OneChild(const OneChild&) = delete;
    OneChild& operator=(const OneChild&) = delete;
    ~OneChild() = default;
};
/// Calls with each kind of node.
template <class Call>
void for_each_kind(Call call) {
    call.template operator()<OneChild<detail::PackedNode>>();
    call.template operator()<OneChild<detail::PlainNode>>();
}

constexpr unsigned bits = 16;

TEST_CASE("kernel: a box that touches a half-space overlaps it and is inside up to its last step") {
    for_each_kind([]<class Child>() {
        const Child child({10, 20, 30}, {11, 22, 33});
        for (int k = 0; k < 3; ++k) {
            const std::int64_t low = 10 * (k + 1), high = 11 * (k + 1);
            detail::LatticePlane plane{{0, 0, 0}, low};
            plane.normal[k] = 1;
            CHECK(detail::children_behind(child.node, bits, plane, 1) == 1);
            plane.offset = low - 1;
            CHECK(detail::children_behind(child.node, bits, plane, 1) == 0);
            plane.offset = high;
            CHECK(detail::is_wholly_behind(child.node, bits, 0, plane));
            plane.offset = high - 1;
            CHECK_FALSE(detail::is_wholly_behind(child.node, bits, 0, plane));
            plane.normal[k] = -1;
            plane.offset = -high;
            CHECK(detail::children_behind(child.node, bits, plane, 1) == 1);
            plane.offset = -high - 1;
            CHECK(detail::children_behind(child.node, bits, plane, 1) == 0);
            plane.offset = -low;
            CHECK(detail::is_wholly_behind(child.node, bits, 0, plane));
            plane.offset = -low - 1;
            CHECK_FALSE(detail::is_wholly_behind(child.node, bits, 0, plane));
        }
    });
}

TEST_CASE("kernel: a box at the last plane overlaps and one beyond does not") {
    for_each_kind([]<class Child>() {
        constexpr std::int32_t plane = Child::Node::max_children == 8 ? 255 : 65535;  // the last
        constexpr auto byte_or_word = static_cast<unsigned>(plane);
        const Child last({byte_or_word, byte_or_word, byte_or_word}, {byte_or_word, byte_or_word, byte_or_word});
        CHECK(detail::children_within(last.node, bits, {{plane, plane, plane}, {plane, plane, plane}}) == 1);
        CHECK(detail::children_within(last.node, bits,
                                      {{plane - 1, plane - 1, plane - 1}, {plane - 1, plane - 1, plane - 1}}) == 0);
        const Child all({0, 0, 0}, {byte_or_word, byte_or_word, byte_or_word});
        for (int k = 0; k < 3; ++k) {
            detail::IntegerBounds bounds{{5, 5, 5}, {5, 5, 5}};
            CHECK(detail::children_within(all.node, bits, bounds) == 1);
            for (const std::int32_t beyond : {plane + 1, plane + 45, plane + 257, 2 * plane + 2, -1, -300}) {
                bounds.low[k] = bounds.high[k] = beyond;
                CHECK(detail::children_within(all.node, bits, bounds) == 0);
            }
        }
    });
}

TEST_CASE("kernel: a box is small exactly up to its longest side") {
    for_each_kind([]<class Child>() {
        const Child point({7, 8, 9}, {7, 8, 9});
        CHECK(detail::children_no_larger(point.node, 0, bits) == 1);
        CHECK(detail::children_no_larger(point.node, -1, bits) == 0);
        const Child child({10, 20, 30}, {11, 22, 33});
        CHECK(detail::children_no_larger(child.node, 3, bits) == 1);
        CHECK(detail::children_no_larger(child.node, 2, bits) == 0);
        CHECK(detail::children_no_larger(child.node, 1 << 20, bits) == 1);
    });
}

}  // namespace
}  // namespace espalier::tests::node_boxes_test
