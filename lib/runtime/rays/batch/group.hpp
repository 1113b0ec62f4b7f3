// Rays that are alike walk the tree together: a node is fetched once for all of them, a leaf is decoded once. The idea
// of one walk with a list of its rays goes back to Wald, Slusallek, Benthin and Wagner (2001).
#ifndef ESPALIER_RAYS_BATCH_GROUP_HPP
#define ESPALIER_RAYS_BATCH_GROUP_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/rays/batch/ray_in_batch.hpp>

ESPALIER_BEGIN_SET

inline constexpr unsigned rays_in_group = 16;
using GroupMask = std::uint32_t;  ///< a bit for each ray

/// Calls the function with the number of each set bit.
template <class Mask, class Function>
inline void for_each_bit(Mask mask, Function function) {
    for (; mask != 0; mask &= mask - 1) function(static_cast<unsigned>(std::countr_zero(mask)));
}

template <class Leaf>
class RayGroup {
public:
    /// Answers rays_in_group rays.
    void answer(const BlobData& blob, const Ray* worlds, const BatchAnswers& answers) {
        GroupMask begun = 0;
        for (unsigned number = 0; number < rays_in_group; ++number) {
            const QueryStatus status = rays_[number].begin(blob, worlds[number], answers.hit(number));
            if (status == QueryStatus::ok) begun |= GroupMask{1} << number;
            else answers.miss(number, status);
        }
        if (begun != 0) walk(blob, begun);
        for_each_bit(begun, [&](unsigned number) { rays_[number].answer(worlds[number], answers, number); });
    }

private:
    struct Waiting {
        std::uint64_t entry;  ///< the smallest key of its rays above the index, as in NearestFirst
        GroupMask rays;
    };

    void walk(const BlobData& blob, GroupMask rays) {
        size_ = 0;
        std::uint32_t index = 0;
        for (;;) {
            if ((rays & (rays - 1)) == 0)  // alone: the rest of its way is walked without the others
                traverse_nearest_first<PlaceOf<Leaf>>(blob, rays_[std::countr_zero(rays)].query, index);
            else visit(blob, node_at<typename Leaf::Node>(blob, index), rays);
            do {
                if (size_ == 0) return;
                const Waiting& next = stack_[--size_];
                rays = still_interested(next.rays, [&](unsigned) {
                    return std::bit_cast<float>(static_cast<std::uint32_t>(next.entry >> 32));
                });
                index = static_cast<std::uint32_t>(next.entry);
            } while (rays == 0);
        }
    }

    /// Those of the rays whose limit is not below their key.
    template <class KeyOf>
    GroupMask still_interested(GroupMask rays, KeyOf key_of) const {
        GroupMask result = 0;
        for_each_bit(rays, [&](unsigned number) {
            result |= static_cast<GroupMask>(key_of(number) <= rays_[number].query.limit()) << number;
        });
        return result;
    }

    void visit(const BlobData& blob, const typename Leaf::Node& node, GroupMask rays) {
        GroupMask by_child[Leaf::Node::max_children] = {};
        for_each_bit(rays, [&](unsigned number) {
            count_node_step();
            for_each_bit(rays_[number].query.children(node, keys_[number]),
                         [&](unsigned child) { by_child[child] |= GroupMask{1} << number; });
        });
        const auto rays_of = [&](unsigned child) {
            return still_interested(by_child[child], [&](unsigned number) { return keys_[number][child]; });
        };
        const unsigned node_children = node.node_children();
        for (unsigned number = 0; number < node.leaf_children(); ++number)
            if (const GroupMask those = rays_of(node_children + number); those != 0)
                visit_leaf({&blob, node, number}, those);
        const unsigned bottom = size_;
        // mutant(!= -> true) work: stores a child that no ray needs, which is dropped later
        for (unsigned child = 0; child < node_children; ++child)
            if (const GroupMask those = rays_of(child); those != 0) put_aside(blob, node, child, those, bottom);
    }

