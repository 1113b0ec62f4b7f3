// How points spread: their covariance matrix, and its eigenvectors, which are the axes of a box (Gottschalk, Lin,
// Manocha 1996). In float for refits, which have to be fast, and in double.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

template <class Real>
using SymmetricMatrix = std::array<std::array<Real, 3>, 3>;

/// Adds up points. They are relative to one of them, which keeps the numbers small.
template <class Real>
class PointCovariance {
public:
    void add(Real x, Real y, Real z) {
        sum_[0] += x, sum_[1] += y, sum_[2] += z;
        products_[0] += x * x, products_[1] += y * y, products_[2] += z * z;
        products_[3] += x * y, products_[4] += y * z, products_[5] += z * x;
    }
    [[nodiscard]] SymmetricMatrix<Real> of(std::size_t count) const {
        const Real share = Real(1) / static_cast<Real>(count);
        const auto entry = [&](std::size_t product, std::size_t i, std::size_t j) {
            return products_[product] * share - (sum_[i] * share) * (sum_[j] * share);
        };
        const Real xy = entry(3, 0, 1), yz = entry(4, 1, 2), zx = entry(5, 2, 0);
        return {{{entry(0, 0, 0), xy, zx}, {xy, entry(1, 1, 1), yz}, {zx, yz, entry(2, 2, 2)}}};
    }

private:
    Real sum_[3] = {};
    Real products_[6] = {};
};

/// Returns three perpendicular eigenvectors of length 1, by Jacobi's rotations, which stop where what is left outside
/// of the diagonal is at most `rest` of the trace.
template <class Real>
std::array<std::array<Real, 3>, 3> eigenvectors_of(SymmetricMatrix<Real> matrix, Real rest) {
    std::array<std::array<Real, 3>, 3> vectors = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (unsigned sweep = 0; sweep < 8; ++sweep) {
        const Real trace = std::abs(matrix[0][0]) + std::abs(matrix[1][1]) + std::abs(matrix[2][2]);
        const Real outside = std::abs(matrix[0][1]) + std::abs(matrix[1][2]) + std::abs(matrix[0][2]);
        if (!(outside > rest * trace)) break;
        for (std::size_t p = 0; p < 2; ++p)
            for (std::size_t q = p + 1; q < 3; ++q) {
                if (matrix[p][q] == Real(0)) continue;
                const Real theta = (matrix[q][q] - matrix[p][p]) / (Real(2) * matrix[p][q]);
                const Real tangent =
                    std::copysign(Real(1), theta) / (std::abs(theta) + std::sqrt(theta * theta + Real(1)));
                const Real cosine = Real(1) / std::sqrt(tangent * tangent + Real(1)), sine = tangent * cosine;
                const std::size_t r = 3 - p - q;
                const Real pr = matrix[p][r], qr = matrix[q][r], shift = tangent * matrix[p][q];
                matrix[p][p] -= shift;
                matrix[q][q] += shift;
                matrix[p][q] = matrix[q][p] = Real(0);
                matrix[p][r] = matrix[r][p] = cosine * pr - sine * qr;
                matrix[q][r] = matrix[r][q] = sine * pr + cosine * qr;
                for (std::size_t k = 0; k < 3; ++k) {
                    const Real a = vectors[p][k], b = vectors[q][k];
                    vectors[p][k] = cosine * a - sine * b;
                    vectors[q][k] = sine * a + cosine * b;
                }
            }
    }
    return vectors;
}

}  // namespace espalier::bench
