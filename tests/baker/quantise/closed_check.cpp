#include "closed_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <espalier/distance.hpp>

#include <runtime/lattice/round_point.hpp>

#include "oracle/winding.hpp"
#include "support/blobs/baking.hpp"
#include "support/format/decoder.hpp"

namespace espalier::tests {

namespace {

using oracle::WholePoint;
using oracle::WholeTriangle;

constexpr int fraction_bits = 6;
constexpr std::int64_t one_step = 1 << fraction_bits;
constexpr double far_tolerance = 1e-8;   // of a sum of solid angles, far from edges
constexpr double near_tolerance = 1e-4;  // some steps from an edge that may be 2^16 long
constexpr std::size_t all_corners = 1500;
constexpr int few_corners = 60;

std::vector<WholeTriangle> whole_triangles(const DecodedBlob& decoded) {
    std::vector<WholeTriangle> triangles;
    const auto whole = [](const GridPoint& p) -> WholePoint {
        return {p[0] * one_step, p[1] * one_step, p[2] * one_step};
    };
    for (const GridTriangle& t : decoded.triangles) triangles.push_back({{whole(t.a), whole(t.b), whole(t.c)}});
    return triangles;
}

bool is_whole(double number, double tolerance) { return std::fabs(number - std::round(number)) <= tolerance; }

/// A blob, and what it is made of in whole numbers.
struct Subject {
    OpenedBlob opened;
    DecodedBlob decoded;
    std::vector<WholeTriangle> triangles;

    explicit Subject(std::vector<std::byte> bytes)
        : opened(std::move(bytes)), decoded(decode(opened.bytes)), triangles(whole_triangles(decoded)) {}

    [[nodiscard]] const WholePoint& some_corner(Random& random) const {
        return triangles[random.below(static_cast<std::uint32_t>(triangles.size()))].corner[random.below(3)];
    }
    [[nodiscard]] WholePoint in_box(Random& random) const {
        const auto along = [&](unsigned k) {
            const auto size = static_cast<std::int32_t>(decoded.extent[k]);
            return random.between(-1, size) * one_step + random.between(0, one_step);
        };
        const std::int64_t x = along(0), y = along(1);
        return {x, y, along(2)};
    }
    static WholePoint beside(const WholePoint& corner, Random& random) {
        const auto off = [&] { return std::int64_t{random.between(-4 * one_step, 4 * one_step)}; };
        const std::int64_t x = corner[0] + off(), y = corner[1] + off();
        return {x, y, corner[2] + off()};
    }

    /// Points on the surface count: they say nothing.
    [[nodiscard]] bool is_winding_whole(const WholePoint& point, double tolerance) const {
        return is_whole(oracle::winding(triangles, point), tolerance) || oracle::is_on_surface(triangles, point);
    }
    /// Every piece of the boundary ends at corners, and is seen well from beside them.
    [[nodiscard]] bool are_windings_whole(bool thoroughly, Random& random) const {
        for (int i = 0; i < 8; ++i)
            if (!is_winding_whole(in_box(random), far_tolerance)) return false;
        if (!thoroughly) {
            for (int i = 0; i < few_corners; ++i)
                if (!is_winding_whole(beside(some_corner(random), random), near_tolerance)) return false;
            return true;
        }
        for (const WholeTriangle& triangle : triangles)
            for (const WholePoint& corner : triangle.corner)
                if (!is_winding_whole(beside(corner, random), near_tolerance)) return false;
        return true;
    }
    [[nodiscard]] bool are_edges_in_pairs() const {
        std::map<std::pair<WholePoint, WholePoint>, int> uses;
        for (const auto& [corner] : triangles)
            for (std::size_t k = 0; k < 3; ++k) ++uses[{corner[k], corner[(k + 1) % 3]}];
        return std::all_of(uses.begin(), uses.end(), [&](const auto& edge) {
            const auto back = uses.find({edge.first.second, edge.first.first});
            return edge.second == 1 && back != uses.end() && back->second == 1;
        });
    }

