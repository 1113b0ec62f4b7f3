#include "hull.hpp"

namespace espalier::bench {
namespace {

__extension__ using Wide = __int128;

Wide product(double a, double b) { return Wide{static_cast<std::int64_t>(a)} * static_cast<std::int64_t>(b); }

/// The differences of lattice points have 41 bits with the sign, so the sum of six products of three has less than 128.
Wide exact_determinant(const Point& u, const Point& v, const Point& w) {
    const Wide x = product(u.y, v.z) - product(u.z, v.y), y = product(u.z, v.x) - product(u.x, v.z),
               z = product(u.x, v.y) - product(u.y, v.x);
    return x * static_cast<std::int64_t>(w.x) + y * static_cast<std::int64_t>(w.y) + z * static_cast<std::int64_t>(w.z);
}

}  // namespace

double side_of(const Point& a, const Point& b, const Point& c, const Point& p) {
    const Point u = b - a, v = c - a, w = p - a;  // exact
    const double determinant = dot(cross(u, v), w);
    const auto magnitude = [](const Point& d) { return Point{std::abs(d.x), std::abs(d.y), std::abs(d.z)}; };
    const Point mu = magnitude(u), mv = magnitude(v), mw = magnitude(w);
    const double sum =
        (mu.y * mv.z + mu.z * mv.y) * mw.x + (mu.z * mv.x + mu.x * mv.z) * mw.y + (mu.x * mv.y + mu.y * mv.x) * mw.z;
    if (std::abs(determinant) > 0x1p-49 * sum) return determinant;  // Shewchuk 1997: less than 8 roundings of 2^-53
    const Wide exact = exact_determinant(u, v, w);
    return exact > 0 ? 1.0 : exact < 0 ? -1.0 : 0.0;
}

namespace {

using Index = std::uint32_t;
constexpr Index none = std::numeric_limits<Index>::max();

double length_of(const Point& p) { return std::sqrt(dot(p, p)); }

/// Points on the lattice. A copy of a point in double, which the hull returns, differs by less than a step.
struct Lattice {
    explicit Lattice(std::span<const Point> from) {
        Point low = from.front(), high = from.front();
        for (const Point& p : from) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        const double side = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        if (!(side > 0.0)) return;
        const double scale = lattice_steps / side;
        points.reserve(from.size());
        for (const Point& p : from)
            points.push_back({std::round((p.x - low.x) * scale), std::round((p.y - low.y) * scale),
                              std::round((p.z - low.z) * scale)});
    }
    std::vector<Point> points;  ///< none: all points are at one place
};

/// A triangle of the hull so far, and the points outside of it that have not been looked at.
struct Face {
    HullMesh::Triangle corners{};
    std::array<Index, 3> beyond{};  ///< beyond[k]: the face that shares the edge from corner k to the next
    Point normal{};                 ///< of length 1
    double height = 0.0;
    std::vector<Index> outside;
    double farthest = 0.0;  ///< height of the first of `outside`
    unsigned visit = 0;     ///< the last step in which the face was tested
    bool is_visible = false;
    bool is_gone = false;
};

class Quickhull {
public:
    Quickhull(std::span<const Point> lattice, double flat)
        : points_(lattice), flat_(flat), face_from_(lattice.size(), none) {}

