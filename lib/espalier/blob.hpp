// Opens a blob whose bytes lie in flash, in a mapped file, or in a buffer from an untrusted source.
//
// Any number of threads may use the same Blob, and no call allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/format.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

class Blob;

namespace detail {

/// What open() proved about the bytes. Queries read nothing but this and the bytes. In a Blob that was never opened all
/// members are zero, so a C structure filled with zeros is such a Blob.
struct BlobData {
    const std::byte* bytes = nullptr;  // the whole blob; null if it is not open
    const std::byte* nodes = nullptr;
    const std::byte* leaves = nullptr;
    std::int16_t step_exponent = 0;
    std::uint8_t bits = 0;
    std::uint8_t depth = 0;
    std::uint8_t id_kind_bits = 0;
    Profile profile = Profile::fast;
    OpenStatus refusal = OpenStatus::ok;  // why open() refused the bytes, or ok
    const std::byte* sources = nullptr;   // null without original ids
    const std::byte* ids = nullptr;
    const std::byte* materials = nullptr;
    const std::byte* copies = nullptr;  // null without split references
    const std::byte* edge_flags = nullptr;
    const std::byte* bounds = nullptr;   // the stored bounds, in the order of format/sections.hpp
    const std::byte* corners = nullptr;  // of all leaves, before the vertex sources; null unless deformable
    std::uint32_t size = 0;
    std::uint32_t features = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t vertex_count = 0;
    std::uint32_t node_count = 0;
    std::uint32_t leaf_bytes = 0;
    std::uint32_t source_count = 0;
    std::uint32_t source_triangles = 0;
    std::uint32_t copy_count = 0;
    std::uint32_t checksum = 0;
    // The fourth element of each vector is zero.
    alignas(16) float origin[4] = {};
    alignas(16) std::int32_t extent[4] = {};
    alignas(16) float extent_steps[4] = {};  // `extent` as floats, exactly
    float steps_per_unit = 0.0f;             // 2^-step_exponent
    float base_unit = 0.0f;                  // the unit of a node's base, in lattice steps
    float max_error = 0.0f;

    /// Computes the members that depend on bits, step_exponent and extent.
    void derive() noexcept;
};

constexpr const BlobData& data_of(const Blob& blob) noexcept;

}  // namespace detail

/// The lattice of a blob. A coordinate in the blob's units is origin + steps * 2^step_exponent, and the triangles
/// extend from 0 to `extent` steps along each axis. Those of a deformable blob never leave this box.
struct Lattice {
    Vec3 origin;
    std::int32_t step_exponent = 0;
    std::int32_t extent[3] = {};
    friend constexpr bool operator==(const Lattice&, const Lattice&) = default;
};

/// A view of a baked mesh. It is a few words that can be copied freely and own nothing: the bytes must outlive it and
/// must not change, except by refit() (deformation.hpp). Queries never write to them. A default Blob was never opened;
/// it has no triangles, and queries refuse it with QueryStatus::not_open. A Blob whose bytes open() refused behaves the
/// same and differs only in its status.
class [[nodiscard]] Blob {
public:
    constexpr Blob() noexcept = default;

    /// Returns ok, not_opened, or why open() or open_unchecked() refused the bytes.
    [[nodiscard]] constexpr OpenStatus status() const noexcept {
        if (data_.bytes != nullptr) return OpenStatus::ok;
        return data_.refusal == OpenStatus::ok ? OpenStatus::not_opened : data_.refusal;
    }
    /// Returns whether the blob is open.
    [[nodiscard]] explicit constexpr operator bool() const noexcept { return data_.bytes != nullptr; }

