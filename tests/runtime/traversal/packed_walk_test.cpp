// Claims about the parts of walks: what they keep on their stacks, packed into words, and what they do not look at.
#include "support/testing.hpp"

#include <runtime/pairs/queries.hpp>
#include <runtime/pairs/walk.hpp>

#include "support/queries/test_pair_frame.hpp"

using namespace espalier;

namespace {

template <class Node>
void check_levels() {
    using Waiting = detail::scalar::WaitingChildren<Node>;
    constexpr unsigned stride = Node::max_children <= 8 ? 1 : 251;
    for (const std::uint32_t node : {0u, 1u, 0x555555u, 0x7FFFFFu, 0x800000u, 0xFFFFFFu})
        for (const float key : {0.0f, 0x1p-100f, 1.5f, 0x1p100f})
            for (unsigned second = 0; second < Node::max_children; ++second)
                for (unsigned others = 0; others <= detail::every_child_of<Node>; others += stride) {
                    if ((others >> second & 1) != 0) continue;
                    const Waiting waiting(Waiting::entry(key, second), others, node);
                    REQUIRE(waiting.node() == node);
                    REQUIRE(waiting.others() == others);
                    REQUIRE(waiting.child() == second);
                    REQUIRE(waiting.is_within(key));
                    REQUIRE(waiting.is_within(key * 2.0f));
                    REQUIRE((key == 0.0f || !waiting.is_within(key * 0.5f)));
                    if (others == 0) continue;
                    Waiting rest = waiting;
                    rest.drop_second();
                    REQUIRE(rest.node() == node);
                    REQUIRE(rest.others() == others);
                    REQUIRE((others >> rest.child() & 1) != 0);
                    REQUIRE(rest.is_within(key));
                    REQUIRE((key == 0.0f || !rest.is_within(key * 0.5f)));
                }
}

/// Nodes without children, read from zeros.
class EmptyNodes {
public:
    /// From node `first` on.
    EmptyNodes(Profile profile, std::uint32_t first) {
        blob_.profile = profile;
        blob_.bits = 16;
        const auto begin = reinterpret_cast<std::uintptr_t>(bytes_.data());
        blob_.nodes = reinterpret_cast<const std::byte*>(begin - std::size_t{first} * format::node_bytes(profile));
        frame_.a = frame_.b = &blob_;
    }
    EmptyNodes(const EmptyNodes&) = delete;
    EmptyNodes& operator=(const EmptyNodes&) = delete;

    [[nodiscard]] const detail::PairFrame& frame() const { return frame_; }

private:
    alignas(64) std::array<std::byte, 2 * format::plain_node::bytes> bytes_{};
    detail::BlobData blob_;
    tests::TestPairFrame frame_;
};

}  // namespace

TEST_SUITE("packed walk") {
    TEST_CASE("walk: a packed level returns the node and the children that were stored") {
        check_levels<detail::PackedNode>();
        check_levels<detail::PlainNode>();
    }

    TEST_CASE("walk: a child of any possible node fits one word") {
        using detail::scalar::PairItem;
        REQUIRE(PairItem{}.is_root());
        REQUIRE_FALSE(PairItem{}.is_leaf());
        for (const std::uint32_t node : {0u, 1u, 0x555555u, 0x7FFFFFu, 0x800000u, 0xFFFFFFu})
            for (std::uint32_t child = 0; child < format::max_children; ++child)
                for (const std::uint32_t leaf : {0u, PairItem::leaf_bit}) {
                    const PairItem item{node | child << PairItem::child_shift | leaf};
                    REQUIRE(item.parent() == node);
                    REQUIRE(item.child() == child);
                    REQUIRE(item.is_leaf() == (leaf != 0));
                    REQUIRE_FALSE(item.is_root());
                }
    }

    TEST_CASE("walk: a level of two trees returns any possible node and every child that waits") {
        using detail::scalar::PairItem;
        for (const std::uint32_t node : {0u, 1u, 0x555555u, 0x7FFFFFu, 0x800000u, 0xFFFFFEu})
            for (const Profile profile : {Profile::fast, Profile::balanced})
                for (const unsigned side : {0u, 1u}) {
                    const EmptyNodes nodes(profile, node);
                    const unsigned most = profile == Profile::fast ? 16 : 8;
                    const PairItem beside{(node + 1) | 3u << PairItem::child_shift | PairItem::leaf_bit};
                    detail::scalar::PairOfBoxes at(nodes.frame(), beside, beside);
                    detail::scalar::PairLevels levels;
                    const unsigned all = (1u << most) - 1;
                    levels.push({side, node, all}, 0, all & ~1u, at);
                    for (unsigned child = 1; child < most; ++child) {
                        at.items[0] = at.items[1] = {};
                        REQUIRE(levels.take_waiting(nodes.frame(), at));
                        REQUIRE(at.items[side].parent() == node);
                        REQUIRE(at.items[side].child() == child);
                        REQUIRE(at.items[1 - side].packed == beside.packed);
                    }
                    REQUIRE_FALSE(levels.take_waiting(nodes.frame(), at));
                }
    }

    TEST_CASE("walk: a step on the path through two trees returns every child that waits") {
        using detail::scalar::PairItem;
        const EmptyNodes nodes(Profile::fast, 0);
        for (const unsigned side : {0u, 1u})
            for (unsigned first = 0; first < format::max_children; ++first)
                for (unsigned waiting = 1; waiting < 1u << format::max_children; waiting += 251) {
                    detail::scalar::PairOfBoxes at(nodes.frame(), {}, {});
                    detail::scalar::PairPath path;
                    path.push({side, 0, waiting | 1u << first}, first, waiting, at);
                    for (unsigned child = 0; child < format::max_children; ++child) {
                        if ((waiting >> child & 1u) == 0) continue;
                        REQUIRE(path.take_waiting(nodes.frame(), at));
                        REQUIRE(at.items[side].parent() == 0);
                        REQUIRE(at.items[side].child() == child);
                        REQUIRE(at.items[1 - side].is_root());
                    }
                    REQUIRE_FALSE(path.take_waiting(nodes.frame(), at));
                }
    }

    TEST_CASE("walk: a ray that begins on the far face of the box meets it and one beyond does not") {
        detail::BlobData blob;
        detail::RayLanes lanes{};
        for (int k = 0; k < 3; ++k) {
            blob.extent_steps[k] = 7.0f;
            lanes.inverse[k] = 1.0f;
        }
        detail::LatticeRay ray{};
        for (const float begin : {0.0f, 6.5f, 7.0f}) {
            ray.tau_min = begin;
            CHECK(detail::meets_asset(blob, ray, lanes));
        }
        ray.tau_min = 7.0f + 0x1p-20f;
        CHECK_FALSE(detail::meets_asset(blob, ray, lanes));
    }
}
