// The kernel of spheres and, through it, of capsules that move. Widths and roundings: docs/numerics.md.
#include <runtime/base/bits.hpp>
#include <runtime/base/wide_difference.hpp>
#include <runtime/kernels/moving_shapes.hpp>
#include <runtime/kernels/segment_triangle.hpp>

namespace espalier::detail {

namespace {

/// What float arithmetic may be off by, with room to spare: 64 roundings.
constexpr float slack = 0x1p-18f;

/// Each coordinate times 2^-40, rounded once.
Vec3 rounded_cross(const Integer3& a, const Integer3& b) { return to_vector(wide_cross(a, b)) * 0x1p-40f; }
Vec3 unit_along(const Integer3& a, bool turned) { return to_unit(a, turned ? -0x1p-30f : 0x1p-30f); }

enum class Part : std::uint8_t { corner, side, face };

/// How the sphere's centre is to the triangle at some tick.
struct Probe {
    bool touches;
    bool closing;    ///< the distance shrinks; set, as the next two, only where it does not touch
    float distance;  ///< in units
    float speed;     ///< by how much, at most, it would shrink or grow on the whole way, if it went on like this
};

class Approach {
public:
    Approach(const MovingSphere& sphere, const IntegerTriangle& triangle)
        : sphere_(sphere), triangle_(triangle), radius_(to_float(sphere.radius)), squared_radius_(radius_ * radius_) {
        std::int64_t large = 0;
        for (unsigned i = 0; i < 3; ++i) {
            side_[i] = triangle.corner[(i + 1) % 3] - triangle.corner[i];
            length_[i] = dot<std::int64_t>(side_[i], side_[i]);
            const Integer3 size = magnitude(side_[i]);
            large |= size.x | size.y | size.z;
        }
        normal_ = cross(side_[0], side_[1]);
        largest_side_ = large;
        is_narrow_ = takes_shortcut(large < std::int64_t{1} << 20);
        for (unsigned i = 0; i < 3; ++i) {
            if (is_narrow_) inward_[i] = cross(normal_, side_[i]);
            else if (takes_shortcut()) rounded_inward_[i] = cross(to_vector(normal_), to_vector(side_[i]));
        }
        if (takes_shortcut(!is_narrow_))
            inward_error_ = sum_of_magnitudes(to_vector(normal_)) * to_float(large) * 0x1p-18f;
    }

    [[nodiscard]] SweepTick first_contact_tick(SweepTick least, SweepTick most) {
        // A bound of lanes is a little early. Where nothing was met so far, the contact is most often soon after it;
        // else the triangle is most often beyond what was met.
        const bool is_likely = takes_shortcut(most == whole_way && least != 0 && least < most && most - least > 512);
        high_.tick = most;
        if (is_likely && closes_at(least)) {
            const std::uint32_t soon = tick_near(least + 1, (low_.probe.distance - radius_) / low_.probe.speed);
            const Bound near = {soon, probe(soon)};
            const bool is_before = !near.probe.touches && near.probe.closing;
            (is_before ? low_ : high_) = near;
            if (is_before) high_ = {most, probe(most)};
            if (!high_.probe.touches && high_.probe.closing) return no_contact;
        } else {
            // What is still getting nearer in the end has not been nearer before.
            high_ = {most, probe(most)};
            if (!high_.probe.touches && high_.probe.closing) return no_contact;
            if (is_likely || least == 0 || least >= most || !closes_at(least)) {
                low_ = {0, most == 0 ? high_.probe : probe(0)};
                if (low_.probe.touches) return 0;
            } else if (most - least > 512) {
                const Bound near = {least + 256, probe(least + 256)};
                (!near.probe.touches && near.probe.closing ? low_ : high_) = near;
            }
        }
        if (!low_.probe.closing || !(high_.probe.touches || find_contact_inside())) return no_contact;
        if (high_.probe.touches) close_in();
        return high_.tick;
    }

