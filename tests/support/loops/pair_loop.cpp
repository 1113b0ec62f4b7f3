#include "pair_loop.hpp"

#include <algorithm>
#include <tuple>

namespace espalier::tests {

namespace {

/// Of squared distances: what the kernels say in float is within a millionth.
constexpr double relative_slack = 1.0 + 1e-5;
constexpr double search_slack = 1.0 + 2e-5;

}  // namespace

PairLoop::PairLoop(const detail::PairFrame& frame, const TriangleGroups& a, const TriangleGroups& b, LeftOut left_out)
    : left_out_(left_out), a_(a, frame, PlacedGroups::Side::a), b_(b, frame, PlacedGroups::Side::b) {}

std::vector<PairLoop::Near> PairLoop::near_blocks(double limit) const {
    std::vector<Near> near;
    for (std::size_t i = 0; i < a_.blocks().size(); ++i)
        for (std::size_t j = 0; j < b_.blocks().size(); ++j) {
            const double gap = squared_gap(a_.blocks()[i], b_.blocks()[j]);
            if (!is_clear(gap, limit)) near.push_back({gap, i, j});
        }
    std::sort(near.begin(), near.end(), [](const Near& x, const Near& y) { return x.squared_gap < y.squared_gap; });
    return near;
}

void PairLoop::append_near(const Near& blocks, double limit, std::vector<Near>& groups) const {
    const std::vector<PlacedBox>&a = a_.groups_of(blocks.a), &b = b_.groups_of(blocks.b);
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (is_clear(squared_gap(a[i], b_.blocks()[blocks.b]), limit)) continue;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const double gap = squared_gap(a[i], b[j]);
            if (is_clear(gap, limit)) continue;
            groups.push_back(
                {gap, blocks.a * TriangleGroups::group_size + i, blocks.b * TriangleGroups::group_size + j});
        }
    }
}

template <class Visit>
bool PairLoop::visit_near(const Near& groups, const double& limit, Visit visit) const {
    const std::vector<PlacedTriangle>&all_a = a_.triangles_of(groups.a), &all_b = b_.triangles_of(groups.b);
    PlacedBox a_box, b_box;
    const auto extend = [](PlacedBox& box, const PlacedTriangle& triangle) {
        for (const auto& corner : triangle.at.corner) box.extend(corner);
    };
    for (const PlacedTriangle& a : all_a) extend(a_box, a);
    const PlacedTriangle* near_b[TriangleGroups::group_size];
    std::size_t count = 0;
    for (const PlacedTriangle& b : all_b) {
        if (is_clear(squared_gap(a_box, b.box), limit)) continue;
        near_b[count++] = &b;
        extend(b_box, b);
    }
    for (const PlacedTriangle& a : all_a) {
        if (is_clear(squared_gap(a.box, b_box), limit) || is_clear(squared_gap_to_plane(a, b_box), limit)) continue;
        for (std::size_t j = 0; j < count; ++j) {
            const PlacedTriangle& b = *near_b[j];
            if (is_clear(squared_gap(a.box, b.box), limit) || is_clear(squared_gap_to_plane(a, b), limit) ||
                is_clear(squared_gap_to_plane(b, a), limit))
                continue;
            if (!visit(a, b)) return false;
        }
    }
    return true;
}

double PairLoop::squared_between_corners(const Near& groups) const {
    const PlacedGroups::GridPlace a = a_.corner_in_group(groups.a), b = b_.corner_in_group(groups.b);
    double squared = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double along = static_cast<double>(a.axis[k]) - static_cast<double>(b.axis[k]);
        squared += along * along;
    }
    return squared;
}

std::vector<detail::TrianglePair> PairLoop::every_contact() const {
    std::vector<detail::TrianglePair> found;
    const auto add = [&](const PlacedTriangle& a, const PlacedTriangle& b) {
        if (detail::triangles_meet(detail::integer_triangle(a.at), detail::integer_triangle(b.at)))
            found.push_back({{a.index}, {b.index}});
        return true;
    };
    constexpr double limit = 0.0;
    std::vector<Near> near;
    for (const Near& blocks : near_blocks(limit)) append_near(blocks, limit, near);
    for (const Near& groups : near) visit_near(groups, limit, add);
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<detail::FoundTriangles> PairLoop::nearest_pairs() const {
    // Corners bound the distance from above, boxes from below.
    double limit = PlacedBox::infinity;
    const auto lower = [&](double squared) { limit = std::min(limit, squared * search_slack); };
    std::vector<Near> near;
    for (const Near& blocks : near_blocks(limit)) {
        constexpr std::size_t size = TriangleGroups::group_size;
        lower(squared_between_corners({0.0, blocks.a * size, blocks.b * size}));
        const std::size_t before = near.size();
        if (!is_clear(blocks.squared_gap, limit)) append_near(blocks, limit, near);
        for (std::size_t i = before; i < near.size(); ++i) lower(squared_between_corners(near[i]));
    }
    std::erase_if(near, [&](const Near& groups) { return is_clear(groups.squared_gap, limit); });
    std::sort(near.begin(), near.end(), [](const Near& x, const Near& y) { return x.squared_gap < y.squared_gap; });

    std::vector<detail::FoundTriangles> found;
    const auto look = [&](const PlacedTriangle& a, const PlacedTriangle& b) {
        const detail::TriangleDistance distance = detail::distance_between(a.at, b.at);
        if (static_cast<double>(distance.squared) > limit) return true;
        lower(static_cast<double>(distance.squared));
        found.push_back({distance, a.at, b.at, {{a.index}, {b.index}}});
        return true;
    };
    for (const Near& groups : near)
        if (!is_clear(groups.squared_gap, limit)) visit_near(groups, limit, look);
    std::sort(found.begin(), found.end(), [](const detail::FoundTriangles& x, const detail::FoundTriangles& y) {
        return std::tie(x.distance.squared, x.pair) < std::tie(y.distance.squared, y.pair);
    });
    std::erase_if(found, [least = found.empty() ? 0.0 : static_cast<double>(found.front().distance.squared)](
                             const detail::FoundTriangles& pair) {
        return static_cast<double>(pair.distance.squared) > least * relative_slack;
    });
    return found;
}

const detail::FoundTriangles* first_within(const std::vector<detail::FoundTriangles>& nearest, float radius) {
    const auto first = std::find_if(nearest.begin(), nearest.end(), [&](const detail::FoundTriangles& pair) {
        return detail::is_within_radius(pair.a, pair.b, pair.distance, radius);
    });
    return first != nearest.end() ? &*first : nullptr;
}

bool PairLoop::is_any_within(float radius) const {
    const double limit = static_cast<double>(radius) * static_cast<double>(radius) * relative_slack;
    std::vector<Near> near;
    for (const Near& blocks : near_blocks(limit)) append_near(blocks, limit, near);
    for (const Near& groups : near) {
        const bool goes_on = visit_near(groups, limit, [&](const PlacedTriangle& a, const PlacedTriangle& b) {
            return !detail::is_within_radius(a.at, b.at, detail::distance_between(a.at, b.at), radius);
        });
        if (!goes_on) return true;
    }
    return false;
}

}  // namespace espalier::tests
