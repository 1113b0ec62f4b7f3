// Claims about the float bounds of distances for walks without lanes: they are never above the exact distance, and
// mostly close to it.
#include "support/testing.hpp"

#include <runtime/kernels/segment_triangle.hpp>
#include <runtime/proximity/triangle_gap.hpp>

namespace espalier::tests::triangle_gap_test {
namespace {

using detail::Integer3;
using detail::LatticeTriangle;

/// Triangles of a lattice, and points beside them.
class Cases {
public:
    explicit Cases(unsigned bits) : bits_(bits), random_(bits) {}

    LatticeTriangle triangle() {
        size_ = 1 + random_.below(bits_);
        const Integer3 low = some_point(0, std::int64_t{1} << bits_);
        Integer3 corner[3];
        for (Integer3& c : corner) c = low + some_point(-(std::int64_t{1} << size_) / 2, std::int64_t{1} << size_);
        const auto kind = random_.below(8);
        if (kind == 0)
            for (Integer3& c : corner) c.z = corner[0].z;
        else if (kind == 1) corner[2] = corner[1];
        else if (kind == 2) corner[2] = corner[1] + some_point(-1, 3);
        else if (kind == 3) corner[1] = corner[2] = corner[0];
        LatticeTriangle triangle;
        const std::int64_t most = (std::int64_t{1} << bits_) - 1;
        for (unsigned i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                triangle.corner[i][k] = static_cast<std::int32_t>(std::clamp<std::int64_t>(corner[i][k], 0, most));
        at_ = detail::corner_on_grid(triangle, static_cast<int>(random_.below(3)), fraction_bits());
        return triangle;
    }
    /// From on the triangle to many times its size away, in units that floats hold exactly.
    Integer3 point() {
        const auto reach = static_cast<int>(random_.below(size_ + 4)) + fraction_bits();
        const Integer3 point = at_ + some_point(-(std::int64_t{1} << reach), std::int64_t{2} << reach);
        const std::int64_t most = (std::int64_t{1} << 24) - 1;
        const auto clamp = [&](std::int64_t x) { return std::clamp<std::int64_t>(x, -most, most); };
        return {clamp(point.x), clamp(point.y), clamp(point.z)};
    }
    [[nodiscard]] int fraction_bits() const { return bits_ > 17 ? 0 : std::min(6, 23 - static_cast<int>(bits_)); }

private:
    Integer3 some_point(std::int64_t low, std::int64_t count) {
        const auto some = [&] {
            return low + static_cast<std::int64_t>(random_.next() % static_cast<std::uint64_t>(count));
        };
        const std::int64_t x = some(), y = some();
        return {x, y, some()};
    }

    unsigned bits_;
    Random random_;
    unsigned size_ = 1;
    Integer3 at_{};
};

struct Steps {
    float at[3];
    Steps(const Integer3& p, int fraction_bits) {
        for (int k = 0; k < 3; ++k) at[k] = static_cast<float>(p[k]) * detail::power_of_two(-fraction_bits);
    }
};

struct Outcome {
    std::uint64_t apart = 0, close = 0, wrong = 0;

    void add(float bound, float squared) {
        wrong += bound <= squared * detail::distance_slack ? 0u : 1u;
        apart += squared > 0.0f ? 1u : 0u;
        close += squared > 0.0f && bound > 0.98f * squared ? 1u : 0u;
    }
};

TEST_CASE("kernel: bounds of the gap to a triangle are never above the exact distance and mostly close to it") {
    Outcome points, segments;
    const std::uint64_t count = scaled(200'000);
    for (const unsigned bits : {8u, 16u, 20u}) {
        Cases cases(bits);
        const int f = cases.fraction_bits();
        for (std::uint64_t i = 0; i < count; ++i) {
            const LatticeTriangle triangle = cases.triangle();
            const Integer3 from = cases.point(), to = i % 16 == 0 ? from : cases.point();
            const Steps start(from, f), end(to, f);
            float reach = 0.0f;
            for (int k = 0; k < 3; ++k) {
                float farthest = 0.0f;
                for (const auto& corner : triangle.corner)
                    farthest = std::max(std::abs(static_cast<float>(corner[k]) - start.at[k]), farthest);
                reach += farthest;
            }
            points.add(detail::squared_gap_to_point(triangle, start.at, reach),
                       detail::distance_to(detail::relative_to(from, f, triangle), f).squared);
            segments.add(detail::squared_gap_to_segment(triangle, start.at, end.at, reach),
                         detail::distance_to({from, to, f}, triangle).squared);
        }
    }
    for (const Outcome& outcome : {points, segments}) {
        MESSAGE(outcome.apart, " apart, ", outcome.close, " close");
        CHECK(outcome.wrong == 0);
    }
    if (!asks_enough()) return;
    CHECK(points.close > points.apart - points.apart / 10);
    CHECK(segments.close > segments.apart / 2);
}

}  // namespace
}  // namespace espalier::tests::triangle_gap_test
