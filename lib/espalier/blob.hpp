// Opening a blob: bytes in flash, in a mapped file, or in a buffer from an untrusted source.
//
// Thread safety: any number of threads may use one Blob. No call allocates.
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

/// The facts that open() proved about the bytes. Queries read these and the bytes only.
/// All are zero in a Blob that was never opened, so that a structure of C that is filled with zeros is one.
struct BlobData {
    const std::byte* bytes = nullptr;  // the whole blob; null if it is not open
    const std::byte* nodes = nullptr;
    const std::byte* leaves = nullptr;
    std::int16_t step_exponent = 0;
    std::uint8_t bits = 0;
    std::uint8_t depth = 0;
    std::uint8_t id_kind_bits = 0;
    Profile profile = Profile::fast;
    OpenStatus refusal = OpenStatus::ok;  // why open() refused the bytes; ok if it did not
    const std::byte* sources = nullptr;   // null without original ids
    const std::byte* ids = nullptr;
    const std::byte* materials = nullptr;
    const std::byte* copies = nullptr;  // null without split references
    const std::byte* edge_flags = nullptr;
    const std::byte* bounds = nullptr;   // the stored ones, in the order of format/sections.hpp
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
    // Vectors have a fourth element, which is zero.
    alignas(16) float origin[4] = {};
    alignas(16) std::int32_t extent[4] = {};
    alignas(16) float extent_steps[4] = {};  // the same in float, exactly
    float steps_per_unit = 0.0f;             // 2^-step_exponent
    float base_unit = 0.0f;                  // lattice steps that a node's base counts in
    float max_error = 0.0f;

    /// Computes the members that follow from bits, step_exponent and extent.
    void derive() noexcept;
};

constexpr const BlobData& data_of(const Blob& blob) noexcept;

}  // namespace detail

/// The lattice of a blob. A coordinate in the blob's units is origin + steps * 2^step_exponent; the triangles reach
/// from 0 to `extent` steps along each axis. Those of a deformable blob never leave it.
struct Lattice {
    Vec3 origin;
    std::int32_t step_exponent = 0;
    std::int32_t extent[3] = {};
    friend constexpr bool operator==(const Lattice&, const Lattice&) = default;
};

