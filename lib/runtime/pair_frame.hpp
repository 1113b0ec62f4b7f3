// Two blobs moved onto one grid of integers, once: the pair of meshes that everything else answers exactly.
#pragma once

#include <cstdint>

#include <espalier/collide.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/read_profiles.hpp>
#include <runtime/small_code.hpp>
#include <runtime/triangle_triangle.hpp>

namespace espalier::detail {

struct PredictedVertices;

/// How boxes of the other tree look from a tree's own frame. Float, with slack: for rejecting only.
struct PairSide {
    float axis[3][3];     ///< component i of the other's unit axis j
#if !ESPALIER_SMALL_CODE  // there nine numbers on the stack are dearer than their signs
    float absolute_axis[3][3];
#endif
    float offset[3];    ///< where the other's lattice origin is
    float scale;        ///< of the other's lattice steps
    float own_scale;    ///< of this tree's lattice steps
    float slack;        ///< more than all roundings of both meshes and of the tests
    float common_size;  ///< one unit of this frame in steps of the common grid

    [[nodiscard]] float absolute_at(int i, int j) const {
#if ESPALIER_SMALL_CODE
        return absolute(axis[i][j]);
#else
        return absolute_axis[i][j];
#endif
    }
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

/// Finite, with a rotation of some length and a scale above 0.
bool is_valid(const Placement& placement) noexcept;

/// ok, or why not. Neither blob is empty.
QueryStatus place_pair(const BlobData& a, const BlobData& b, const Placement& placement, PairFrame& frame) noexcept;

}  // namespace espalier::detail
