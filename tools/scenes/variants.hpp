// The forms of one mesh that its instances need: what a Transform cannot do is done to the vertices before the bake.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <espalier/import.hpp>
#include <espalier/transform.hpp>

#include <import/base/placement.hpp>

#include "base/exit_code.hpp"

namespace espalier::tools {

/// A Transform in place of a placement, and the largest distance between the two over the points of a box. It is that
/// at a corner of the box, since the distance is convex.
struct FittedTransform {
    Transform transform;
    double error = 0.0;
    Vec3d offset = {};  ///< the translation before it was rounded
};

/// Returns the Transform of a placement, or nothing if there is none whose error is due to rounding alone: the
/// placement shears, mirrors or scales unequally, or is out of range.
std::optional<FittedTransform> fit_transform(const Placement& placement, const PointBox& box);

/// Returns the Transform that only moves by the placement's offset, for a mesh with the rest of it in its vertices.
FittedTransform fit_translation(const std::array<double, 3>& offset);

/// Returns the scale of a placement: the root of the mean square of its columns' lengths.
double scale_of(const Placement& placement);

/// An instance of a variant.
struct VariantUse {
    std::uint32_t place = 0;  ///< index into ImportResult::places
    FittedTransform fitted;
};

/// A mesh with a placement applied to its vertices, and where it stands then.
struct Variant {
    std::uint32_t mesh = 0;  ///< index into ImportResult::meshes
    Placement placement;
    PointBox box;  ///< around the vertices, in double precision
    std::vector<VariantUse> uses;
};

/// Sorts the places of one mesh into variants. Places whose linear parts differ by a rotation and a uniform scale share
/// a variant: the mesh at the size of the first of them. Where the first is sheared, mirrored, unequally scaled or
/// rotated by quarter turns, the vertices have its whole linear part; instances like it then only move.
class VariantSorter {
public:
    /// `largest_error` bounds the distance between an instance and the place that it stands for.
    VariantSorter(const ImportResult& imported, std::uint32_t mesh, double largest_error)
        : imported_(imported), mesh_(mesh), largest_error_(largest_error) {}

    /// Returns false for a place that no Transform reaches within the error: it takes the vertices themselves there.
    bool add(std::uint32_t place);
    /// Returns the variants in the order of their first places.
    [[nodiscard]] std::vector<Variant>& variants() { return variants_; }

private:
    [[nodiscard]] std::optional<FittedTransform> fit(const Variant& variant, const Placement& placement) const;
    [[nodiscard]] bool is_near(const FittedTransform& fitted) const;

    const ImportResult& imported_;
    std::uint32_t mesh_;
    double largest_error_;
    std::vector<Variant> variants_;
    std::multimap<double, std::size_t> by_shape_;
};

/// Returns the box around the vertices of a mesh at that placement.
PointBox box_at(const ImportedMesh& mesh, const Placement& placement);

}  // namespace espalier::tools
