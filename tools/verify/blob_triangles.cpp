#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <unordered_map>

#include <espalier/espalier.hpp>

#include <baker/base/indexed_hash_set.hpp>
#include <baker/input/positions.hpp>
#include <baker/input/zero_area.hpp>
#include <baker/quantise/lattice.hpp>
#include <import/base/numbers.hpp>
#include <import/base/placement.hpp>

#include "base/exit_code.hpp"
#include "base/vectors.hpp"
#include "measure.hpp"
#include "stored_triangles.hpp"

namespace espalier::tools {

namespace {

/// Corners in whole lattice steps, which float64 holds. The least corner is the first; the winding stays.
using LatticeCorners = std::array<std::array<double, 3>, 3>;

struct LatticeCornersHash {
    std::size_t operator()(const LatticeCorners& corners) const {
        std::uint64_t hash = 0;
        for (const auto& corner : corners)
            for (const double steps : corner) hash = baker::mix_bits(hash ^ std::bit_cast<std::uint64_t>(steps));
        return static_cast<std::size_t>(hash);
    }
};

Triangle corners_in(const Blob& blob, TriangleId triangle) { return triangle_at(blob, triangle).value; }

/// Triangles of a source are first looked up as the baker moves them onto the lattice, which is exact where the blob
/// was baked from this source. Those of a source that was written anew, with other digits, are found by their corners.
class BlobTriangles final : public StoredTriangles {
public:
    explicit BlobTriangles(const Blob& blob)
        : blob_(blob), lattice_(blob.lattice()), reciprocal_step_(std::ldexp(1.0, -lattice_.step_exponent)) {
        static_cast<void>(for_each_triangle(blob, [&](TriangleId id, const Triangle& triangle) {
            const SourceCorners corners = in_blob(triangle);
            if (is_flat(corners)) return;  // a pose of a deformable blob may flatten triangles
            entries_.try_emplace(on_lattice(corners), Entry{id});
        }));
    }

    [[nodiscard]] std::uint64_t size() const override { return entries_.size(); }

    Match match(const SourceCorners& corners) override {
        for (const bool as_float32 : {false, true}) {
            const auto found = entries_.find(on_lattice(from_origin(corners, as_float32)));
            if (found != entries_.end()) return mark(found->second);
        }
        return match_near(from_origin(corners, false));
    }

    [[nodiscard]] bool may_collapse(const SourceCorners& corners) const override {
        return is_flat(from_origin(corners, false)) || is_flat(from_origin(corners, true));
    }

    [[nodiscard]] Sourceless sourceless() const override {
        Sourceless result;
        TriangleId first;
        for (const auto& [corners, entry] : entries_) {
            if (entry.has_source) continue;
            ++result.count;
            first = std::min(first, entry.triangle);
        }
        if (result.count != 0) result.first = text("triangle ", first.index);
        return result;
    }

private:
    struct Entry {
        TriangleId triangle;
        bool has_source = false;
    };

    static SourceCorners in_blob(const Triangle& triangle) {
        return {to_float64(triangle.a), to_float64(triangle.b), to_float64(triangle.c)};
    }

    static Match mark(Entry& entry) {
        const Match match = entry.has_source ? Match::again : Match::first;
        entry.has_source = true;
        return match;
    }

    /// As the baker does; a program may have rounded positions to float32 before.
    [[nodiscard]] SourceCorners from_origin(const SourceCorners& corners, bool as_float32) const {
        baker::PositionsFromOrigin positions(blob_.source_origin(), as_float32);
        return {positions.at(corners[0]), positions.at(corners[1]), positions.at(corners[2])};
    }

    [[nodiscard]] LatticeCorners on_lattice(const SourceCorners& corners) const {
        LatticeCorners snapped;
        for (std::size_t i = 0; i < 3; ++i) {
            snapped[i] = {baker::snap_coordinate(corners[i].x, lattice_.origin.x, reciprocal_step_),
                          baker::snap_coordinate(corners[i].y, lattice_.origin.y, reciprocal_step_),
                          baker::snap_coordinate(corners[i].z, lattice_.origin.z, reciprocal_step_)};
        }
        std::rotate(snapped.begin(), std::min_element(snapped.begin(), snapped.end()), snapped.end());
        return snapped;
    }

    [[nodiscard]] bool is_flat(const SourceCorners& corners) const {
        const auto [a, b, c] = on_lattice(corners);
        return baker::has_zero_area({a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {c[0], c[1], c[2]});
    }

    Match match_near(const SourceCorners& corners) {
        const Vec3d middle = middle_of(corners);
        const Vec3 in_blob_space = to_float32(middle);
        const double tolerance = corner_tolerance(blob_.max_error());
        const double radius = tolerance + length_of(middle - to_float64(in_blob_space)) +
                              measuring_error_at(blob_, in_blob_space, tolerance);
        Match match = Match::none;
        const auto visit = [&](TriangleId triangle) {
            const SourceCorners stored = in_blob(corners_in(blob_, triangle));
            if (!are_corners_near(stored, corners, tolerance)) return;
            const auto found = entries_.find(on_lattice(stored));
            if (found != entries_.end()) match = std::max(match, mark(found->second));
        };
        static_cast<void>(for_each_overlap(blob_, Sphere{in_blob_space, to_float32(radius)}, visit));
        return match;
    }

    Blob blob_;
    Lattice lattice_;
    double reciprocal_step_;
    std::unordered_map<LatticeCorners, Entry, LatticeCornersHash> entries_;
};

}  // namespace

std::unique_ptr<StoredTriangles> triangles_of_blob(const Blob& blob) { return std::make_unique<BlobTriangles>(blob); }

}  // namespace espalier::tools