    [[nodiscard]] SweepContact contact_at(std::uint32_t tick) {
        look_at(tick);
        switch (part_) {
            case Part::corner: {
                const Integer3& p = seen_[number_];
                return {weights_on_side(static_cast<int>(number_), 0.0f),
                        is_zero(p) ? normal_against_displacement() : unit_along(p, false),
                        vertex_of(static_cast<int>(number_))};
            }
            case Part::side: {
                const float along = to_float(forward_) * 0x1p-24f / to_float(length_[number_]);
                const Weights at = weights_on_side(static_cast<int>(number_), along);
                // What of p is perpendicular to the side, times its squared length.
                const Integer3& p = seen_[number_];
                const auto across = [&](std::int64_t of_p, std::int64_t of_side) {
                    return product_difference(Int128(of_p), Int128(length_[number_]), forward_, Int128(of_side))
                        .to_float(-56);
                };
                const Integer3& side = side_[number_];
                const Vec3 off = {across(p.x, side.x), across(p.y, side.y), across(p.z, side.z)};
                return {at, off == Vec3{} ? normal_against_displacement() : to_unit(off),
                        edge_of(static_cast<int>(number_))};
            }
            default: {
                const float whole = to_float(dot<Int128>(normal_, normal_)) * 0x1p-36f;
                const Int128 above = dot<Int128>(normal_, seen_[0]);
                return {{flush_subnormal(weight(2) / whole), flush_subnormal(weight(0) / whole)},
                        above.is_zero() ? normal_against_displacement() : unit_along(normal_, above.is_negative()),
                        Feature::face};
            }
        }
    }

    [[nodiscard]] bool is_nearest(std::uint32_t tick, const Integer3* points, unsigned count) {
        look_at(tick);
        return !any_is_beyond(points, count);
    }
    [[nodiscard]] Departure departure(const Integer3* points, unsigned count) {
        const Probe start = probe(0);
        if (start.touches) return Departure::touches;
        if (any_is_beyond(points, count)) return Departure::is_elsewhere;
        return start.closing ? Departure::closes : Departure::leaves;
    }

private:
    struct Bound {
        std::uint32_t tick;
        Probe probe;
    };

