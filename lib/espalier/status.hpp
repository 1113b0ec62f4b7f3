// The outcome of opening a blob and of running a query: found or not, yes or no, how much was written, or why the call
// was refused.
//
// A refused query computes nothing, and its result cannot be mistaken for an answer: results convert to true only if
// something was found, and a refused YesNo is neither yes nor no. A query on two blobs that exhausts its WorkLimit has
// answered only in part, so its YesNo is neither yes nor no as well, but is_refused() returns false.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace espalier {

/// The outcome of opening a blob or a scene. The numbers never change.
enum class [[nodiscard]] OpenStatus : std::uint8_t{
    ok = 0,
    too_short = 1,            ///< fewer bytes than a header takes, or than the header states
    trailing_bytes = 2,       ///< more bytes than the header states
    not_a_blob = 3,           ///< the first four bytes are not "ESPL"
    unsupported_version = 4,  ///< another major version, or a minor version newer than this library
    unsupported_profile = 5,  ///< the profile is unknown, or left out of this build
    unsupported_feature = 6,  ///< an unknown feature bit
    bad_header = 7,           ///< a header field is out of range, or two fields contradict each other
    bad_checksum = 8,         ///< the bytes differ from those that were written
    bad_node = 9,             ///< a node violates docs/format.md
    bad_leaf = 10,            ///< a leaf violates docs/format.md
    bad_section = 11,         ///< a section of a blob or a part of a scene violates docs/format.md
    not_opened = 12,          ///< open() was never called: the state of a default Blob
    misaligned = 13,          ///< C only: an espalier_blob or espalier_scene is not aligned to 16 bytes
    not_a_remap = 15,         ///< read_remap() only: the file is damaged, or no remap file of this version
    other_blob = 16,          ///< read_remap() only: the remap file belongs to another blob
    not_a_scene = 17,         ///< open_scene() only: the first four bytes are not "ESPS"
    bad_instance = 18,        ///< open_scene() only: an instance violates docs/format.md
    too_few_meshes = 19,      ///< open_scene() only: the array for meshes or tiles is too small
};

/// Returns one English sentence without a full stop. The string is static and never null, whatever the value.
[[nodiscard]] const char* describe(OpenStatus status) noexcept;

/// The outcome of a query. Values below 16 mean that the query was answered, at least in part; from 16 on it was
/// refused and computed nothing. There are two exceptions, which process elements one by one and stop at the first that
/// they refuse: a batched move() and collect_colliding_pairs(). Their `count` tells how many elements were completed.
/// The numbers never change.
enum class [[nodiscard]] QueryStatus : std::uint8_t{
    ok = 0,           ///< complete; a YesNo is yes. Lists and visitors return it even if nothing was found
    not_found = 1,    ///< complete, but there is nothing to find; a YesNo is no
    stopped = 2,      ///< partial: a visitor returned Visit::stop
    output_full = 3,  ///< partial: the array is full, and there may be more results
    work_limit = 4,   ///< partial: the WorkLimit was exhausted; a distance is then only an upper bound
    not_open = 16,    ///< refused: never opened, or its bytes were refused. Every result starts with this status
    invalid_argument =
        17,             ///< refused: a NaN; an infinity or a negative size where not allowed; spans whose sizes differ
    out_of_range = 18,  ///< refused: too far away or too large for exact arithmetic or for the world of a moving scene;
                        ///< a slot that was never used; or outside the range of motion. Each header states its limits
    not_closed = 19,    ///< refused by contains() and signed_distance(): the surface is not closed, so it has no inside
    no_data = 20,       ///< refused: the blob was baked without the section, or the deformation, that the call needs
    no_room = 21,       ///< refused: the memory is too small or of another size, or the moving scene is full
    stale_handle = 22,  ///< refused: the instance was removed from its moving scene, or was never in it
    not_refitted = 23,  ///< refused: the moving scene needs refit() after a batch of moves
};

/// Returns whether the query was refused. It then computed nothing; a batch or a page completed `count` elements.
[[nodiscard]] constexpr bool is_refused(QueryStatus status) noexcept { return static_cast<std::uint8_t>(status) >= 16; }

/// Returns one English sentence without a full stop. The string is static and never null, whatever the value.
[[nodiscard]] const char* describe(QueryStatus status) noexcept;

/// A yes, a no, or neither: the query was refused, or ran into its work limit and is undecided. There is no conversion
/// to bool, because "neither" would silently become "no". Where that is dangerous, test no() rather than !yes().
class [[nodiscard]] YesNo {
public:
    /// Constructs a refusal with the status not_open.
    constexpr YesNo() noexcept = default;
    /// Constructs a yes from ok, a no from not_found, and an undecided or refused result from any other status.
    constexpr explicit YesNo(QueryStatus status) noexcept : status_(status) {}
    static constexpr YesNo of(bool yes) noexcept { return YesNo(yes ? QueryStatus::ok : QueryStatus::not_found); }

    [[nodiscard]] constexpr bool yes() const noexcept { return status_ == QueryStatus::ok; }
    [[nodiscard]] constexpr bool no() const noexcept { return status_ == QueryStatus::not_found; }
    /// Returns whether the answer is yes, or `otherwise` if it is neither yes nor no.
    [[nodiscard]] constexpr bool value_or(bool otherwise) const noexcept { return yes() || (!no() && otherwise); }
    [[nodiscard]] constexpr QueryStatus status() const noexcept { return status_; }
    explicit operator bool() const = delete;
    friend constexpr bool operator==(YesNo, YesNo) = default;

private:
    QueryStatus status_ = QueryStatus::not_open;
};

/// A value and the status of the query that returned it. The value is meaningful only if the status is ok.
template <class Value>
class [[nodiscard]] Result {
public:
    Value value = {};
    QueryStatus status = QueryStatus::not_open;

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
    constexpr const Value& operator*() const noexcept { return value; }
    constexpr const Value* operator->() const noexcept { return &value; }
};

/// An opaque position in a list of results, from which a query resumes. The default is the beginning of the list.
struct Cursor {
    std::uint32_t place[3] = {};
    friend constexpr bool operator==(const Cursor&, const Cursor&) = default;
};

/// The outcome of a query that writes to an array: how many elements it wrote, and where to resume.
struct [[nodiscard]] Filled {
    std::size_t count = 0;  ///< number of elements written
    Cursor next;            ///< where to resume after output_full or work_limit; otherwise the end
    /// ok: the list is complete. output_full: the array is full, and there may be more elements. work_limit: elements
    /// are missing. Any other status tells why the query was refused.
    QueryStatus status = QueryStatus::not_open;

    /// Returns the part of the array that the query filled. Pass the array that the query was given.
    [[nodiscard]] constexpr auto in(auto& array) const noexcept { return std::span(array).first(count); }
};

/// Returned by a visitor after each element, to continue or to stop.
enum class Visit : std::uint8_t { next, stop };

}  // namespace espalier
