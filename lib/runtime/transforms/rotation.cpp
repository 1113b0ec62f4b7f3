#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

bool is_valid(const Transform& transform) noexcept {
    const float numbers[8] = {transform.rotation.x,    transform.rotation.y,    transform.rotation.z,
                              transform.rotation.w,    transform.translation.x, transform.translation.y,
                              transform.translation.z, transform.scale};
    for (const float x : numbers)
        if (!is_finite(x)) return false;
    std::uint32_t turn = 0;
    for (int k = 0; k < 4; ++k) turn |= magnitude_bits(numbers[k]);
    return turn != 0 && magnitude_bits(transform.scale) != 0 && !is_negative(transform.scale);
}

bool is_identity(const Transform& transform) noexcept {
    const Quaternion& rotation = transform.rotation;
    const Vec3& translation = transform.translation;
    constexpr std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);
    return (magnitude_bits(rotation.x) | magnitude_bits(rotation.y) | magnitude_bits(rotation.z) |
            magnitude_bits(translation.x) | magnitude_bits(translation.y) | magnitude_bits(translation.z)) == 0 &&
           std::bit_cast<std::uint32_t>(rotation.w) == one && std::bit_cast<std::uint32_t>(transform.scale) == one;
}

int make_greatest_one(float* numbers, int count) noexcept {
    std::uint32_t greatest = 0;
    for (int i = 0; i < count; ++i)
        greatest = magnitude_bits(numbers[i]) > greatest ? magnitude_bits(numbers[i]) : greatest;
    if (greatest == 0 || greatest >= infinity_bits) return no_exponent;
    const int exponent = exponent_of_bits(greatest);
    for (int i = 0; i < count; ++i) {
        numbers[i] = scale_by_power_of_two(numbers[i], -exponent);
        if (magnitude_bits(numbers[i]) < std::bit_cast<std::uint32_t>(0x1p-40f)) numbers[i] = 0.0f;
    }
    return exponent;
}

Quaternion with_greatest_of_one(const Quaternion& rotation) noexcept {
    float q[4] = {rotation.x, rotation.y, rotation.z, rotation.w};
    if (make_greatest_one(q, 4) == no_exponent) return {not_a_number, not_a_number, not_a_number, not_a_number};
    return {q[0], q[1], q[2], q[3]};
}

#if ESPALIER_SMALL_CODE

namespace {

float product(float a, float b) { return without_tiny(a * b); }

}  // namespace

PreparedTransform::PreparedTransform(const Transform& transform) noexcept
    : translation_(without_tiny(transform.translation)),
      scale_(is_in_range(transform.scale) ? transform.scale : not_a_number) {
    const Quaternion rotation = with_greatest_of_one(transform.rotation);
    const float q[3] = {rotation.x, rotation.y, rotation.z}, w = rotation.w;
    const float squares[3] = {q[0] * q[0], q[1] * q[1], q[2] * q[2]}, ww = w * w;
    const float n = (squares[0] + squares[1]) + (squares[2] + ww);
    for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        entry_[4 * i] = ((ww + squares[i]) - (squares[j] + squares[k])) / n;
        entry_[3 * i + j] = 2.0f * (q[i] * q[j] - w * q[k]) / n;
        entry_[3 * j + i] = 2.0f * (q[i] * q[j] + w * q[k]) / n;
    }
}

Vec3 PreparedTransform::rotated(const Vec3& v) const noexcept { return multiplied(v, 3, 1); }
Vec3 PreparedTransform::rotated_back(const Vec3& v) const noexcept { return multiplied(v, 1, 3); }

Vec3 PreparedTransform::multiplied(const Vec3& v, int row, int column) const noexcept {
    const auto coordinate = [&](const float* entry) {
        return product(entry[0], v.x) + product(entry[column], v.y) + product(entry[2 * column], v.z);
    };
    return {coordinate(entry_), coordinate(entry_ + row), coordinate(entry_ + 2 * row)};
}

Vec3 PreparedTransform::direction_to_local(const Vec3& v) const noexcept {
    return for_each_coordinate(rotated_back(without_tiny(v)), [&](float x) { return length_to_local(x); });
}

Vec3 PreparedTransform::direction_to_world(const Vec3& v) const noexcept {
    return rotated(for_each_coordinate(v, [&](float x) { return length_to_world(x); }));
}

Vec3 PreparedTransform::point_to_local(const Vec3& p) const noexcept {
    const Vec3 from = without_tiny(p);
    return direction_to_local({from.x - translation_.x, from.y - translation_.y, from.z - translation_.z});
}

Vec3 PreparedTransform::point_to_world(const Vec3& p) const noexcept {
    return sum(direction_to_world(p), translation_);
}

#endif

}  // namespace espalier::detail