    /// Returns the number of triangles, including duplicate references. The index of every TriangleId of this blob is
    /// below it.
    [[nodiscard]] constexpr std::uint32_t triangle_count() const noexcept { return data_.triangle_count; }
    /// Returns how many triangles are duplicate references to another triangle, which has a lower index. This is above
    /// 0 only for a blob that was baked with Builder::spatial_splits. No query returns a duplicate, and each query
    /// reports a triangle once, but enumerations come in another order (overlap.hpp).
    [[nodiscard]] constexpr std::uint32_t duplicate_reference_count() const noexcept { return data_.copy_count; }
    [[nodiscard]] constexpr std::uint32_t vertex_count() const noexcept { return data_.vertex_count; }
    /// Returns the size in bytes.
    [[nodiscard]] constexpr std::uint32_t size() const noexcept { return data_.size; }
    /// Returns the checksum in the header. refit() does not update it.
    [[nodiscard]] constexpr std::uint32_t checksum() const noexcept { return data_.checksum; }
    /// Returns the number of nodes on the longest path down from the root, at most format::max_depth.
    [[nodiscard]] constexpr unsigned depth() const noexcept { return data_.depth; }
    [[nodiscard]] constexpr Profile profile() const noexcept { return data_.profile; }
    /// Returns the lattice on which the corners lie. If there are no triangles, its origin and step are arbitrary.
    [[nodiscard]] constexpr Lattice lattice() const noexcept {
        return {{data_.origin[0], data_.origin[1], data_.origin[2]},
                data_.step_exponent,
                {data_.extent[0], data_.extent[1], data_.extent[2]}};
    }
    /// Returns an upper bound on the distance between the baked surface and the source that was given to the baker, in
    /// the blob's units. Queries round as well; rounding_error() in advanced/rounding.hpp returns by how much.
    [[nodiscard]] constexpr float max_error() const noexcept { return data_.max_error; }
    /// Returns the point of the source that is the origin of the blob: what the baker subtracted from all positions
    /// (BakeOptions::origin). Queries count from there, so subtract it from a position of the source, and add it to an
    /// answer, in float64.
    [[nodiscard]] Vec3d source_origin() const noexcept;
    /// Returns the box around all triangles, with each coordinate rounded to float. Both corners are zero if there are
    /// no triangles.
    [[nodiscard]] Box bounds() const noexcept;
    /// Returns whether the surface is closed, as contains() and signed_distance() require. It is closed if the boundary
    /// of its triangles cancels along lines: wherever an edge runs, as many edges run one way as the other, and the
    /// winding number of every point off the surface is a whole number.
    [[nodiscard]] constexpr bool is_closed() const noexcept { return (data_.features & format::feature::closed) != 0; }
    /// Returns whether the vertices can move (deformation.hpp).
    [[nodiscard]] constexpr bool is_deformable() const noexcept { return data_.corners != nullptr; }
    [[nodiscard]] constexpr bool has_original_ids() const noexcept { return data_.ids != nullptr; }
    [[nodiscard]] constexpr bool has_materials() const noexcept { return data_.materials != nullptr; }
    /// Returns whether the blob stores the edge flags that contact.hpp uses.
    [[nodiscard]] constexpr bool has_edge_flags() const noexcept { return data_.edge_flags != nullptr; }

private:
    friend constexpr const detail::BlobData& detail::data_of(const Blob& blob) noexcept;
    friend Blob open(std::span<const std::byte> bytes) noexcept;
    friend Blob open_unchecked(std::span<const std::byte> bytes) noexcept;
    friend class Deformable;
    detail::BlobData data_;
};

namespace detail {

/// Returns the internal data, for the library itself and its tests. The layout may change.
constexpr const BlobData& data_of(const Blob& blob) noexcept { return blob.data_; }
/// Returns not_open if queries must refuse the blob, otherwise ok.
constexpr QueryStatus query_status_of(const Blob& blob) noexcept {
    return blob ? QueryStatus::ok : QueryStatus::not_open;
}

}  // namespace detail

/// Proves that every query on `bytes` is safe and returns a view of them. If they are not a valid blob, the result has
/// no triangles and its status states why.
///
/// Takes any bytes at any alignment. Reads only inside `bytes`, without heap or recursion, in time proportional to
/// their number. It does not prove that the bytes describe the mesh that you baked; for that, sign them.
Blob open(std::span<const std::byte> bytes) noexcept;

/// Returns a view of a blob in O(1), without proving anything about its contents, for firmware that has no time or no
/// room for open(). `bytes` must be exactly what the baker wrote, for example a blob linked into your own program. If
/// anything changed them, be it a flash cell, a cable or an attacker, queries may read any address and may never end.
/// Use open() for bytes of any other origin.
///
/// Only the header is checked, and refused like open() does: the magic number (which differs in the wrong byte order),
/// the version, the profile and features that this library reads, the range of each field, and that the sizes of all
/// sections add up to the number of bytes. The checksum is not compared. A blob that both functions open is the same
/// either way.
Blob open_unchecked(std::span<const std::byte> bytes) noexcept;

/// Returns the material number that was given to the baker, or 0 if the blob stores none or has no such triangle. O(1).
[[nodiscard]] std::uint16_t material(const Blob& blob, TriangleId triangle) noexcept;

}  // namespace espalier
