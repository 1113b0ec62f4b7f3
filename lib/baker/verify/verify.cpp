#include <espalier/bake.hpp>

#include <algorithm>
#include <bit>

#include <espalier/blob.hpp>
#include <runtime/blob/duplicate_references.hpp>

#include <baker/base/indexed_hash_set.hpp>
#include <baker/base/triangle_set.hpp>
#include <baker/quantise/closed.hpp>
#include <baker/quantise/lattice_mesh.hpp>
#include <baker/sections/optional_sections.hpp>
#include <baker/verify/check_motion.hpp>
#include <baker/verify/check_tree.hpp>

namespace espalier {

namespace baker {

namespace {

/// Gathers the leaves' triangles into one welded mesh, with a look at each.
class Gatherer {
public:
    Gatherer(const detail::BlobData& data, std::size_t leaves_at)
        : data_(data),
          leaves_at_(leaves_at),
          points_(std::size_t{data.triangle_count} * 3),
          triangles_(data.triangle_count) {}

    std::optional<std::string> add(const DecodedLeaf& leaf, const DecodedBox& region) {
        std::array<std::uint32_t, format::max_leaf_vertices> numbers{};
        for (unsigned i = 0; i < leaf.vertex_count; ++i) numbers[i] = weld(leaf.vertices[i]);
        std::uint64_t used = 0;  // a bit for each vertex
        static_assert(format::max_leaf_vertices < 64);
        for (unsigned i = 0; i < leaf.triangle_count; ++i) {
            const std::uint32_t index = leaf.first_triangle + i;
            std::array<std::uint32_t, 3> corners{};
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = leaf.corners[i][corner];
                // In a strip the first uses of entries number the vertices, and a window may turn them round.
                if (data_.profile == Profile::fast && vertex > static_cast<unsigned>(std::popcount(used)))
                    return about(index, leaf, "uses a vertex before the ones that are numbered lower");
                used |= std::uint64_t{1} << vertex;
                corners[corner] = numbers[vertex];
            }
            const auto [a, b, c] = corners;
            if (is_collapsed(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c])) {
                return about(index, leaf, "has no area");
            }
            const std::uint32_t same = triangles_.find_or_insert(corners);
            const bool is_new = same == mesh.triangles.size();
            const std::uint32_t owner = detail::owner_of(data_, index);
            if (is_new && owner != index) return about(index, leaf, "is a copy of another triangle");
            if (!is_new && mesh.triangles[same].original_id != owner) {
                return about(index, leaf,
                             "is the same as triangle " + std::to_string(mesh.triangles[same].original_id));
            }
            if (is_new) {
                mesh.triangles.push_back({corners, index});
                corners_found_.push_back(0);
            }
            for (unsigned corner = 0; corner < 3; ++corner) {
                const Coordinates& at = leaf.vertices[leaf.corners[i][corner]];
                if (region.contains({at, at})) corners_found_[same] |= static_cast<std::uint8_t>(1u << corner);
            }
        }
        if (static_cast<unsigned>(std::popcount(used)) != leaf.vertex_count)
            return about(leaf.first_triangle, leaf, "is in a leaf with vertices that none uses");
        return std::nullopt;
    }

    /// Every corner of every triangle must lie where a query that looks for it comes to one of its leaves.
    [[nodiscard]] std::optional<std::string> check_corners() const {
        for (std::size_t i = 0; i < corners_found_.size(); ++i) {
            if (corners_found_[i] == 7) continue;
            return "triangle " + std::to_string(mesh.triangles[i].original_id) +
                   " has a corner that lies in none of the boxes of its leaves";
        }
        return std::nullopt;
    }

