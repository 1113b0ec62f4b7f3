// Claims about Hilbert's curve.
#include "support/testing.hpp"

#include <cstdlib>

#include <runtime/moving_scenes/box_tree/hilbert.hpp>

namespace espalier::tests::hilbert_test {
namespace {

using namespace espalier::detail;

TEST_CASE("scene: the curve through a cube passes each point once and steps to a neighbour") {
    constexpr unsigned bits = 4, side = 1u << bits;
    struct Point {
        int x = -1, y = 0, z = 0;
    };
    std::vector<Point> along(side * side * side);
    for (unsigned x = 0; x < side; ++x)
        for (unsigned y = 0; y < side; ++y)
            for (unsigned z = 0; z < side; ++z) {
                const std::uint32_t key = hilbert_key(x, y, z, bits);
                REQUIRE(key < along.size());
                REQUIRE(along[key].x == -1);
                along[key] = {static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
            }
    for (std::size_t i = 1; i < along.size(); ++i) {
        const Point &a = along[i - 1], &b = along[i];
        REQUIRE(std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z) == 1);
    }
}

}  // namespace
}  // namespace espalier::tests::hilbert_test
