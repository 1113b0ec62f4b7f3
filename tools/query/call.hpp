// One question as it stands on the command line, read and checked, with the blob or the scene that it goes to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <espalier/espalier.hpp>

#include "base/verb_arguments.hpp"
#include "files/blob_file.hpp"

namespace espalier::tools {

struct QueryKind;
struct QueryWord;

/// A float from a length with a unit, or from a bare number, which may be inf or nan. Throws CommandError (usage).
float length_argument(const std::string& input, std::string_view name);
/// The same without units.
float number_argument(const std::string& input, std::string_view name);

/// Returns a word as it was typed: verb.cpp marks negative numbers by a space.
std::string typed(const std::string& word);

class QueryCall {
public:
    /// Reads all words, then opens the blob or the scene. Throws CommandError, also when that does not answer the kind
    /// or one of the options.
    QueryCall(const QueryKind& kind, const QueryArguments& arguments);

    /// Returns the blob; a default one for a query of a scene.
    [[nodiscard]] const Blob& blob() const { return file_.blob; }
    /// Returns the scene, if the query is of one.
    [[nodiscard]] const BakedScene* scene() const { return scene_.scene ? &scene_.scene : nullptr; }
    /// Returns the mask for queries of a scene.
    [[nodiscard]] std::uint32_t mask() const { return mask_; }
    [[nodiscard]] const QueryArguments& options() const { return arguments_; }

    // The words, one after another, in the order of the kind's table. Numbers, indices and names each have their own.
    /// A Vec3, a LatticePoint, or a shape of them: its members in their order.
    template <class Value>
    Value next();
    float next_number();
    std::uint32_t next_index();
    const std::string& next_name();
    [[nodiscard]] bool has_numbers() const { return number_ < numbers_.size(); }
    /// As next_index, and of the blob. Throws CommandError (usage) when the blob has no such triangle.
    TriangleId next_triangle();

private:
    void open_asset(const QueryKind& kind);
    void read_word(const std::string& input, const QueryWord& word);

    const QueryArguments& arguments_;
    BlobFile file_;
    std::vector<std::byte> bytes_of_scene_;
    SceneFile scene_;
    std::uint32_t mask_ = 0xFFFFFFFF;
    std::vector<float> numbers_;
    std::vector<std::uint32_t> indices_;
    std::vector<std::int32_t> steps_;
    std::vector<std::string> names_;
    std::size_t number_ = 0;
    std::size_t index_ = 0;
    std::size_t step_ = 0;
    std::size_t name_ = 0;
};

template <>
Vec3 QueryCall::next();
template <>
LatticePoint QueryCall::next();
template <>
Sphere QueryCall::next();
template <>
Capsule QueryCall::next();
template <>
Box QueryCall::next();
template <>
LatticeBox QueryCall::next();
template <>
OrientedBox QueryCall::next();
template <>
Cone QueryCall::next();
template <>
Triangle QueryCall::next();

}  // namespace espalier::tools
