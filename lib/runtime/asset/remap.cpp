// Reading the remap file that lies beside a blob.
#include <espalier/original.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/checksum.hpp>

namespace espalier {

OpenStatus read_remap(std::span<const std::byte> file, const Blob& blob, std::span<OriginalTriangle> remap) noexcept {
    using namespace detail;
    using namespace format::remap;
    static_assert(magic_at == 0);
    if (file.size() < triangles_at || load_u32(file.data()) != magic || load_u32(file.data() + version_at) != version ||
        load_u32(file.data() + checksum_at) != checksum_of_blob(file) || file.size() % triangle_bytes != 0)
        return OpenStatus::not_a_remap;
    const std::byte* at = file.data() + triangles_at;
    const std::size_t count = (file.size() - triangles_at) / triangle_bytes;
    for (std::size_t i = 0; i < count; ++i)
        if (load_u32(at + triangle_bytes * i + 12) > 2) return OpenStatus::not_a_remap;
    if (load_u32(file.data() + blob_checksum_at) != blob.checksum() || count != blob.triangle_count() ||
        count != remap.size())
        return OpenStatus::other_blob;
    for (OriginalTriangle& original : remap) {
        original = {load_u32(at), load_u32(at + 4), load_u32(at + 8), load_u32(at + 12)};
        at += triangle_bytes;
    }
    return OpenStatus::ok;
}

}  // namespace espalier