    /// Returns the hull's dimension. The faces are there where that is 3, and the corners of a first triangle where
    /// that is 2, of a segment where that is 1.
    unsigned run() {
        const unsigned dimension = find_first_corners();
        if (dimension < 3) return dimension;
        make_first_faces();
        for (std::size_t f = 0; f < faces_.size(); ++f)  // faces are added at the end
            while (!faces_[f].is_gone && !faces_[f].outside.empty()) add_point(static_cast<Index>(f));
        return dimension;
    }
    [[nodiscard]] const std::array<Index, 4>& first_corners() const { return first_; }
    [[nodiscard]] std::span<const Face> faces() const { return faces_; }

private:
    unsigned find_first_corners() {
        std::array<Index, 6> extremes{};
        for (Index i = 0; i < points_.size(); ++i) {
            const auto replace = [&](std::size_t k, double a, double b) {
                if (a < b) extremes[k] = i;
            };
            const Point& p = points_[i];
            replace(0, p.x, points_[extremes[0]].x);
            replace(1, points_[extremes[1]].x, p.x);
            replace(2, p.y, points_[extremes[2]].y);
            replace(3, points_[extremes[3]].y, p.y);
            replace(4, p.z, points_[extremes[4]].z);
            replace(5, points_[extremes[5]].z, p.z);
        }
        double most = 0.0;
        for (const Index a : extremes)
            for (const Index b : extremes) {
                const double length = length_of(points_[b] - points_[a]);
                if (length > most) most = length, first_[0] = a, first_[1] = b;
            }
        const Point& origin = points_[first_[0]];
        const Point along = (1.0 / most) * (points_[first_[1]] - origin);
        first_[2] = farthest([&](const Point& p) { return length_of(cross(along, p - origin)); }, most);
        if (!(most > flat_)) return 1;
        const Point across = cross(along, points_[first_[2]] - origin);
        const Point normal = (1.0 / length_of(across)) * across;
        first_[3] = farthest([&](const Point& p) { return std::abs(dot(normal, p - origin)); }, most);
        return most > flat_ ? 3 : 2;
    }
    template <class Distance>
    Index farthest(const Distance& distance, double& most) const {
        Index found = 0;
        most = -1.0;
        for (Index i = 0; i < points_.size(); ++i) {
            const double d = distance(points_[i]);
            if (d > most) most = d, found = i;
        }
        return found;
    }

    void make_first_faces() {
        auto [a, b, c, d] = first_;
        if (side_of(points_[a], points_[b], points_[c], points_[d]) > 0.0) std::swap(b, c);
        // d is below a, b, c.
        add_face({a, b, c}, {3, 2, 1});
        add_face({a, c, d}, {0, 2, 3});
        add_face({c, b, d}, {0, 3, 1});
        add_face({b, a, d}, {0, 1, 2});
        std::vector<Index> all(points_.size());
        for (Index i = 0; i < all.size(); ++i) all[i] = i;
        distribute(all, 0);
    }
    void add_face(const HullMesh::Triangle& corners, const std::array<Index, 3>& beyond) {
        Face face;
        face.corners = corners;
        face.beyond = beyond;
        const Point& a = points_[corners[0]];
        const Point across = cross(points_[corners[1]] - a, points_[corners[2]] - a);
        face.normal = (1.0 / length_of(across)) * across;
        face.height = dot(face.normal, a);
        faces_.push_back(std::move(face));
    }

    /// Puts each point on the list of the face, from `first` on, that it is farthest outside of, and drops the others.
    void distribute(std::span<const Index> points, std::size_t first) {
        for (const Index i : points) {
            double most = flat_;
            Face* found = nullptr;
            for (std::size_t f = first; f < faces_.size(); ++f) {
                const double height = dot(faces_[f].normal, points_[i]) - faces_[f].height;
                if (height > most) most = height, found = &faces_[f];
            }
            if (found == nullptr) continue;
            found->outside.push_back(i);
            if (most <= found->farthest) continue;
            found->farthest = most;
            std::swap(found->outside.front(), found->outside.back());
        }
    }

    [[nodiscard]] bool is_outside(Index point, const Face& face) const {
        const auto& [a, b, c] = face.corners;
        return side_of(points_[a], points_[b], points_[c], points_[point]) > 0.0;
    }

