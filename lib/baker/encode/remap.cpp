#include <baker/encode/remap.hpp>

#include <espalier/bake.hpp>
#include <espalier/format.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/checksum.hpp>

#include <baker/base/byte_writer.hpp>

namespace espalier {

namespace baker {

std::vector<OriginalTriangle> remap_of(const Source& source, const LatticeMesh& mesh, const WideTree& wide) {
    std::vector<OriginalTriangle> remap(wide.triangles.size());
    for (std::size_t i = 0; i < remap.size(); ++i) {
        remap[i] = original_triangle(source, mesh.triangles[wide.triangles[i]].original_id);
        remap[i].first_corner = wide.first_corners[i];
    }
    return remap;
}

}  // namespace baker

std::vector<std::byte> remap_file(const BakeResult& result) {
    using namespace format::remap;
    if (!result) return {};
    std::vector<std::byte> file;
    file.reserve(triangles_at + triangle_bytes * result.remap.size());
    baker::put_u32(file, magic);
    baker::put_u32(file, version);
    baker::put_u32(file, detail::load_u32(result.bytes.data() + format::header::checksum_at));
    baker::put_u32(file, 0);
    for (const OriginalTriangle& original : result.remap) {
        for (const std::uint32_t field : {original.file, original.mesh, original.triangle, original.first_corner})
            baker::put_u32(file, field);
    }
    baker::set_u32(file.data() + checksum_at, detail::checksum_of_blob(file));
    return file;
}

}  // namespace espalier
