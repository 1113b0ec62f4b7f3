// What a blob says about itself and where its triangles came from.
#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/id_field.hpp>
#include <runtime/lattice_world.hpp>

namespace espalier {

using namespace detail;

float Blob::step() const noexcept { return power_of_two(data_.step_exponent); }

Vec3 Blob::bounds_min() const noexcept {
    return data_.triangle_count == 0 ? Vec3{} : Vec3{data_.origin[0], data_.origin[1], data_.origin[2]};
}

Vec3 Blob::bounds_max() const noexcept { return data_.triangle_count == 0 ? Vec3{} : to_world(data_, data_.extent); }

bool original_triangle(const Blob& blob, Triangle triangle, OriginalTriangle& original) noexcept {
    const BlobData& data = blob.data();
    if (data.ids == nullptr || triangle.index >= data.triangle_count) return false;
    const std::uint64_t field = id_field(data, triangle.index);
    const unsigned corner_bits = format::first_corner_bits(data.profile);
    const std::uint64_t id = field >> corner_bits;

    std::uint32_t low = 0;  // the last source that begins at or before the id
    std::uint32_t high = data.source_count;
    while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        (load_u32(data.sources + std::size_t{middle} * format::source::bytes) <= id ? low : high) = middle;
    }
    const std::byte* source = data.sources + std::size_t{low} * format::source::bytes;
    original.file = load_u32(source + format::source::file_at);
    original.mesh = load_u32(source + format::source::mesh_at);
    original.triangle = static_cast<std::uint32_t>(id) - load_u32(source + format::source::first_at);
    original.first_corner = static_cast<std::uint32_t>(field & ((1u << corner_bits) - 1u));
    return true;
}

std::uint16_t material(const Blob& blob, Triangle triangle) noexcept {
    const BlobData& data = blob.data();
    if (data.materials == nullptr || triangle.index >= data.triangle_count) return 0;
    return static_cast<std::uint16_t>((data.features & format::feature::materials_16) != 0
                                          ? load_u16(data.materials + 2 * std::size_t{triangle.index})
                                          : load_u8(data.materials + triangle.index));
}

}  // namespace espalier
