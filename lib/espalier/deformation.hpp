// Meshes whose vertices move while their triangles stay: cloth, characters, soft robots, terrain that is dug.
//
// Bake a deformable blob with BakeOptions::deformation. create_deformable() copies the part that moves to memory of the
// caller, where refit() moves the vertices and updates the boxes above them. Every query takes Deformable::blob() like
// any other blob, and its answer is that of a loop over the moved triangles.
//
// Any number of threads may query the blob while no thread refits it. No call allocates. Numerics are described at the
// end of this file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// A view of a deformable mesh: its moving part is in memory that the caller owns, the rest in the blob that it was
/// created from. It can be copied freely, and both must outlive it. A default Deformable, or one filled with zeros,
/// refuses every call with not_open.
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

    /// Returns the blob to query. A copy of it stays valid and always has the latest pose.
    [[nodiscard]] constexpr const Blob& blob() const noexcept { return blob_; }
    /// Returns the number of positions that refit() takes: those of all baked meshes one after the other, including
    /// unused ones.
    [[nodiscard]] std::uint32_t position_count() const noexcept;
    /// Returns the box in which positions must lie. It was fixed by the bake, in whole lattice steps, and each
    /// coordinate is rounded to float. Positions are rounded to the lattice before they are tested, so they may be up
    /// to half a step outside.
    [[nodiscard]] Box range() const noexcept;

private:
    friend Deformable create_deformable(const Blob& blob, std::span<std::byte> memory) noexcept;
    friend struct RefitResult refit(Deformable& mesh, std::span<const Vec3> positions) noexcept;
    friend QueryStatus seal(const Deformable& mesh, std::span<std::byte> bytes) noexcept;
    QueryStatus create(const Blob& blob, std::byte* memory) noexcept;
    Blob blob_;
    std::byte* memory_ = nullptr;            // header, nodes, leaves and guard
    const std::byte* still_ = nullptr;       // the sections after the guard
    QueryStatus refusal_ = QueryStatus::ok;  // why create_deformable() refused, or ok
};

/// The outcome of refit(). Converts to true if the vertices moved.
struct [[nodiscard]] RefitResult {
    QueryStatus status = QueryStatus::not_open;
    /// The index of the first position that was refused; if the number of positions is wrong, the smaller of the two
    /// numbers; otherwise 0.
    std::uint32_t position = 0;
    /// The cost of the tree in this pose relative to that at rest, for an average ray (SAH). At about 1 the tree is as
    /// good as at rest. If it reaches 1.5, bake once more with this pose among those of BakeOptions::deformation. If
    /// that does not lower it, the pose itself is crowded, and no tree suits it better.
    float quality = 0.0f;

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns how many bytes create_deformable() needs: 8.4 to 10 per triangle at 16 bits or fewer, 3 more above that, and
/// up to three times as much where triangles share no vertices. Returns 0 if the blob is not open or not deformable.
[[nodiscard]] std::size_t deformable_bytes(const Blob& blob) noexcept;

/// Copies the moving part of a blob, in its current pose, to `memory`, which may have any alignment. The rest is read
/// from the blob and may stay in flash. Only the first deformable_bytes() of `memory` are used. They may be the front
/// of the blob's own bytes, which then change: after a refit, open() refuses them until seal().
///
/// Refuses a blob that is not open (not_open), one that was baked without BakeOptions::deformation (no_data), memory of
/// fewer than deformable_bytes() bytes (no_room), and memory that overlaps the rest (invalid_argument). O(size).
Deformable create_deformable(const Blob& blob, std::span<std::byte> memory) noexcept;

/// Moves the vertices to `positions`, in the blob's units and in the order of the baked meshes.
///
/// Refuses any number of positions but position_count(), a position that is NaN or infinite (invalid_argument), and one
/// outside range() (out_of_range). A refusal names the position and changes nothing. O(n); each position is read at
/// least twice. Takes less than 1.3 KB of stack.
RefitResult refit(Deformable& mesh, std::span<const Vec3> positions) noexcept;

/// Writes the mesh in its current pose as a complete blob with a new checksum, which open() accepts. `bytes` must have
/// Blob::size() bytes. They may be the bytes of the blob itself, with the memory of create_deformable() at their front.
///
/// Refuses a mesh that is not open (not_open), any other number of bytes (no_room), and bytes in which a part of the
/// mesh lies at a different place (invalid_argument). Blobs that were opened earlier keep their old checksum. O(size).
QueryStatus seal(const Deformable& mesh, std::span<std::byte> bytes) noexcept;

}  // namespace espalier

// Numerics
//
// refit() rounds each coordinate to the nearest multiple of the lattice step, with ties to even, like bake(). Every
// pose is within Blob::max_error() of its source, since a triangle moves no farther than its corners do. The bytes
// depend only on the positions, not on earlier poses or the machine; for the positions of the bake they are the baked
// bytes.
//
// A triangle may collapse to a segment or a point. It remains a triangle of the blob. Rays and lattice segments miss
// it, while distances, overlaps, sweeps and pairs treat it as that segment or point.
