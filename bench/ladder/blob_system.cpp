// Espalier's own queries among the trees that are compared.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>
#include <espalier/statistics.hpp>
#include <espalier/walk.hpp>

#include "../../tests/support/format/decoder.hpp"
#include "systems.hpp"

namespace espalier::bench {
namespace {

Box box_of(const Aabb& box) { return {{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}}; }

bool do_touch(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
           b.min.z <= a.max.z;
}

class BlobSystem final : public TreeSystem {
public:
    BlobSystem(const std::string& name, const BakedBlob& baked) : TreeSystem(name), baked_(&baked) {}

    [[nodiscard]] unsigned degree() const override { return format::max_node_children(baked_->blob.profile()); }
    [[nodiscard]] TreeBytes bytes() const override {
        const std::size_t node_bytes = format::node_bytes(baked_->blob.profile());
        return {detail::data_of(baked_->blob).node_count, node_bytes, baked_->bytes.size()};
    }
    void find_closest(std::span<const Ray> rays, std::span<float> hits) override {
        for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = raycast(baked_->blob, rays[i]).t;
    }
    void count_touching(std::span<const Aabb> boxes, std::span<std::uint64_t> counts) override {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            std::uint64_t count = 0;
            const QueryStatus status = for_each_overlap(baked_->blob, box_of(boxes[i]), [&](TriangleId) { ++count; });
            if (is_refused(status)) throw std::runtime_error(std::string("a box is refused: ") + describe(status));
            counts[i] = count;
        }
    }
    [[nodiscard]] TreeWork count_rays(std::span<const Ray> rays) override {
        QueryCounters counters;
        for (const Ray& ray : rays) static_cast<void>(raycast(baked_->blob, ray, counters));
        TreeWork work;
        work.nodes = counters.nodes;
        work.leaves = counters.leaves;
        work.triangle_tests = counters.triangles;
        return work;
    }
    /// Counts the nodes whose boxes the query meets: the library counts no overlaps.
    [[nodiscard]] TreeWork count_boxes(std::span<const Aabb> boxes) override {
        TreeWork work;
        for (const Aabb& box : boxes) work += work_of(box_of(box));
        return work;
    }
    /// Compares the work of boxes with that of a loop over all nodes of a decoder that shares no code with the library.
    void recount(std::span<const Ray>, std::span<const std::vector<TriangleOnRay>>,
                 std::span<const Aabb> boxes) override {
        const tests::DecodedBlob decoded = tests::decode(baked_->bytes);
        for (const Aabb& box : boxes)
            if (work_of(box_of(box)) != work_of(decoded, box))
                throw std::runtime_error(name() + ": two counters differ for a box");
    }
    [[nodiscard]] bool is_textbook() const override { return false; }

private:
    [[nodiscard]] TreeWork work_of(const Box& box) const {
        TreeWork work;
        std::vector<char> is_visited(detail::data_of(baked_->blob).node_count, 0);
        is_visited[0] = 1;
        static_cast<void>(for_each_node(baked_->blob, [&](const TreeNode& node) {
            if (!is_visited[node.number]) return NodeVisit::skip;
            work.count_node();
            for (unsigned i = 0; i < node.child_count; ++i) {
                const TreeChild& child = node.children[i];
                work.count_box();
                if (!do_touch(child.box, box)) continue;
                if (child.is_leaf) work.count_leaf(child.count);
                else is_visited[child.node] = 1;
            }
            return NodeVisit::descend;
        }));
        return work;
    }
    [[nodiscard]] static TreeWork work_of(const tests::DecodedBlob& decoded, const Aabb& box) {
        tests::GridBox query;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto steps = [&](float at) {
                return static_cast<std::int32_t>(
                    std::ldexp(double(at) - double(decoded.origin[k]), -decoded.step_exponent));
            };
            query.low[k] = steps(box.low[k]);
            query.high[k] = steps(box.high[k]);
        }
        TreeWork work;
        std::vector<char> is_visited(decoded.nodes.size(), 0);
        is_visited[0] = 1;
        for (std::size_t i = 0; i < decoded.nodes.size(); ++i) {  // children come after their parents
            if (!is_visited[i]) continue;
            work.nodes += 1;
            work.box_tests += decoded.nodes[i].children.size();
            for (const tests::DecodedChild& child : decoded.nodes[i].children) {
                bool is_apart = false;
                for (std::size_t k = 0; k < 3; ++k)
                    is_apart |= child.box.high[k] < query.low[k] || child.box.low[k] > query.high[k];
                if (is_apart) continue;
                if (child.is_node) is_visited[child.node] = 1;
                work.leaves += child.is_node ? 0u : 1u;
                work.triangle_tests += child.is_node ? 0u : child.triangle_count;
            }
        }
        return work;
    }
    const BakedBlob* baked_;
};

}  // namespace

std::unique_ptr<TreeSystem> make_blob_system(const std::string& name, const BakedBlob& baked) {
    return std::make_unique<BlobSystem>(name, baked);
}

}  // namespace espalier::bench
