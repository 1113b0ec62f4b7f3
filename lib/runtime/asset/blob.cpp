// The bounds of a blob, where it lies in the source, and the materials of its triangles.
#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/deformable_blob.hpp>
#include <runtime/blob/source_origin.hpp>
#include <runtime/lattice/to_local.hpp>

namespace espalier {

using namespace detail;

Box Blob::bounds() const noexcept {
    if (data_.triangle_count == 0) return {};
    if (!is_deformable()) return {{data_.origin[0], data_.origin[1], data_.origin[2]}, to_local(data_, data_.extent)};
    const PoseBounds bounds = pose_bounds_of(data_);
    return {to_local(data_, bounds.low), to_local(data_, bounds.high)};
}

Vec3d Blob::source_origin() const noexcept {
    if ((data_.features & format::feature::source_origin) == 0) return {};
    return load_source_origin(data_.bytes + data_.size - format::source_origin::bytes);  // the last section
}

std::uint16_t material(const Blob& blob, TriangleId triangle) noexcept {
    const BlobData& data = data_of(blob);
    if (data.materials == nullptr || triangle.index >= data.triangle_count) return 0;
    return static_cast<std::uint16_t>((data.features & format::feature::materials_16) != 0
                                          ? load_u16(data.materials + 2 * std::size_t{triangle.index})
                                          : load_u8(data.materials + triangle.index));
}

}  // namespace espalier
