#include "pair_loop.hpp"

#include <algorithm>
#include <cmath>

namespace espalier::tests {

template <class Place>
std::vector<PairLoop::Placed> PairLoop::placed(const DecodedBlob& blob, Place place) {
    std::vector<Placed> result;
    for (std::uint32_t i = 0; i < blob.triangles.size(); ++i) {
        if (blob.owners[i] != i) continue;
        const GridTriangle& t = blob.triangles[i];
        Placed p = {i,
                    place(detail::LatticeTriangle{
                        {{t.a[0], t.a[1], t.a[2]}, {t.b[0], t.b[1], t.b[2]}, {t.c[0], t.c[1], t.c[2]}}}),
                    {},
                    {}};
        for (int k = 0; k < 3; ++k) {
            const auto& c = p.triangle.corner;
            p.low[k] = std::min({c[0][k], c[1][k], c[2][k]});
            p.high[k] = std::max({c[0][k], c[1][k], c[2][k]});
        }
        result.push_back(p);
    }
    return result;
}

PairLoop::PairLoop(const detail::PairFrame& frame, const DecodedBlob& a, const DecodedBlob& b)
    : a_(placed(a, [&](const detail::LatticeTriangle& t) { return frame.place_a(t); })),
      b_(placed(b, [&](const detail::LatticeTriangle& t) { return frame.place_b(t); })) {}

double PairLoop::gap(const Placed& a, const Placed& b) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double gap = std::max({0, a.low[k] - b.high[k], b.low[k] - a.high[k]});
        sum += gap * gap;
    }
    return sum;
}

std::vector<TrianglePair> PairLoop::every_contact() const {
    std::vector<TrianglePair> found;
    for (const Placed& a : a_)
        for (const Placed& b : b_)
            if (gap(a, b) == 0.0 &&
                detail::triangles_meet(detail::integer_triangle(a.triangle), detail::integer_triangle(b.triangle)))
                found.push_back({{a.index}, {b.index}});
    return found;
}

std::optional<detail::FoundTriangles> PairLoop::nearest_pair(float radius) const {
    // Corners bound the distance from above, boxes from below: pairs that are clearly farther need no kernel.
    double bound = static_cast<double>(radius) * static_cast<double>(radius);
    for (const Placed& a : a_)
        for (const Placed& b : b_) {
            double squared = 0.0;
            for (int k = 0; k < 3; ++k) {
                const double apart = a.triangle.corner[0][k] - b.triangle.corner[0][k];
                squared += apart * apart;
            }
            bound = std::min(bound, squared);
        }
    std::optional<detail::FoundTriangles> best;
    for (const Placed& a : a_)
        for (const Placed& b : b_) {
            if (gap(a, b) > bound * 1.00001) continue;
            const detail::TriangleDistance distance = detail::distance_between(a.triangle, b.triangle);
            if (!detail::is_within_radius(a.triangle, b.triangle, distance, radius)) continue;
            if (best && !(distance.squared < best->distance.squared)) continue;
            best = {distance, a.triangle, b.triangle, {{a.index}, {b.index}}};
            bound = std::min(bound, static_cast<double>(distance.squared));
        }
    return best;
}

bool PairLoop::is_any_within(float radius) const {
    const double bound = static_cast<double>(radius) * static_cast<double>(radius) * 1.00001;
    for (const Placed& a : a_)
        for (const Placed& b : b_)
            if (gap(a, b) <= bound &&
                detail::is_within_radius(a.triangle, b.triangle, detail::distance_between(a.triangle, b.triangle),
                                         radius))
                return true;
    return false;
}

}  // namespace espalier::tests
