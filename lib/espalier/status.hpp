// The results of opening a blob and of queries: found or not, yes or no, how much was written, or why it was refused.
//
// A refusal is a query that was not answered. It never looks like an answer: a result converts to true only if
// something was found, and a YesNo that was refused is neither yes nor no. A query of two blobs that reaches its
// WorkLimit is answered in part: its YesNo is neither yes nor no either, but is_refused() is false.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace espalier {

/// The result of opening a blob or a scene. The numbers are stable.
enum class [[nodiscard]] OpenStatus : std::uint8_t{
    ok = 0,
    too_short = 1,            ///< fewer bytes than the header takes, or than it states
    trailing_bytes = 2,       ///< more bytes than the header states
    not_a_blob = 3,           ///< the first four bytes are not "ESPL"
    unsupported_version = 4,  ///< another major version, or a minor version newer than this library
    unsupported_profile = 5,  ///< an unknown profile, or one that this build leaves out
    unsupported_feature = 6,  ///< an unknown feature bit
    bad_header = 7,           ///< a header field out of its range, or two that contradict each other
    bad_checksum = 8,         ///< the bytes are not the ones that were written
    bad_node = 9,             ///< a node breaks the rules of docs/format.md
    bad_leaf = 10,            ///< a leaf breaks the rules of docs/format.md
    bad_section = 11,         ///< a section of a blob or a part of a scene breaks the rules of docs/format.md
    not_opened = 12,          ///< open() was never called: the state of a default Blob
    misaligned = 13,          ///< in C only: the address of an espalier_blob or espalier_scene is no multiple of 16
    not_a_remap = 15,         ///< read_remap() only: not a remap file of this version, or a damaged one
    other_blob = 16,          ///< read_remap() only: the remap file belongs to another blob
    not_a_scene = 17,         ///< open_scene() only: the first four bytes are not "ESPS"
    bad_instance = 18,        ///< open_scene() only: an instance breaks the rules of docs/format.md
    too_few_meshes = 19,      ///< open_scene() only: an array for meshes or tiles is too small
};

/// Returns one English sentence without a full stop: static, never null, for any value.
[[nodiscard]] const char* describe(OpenStatus status) noexcept;

/// The result of a query. Below 16 the query was answered, at least in part; from 16 on it was refused and computed
/// nothing. Two calls do part of their work before they refuse an element: move() of a batch, and
/// collect_colliding_pairs(). Their `count` is how many elements before it are done. The numbers are stable.
enum class [[nodiscard]] QueryStatus : std::uint8_t{
    ok = 0,           ///< complete; of a YesNo: yes. Lists and visitors have it also if there is nothing
    not_found = 1,    ///< complete: there is none; of a YesNo: no
    stopped = 2,      ///< partial: a visitor returned Visit::stop
    output_full = 3,  ///< partial: the array is full and there is more
    work_limit = 4,   ///< partial: the WorkLimit was reached; a distance is then an upper bound
    not_open = 16,    ///< refused: never opened, or the bytes were refused; the default of every result
    invalid_argument =
        17,             ///< refused: NaN, or an infinity or a negative size where not allowed; spans of different sizes
    out_of_range = 18,  ///< refused: too far away or too large for exact arithmetic or the world of a moving scene, or
                        ///< a slot that was never used, or outside of a range of motion; each header states the limit
    not_closed = 19,    ///< refused by contains() and signed_distance(): this surface has no inside
    no_data = 20,       ///< refused: the blob was baked without the section or deformation that the call reads
    no_room = 21,       ///< refused: memory is too small or has another size, or a moving scene is full
    stale_handle = 22,  ///< refused: the instance was removed from its moving scene, or never was in it
    not_refitted = 23,  ///< refused: a moving scene waits for refit() since a batch of moves
};

/// Returns whether the query was refused: it computed nothing, or of a batch or page `count` elements.
[[nodiscard]] constexpr bool is_refused(QueryStatus status) noexcept { return static_cast<std::uint8_t>(status) >= 16; }

/// Returns one English sentence without a full stop: static, never null, for any value.
[[nodiscard]] const char* describe(QueryStatus status) noexcept;

/// The result of a query: yes, no, or neither, which is a refusal or work_limit (undecided). It has no conversion to
/// bool, so that neither cannot be taken for a no. Where a mistake is dangerous, test no(), not !yes().
class [[nodiscard]] YesNo {
public:
    /// Constructs a refusal: not_open.
    constexpr YesNo() noexcept = default;
    /// Constructs a yes from ok, a no from not_found, else an undecided or refused result.
    constexpr explicit YesNo(QueryStatus status) noexcept : status_(status) {}
    static constexpr YesNo of(bool yes) noexcept { return YesNo(yes ? QueryStatus::ok : QueryStatus::not_found); }

    [[nodiscard]] constexpr bool yes() const noexcept { return status_ == QueryStatus::ok; }
    [[nodiscard]] constexpr bool no() const noexcept { return status_ == QueryStatus::not_found; }
    /// Returns yes(), or `otherwise` if the result is neither yes nor no.
    [[nodiscard]] constexpr bool value_or(bool otherwise) const noexcept { return yes() || (!no() && otherwise); }
    [[nodiscard]] constexpr QueryStatus status() const noexcept { return status_; }
    explicit operator bool() const = delete;
    friend constexpr bool operator==(YesNo, YesNo) = default;

private:
    QueryStatus status_ = QueryStatus::not_open;
};

/// A value and the status of the query that returned it. The value counts only if the status is ok.
template <class Value>
class [[nodiscard]] Result {
public:
    Value value = {};
    QueryStatus status = QueryStatus::not_open;

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
    constexpr const Value& operator*() const noexcept { return value; }
    constexpr const Value* operator->() const noexcept { return &value; }
};

/// A place in a list of results from which a query resumes. Opaque; the default is the beginning.
struct Cursor {
    std::uint32_t place[3] = {};
    friend constexpr bool operator==(const Cursor&, const Cursor&) = default;
};

/// The result of a query that writes to an array: how many elements it wrote, and where it resumes.
struct [[nodiscard]] Filled {
    std::size_t count = 0;  ///< elements written
    Cursor next;            ///< where to resume after output_full or work_limit; else the end
    /// ok: complete; output_full: there is more; work_limit: elements are missing; else why the query was refused.
    QueryStatus status = QueryStatus::not_open;

    /// Returns the written part of the array that the query was given.
    [[nodiscard]] constexpr auto in(auto& array) const noexcept { return std::span(array).first(count); }
};

/// The result of a visitor after each element: go on with the next one, or stop.
enum class Visit : std::uint8_t { next, stop };

}  // namespace espalier