    /// Replaces the faces that are visible from a point by those from it to their border, which is one loop: a face in
    /// whose plane the point is counts as not visible, so that no new face is without area.
    void add_point(Index from) {
        const Index apex = faces_[from].outside.front();
        if (!is_outside(apex, faces_[from])) {  // the plane of a sliver was rounded too much
            faces_[from].outside.front() = faces_[from].outside.back();
            faces_[from].outside.pop_back();
            return;
        }
        ++visit_;
        visible_.clear();
        border_.clear();
        faces_[from].visit = visit_;
        faces_[from].is_visible = true;
        visible_.push_back(from);
        for (std::size_t next = 0; next < visible_.size(); ++next)
            for (std::size_t k = 0; k < 3; ++k) {
                const Index other = faces_[visible_[next]].beyond[k];
                Face& face = faces_[other];
                if (face.visit != visit_) {
                    face.visit = visit_;
                    face.is_visible = is_outside(apex, face);
                    if (face.is_visible) visible_.push_back(other);
                }
                if (!face.is_visible) border_.push_back({visible_[next], static_cast<Index>(k)});
            }
        const std::size_t first = faces_.size();
        for (const auto& [inside, k] : border_) {
            const auto index = static_cast<Index>(faces_.size());
            const Index a = faces_[inside].corners[k], b = faces_[inside].corners[(k + 1) % 3];
            const Index other = faces_[inside].beyond[k];
            for (Index& back : faces_[other].beyond)
                if (back == inside && edge_from(faces_[other], back) == b) back = index;
            add_face({a, b, apex}, {other, none, none});
            face_from_[a] = index;
        }
        for (std::size_t f = first; f < faces_.size(); ++f) {
            const Index next = face_from_[faces_[f].corners[1]];
            faces_[f].beyond[1] = next;
            faces_[next].beyond[2] = static_cast<Index>(f);
        }
        left_.clear();
        for (const Index gone : visible_) {
            Face& face = faces_[gone];
            for (const Index i : face.outside)
                if (i != apex) left_.push_back(i);
            face.outside = {};
            face.is_gone = true;
        }
        distribute(left_, first);
    }
    /// Returns the corner at which the edge begins whose entry of `beyond` this is.
    [[nodiscard]] static Index edge_from(const Face& face, const Index& beyond) {
        return face.corners[static_cast<std::size_t>(&beyond - face.beyond.data())];
    }

    struct BorderEdge {
        Index face;
        Index edge;
    };
    std::span<const Point> points_;
    double flat_;
    std::array<Index, 4> first_{};
    std::vector<Face> faces_;
    std::vector<Index> face_from_;  ///< by the corner of the border from which a new face's edge leads
    std::vector<Index> visible_, left_;
    std::vector<BorderEdge> border_;
    unsigned visit_ = 0;
};

/// Returns the hull of points in the plane of three of them.
HullMesh flat_hull(std::span<const Point> points, const std::array<Index, 4>& corners) {
    const Point& origin = points[corners[0]];
    const Point side = points[corners[1]] - origin;
    const Point along = (1.0 / length_of(side)) * side;
    const Point across = cross(along, points[corners[2]] - origin);
    const Point up = cross((1.0 / length_of(across)) * across, along);
    std::vector<PlanePoint> in_plane;
    in_plane.reserve(points.size());
    for (Index i = 0; i < points.size(); ++i)
        in_plane.push_back({dot(along, points[i] - origin), dot(up, points[i] - origin), i});
    reduce_to_polygon(in_plane);
    HullMesh hull;
    hull.dimension = 2;
    for (const PlanePoint& p : in_plane) hull.vertices.push_back(points[p.number]);
    for (Index i = 2; i < hull.vertices.size(); ++i) hull.triangles.push_back({0, i - 1, i});
    return hull;
}

}  // namespace

HullMesh convex_hull_of(std::span<const Point> points) {
    HullMesh hull;
    const Lattice lattice(points);
    if (lattice.points.empty()) {
        hull.vertices = {points.front()};
        return hull;
    }
    Quickhull quickhull(lattice.points, float_rounding_share * lattice_steps);
    hull.dimension = quickhull.run();
    if (hull.dimension == 1)
        hull.vertices = {points[quickhull.first_corners()[0]], points[quickhull.first_corners()[1]]};
    if (hull.dimension == 2) return flat_hull(points, quickhull.first_corners());
    if (hull.dimension < 3) return hull;
    std::vector<Index> number(points.size(), none);
    for (const Face& face : quickhull.faces()) {
        if (face.is_gone) continue;
        HullMesh::Triangle& triangle = hull.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            Index& vertex = number[face.corners[k]];
            if (vertex == none) {
                vertex = static_cast<Index>(hull.vertices.size());
                hull.vertices.push_back(points[face.corners[k]]);
            }
            triangle[k] = vertex;
        }
    }
    return hull;
}

}  // namespace espalier::bench