/// A view of a baked mesh: a few words that are copied freely and own nothing. The bytes must outlive it and stay
/// unchanged, but by refit() (deformation.hpp). Queries never write. A default Blob was never opened: it has no
/// triangles, and queries refuse it with QueryStatus::not_open. A Blob whose bytes open() refused is the same but for
/// its status.
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

    /// Returns the number of triangles, duplicate references included. Every TriangleId of this blob has a lower index.
    [[nodiscard]] constexpr std::uint32_t triangle_count() const noexcept { return data_.triangle_count; }
    /// Returns how many triangles are duplicate references to another triangle, which has a lower index: above 0 only
    /// if the blob was baked with Builder::spatial_splits. No query returns a duplicate, and each one
    /// reports a triangle once; enumerations come in another order (overlap.hpp).
    [[nodiscard]] constexpr std::uint32_t duplicate_reference_count() const noexcept { return data_.copy_count; }
    [[nodiscard]] constexpr std::uint32_t vertex_count() const noexcept { return data_.vertex_count; }
    /// Returns the size in bytes.
    [[nodiscard]] constexpr std::uint32_t size() const noexcept { return data_.size; }
    /// Returns the checksum that the header stores. refit() does not renew it.
    [[nodiscard]] constexpr std::uint32_t checksum() const noexcept { return data_.checksum; }
    /// Returns the number of nodes on the longest path from the root, at most format::max_depth.
    [[nodiscard]] constexpr unsigned depth() const noexcept { return data_.depth; }
    [[nodiscard]] constexpr Profile profile() const noexcept { return data_.profile; }
    /// Returns the lattice on which the corners lie. The one of a blob without triangles has any origin and step.
    [[nodiscard]] constexpr Lattice lattice() const noexcept {
        return {{data_.origin[0], data_.origin[1], data_.origin[2]},
                data_.step_exponent,
                {data_.extent[0], data_.extent[1], data_.extent[2]}};
    }
    /// Returns the largest distance between the baked surface and its source as the baker was given it, in the blob's
    /// units. The rounding of queries, which rounding.hpp returns, is not included.
    [[nodiscard]] constexpr float max_error() const noexcept { return data_.max_error; }
    /// Returns where 0 0 0 of the blob lies in the source: what the baker subtracted from all positions
    /// (BakeOptions::origin). Queries take and return places from there: subtract it from a place of the source, and
    /// add it to an answer, in float64.
    [[nodiscard]] Vec3d source_origin() const noexcept;
    /// Returns the box around all triangles, each coordinate rounded to float. Both corners are zero if there are no
    /// triangles.
    [[nodiscard]] Box bounds() const noexcept;
    /// Returns whether the surface is closed, so that contains() and signed_distance() do not refuse the blob: the
    /// boundary of the triangles cancels along lines. Wherever an edge runs, as many edges run one way as the other,
    /// and every point that is not on the surface has a whole winding number.
    [[nodiscard]] constexpr bool is_closed() const noexcept { return (data_.features & format::feature::closed) != 0; }
    /// Returns whether the vertices can move (deformation.hpp).
    [[nodiscard]] constexpr bool is_deformable() const noexcept { return data_.corners != nullptr; }
    [[nodiscard]] constexpr bool has_original_ids() const noexcept { return data_.ids != nullptr; }
    [[nodiscard]] constexpr bool has_materials() const noexcept { return data_.materials != nullptr; }
    /// Returns whether the blob stores the edge flags that contact.hpp reads.
    [[nodiscard]] constexpr bool has_edge_flags() const noexcept { return data_.edge_flags != nullptr; }

private:
    friend constexpr const detail::BlobData& detail::data_of(const Blob& blob) noexcept;
    friend Blob open(std::span<const std::byte> bytes) noexcept;
    friend Blob open_unchecked(std::span<const std::byte> bytes) noexcept;
    friend class Deformable;
    detail::BlobData data_;
};

namespace detail {

/// Returns the inner data of a blob: for the library's own parts and its tests. Its layout may change.
constexpr const BlobData& data_of(const Blob& blob) noexcept { return blob.data_; }
/// Returns not_open for a blob that queries must refuse, else ok.
constexpr QueryStatus query_status_of(const Blob& blob) noexcept {
    return blob ? QueryStatus::ok : QueryStatus::not_open;
}

}  // namespace detail

/// Proves that every query on `bytes` is safe and returns a view of them. If they are no sound blob, the result's
/// status states why, and it has no triangles.
///
/// Takes any bytes at any alignment. Reads only inside `bytes`, without heap and recursion, in time proportional to the
/// size. It does not prove that the bytes describe the mesh that you baked: sign them for that.
Blob open(std::span<const std::byte> bytes) noexcept;

/// Returns a view of a blob that is linked into your own program, in O(1): for firmware that has no time or no room for
/// open(). It requires that `bytes` are exactly what the baker wrote. If they were changed, by a flash cell, a cable or
/// an attacker, queries may read anywhere and need not end; use open() for bytes of any other origin.
///
/// Checks the header only, and refuses it as open() does: magic (a wrong byte order has another one), version, that the
/// sizes of all sections add up to the number of bytes, that this library reads the profile and the features, and the
/// range of each field. Does not compare the checksum. A blob that both open is the same for both.
Blob open_unchecked(std::span<const std::byte> bytes) noexcept;

/// Returns the material number given at bake, or 0 if the blob stores none or has no such triangle. O(1).
[[nodiscard]] std::uint16_t material(const Blob& blob, TriangleId triangle) noexcept;

}  // namespace espalier
