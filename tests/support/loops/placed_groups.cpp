#include "placed_groups.hpp"

#include <algorithm>
#include <cmath>

namespace espalier::tests {

namespace {

using LatticeRange = TriangleGroups::LatticeRange;

void extend(LatticeRange& range, const LatticeRange& other) {
    for (std::size_t k = 0; k < 3; ++k) {
        range.low[k] = std::min(range.low[k], other.low[k]);
        range.high[k] = std::max(range.high[k], other.high[k]);
    }
}

/// Where `member` is the first of a group it begins one.
void add_to_groups(std::vector<LatticeRange>& groups, std::size_t member, const LatticeRange& range) {
    if (member % TriangleGroups::group_size == 0) groups.push_back(range);
    extend(groups.back(), range);
}

/// Steps of the grid: what is nearer to a plane may be on it.
constexpr double plane_slack = 0x1p-20;

/// Of what lies between `low` and `high` along a normal.
double squared_gap_outside(double low, double high) {
    const double gap = std::max({0.0, low - plane_slack, -high - plane_slack});
    return gap * gap;
}

}  // namespace

TriangleGroups::TriangleGroups(const DecodedBlob& decoded) {
    for (std::uint32_t i = 0; i < decoded.triangles.size(); ++i) {
        if (decoded.owners[i] != i) continue;
        const GridTriangle& t = decoded.triangles[i];
        LatticeRange range = {t.a, t.a};
        extend(range, {t.b, t.b});
        extend(range, {t.c, t.c});
        add_to_groups(groups, indices.size(), range);
        indices.push_back(i);
        triangles.push_back({{{t.a[0], t.a[1], t.a[2]}, {t.b[0], t.b[1], t.b[2]}, {t.c[0], t.c[1], t.c[2]}}});
    }
    for (std::size_t i = 0; i < groups.size(); ++i) add_to_groups(blocks, i, groups[i]);
}

void PlacedBox::extend(const std::int32_t* place) {
    for (unsigned k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], static_cast<double>(place[k]));
        high[k] = std::max(high[k], static_cast<double>(place[k]));
    }
}

double squared_gap(const PlacedBox& a, const PlacedBox& b) {
    double sum = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
        const double gap = std::max({0.0, a.low[k] - b.high[k], b.low[k] - a.high[k]});
        sum += gap * gap;
    }
    return sum;
}

/// Normals are exact before they get their length: coordinates are below 2^25, so that what a plane says of a place is
/// within 2^-24.
PlacedTriangle::PlacedTriangle(const detail::LatticeTriangle& triangle, std::uint32_t storage_index)
    : at(triangle), index(storage_index) {
    double u[3], v[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = static_cast<double>(at.corner[1][k]) - at.corner[0][k];
        v[k] = static_cast<double>(at.corner[2][k]) - at.corner[0][k];
    }
    double squared = 0.0;
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        normal[k] = u[next] * v[last] - u[last] * v[next];
        squared += normal[k] * normal[k];
    }
    const double inverse = squared > 0.0 ? 1.0 / std::sqrt(squared) : 0.0;
    offset = 0.0;
    for (int k = 0; k < 3; ++k) {
        normal[k] *= inverse;
        offset += normal[k] * at.corner[0][k];
    }
    for (const auto& corner : at.corner) box.extend(corner);
}

double squared_gap_to_plane(const PlacedTriangle& of_plane, const PlacedBox& box) {
    double low = -of_plane.offset, high = -of_plane.offset;
    for (int k = 0; k < 3; ++k) {
        const double at_low = of_plane.normal[k] * box.low[k], at_high = of_plane.normal[k] * box.high[k];
        low += std::min(at_low, at_high);
        high += std::max(at_low, at_high);
    }
    return squared_gap_outside(low, high);
}

double squared_gap_to_plane(const PlacedTriangle& of_plane, const PlacedTriangle& other) {
    double along[3];
    for (int corner = 0; corner < 3; ++corner) {
        along[corner] = -of_plane.offset;
        for (int k = 0; k < 3; ++k) along[corner] += of_plane.normal[k] * other.at.corner[corner][k];
    }
    return squared_gap_outside(std::min({along[0], along[1], along[2]}), std::max({along[0], along[1], along[2]}));
}

PlacedGroups::PlacedGroups(const TriangleGroups& groups, const detail::PairFrame& frame, Side side)
    : own_(groups), frame_(frame), side_(side), groups_(groups.blocks.size()), triangles_(groups.groups.size()) {
    for (const LatticeRange& range : own_.blocks) blocks_.push_back(placed(range));
}

void PlacedGroups::place(const std::int32_t* from, std::int32_t* to) const {
    if (side_ == Side::b) return frame_.place_b(from, to);
    for (int k = 0; k < 3; ++k) to[k] = frame_.place_a(from[k]);
}

/// The box around where its corners land. Vertices are placed by an affine map and then rounded: within the box each
/// coordinate is extreme in a corner, and rounding keeps the order.
PlacedBox PlacedGroups::placed(const LatticeRange& range) const {
    PlacedBox box;
    for (unsigned corner = 0; corner < 8; ++corner) {
        std::int32_t from[3], to[3];
        for (unsigned k = 0; k < 3; ++k) from[k] = (corner >> k & 1u) != 0 ? range.high[k] : range.low[k];
        place(from, to);
        box.extend(to);
    }
    return box;
}

const std::vector<PlacedBox>& PlacedGroups::groups_of(std::size_t block) const {
    std::vector<PlacedBox>& boxes = groups_[block];
    if (!boxes.empty()) return boxes;
    const std::size_t begin = block * TriangleGroups::group_size;
    const std::size_t end = std::min(begin + TriangleGroups::group_size, own_.groups.size());
    for (std::size_t i = begin; i < end; ++i) boxes.push_back(placed(own_.groups[i]));
    return boxes;
}

const std::vector<PlacedTriangle>& PlacedGroups::triangles_of(std::size_t group) const {
    std::vector<PlacedTriangle>& triangles = triangles_[group];
    if (!triangles.empty()) return triangles;
    const std::size_t begin = group * TriangleGroups::group_size;
    const std::size_t end = std::min(begin + TriangleGroups::group_size, own_.triangles.size());
    for (std::size_t i = begin; i < end; ++i) {
        const detail::LatticeTriangle& t = own_.triangles[i];
        triangles.emplace_back(side_ == Side::a ? frame_.place_a(t) : frame_.place_b(t), own_.indices[i]);
    }
    return triangles;
}

PlacedGroups::GridPlace PlacedGroups::corner_in_group(std::size_t group) const {
    GridPlace corner{};
    place(own_.triangles[group * TriangleGroups::group_size].corner[0], corner.axis);
    return corner;
}

}  // namespace espalier::tests
