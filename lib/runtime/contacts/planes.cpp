// The planes that hold a capsule back, and the way along them.
#include <espalier/contact.hpp>
#include <runtime/contacts/bodies.hpp>
#include <runtime/contacts/surface_around.hpp>
#include <runtime/contacts/touch.hpp>
#include <runtime/kernels/segment_triangle.hpp>
#include <runtime/traversal/find_triangle.hpp>

namespace espalier {

using namespace detail;
using detail::contacts::BodyOf;
using detail::contacts::NearTriangle;
using detail::contacts::NearTriangles;
using detail::contacts::Part;
using detail::contacts::Touches;

namespace {

bool comes_first(const ContactPlane& a, const ContactPlane& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.triangle < b.triangle);
}

/// The planes that were chosen so far, in the array of the caller.
class ChosenPlanes {
public:
    ChosenPlanes(std::span<ContactPlane> room, float reach) : room_(room), reach_(reach) {}

    /// Whether one of them, none of which is farther, says the same for every way that is no longer than the reach, but
    /// for a 256th of that.
    [[nodiscard]] bool imply(const ContactPlane& plane) const {
        for (const ContactPlane& other : room_.first(count_)) {
            const Vec3 turn = plane.normal - other.normal;
            const float apart = plane.distance - other.distance, reach = reach_ + maximum(-other.distance, 0.0f);
            if ((square_root(dot(turn, turn)) - 1.0f / 256.0f) * reach <= apart) return true;
        }
        return false;
    }
    /// Returns whether there was room.
    bool add(const ContactPlane& plane) {
        if (count_ == room_.size()) return false;
        room_[count_++] = plane;
        return true;
    }
    [[nodiscard]] std::size_t count() const { return count_; }

private:
    std::span<ContactPlane> room_;
    std::size_t count_ = 0;
    float reach_;
};

/// Those planes of a walk that come first after a given one.
class NextPlanes {
public:
    void begin_after(const ContactPlane& plane) {
        after_ = plane;
        count_ = 0;
        is_any_left_ = false;
    }
    /// Whether a plane with no smaller distance is not kept.
    [[nodiscard]] bool rules_out(float distance) const {
        return count_ == most && distance > plane_[most - 1].distance;
    }
    void add(const ContactPlane& plane) {
        if (!comes_first(after_, plane)) return;
        unsigned place = count_;
        if (count_ == most) {
            is_any_left_ = true;
            if (!comes_first(plane, plane_[most - 1])) return;
            --place;
        } else {
            ++count_;
        }
        for (; place > 0 && comes_first(plane, plane_[place - 1]); --place) plane_[place] = plane_[place - 1];
        plane_[place] = plane;
    }
    void leave_out() { is_any_left_ = true; }
    [[nodiscard]] bool is_any_left() const { return is_any_left_; }
    [[nodiscard]] std::span<const ContactPlane> planes() const { return {plane_.data(), count_}; }

private:
    static constexpr unsigned most = small_code ? 8 : 32;

