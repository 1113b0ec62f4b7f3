// What a blob says about itself and where its triangles came from.
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

bool original_triangle(const Blob& blob, Triangle triangle, OriginalTriangle& original) noexcept {
    const BlobData& data = blob.data();
    if (data.ids == nullptr || triangle.index >= data.triangle_count) return false;
    const std::uint64_t bit = std::uint64_t{triangle.index} * data.id_bits;
    std::uint64_t window = 0;  // the field may begin in any bit of a byte: up to five bytes
    for (unsigned i = 0; i < (bit % 8 + data.id_bits + 7) / 8; ++i)
        window |= std::uint64_t{load_u8(data.ids + bit / 8 + i)} << (8 * i);
    const std::uint64_t id = (window >> (bit % 8)) & ((std::uint64_t{1} << data.id_bits) - 1);

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