    [[nodiscard]] Vec3 world(const std::array<double, 3>& steps) const {
        const double step = std::ldexp(1.0, decoded.step_exponent);
        const auto along = [&](unsigned k) {
            return static_cast<float>(static_cast<double>(decoded.origin[k]) + steps[k] * step);
        };
        return {along(0), along(1), along(2)};
    }
    /// Corners, middles of edges, points of faces, their coordinates mixed with those of others; or anywhere.
    [[nodiscard]] Vec3 some_point(Random& random) const {
        const auto& [a, b, c] = triangles[random.below(static_cast<std::uint32_t>(triangles.size()))].corner;
        const std::uint32_t kind = random.below(6);
        std::array<double, 3> at{};
        if (kind == 0) return world(scaled_down(in_box(random)));
        if (kind == 1) return world(scaled_down(beside(a, random)));
        const double u = kind == 2 ? 0.0 : kind == 3 ? 0.5 : 0.25, v = kind == 4 ? 0.25 : 0.0;
        for (std::size_t k = 0; k < 3; ++k)
            at[k] = ((1 - u - v) * static_cast<double>(a[k]) + u * static_cast<double>(b[k]) +
                     v * static_cast<double>(c[k])) /
                    static_cast<double>(one_step);
        const std::size_t axis = random.below(3);
        const WholePoint other = random.coin() ? some_corner(random) : in_box(random);
        if (random.below(4) != 0) at[axis] = static_cast<double>(other[axis]) / static_cast<double>(one_step);
        return world(at);
    }
    static std::array<double, 3> scaled_down(const WholePoint& point) {
        const auto down = [](std::int64_t whole) { return static_cast<double>(whole) / static_cast<double>(one_step); };
        return {down(point[0]), down(point[1]), down(point[2])};
    }
};

std::int64_t exact_winding(const Subject& subject, const WholePoint& point, Random& random) {
    for (;;) {
        const auto some = [&] { return std::int64_t{random.between(-1'000'000, 1'000'000)}; };
        const std::int64_t x = some(), y = some();
        if (const auto count = oracle::crossings(subject.triangles, point, {x, y, some()})) return *count;
    }
}

/// The point as the library rounds it, in the oracle's unit.
std::optional<WholePoint> rounded(const Subject& subject, Vec3 point) {
    detail::RoundedPoint at{};
    if (detail::round_point(detail::data_of(subject.opened.blob), point, std::numeric_limits<float>::infinity(), at) !=
        QueryStatus::ok)
        return std::nullopt;
    WholePoint whole{};
    for (std::size_t k = 0; k < 3; ++k) whole[k] = at.origin[k] << (fraction_bits - at.fraction_bits);
    return whole;
}

std::string check_point(const Subject& subject, Random& random, ClosedTally& tally) {
    const Vec3 point = subject.some_point(random);
    const std::optional<WholePoint> whole = rounded(subject, point);
    const YesNo inside = contains(subject.opened.blob, point);
    if (!whole || is_refused(inside.status())) return std::string("contains refuses: ") + describe(inside.status());
    ++tally.points;
    const bool on_surface = oracle::is_on_surface(subject.triangles, *whole);
    const std::int64_t winding = on_surface ? 0 : exact_winding(subject, *whole, random);
    tally.on_surface += on_surface ? 1u : 0u;
    tally.inside += winding != 0 ? 1u : 0u;
    tally.other_windings += winding != 0 && winding != 1 && winding != -1 ? 1u : 0u;
    if (inside == YesNo::of(on_surface || winding != 0)) return {};
    return "contains is wrong at " + std::to_string(point.x) + ' ' + std::to_string(point.y) + ' ' +
           std::to_string(point.z) + ": the winding number is " + std::to_string(winding);
}

/// The fewest bits above those of the report that keep the surface closed, by baking with each of them.
unsigned bits_that_keep(const Mesh& mesh, BakeOptions options, unsigned bits) {
    while (++bits <= format::max_bits) {
        options.resolution = Resolution::bits(bits);
        const MeshView view = mesh.view();
        const auto baked = bake({&view, 1}, options);
        if (baked && baked.report.closed) return bits;
    }
    return 0;
}

}  // namespace

std::string ClosedTally::text() const {
    return std::to_string(bakes) + " bakes, " + std::to_string(closed) + " closed (" +
           std::to_string(edges_not_in_pairs) + " with edges that are not in pairs), " + std::to_string(lost) +
           " lost; " + std::to_string(points) + " points, " + std::to_string(inside) + " inside (" +
           std::to_string(other_windings) + " by a winding number other than 1 and -1), " + std::to_string(on_surface) +
           " on the surface";
}

std::string check_closed(const Mesh& mesh, const BakeOptions& options, std::uint64_t points, Random& random,
                         ClosedTally& tally) {
    const MeshView view = mesh.view();
    auto baked = bake({&view, 1}, options);
    if (!baked) return baked.message;
    const BakeReport& report = baked.report;
    if (report.tree.triangles == 0) return report.closed ? "nothing is closed" : "";
    const Subject subject(std::move(baked.bytes));
    ++tally.bakes;
    const bool is_small = subject.triangles.size() <= all_corners;
    if (subject.are_windings_whole(is_small || !report.closed, random) != report.closed)
        return report.closed ? "it is not closed: a winding number is not whole" : "its winding numbers are whole";
    if (!report.closed) {
        tally.lost += report.warns_of(BakeWarning::Kind::lost_closed) ? 1u : 0u;
        const unsigned keeping =
            report.warns_of(BakeWarning::Kind::lost_closed) ? bits_that_keep(mesh, options, report.lattice.bits) : 0;
        if (report.bits_that_keep_closed == keeping) return {};
        return "it would stay closed with " + std::to_string(keeping) + " bits";
    }
    if (report.warns_of(BakeWarning::Kind::lost_closed) || report.bits_that_keep_closed != 0)
        return "it is closed and nothing is lost";
    ++tally.closed;
    tally.edges_not_in_pairs += subject.are_edges_in_pairs() ? 0u : 1u;
    for (std::uint64_t i = 0; i < points; ++i)
        if (std::string complaint = check_point(subject, random, tally); !complaint.empty()) return complaint;
    return {};
}

}  // namespace espalier::tests
