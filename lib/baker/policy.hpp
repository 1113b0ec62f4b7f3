// What a bake lost, and whether it may.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <espalier/bake.hpp>

#include <baker/base/expected.hpp>

namespace espalier::baker {

/// The triangles whose surface is not in the blob. Those with two corners in one place had none, and a duplicate's is
/// there once.
struct LostTriangles {
    std::uint64_t count = 0;
    std::uint64_t of = 0;              ///< those of the source that had a surface
    std::string words;                 ///< "3 without area (first: box.obj, mesh 0, triangle 5)" for each reason
    std::optional<SourcePlace> place;  ///< of the first

    [[nodiscard]] bool are_more_than(double percent) const { return double(count) * 100.0 > percent * double(of); }
};
[[nodiscard]] LostTriangles lost_triangles(const BakeReport& report);

/// Returns why a policy refuses a bake with this report.
[[nodiscard]] std::optional<Refusal> judge(const BakePolicy& policy, const BakeReport& report);

}  // namespace espalier::baker
