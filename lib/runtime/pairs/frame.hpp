// Two blobs moved onto one grid of integers, once: the pair of meshes that everything else answers exactly.
#pragma once

#include <espalier/transform.hpp>
#include <runtime/kernels/triangle_triangle.hpp>

namespace espalier::detail {

struct PredictedVertices;

/// A triangle of each blob, by storage index.
struct TrianglePair {
    TriangleId a;
    TriangleId b;
    friend constexpr auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

/// How boxes of the other tree look from a tree's own frame. Float, with slack: for rejecting only.
struct PairSide {
    /// Vectors are as long as a register where there are such.
    static constexpr int row = small_code ? 3 : 4;

    float axis[3][row];  ///< the other's unit axes, one after the other
#if !ESPALIER_SMALL_CODE
    float absolute_axis[3][row];
#endif
    float offset[row];  ///< where the other's lattice origin is
    float scale;        ///< of the other's lattice steps
    float own_scale;    ///< of this tree's lattice steps
    float slack;        ///< more than all roundings of both meshes and of the tests
    float common_size;  ///< one unit of this frame in steps of the common grid

    /// Component i of the other's axis j.
    [[nodiscard]] float at(int i, int j) const { return axis[j][i]; }
#if ESPALIER_SMALL_CODE
    [[nodiscard]] float absolute_at(int i, int j) const { return absolute(axis[j][i]); }
    void set(int i, int j, float component) { axis[j][i] = component; }
#else
    [[nodiscard]] float absolute_at(int i, int j) const { return absolute_axis[j][i]; }
    void set(int i, int j, float component) {
        axis[j][i] = component;
        absolute_axis[j][i] = absolute(component);
    }
#endif
};

struct PairFrame {
    const BlobData* a;
    const BlobData* b;
    int shift;                  ///< the grid's step is 2^shift of a's lattice steps
    int fraction_bits;          ///< of matrix and translation
    std::int32_t matrix[3][3];  ///< b's lattice to the grid
    std::int64_t translation[3];
    float a_scale;  ///< 2^-shift
    float a_round;  ///< 2^23 when a's vertices are to be rounded, else 0: added and taken away again
    float gap;      ///< between the placed bounds along some axis, at least
    float span;     ///< the longest side of the two bounds
    PairSide sides[2];
#if ESPALIER_PREDICTED_STRIPS
    PredictedVertices* vertices;  ///< room for those of a leaf of a and one of b, where either has predicted strips
#endif

    [[nodiscard]] const BlobData& blob(unsigned side) const { return side == 0 ? *a : *b; }
    /// One step of a blob's lattice.
    [[nodiscard]] float unit(unsigned side) const { return side == 0 ? a_scale : sides[1].common_size; }
    /// A coordinate of a on the grid.
    [[nodiscard]] std::int32_t place_a(std::int32_t q) const {
        return static_cast<std::int32_t>((static_cast<float>(q) * a_scale + a_round) - a_round);
    }
    /// A vertex of b on the grid.
    void place_b(const std::int32_t* v, std::int32_t* placed) const {
        for (int k = 0; k < 3; ++k)
            placed[k] =
                static_cast<std::int32_t>((std::int64_t{matrix[k][0]} * v[0] + std::int64_t{matrix[k][1]} * v[1] +
                                           std::int64_t{matrix[k][2]} * v[2] + translation[k]) >>
                                          fraction_bits);
    }
    [[nodiscard]] ESPALIER_SHARED_CODE LatticeTriangle place_a(const LatticeTriangle& t) const {
        LatticeTriangle placed;
        for (int corner = 0; corner < 3; ++corner)
            for (int k = 0; k < 3; ++k) placed.corner[corner][k] = place_a(t.corner[corner][k]);
        return placed;
    }
    [[nodiscard]] ESPALIER_SHARED_CODE LatticeTriangle place_b(const LatticeTriangle& t) const {
        LatticeTriangle placed;
        for (int corner = 0; corner < 3; ++corner) place_b(t.corner[corner], placed.corner[corner]);
        return placed;
    }
};

/// The triangles that a pair stands for, where it is one of copies.
TrianglePair owners(const PairFrame& frame, const TrianglePair& pair);

/// Whether the bounds of two blobs are surely farther apart than a distance in a's space, b being placed by a valid
/// transform (docs/numerics.md). Costs a fraction of placing b, and is false for what place_pair() refuses.
bool are_apart(const BlobData& a, const BlobData& b, const Transform& b_in_a, float distance) noexcept;

/// Places b in the local space of a by a valid transform. Returns ok or out_of_range. Neither blob is empty.
QueryStatus place_pair(const BlobData& a, const BlobData& b, const Transform& b_in_a, PairFrame& frame) noexcept;

}  // namespace espalier::detail
