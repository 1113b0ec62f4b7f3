// The proof that a block is sound.
#include <runtime/moving_scenes/access.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

namespace {

bool is_box(const StepsBox& box) {
    for (int k = 0; k < 3; ++k)
        if (box.low[k] > box.high[k] || box.low[k] < -most_world_steps || box.high[k] > most_world_steps) return false;
    return true;
}

/// Returns whether the counts of the head fit to each other and to the capacity.
bool is_head_sound(const BlockHead& head) {
    // mutant(<= -> < 4) huge: a tree of 12 levels has at least 2 * 4^11 instances
    return head.magic == block_magic && is_step_exponent(head.step_exponent) && head.slots_used <= head.slot_capacity &&
           head.nodes_used <= head.node_capacity && head.free_nodes <= head.nodes_used &&
           head.levels <= most_tree_levels && (head.levels == 0) == (head.live == 0) &&
           (head.levels == 0) == (head.root == no_child) && head.must_refit <= 1 && head.common_region <= most_region &&
           head.step != 0 &&
           (std::bit_cast<std::uint32_t>(head.packed_area) == 0 ||
            (head.packed_area >= 1.0f && is_finite(head.packed_area)));
}

/// Returns whether the slots below slots_used are alive, worn, or in the list of free ones, each once.
bool are_slots_sound(const SceneBlock& block) {
    const BlockHead& head = *block.head;
    std::uint32_t live = 0, worn = 0;
    for (std::uint32_t number = 0; number < head.slots_used; ++number) {
        const InstanceSlot& slot = block.slots[number];
        if (block.moved[number] > head.step) return false;
        for (const std::int32_t steps : slot.origin)
            if (steps % origin_grid != 0 || steps < -most_world_steps || steps > most_world_steps) return false;
        worn += is_worn(slot) ? 1u : 0u;
        live += is_live(slot) ? 1u : 0u;
    }
    if (live != head.live) return false;
    std::uint32_t at = head.free_slot;
    // A list that is longer than the number of free slots has a cycle.
    for (std::uint32_t left = head.slots_used - live - worn; left > 0; --left) {
        if (at >= head.slots_used || is_live(block.slots[at]) || is_worn(block.slots[at])) return false;
        at = block.slots[at].place;
    }
    return at == no_child;
}

/// Returns whether the list of free nodes has as many as the head states. None of them is in the tree, where all nodes
/// but the root have a parent.
bool are_free_nodes_sound(const SceneBlock& block) {
    std::uint32_t at = block.head->free_node;
    for (std::uint32_t left = block.head->free_nodes; left > 0; --left) {
        if (at >= block.head->nodes_used || at == block.head->root) return false;
        if (block.parent[at] != no_child || block.dirty[at] != 0) return false;
        at = block.node(at).child[0];
    }
    return at == no_child;
}

/// Returns whether the room for the sort of pairs holds zeros, as each query leaves it.
bool is_room_clear(const SceneBlock& block) {
    for (std::uint32_t number = 0; number < block.head->slot_capacity; ++number)
        if (block.counts[number] != 0) return false;
    return true;
}

/// A walk over the tree that proves it.
class TreeProof {
public:
    explicit TreeProof(const SceneBlock& block) : block_(block), head_(*block.head) {}

    bool prove() {
        if (head_.levels == 0) return head_.free_nodes == head_.nodes_used;
        if (head_.root >= head_.nodes_used || block_.parent[head_.root] != no_child) return false;
        // Each child points back to its place, so that no two places have one child and the walk ends.
        path_[0] = {head_.root, 0};
        if (!is_node_sound()) return false;
        for (;;) {
            Level& top = path_[depth_];
            if (top.next < BoxNode::most) {
                if (!take_child(top.node, top.next++)) return false;
            } else if (depth_ == 0) {
                break;
            } else {
                --depth_;
            }
        }
        return found_slots_ == head_.live && found_nodes_ + head_.free_nodes == head_.nodes_used;
    }

private:
    struct Level {
        std::uint32_t node;
        unsigned next;  ///< the child that is next
    };

    /// Returns whether the node at hand has enough children, and its parent the box around them. Only the box of a
    /// marked node may be old: a removal may free that node with its mark, and no refit then renews the boxes above.
    [[nodiscard]] bool is_node_sound() const {
        const std::uint32_t number = path_[depth_].node;
        const BoxNode& node = block_.node(number);
        const unsigned least = depth_ != 0 ? BoxNode::least : head_.levels == 1 ? 1 : 2;
        if (block_.dirty[number] > head_.must_refit || node.count() < least) return false;
        if (depth_ == 0 || block_.dirty[number] != 0) return true;
        const std::uint32_t above = block_.parent[number];
        return block_.node(above / 8).box(above % 8) == node.bounds();
    }
    /// Returns whether a child is sound, and goes to it if it is a node.
    bool take_child(std::uint32_t number, unsigned place) {
        const BoxNode& node = block_.node(number);
        const std::uint32_t child = node.child[place], at = 8 * number + place;
        if (child == no_child) return node.box(place) == StepsBox::none();
        if (!is_box(node.box(place))) return false;
        if (depth_ + 1u == head_.levels) {
            ++found_slots_;
            return child < head_.slots_used && is_live(block_.slots[child]) && block_.slots[child].place == at &&
                   block_.slots[child].box == node.box(place);
        }
        if (child >= head_.nodes_used || block_.parent[child] != at) return false;
        ++found_nodes_;
        path_[++depth_] = {child, 0};
        return is_node_sound();
    }

    const SceneBlock& block_;
    const BlockHead& head_;
    Level path_[most_tree_levels];
    std::uint32_t depth_ = 0;
    std::uint32_t found_nodes_ = 1;
    std::uint32_t found_slots_ = 0;
};

}  // namespace

bool is_sound(const SceneBlock& block) {
    return is_head_sound(*block.head) && are_slots_sound(block) && are_free_nodes_sound(block) &&
           is_room_clear(block) && TreeProof(block).prove();
}

bool has_boxes_of_instances(const MovingScene& scene) {
    const SceneBlock block = block_of(scene);
    Coarseness coarseness{};
    for (std::uint32_t number = 0; number < block.head->slots_used; ++number) {
        const InstanceSlot& slot = block.slots[number];
        if (!is_live(slot)) continue;
        if (!is_placeable(scene, slot.mesh) || !is_in_range(slot.transform.scale)) return false;
        const PartBounds bounds = bounds_of_part(scene, slot.mesh);
        StepsBox box;
        // The box of any other transform that is not valid is NaN.
        if (!find_steps_box(bounds, slot.transform, block.head->step_exponent, box)) return false;
        if (!move_to_world(slot.origin, box) || box != slot.box) return false;
        if (common_region_with(scene, slot) != block.head->common_region) return false;
        coarseness.add(bounds, slot.transform);
    }
    // No number below 0 and no NaN includes another one.
    return block.head->coarseness.includes(coarseness);
}

}  // namespace espalier::detail
