#include "c/expecting.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace espalier::tests {

namespace {

constexpr std::size_t queries = 4, most = 40;

/// The lists of a batch, made by one call for each query.
template <class Element>
struct Lists {
    std::vector<std::vector<Element>> elements;
    std::vector<QueryStatus> statuses;

    template <class Query>
    explicit Lists(Query query) {
        for (std::size_t i = 0; i < queries; ++i) {
            std::vector<Element>& list = elements.emplace_back();
            statuses.push_back(query(i, [&list](const Element& element) { list.push_back(element); }));
        }
    }
};

/// Which lists a call for those from `first` on writes.
struct Page {
    std::size_t end, count = 0, needed = 0;

    template <class Element>
    Page(const Lists<Element>& lists, std::size_t first, std::size_t capacity) : end(first) {
        for (; end < queries && needed == 0; ++end) {
            const std::size_t size = lists.elements[end].size();
            if (size > capacity - count) {
                needed = size;
                return;
            }
            count += size;
        }
    }
};

}  // namespace

void Expecting::batches() {
    const auto batch = [&] { tell(Filled{blob_ ? queries : 0, {}, blob_ ? QueryStatus::ok : QueryStatus::not_open}); };
    const auto each = [&](auto query) {
        batch();
        for (std::size_t i = 0; blob_ && i < queries; ++i) tell(query(i));
    };
    const auto rows = [&](std::size_t places, auto element, auto query) {
        batch();
        for (std::size_t i = 0; blob_ && i < queries; ++i) {
            std::vector<decltype(element)> row(places);
            const Filled filled = query(i, std::span(row));
            tell(filled);
            for (std::size_t k = 0; k < filled.count; ++k) tell(row[k]);
        }
    };
    const auto page = [&](const auto& lists, std::size_t first, std::size_t capacity) {
        Page written(lists, first, capacity);
        if (!blob_) written.end = first;
        tell(std::uint64_t{written.end - first});
        tell(std::uint64_t{written.count});
        tell(std::uint64_t{written.needed});
        tell(!blob_ ? QueryStatus::not_open : written.needed != 0 ? QueryStatus::output_full : QueryStatus::ok);
        std::size_t end = 0;
        for (std::size_t i = first; i < written.end; ++i) {
            tell(lists.statuses[i]);
            tell(std::uint64_t{end += lists.elements[i].size()});
        }
        for (std::size_t i = first; i < written.end; ++i)
            for (const auto& element : lists.elements[i]) tell(element);
        return written;
    };
    const auto ray = [&](std::size_t i) {
        const int number = static_cast<int>(i);
        Ray made = {point(number), direction(3 - number)};
        if ((asked_.bits & 1u) != 0) made.t_max = length(number);
        if ((asked_.bits & 2u) != 0) made.t_min = length(3);
        made.culling = static_cast<FaceCulling>(asked_.bits >> 2 & 3u);
        return made;
    };
    const auto at = [&](std::size_t i) { return point(static_cast<int>(i)); };

    each([&](std::size_t i) { return raycast(blob_, ray(i)); });
    each([&](std::size_t i) { return occluded(blob_, ray(i)); });
    rows(3, RayHit(), [&](std::size_t i, std::span<RayHit> row) { return closest_hits(blob_, ray(i), row); });
    const auto all_pages = [&](const Lists<RayHit>& lists) {
        std::size_t capacity = asked_.bits % 7;
        for (std::size_t first = 0;;) {
            const Page written = page(lists, first, capacity);
            if (!blob_ || written.needed == 0 || written.needed > most) return;
            first = written.end;
            capacity = std::max(capacity, written.needed);
        }
    };
    all_pages(Lists<RayHit>([&](std::size_t i, auto visit) { return for_each_hit(blob_, ray(i), visit); }));
    all_pages(Lists<RayHit>([&](std::size_t i, auto visit) { return for_each_crossing(blob_, ray(i), visit); }));

    each([&](std::size_t i) { return closest_point(blob_, at(i), length(0)); });
    each([&](std::size_t i) { return signed_distance(blob_, at(i), length(0)); });
    each([&](std::size_t i) { return contains(blob_, at(i)); });
    rows(2, ClosestPoint(),
         [&](std::size_t i, std::span<ClosestPoint> row) { return closest_triangles(blob_, at(i), row, length(0)); });

    const auto sphere_at = [&](std::size_t i) { return Sphere{at(i), length(static_cast<int>(i))}; };
    const auto box_at = [&](std::size_t i) { return Box{at(0), at(i)}; };
    each([&](std::size_t i) { return overlaps(blob_, sphere_at(i)); });
    each([&](std::size_t i) { return overlaps(blob_, box_at(i)); });
    page(Lists<TriangleId>([&](std::size_t i, auto visit) { return for_each_overlap(blob_, sphere_at(i), visit); }), 0,
         most);
    page(Lists<TriangleId>([&](std::size_t i, auto visit) { return for_each_overlap(blob_, box_at(i), visit); }), 0,
         most);

    const std::array triangles = {TriangleId{0}, TriangleId{asked_.bits % 200}, TriangleId{asked_.bits}, no_triangle};
    each([&](std::size_t i) { return original_triangle(blob_, triangles[i]); });
    each([&](std::size_t i) { return std::uint32_t{material(blob_, triangles[i])}; });
    batch();
    for (std::size_t i = 0; blob_ && i < queries; ++i) {
        const Result<Triangle> corners = triangle_at(blob_, triangles[i]);
        tell(corners.status);
        tell(corners->a);
        tell(corners->b);
        tell(corners->c);
    }
}

}  // namespace espalier::tests