    /// The centre seen from the corners, in units of 2^-24, and which part of the triangle is closest to it: the one in
    /// whose normal cone it lies (Ericson 2005, 5.1.5). Triangles without area have no face, but all the rest.
    void look_at(std::uint32_t tick) {
        const std::int64_t time = tick;
        const Integer3& d = sphere_.displacement;
        Int128 forward[3];  // from each corner along its side, times the side's length
        for (unsigned i = 0; i < 3; ++i) {
            seen_[i] = d * time - (triangle_.corner[i] << tick_bits);
            forward[i] = dot<Int128>(seen_[i], side_[i]);
        }
        const auto is_before_end = [&](unsigned i) { return forward[i] < Int128(length_[i]) << tick_bits; };
        const auto is_behind_start = [&](unsigned i) { return Int128(0) < forward[i]; };
        for (unsigned i = 0; i < 3; ++i) {
            number_ = i;
            part_ = Part::corner;
            if (!is_behind_start(i) && !is_before_end((i + 2) % 3)) return;
        }
        for (unsigned i = 0; i < 3; ++i) {
            if (!is_behind_start(i) || !is_before_end(i)) continue;  // none has length 0
            number_ = i;
            part_ = Part::side;
            forward_ = forward[i];
            if (!is_within_side(i)) return;
        }
        part_ = Part::face;
    }
    // How far the centre is on the inner side of a side, times length and squared area: proportional to the weight of
    // the corner opposite. For long sides (s x p) . (a x b) = (s . a)(p . b) - (s . b)(p . a).
    [[nodiscard]] bool is_within_side(unsigned i) const {
        if (takes_shortcut(is_narrow_)) return Int128(0) < dot<Int128>(inward_[i], seen_[i]);
        if (takes_shortcut()) {
            const Vec3 seen = to_vector(seen_[i]) * 0x1p-24f;
            const float inside = dot(rounded_inward_[i], seen);
            if (absolute(inside) > inward_error_ * sum_of_magnitudes(seen)) return inside > 0.0f;
        }
        return compare_products(dot<Int128>(side_[i], side_[0]), dot<Int128>(seen_[i], side_[1]),
                                dot<Int128>(side_[i], side_[1]), dot<Int128>(seen_[i], side_[0])) > 0;
    }
    /// Whether a point is nearer to the centre than the part, along the way between those two.
    [[nodiscard]] bool is_beyond(const Integer3& point) const {
        const Integer3 ahead = point - triangle_.corner[number_];
        switch (part_) {
            case Part::corner:
                return Int128(0) < dot<Int128>(seen_[number_], ahead);
            case Part::side:
                return compare_products(dot<Int128>(seen_[number_], ahead), Int128(length_[number_]), forward_,
                                        dot<Int128>(side_[number_], ahead)) > 0;
            default: {
                const Int128 above = dot<Int128>(normal_, seen_[0]);
                const Int128 of_point = dot<Int128>(normal_, point - triangle_.corner[0]);
                return sign(of_point) == sign(above);
            }
        }
    }
    /// The nearest point of the face is that of the body exactly if no point of the body is beyond the plane through
    /// it, across the way to the centre.
    [[nodiscard]] bool any_is_beyond(const Integer3* points, unsigned count) const {
        for (unsigned i = 0; i < count; ++i)
            if (is_beyond(points[i])) return true;
        return false;
    }
    [[nodiscard]] float weight(unsigned i) const {
        if (takes_shortcut(is_narrow_)) return to_float(dot<Int128>(inward_[i], seen_[i])) * 0x1p-60f;
        if (takes_shortcut() && largest_side_ < std::int64_t{1} << 23 &&
            sum_of_magnitudes(seen_[i]) < std::int64_t{1} << 50)
            return to_float(dot(wide_cross(normal_, side_[i]), seen_[i])) * 0x1p-60f;
        return product_difference(dot<Int128>(side_[i], side_[0]), dot<Int128>(seen_[i], side_[1]),
                                  dot<Int128>(side_[i], side_[1]), dot<Int128>(seen_[i], side_[0]))
            .to_float(-60);
    }

    [[nodiscard]] Probe probe(std::uint32_t tick) {
        look_at(tick);
        const Int128 radius = multiply(sphere_.radius << tick_bits, sphere_.radius << tick_bits);
        switch (part_) {
            case Part::corner: {
                const Int128 squared = dot<Int128>(seen_[number_], seen_[number_]);
                if (!(radius < squared)) return {true, false, 0.0f, 0.0f};
                const Int128 along = dot<Int128>(seen_[number_], sphere_.displacement);
                const float distance = square_root(to_float(squared)) * 0x1p-24f;
                return {false, along.is_negative(), distance, absolute(to_float(along)) * 0x1p-24f / distance};
            }
            case Part::side: {
                const Integer3& side = side_[number_];
                const Int128 length(length_[number_]);
                const Vec3 across = rounded_cross(seen_[number_], side);
                const float squared = dot(across, across) * 0x1p16f / to_float(length) * 0x1p16f;
                const bool touches = is_within(squared, [&] {
                    // |p x s|^2 = |p|^2 |s|^2 - (p . s)^2
                    return compare_products(dot<Int128>(seen_[number_], seen_[number_]) - radius, length, forward_,
                                            forward_);
                });
                if (touches) return {true, false, 0.0f, 0.0f};
                const float distance = square_root(squared);
                // The displacement along what of p is perpendicular to the side: (p x s) . (d x s)
                const Vec3 way_across = rounded_cross(sphere_.displacement, side);
                const float along = dot(across, way_across);
                const float error = slack * (absolute(across.x * way_across.x) + absolute(across.y * way_across.y) +
                                             absolute(across.z * way_across.z));
                const bool closing = absolute(along) > error
                                         ? along < 0.0f
                                         : compare_products(dot<Int128>(seen_[number_], sphere_.displacement), length,
                                                            forward_, dot<Int128>(side, sphere_.displacement)) < 0;
                // Times 2^56, in two halves: beside a long side what lies between would be subnormal.
                return {false, closing, distance,
                        (absolute(along) + error) * 0x1p28f / to_float(length) / distance * 0x1p28f};
            }
            default: {
                const Int128 area = dot<Int128>(normal_, normal_);
                const Int128 above = dot<Int128>(normal_, seen_[0]);
                const float length = square_root(to_float(area));
                const float distance = absolute(to_float(above)) * 0x1p-24f / length;
                if (is_within(distance * distance, [&] { return compare_products(above, above, radius, area); }))
                    return {true, false, 0.0f, 0.0f};
                const Int128 along = dot<Int128>(normal_, sphere_.displacement);
                return {false, !along.is_zero() && along.is_negative() != above.is_negative(), distance,
                        absolute(to_float(along)) / length};
            }
        }
    }
    /// Whether a squared distance is at most the squared radius; where floats do not tell, by the sign that
    /// `compare` finds of the exact difference.
    template <class Compare>
    [[nodiscard]] bool is_within(float squared, Compare compare) const {
        if (squared > squared_radius_ * (1.0f + slack)) return false;
        return squared * (1.0f + slack) < squared_radius_ || compare() <= 0;
    }