    ContactPlane after_ = {{}, -infinity, TriangleId{0}};
    Uninitialised<ContactPlane, most> plane_;
    unsigned count_ = 0;
    bool is_any_left_ = false;
};

/// A triangle near the axis of a capsule; `nearest` is the squared distance, in lattice steps.
struct NearAxis : NearTriangle {
    SegmentDistance distance;
};

/// Takes the triangles near a capsule from a walk, and adds the planes of those where the surface is locally nearest.
class PlanesOf : public Each {
public:
    PlanesOf(const BlobData& from, BodyOf<Capsule>& body, float margin, const TriangleVisitor& by_id,
             const ChosenPlanes& chosen, NextPlanes& into)
        : Each(from, by_id), body_(body), margin_(margin), chosen_(chosen), planes_(into) {
        on_triangle = [](Each& self, std::uint32_t index, const LatticeTriangle& triangle) {
            return static_cast<PlanesOf&>(self).take(index, triangle);
        };
    }
    Visit take(std::uint32_t index, const LatticeTriangle& triangle) {
        const SegmentDistance distance = distance_to(body_.segment, triangle);
        if (distance.squared > 0.0f && planes_.rules_out(to_local_distance(square_root(distance.squared)))) {
            planes_.leave_out();  // and what it makes a ghost is no nearer
            return Visit::next;
        }
        if (waiting_.are_full()) add_waiting(false);
        waiting_.add({{index, triangle, distance.squared}, distance});
        return Visit::next;
    }
    void add_waiting(bool is_last) {
        are_all_waiting_ = are_all_waiting_ && is_last;
        const std::span<NearAxis> all = are_all_waiting_ ? waiting_.all() : std::span<NearAxis>();
        for (const NearAxis& near : waiting_.all())
            if (!is_ghost(near, all)) add(near);
        waiting_.clear();
    }

private:
    /// Whether another triangle at the same edge or corner is nearer, or as near with a lower index.
    [[nodiscard]] bool is_ghost(const NearAxis& near, std::span<NearAxis> all) const {
        if (near.distance.feature == Feature::face || near.nearest == 0.0f) return false;
        const Part part(near.distance.feature);
        const std::int32_t *const from = near.triangle.corner[part.from], *const to = near.triangle.corner[part.to];
        const auto is_nearer = [&](const NearTriangle& other) {
            return other.nearest < near.nearest || (other.nearest == near.nearest && other.index < near.index);
        };
        return contacts::visit_around(blob, all, near.triangle, part, [&](NearTriangle& other) {
            if (other.nearest != -infinity && !is_nearer(other)) return Visit::next;
            if (contacts::corner_at(other.triangle, from) == 3 || contacts::corner_at(other.triangle, to) == 3)
                return Visit::next;
            if (other.nearest == -infinity) other.nearest = distance_to(body_.segment, other.triangle).squared;
            return is_nearer(other) ? Visit::stop : Visit::next;
        });
    }
    void add(const NearAxis& near) {
        contacts::FacingSide side;
        side.is_back = is_origin_behind(body_.seen(near.triangle));
        Touches touches;
        touch_nearest(body_.segment, near.triangle, near.distance, side, touches);
        const contacts::Touch& nearest = touches.touch[0];
        const ContactPlane plane = {nearest.normal, to_local_distance(nearest.distance), TriangleId{near.index}};
        if (!chosen_.imply(plane)) planes_.add(plane);  // so that each walk adds one
    }
    [[nodiscard]] float to_local_distance(float of_axis) const {
        return minimum(scale_by_power_of_two(of_axis, blob.step_exponent) - body_.least_reach, margin_);
    }

    BodyOf<Capsule>& body_;
    float margin_;
    const ChosenPlanes& chosen_;
    NextPlanes& planes_;
    NearTriangles<NearAxis, 64> waiting_;
    bool are_all_waiting_ = true;  ///< all that were taken
};

}  // namespace

Filled collect_planes(const Blob& blob, const Capsule& capsule, float margin, std::span<ContactPlane> planes) noexcept {
    if (!blob) return {};
    if (!is_radius(capsule.radius) || !is_finite(capsule.radius) || !is_radius(margin) || !is_finite(margin))
        return {0, {}, QueryStatus::invalid_argument};
    const BlobData& data = data_of(blob);
    BodyOf<Capsule> body;
    const QueryStatus rounded = body.round(data, capsule, margin);
    if (rounded != QueryStatus::ok) return {0, {}, rounded};
    ChosenPlanes chosen(planes, capsule.radius + margin);
    NextPlanes next;
    for (;;) {
        PlanesOf* self = nullptr;
        // Where the leaf is not at hand, on small cores, the triangle is searched.
        const auto search = [&](TriangleId id) { return self->take(id.index, find_triangle(data, id.index)); };
        PlanesOf answer(data, body, margin, search, chosen, next);
        self = &answer;
        const QueryStatus status = body.functions->find_near(data, body.shape, margin, answer);
        if (is_refused(status)) return {0, {}, status};
        answer.add_waiting(true);
        for (const ContactPlane& plane : next.planes())
            if (!chosen.imply(plane) && !chosen.add(plane)) return {chosen.count(), {}, QueryStatus::output_full};
        if (!next.is_any_left()) return {chosen.count(), {}, QueryStatus::ok};
        next.begin_after(next.planes().back());
    }
}

