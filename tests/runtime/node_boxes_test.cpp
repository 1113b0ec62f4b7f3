// Claims about the tests of a node's children at their borders: what just touches is let through, what is just beyond
// is not.
#include <doctest/doctest.h>

#include <array>
#include <cstddef>

#include <runtime/box_nodes.hpp>
#include <runtime/plane_nodes.hpp>

using namespace espalier;

namespace {

/// A node with one leaf in a box of planes a step apart; what lies behind it is zero.
struct OneChild {
    std::array<std::byte, 80> bytes{};
    detail::Node node{bytes.data()};

    OneChild(std::array<unsigned, 3> low, std::array<unsigned, 3> high) {
        bytes[format::node::children_at + 3] = std::byte{0x10};
        for (std::size_t k = 0; k < 3; ++k) {
            bytes[format::node::lo_at + 8 * k] = static_cast<std::byte>(low[k]);
            bytes[format::node::hi_at + 8 * k] = static_cast<std::byte>(high[k]);
        }
    }
    OneChild(const OneChild&) = delete;
    OneChild& operator=(const OneChild&) = delete;
    ~OneChild() = default;
};

constexpr unsigned bits = 16;

}  // namespace

TEST_SUITE("node boxes") {
    TEST_CASE("kernel: a box that touches a half-space overlaps it and is inside up to its last step") {
        const OneChild child({10, 20, 30}, {11, 22, 33});
        for (int k = 0; k < 3; ++k) {
            const std::int64_t low = 10 * (k + 1), high = 11 * (k + 1);
            detail::LatticePlane plane{{0, 0, 0}, low};
            plane.normal[k] = 1;
            CHECK(detail::children_behind(child.node, bits, plane, 1) == 1);
            plane.offset = low - 1;
            CHECK(detail::children_behind(child.node, bits, plane, 1) == 0);
            plane.offset = high + 5;
            CHECK(detail::is_wholly_behind(child.node, bits, 0, plane, 5));
            CHECK_FALSE(detail::is_wholly_behind(child.node, bits, 0, plane, 6));
            plane.normal[k] = -1;
            plane.offset = -high;
            CHECK(detail::children_behind(child.node, bits, plane, 1) == 1);
            plane.offset = -high - 1;
            CHECK(detail::children_behind(child.node, bits, plane, 1) == 0);
            plane.offset = -low + 5;
            CHECK(detail::is_wholly_behind(child.node, bits, 0, plane, 5));
            CHECK_FALSE(detail::is_wholly_behind(child.node, bits, 0, plane, 6));
        }
    }

    TEST_CASE("kernel: a box at the last plane overlaps and one beyond does not") {
        const OneChild last({255, 255, 255}, {255, 255, 255});
        CHECK(detail::children_within(last.node, bits, {{255, 255, 255}, {255, 255, 255}}) == 1);
        CHECK(detail::children_within(last.node, bits, {{254, 254, 254}, {254, 254, 254}}) == 0);
        const OneChild all({0, 0, 0}, {255, 255, 255});
        for (int k = 0; k < 3; ++k) {
            detail::IntegerBounds bounds{{5, 5, 5}, {5, 5, 5}};
            CHECK(detail::children_within(all.node, bits, bounds) == 1);
            for (const std::int32_t beyond : {256, 300, 512, -1, -300}) {
                bounds.low[k] = bounds.high[k] = beyond;
                CHECK(detail::children_within(all.node, bits, bounds) == 0);
            }
        }
    }

    TEST_CASE("kernel: a box is small exactly up to its longest side") {
        const OneChild point({7, 8, 9}, {7, 8, 9});
        CHECK(detail::children_no_larger(point.node, 0) == 1);
        CHECK(detail::children_no_larger(point.node, -1) == 0);
        const OneChild child({10, 20, 30}, {11, 22, 33});
        CHECK(detail::children_no_larger(child.node, 3) == 1);
        CHECK(detail::children_no_larger(child.node, 2) == 0);
        CHECK(detail::children_no_larger(child.node, 1 << 20) == 1);
    }
}
