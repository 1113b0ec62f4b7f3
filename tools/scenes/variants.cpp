#include "variants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::tools {

namespace {

/// How far the shapes of equal variants may differ: far more than rounding, since fit() decides.
constexpr double shape_slack = 0x1p-16;
/// How far entries of a rotation by quarter turns may be from 0 and from the scale, as a share of it.
constexpr double rounding_slack = 0x1p-20;

/// A number that rotations and uniform scales from the left leave as it is: a sum of the squares and products of the
/// columns, each with a weight of its own, over their sum.
double shape_of(const Placement& placement) {
    constexpr double weights[3][3] = {{1.0, 0.61, 0.37}, {0.0, 0.53, 0.29}, {0.0, 0.0, 0.17}};
    double sum = 0.0, trace = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = i; k < 3; ++k) {
            double dot = 0.0;
            for (const auto& row : placement.linear) dot += row[i] * row[k];
            sum += weights[i][k] * dot;
            if (i == k) trace += dot;
        }
    }
    const double shape = sum / trace;
    return std::isfinite(shape) ? shape : 0.0;
}

/// outer = result * inner, for the linear parts; nothing if inner has no inverse.
std::optional<Placement> quotient(const Placement& outer, const Placement& inner) {
    const double determinant = inner.determinant();
    if (determinant == 0.0 || !std::isfinite(1.0 / determinant)) return std::nullopt;
    const auto& m = inner.linear;
    const auto minor = [&m](std::size_t row, std::size_t column) {
        const std::size_t a = (row + 1) % 3, b = (row + 2) % 3, c = (column + 1) % 3, d = (column + 2) % 3;
        return m[a][c] * m[b][d] - m[a][d] * m[b][c];
    };
    Placement inverse;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            inverse.linear[row][column] = minor(column, row) / determinant;
    Placement linear = outer;
    linear.offset = {};
    return combine(linear, inverse);
}

bool is_finite(const Placement& placement) {
    const auto finite = [](double number) { return std::isfinite(number); };
    return std::all_of(placement.offset.begin(), placement.offset.end(), finite) &&
           std::all_of(placement.linear.begin(), placement.linear.end(),
                       [&](const auto& row) { return std::all_of(row.begin(), row.end(), finite); });
}

Placement without_offset(Placement placement) {
    placement.offset = {};
    return placement;
}

/// Returns whether a placement rotates by quarter turns or not at all and scales uniformly, but for what rounding
/// explains.
bool turns_by_quarters(const Placement& placement) {
    const double size = scale_of(placement), slack = size * rounding_slack;
    std::array<unsigned, 3> in_column{};
    for (const auto& row : placement.linear)
        for (std::size_t k = 0; k < 3; ++k) {
            const double length = std::abs(row[k]);
            if (length <= slack) continue;
            if (std::abs(length - size) > slack) return false;
            ++in_column[k];
        }
    return in_column == std::array<unsigned, 3>{1, 1, 1} && placement.determinant() > 0.0;
}

}  // namespace

PointBox box_at(const ImportedMesh& mesh, const Placement& placement) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    PointBox box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const Vec3& position : mesh.positions) {
        const Vec3 point = placement(position);
        const double coordinates[3] = {double(point.x), double(point.y), double(point.z)};
        for (std::size_t k = 0; k < 3; ++k) {
            if (!std::isfinite(coordinates[k])) continue;  // such a vertex is refused or dropped by the baker
            box.low[k] = std::min(box.low[k], coordinates[k]);
            box.high[k] = std::max(box.high[k], coordinates[k]);
        }
    }
    for (std::size_t k = 0; k < 3; ++k)
        if (box.low[k] > box.high[k]) return {{1, 1, 1}, {0, 0, 0}};
    return box;
}

bool VariantSorter::is_near(const FittedTransform& fitted) const {
    const Vec3& moved = fitted.transform.translation;
    return std::isfinite(moved.x) && std::isfinite(moved.y) && std::isfinite(moved.z) && fitted.error <= largest_error_;
}

std::optional<FittedTransform> VariantSorter::fit(const Variant& variant, const Placement& placement) const {
    if (variant.placement.linear == placement.linear) return fit_translation(placement.offset);
    std::optional<Placement> rest = quotient(placement, variant.placement);
    if (!rest) return std::nullopt;
    rest->offset = placement.offset;
    return fit_transform(*rest, variant.box);
}

bool VariantSorter::add(std::uint32_t place) {
    const Placement& placement = imported_.places[place].placement;
    if (!is_finite(placement)) return false;
    const double shape = shape_of(placement);
    const auto end = by_shape_.upper_bound(shape + shape_slack);
    for (auto candidate = by_shape_.lower_bound(shape - shape_slack); candidate != end; ++candidate) {
        Variant& variant = variants_[candidate->second];
        const std::optional<FittedTransform> fitted = fit(variant, placement);
        if (!fitted || !is_near(*fitted)) continue;
        variant.uses.push_back({place, *fitted});
        return true;
    }
    // The size is a float32, so that a mesh at its own size keeps every bit.
    const auto size = static_cast<double>(static_cast<float>(scale_of(placement)));
    const Placement form = turns_by_quarters(placement) ? without_offset(placement) : scaled_by(size);
    Variant variant{mesh_, form, box_at(imported_.meshes[mesh_], form), {}};
    std::optional<FittedTransform> fitted = size > 0.0 ? fit(variant, placement) : std::nullopt;
    if (!fitted || !is_near(*fitted)) {
        variant.placement = without_offset(placement);
        variant.box = box_at(imported_.meshes[mesh_], variant.placement);
        fitted = fit_translation(placement.offset);
    }
    if (!is_near(*fitted)) return false;
    variant.uses.push_back({place, *fitted});
    by_shape_.emplace(shape, variants_.size());
    variants_.push_back(std::move(variant));
    return true;
}

}  // namespace espalier::tools