    /// Neither at low nor at high the sphere touches, and the closest approach is between them. Moves both towards it,
    /// until high touches, or nothing does, or what does lies between two ticks.
    [[nodiscard]] bool find_contact_inside() {
        for (unsigned rounds = 0; high_.tick - low_.tick > 1; ++rounds) {
            std::uint32_t tick = low_.tick + (high_.tick - low_.tick) / 2;
            if (rounds < 8) {
                // Both tangents lie below the distance, and so does every mean of them: one of these is constant.
                const float low_speed = low_.probe.speed * (1.0f + slack);
                const float high_speed = high_.probe.speed * (1.0f + slack);
                const float way = share_of_way(high_.tick - low_.tick);
                const float speeds = low_speed + high_speed;
                const float product = low_speed * (high_speed / speeds) * way;
                const float apart =
                    low_.probe.distance * (high_speed / speeds) + high_.probe.distance * (low_speed / speeds);
                if (apart * (1.0f - slack) > (radius_ + product) * (1.0f + slack)) return false;
                const float meet = (low_.probe.distance - high_.probe.distance + high_speed * way) / speeds;
                tick = tick_near(low_.tick, meet);
            } else if (rounds == 8 && !passes_within_radius()) {
                return false;
            }
            if (narrow(tick)) return true;
        }
        return passes_within_radius();
    }

    /// Puts low to a tick. Whether the sphere does not touch there, and comes nearer.
    [[nodiscard]] bool closes_at(std::uint32_t tick) {
        low_ = {tick, probe(tick)};
        return !low_.probe.touches && low_.probe.closing;
    }

    /// High touches, low does not: until they are neighbours.
    void close_in() {
        std::uint32_t margin = 0;
        for (unsigned rounds = 0; high_.tick - low_.tick > 1; ++rounds) {
            std::uint32_t tick = low_.tick + (high_.tick - low_.tick) / 2;
            if (rounds < 12) {
                const float left = low_.probe.distance - radius_;
                tick = tick_near(low_.tick + margin, left / low_.probe.speed);
                margin = 2 * margin + 1;
            }
            (void)narrow(tick);
        }
    }

    /// A tick between low and high: so far after one of them, if that lies there.
    [[nodiscard]] std::uint32_t tick_near(std::uint32_t from, float after) const {
        const std::uint32_t last = high_.tick - 1;
        const float ticks = after * 0x1p24f;
        if (!(ticks < 0x1p24f)) return last;
        const std::uint32_t tick = from + (ticks > 0.0f ? static_cast<std::uint32_t>(ticks) : 0);
        return tick <= low_.tick ? low_.tick + 1 : tick < last ? tick : last;
    }
    /// Puts one of the bounds to that tick. Whether the sphere touches there.
    bool narrow(std::uint32_t tick) {
        const Bound bound = {tick, probe(tick)};
        (!bound.probe.touches && bound.probe.closing ? low_ : high_) = bound;
        return bound.probe.touches;
    }

