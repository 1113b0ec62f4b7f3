// Claims about the bounds in lanes of sweeps: they are never late, and tight enough to be of use. Here with one lane;
// sweep_test.cpp runs all instruction sets.
#include "support/testing.hpp"

#include <runtime/sweeps/capsule_bounds.hpp>
#include <runtime/sweeps/hull_bounds.hpp>
#include <runtime/sweeps/leaf_bounds.hpp>
#include <runtime/sweeps/queries.hpp>
#include <runtime/sweeps/separating_directions.hpp>

using namespace espalier;
using namespace espalier::tests;
using detail::BoxSweep;
using detail::CapsuleSweep;
using detail::HullSweep;
using detail::Integer3;
using detail::LatticeTriangle;
using detail::no_contact;
using detail::SweepTick;
using detail::whole_way;

namespace {

/// Triangles of a lattice, and shapes that move towards them.
class Cases {
public:
    Cases(const OpenedBlob& opened, unsigned bits, std::uint64_t seed)
        : blob_(detail::data_of(opened.blob)), bits_(bits), random_(seed) {}

    void make_triangle() {
        size_ = 1 + random_.below(bits_);
        Integer3 corner[3];
        const Integer3 low = some_point(0, std::int64_t{1} << bits_);
        for (Integer3& c : corner) c = low + some_point(-(std::int64_t{1} << size_) / 2, std::int64_t{1} << size_);
        const auto kind = random_.below(8);
        if (kind == 0)
            for (Integer3& c : corner) c.z = corner[0].z;
        else if (kind == 1) corner[2] = middle(corner[0], corner[1]);
        else if (kind == 2) corner[1] = corner[0];
        else if (kind == 3) {  // sides along axes
            corner[1] = {corner[0].x + 1 + random_.below(1u << size_), corner[0].y, corner[0].z};
            corner[2] = {corner[0].x, corner[0].y + 1 + random_.below(1u << size_), corner[0].z};
        } else if (kind == 4) {  // slim
            corner[2] = corner[1] + some_point(-1, 3);
        }
        const std::int64_t most = (std::int64_t{1} << bits_) - 1;
        for (unsigned i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                triangle_.corner[i][k] = static_cast<std::int32_t>(std::clamp<std::int64_t>(corner[i][k], 0, most));
    }
    CapsuleSweep capsule() {
        CapsuleSweep sweep;
        const Integer3 way = some_way(sweep);
        const std::int64_t radius = some_radius();
        Integer3 axis = random_.coin() ? Integer3{0, 0, 0} : some_point(-reach() / 2, reach());
        const auto kind = random_.below(5);
        if (kind == 0) axis = side();
        else if (kind == 1) axis.x = axis.y = 0;
        const Integer3 start = some_start(way, radius) - (random_.coin() ? axis : Integer3{0, 0, 0});
        sweep.from = start;
        sweep.moving = {{way, radius}, axis};
        const Integer3 around = {radius, radius, radius};
        sweep.low = smaller(start, start + axis) - around;
        sweep.high = larger(start, start + axis) + around;
        return sweep;
    }
    BoxSweep box() {
        BoxSweep sweep;
        const Integer3 way = some_way(sweep);
        Integer3 size = some_point(0, 1 + 2 * some_radius());
        if (random_.below(4) == 0) size.y = 0;
        sweep.low = some_start(way, size.x / 2);
        sweep.high = sweep.low + size;
        return sweep;
    }

    /// A box of any orientation, or points around a place.
    HullSweep hull() {
        HullSweep sweep;
        Integer3 way = some_way(sweep);
        while (detail::sum_of_magnitudes(way) >= std::int64_t{1} << 28) way = {way.x / 2, way.y / 2, way.z / 2};
        sweep.displacement = way;
        const std::int64_t radius = some_radius();
        const Integer3 start = some_start(way, radius);
        const auto some = [&] { return some_point(-radius, 2 * radius + 1); };
        std::vector<Integer3> points;
        sweep.is_box = random_.coin();
        if (sweep.is_box) {
            const Integer3 half[3] = {random_.below(4) == 0 ? side() : some(), some(), some()};
            for (unsigned i = 0; i < 8; ++i) {
                Integer3 corner = start;
                for (unsigned k = 0; k < 3; ++k) corner = (i >> k & 1u) != 0 ? corner + half[k] : corner - half[k];
                points.push_back(corner);
            }
        } else {
            const unsigned count = 1 + random_.below(random_.below(4) == 0 ? max_hull_vertices : 16);
            for (unsigned i = 0; i < count; ++i) points.push_back(start + some());
        }
        sweep.moving.displacement = way;
        sweep.moving.point_count = static_cast<unsigned>(points.size());
        sweep.low = sweep.high = points[0];
        for (unsigned i = 0; i < points.size(); ++i) {
            for (int k = 0; k < 3; ++k) sweep.moving.point[i][k] = static_cast<std::int32_t>(points[i][k]);
            sweep.low = smaller(sweep.low, points[i]);
            sweep.high = larger(sweep.high, points[i]);
        }
        return sweep;
    }

    [[nodiscard]] const detail::BlobData& blob() const { return blob_; }
    [[nodiscard]] const LatticeTriangle& triangle() const { return triangle_; }

private:
    /// In units of the sweep.
    [[nodiscard]] std::int64_t reach() const { return std::int64_t{1} << (static_cast<int>(size_) + fraction_bits_); }
    Integer3 some_point(std::int64_t low, std::int64_t count) {
        const auto some = [&] {
            return low + static_cast<std::int64_t>(random_.next() % static_cast<std::uint64_t>(count));
        };
        const std::int64_t x = some(), y = some();
        return {x, y, some()};
    }
    static Integer3 middle(const Integer3& a, const Integer3& b) {
        return {(a.x + b.x) >> 1, (a.y + b.y) >> 1, (a.z + b.z) >> 1};
    }
    [[nodiscard]] Integer3 corner(unsigned i) const {
        return detail::corner_on_grid(triangle_, static_cast<int>(i), fraction_bits_);
    }
    [[nodiscard]] Integer3 side() const { return corner(1) - corner(0); }
    Integer3 some_way(detail::LatticeSweep& sweep) {
        fraction_bits_ = static_cast<int>(random_.below(bits_ < 18 ? 7 : 1));
        sweep.fraction_bits = fraction_bits_;
        Integer3 way = some_point(-reach(), 2 * reach());
        switch (random_.below(8)) {
            case 0:
                way = {0, 0, 0};
                break;
            case 1:
                way.x = way.y = 0;
                break;
            case 2:
                way = side();
                break;
            case 3: {
                const std::int64_t factor = std::int64_t{1} << random_.below(31 - bits_);
                way = {way.x * factor, way.y * factor, way.z * factor};
                break;
            }
            default:
                break;
        }
        sweep.displacement = way;
        return way;
    }
    std::int64_t some_radius() {
        const auto kind = random_.below(4);
        if (kind == 0) return 0;
        if (kind == 1) return 1 + random_.below(4);
        return static_cast<std::int64_t>(random_.next() % static_cast<std::uint64_t>(reach()));
    }
    /// At some time the shape is about as far from a place on the triangle as its radius.
    Integer3 some_start(const Integer3& way, std::int64_t radius) {
        Integer3 target = middle(corner(random_.below(3)), corner(random_.below(3)));
        if (random_.coin()) target = middle(target, corner(2));
        const std::int64_t part = random_.below(6);  // of the way, in quarters: at the end and behind it too
        const Integer3 off = some_point(-radius - 1, 2 * radius + 3);
        return target + off - Integer3{way.x * part / 4, way.y * part / 4, way.z * part / 4};
    }

    const detail::BlobData& blob_;
    unsigned bits_;
    Random random_;
    unsigned size_ = 1;
    int fraction_bits_ = 0;
    LatticeTriangle triangle_{};
};

struct Outcome {
    std::uint64_t hits = 0, misses = 0;
    std::uint64_t rejected = 0;  ///< misses that the bound excludes
    std::uint64_t close = 0;     ///< hits whose bound is within a thousandth of the way
};

/// A triangle as lanes see it.
detail::scalar::CornersFromPoint seen_in_lanes(const detail::FloatSweep& lanes, const LatticeTriangle& triangle) {
    detail::scalar::Floats3 corners[3];
    for (unsigned i = 0; i < 3; ++i) {
        float at[3];
        for (int k = 0; k < 3; ++k) at[k] = static_cast<float>(triangle.corner[i][k]) * lanes.scale - lanes.from[k];
        corners[i] = {at[0], at[1], at[2]};
    }
    return {corners[0], corners[1], corners[2]};
}
/// The time that lanes give a triangle, as they do for a leaf.
template <class Bounds, class FloatShape>
float time_of(const FloatShape& lanes, const LatticeTriangle& triangle) {
    using namespace detail::scalar;
    const CornersFromPoint t = seen_in_lanes(lanes, triangle);
    float time = 0.0f;
    if (SweptBox(lanes).meet(t, 1.0f, &time) == 0) return 2.0f;
    if (lanes.is_far) return time;
    const Bounds bounds(lanes);
    return LaterBounds<Bounds>(bounds, lanes, std::max(time - 0x1p-20f, 0.0f))(t);
}

template <class Sweep>
void check(const Cases& cases, const Sweep& sweep, float time, Outcome& outcome) {
    const SweepTick step = first_contact_tick(sweep, cases.triangle(), whole_way);
    if (step == no_contact) {
        ++outcome.misses;
        outcome.rejected += time > 1.0f ? 1u : 0u;
        return;
    }
    ++outcome.hits;
    outcome.close += detail::share_of_way(step) - time < 0.001f ? 1u : 0u;
    if (!(time <= detail::share_of_way(step))) {
        const LatticeTriangle& t = cases.triangle();
        std::string words = "step " + std::to_string(step) + ", time " + std::to_string(time * 0x1p24f);
        for (const auto& corner : t.corner)
            for (const std::int32_t x : corner) words += " " + std::to_string(x);
        const auto add = [&](const Integer3& p) {
            words += " | " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
        };
        add(sweep.low);
        add(sweep.high);
        add(sweep.displacement);
        words += " | " + std::to_string(sweep.fraction_bits);
        FAIL_CHECK(words);
    }
}

/// The same of a direction that may separate both until a step. The triangle meets the box that goes the same way.
void check_beside(const Cases& cases, const CapsuleSweep& sweep, SweepTick step, SweepTick most, Outcome& outcome) {
    using namespace detail::scalar;
    const auto lanes = detail::float_shape(cases.blob(), sweep);
    const CornersFromPoint t = seen_in_lanes(lanes, cases.triangle());
    const float limit = detail::share_of_way(most);
    float time = 0.0f;
    if (SweptBox(lanes).meet(t, limit, &time) == 0) return;
    const bool may_touch = BesideWay(lanes, limit).meet(t) != 0;
    if (step == no_contact || step > most) {
        ++outcome.misses;
        outcome.rejected += may_touch ? 0u : 1u;
        return;
    }
    ++outcome.hits;
    if (!may_touch) FAIL_CHECK("touched at step ", step, " of ", most);
}

/// Calls use(cases) with triangles of coarse and of fine lattices, `count` times for each.
template <class Use>
void for_each_case(std::uint64_t count, Use use) {
    for (const unsigned bits : {8u, 16u, 24u}) {
        const OpenedBlob opened(make_cube(-1.0f, 1.0f), {.resolution = Resolution::bits(bits)});
        Cases cases(opened, bits, bits);
        for (std::uint64_t i = 0; i < count; ++i) {
            cases.make_triangle();
            use(cases);
        }
    }
}

}  // namespace

TEST_SUITE("bounds") {
    TEST_CASE("sweep: bounds in lanes are never later than the first contact and mostly close to it") {
        Outcome capsules, boxes, hulls, frames;
        const std::uint64_t count = scaled_share(200'000);
        for_each_case(count, [&](Cases& cases) {
            const CapsuleSweep capsule = cases.capsule();
            const auto float_shape = detail::float_shape(cases.blob(), capsule);
            check(cases, capsule, time_of<detail::scalar::CapsuleBounds>(float_shape, cases.triangle()), capsules);
            check(cases, capsule, detail::SeparatingDirections(float_shape).bound(cases.triangle(), 1.0f), frames);
            const BoxSweep box = cases.box();
            const auto box_in_lanes = detail::float_shape(cases.blob(), box);
            check(cases, box, time_of<detail::scalar::BoxBounds>(box_in_lanes, cases.triangle()), boxes);
            const detail::HullSweep hull = cases.hull();
            const auto hull_in_lanes = detail::float_shape(cases.blob(), hull);
            check(cases, hull, time_of<detail::scalar::HullBounds>(hull_in_lanes, cases.triangle()), hulls);
        });
        for (const Outcome& outcome : {capsules, boxes, hulls, frames}) {
            MESSAGE(outcome.hits, " hits, ", outcome.close, " close; ", outcome.misses, " misses, ", outcome.rejected,
                    " rejected");
            if (!asks_enough()) continue;
            CHECK(outcome.hits > count / 2);
            CHECK(outcome.misses > count / 10);
        }
    }

    TEST_CASE("sweep: triangles beside the way of a capsule are not touched up to a step") {
        Outcome outcome;
        const std::uint64_t count = scaled_share(200'000);
        Random random(8);
        for_each_case(count, [&](Cases& cases) {
            const CapsuleSweep capsule = cases.capsule();
            // At some step, and most often at the one of the first contact.
            const SweepTick step = first_contact_tick(capsule, cases.triangle(), whole_way);
            const SweepTick most = step != no_contact && random.below(4) != 0 ? step : random.below(whole_way + 1);
            check_beside(cases, capsule, step, most, outcome);
        });
        MESSAGE(outcome.hits, " hits; ", outcome.misses, " misses, ", outcome.rejected, " beside the way");
        if (!asks_enough()) return;
        CHECK(outcome.hits > count / 2);
        CHECK(outcome.misses > count / 10);
        CHECK(outcome.rejected > outcome.misses / 10);
    }
}
