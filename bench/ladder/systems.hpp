// The trees that are compared, behind one interface: textbook layouts, and blobs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "recount.hpp"
#include "subject.hpp"
#include "work.hpp"

namespace espalier::bench {

struct TreeBytes {
    std::size_t nodes = 0;
    std::size_t node_bytes = 0;  ///< of one
    std::size_t all_bytes = 0;   ///< of the nodes and of the triangles
};

class TreeSystem {
public:
    explicit TreeSystem(std::string name) : name_(std::move(name)) {}
    virtual ~TreeSystem() = default;
    TreeSystem(const TreeSystem&) = delete;
    TreeSystem& operator=(const TreeSystem&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] virtual unsigned degree() const = 0;
    [[nodiscard]] virtual TreeBytes bytes() const = 0;

    /// Writes t of each ray's closest hit, or infinity.
    virtual void find_closest(std::span<const Ray> rays, std::span<float> hits) = 0;
    /// Writes how many triangles touch each box.
    virtual void count_touching(std::span<const Aabb> boxes, std::span<std::uint64_t> counts) = 0;

    /// Adds up the work of queries. A blob's rays have no number of box tests.
    [[nodiscard]] virtual TreeWork count_rays(std::span<const Ray> rays) = 0;
    [[nodiscard]] virtual TreeWork count_boxes(std::span<const Aabb> boxes) = 0;

    /// Throws std::runtime_error if a second counter counts other work for one of the queries. `hits` has the triangles
    /// on each ray.
    virtual void recount(std::span<const Ray> rays, std::span<const std::vector<TriangleOnRay>> hits,
                         std::span<const Aabb> boxes) = 0;

    /// Whether answers are those of the same test of triangles in double; a blob's are exact.
    [[nodiscard]] virtual bool is_textbook() const = 0;

private:
    std::string name_;
};

/// The shapes over one binary tree that the systems are made from.
struct LadderShapes {
    LadderShapes(const LadderSubject& subject, unsigned leaf_triangles);
    TreeShape single;  ///< a triangle in each leaf
    TreeShape several;
    TreeShape wide_4, wide_8, wide_16;  ///< with the leaves of `several`
};

using TreeSystems = std::vector<std::unique_ptr<TreeSystem>>;
/// Returns the steps of the ladder.
[[nodiscard]] TreeSystems ladder_systems(const LadderSubject& subject, const LadderShapes& shapes);
/// Returns the trees of each degree.
[[nodiscard]] TreeSystems degree_systems(const LadderSubject& subject, const LadderShapes& shapes);

[[nodiscard]] std::unique_ptr<TreeSystem> make_blob_system(const std::string& name, const BakedBlob& baked);

}  // namespace espalier::bench