    /// Whether the line of the path comes within the radius of the triangle, exactly: the closest approach is known to
    /// lie on the path. Seen along the displacement the line is a point and the triangle a triangle.
    [[nodiscard]] ESPALIER_NOINLINE bool passes_within_radius() const {
        const Integer3& d = sphere_.displacement;
        const Int128 radius = multiply(sphere_.radius, sphere_.radius);
        const Int128 way = dot<Int128>(d, d);
        Int128 volume[3];
        int positive = 0;
        int negative = 0;
        for (unsigned i = 0; i < 3; ++i) {
            const Integer3& m = triangle_.corner[i];
            const Int128 along = dot<Int128>(m, d);
            if (compare_products(dot<Int128>(m, m) - radius, way, along, along) <= 0) return true;
            volume[i] = dot<Int128>(d, cross(m, side_[i]));
            positive += Int128(0) < volume[i] ? 1 : 0;
            negative += volume[i].is_negative() ? 1 : 0;
        }
        if (positive == 3 || negative == 3) return true;
        for (unsigned i = 0; i < 3; ++i) {
            const Integer3& side = side_[i];
            const Int128 both = dot<Int128>(d, side);
            // Where on the side the line is closest, times |d x s|^2: (m x d) . (d x s) = (m . d)(d . s) - (m . s)
            // |d|^2
            const auto place = [&](const Integer3& m) {
                return compare_products(dot<Int128>(m, d), both, dot<Int128>(m, side), way);
            };
            if (place(triangle_.corner[i]) < 0 || place(triangle_.corner[(i + 1) % 3]) > 0) continue;
            const Integer3 across = cross(d, side);
            const Int128 squared = dot<Int128>(across, across);
            if (!squared.is_zero() && compare_products(volume[i], volume[i], radius, squared) <= 0) return true;
        }
        return false;
    }

    [[nodiscard]] Vec3 normal_against_displacement() const {
        const Integer3& d = sphere_.displacement;
        if (!is_zero(normal_)) return unit_along(normal_, Int128(0) < dot<Int128>(normal_, d));
        return is_zero(d) ? Vec3{0.0f, 0.0f, 1.0f} : unit_along(d, true);
    }

    const MovingSphere& sphere_;
    const IntegerTriangle& triangle_;
    float radius_;
    float squared_radius_;
    Integer3 side_[3];        ///< from each corner to the next
    std::int64_t length_[3];  ///< squared
    Integer3 normal_;
    Integer3 inward_[3];         ///< in the plane, perpendicular to each side; where it is narrow
    Vec3 rounded_inward_[3];     ///< elsewhere
    float inward_error_ = 0.0f;  ///< by how much a product with these is off at most, for coordinates that add up to 1
    std::int64_t largest_side_;  ///< no coordinate of a side is larger
    bool is_narrow_;
    // What look_at found.
    Integer3 seen_[3];
    Part part_ = Part::face;
    unsigned number_ = 0;  ///< of the corner or side
    Int128 forward_;       ///< from the side's start along it, times its length
    Bound low_{};          ///< not touching, closing
    Bound high_{};         ///< touching, or not closing
};

}  // namespace

SweepTick first_contact_tick(const MovingSphere& sphere, const IntegerTriangle& triangle, SweepTick most,
                             SweepTick least) noexcept {
    return Approach(sphere, triangle).first_contact_tick(least, most);
}

SweepContact contact_at(const MovingSphere& sphere, const IntegerTriangle& triangle, std::uint32_t tick) noexcept {
    return Approach(sphere, triangle).contact_at(tick);
}

bool is_nearest_face(const MovingSphere& sphere, const IntegerTriangle& face, const Integer3* points, unsigned count,
                     std::uint32_t tick) noexcept {
    return Approach(sphere, face).is_nearest(tick, points, count);
}

Departure departure_from(const MovingSphere& sphere, const IntegerTriangle& face, const Integer3* points,
                         unsigned count) noexcept {
    return Approach({sphere.displacement, 0}, face).departure(points, count);
}

}  // namespace espalier::detail
