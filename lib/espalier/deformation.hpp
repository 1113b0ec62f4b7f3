// Meshes that change their vertices and keep their triangles: cloth, characters, soft robots, terrain that is dug.
//
// bake() with BakeOptions::deformation makes a deformable blob. create_deformable() copies the part that moves to the
// caller's memory, and refit() moves the vertices there and renews the boxes above them. Every query takes
// Deformable::blob() as any other blob, and its answer is that of the loop over the moved triangles.
//
// Thread safety: any number of threads may query the blob while none refits it. No call allocates. Numerics are
// described at the end of this file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// A deformable mesh: a view of the moving part, in memory that the caller owns, and of the rest, in the blob that it
/// was created from. Copied freely; both must outlive it. A default Deformable, and one filled with zeros, refuses
/// every call with not_open.
class [[nodiscard]] Deformable {
public:
    constexpr Deformable() noexcept = default;

    /// Returns ok, or why create_deformable() refused its arguments.
    [[nodiscard]] constexpr QueryStatus status() const noexcept {
        if (memory_ != nullptr) return QueryStatus::ok;
        return refusal_ == QueryStatus::ok ? QueryStatus::not_open : refusal_;
    }
    /// Returns whether status() is ok.
    [[nodiscard]] explicit constexpr operator bool() const noexcept { return memory_ != nullptr; }

    /// Returns the blob for queries. A copy of it stays valid, and always has the latest pose.
    [[nodiscard]] constexpr const Blob& blob() const noexcept { return blob_; }
    /// Returns how many positions refit() takes: those of all baked meshes in a row, unused ones included.
    [[nodiscard]] std::uint32_t position_count() const noexcept;
    /// Returns the box that positions must lie in, from the bake, in whole lattice steps; each coordinate is rounded to
    /// float. A position is rounded to the lattice first, so it may lie up to half a step outside.
    [[nodiscard]] Box range() const noexcept;

private:
    friend Deformable create_deformable(const Blob& blob, std::span<std::byte> memory) noexcept;
    friend struct RefitResult refit(Deformable& mesh, std::span<const Vec3> positions) noexcept;
    friend QueryStatus seal(const Deformable& mesh, std::span<std::byte> bytes) noexcept;
    QueryStatus create(const Blob& blob, std::byte* memory) noexcept;
    Blob blob_;
    std::byte* memory_ = nullptr;            // header, nodes, leaves and guard
    const std::byte* still_ = nullptr;       // the sections behind the guard
    QueryStatus refusal_ = QueryStatus::ok;  // why create_deformable() refused; ok if it did not
};

/// The outcome of refit(). Converts to true if the vertices moved.
struct [[nodiscard]] RefitResult {
    QueryStatus status = QueryStatus::not_open;
    /// The index of the first position that is refused, or the number of positions that a wrong number begins to
    /// differ at; else 0.
    std::uint32_t position = 0;
    /// The cost of the tree in this pose over that at rest, for an average ray (SAH). About 1 is as good as at rest.
    /// From 1.5 on, bake once with this pose among BakeOptions::deformation's. If the number stays, the pose itself is
    /// crowded, and no tree is better in it.
    float quality = 0.0f;

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns how many bytes create_deformable() needs: 8.4 to 10 a triangle at 16 bits or fewer, and 3 more above; up to
/// three times as much where triangles share no vertices. 0 if the blob is not open or not deformable.
[[nodiscard]] std::size_t deformable_bytes(const Blob& blob) noexcept;

/// Copies the moving part of a blob to `memory`, at any alignment, in the pose that the blob has. The rest is read from
/// the blob, which may stay in flash. Of `memory`, the first deformable_bytes() count. They may be the front of the
/// blob's own bytes, which then change: until seal(), open() refuses them after a refit.
///
/// Refuses a blob that is not open (not_open), one that was baked without BakeOptions::deformation (no_data), memory of
/// fewer than deformable_bytes() (no_room), and memory that overlaps the rest (invalid_argument). O(size).
Deformable create_deformable(const Blob& blob, std::span<std::byte> memory) noexcept;

/// Moves the vertices to `positions`, in the order of the baked meshes, in the blob's units.
///
/// Refuses another number of positions than position_count(), and a position that is NaN or infinite
/// (invalid_argument) or outside of range() (out_of_range). A refusal names the position and changes nothing. O(n);
/// reads each position twice or more often. Takes less than 1.3 KB of stack.
RefitResult refit(Deformable& mesh, std::span<const Vec3> positions) noexcept;

/// Writes the mesh in its pose as a whole blob with a new checksum, which open() takes. `bytes` has Blob::size() bytes;
/// they may be those of the blob, with create_deformable()'s memory at their front. Refuses a mesh that is not open
/// (not_open), another number of bytes (no_room), and bytes in which a part of the mesh lies at another place
/// (invalid_argument). Blobs that were opened before keep the checksum that they had. O(size).
QueryStatus seal(const Deformable& mesh, std::span<std::byte> bytes) noexcept;

}  // namespace espalier

// Numerics
//
// refit() rounds a coordinate to the nearest multiple of the lattice step, ties to the even one, as bake() does. Every
// pose is within Blob::max_error() of its source, since a triangle moves no farther than its corners do. The bytes
// depend on the positions alone: not on the poses before, nor on the machine. At the positions of the bake they are the
// baked ones.
//
// A triangle may become flat: a segment or a point. It stays a triangle of the blob. Rays, and segments, miss it.
// Distances, overlaps, sweeps and pairs take it as the segment or point that it is.
