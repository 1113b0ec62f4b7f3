// Claims about contacts on edges that only join two triangles of one surface, against a reference in double.
#include "support/testing.hpp"

#include "touched.hpp"

namespace espalier::tests::internal_edges_test {
namespace {

/// A square of cells over -4..4, each of two triangles, at heights z(x, y).
template <class Height>
Mesh make_ground(unsigned side, const Height& height) {
    Mesh mesh;
    const auto at = [side](unsigned i) { return -4.0 + 8.0 * static_cast<double>(i) / static_cast<double>(side); };
    for (unsigned j = 0; j <= side; ++j)
        for (unsigned i = 0; i <= side; ++i)
            mesh.positions.push_back(
                {static_cast<float>(at(i)), static_cast<float>(at(j)), static_cast<float>(height(at(i), at(j)))});
    for (unsigned j = 0; j < side; ++j) {
        for (unsigned i = 0; i < side; ++i) {
            const std::uint32_t a = j * (side + 1) + i, b = a + 1, c = b + side + 1, d = a + side + 1;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    }
    return mesh;
}

/// Every other column as high as the slope of a roof makes it.
double roof(double x, double slope) { return slope * std::abs(x - 2.0 * std::round(x / 2.0)); }

struct Ground {
    const char* name;
    Mesh mesh;
    bool is_within_flat_angle;  ///< all edges are flat but for those at a border
    bool is_tiled = false;      ///< baked in four tiles, whose borders are joined
};

std::vector<Ground> grounds() {
    const double tan4 = std::tan(4.0 * 3.14159265358979 / 180.0);
    std::vector<Ground> all = {
        {"level", make_ground(8, [](double, double) { return 0.0; }), true},
        {"slope", make_ground(8, [](double x, double y) { return 0.36 * x + 0.05 * y; }), true},
        {"flat roofs", make_ground(8, [&](double x, double) { return roof(x, 0.5 * tan4); }), true},
        {"steep roofs", make_ground(8, [](double x, double) { return roof(x, 0.7); }), false},
        {"dome", make_ground(16, [](double x, double y) { return -0.04 * (x * x + y * y); }), true},
        {"bowl", make_ground(8, [](double x, double y) { return 0.1 * (x * x + y * y); }), false},
        {"cube", make_cube(-1.0f, 1.0f), false},
        {"ball", make_icosphere(4, 3.0, {0.0f, 0.0f, 0.0f}), true}};
    for (const std::size_t i : {0u, 1u, 2u, 4u}) {
        all.push_back(all[i]);
        all.back().is_tiled = true;
    }
    return all;
}

/// The bytes of the ground's blobs: one, or that of each quadrant.
std::vector<Bytes> bake_ground(const Ground& ground, double flat_angle) {
    BakeOptions options;
    if (flat_angle > 0.0) options.flat_angle = flat_angle;
    if (!ground.is_tiled) return {bake_or_throw(ground.mesh, options)};
    options.resolution = Resolution::step(-12);
    std::vector<Bytes> tiles;
    std::vector<JoinedBlob> joined;
    for (unsigned i = 0; i < 4; ++i) {
        Mesh tile = ground.mesh;
        std::erase_if(tile.triangles, [&](const auto& t) {
            float x = 0.0f, y = 0.0f;
            for (const std::uint32_t corner : t) {
                x += tile.positions[corner].x;
                y += tile.positions[corner].y;
            }
            return (x > 0.0f) != (i % 2 == 1) || (y > 0.0f) != (i / 2 == 1);
        });
        tiles.push_back(bake_or_throw(tile, options));
    }
    for (auto& tile : tiles) joined.push_back({tile, {}});
    if (flat_angle > 0.0) REQUIRE(join_borders(joined).edges >= 4);
    return tiles;
}

/// A body as the library and as the reference have it.
struct Body {
    int kind;  ///< sphere, capsule, box, hull
    Points core;
    Point middle;
    float radius = 0.0f;
    Vec3 center;
    Vec3 half[3];
    std::vector<Vec3> vertices;

    [[nodiscard]] Filled contacts(const Blob& blob, float margin, std::span<Contact> out) const {
        const Vec3 a = center, h = half[0];
        const Capsule capsule = {{a.x - h.x, a.y - h.y, a.z - h.z}, {a.x + h.x, a.y + h.y, a.z + h.z}, radius};
        if (kind == 0) return find_contacts(blob, Sphere{center, radius}, margin, out);
        if (kind == 1) return find_contacts(blob, capsule, margin, out);
        if (kind == 2) return find_contacts(blob, OrientedBox{center, {half[0], half[1], half[2]}}, margin, out);
        return find_contacts(blob, ConvexHull{vertices}, margin, out);
    }
};

/// A body of a size between those of a cell and a part of it, at `at`: along the axes if it is level.
Body some_body(Random& random, int kind, Vec3 at, bool is_level) {
    Body body;
    body.kind = kind;
    body.center = at;
    const double turn = 3.0 * static_cast<double>(random.signed_unit());
    const double tilt = is_level ? 0.0 : static_cast<double>(random.signed_unit()) * (random.coin() ? 0.02 : 1.5);
    const double size = 0.2 + 0.8 * static_cast<double>(random.unit());
    const double thin = random.below(3) == 0 ? 0.03 : 0.4;  // every third one a plank
    const Point u = {std::cos(turn) * std::cos(tilt), std::sin(turn) * std::cos(tilt), std::sin(tilt)};
    const Point v = {-std::sin(turn), std::cos(turn), 0.0}, w = reference::cross(u, v);
    const Point axes[] = {size * u, (0.6 * size) * v, (thin * size) * w};
    const auto vector = [](Point p) {
        return Vec3{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    };
    for (int k = 0; k < 3; ++k) body.half[k] = vector(axes[k]);
    const Point center = to_point(at);
    if (kind < 2) body.radius = static_cast<float>((kind == 0 ? 0.6 : 0.2) * size);
    if (kind == 0) body.core = {center};
    if (kind == 1) body.core = {center - to_point(body.half[0]), center + to_point(body.half[0])};
    if (kind == 2) body.core = corners_of(center, body.half);
    if (kind == 3) {
        const bool is_flat = random.below(4) == 0;  // level, it lies in a plane beside that of a level floor
        for (int i = 0; i < 7; ++i) {
            Vec3 share = random.in_cube(1.0f);
            if (is_flat) share.z = 0.0f;
            const Point p = center + static_cast<double>(share.x) * axes[0] + static_cast<double>(share.y) * axes[1] +
                            static_cast<double>(share.z) * axes[2];
            body.vertices.push_back(vector(p));
            body.core.push_back(to_point(body.vertices.back()));
        }
    }
    body.middle = middle_of(body.core);
    return body;
}

/// A triangle of the ground as the reference has it.
struct Plot {
    Points corners;
    reference::PointTriangle triangle;
    EdgeKinds kinds;
    double separation = 0.0;  ///< of the body that is tried

    [[nodiscard]] bool is_flat() const {
        return kinds.ab == EdgeKind::flat && kinds.bc == EdgeKind::flat && kinds.ca == EdgeKind::flat;
    }
    [[nodiscard]] Point normal() const {
        const Point of_face = reference::normal_of(triangle);
        return (1.0 / reference::length(of_face)) * of_face;
    }
    [[nodiscard]] bool shares_a_corner(const Plot& other) const {
        return std::any_of(corners.begin(), corners.end(), [&](const Point& p) {
            return std::any_of(other.corners.begin(), other.corners.end(),
                               [&](const Point& q) { return reference::length(p - q) == 0.0; });
        });
    }
};

/// Returns the widest gap between the two as seen along a direction: below 0 if they cover each other.
double gap_seen_along(const Point& way, const Points& a, const Points& b) {
    double widest = -std::numeric_limits<double>::infinity();
    for (const Points* points : {&a, &b}) {
        for (std::size_t i = 0; i < points->size(); ++i) {
            for (std::size_t j = 0; j < points->size(); ++j) {
                const Point across = reference::cross(way, (*points)[j] - (*points)[i]);
                const double size = reference::length(across);
                if (size > 1e-9) widest = std::max(widest, reference::gap_along((1.0 / size) * across, a, b));
            }
        }
    }
    return widest;
}

/// A ground with its contacts.
class Tried {
public:
    Tried(const Ground& ground, double flat_angle)
        : ground_(ground), flat_angle_(flat_angle), bytes_(bake_ground(ground, flat_angle)) {
        for (const auto& bytes : bytes_) {
            tiles_.push_back({open(bytes), static_cast<std::uint32_t>(plots_.size())});
            const Blob& blob = tiles_.back().blob;
            const auto surface = reference::baked_surface(bytes);
            for (std::uint32_t t = 0; t < surface.size(); ++t) {
                Plot plot = {{surface[t].begin(), surface[t].end()}, surface[t], {}};
                if (const auto kinds = edge_kinds(blob, {t})) plot.kinds = *kinds;
                plots_.push_back(plot);
            }
            step_ = std::ldexp(1.0, blob.lattice().step_exponent);
        }
    }

    void try_body(const Body& body, float margin) {
        std::vector<Contact> contacts;
        for (const Tile& tile : tiles_) {
            std::vector<Contact> room(2000);
            const Filled found = body.contacts(tile.blob, margin, room);
            REQUIRE(found.status == QueryStatus::ok);
            for (Contact contact : found.in(room)) {
                contact.triangle.index += tile.first_plot;
                contacts.push_back(contact);
            }
        }
        std::ranges::stable_sort(contacts, {}, &Contact::distance);
        const Vec3 middle = {static_cast<float>(body.middle.x), static_cast<float>(body.middle.y),
                             static_cast<float>(body.middle.z)};
        if (tiles_[0].blob.is_closed() && contains(tiles_[0].blob, middle).yes()) return;
        error_ = step_ / 8.0 + 1e-5;
        near_.clear();
        double deepest = std::numeric_limits<double>::infinity(), reach = static_cast<double>(body.radius);
        double nearest = std::numeric_limits<double>::infinity();
        side_ = 0.0;
        for (const Point& p : body.core)
            reach = std::max(reach, static_cast<double>(body.radius) + reference::length(p - body.middle));
        for (std::uint32_t t = 0; t < plots_.size(); ++t) {
            Plot& plot = plots_[t];
            const double to_middle = std::sqrt(reference::squared_distance(body.middle, plot.triangle));
            if (to_middle > reach + static_cast<double>(margin)) continue;
            if (to_middle < nearest) {
                const double level = reference::dot(plot.normal(), body.middle - plot.triangle[0]);
                side_ = std::abs(level) < 64.0 * error_ ? 0.0 : level < 0.0 ? -1.0 : 1.0;
                below_ = plot.normal();
                nearest_ = t;
                nearest = to_middle;
            }
            plot.separation = reference::signed_separation(body.core, plot.corners);
            near_.push_back(t);
            deepest = std::min(deepest, plot.separation - static_cast<double>(body.radius));
        }
        if (deepest <= static_cast<double>(margin) - error_) {
            REQUIRE(!contacts.empty());
            REQUIRE(std::abs(static_cast<double>(contacts[0].distance) - deepest) <= error_);
        }
        for (const Contact& contact : contacts) require_right(contact, body, deepest);
        for (const std::uint32_t t : near_) require_present(t, body, contacts, static_cast<double>(margin));
        count += contacts.size();
    }
    std::uint64_t count = 0, corrected = 0, left = 0;

private:
    void require_right(const Contact& contact, const Body& body, double deepest) {
        const Plot& plot = plots_[contact.triangle.index];
        const Point normal = to_point(contact.normal), place = to_point(contact.point);
        const double distance = static_cast<double>(contact.distance), radius = static_cast<double>(body.radius);
        CAPTURE(contact.triangle.index);
        CAPTURE(distance);
        CAPTURE(plot.separation - radius);
        CAPTURE(static_cast<int>(contact.feature));
        // On the triangle; from the side that is named, which is the middle's if that is above the triangle; toward
        // that middle.
        REQUIRE(std::sqrt(reference::squared_distance(place, plot.triangle)) <= error_);
        const double level = reference::dot(plot.normal(), body.middle - plot.triangle[0]);
        const double steepness = reference::dot(plot.normal(), normal), named = contact.side == Side::back ? -1.0 : 1.0;
        if (std::abs(steepness) > 0.51) REQUIRE(named * steepness > 0.0);
        else if (std::abs(steepness) < 0.49 && std::abs(level) > error_) REQUIRE(named * level > 0.0);
        REQUIRE(reference::dot(normal, body.middle - place) >= -2.0 * error_);
        // Below 0 where the body overlaps the triangle. No correction is deeper than the deepest of all.
        if (contact.distance < 0.0f) REQUIRE(plot.separation - radius <= error_);
        REQUIRE(distance >= deepest - error_);
        if (flat_angle_ == 0.0 || contact.feature == Feature::face) return;
        const bool is_face_normal = std::abs(std::abs(reference::dot(normal, plot.normal())) - 1.0) < 1e-6;
        corrected += is_face_normal ? 1u : 0u;
        if (!plot.is_flat() || is_at_border(place)) return;
        // Where all edges are flat, every contact has the direction of the surface, and is below the body.
        double cosine = -1.0;
        // Behind one slope and in front of the plane of another a body may leave either. A tile does not know on which
        // side of the next one the middle of a body is that is nearest to that.
        const bool is_in_doubt = tile_of(contact.triangle.index) != tile_of(nearest_) || level * side_ < 0.0;
        for (const std::uint32_t t : near_) {
            if (std::sqrt(reference::squared_distance(place, plots_[t].triangle)) > error_) continue;
            const double aligned = side_ * reference::dot(normal, plots_[t].normal());
            cosine = std::max(cosine, is_in_doubt ? std::abs(aligned) : aligned);
        }
        const auto degrees = [](double of_cosine) {
            return std::acos(std::min(of_cosine, 1.0)) * 180.0 / 3.14159265358979;
        };
        // By as much more as the surface bends between here and what is below a long body's middle.
        const double bend = level * side_ > 0.0 ? 0.0 : degrees(reference::dot(below_, plot.normal()));
        const double off = degrees(cosine) - bend;
        // Of a place that is nearly in the plane only rounding tells the direction.
        if (ground_.is_within_flat_angle && side_ != 0.0 && std::abs(plot.separation) > 64.0 * error_)
            REQUIRE(off <= flat_angle_ + 0.1);
        // Beyond a seam the tile knows of no triangle: what lies there may lean by the flat angle from any of its faces
        // at this place, and so may the body; by a fifth of a degree more, as the library compares in float.
        double over = 0.0;
        if (ground_.is_tiled && (std::abs(place.x) <= error_ || std::abs(place.y) <= error_)) {
            double lean = flat_angle_;
            for (const std::uint32_t t : near_)
                if (tile_of(t) == tile_of(contact.triangle.index) &&
                    std::sqrt(reference::squared_distance(place, plots_[t].triangle)) <= error_)
                    lean = std::max(lean, flat_angle_ + degrees(reference::dot(plots_[t].normal(), plot.normal())));
            over = std::max(distance + radius, 0.0) * std::tan((lean + 0.2) / 57.3);
        }
        REQUIRE(gap_seen_along(normal, body.core, plot.corners) <= error_ + over);
    }

    /// Whether the ground ends at a place, as it does at a corner of a triangle whose edges are all flat: a body that
    /// is over none of the triangles there leaves the corner across the border.
    [[nodiscard]] bool is_at_border(const Point& place) const {
        return std::ranges::any_of(near_, [&](std::uint32_t t) {
            const auto& [corners, triangle, kinds, separation] = plots_[t];
            const EdgeKind of_edge[] = {kinds.ab, kinds.bc, kinds.ca};
            for (unsigned i = 0; i < 3; ++i) {
                const Point &a = triangle[i], &b = triangle[(i + 1) % 3];
                if (of_edge[i] == EdgeKind::boundary &&
                    reference::squared_distance(place, {a, b, b}) <= error_ * error_)
                    return true;
            }
            return false;
        });
    }

    [[nodiscard]] std::size_t tile_of(std::uint32_t plot) const {
        std::size_t tile = 0;
        while (tile + 1 < tiles_.size() && tiles_[tile + 1].first_plot <= plot) ++tile;
        return tile;
    }

    /// A triangle has a contact, unless it only joins another one of the surface that is nearer.
    void require_present(std::uint32_t t, const Body& body, std::span<const Contact> contacts, double margin) {
        const Plot& plot = plots_[t];
        if (plot.separation - static_cast<double>(body.radius) > margin - error_) return;
        if (std::any_of(contacts.begin(), contacts.end(), [t](const Contact& c) { return c.triangle.index == t; }))
            return;
        ++left;
        CAPTURE(t);
        REQUIRE(flat_angle_ > 0.0);
        REQUIRE(plot.separation >= -error_);
        // The body is not over it, on its own side or, where that is another, on that of a neighbour below the middle.
        const auto is_beside = [&](const Point& outward) {
            return reference::depth_along(outward, body.core, plot.corners) > 0.0 ||
                   gap_seen_along(outward, body.core, plot.corners) >= -error_;
        };
        const Point own = Beside{body.core, plot.corners, body.middle, 0.0}.outward();
        REQUIRE((is_beside(own) || std::any_of(near_.begin(), near_.end(), [&](std::uint32_t other) {
                     return plots_[other].shares_a_corner(plot) && is_beside(side_ * plots_[other].normal());
                 })));
        REQUIRE(std::any_of(near_.begin(), near_.end(), [&](std::uint32_t other) {
            return other != t && plots_[other].shares_a_corner(plot) &&
                   plots_[other].separation <= plot.separation + error_;
        }));
    }

    const Ground& ground_;
    double flat_angle_;
    std::vector<Bytes> bytes_;
    struct Tile {
        Blob blob;
        std::uint32_t first_plot;
    };
    std::vector<Tile> tiles_;
    double step_ = 0.0;
    double error_ = 0.0;
    double side_ = 0.0;          ///< of the surface, on which the middle of the body is: -1 behind, 0 in doubt
    std::uint32_t nearest_ = 0;  ///< the triangle that is nearest to it
    Point below_ = {};           ///< the normal of that
    std::vector<Plot> plots_;
    std::vector<std::uint32_t> near_;
};

TEST_CASE("contact: with and without edge flags a body is led to its side and never deeper than it is") {
    for (const Ground& ground : grounds()) {
        for (const double flat_angle : {0.0, 5.0}) {
            CAPTURE(std::string(ground.name));
            CAPTURE(ground.is_tiled);
            CAPTURE(flat_angle);
            Tried tried(ground, flat_angle);
            Random random(17);
            for (std::uint64_t i = 0; i < scaled(200); ++i) {
                CAPTURE(i);
                const auto& corners =
                    ground.mesh.triangles[random.below(static_cast<std::uint32_t>(ground.mesh.triangles.size()))];
                float share[3] = {random.unit(), random.unit(), random.unit()};
                if (random.below(4) == 0) share[random.below(3)] = 0.0f;  // over an edge
                if (random.below(8) == 0) share[0] = share[1] = 0.0f;     // over a corner
                const float sum = share[0] + share[1] + share[2] + 1e-9f;
                Vec3 at = {};
                for (int k = 0; k < 3; ++k) {
                    const Vec3& p = ground.mesh.positions[corners[static_cast<unsigned>(k)]];
                    at = {at.x + p.x * share[k] / sum, at.y + p.y * share[k] / sum, at.z + p.z * share[k] / sum};
                }
                at.z += random.signed_unit() * (random.coin() ? 0.1f : 0.7f);
                tried.try_body(some_body(random, static_cast<int>(i % 4), at, random.coin()), 0.1f);
            }
            CHECK(tried.count > 0);
            MESSAGE(std::string(ground.name), std::string(ground.is_tiled ? " in tiles" : ""), ", flat angle ",
                    flat_angle, ": ", tried.count, " contacts, ", tried.corrected, " with a face's normal on an edge, ",
                    tried.left, " left to neighbours");
        }
    }
}

}  // namespace
}  // namespace espalier::tests::internal_edges_test
