// Refit: vertices move, and boxes and sizes of leaves are renewed from the last node to the first. Children have higher
// numbers than their parents, so each box is complete when its parent reads it.
#include <espalier/deformation.hpp>

#include <runtime/blob/plain_leaf.hpp>
#include <runtime/deformation/place_vertices.hpp>

namespace espalier {

using namespace detail;

namespace {

template <bool near>
inline bool is_in_range(const PoseAxes& axes, const Vec3& position) {
    return axes.axis[0].coordinate<near>(position.x) <= axes.axis[0].extent &&
           axes.axis[1].coordinate<near>(position.y) <= axes.axis[1].extent &&
           axes.axis[2].coordinate<near>(position.z) <= axes.axis[2].extent;
}

/// Returns the index of the first position that is not finite or out of range, or their number if there is none.
template <bool near>
std::size_t first_refused(const PoseAxes& axes, std::span<const Vec3> positions) {
    std::size_t index = 0;
    if constexpr (near && takes_four_positions)
        while (positions.size() - index >= 4 && are_four_in_range(axes, positions.data() + index)) index += 4;
    while (index < positions.size() && is_in_range<near>(axes, positions[index])) ++index;
    return index;
}

/// The moving part of a blob, and positions for it that all are in range.
class Refit {
public:
    Refit(const BlobData& blob, std::byte* memory, const Vec3* positions)
        : blob_(blob),
          nodes_(memory + format::header::bytes),
          leaves_(nodes_ + std::size_t{blob.node_count} * PlainNode::size),
          positions_(positions),
          unit_shift_(format::unit_shift(blob.bits)),
          least_size_(format::plain_leaf::least_size(blob.bits)),
          number_bytes_(format::vertex_sources::number_bits(load_u32(blob.bytes + format::header::position_count_at)) /
                        8),
          sources_(vertex_sources_of(blob) +
                   std::size_t{load_u32(blob.bytes + format::header::vertex_slots_at)} * number_bytes_) {}

    /// Returns the cost of the tree.
    template <bool near>
    float run(const PoseAxes& axes) {
        TreeCost cost;
        UnsignedBox box;
        for (std::uint32_t number = blob_.node_count; number-- != 0;) {
            const auto node = node_at<PlainNode>(blob_, number);
            for (unsigned leaf = node.leaf_children(); leaf-- != 0;) move_leaf<near>(axes, node, leaf);
            for (unsigned child = 0; child < node.node_children(); ++child) {
                TreeCost unused;
                set_planes(node, child, unused.add(node_at<PlainNode>(blob_, node.first_child() + child)));
            }
            box = cost.add(node);
        }
        return cost.over(box);
    }

    [[nodiscard]] const UnsignedBox& bounds() const { return bounds_; }

private:
    [[nodiscard]] std::byte* moving(const PlainNode& node) const { return nodes_ + (node.bytes - blob_.nodes); }

    void set_planes(const PlainNode& node, unsigned child, const UnsignedBox& box) const {
        std::byte* const at = moving(node) + 2 * std::size_t{child};
        for (unsigned k = 0; k < 3; ++k) {
            std::byte* const row = at + format::plain_node::row_bytes * k;
            store_u16(row + format::plain_node::lo_at, box.low[k]);
            store_u16(row + format::plain_node::hi_at, box.high[k]);
        }
    }

    template <bool near>
    void move_leaf(const PoseAxes& axes, const PlainNode& node, unsigned number) {
        using namespace format::plain_leaf;
        const std::uint32_t descriptor = node.leaf_descriptor(number);
        const unsigned vertices = (descriptor >> vertices_shift & 31u) + 1;
        sources_ -= std::size_t{vertices} * number_bytes_;
        std::byte* const data =
            leaves_ + 4 * (std::size_t{node.leaf_block_place()} + (descriptor & ((1u << offset_bits) - 1u)));
        std::byte* const words = data + words_at;
        const MovingLeaf leaf = {words, has_high_bytes(blob_.bits) ? words + 6 * vertices : nullptr, sources_, vertices,
                                 number_bytes_ == 2};
        const UnsignedBox box = place_vertices<near>(axes, positions_, leaf);
        bounds_.add(box);

        UnsignedBox planes;
        std::uint32_t differences = 0;
        for (int k = 0; k < 3; ++k) {
            planes.low[k] = box.low[k] >> unit_shift_;
            planes.high[k] = box.high[k] >> unit_shift_;
            differences |= box.high[k] - box.low[k];
        }
        set_planes(node, node.node_children() + number, planes);
        const auto size = static_cast<unsigned>(std::bit_width(differences));
        const std::uint32_t field = size > least_size_ ? size - least_size_ : 0;
        // The highest bits of the descriptor, in the last of its three bytes.
        static_assert(size_shift == 20 && descriptor_bytes == 3);
        std::byte* const last = moving(node) + format::plain_node::leaves_at + descriptor_bytes * number + 2;
        store_u8(last, (descriptor >> 16 & 15u) | field << 4);
    }

    const BlobData& blob_;
    std::byte* nodes_;
    std::byte* leaves_;
    const Vec3* positions_;
    unsigned unit_shift_;
    unsigned least_size_;
    std::size_t number_bytes_;
    const std::byte* sources_;  ///< of the leaf that was moved last
    UnsignedBox bounds_;
};

/// Returns why a position is refused.
QueryStatus status_of(const Vec3& position) {
    return is_finite(position.x) && is_finite(position.y) && is_finite(position.z) ? QueryStatus::out_of_range
                                                                                   : QueryStatus::invalid_argument;
}

template <bool near>
RefitResult refit_on(const PoseAxes& axes, const BlobData& blob, std::byte* memory, std::span<const Vec3> positions) {
    const std::size_t refused = first_refused<near>(axes, positions);
    if (refused != positions.size()) return {status_of(positions[refused]), static_cast<std::uint32_t>(refused), 0.0f};
    Refit refit(blob, memory, positions.data());
    const float cost = refit.run<near>(axes);
    for (std::size_t k = 0; k < 3; ++k) {
        store_u32(memory + format::header::pose_low_at + 4 * k, refit.bounds().low[k]);
        store_u32(memory + format::header::pose_high_at + 4 * k, refit.bounds().high[k]);
    }
    return {QueryStatus::ok, 0, cost / load_f32(blob.bytes + format::header::rest_cost_at)};
}

}  // namespace

RefitResult refit(Deformable& mesh, std::span<const Vec3> positions) noexcept {
    if (!mesh) return {mesh.status(), 0, 0.0f};
    const std::uint32_t count = mesh.position_count();
    if (positions.size() != count)
        return {QueryStatus::invalid_argument,
                positions.size() < count ? static_cast<std::uint32_t>(positions.size()) : count, 0.0f};
    const BlobData& blob = data_of(mesh.blob_);
    const PoseAxes axes(blob);
    return axes.are_near ? refit_on<true>(axes, blob, mesh.memory_, positions)
                         : refit_on<false>(axes, blob, mesh.memory_, positions);
}

}  // namespace espalier
