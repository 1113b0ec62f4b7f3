#include <baker/verify/check_motion.hpp>

#include <algorithm>
#include <vector>

#include <runtime/base/bits.hpp>
#include <runtime/blob/deformable_blob.hpp>

#include <baker/base/triangle_set.hpp>
#include <baker/quantise/closed.hpp>
#include <baker/quantise/lattice_mesh.hpp>
#include <baker/verify/check_tree.hpp>

namespace espalier::baker {

namespace {

/// Gathers the triangles of all leaves over the positions of the sources.
class MotionChecker {
public:
    MotionChecker(std::span<const std::byte> bytes, const Blob& blob, const TreeBytes& tree)
        : header_(bytes.data()),
          blob_(blob),
          tree_(tree),
          sources_(detail::vertex_sources_of(detail::data_of(blob))),
          leaves_at_(format::header::bytes + tree.nodes.size()),
          triangles_(blob.triangle_count()) {
        find_positions();
        mesh_.vertices.resize(positions_.size());
        mesh_.is_used.assign(positions_.size(), 0);
    }

    std::optional<std::string> run() {
        find_slots();
        TreeCounts counts;
        const auto add = [this](const DecodedLeaf& leaf, const DecodedBox&) { return add_leaf(leaf); };
        if (auto complaint = check_tree(tree_, add, counts)) return complaint;
        if (auto complaint = check_bounds()) return complaint;
        if (blob_.vertex_count() != mesh_.used_vertices)
            return at(format::header::vertex_count_at) + "counts " + std::to_string(blob_.vertex_count()) +
                   " vertices, but " + std::to_string(mesh_.used_vertices) + " positions have a triangle";
        if (edges_cancel_in_pairs(mesh_) != blob_.is_closed())
            return at(format::header::features_at) + "calls the mesh " +
                   (blob_.is_closed() ? "closed, but its edges do not cancel" : "open, but its edges cancel");
        // More, where positions were rounded before: to float32, or by the subtraction of an origin.
        if (blob_.max_error() < largest_snap_error(blob_.lattice().step_exponent))
            return at(format::header::max_error_at) + "has a smaller largest error than that of the lattice";
        return std::nullopt;
    }

private:
    [[nodiscard]] std::uint32_t field(std::size_t place) const { return detail::load_u32(header_ + place); }
    [[nodiscard]] std::uint32_t source(std::size_t slot) const {
        return format::vertex_sources::number_bits(field(format::header::position_count_at)) == 16
                   ? detail::load_u16(sources_ + 2 * slot)
                   : detail::load_u32(sources_ + 4 * slot);
    }
    /// Finds the positions that have a vertex: not more than the blob's bytes hold, whatever their number is.
    void find_positions() {
        const std::size_t slots = field(format::header::vertex_slots_at);
        positions_.reserve(slots);
        for (std::size_t slot = 0; slot < slots; ++slot) positions_.push_back(source(slot));
        std::sort(positions_.begin(), positions_.end());
        positions_.erase(std::unique(positions_.begin(), positions_.end()), positions_.end());
    }
    /// Returns the vertex of the mesh at a slot.
    [[nodiscard]] std::uint32_t vertex_at(std::size_t slot) const {
        const auto found = std::lower_bound(positions_.begin(), positions_.end(), source(slot));
        return static_cast<std::uint32_t>(found - positions_.begin());
    }
    static std::string at(std::size_t place) { return "the header (byte " + std::to_string(place) + ") "; }

    /// Finds where the sources of each leaf begin: they are in the order of the nodes' numbers.
    void find_slots() {
        slots_.assign(tree_.leaves.size() / 4 + 1, 0);
        std::size_t slot = 0;
        DecodedNode node;
        for (std::uint32_t number = 0; tree_.decode_node(number, node); ++number) {
            for (unsigned i = 0; i < node.leaves; ++i) {
                DecodedLeaf leaf;
                if (!tree_.decode_leaf(node, i, leaf)) return;  // check_tree complains about it
                slots_[leaf.at / 4] = slot;
                slot += leaf.vertex_count;
            }
            node = {};
        }
    }

    std::optional<std::string> add_leaf(const DecodedLeaf& leaf) {
        const auto about = [&](std::uint32_t triangle, const std::string& what) {
            return "triangle " + std::to_string(triangle) + " (leaf data at byte " +
                   std::to_string(leaves_at_ + leaf.at) + ") " + what;
        };
        const std::size_t slot = slots_[leaf.at / 4];
        for (unsigned i = 0; i < leaf.vertex_count; ++i) {
            const std::uint32_t vertex = vertex_at(slot + i);
            const LatticePoint point{leaf.vertices[i][0], leaf.vertices[i][1], leaf.vertices[i][2]};
            if (mesh_.is_used[vertex] == 0) {
                mesh_.is_used[vertex] = 1;
                mesh_.vertices[vertex] = point;
                ++mesh_.used_vertices;
            } else if (!(mesh_.vertices[vertex] == point)) {
                return about(leaf.first_triangle, "is in a leaf that has position " +
                                                      std::to_string(positions_[vertex]) +
                                                      " elsewhere than another leaf");
            }
        }
        unsigned used = 0;
        for (unsigned i = 0; i < leaf.triangle_count; ++i) {
            std::array<std::uint32_t, 3> corners{};
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = leaf.corners[i][corner];
                if (vertex > used) return about(leaf.first_triangle + i, "uses a vertex before those numbered lower");
                used += vertex == used ? 1 : 0;
                corners[corner] = vertex_at(slot + vertex);
            }
            const std::uint32_t next = triangles_.size();
            if (const std::uint32_t same = triangles_.find_or_insert(corners); same != next)
                return about(leaf.first_triangle + i,
                             "has the positions of triangle " + std::to_string(mesh_.triangles[same].original_id));
            mesh_.triangles.push_back({corners, leaf.first_triangle + i});
        }
        if (used != leaf.vertex_count) return about(leaf.first_triangle, "is in a leaf with vertices that none uses");
        all_.add(leaf.box());
        return std::nullopt;
    }

    std::optional<std::string> check_bounds() const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto low = static_cast<std::int32_t>(field(format::header::pose_low_at + 4 * axis));
            const auto high = static_cast<std::int32_t>(field(format::header::pose_high_at + 4 * axis));
            if (all_.lo[axis] == low && all_.hi[axis] == high) continue;
            return at(format::header::pose_low_at + 4 * axis) + "states that axis " + std::to_string(axis) +
                   " of the pose goes from " + std::to_string(low) + " to " + std::to_string(high) +
                   ", but its vertices go from " + std::to_string(all_.lo[axis]) + " to " +
                   std::to_string(all_.hi[axis]);
        }
        return std::nullopt;
    }

    static constexpr std::int32_t far = 1 << 30;

    const std::byte* header_;
    const Blob& blob_;
    const TreeBytes& tree_;
    const std::byte* sources_;
    std::size_t leaves_at_;
    std::vector<std::size_t> slots_;
    std::vector<std::uint32_t> positions_;  ///< their numbers, each once, sorted
    TriangleSet triangles_;
    LatticeMesh mesh_;  ///< has a vertex for each of `positions_`
    DecodedBox all_{{far, far, far}, {-far, -far, -far}};
};

}  // namespace

std::optional<std::string> check_motion(std::span<const std::byte> bytes, const Blob& blob, const TreeBytes& tree) {
    return MotionChecker(bytes, blob, tree).run();
}

}  // namespace espalier::baker
