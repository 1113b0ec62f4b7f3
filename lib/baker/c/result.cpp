#include <baker/c/options.hpp>
#include <baker/c/result.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace espalier::baker {

namespace {

/// What a pointer to a result points to. The rest of its memory follows.
struct Piece {
    espalier_bake_result result;  // first, so that its address is that of the piece
    espalier_bake_report report;
    ResultMemory source;
    void* memory;  // as it was allocated; null for a static result
    std::size_t size;
};
static_assert(std::is_standard_layout_v<Piece> && std::is_trivially_destructible_v<Piece>);

constexpr std::size_t blob_alignment = 64;

constexpr espalier_bake_finding nothing_found = {0, "", {0, 0, ESPALIER_NO_TRIANGLE, 0}};

constexpr espalier_bake_report empty_report() {
    espalier_bake_report report = {};
    report.not_finite = report.index_out_of_range = report.zero_area = report.collapsed = report.duplicate =
        nothing_found;
    return report;
}

constexpr Piece piece_without_memory(const espalier_bake_report* report) {
    Piece piece = {};
    piece.report = empty_report();
    piece.result.report = report;
    piece.result.message =
        "there is not enough memory for this bake, which takes about 150 bytes for each triangle; bake smaller parts";
    piece.result.place.triangle = ESPALIER_NO_TRIANGLE;
    piece.result.status = ESPALIER_BAKE_NO_MEMORY;
    return piece;
}

constinit const Piece out_of_memory = piece_without_memory(&out_of_memory.report);

/// Cuts arrays off memory, or counts how much they take if there is none.
class Cutter {
public:
    explicit Cutter(std::byte* memory) : memory_(memory) {}

    /// Returns null while it counts.
    template <class T>
    T* array(std::size_t count, std::size_t alignment = alignof(T)) {
        used_ = (used_ + alignment - 1) / alignment * alignment;
        std::byte* const place = memory_ == nullptr ? nullptr : memory_ + used_;
        used_ += count * sizeof(T);
        return reinterpret_cast<T*>(place);
    }
    template <class T>
    const T* copy(std::span<const T> values, std::size_t alignment = alignof(T)) {
        T* const place = array<T>(values.size(), alignment);
        if (place != nullptr && !values.empty()) std::memcpy(place, values.data(), values.size_bytes());
        return values.empty() ? nullptr : place;
    }
    const char* text(const std::string& text) {
        char* const place = array<char>(text.size() + 1);
        if (place != nullptr) std::memcpy(place, text.c_str(), text.size() + 1);
        return place;
    }
    [[nodiscard]] std::size_t used() const { return used_; }

private:
    std::byte* memory_;
    std::size_t used_ = 0;
};

espalier_source_place in_c(const std::optional<SourcePlace>& place) {
    if (!place) return {0, 0, ESPALIER_NO_TRIANGLE, 0};
    return {place->file, place->mesh, place->triangle.value_or(ESPALIER_NO_TRIANGLE), 1};
}

espalier_vec3 in_c(const Vec3& v) { return {v.x, v.y, v.z}; }

espalier_bake_finding in_c(const Finding& finding, Cutter& cutter) {
    return {finding.count, cutter.text(finding.first), in_c(finding.place)};
}

void put_warnings(const std::vector<BakeWarning>& given, Cutter& cutter, espalier_bake_report& report) {
    report.warning_count = given.size();
    auto* const warnings = cutter.array<espalier_bake_warning>(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
        const char* const message = cutter.text(given[i].message);
        const auto kind = static_cast<espalier_bake_warning_kind>(given[i].kind);
        if (warnings != nullptr) new (warnings + i) espalier_bake_warning{message, kind};
    }
    report.warnings = given.empty() ? nullptr : warnings;
}

espalier_bake_report in_c(const BakeReport& report, Cutter& cutter) {
    espalier_bake_report in_c_terms = {};
    in_c_terms.source_triangles = report.source.triangles;
    in_c_terms.source_vertices = report.source.vertices;
    in_c_terms.not_finite = in_c(report.findings.not_finite, cutter);
    in_c_terms.index_out_of_range = in_c(report.findings.index_out_of_range, cutter);
    in_c_terms.zero_area = in_c(report.findings.zero_area, cutter);
    in_c_terms.collapsed = in_c(report.findings.collapsed, cutter);
    in_c_terms.duplicate = in_c(report.findings.duplicate, cutter);
    in_c_terms.equal_corners = report.findings.equal_corners;
    in_c_terms.bounds_min = in_c(report.bounds.min);
    in_c_terms.bounds_max = in_c(report.bounds.max);
    in_c_terms.extent = report.bounds.extent;
    in_c_terms.box_volume = report.bounds.volumes.box;
    in_c_terms.oriented_box_volume = report.bounds.volumes.oriented_box;
    in_c_terms.sphere_volume = report.bounds.volumes.sphere;
    in_c_terms.k_dop_volume = report.bounds.volumes.k_dop;
    in_c_terms.step = report.lattice.step;
    in_c_terms.max_error = report.lattice.max_error;
    in_c_terms.origin = {report.origin.x, report.origin.y, report.origin.z};
    in_c_terms.bits = report.lattice.bits;
    in_c_terms.range_positions = report.motion.positions;
    in_c_terms.moving_bytes = report.motion.moving_bytes;
    in_c_terms.range = {in_c(report.motion.range.min), in_c(report.motion.range.max)};
    in_c_terms.triangles = report.tree.triangles;
    in_c_terms.duplicate_references = report.tree.duplicate_references;
    in_c_terms.vertices = report.tree.vertices;
    in_c_terms.nodes = report.tree.nodes;
    in_c_terms.leaves = report.tree.leaves;
    in_c_terms.depth = report.tree.depth;
    in_c_terms.bits_that_keep_closed = report.bits_that_keep_closed;
    in_c_terms.bytes = report.bytes;
    in_c_terms.seconds = report.seconds;
    in_c_terms.is_closed = report.closed ? 1 : 0;
    put_warnings(report.warnings, cutter, in_c_terms);
    return in_c_terms;
}

espalier_original_triangle in_c(const OriginalTriangle& original) {
    return {original.file, original.mesh, original.triangle, original.first_corner};
}

/// Writes a piece and what it points to, or counts how much that takes.
void write_piece(const BakeResult& baked, bool with_remap, Cutter& cutter, Piece& piece) {
    const std::span<const OriginalTriangle> remap = with_remap ? baked.remap : std::span<const OriginalTriangle>();
    piece.result.bytes = cutter.copy(std::span<const std::byte>(baked.bytes), blob_alignment);
    piece.result.byte_count = baked.bytes.size();
    auto* const originals = cutter.array<espalier_original_triangle>(remap.size());
    for (std::size_t i = 0; originals != nullptr && i < remap.size(); ++i)
        new (originals + i) espalier_original_triangle(in_c(remap[i]));
    piece.result.remap = remap.empty() ? nullptr : originals;
    piece.result.remap_count = remap.size();
    piece.report = in_c(baked.report, cutter);
    piece.result.message = cutter.text(baked.message);
    piece.result.place = in_c(baked.place);
    piece.result.status = static_cast<espalier_bake_status>(baked.status);
}

void write_piece(const SceneBakeResult& baked, Cutter& cutter, Piece& piece) {
    piece.report = empty_report();
    piece.report.max_error = double(baked.report.max_error);
    piece.report.origin = {baked.report.origin.x, baked.report.origin.y, baked.report.origin.z};
    piece.report.bytes = baked.report.bytes;
    put_warnings(baked.report.warnings, cutter, piece.report);
    piece.result.bytes = cutter.copy(std::span<const std::byte>(baked.bytes), blob_alignment);
    piece.result.byte_count = baked.bytes.size();
    piece.result.message = cutter.text(baked.message);
    piece.result.place = in_c(std::nullopt);
    piece.result.status = static_cast<espalier_bake_status>(baked.status);
}

void write_piece(const Failure& failure, Cutter& cutter, Piece& piece) {
    piece.report = empty_report();
    piece.result.message = cutter.text(failure.message);
    piece.result.place = in_c(failure.place);
    piece.result.status = failure.status;
}

/// Returns null also where the callback throws, which it must not.
void* allocate(const ResultMemory& source, std::size_t size) noexcept {
    try {
        return source.allocate(size, source.user);
    } catch (...) {
        return nullptr;
    }
}

/// Allocates a piece and has it written: once to count, and once into its memory.
template <class Write>
const espalier_bake_result* allocate_piece(const ResultMemory& source, Write write) {
    Piece counted = {};
    Cutter counter(nullptr);
    counter.array<Piece>(1);
    write(counter, counted);
    const std::size_t size = counter.used() + blob_alignment - 1;
    void* const memory = allocate(source, size);
    if (memory == nullptr) return no_memory();
    void* aligned = memory;
    std::size_t space = size;
    std::align(blob_alignment, counter.used(), aligned, space);
    Cutter cutter(static_cast<std::byte*>(aligned));
    auto* const piece = new (cutter.array<Piece>(1)) Piece{};
    write(cutter, *piece);
    piece->source = source;
    piece->memory = memory;
    piece->size = size;
    piece->result.report = &piece->report;
    return &piece->result;
}

}  // namespace

