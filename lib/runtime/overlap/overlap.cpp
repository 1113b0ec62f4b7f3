// Overlaps of a shape of any type: yes or no, each triangle, a page of them. How a shape finds them is in its own file.
#include <espalier/approximate.hpp>
#include <espalier/overlap.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/traversal/small_boxes.hpp>

namespace espalier::detail {

namespace {

constexpr auto stop = [](TriangleId) { return Visit::stop; };
constexpr TriangleVisitor stop_at_first(stop);  // takes no stack

YesNo find_any(const BlobData& blob, AnyShape shape, const WalkAccuracy& accuracy) {
    if (blob.bytes == nullptr) return YesNo();
    Each any(blob, stop_at_first, nullptr);
    const QueryStatus status = shape.find(blob, shape.shape, any, accuracy);
    return is_refused(status) ? YesNo(status) : YesNo::of(status == QueryStatus::stopped);
}

}  // namespace

YesNo overlaps(const Blob& blob, AnyShape shape) noexcept { return find_any(data_of(blob), shape, exactly); }

YesNo overlaps(const Blob& blob, AnyShape shape, Accuracy accuracy, QueryCounters* counters) noexcept {
    return find_any(data_of(blob), shape, {steps_in(data_of(blob), accuracy.distance), counters});
}

QueryStatus for_each_overlap(const Blob& blob, AnyShape shape, TriangleVisitor visit) noexcept {
    const BlobData& data = data_of(blob);
    if (data.bytes == nullptr) return QueryStatus::not_open;
    Each each(data, visit);
    return shape.find(data, shape.shape, each, exactly);
}

Filled collect_overlaps(const Blob& blob, AnyShape shape, std::span<TriangleId> out, const Cursor& from) noexcept {
    const BlobData& data = data_of(blob);
    Filled filled = {0, from, QueryStatus::not_open};
    if (data.bytes == nullptr) return filled;
    Each* self = nullptr;
    const auto write = [&self](TriangleId triangle) {
        if (self->out == self->out_end) return Visit::stop;
        *self->out++ = triangle;
        return Visit::next;
    };
    Each each(data, write);
    self = &each;
    each.out = out.data();
    each.out_end = each.out + out.size();
    each.first = from.place[0];
    filled.status = shape.find(data, shape.shape, each, exactly);
    filled.count = static_cast<std::size_t>(each.out - out.data());
    if (filled.status == QueryStatus::stopped) {
        filled.status = QueryStatus::output_full;
        filled.next = {{each.first}};
    }
    if (filled.status == QueryStatus::ok) filled.next = {{data.triangle_count}};
    return filled;
}

}  // namespace espalier::detail
