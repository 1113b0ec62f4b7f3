#include "fits.hpp"
#include "hull.hpp"

namespace espalier::bench {
namespace {

double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double distance(const PlanePoint& a, const PlanePoint& b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// Drops corners that are so close to the one before that the direction between them is made of rounding.
void drop_short_edges(std::vector<PlanePoint>& polygon) {
    constexpr double shortest_share = 0x1p-40;
    double size = 0.0;
    for (const PlanePoint& p : polygon) size = std::max(size, distance(polygon.front(), p));
    const auto is_short = [&](const PlanePoint& a, const PlanePoint& b) {
        return distance(a, b) <= shortest_share * size;
    };
    polygon.erase(std::unique(polygon.begin(), polygon.end(), is_short), polygon.end());
    while (polygon.size() > 1 && is_short(polygon.back(), polygon.front())) polygon.pop_back();
}

}  // namespace

void reduce_to_polygon(std::vector<PlanePoint>& points) {
    std::sort(points.begin(), points.end(), [](const PlanePoint& a, const PlanePoint& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.number < b.number;
    });
    const auto is_same_place = [](const PlanePoint& a, const PlanePoint& b) { return a.x == b.x && a.y == b.y; };
    points.erase(std::unique(points.begin(), points.end(), is_same_place), points.end());
    if (points.size() < 3) return drop_short_edges(points);
    std::vector<PlanePoint> chain;
    chain.reserve(points.size() + 1);
    const auto extend = [&](const PlanePoint& p, std::size_t begin) {
        while (chain.size() >= begin + 2 && turn(chain[chain.size() - 2], chain.back(), p) <= 0.0) chain.pop_back();
        chain.push_back(p);
    };
    for (const PlanePoint& p : points) extend(p, 0);  // from below
    const std::size_t begin = chain.size() - 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], begin);
    chain.pop_back();  // the first one again
    points = std::move(chain);
    drop_short_edges(points);
}

void find_rectangles(std::span<const PlanePoint> polygon, std::vector<Rectangle>& rectangles) {
    rectangles.clear();
    const std::size_t count = polygon.size();
    if (count < 2) rectangles.push_back({{1.0, 0.0}, 0.0, 0.0});
    if (count < 2) return;
    // The corners that are the farthest to the right of the edge's direction, above the edge, and to the left.
    std::size_t right = 1, top = 1, left = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const PlanePoint& from = polygon[i];
        const PlanePoint& to = polygon[(i + 1) % count];
        const double length = distance(from, to);
        const double x = (to.x - from.x) / length, y = (to.y - from.y) / length;
        const auto along = [&](std::size_t k) { return x * polygon[k % count].x + y * polygon[k % count].y; };
        const auto above = [&](std::size_t k) { return x * polygon[k % count].y - y * polygon[k % count].x; };
        // No caliper goes farther than one time around.
        right = std::max(right, i + 1);
        while (right < i + count && along(right + 1) > along(right)) ++right;
        top = std::max(top, right);
        while (top < i + count && above(top + 1) > above(top)) ++top;
        left = std::max(left, top);
        while (left < i + count && along(left + 1) < along(left)) ++left;
        rectangles.push_back({{x, y}, along(right) - along(left), above(top) - above(i)});
    }
}

namespace {

Point unit_along(const Point& p) { return (1.0 / std::sqrt(dot(p, p))) * p; }

/// Returns a direction that is perpendicular to one of length 1.
Point perpendicular_to(const Point& p) {
    return unit_along(cross(p, std::abs(p.x) < 0.6 ? Point{1.0, 0.0, 0.0} : Point{0.0, 1.0, 0.0}));
}

struct Candidate {
    BoxAxes axes{};
    double size = std::numeric_limits<double>::infinity();
};

class Search {
public:
    /// A flat hull has no volume, so there the area is what is least.
    explicit Search(const HullMesh& hull) : vertices_(hull.vertices), is_flat_(hull.dimension < 3) {
        const Point origin = vertices_.front();  // so that numbers are as small as the body
        for (Point& p : vertices_) p = p - origin;
    }

    [[nodiscard]] Candidate with(const BoxAxes& axes) const {
        const auto half = box_along(axes, vertices_).half;
        return {axes, size_of(2.0 * half[0], 2.0 * half[1], 2.0 * half[2])};
    }

