// What a subdivision of space shares: triangles that are referenced from several cells, and mailboxes that keep a query
// from testing one of them again.
#pragma once

#include "../exactness/edge_rays.hpp"
#include "../exactness/kernels.hpp"
#include "../study/walks.hpp"
#include "../study/shapes.hpp"

namespace espalier::bench {

/// A number for each triangle: the last query that tested it (Arnaldi, Priol, Bouatouch 1987).
class Mailboxes {
public:
    explicit Mailboxes(std::size_t triangles) : last_(triangles, 0) {}

    void begin_query() { ++query_; }
    /// Returns whether the triangle has not been tested by this query, and marks it.
    [[nodiscard]] bool take(std::uint32_t triangle) {
        if (last_[triangle] == query_) return false;
        last_[triangle] = query_;
        return true;
    }
    [[nodiscard]] std::size_t bytes() const { return last_.size() * sizeof(std::uint32_t); }

private:
    std::vector<std::uint32_t> last_;
    std::uint32_t query_ = 0;
};

/// By how much cells count as larger when triangles are put into them, as a share of the largest coordinate. A ray that
/// floats lead past the corner of a cell then finds its triangles in the next one.
inline constexpr float cell_margin_share = 0x1p-19f;

inline Aabb box_of(const FloatTriangle& triangle) {
    Aabb box = Aabb::none();
    for (const Vec3& corner : triangle) box.add(corner);
    return box;
}

inline Aabb box_of(std::span<const FloatTriangle> triangles) {
    Aabb box = Aabb::none();
    for (const FloatTriangle& triangle : triangles) box.add(box_of(triangle));
    return box;
}

inline float largest_coordinate(const Aabb& box) {
    float largest = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
    return largest;
}

inline Aabb grown(Aabb box, float margin) {
    for (std::size_t k = 0; k < 3; ++k) box.low[k] -= margin, box.high[k] += margin;
    return box;
}

/// A test of a ray and a triangle that rounds to floats.
using FloatTest = MollerTrumbore<float>;

/// A ray as slabs take it: the inverse of a direction of 0 is a large number.
struct FloatRay {
    explicit FloatRay(const Ray& ray)
        : line{point_of(ray.origin), point_of(ray.direction)},
          origin{ray.origin.x, ray.origin.y, ray.origin.z},
          direction{ray.direction.x, ray.direction.y, ray.direction.z} {
        for (std::size_t k = 0; k < 3; ++k) inverse[k] = inverse_of(direction[k]);
        FloatTest::prepare(ray, prepared);
    }
    /// Returns t of the hit of triangle `index`, or infinity.
    [[nodiscard]] double hit(const FloatTriangle& triangle, std::size_t index, const FloatTest* float_test) const {
        if (float_test != nullptr) return static_cast<double>(float_test->test(prepared, index));
        return meets(corners_of(triangle), line).value_or(std::numeric_limits<double>::infinity());
    }
    /// Returns whether it meets the box, and where it enters and leaves it.
    [[nodiscard]] bool meets_box(const Aabb& box, float& enter, float& leave) const {
        enter = 0.0f, leave = std::numeric_limits<float>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            const float one = (box.low[k] - origin[k]) * inverse[k], other = (box.high[k] - origin[k]) * inverse[k];
            enter = std::max(enter, std::min(one, other));
            leave = std::min(leave, std::max(one, other));
        }
        return enter <= leave;
    }

    Line line;
    FloatTest::Prepared prepared;
    std::array<float, 3> origin, direction, inverse{};
};

/// A structure over the triangles of a mesh.
class Structure {
public:
    Structure() = default;
    Structure(const Structure&) = delete;
    Structure& operator=(const Structure&) = delete;
    virtual ~Structure() = default;

    /// Returns t of the closest hit, or infinity. The box tests that it counts are visits of cells or nodes.
    [[nodiscard]] virtual double closest(const Ray& ray, RayWork& work) = 0;
    /// Counts the triangles that touch the box.
    [[nodiscard]] virtual std::size_t count_touching(const Aabb& box, RayWork& work) = 0;

    std::string name;
    double build_seconds = 0.0;  ///< processor time
    std::size_t cells = 0;       ///< or nodes
    std::size_t references = 0;  ///< to triangles
    std::size_t bytes = 0;
    bool has_triangles = false;  ///< in these bytes
    bool has_work = true;        ///< queries count it
    bool is_reference = true;    ///< all such structures have the same answers
};

/// A structure whose cells have references to the triangles that touch them. The triangles outlive it.
class CellStructure : public Structure {
protected:
    /// `margin`: of cells, when triangles are put into them. Rays test triangles in double, or by `float_test`.
    CellStructure(const char* called, std::span<const FloatTriangle> triangles, float margin,
                  const FloatTest* float_test)
        : triangles_(triangles),
          margin_(margin),
          float_test_(float_test),
          box_(box_of(triangles)),
          mailboxes_(triangles.size()) {
        name = called;
        box_ = grown(box_, largest_coordinate(box_) * cell_margin_share);
    }
    /// Notes what was built: so many cells, and their bytes beside the references.
    void finish(std::size_t cell_count, std::size_t cell_bytes) {
        build_seconds = time_.seconds();
        cells = cell_count;
        references = references_.size();
        bytes = cell_bytes + references * sizeof(std::uint32_t) + mailboxes_.bytes();
    }