const ResultMemory default_memory = {[](std::size_t size, void*) { return std::malloc(size); },
                                     [](void* memory, std::size_t, void*) { std::free(memory); }, nullptr};

const espalier_bake_result* no_memory() noexcept { return &out_of_memory.result; }

const espalier_bake_result* make_result(const BakeResult& baked, bool with_remap, const ResultMemory& memory) noexcept {
    return allocate_piece(memory, [&](Cutter& cutter, Piece& piece) { write_piece(baked, with_remap, cutter, piece); });
}

const espalier_bake_result* make_result(const SceneBakeResult& baked, const ResultMemory& memory) noexcept {
    return allocate_piece(memory, [&](Cutter& cutter, Piece& piece) { write_piece(baked, cutter, piece); });
}

const espalier_bake_result* make_result(const Failure& failure, const ResultMemory& memory) noexcept {
    return allocate_piece(memory, [&](Cutter& cutter, Piece& piece) { write_piece(failure, cutter, piece); });
}

const espalier_bake_result* result_of_exception(const ResultMemory& memory) {
    try {
        throw;
    } catch (const StoppedByProgress&) {
        return make_result(Failure{ESPALIER_BAKE_STOPPED, "the progress callback ended the bake"}, memory);
    } catch (const std::bad_alloc&) {
        return no_memory();
    } catch (const std::length_error&) {
        return no_memory();
    } catch (const std::exception& error) {
        return make_result(Failure{ESPALIER_BAKE_INTERNAL, error.what()}, memory);
    } catch (...) {
        return make_result(Failure{ESPALIER_BAKE_INTERNAL, "a callback threw an exception; it must not"}, memory);
    }
}

void release_result(const espalier_bake_result* result) noexcept {
    if (result == nullptr) return;
    const auto* const piece = reinterpret_cast<const Piece*>(result);
    if (piece->memory != nullptr) piece->source.release(piece->memory, piece->size, piece->source.user);
}

}  // namespace espalier::baker
