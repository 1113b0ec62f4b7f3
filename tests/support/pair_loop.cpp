#include "pair_loop.hpp"

#include <algorithm>

namespace espalier::tests {

namespace {

/// Of squared distances: what the kernels say in float is within a millionth.
constexpr double relative_slack = 1.0 + 1e-5;

double square(double x) { return x * x; }

}  // namespace

void PairLoop::Box::extend(const double* place) {
    for (unsigned k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], place[k]);
        high[k] = std::max(high[k], place[k]);
    }
}

void PairLoop::Box::extend(const Box& other) {
    extend(other.low);
    extend(other.high);
}

template <class Place>
PairLoop::Side PairLoop::placed(const DecodedBlob& blob, Place place) {
    Side side;
    for (std::uint32_t i = 0; i < blob.triangles.size(); ++i) {
        if (blob.owners[i] != i) continue;
        const GridTriangle& t = blob.triangles[i];
        side.indices.push_back(i);
        side.triangles.push_back(
            place({{{t.a[0], t.a[1], t.a[2]}, {t.b[0], t.b[1], t.b[2]}, {t.c[0], t.c[1], t.c[2]}}}));
        Box& box = side.boxes[0].emplace_back();
        for (const auto& corner : side.triangles.back().corner) {
            const double at[3] = {static_cast<double>(corner[0]), static_cast<double>(corner[1]),
                                  static_cast<double>(corner[2])};
            box.extend(at);
        }
    }
    for (std::size_t level = 1; level < side.boxes.size(); ++level) {
        const std::vector<Box>& members = side.boxes[level - 1];
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (i % group_size == 0) side.boxes[level].emplace_back();
            side.boxes[level].back().extend(members[i]);
        }
    }
    return side;
}

PairLoop::PairLoop(const detail::PairFrame& frame, const DecodedBlob& a, const DecodedBlob& b, LeftOut left_out)
    : left_out_(left_out),
      a_(placed(a, [&](const detail::LatticeTriangle& t) { return frame.place_a(t); })),
      b_(placed(b, [&](const detail::LatticeTriangle& t) { return frame.place_b(t); })) {}

double PairLoop::squared_gap(const Box& a, const Box& b) {
    double sum = 0.0;
    for (unsigned k = 0; k < 3; ++k) sum += square(std::max({0.0, a.low[k] - b.high[k], b.low[k] - a.high[k]}));
    return sum;
}

void PairLoop::append_near(std::size_t level, const Near& parent, double limit, std::vector<Near>& near) const {
    const std::vector<Box>& a = a_.boxes[level];
    const std::vector<Box>& b = b_.boxes[level];
    const bool is_highest = level + 1 == a_.boxes.size();
    const auto end_of = [&](std::size_t group, std::size_t all) {
        return is_highest ? all : std::min((group + 1) * group_size, all);
    };
    const std::size_t a_end = end_of(parent.a, a.size()), b_end = end_of(parent.b, b.size());
    for (std::size_t i = parent.a * group_size; i < a_end; ++i)
        for (std::size_t j = parent.b * group_size; j < b_end; ++j) {
            const double gap = squared_gap(a[i], b[j]);
            if (gap <= limit || left_out_ == LeftOut::nothing)
                near.push_back({gap, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
        }
}

std::vector<PairLoop::Near> PairLoop::near_groups(double limit) const {
    std::vector<Near> highest, groups;
    append_near(2, {0.0, 0, 0}, limit, highest);
    for (const Near& pair : highest) append_near(1, pair, limit, groups);
    return groups;
}

std::vector<TrianglePair> PairLoop::every_contact() const {
    std::vector<TrianglePair> found;
    std::vector<Near> near;
    for (const Near& groups : near_groups(0.0)) {
        near.clear();
        append_near(0, groups, 0.0, near);
        for (const auto& [gap, a, b] : near)
            if (detail::triangles_meet(detail::integer_triangle(a_.triangles[a]),
                                       detail::integer_triangle(b_.triangles[b])))
                found.push_back({{a_.indices[a]}, {b_.indices[b]}});
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::optional<detail::FoundTriangles> PairLoop::nearest_pair(float radius) const {
    // Corners bound the distance from above, boxes from below.
    double bound = square(static_cast<double>(radius));
    for (std::size_t i = 0; i < a_.triangles.size(); i += group_size)
        for (std::size_t j = 0; j < b_.triangles.size(); j += group_size) {
            double squared = 0.0;
            for (int k = 0; k < 3; ++k) squared += square(a_.triangles[i].corner[0][k] - b_.triangles[j].corner[0][k]);
            bound = std::min(bound, squared);
        }
    std::vector<Near> groups = near_groups(bound * relative_slack);
    std::sort(groups.begin(), groups.end(), [](const Near& x, const Near& y) { return x.squared_gap < y.squared_gap; });
    std::optional<detail::FoundTriangles> best;
    std::vector<Near> near;
    for (const Near& pair : groups) {
        near.clear();
        append_near(0, pair, bound * relative_slack, near);
        for (const auto& [gap, i, j] : near) {
            if (gap > bound * relative_slack && left_out_ != LeftOut::nothing) continue;
            const detail::LatticeTriangle &a = a_.triangles[i], &b = b_.triangles[j];
            const detail::TriangleDistance distance = detail::distance_between(a, b);
            const TrianglePair indices = {{a_.indices[i]}, {b_.indices[j]}};
            if (best && (distance.squared > best->distance.squared ||
                         (distance.squared == best->distance.squared && indices > best->pair)))
                continue;
            if (!detail::is_within_radius(a, b, distance, radius)) continue;
            best = {distance, a, b, indices};
            bound = std::min(bound, static_cast<double>(distance.squared));
        }
    }
    return best;
}

bool PairLoop::is_any_within(float radius) const {
    const double limit = square(static_cast<double>(radius)) * relative_slack;
    std::vector<Near> near;
    for (const Near& groups : near_groups(limit)) {
        near.clear();
        append_near(0, groups, limit, near);
        for (const auto& [gap, i, j] : near) {
            const detail::LatticeTriangle &a = a_.triangles[i], &b = b_.triangles[j];
            if (detail::is_within_radius(a, b, detail::distance_between(a, b), radius)) return true;
        }
    }
    return false;
}

}  // namespace espalier::tests
