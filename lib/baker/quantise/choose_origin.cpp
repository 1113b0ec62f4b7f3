#include <baker/quantise/choose_origin.hpp>

#include <cmath>
#include <limits>

#include <baker/base/float_rounding.hpp>
#include <baker/input/positions.hpp>
#include <baker/quantise/lattice.hpp>

namespace espalier::baker {

namespace {

int exponent_of(double value) {
    int exponent = 0;
    std::frexp(value, &exponent);
    return exponent;
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

/// Whether float32 moves a coordinate, by half its spacing, farther than a quarter of a step.
bool is_too_coarse(double coordinate, int step_exponent) {
    return exponent_of(coordinate) - std::numeric_limits<float>::digits - 1 > step_exponent - 2;
}

}  // namespace

Vec3d choose_origin(std::span<const MeshView> meshes, const BakeOptions& options) {
    if (options.origin) return *options.origin;
    if (options.deformation) return {};
    SourceBounds bounds;
    bool is_first = true, is_rounded = false;
    for (const MeshView& mesh : meshes) {
        if (!mesh.positions.empty() && !mesh.float64_positions.empty()) continue;  // refused later
        for (const TriangleVertices& triangle : mesh.triangles) {
            for (const std::uint32_t corner : triangle) {
                if (corner >= mesh.position_count()) continue;
                const Vec3d point = given_position(mesh, corner);
                if (!is_finite(point)) continue;
                is_rounded = is_rounded || !fits_float32(point);
                if (is_first) bounds = SourceBounds(point);
                is_first = false;
                bounds.add(point);
            }
        }
    }
    bounds.measure();
    const double side = bounds.largest_side;
    if (!is_rounded || !(side > 0.0) || !std::isfinite(side) ||
        !is_too_coarse(bounds.largest_coordinate, step_exponent_of(options.resolution, side)))
        return {};
    const double spacing = std::ldexp(1.0, exponent_of(side));
    const auto near_middle = [&](double low, double high) {
        return std::nearbyint((0.5 * low + 0.5 * high) / spacing) * spacing + 0.0;
    };
    return {near_middle(bounds.min.x, bounds.max.x), near_middle(bounds.min.y, bounds.max.y),
            near_middle(bounds.min.z, bounds.max.z)};
}

}  // namespace espalier::baker