    LatticeMesh mesh;  ///< copies left out; original ids are storage indices

private:
    std::uint32_t weld(const Coordinates& at) {
        const LatticePoint point{at[0], at[1], at[2]};
        const auto number = points_.find_or_insert(hash_of(point), static_cast<std::uint32_t>(mesh.vertices.size()),
                                                   [&](std::uint32_t other) { return mesh.vertices[other] == point; });
        if (number == mesh.vertices.size()) mesh.vertices.push_back(point);
        return number;
    }
    [[nodiscard]] std::string about(std::uint32_t triangle, const DecodedLeaf& leaf, const std::string& what) const {
        return "triangle " + std::to_string(triangle) + " (leaf data at byte " + std::to_string(leaves_at_ + leaf.at) +
               ") " + what;
    }

    const detail::BlobData& data_;
    std::size_t leaves_at_;
    std::vector<std::uint8_t> corners_found_;  // of each triangle of the mesh, a bit for each corner
    IndexedHashSet points_;
    TriangleSet triangles_;
};

std::optional<std::string> check_extent(const Blob& blob, const LatticeMesh& mesh) {
    if (mesh.vertices.empty()) return std::nullopt;
    DecodedBox all{{mesh.vertices[0].x, mesh.vertices[0].y, mesh.vertices[0].z}, {}};
    all.hi = all.lo;
    for (const LatticePoint& point : mesh.vertices) all.add({{point.x, point.y, point.z}, {point.x, point.y, point.z}});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (all.lo[axis] == 0 && all.hi[axis] == detail::data_of(blob).extent[axis]) continue;
        return "the header (byte " + std::to_string(format::header::extent_at + 4 * axis) + ") states that axis " +
               std::to_string(axis) + " goes from 0 to " + std::to_string(detail::data_of(blob).extent[axis]) +
               ", but its vertices go from " + std::to_string(all.lo[axis]) + " to " + std::to_string(all.hi[axis]);
    }
    return std::nullopt;
}

/// Returns the first thing that is wrong, or nothing.
std::optional<std::string> find_fault(std::span<const std::byte> bytes) {
    const Blob blob = open(bytes);
    if (!blob) return describe(blob.status());
    const detail::BlobData& data = detail::data_of(blob);
    const std::size_t node_bytes = data.node_count * format::node_bytes(data.profile);
    const std::size_t leaves_at = format::header::bytes + node_bytes;
    const auto extent_of = [&](std::size_t axis) { return static_cast<std::int32_t>(data.extent[axis]); };
    const TreeBytes tree{bytes.subspan(format::header::bytes, node_bytes),
                         bytes.subspan(leaves_at, data.leaf_bytes),
                         data.bits,
                         data.profile,
                         data.copies != nullptr,
                         {extent_of(0), extent_of(1), extent_of(2)}};
    if (blob.is_deformable()) {
        TreeBytes moving = tree;
        moving.corners = std::span(data.corners, std::size_t{3} * data.triangle_count);
        return check_motion(bytes, blob, moving);
    }

    Gatherer gatherer(data, leaves_at);
    TreeCounts counts;
    const auto gather = [&](const DecodedLeaf& leaf, const DecodedBox& region) { return gatherer.add(leaf, region); };
    if (auto complaint = check_tree(tree, gather, counts)) return complaint;
    if (auto complaint = gatherer.check_corners()) return complaint;
    const LatticeMesh& mesh = gatherer.mesh;
    if (auto complaint = check_extent(blob, mesh)) return complaint;
    if (mesh.vertices.size() != blob.vertex_count()) {
        return "the header (byte " + std::to_string(format::header::vertex_count_at) + ") counts " +
               std::to_string(blob.vertex_count()) + " vertices, but there are " + std::to_string(mesh.vertices.size());
    }
    if (is_closed(mesh) != blob.is_closed()) {
        return std::string("the header (byte ") + std::to_string(format::header::features_at) + ") calls the mesh " +
               (blob.is_closed() ? "closed, but it is not" : "open, but it is closed");
    }
    return check_optional_sections(blob, mesh);
}

}  // namespace

}  // namespace baker

VerifyReport verify(std::span<const std::byte> bytes) {
    std::optional<std::string> fault = baker::find_fault(bytes);
    if (fault) return {false, std::move(*fault)};
    return {true, {}};
}

}  // namespace espalier
