// Deformable meshes: the parts that move and that stay, and whole blobs of both.
#include <espalier/deformation.hpp>

#include <runtime/blob/checksum.hpp>
#include <runtime/lattice/to_local.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Tests whether two ranges of bytes share none.
bool are_apart(const std::byte* a, std::size_t a_size, const std::byte* b, std::size_t b_size) {
    const auto at_a = reinterpret_cast<std::uintptr_t>(a), at_b = reinterpret_cast<std::uintptr_t>(b);
    return at_a < at_b ? a_size <= at_b - at_a : b_size <= at_a - at_b;
}

/// Copies bytes that may overlap.
void move_bytes(std::byte* to, const std::byte* from, std::size_t count) { ESPALIER_MOVE_BYTES(to, from, count); }

}  // namespace

std::uint32_t Deformable::position_count() const noexcept {
    return *this ? load_u32(data_of(blob_).bytes + format::header::position_count_at) : 0;
}

Box Deformable::range() const noexcept {
    if (!*this) return {};
    const BlobData& data = data_of(blob_);
    return {{data.origin[0], data.origin[1], data.origin[2]}, to_local(data, data.extent)};
}

std::size_t deformable_bytes(const Blob& blob) noexcept {
    const BlobData& data = data_of(blob);
    if (!blob.is_deformable()) return 0;
    return format::header::bytes + std::size_t{data.node_count} * format::plain_node::bytes + data.leaf_bytes +
           format::guard_bytes;
}

QueryStatus Deformable::create(const Blob& blob, std::byte* memory) noexcept {
    const BlobData& from = data_of(blob);
    const std::size_t moving = deformable_bytes(blob);
    // The first section behind the guard; the blob of another Deformable has them elsewhere than the moving part.
    still_ = from.sources != nullptr ? from.sources : from.materials != nullptr ? from.materials : from.corners;
    if (!are_apart(memory, moving, still_, blob.size() - moving)) return QueryStatus::invalid_argument;
    blob_ = blob;
    memory_ = memory;
    move_bytes(memory, from.bytes, moving);
    blob_.data_.bytes = memory;
    blob_.data_.nodes = memory + (from.nodes - from.bytes);
    blob_.data_.leaves = memory + (from.leaves - from.bytes);
    return QueryStatus::ok;
}

Deformable create_deformable(const Blob& blob, std::span<std::byte> memory) noexcept {
    Deformable mesh;
    if (!blob) return mesh;
    const std::size_t moving = deformable_bytes(blob);
    if (moving == 0) mesh.refusal_ = QueryStatus::no_data;
    else if (memory.size() < moving) mesh.refusal_ = QueryStatus::no_room;
    else mesh.refusal_ = mesh.create(blob, memory.data());
    return mesh;
}

QueryStatus seal(const Deformable& mesh, std::span<std::byte> bytes) noexcept {
    if (!mesh) return mesh.status();
    if (bytes.size() != mesh.blob_.size()) return QueryStatus::no_room;
    const std::size_t moving = deformable_bytes(mesh.blob_), staying = bytes.size() - moving;
    const auto is_in_place_or_apart = [&](const std::byte* part, std::size_t size, const std::byte* place) {
        return part == place || are_apart(part, size, bytes.data(), bytes.size());
    };
    if (!is_in_place_or_apart(mesh.memory_, moving, bytes.data()) ||
        !is_in_place_or_apart(mesh.still_, staying, bytes.data() + moving))
        return QueryStatus::invalid_argument;
    move_bytes(bytes.data() + moving, mesh.still_, staying);
    move_bytes(bytes.data(), mesh.memory_, moving);
    store_u32(bytes.data() + format::header::checksum_at, checksum_of_blob(bytes));
    return QueryStatus::ok;
}

}  // namespace espalier
