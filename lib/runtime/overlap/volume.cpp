// The walk that all shapes share. It needs no float: cores without them are as well served.
#include <bit>

#include <runtime/overlap/volume.hpp>
#include <runtime/traversal/scalar_walk.hpp>

namespace espalier::detail {

namespace {

// A bit for each plane and each side of the bounds that a vertex is beyond of, as Sutherland and Cohen clip lines. A
// triangle all of whose corners are beyond the same one is out. Shapes have either bounds and few planes or planes
// only.
constexpr unsigned bounds_shift = 26;
static_assert(max_planes == 32 && bounds_shift + 6 == 32);

/// Where the vertices of a leaf are.
template <class Leaf>
struct Places {
    std::uint32_t beyond[Leaf::max_vertices];  ///< a bit for each side
    std::uint64_t inside = 0;                  ///< a bit for each vertex that is surely in the shape
    static_assert(Leaf::max_vertices <= 64);
};

/// Which sides do not have all vertices deep inside of them. All sides where vertices may lie outside of the leaf's
/// box.
template <class Leaf>
std::uint32_t sides_that_matter(const Leaf& leaf, const Volume& volume) {
    const unsigned bits = leaf.blob->bits;
    const std::int64_t depth = volume.depth_inside == Volume::unknown ? 0 : volume.depth_inside;
    const bool in_box = !Leaf::may_have_duplicates || leaf.blob->copies == nullptr;
    std::uint32_t sides = 0;
    for (unsigned i = 0; i < volume.plane_count; ++i)
        if (!in_box || !is_wholly_behind(leaf.node, bits, leaf.child(), volume.planes[i], depth)) sides |= 1u << i;
    if (!volume.bounded) return sides;
    for (int k = 0; k < 3; ++k) {
        const unsigned low_side = bounds_shift + 2 * static_cast<unsigned>(k);
        if (!in_box || leaf.node.low(k, leaf.child(), bits) < volume.bounds.low[k]) sides |= 1u << low_side;
        if (!in_box || leaf.node.high(k, leaf.child(), bits) > volume.bounds.high[k]) sides |= 2u << low_side;
    }
    return sides;
}

/// Seen from those sides that matter.
template <class Leaf>
void find_places(const Leaf& leaf, const Volume& volume, std::uint32_t matter, Places<Leaf>& places) {
    const bool knows_inside = volume.depth_inside != Volume::unknown;
    const std::int32_t anchor[3] = {leaf.anchor(0), leaf.anchor(1), leaf.anchor(2)};
    const std::uint32_t planes = volume.bounded ? matter & ((1u << bounds_shift) - 1u) : matter;
    for (unsigned vertex = 0; vertex < leaf.vertex_count; ++vertex) {
        std::int32_t at[3];
        for (int k = 0; k < 3; ++k) at[k] = anchor[k] + leaf.offset(k, vertex);
        std::uint32_t sides = 0;
        bool is_deep = knows_inside;
        if (volume.bounded) {
            for (int k = 0; k < 3; ++k) {
                const unsigned low_side = bounds_shift + 2 * static_cast<unsigned>(k);
                sides |= static_cast<std::uint32_t>(at[k] < volume.bounds.low[k]) << low_side;
                sides |= static_cast<std::uint32_t>(at[k] > volume.bounds.high[k]) << (low_side + 1);
            }
        }
        for (std::uint32_t left = planes; left != 0; left &= left - 1) {
            const auto i = static_cast<unsigned>(std::countr_zero(left));
            const LatticePlane& plane = volume.planes[i];
            std::int64_t reached = 0;
            for (int k = 0; k < 3; ++k) reached += std::int64_t{plane.normal[k]} * at[k];
            sides |= static_cast<std::uint32_t>(reached > plane.offset) << i;
            is_deep = is_deep && reached <= plane.offset - volume.depth_inside;
        }
        places.beyond[vertex] = sides;
        places.inside |= std::uint64_t{is_deep && sides == 0} << vertex;
    }
}

/// Whether all corners are beyond one of the planes.
[[maybe_unused]] bool is_beyond_a_plane(const Volume& volume, const LatticeTriangle& triangle) {
    for (unsigned i = 0; i < volume.plane_count; ++i) {
        const LatticePlane& plane = volume.planes[i];
        bool is_beyond = true;
        for (const auto& corner : triangle.corner) {
            std::int64_t reached = 0;
            for (int k = 0; k < 3; ++k) reached += std::int64_t{plane.normal[k]} * corner[k];
            is_beyond = is_beyond && reached > plane.offset;
        }
        if (is_beyond) return true;
    }
    return false;
}

struct VolumeShape {
    const BlobData& blob;
    const Volume& volume;

    template <class Node>
    [[nodiscard]] unsigned cull(const Node& node, float, float*) const {
        unsigned mask = volume.bounded ? children_within(node, blob.bits, volume.bounds) : all_children(node);
        for (unsigned i = 0; i < volume.plane_count && mask != 0; ++i)
            mask = children_behind(node, blob.bits, volume.planes[i], mask);
        return mask;
    }
    template <class Leaf>
    [[nodiscard]] Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, Each& answer) const {
        if ((volume.bounded && is_beside(volume.bounds, triangle.corner)) || is_beyond_a_plane(volume, triangle))
            return Visit::next;
        count_decision();
        if (!volume.kernel(volume, triangle)) return Visit::next;
        return answer.take(found_at(leaf, scalar::storage_index(leaf, slot)), leaf, slot);
    }
    /// Vertices first: most triangles need no more.
    template <class Leaf>
    [[nodiscard]] Visit scan(const Leaf& leaf, Each& answer) const {
        Places<Leaf> places;
        const std::uint32_t matter = sides_that_matter(leaf, volume);
        const bool all_inside = matter == 0 && volume.depth_inside != Volume::unknown;
        if (!all_inside) find_places(leaf, volume, matter, places);
        auto corners = scalar::corners_of(leaf);
        const auto used = leaf.used_slots();
        std::uint32_t index = scalar::storage_index(leaf, 0);
        for (unsigned slot = 0; slot < leaf.slot_count; ++slot) {
            const scalar::CornerNumbers vertices = corners.next();
            if ((used >> slot & 1u) == 0) continue;
            const std::uint32_t reference = index++;
            if (reference < answer.first) continue;
            if (!all_inside) {
                const std::uint32_t* beyond = places.beyond;
                if ((beyond[vertices.a] & beyond[vertices.b] & beyond[vertices.c]) != 0) continue;
                const std::uint64_t corners_inside =
                    places.inside >> vertices.a | places.inside >> vertices.b | places.inside >> vertices.c;
                if ((corners_inside & 1) == 0) {
                    count_decision();
                    if (!volume.kernel(volume, leaf.triangle(slot))) continue;
                }
            }
            if (answer.take(found_at(leaf, reference), leaf, slot) == Visit::stop) return Visit::stop;
        }
        return Visit::next;
    }
};

}  // namespace

bool find_overlaps(const BlobData& blob, const Volume& volume, Each& answer, const WalkAccuracy& accuracy) {
    VolumeShape shape = {blob, volume};
    return scalar_walk::find_each<Each>(blob, shape, answer, accuracy);
}

}  // namespace espalier::detail
