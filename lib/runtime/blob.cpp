// What a blob says about itself.
#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/lattice_world.hpp>

namespace espalier {

using namespace detail;

float Blob::step() const noexcept { return power_of_two(data_.step_exponent); }

Vec3 Blob::bounds_min() const noexcept {
    return data_.triangle_count == 0 ? Vec3{} : Vec3{data_.origin[0], data_.origin[1], data_.origin[2]};
}

Vec3 Blob::bounds_max() const noexcept { return data_.triangle_count == 0 ? Vec3{} : to_world(data_, data_.extent); }

std::uint16_t material(const Blob& blob, Triangle triangle) noexcept {
    const BlobData& data = blob.data();
    if (data.materials == nullptr || triangle.index >= data.triangle_count) return 0;
    return static_cast<std::uint16_t>((data.features & format::feature::materials_16) != 0
                                          ? load_u16(data.materials + 2 * std::size_t{triangle.index})
                                          : load_u8(data.materials + triangle.index));
}

}  // namespace espalier