namespace {

/// The ways that planes allow: the intersection of half-spaces.
class AllowedWays {
public:
    AllowedWays(std::span<const ContactPlane> planes, const Vec3& wish, float skin)
        : planes_(planes), wish_(wish), skin_(skin) {
        float size = largest(wish) + skin;
        for (const ContactPlane& plane : planes) size = maximum(size, absolute(plane.distance));
        rounding_ = size * 0x1p-20f;
    }

    /// Finds the allowed way that is nearest to the wish, one plane after the other: where the nearest of those before
    /// is not allowed, the new one lies in the plane (Seidel 1991).
    bool find_nearest(Vec3& way) const {
        way = wish_;
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            if (lack(i, way) <= rounding_) continue;
            way = wish_ + planes_[i].normal * lack(i, wish_);
            for (std::size_t k = 0; k < i; ++k)
                if (lack(k, way) > rounding_ && !find_nearest_in_both(i, k, way)) return false;
        }
        return true;
    }

private:
    /// How far a way is beyond a plane.
    [[nodiscard]] float lack(std::size_t plane, const Vec3& way) const {
        return skin_ - planes_[plane].distance - dot(planes_[plane].normal, way);
    }
    /// The nearest way in two planes that those before plane k allow.
    bool find_nearest_in_both(std::size_t i, std::size_t k, Vec3& way) const {
        const Vec3 &a = planes_[i].normal, &b = planes_[k].normal;
        const Vec3 across = cross(a, b);
        const float squared = dot(across, across), cosine = dot(a, b);
        if (squared < 0x1p-20f) {  // nearly parallel: the farther one decides, or there is no room between them
            way = way + a * lack(k, way);
            return cosine > 0.0f;
        }
        const float of_a = lack(i, wish_), of_b = lack(k, wish_);
        const Vec3 start = wish_ + a * ((of_a - of_b * cosine) / squared) + b * ((of_b - of_a * cosine) / squared);
        const Vec3 along = across * (1.0f / square_root(squared));
        float low = -infinity, high = infinity;
        for (std::size_t other = 0; other < k; ++other) {
            const float slope = dot(planes_[other].normal, along), missing = lack(other, start);
            if (absolute(slope) > 0x1p-20f) {
                const float share = missing / slope;
                if (slope > 0.0f) low = maximum(low, share);
                else high = minimum(high, share);
            } else if (missing > rounding_) {
                return false;
            }
        }
        way = start + along * (low > 0.0f ? low : high < 0.0f ? high : 0.0f);
        return low <= high + rounding_;
    }

    std::span<const ContactPlane> planes_;
    Vec3 wish_;
    float skin_;
    float rounding_;
};

}  // namespace

Result<Vec3> solve_planes(std::span<const ContactPlane> planes, Vec3 wish, float skin) noexcept {
    bool is_valid = is_finite(wish) && is_radius(skin) && is_finite(skin);
    for (const ContactPlane& plane : planes)
        is_valid = is_valid && is_finite(plane.normal) && is_finite(plane.distance);
    if (!is_valid) return {{}, QueryStatus::invalid_argument};
    Vec3 way;
    const bool is_found = AllowedWays(planes, wish, skin).find_nearest(way);
    if (!is_found || !is_finite(way)) return {{}, QueryStatus::not_found};
    return {way, QueryStatus::ok};
}

}  // namespace espalier
