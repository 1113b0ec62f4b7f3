// The kinds of `espalier query`: a table from which the command line and its help are made, and a question as it stands
// on the command line, read and checked. Each family of kinds has a file of its own, <family>.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <espalier/espalier.hpp>

#include "answer.hpp"
#include "base/verb_arguments.hpp"
#include "files/blob_file.hpp"
#include "report/source_point.hpp"

namespace espalier::tools {

struct QueryKind;
struct QueryWord;

/// A float from a length with a unit, or from a bare number, which may be inf or nan. Throws CommandError (usage).
float length_argument(const std::string& input, std::string_view name);
/// The same of a coordinate of the source, as one of the blob: the origin is subtracted in float64.
float place_argument(const std::string& input, std::string_view name, double origin);
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
    [[nodiscard]] const BakedScene* scene() const { return file_.is_a_scene ? &file_.scene() : nullptr; }
    /// Returns the blob, or the mesh of an instance of the scene.
    [[nodiscard]] Blob mesh_of(InstanceId instance) const {
        return scene() == nullptr ? blob() : mesh_at(*scene(), instance).value;
    }
    /// Returns whether the blob, or a mesh of the scene or of its tiles, has something.
    [[nodiscard]] bool has_mesh(bool (Blob::*has)() const noexcept) const;
    /// Returns the mask for queries of a scene.
    [[nodiscard]] std::uint32_t mask() const { return mask_; }
    [[nodiscard]] const QueryArguments& options() const { return arguments_; }
    /// Returns what the bake subtracted from places of the source.
    [[nodiscard]] const Vec3d& origin() const { return origin_; }
    /// Returns places of the answer in the coordinates of the source, as those of the question are.
    [[nodiscard]] SourcePoint in_source(Vec3 point) const { return {point, origin_}; }
    [[nodiscard]] SourceBox in_source(const Box& box) const { return {in_source(box.min), in_source(box.max)}; }

    /// Returns the next word, in the order of the kind's table, as a float, an index, a number of steps or a name, or
    /// the words of a point or a shape: its members in their order.
    template <class Value>
    Value next() {
        if constexpr (std::is_same_v<Value, Vec3>) return made<Vec3, float, float, float>();
        else if constexpr (std::is_same_v<Value, Triangle>) return made<Triangle, Vec3, Vec3, Vec3>();
        else if constexpr (std::is_same_v<Value, Segment>) return made<Segment, Vec3, Vec3>();
        else if constexpr (std::is_same_v<Value, Box>) return made<Box, Vec3, Vec3>();
        else if constexpr (std::is_same_v<Value, OrientedBox>)
            return {next<Vec3>(), {next<Vec3>(), next<Vec3>(), next<Vec3>()}};
        else if constexpr (std::is_same_v<Value, Sphere>) return made<Sphere, Vec3, float>();
        else if constexpr (std::is_same_v<Value, Plane>) return made<Plane, Vec3, float>();
        else if constexpr (std::is_same_v<Value, Capsule>) return made<Capsule, Vec3, Vec3, float>();
        else if constexpr (std::is_same_v<Value, Cone>) return made<Cone, Vec3, Vec3, float>();
        else if constexpr (std::is_same_v<Value, LatticePoint>)
            return made<LatticePoint, std::int32_t, std::int32_t, std::int32_t>();
        else if constexpr (std::is_same_v<Value, LatticeBox>) return made<LatticeBox, LatticePoint, LatticePoint>();
        else if constexpr (std::is_same_v<Value, LatticeSegment>)
            return made<LatticeSegment, LatticePoint, LatticePoint>();
        else return std::get<Value>(words_.at(at_++));
    }
    /// Returns all words that are left.
    template <class Value>
    std::vector<Value> rest() {
        std::vector<Value> values;
        while (at_ < words_.size()) values.push_back(next<Value>());
        return values;
    }
    /// Returns a triangle of the blob. Throws QueryRefusal when the blob has no such one.
    TriangleId next_triangle();

private:
    void open_asset(const QueryKind& kind);
    void read_words(std::span<const QueryWord* const> words);
    void read_word(const std::string& input, const QueryWord& word, unsigned part);
    [[nodiscard]] float plane_offset(const std::string& input, std::span<const std::string> normal) const;
    template <class Value, class... Members>
    Value made() {
        return Value{next<Members>()...};  // in this order
    }

    const QueryArguments& arguments_;
    AssetFile file_;
    Vec3d origin_;
    std::uint32_t mask_ = 0xFFFFFFFF;
    std::vector<std::variant<float, std::uint32_t, std::int32_t, std::string>> words_;
    std::size_t at_ = 0;  // the next one
};

/// The values of an argument that a query accepts; it refuses others as invalid.
enum class Range : std::uint8_t {
    finite,
    number,       ///< infinite ones too
    size,         ///< from 0 on, or infinite
    finite_size,  ///< from 0 on
    direction,    ///< finite, and not of length zero
    apart,        ///< finite, and another point than the argument before
    factor,       ///< finite and above 0
    directions,   ///< of winding_number()
};

/// Returns whether the coordinates of an argument are in the range, but for lengths that round to zero.
bool holds(Range range, std::span<const double> values);

/// Returns the words after "it must be".
const char* describe(Range range);