    /// On the stack, the nearer ones on top.
    void put_aside(const BlobData& blob, const typename Leaf::Node& node, unsigned child, GroupMask rays,
                   unsigned bottom) {
        std::uint32_t key = infinity_bits;
        for_each_bit(rays, [&](unsigned number) {
            const auto own = std::bit_cast<std::uint32_t>(keys_[number][child]);
            // mutant(< -> <=) equivalent: both sides are equal then
            key = own < key ? own : key;
        });
        const std::uint32_t index = node.first_child() + child;
        prefetch(node_at<typename Leaf::Node>(blob, index).bytes);
        const Waiting waits = {std::uint64_t{key} << 32 | index, rays};
        unsigned place = size_++;
        // mutant(< -> <=) equivalent: no two entries are equal, since each contains the number of its node
        for (; place > bottom && stack_[place - 1].entry < waits.entry; --place) stack_[place] = stack_[place - 1];
        stack_[place] = waits;
    }

    /// First what lanes can reject, for all rays, then the rest in integers: so the branches come together.
    void visit_leaf(const PlaceOf<Leaf>& place, GroupMask rays) {
        count_leaf_step();
        UnpackedLeaf<Leaf> leaf;
        decode_leaf(*place.blob, place.node, place.number, leaf);
        typename Leaf::Slots candidates[rays_in_group];
        const GroupMask with_candidates = with_table_groups<Leaf::max_vertices>(
            leaf.vertex_count, [&](auto groups) { return reject<groups>(leaf, rays, candidates); });
        for_each_bit(with_candidates, [&](unsigned number) {
            for_each_bit(candidates[number], [&](unsigned slot) {
                rays_[number].query.answer.decide(rays_[number].prepared.ray, leaf, slot);
            });
        });
    }

    /// ray_candidates, for several rays. Those who have any.
    template <unsigned groups>
    GroupMask reject(UnpackedLeaf<Leaf>& leaf, GroupMask rays, typename Leaf::Slots* candidates) const {
        constexpr unsigned slots = 8 * sizeof(typename Leaf::Slots);
        CornerNumbers numbers[(slots + lanes - 1) / lanes];
        const unsigned used = SeenVertices<groups>::groups_of(leaf.vertex_count);
        leaf.unpack_vertices(used);
        auto corners = leaf.corners_in_lanes();
        // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
        for (unsigned first = 0; first < leaf.slot_count; first += lanes) numbers[first / lanes] = corners.next();
        GroupMask result = 0;
        for_each_bit(rays, [&](unsigned number) {
            const LatticeRay& ray = rays_[number].prepared.ray;
            const unsigned kx = ray.axis[0], ky = ray.axis[1], kz = ray.axis[2];
            const Floats offset_x = splat(anchor_from_origin(leaf, ray.zero, kx));
            const Floats offset_y = splat(anchor_from_origin(leaf, ray.zero, ky));
            const Floats offset_z = splat(anchor_from_origin(leaf, ray.zero, kz));
            const Floats shear_x = splat(ray.shear[0]), shear_y = splat(ray.shear[1]);
            SeenVertices<groups> vertices(leaf, ray);
            for (unsigned group = 0; group < used; ++group) {
                const Floats z = add(to_floats(leaf.vertices(kz, group)), offset_z);
                vertices.set(group, multiply_add(z, shear_x, add(to_floats(leaf.vertices(kx, group)), offset_x)),
                             multiply_add(z, shear_y, add(to_floats(leaf.vertices(ky, group)), offset_y)));
            }
            typename Leaf::Slots mask = 0;
            // mutant(< -> <=) sanitizer: shifts by the width of the type where a leaf is full
            for (unsigned first = 0; first < leaf.slot_count; first += lanes)
                mask |= typename Leaf::Slots{vertices.allow(numbers[first / lanes])} << first;
            candidates[number] = mask & leaf.used_slots();
            // mutant(!= -> true) equivalent: a ray without candidates has nothing to visit
            result |= static_cast<GroupMask>(candidates[number] != 0) << number;
        });
        return result;
    }

    RayInBatch<Leaf> rays_[rays_in_group];
    Waiting stack_[(format::max_depth - 1) * (Leaf::Node::max_children - 1) + 1];  ///< enough as in NearestFirst
    unsigned size_ = 0;
    alignas(32) float keys_[rays_in_group][Leaf::Node::max_children];  ///< of the node at hand, by ray
};

/// For whole groups of rays.
template <class Leaf>
ESPALIER_NOINLINE inline void answer_in_groups(const BlobData& blob, const Ray* rays, const BatchAnswers& answers,
                                               std::size_t count) {
    RayGroup<Leaf> group;
    for (std::size_t first = 0; first < count; first += rays_in_group)
        group.answer(blob, rays + first, answers.from(first));
}

ESPALIER_END_SET

#endif
