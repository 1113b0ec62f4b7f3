#include <baker/quantise/lattice.hpp>

#include <algorithm>
#include <limits>
#include <string>

#include <baker/base/float_rounding.hpp>
#include <baker/base/number_text.hpp>
#include <baker/base/origin_choice.hpp>
#include <baker/input/positions.hpp>

namespace espalier::baker {

namespace {

constexpr double half_diagonal =
    0x1.bb67ae8584cabp-1;  // sqrt(3) / 2, rounded up: how far from a lattice point one can be

constexpr double text_margin = 1e-8;  // of a number of nine digits

constexpr int far_too_fine = -200;  // below this no float32 extent has few enough steps

/// Bits of the largest coordinate that the bounds have on this lattice.
unsigned bits_needed(const SourceBounds& bounds, int step_exponent) {
    // mutant(< -> <=) equivalent: at 2^-1000 every float32 extent has too many steps, which the loop finds too
    if (step_exponent < far_too_fine) return unsigned{format::max_bits} + 1;
    const double reciprocal_step = std::ldexp(1.0, -step_exponent);
    const auto steps_between = [&](double min, double max) {
        return snap_to_step(max, reciprocal_step) - snap_to_step(min, reciprocal_step);
    };
    const double largest =
        std::max({steps_between(bounds.min.x, bounds.max.x), steps_between(bounds.min.y, bounds.max.y),
                  steps_between(bounds.min.z, bounds.max.z)});
    unsigned bits = 1;
    while (largest > std::ldexp(1.0, static_cast<int>(bits)) - 1.0) ++bits;
    return bits;
}

std::optional<Refusal> check_exponent(int step_exponent, const SourceBounds& bounds) {
    if (step_exponent >= format::min_step_exponent && step_exponent <= format::max_step_exponent) return std::nullopt;
    return Refusal{BakeStatus::too_large, "the meshes are " + number_text(bounds.largest_side) +
                                              " units large, which needs a lattice step of 2^" +
                                              std::to_string(step_exponent) + "; steps go from 2^" +
                                              std::to_string(format::min_step_exponent) + " to 2^" +
                                              std::to_string(format::max_step_exponent) + "; scale the input"};
}

/// With as many bits as given. A step of which the bounds are too many gives an origin, too, which is of no use.
Lattice lattice_at(const SourceBounds& bounds, int step_exponent, unsigned bits) {
    const double step = std::ldexp(1.0, step_exponent);
    const double reciprocal_step = std::ldexp(1.0, -step_exponent);
    const auto snapped = [&](double coordinate) {
        return static_cast<float>(snap_to_step(coordinate, reciprocal_step) * step);
    };
    return {{snapped(bounds.min.x), snapped(bounds.min.y), snapped(bounds.min.z)}, step_exponent, bits};
}

/// Returns about the exponent of the step that a resolution gives.
int step_exponent_of(const Resolution& resolution, double largest_side) {
    switch (resolution.kind()) {
        case Resolution::Kind::bits:
            return exponent_of(largest_side) - static_cast<int>(resolution.value());
        case Resolution::Kind::step:
            return static_cast<int>(resolution.value());
        case Resolution::Kind::tolerance:
            break;
    }
    return step_exponent_for_tolerance(resolution.value());
}

}  // namespace

Vec3d choose_origin(std::span<const MeshView> meshes, const BakeOptions& options) {
    if (options.origin) return *options.origin;
    if (options.deformation) return {};
    SourceBounds bounds;
    bool is_first = true;
    for (const MeshView& mesh : meshes) {
        if (!mesh.positions.empty() && !mesh.float64_positions.empty()) continue;  // refused later
        for (const TriangleVertices& triangle : mesh.triangles) {
            for (const std::uint32_t corner : triangle) {
                if (corner >= mesh.position_count()) continue;
                const Vec3d point = given_position(mesh, corner);
                if (!is_finite(point)) continue;
                if (is_first) bounds = SourceBounds(point);
                is_first = false;
                bounds.add(point);
            }
        }
    }
    bounds.measure();
    const double side = bounds.largest_side;
    if (!(side > 0.0) || !std::isfinite(side) ||
        !is_too_coarse(bounds.largest_coordinate, std::ldexp(1.0, step_exponent_of(options.resolution, side))))
        return {};
    return origin_near_middle(bounds.min, bounds.max, power_above(side));
}

float largest_snap_error(int step_exponent) {
    return round_up_to_float(half_diagonal * std::ldexp(1.0, step_exponent));
}

SourceBounds bounds_of(const Source& source) {
    if (source.triangles.empty()) return SourceBounds();
    SourceBounds bounds(source.positions[source.triangles.front().corners[0]]);
    for (const SourceTriangle& triangle : source.triangles)
        for (const std::uint32_t corner : triangle.corners) bounds.add(source.positions[corner]);
    bounds.measure();
    return bounds;
}

bool is_below_float_spacing(const Lattice& lattice, const SourceBounds& bounds) {
    int exponent = 0;
    std::frexp(bounds.largest_coordinate, &exponent);
    return bounds.largest_coordinate != 0.0 && lattice.step_exponent < exponent - std::numeric_limits<float>::digits;
}

Expected<Lattice> lattice_for_bits(const SourceBounds& bounds, unsigned bits) {
    if (bounds.largest_side == 0.0) return Lattice{{}, 0, bits};  // only of nothing: an area has an extent
    int step_exponent = 0;                                        // side < 2^exponent: a step of this size fits
    std::frexp(bounds.largest_side, &step_exponent);
    while (bits_needed(bounds, step_exponent - 1) <= bits) --step_exponent;
    if (auto refusal = check_exponent(step_exponent, bounds)) return *refusal;
    return lattice_at(bounds, step_exponent, bits);
}

int step_exponent_for_tolerance(double tolerance) {
    int exponent = 0;
    std::frexp(tolerance, &exponent);
    while (double(largest_snap_error(exponent)) > tolerance) --exponent;
    return exponent;
}

Expected<Lattice> lattice_for_step(const SourceBounds& bounds, int step_exponent) {
    const unsigned bits = bits_needed(bounds, step_exponent);
    if (bits <= unsigned{format::max_bits}) return lattice_at(bounds, step_exponent, bits);
    std::string message = "a step of 2^" + std::to_string(step_exponent) + " is too fine for meshes that are " +
                          number_text(bounds.largest_side) + " large: a blob has at most 2^" +
                          std::to_string(format::max_bits) + " - 1 steps along each axis";
    if (const auto finest = lattice_for_bits(bounds, unsigned{format::max_bits}))
        message += ", so at this size the finest step is 2^" + std::to_string(finest->step_exponent);
    return Refusal{BakeStatus::too_fine,
                   message + "; choose a coarser step, or split the input into several blobs with the same step"};
}

Expected<Lattice> lattice_for_tolerance(const SourceBounds& bounds, int step_exponent, double tolerance) {
    if (bounds.largest_side == 0.0) return Lattice{};
    const unsigned bits = bits_needed(bounds, step_exponent);
    if (bits > unsigned{format::max_bits}) {
        const double most_steps = std::ldexp(1.0, format::max_bits) - 1.0;
        const double largest_extent = most_steps * std::ldexp(1.0, step_exponent_for_tolerance(tolerance));
        const auto finest = lattice_for_bits(bounds, unsigned{format::max_bits});
        std::string message = "a tolerance of " + number_text(tolerance) + " is too fine for meshes that are " +
                              number_text(bounds.largest_side) + " large: at this tolerance they may be " +
                              number_text(largest_extent * (1.0 - text_margin)) + " large";
        if (finest) {
            const double finest_tolerance = double(largest_snap_error(finest->step_exponent));
            message += ", at this size the finest tolerance is " + number_text(finest_tolerance * (1.0 + text_margin));
        }
        return Refusal{BakeStatus::too_fine,
                       message + "; choose a coarser tolerance, or split the input into several blobs"};
    }
    if (auto refusal = check_exponent(step_exponent, bounds)) return *refusal;
    return lattice_at(bounds, step_exponent, bits);
}

}  // namespace espalier::baker
