// The rotation, scale and translation of a matrix, after Shepperd (1978).
#include <runtime/base/bits.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier {

using namespace detail;

namespace {

/// A 3 x 3 matrix times 2^-exponent, with a greatest entry in [1, 2).
struct ScaledMatrix {
    float entry[9];  ///< row by row
    int exponent;    ///< no_exponent if the matrix is zero or not finite

    explicit ScaledMatrix(const float (&rows)[3][4]) {
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) entry[3 * i + k] = rows[i][k];
        exponent = make_greatest_one(entry, 9);
    }

    [[nodiscard]] float at(int row, int column) const { return entry[3 * row + column]; }
    [[nodiscard]] float dot_of_columns(int i, int j) const {
        return at(0, i) * at(0, j) + at(1, i) * at(1, j) + at(2, i) * at(2, j);
    }
    [[nodiscard]] float determinant() const {
        const auto minor = [&](int i, int j) { return at(1, i) * at(2, j) - at(1, j) * at(2, i); };
        return at(0, 0) * minor(1, 2) - at(0, 1) * minor(0, 2) + at(0, 2) * minor(0, 1);
    }
    /// Returns whether it is a rotation times the root of `squared_scale`, nearly.
    [[nodiscard]] bool is_similarity(float squared_scale) const {
        const float slack = 0x1p-12f * squared_scale;
        for (int i = 0; i < 3; ++i) {
            if (!(absolute(dot_of_columns(i, i) - squared_scale) <= slack)) return false;
            if (!(absolute(dot_of_columns(i, i == 2 ? 0 : i + 1)) <= slack)) return false;
        }
        return determinant() > 0.0f;
    }
    /// The rotation, whose greatest component is 1, of such a matrix.
    [[nodiscard]] Quaternion rotation(float scale) const {
        const float trace = at(0, 0) + at(1, 1) + at(2, 2);
        int top = 3;
        for (int k = 0; k < 3; ++k)
            if (at(k, k) > (top == 3 ? trace : at(top, top))) top = k;
        float q[4];
        if (top == 3) {
            q[3] = scale + trace;
            for (int k = 0; k < 3; ++k) q[k] = at(last(k), next(k)) - at(next(k), last(k));
        } else {
            const int i = next(top), j = last(top);
            q[top] = scale + at(top, top) - at(i, i) - at(j, j);
            q[i] = at(i, top) + at(top, i);
            q[j] = at(j, top) + at(top, j);
            q[3] = at(j, i) - at(i, j);
        }
        return {q[0] / q[top], q[1] / q[top], q[2] / q[top], q[3] / q[top]};
    }

private:
    static int next(int k) { return k == 2 ? 0 : k + 1; }
    static int last(int k) { return k == 0 ? 2 : k - 1; }
};

}  // namespace

Result<Transform> transform_from_matrix(const float (&rows)[3][4]) noexcept {
    Result<Transform> result;
    result.status = QueryStatus::invalid_argument;
    const ScaledMatrix matrix(rows);
    if (matrix.exponent == no_exponent || !is_finite(rows[0][3]) || !is_finite(rows[1][3]) || !is_finite(rows[2][3]))
        return result;
    const float squared_scale =
        (matrix.dot_of_columns(0, 0) + matrix.dot_of_columns(1, 1) + matrix.dot_of_columns(2, 2)) / 3.0f;
    if (!matrix.is_similarity(squared_scale)) return result;
    const float scale = square_root(squared_scale);
    const float in_units = scale_by_power_of_two(scale, matrix.exponent);
    result.status = QueryStatus::out_of_range;
    if (magnitude_bits(in_units) < least_coordinate_bits ||
        magnitude_bits(in_units) > std::bit_cast<std::uint32_t>(greatest_scale))
        return result;
    result.value = {matrix.rotation(scale), {rows[0][3], rows[1][3], rows[2][3]}, in_units};
    result.status = QueryStatus::ok;
    return result;
}

}  // namespace espalier
