#include "plan.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "repeats.hpp"

namespace espalier::tools {

namespace {

Variant standing_in_place(const Imported& imported, std::uint32_t place) {
    const ImportedPlace& standing = imported.places[place];
    return {standing.mesh,
            standing.placement,
            box_at(imported.meshes[standing.mesh], standing.placement),
            {{place, fit_translation({})}}};
}

}  // namespace

ScenePlan plan_scene(const Imported& imported, Instancing instancing, double largest_error) {
    const std::vector<std::uint32_t> first = first_with_content(imported.meshes);
    std::map<std::uint32_t, std::vector<std::uint32_t>> places_of;  // by the first mesh with that content
    for (std::uint32_t i = 0; i < imported.places.size(); ++i) {
        const std::uint32_t mesh = imported.places[i].mesh;
        if (!imported.meshes[mesh].triangles.empty()) places_of[first[mesh]].push_back(i);
    }
    ScenePlan plan;
    const bool is_automatic = instancing == Instancing::automatic;
    for (const auto& [mesh, places] : places_of) {
        if (is_automatic && places.size() == 1) {
            plan.merged.push_back(places.front());
            continue;
        }
        VariantSorter sorter(imported, mesh, largest_error);
        for (const std::uint32_t place : places) {
            if (sorter.add(place)) continue;
            if (is_automatic) plan.merged.push_back(place);
            else plan.meshes.push_back(standing_in_place(imported, place));
        }
        for (Variant& variant : sorter.variants()) {
            if (is_automatic && variant.uses.size() == 1) plan.merged.push_back(variant.uses.front().place);
            else plan.meshes.push_back(std::move(variant));
        }
    }
    std::sort(plan.merged.begin(), plan.merged.end());
    std::sort(plan.meshes.begin(), plan.meshes.end(),
              [](const Variant& a, const Variant& b) { return a.uses.front().place < b.uses.front().place; });
    return plan;
}

}  // namespace espalier::tools
