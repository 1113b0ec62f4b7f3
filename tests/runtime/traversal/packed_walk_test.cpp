// Claims about the parts of walks: what they keep on their stacks, packed into words, and what they do not look at.
#include <doctest/doctest.h>

#include <bit>

#include <espalier/espalier.hpp>
#include <runtime/lanes/scalar.hpp>
#include <runtime/pairs/queries.hpp>

namespace espalier::detail::scalar {
namespace {
#include <runtime/traversal/traverse.inl>
#include <runtime/pairs/trees.inl>
#include <runtime/pairs/walk.inl>
}  // namespace
}  // namespace espalier::detail::scalar

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
