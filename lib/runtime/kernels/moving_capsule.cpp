// The kernel of capsules that move: eight triangles and a sphere. Widths and roundings: docs/numerics.md.
#include <runtime/kernels/moving_shapes.hpp>
#include <runtime/kernels/point_triangle.hpp>

namespace espalier::detail {

IntegerTriangle face_of_prism(const MovingCapsule& capsule, const IntegerTriangle& triangle, unsigned face) {
    IntegerTriangle result;
    for (unsigned i = 0; i < 3; ++i) {
        const unsigned corner = faces_of_prism[face][i];
        result.corner[i] = triangle.corner[corner & 3u];
        if (corner >= 4) result.corner[i] = result.corner[i] - capsule.axis;
    }
    return result;
}

namespace {

/// The faces of the prism that the sphere may meet first: those that look against the displacement, or all of them when
/// the prism is flat. What touches a convex body for the first time, and did not before, touches such a face.
class Faces {
public:
    Faces(const MovingCapsule& capsule, const IntegerTriangle& triangle) : capsule_(capsule), triangle_(triangle) {
        const Int128 volume = dot<Int128>(normal_of(triangle), capsule.axis);
        is_flat_ = volume.is_zero();
        is_turned_ = volume.is_negative();
    }
    /// Whether there is a next one.
    bool next() {
        while (++number_ < 8) {
            face_ = face_of_prism(capsule_, triangle_, number_);
            if (is_flat_) return number_ == 0 || !is_sphere();
            const Int128 along = dot<Int128>(normal_of(face_), capsule_.sphere.displacement);
            if (!along.is_zero() && along.is_negative() != is_turned_) return true;
        }
        return false;
    }
    [[nodiscard]] const IntegerTriangle& face() const { return face_; }

private:
    /// Then all faces are parts of the first.
    [[nodiscard]] bool is_sphere() const { return is_zero(capsule_.axis); }

    const MovingCapsule& capsule_;
    const IntegerTriangle& triangle_;
    IntegerTriangle face_{};
    unsigned number_ = ~0u;
    bool is_flat_ = false;
    bool is_turned_ = false;
};

/// The corners of the prism: those of the triangle, then those that are moved back by the axis.
struct PrismCorners {
    static constexpr unsigned count = 6;
    Integer3 at[count];

    PrismCorners(const MovingCapsule& capsule, const IntegerTriangle& triangle) {
        for (unsigned i = 0; i < 3; ++i) {
            at[i] = triangle.corner[i];
            at[3 + i] = triangle.corner[i] - capsule.axis;
        }
    }
};

/// Returns the part of the triangle that a part of a face of its prism lies over: what its corners come from.
Feature feature_below(const std::uint8_t* face, Feature on_face) {
    const unsigned part = corners_of(on_face);
    unsigned below = 0;
    for (unsigned i = 0; i < 3; ++i) below |= (part >> i & 1u) << (face[i] & 3u);
    return feature_of_corners(below);
}

}  // namespace

SweepTick first_contact_tick(const MovingCapsule& capsule, const IntegerTriangle& triangle, SweepTick most) noexcept {
    SweepTick first = no_contact;
    for (Faces faces(capsule, triangle); faces.next();) {
        const SweepTick tick = first_contact_tick(capsule.sphere, faces.face(), most);
        if (tick >= first) continue;
        first = tick;
        most = tick;
    }
    return first;
}

bool leaves_at_start(const MovingCapsule& capsule, const IntegerTriangle& triangle) noexcept {
    // The axis is as far from the triangle as its start is from the prism: as from the nearest of the faces.
    const PrismCorners corners(capsule, triangle);
    for (unsigned face = 0; face < 8; ++face) {
        const Departure departure =
            departure_from(capsule.sphere, face_of_prism(capsule, triangle, face), corners.at, corners.count);
        if (departure != Departure::is_elsewhere) return departure == Departure::leaves;
    }
    return false;  // inside of the prism: the axis passes through the triangle
}

SweepContact contact_at(const MovingCapsule& capsule, const IntegerTriangle& triangle, SweepTick first) noexcept {
    // The face that is nearest at that tick need not be the first that is met: others can be met within the same tick.
    const std::uint32_t tick = tick_before(first);
    const PrismCorners corners(capsule, triangle);
    unsigned number = 0;
    while (number < 7 && !takes_shortcut(is_zero(capsule.axis)) &&
           !is_nearest_face(capsule.sphere, face_of_prism(capsule, triangle, number), corners.at, corners.count, tick))
        ++number;
    const SweepContact on_face = contact_at(capsule.sphere, face_of_prism(capsule, triangle, number), tick);
    const std::uint8_t* const face = faces_of_prism[number];
    const float weights[3] = {1.0f - on_face.u - on_face.v, on_face.u, on_face.v};
    float of_corner[3] = {0.0f, 0.0f, 0.0f};
    for (unsigned i = 0; i < 3; ++i) of_corner[face[i] & 3u] += weights[i];
    return {{of_corner[1], of_corner[2]}, on_face.normal, feature_below(face, on_face.feature)};
}

}  // namespace espalier::detail
