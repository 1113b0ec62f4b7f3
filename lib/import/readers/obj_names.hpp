// Which mesh of an OBJ file a face belongs to.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace espalier::importer {

/// A mesh is what has the same `o` and `g` names. Meshes are numbered by their first face.
class ObjNames {
public:
    /// Begins an object, which ends the group before it.
    void set_object(std::string_view name) { current_ = {copy_of(name), copy_of({})}; }
    void set_group(std::string_view name) { current_.second = copy_of(name); }

    /// Returns the number of the mesh with the current names: the next one, if it has none.
    std::uint32_t mesh() {
        const auto [place, is_new] = numbers_.try_emplace(current_, count());
        if (is_new) meshes_.push_back(current_);
        return place->second;
    }
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(meshes_.size()); }
    [[nodiscard]] std::string name_of(std::uint32_t mesh) const {
        const auto& [object, group] = meshes_[mesh];
        return object->empty() || group->empty() ? *object + *group : *object + '/' + *group;
    }

private:
    /// The names of the object and of the group. Each is there once, however many meshes have it.
    using Names = std::pair<const std::string*, const std::string*>;

    const std::string* copy_of(std::string_view name) { return &*copies_.emplace(name).first; }

    std::set<std::string, std::less<>> copies_;
    Names current_{copy_of({}), copy_of({})};
    std::map<Names, std::uint32_t> numbers_;
    std::vector<Names> meshes_;
};

}  // namespace espalier::importer
