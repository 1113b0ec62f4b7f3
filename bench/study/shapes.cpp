#include "shapes.hpp"

namespace espalier::bench {

const std::array<Point, slab_count> slab_directions = {{{1, 0, 0},
                                                        {0, 1, 0},
                                                        {0, 0, 1},
                                                        {1, 1, 0},
                                                        {1, -1, 0},
                                                        {1, 0, 1},
                                                        {1, 0, -1},
                                                        {0, 1, 1},
                                                        {0, 1, -1},
                                                        {1, 1, 1},
                                                        {1, 1, -1},
                                                        {1, -1, 1},
                                                        {1, -1, -1}}};

Block box_along(const std::array<Point, 3>& axes, std::span<const Point> points) {
    Block block;
    block.axes = axes;
    block.center = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        double lo = std::numeric_limits<double>::max();
        double hi = -lo;
        for (const Point& p : points) {
            lo = std::min(lo, dot(axes[k], p));
            hi = std::max(hi, dot(axes[k], p));
        }
        block.half[k] = 0.5 * (hi - lo);
        block.center = block.center + (0.5 * (hi + lo)) * axes[k];
    }
    return block;
}

double area_of(const Block& block) {
    return 8.0 * (block.half[0] * block.half[1] + block.half[1] * block.half[2] + block.half[2] * block.half[0]);
}

double volume_of(const Block& block) { return 8.0 * block.half[0] * block.half[1] * block.half[2]; }

namespace {

constexpr double pi = 3.14159265358979323846;

/// Returns the point that is the farthest from `center`.
Point farthest_from(const Point& center, std::span<const Point> points) {
    return *std::max_element(points.begin(), points.end(), [&](const Point& a, const Point& b) {
        return dot(a - center, a - center) < dot(b - center, b - center);
    });
}

/// Searches the center in steps towards the farthest of the outermost points (Badoiu, Clarkson 2003; Larsson 2008), to
/// less than 1 % of the least radius for these. The ball contains all points.
Ball fit_ball(std::span<const Point> points, std::span<const Point> outermost) {
    constexpr int steps = 300;
    Ball ball{outermost[0], 0.0};
    for (int i = 0; i < steps; ++i)
        ball.center = ball.center + (1.0 / (i + 2.0)) * (farthest_from(ball.center, outermost) - ball.center);
    const Point out = farthest_from(ball.center, points) - ball.center;
    ball.radius = std::sqrt(dot(out, out));
    return ball;
}

std::array<Point, 3> axes_of(double w, double x, double y, double z) {
    const double n = 1.0 / (w * w + x * x + y * y + z * z);
    return {{{n * (w * w + x * x - y * y - z * z), n * 2 * (x * y + w * z), n * 2 * (x * z - w * y)},
             {n * 2 * (x * y - w * z), n * (w * w - x * x + y * y - z * z), n * 2 * (y * z + w * x)},
             {n * 2 * (x * z + w * y), n * 2 * (y * z - w * x), n * (w * w - x * x - y * y + z * z)}}};
}

/// A pattern search over rotations from several starts, on the outermost points alone.
Block fit_block(std::span<const Point> points, std::span<const Point> outermost, const Block& aligned) {
    Block best = aligned;
    for (int start = 0; start < 9; ++start) {
        std::array<double, 4> at = {start == 0 ? 1.0 : 2.0, 0.0, 0.0, 0.0};
        if (start != 0)
            for (std::size_t k = 0; k < 3; ++k) at[k + 1] = ((start - 1) >> k & 1) != 0 ? 0.8 : -0.8;
        const auto area = [&](const std::array<double, 4>& q) {
            return area_of(box_along(axes_of(q[0], q[1], q[2], q[3]), outermost));
        };
        double here = area(at);
        for (double turn = 0.3; turn > 0.004;) {
            std::array<double, 4> next = at;
            double least = here;
            for (std::size_t axis = 0; axis < 6; ++axis) {
                const double t = axis % 2 == 0 ? turn : -turn;
                const double r[3] = {axis / 2 == 0 ? t : 0.0, axis / 2 == 1 ? t : 0.0, axis / 2 == 2 ? t : 0.0};
                const auto [w, x, y, z] = at;
                const std::array<double, 4> there = {
                    w - r[0] * x - r[1] * y - r[2] * z, x + r[0] * w + r[1] * z - r[2] * y,
                    y + r[1] * w + r[2] * x - r[0] * z, z + r[2] * w + r[0] * y - r[1] * x};
                const double value = area(there);
                if (value < least) least = value, next = there;
            }
            if (least < here) at = next, here = least;
            else turn *= 0.5;
        }
        const Block found = box_along(axes_of(at[0], at[1], at[2], at[3]), points);
        if (area_of(found) < area_of(best)) best = found;
    }
    return best;
}

/// Adds up the faces of the polytope.
Extent dop_extent(std::span<const std::size_t> slabs, const Volumes& volumes) {
    const Point& middle = volumes.aligned.center;  // so that numbers are as small as the body
    std::vector<baker::HalfSpace> half_spaces;
    for (const std::size_t slab : slabs) {
        const Point& d = slab_directions[slab];
        half_spaces.push_back({d, volumes.slabs.hi[slab] - dot(d, middle)});
        half_spaces.push_back({-1.0 * d, dot(d, middle) - volumes.slabs.lo[slab]});
    }
    Extent extent;
    const auto& half = volumes.aligned.half;
    for (const auto& face : baker::faces_of(half_spaces, half[0] + half[1] + half[2])) {
        for (std::size_t i = 2; i < face.size(); ++i) {
            const Point across = cross(face[i - 1] - face[0], face[i] - face[0]);
            extent.area += 0.5 * std::sqrt(dot(across, across));
            extent.volume += std::abs(dot(face[0], cross(face[i - 1], face[i]))) / 6.0;
        }
    }
    return extent;
}

}  // namespace

Volumes fit_volumes(std::span<const Point> points) {
    Volumes volumes;
    volumes.aligned = box_along({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, points);
    std::vector<Point> outermost;
    for (std::size_t k = 0; k < slab_count; ++k) {
        const Point& d = slab_directions[k];
        const auto [low, high] = std::minmax_element(
            points.begin(), points.end(), [&](const Point& a, const Point& b) { return dot(d, a) < dot(d, b); });
        volumes.slabs.lo[k] = dot(d, *low);
        volumes.slabs.hi[k] = dot(d, *high);
        outermost.insert(outermost.end(), {*low, *high});
    }
    volumes.ball = fit_ball(points, points.size() > outermost.size() ? std::span<const Point>(outermost) : points);
    volumes.oriented = fit_block(points, outermost, volumes.aligned);
    return volumes;
}

Extent extent_of(Kind kind, const Volumes& volumes) {
    switch (kind) {
        case Kind::sphere: {
            const double r = volumes.ball.radius;
            return {4.0 * pi * r * r, 4.0 / 3.0 * pi * r * r * r};
        }
        case Kind::aabb:
            return {area_of(volumes.aligned), volume_of(volumes.aligned)};
        case Kind::obb:
            return {area_of(volumes.oriented), volume_of(volumes.oriented)};
        case Kind::dop_14:
            return dop_extent(dop_slabs<14>(), volumes);
        case Kind::dop_18:
            return dop_extent(dop_slabs<18>(), volumes);
        case Kind::dop_26:
            return dop_extent(dop_slabs<26>(), volumes);
    }
    return {};
}

}  // namespace espalier::bench