    /// Returns the least box that has `normal` as an axis.
    [[nodiscard]] Candidate least_along(const Point& normal) {
        const Point u = perpendicular_to(normal), v = cross(normal, u);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        in_plane_.clear();
        for (const Point& p : vertices_) {
            const double along = dot(normal, p);
            low = std::min(low, along);
            high = std::max(high, along);
            in_plane_.push_back({dot(u, p), dot(v, p)});
        }
        reduce_to_polygon(in_plane_);
        find_rectangles(in_plane_, rectangles_);
        double least = std::numeric_limits<double>::infinity();
        const Rectangle* best = &rectangles_.front();
        for (const Rectangle& rectangle : rectangles_) {
            const double size = size_of(rectangle.along, rectangle.across, high - low);
            if (size < least) least = size, best = &rectangle;
        }
        const auto [x, y] = best->direction;
        return {{x * u + y * v, x * v - y * u, normal}, least};
    }

    /// Returns the best that ever smaller turns lead to, and then rectangles. The turns of a step are all sums of one
    /// about each axis, since the least box is often at a ridge, where turns about a single axis do not help.
    [[nodiscard]] Candidate improved(const Candidate& from) {
        constexpr double first_turn = 0.3, last_turn = 1e-4;
        Candidate best = from;
        for (double turn = first_turn; turn > last_turn;) {
            Candidate next = best;
            for (unsigned k = 1; k < 27; ++k) {
                const auto part = [&](unsigned divisor) { return turn * std::array{0.0, 1.0, -1.0}[k / divisor % 3]; };
                const Candidate turned = with(turned_by(best.axes, {part(1), part(3), part(9)}));
                if (turned.size < next.size) next = turned;
            }
            if (next.size < best.size) best = next;
            else turn *= 0.5;
        }
        return with_least_rectangles(best);
    }

private:
    [[nodiscard]] double size_of(double a, double b, double c) const {
        return is_flat_ ? a * b + b * c + c * a : a * b * c;
    }
    /// Turns about the three axes, one after the other.
    static BoxAxes turned_by(BoxAxes axes, const std::array<double, 3>& angles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (angles[k] == 0.0) continue;
            const double cosine = std::cos(angles[k]), sine = std::sin(angles[k]);
            Point &a = axes[(k + 1) % 3], &b = axes[(k + 2) % 3];
            const Point turned = cosine * a + sine * b;
            b = cosine * b - sine * a;
            a = turned;
        }
        return axes;
    }
    [[nodiscard]] Candidate with_least_rectangles(Candidate best) {
        constexpr double least_gain = 1e-9;
        constexpr unsigned most_steps = 100;
        unsigned steps_without_gain = 0;
        for (unsigned step = 0; step < most_steps && steps_without_gain < 3; ++step) {
            const Candidate next = with(least_along(best.axes[step % 3]).axes);
            const bool is_better = next.size < (1.0 - least_gain) * best.size;
            if (is_better) best = next;
            steps_without_gain = is_better ? 0 : steps_without_gain + 1;
        }
        return best;
    }

    std::vector<Point> vertices_;
    bool is_flat_;
    std::vector<PlanePoint> in_plane_;
    std::vector<Rectangle> rectangles_;
};

/// Returns the least box with a side on a face, or the only choice where the hull has no volume.
Candidate flush(const HullMesh& hull, Search& search) {
    if (hull.dimension == 0) return {Block{}.axes, 0.0};
    if (hull.dimension == 1)
        return search.least_along(perpendicular_to(unit_along(hull.vertices[1] - hull.vertices[0])));
    std::vector<Point> normals;  // as long as twice the area
    for (const auto& [a, b, c] : hull.triangles)
        normals.push_back(cross(hull.vertices[b] - hull.vertices[a], hull.vertices[c] - hull.vertices[a]));
    if (hull.dimension == 2)
        return search.least_along(unit_along(*std::max_element(
            normals.begin(), normals.end(), [](const Point& a, const Point& b) { return dot(a, a) < dot(b, b); })));
    Candidate best;
    for (const Point& normal : normals) {
        if (!(dot(normal, normal) > 0.0)) continue;
        const Candidate next = search.least_along(unit_along(normal));
        if (next.size < best.size) best = next;
    }
    return best;
}

}  // namespace

BoxAxes flush_axes(const HullMesh& hull) {
    Search search(hull);
    return flush(hull, search).axes;
}

BoxAxes search_axes(const HullMesh& hull) {
    Search search(hull);
    Candidate best = flush(hull, search);
    if (hull.dimension < 3) return best.axes;
    const std::array first = {best, search.with(axes_of_surface(hull)), search.with(axes_of_vertices(hull.vertices)),
                              search.with(Block{}.axes)};
    for (const Candidate& candidate : first) {
        const Candidate improved = search.improved(candidate);
        if (improved.size < best.size) best = improved;
    }
    return best.axes;
}

}  // namespace espalier::bench
