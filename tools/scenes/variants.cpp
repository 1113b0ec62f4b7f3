#include "variants.hpp"

#include <algorithm>
#include <cmath>

namespace espalier::tools {

namespace {

using Numbers = std::array<double, 3>;
using Matrix = std::array<Numbers, 3>;
/// x, y, z, w
using Turn = std::array<double, 4>;

/// The largest error of a Transform that rounding explains: that of a few products of float32 matrices, as a share of
/// the lengths that it moves.
constexpr double largest_turning_error = 0x1p-20;
/// Components of rotations are multiples of it: less than float32 resolves at 1. Quarter turns become exact.
constexpr double turn_unit = 0x1p-30;

/// A coordinate that is a smaller share of an offset is what a quarter turn in double precision leaves of a zero.
constexpr double turning_noise = 0x1p-48;

double length(const Numbers& v) { return std::hypot(v[0], v[1], v[2]); }

Numbers product(const Matrix& m, const Numbers& v) {
    Numbers result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
}

/// A quaternion may have any length but zero.
Matrix matrix_of(const Turn& q) {
    const auto [x, y, z, w] = q;
    const double n = x * x + y * y + z * z + w * w;
    return {{{(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n},
             {2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n},
             {2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n}}};
}

/// The rotation nearest to a matrix over its scale, from one that is near: the rest is a turn by so little that its
/// sine is its angle.
Turn refined(const Turn& near, const Matrix& linear, double scale) {
    const Matrix turned = matrix_of(near);
    Matrix rest{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t j = 0; j < 3; ++j) rest[i][k] += turned[j][i] * linear[j][k] / scale;
    const double x = (rest[2][1] - rest[1][2]) / 4, y = (rest[0][2] - rest[2][0]) / 4,
                 z = (rest[1][0] - rest[0][1]) / 4;
    const auto [a, b, c, w] = near;
    return {a + w * x + b * z - c * y, b + w * y + c * x - a * z, c + w * z + a * y - b * x, w - a * x - b * y - c * z};
}

Quaternion in_floats(const Turn& turn) {
    double greatest = 0.0;
    for (const double part : turn) greatest = std::max(greatest, std::abs(part));
    const auto part = [&](std::size_t i) {
        const double unit = std::nearbyint(turn[i] / greatest / turn_unit) * turn_unit;
        return static_cast<float>(unit == 0.0 ? 0.0 : unit);  // not -0
    };
    return {part(0), part(1), part(2), part(3)};
}

Vec3 in_floats(const Numbers& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

Numbers numbers_of(const Vec3& v) { return {double(v.x), double(v.y), double(v.z)}; }

template <class Visit>
void for_each_corner(const PointBox& box, const Visit& visit) {
    for (unsigned corner = 0; corner < 8; ++corner) {
        Numbers point{};
        for (std::size_t k = 0; k < 3; ++k) point[k] = (corner >> k & 1) != 0 ? box.high[k] : box.low[k];
        visit(point);
    }
}

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

bool is_finite_placement(const Placement& placement) {
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

double scale_of(const Placement& placement) {
    double sum = 0.0;
    for (const auto& row : placement.linear)
        for (const double entry : row) sum += entry * entry;
    return std::sqrt(sum / 3);
}

FittedTransform fit_translation(const std::array<double, 3>& offset) {
    FittedTransform fitted;
    const double longest = length(offset);
    Numbers kept = offset;
    for (double& coordinate : kept)
        if (std::abs(coordinate) <= turning_noise * longest) coordinate = 0.0;
    fitted.transform.translation = in_floats(kept);
    fitted.offset = {kept[0], kept[1], kept[2]};
    const Numbers moved = numbers_of(fitted.transform.translation);
    fitted.error = length({offset[0] - moved[0], offset[1] - moved[1], offset[2] - moved[2]});
    return fitted;
}

std::optional<FittedTransform> fit_transform(const Placement& placement, const PointBox& box) {
    float rows[3][4];
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) rows[i][k] = static_cast<float>(placement.linear[i][k]);
        rows[i][3] = static_cast<float>(placement.offset[i]);
    }
    const Result<Transform> near = transform_from_matrix(rows);
    if (!near) return std::nullopt;
    const double scale = scale_of(placement);
    FittedTransform fitted = fit_translation(placement.offset);
    const Quaternion& q = near->rotation;
    fitted.transform.rotation =
        in_floats(refined({double(q.x), double(q.y), double(q.z), double(q.w)}, placement.linear, scale));
    fitted.transform.scale = static_cast<float>(scale);
    if (box.low[0] > box.high[0]) return fitted;

    const Quaternion& r = fitted.transform.rotation;
    const Matrix turn = matrix_of({double(r.x), double(r.y), double(r.z), double(r.w)});
    const Numbers moved = numbers_of(fitted.transform.translation);
    double reach = 0.0, turning_error = 0.0;
    for_each_corner(box, [&](const Numbers& point) {
        const Numbers meant = product(placement.linear, point), turned = product(turn, point);
        Numbers linear_off{}, off{};
        for (std::size_t i = 0; i < 3; ++i) {
            linear_off[i] = meant[i] - double(fitted.transform.scale) * turned[i];
            off[i] = linear_off[i] + placement.offset[i] - moved[i];
        }
        reach = std::max(reach, scale * length(point));
        turning_error = std::max(turning_error, length(linear_off));
        fitted.error = std::max(fitted.error, length(off));
    });
    const bool is_rounding = turning_error <= largest_turning_error * reach && std::isfinite(fitted.error);
    return is_rounding ? std::optional(fitted) : std::nullopt;
}

PointBox box_at(const ImportedMesh& mesh, const Placement& placement) {
    PointBox box;
    for (const Vec3d& position : mesh.positions) {
        const Vec3d point = placement(position);
        const double coordinates[3] = {point.x, point.y, point.z};
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
    if (!is_finite_placement(placement)) return false;
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
