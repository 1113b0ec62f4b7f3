// Opening a blob: from flash, from a mapped file, from a buffer that a stranger filled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/format.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

namespace detail {

/// What `open` proved about the bytes; the queries read this and the bytes, nothing else.
/// All zero when empty: what C fills with zeros is a Blob too.
struct BlobData {
    const std::byte* bytes = nullptr;  // the whole blob
    const std::byte* nodes = nullptr;  // null when empty
    const std::byte* leaves = nullptr;
    std::int16_t step_exponent = 0;
    std::uint8_t bits = 0;
    std::uint8_t depth = 0;
    std::uint8_t id_kind_bits = 0;
    format::Profile profile = format::Profile::fast;
    const std::byte* sources = nullptr;  // null without original ids
    const std::byte* ids = nullptr;
    const std::byte* materials = nullptr;
    const std::byte* copies = nullptr;  // null without split references
    const std::byte* edge_flags = nullptr;
    const std::byte* bounds = nullptr;  // whichever there are
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

    /// Fills in what follows from bits, step_exponent and extent.
    void derive() noexcept;
};

}  // namespace detail

/// A view of a baked mesh: a few words, copied freely, owning nothing. Either empty (no triangles; every query finds
/// nothing) or opened. The bytes must outlive it and stay unchanged; they are never written.
class Blob {
public:
    constexpr Blob() noexcept = default;

    /// Storage indices: every Triangle that a query answers with has an index below this. Copies are counted in.
    [[nodiscard]] constexpr std::uint32_t triangle_count() const noexcept { return data_.triangle_count; }
    /// How many storage indices are copies of another triangle, which has a lower one: above zero only when the blob
    /// was baked with Builder::spatial_splits. No query answers with a copy. for_each_hit and for_each_overlap refuse a
    /// blob with copies: they would have to remember what they have reported. They answer false at once and visit
    /// nothing.
    [[nodiscard]] constexpr std::uint32_t copy_count() const noexcept { return data_.copy_count; }
    [[nodiscard]] constexpr std::uint32_t vertex_count() const noexcept { return data_.vertex_count; }
    [[nodiscard]] constexpr std::uint32_t size_bytes() const noexcept { return data_.size; }
    [[nodiscard]] constexpr std::uint32_t checksum() const noexcept { return data_.checksum; }
    /// Nodes on the longest way down, at most format::max_depth.
    [[nodiscard]] constexpr unsigned depth() const noexcept { return data_.depth; }
    [[nodiscard]] constexpr unsigned bits() const noexcept { return data_.bits; }
    [[nodiscard]] constexpr format::Profile profile() const noexcept { return data_.profile; }
    /// The lattice step, a power of two, in world units.
    [[nodiscard]] float step() const noexcept;
    /// The baked surface differs from its source by at most this, in world units. The source is what the baker was
    /// given: float32 positions. What a conversion from float64 to float32 moved before that is not in it. How far
    /// queries are rounded is not in it either: rounding.hpp returns that.
    [[nodiscard]] constexpr float max_error() const noexcept { return data_.max_error; }
    /// Corners of the box around all triangles, each coordinate rounded to float. Two zeros when empty.
    [[nodiscard]] Vec3 bounds_min() const noexcept;
    [[nodiscard]] Vec3 bounds_max() const noexcept;
    /// The boundary of the triangles cancels along lines: wherever an edge runs, as many edges run one way as the
    /// other. The winding number of every point that is not on the surface is then an integer, and contains and
    /// signed_distance answer.
    [[nodiscard]] constexpr bool closed() const noexcept { return (data_.features & format::feature::closed) != 0; }
    [[nodiscard]] constexpr bool has_original_ids() const noexcept { return data_.ids != nullptr; }
    [[nodiscard]] constexpr bool has_materials() const noexcept { return data_.materials != nullptr; }
    /// Whether contact.hpp has something to say.
    [[nodiscard]] constexpr bool has_edge_flags() const noexcept { return data_.edge_flags != nullptr; }

    /// For the library's own parts and its tests; its layout is no promise.
    [[nodiscard]] constexpr const detail::BlobData& data() const noexcept { return data_; }

private:
    friend Status open(std::span<const std::byte> bytes, Blob& blob) noexcept;
    friend Status open_trusted_image(std::span<const std::byte> bytes, Blob& blob) noexcept;
    detail::BlobData data_;
};

/// Proves that `bytes` is a blob on which every query is safe, and points `blob` at it. Any bytes, any alignment: reads
/// only inside `bytes`, writes only `blob`, no heap, no recursion, time proportional to the size. On any status but ok
/// the blob is empty. It does not promise that a maliciously made blob describes the mesh that you baked: sign it for
/// that.
[[nodiscard]] Status open(std::span<const std::byte> bytes, Blob& blob) noexcept;

/// Opens in O(1) a blob that is linked into your own program: firmware that cannot wait for `open`, or has no room for
/// it. It trusts that `bytes` are, each one, what the baker wrote: nobody changed them since, no flash cell, no cable
/// and no stranger. Where that is not so, queries may read anywhere and need not end; `open` is for bytes of any other
/// origin.
///
/// What is checked is the header and nothing behind it: magic (which also tells a wrong byte order), version, that the
/// sizes of all sections add up to the number of bytes, a profile and features that this library reads, each field
/// within its range. Those are refused as `open` refuses them, and then the blob is empty. The checksum is not
/// compared. A blob that both open, both open alike.
[[nodiscard]] Status open_trusted_image(std::span<const std::byte> bytes, Blob& blob) noexcept;

/// The material number given at bake, or 0 when the blob carries none or has no such triangle. O(1).
[[nodiscard]] std::uint16_t material(const Blob& blob, Triangle triangle) noexcept;

}  // namespace espalier