    ProcessorTime time_;  // begins before the rest
    std::span<const FloatTriangle> triangles_;
    float margin_;
    const FloatTest* float_test_;
    Aabb box_;
    std::vector<std::uint32_t> references_;
    Mailboxes mailboxes_;
};

// A uniform grid: equal cells, each with the triangles that touch it.

/// Rays walk from cell to cell by "A fast voxel traversal algorithm for ray tracing" (Amanatides, Woo 1987).
class UniformGrid final : public CellStructure {
public:
    /// Makes about `density` cells for each triangle (Cleary, Wyvill 1988), as cubes as the box allows.
    UniformGrid(std::span<const FloatTriangle> triangles, double density, float margin, const FloatTest* float_test);

    [[nodiscard]] double closest(const Ray& ray, RayWork& work) override;
    [[nodiscard]] std::size_t count_touching(const Aabb& box, RayWork& work) override;

private:
    [[nodiscard]] int cell_of(float coordinate, std::size_t axis) const;
    [[nodiscard]] Aabb box_of_cell(int x, int y, int z) const;
    [[nodiscard]] std::size_t number_of(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(count_[0]) +
               static_cast<std::size_t>(x);
    }
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::size_t cell) const {
        return std::span(references_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
    }
    /// Calls `function(cell)` for each cell that the triangle touches.
    template <class Function>
    void for_each_cell(const FloatTriangle& triangle, Function function) const;

    std::array<int, 3> count_{};
    std::array<float, 3> size_{};
    std::vector<std::uint32_t> first_;  ///< of each cell, in the references; one more at the end
};

// A k-d tree: space is split by planes across the axes, and each leaf has the triangles that touch its box.

/// A node of 8 bytes. The first child follows its parent.
struct KdNode {
    union {
        float split;          ///< where the plane is
        std::uint32_t first;  ///< of a leaf, in the references
    };
    std::uint32_t axis_and_rest;  ///< 0 to 2 and the second child, or 3 and the number of a leaf's references

    [[nodiscard]] bool is_leaf() const { return (axis_and_rest & 3u) == 3u; }
    [[nodiscard]] std::size_t axis() const { return axis_and_rest & 3u; }
    [[nodiscard]] std::uint32_t rest() const { return axis_and_rest >> 2; }
};
static_assert(sizeof(KdNode) == 8);

/// Splits have the least expected cost (MacDonald, Booth 1990), of planes beside the ends of all triangles where there
/// are few, and of 32 planes along each axis where there are many; with the costs and the bonus for empty space of "On
/// building fast kd-trees for ray tracing" (Wald, Havran 2006).
class KdTree final : public CellStructure {
public:
    KdTree(std::span<const FloatTriangle> triangles, float margin, const FloatTest* float_test);

    [[nodiscard]] double closest(const Ray& ray, RayWork& work) override;
    [[nodiscard]] std::size_t count_touching(const Aabb& box, RayWork& work) override;

private:
    struct Split {
        std::size_t axis = 3;  ///< 3: none is worth it
        float at = 0.0f;
    };
    struct Waiting {
        std::uint32_t node;
        float enter, leave;
    };
    class SplitSearch;
    void try_ends(SplitSearch& search, std::size_t axis, std::span<const std::uint32_t> triangles) const;
    void try_bins(SplitSearch& search, std::size_t axis, const Aabb& box,
                  std::span<const std::uint32_t> triangles) const;
    [[nodiscard]] Split best_split(const Aabb& box, std::span<const std::uint32_t> triangles) const;
    void build(const Aabb& box, std::vector<std::uint32_t> triangles, unsigned depth);
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(const KdNode& leaf) const {
        return std::span(references_).subspan(leaf.first, leaf.rest());
    }

    unsigned most_depth_ = 0;
    std::vector<KdNode> nodes_;
    std::vector<Waiting> stack_;
    std::vector<std::uint32_t> boxes_stack_;
};

// The structures that are compared.

/// A mesh on a lattice, whose floats represent it exactly, and its textbook tree.
struct SubdivisionSubject {
    SnappedMesh snapped;
    TreeAndBlob built;
};
/// Throws std::runtime_error with the mesh's name.
[[nodiscard]] SubdivisionSubject make_subdivision_subject(Mesh mesh);

/// Returns the textbook tree, a grid, a k-d tree and Espalier. The subject outlives them.
[[nodiscard]] std::vector<std::unique_ptr<Structure>> all_structures(const SubdivisionSubject& subject);
/// Returns the textbook structures with another test of rays and triangles, which outlives them, as the subject does.
[[nodiscard]] std::vector<std::unique_ptr<Structure>> structures_with_float_test(const SubdivisionSubject& subject,
                                                                                 const FloatTest& float_test);

}  // namespace espalier::bench