/// An argument after the kind's name on the command line; they are in order.
struct QueryWord {
    enum class Type : std::uint8_t {
        length,  ///< takes units; `inf` and `nan` too, which go to the query unchanged
        place,   ///< the same, a coordinate of the source
        offset,  ///< the same, of a plane whose normal the three numbers before it are
        number,  ///< no units; `inf` and `nan` too
        index,   ///< a whole number
        steps,   ///< a whole number of lattice steps, of either sign
        name,    ///< any text
    };
    const char* name;
    Type type;
    unsigned count = 1;             ///< 3: x y z
    Range range = Range::finite;    ///< what the query accepts
    const char* meaning = nullptr;  ///< for help, where type and range do not state it
};

constexpr QueryWord point_word(const char* name, Range range = Range::finite) {
    return {name, QueryWord::Type::place, 3, range};
}
/// The way from one point to another: a displacement, a half axis.
constexpr QueryWord way_word(const char* name, Range range = Range::finite) {
    return {name, QueryWord::Type::length, 3, range};
}
constexpr QueryWord vector_word(const char* name) { return {name, QueryWord::Type::number, 3, Range::direction}; }
constexpr QueryWord length_word(const char* name, Range range) { return {name, QueryWord::Type::length, 1, range}; }
constexpr QueryWord offset_word(const char* name, Range range) { return {name, QueryWord::Type::offset, 1, range}; }
constexpr QueryWord index_word(const char* name, const char* meaning, Range range = Range::finite) {
    return {name, QueryWord::Type::index, 1, range, meaning};
}
constexpr QueryWord triangle_word() { return index_word("triangle", "the number of a triangle of the blob, from 0"); }
constexpr QueryWord steps_word(const char* name, Range range = Range::finite) {
    return {name, QueryWord::Type::steps, 3, range};
}
constexpr QueryWord name_word(const char* name, const char* meaning) {
    return {name, QueryWord::Type::name, 1, Range::finite, meaning};
}

/// Which words may stand more than once: all in turn, once or more; or the last one, any number of times.
struct Repeats {
    enum class Which : std::uint8_t { none, all, last } which = Which::none;
    std::size_t most = 0;
};

/// The options that a kind takes; command_line/query_arguments.cpp describes each.
enum QueryOption : unsigned {
    option_t_range = 1u << 0,
    option_culling = 1u << 1,
    option_any = 1u << 2,
    option_all = 1u << 3,
    option_first = 1u << 4,
    option_accuracy = 1u << 5,
    option_crossings = 1u << 6,
    option_limit = 1u << 7,
    option_from = 1u << 8,
    option_max_distance = 1u << 9,
    option_placement = 1u << 10,
    option_depth = 1u << 11,
    option_mask = 1u << 12,  // of scenes
    option_work_limit = 1u << 13,
    option_few = 1u << 14,    // of contacts
    option_sweep = 1u << 15,  // what a sweep ignores, and its skin
};

struct QueryKind {
    const char* family;
    const char* name;
    const char* help;
    std::vector<QueryWord> words;
    unsigned options;
    Answer (*run)(QueryCall& call);
    Repeats repeats;
    std::optional<unsigned> scene_options;  ///< those that scenes take; nothing if they do not answer
    bool is_of_scenes_only;
};

/// Kinds under one heading of the help.
struct QueryFamily {
    const char* heading;

    QueryKind operator()(const char* name, const char* help, std::vector<QueryWord> words, unsigned options,
                         Answer (*run)(QueryCall& call), std::optional<unsigned> scene_options = {},
                         Repeats repeats = {}) const {
        return {heading, name, help, std::move(words), options, run, repeats, scene_options, false};
    }
    [[nodiscard]] QueryKind of_scenes(const char* name, const char* help, std::vector<QueryWord> words,
                                      unsigned options, Answer (*run)(QueryCall& call)) const {
        return {heading, name, help, std::move(words), 0, run, {}, options, true};
    }
};

/// Words as help and messages show them: "centre x y z, radius; once or more".
std::string words_text(const QueryKind& kind);
/// A line for each word: what it is, its unit and what the query accepts.
std::string words_help(const QueryKind& kind);
/// How many arguments the words are, each word once.
unsigned word_count(const QueryKind& kind);
/// The least number of arguments.
unsigned least_count(const QueryKind& kind);
/// Returns the words that so many arguments are, in order; none if there are too few or too many.
std::optional<std::vector<const QueryWord*>> words_of(const QueryKind& kind, std::size_t arguments);

using QueryKinds = std::vector<QueryKind>;
QueryKinds ray_kinds();
QueryKinds overlap_kinds();
QueryKinds distance_kinds();
QueryKinds contact_kinds();
QueryKinds sweep_kinds();
QueryKinds pair_kinds();
QueryKinds blob_kinds();
QueryKinds scene_kinds();

/// All of them, in the order in which help lists them.
const QueryKinds& query_kinds();

/// Returns the reason of a query that was answered in part or not at all, without a full stop: which argument is out
/// of its range, or the description of the status. `origin` is that of the blob.
std::string reason_of(const QueryKind& kind, const QueryArguments& arguments, const Vec3d& origin, QueryStatus status);

}  // namespace espalier::tools
