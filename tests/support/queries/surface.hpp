// Triangles and corners of a decoded blob, drawn at random, and where they are in the world.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <espalier/types.hpp>

#include "support/base/random.hpp"
#include "support/format/decoder.hpp"

namespace espalier::tests {

/// A place in lattice steps in the world, rounded to float.
inline Vec3 place_in_world(const DecodedBlob& blob, double x, double y, double z) {
    const auto axis = [&](std::size_t k, double steps) {
        return static_cast<float>(static_cast<double>(blob.origin[k]) + std::ldexp(steps, blob.step_exponent));
    };
    return {axis(0, x), axis(1, y), axis(2, z)};
}
inline Vec3 place_in_world(const DecodedBlob& blob, const GridPoint& p) {
    return place_in_world(blob, p[0], p[1], p[2]);
}

/// The longest side of the asset in the world.
inline double size_of(const DecodedBlob& blob) {
    return std::ldexp(static_cast<double>(*std::max_element(blob.extent.begin(), blob.extent.end())),
                      blob.step_exponent);
}

inline const GridTriangle& some_triangle(const DecodedBlob& blob, Random& random) {
    return blob.triangles[random.below(static_cast<std::uint32_t>(blob.triangles.size()))];
}

inline const GridPoint& some_corner(const DecodedBlob& blob, Random& random) {
    const GridTriangle& t = some_triangle(blob, random);
    const std::uint32_t corner = random.below(3);
    return corner == 0 ? t.a : corner == 1 ? t.b : t.c;
}

/// What makers of queries about one blob have in common.
class SurfaceMaker {
public:
    SurfaceMaker(const DecodedBlob& decoded, std::uint64_t seed)
        : decoded_(decoded), random_(seed), size_(static_cast<float>(size_of(decoded))) {
        if (decoded.triangles.empty()) throw std::runtime_error("SurfaceMaker: the blob is empty");
    }
    [[nodiscard]] Random& random() { return random_; }
    [[nodiscard]] float size() const { return size_; }
    /// A corner of a triangle, in the world.
    Vec3 vertex() { return to_world(some_corner()); }

protected:
    [[nodiscard]] Vec3 to_world(double x, double y, double z) const { return place_in_world(decoded_, x, y, z); }
    [[nodiscard]] Vec3 to_world(const GridPoint& p) const { return place_in_world(decoded_, p); }
    const GridTriangle& some_triangle() { return tests::some_triangle(decoded_, random_); }
    const GridPoint& some_corner() { return tests::some_corner(decoded_, random_); }
    /// Anywhere in a box half again as large as the asset's.
    Vec3 some_place() {
        const auto along = [&](unsigned k) {
            return (static_cast<double>(random_.unit()) * 1.5 - 0.25) * decoded_.extent[k];
        };
        const double x = along(0), y = along(1), z = along(2);
        return to_world(x, y, z);
    }

    const DecodedBlob& decoded_;
    Random random_;
    float size_;  ///< the longest side
};

}  // namespace espalier::tests
