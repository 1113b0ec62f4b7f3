#include "kinds.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include <import/base/numbers.hpp>

#include "base/choices.hpp"
#include "base/vectors.hpp"

namespace espalier::tools {

float number_argument(const std::string& input, std::string_view name) {
    const std::optional<float> value = parse_float(input);
    if (!value) throw_error(ExitCode::usage, name, ": '", printable(input), "' is no number.");
    return *value;
}

float length_argument(const std::string& input, std::string_view name) {
    const std::optional<float> value = parse_float(input);
    return value ? *value : static_cast<float>(parse_length(input, name));
}

float place_argument(const std::string& input, std::string_view name, double origin) {
    if (origin == 0.0) return length_argument(input, name);
    const std::optional<double> number = parse_double(input);
    return to_float32((number ? *number : parse_length(input, name)) - origin);
}

std::string typed(const std::string& word) { return word.starts_with(" -") ? word.substr(1) : word; }

namespace {

std::uint32_t mask_argument(const std::string& input) {
    const bool is_hexadecimal = input.starts_with("0x") || input.starts_with("0X");
    const char* const begin = input.data() + (is_hexadecimal ? 2 : 0);
    const char* const end = input.data() + input.size();
    std::uint32_t mask = 0;
    const auto [stopped, error] = std::from_chars(begin, end, mask, is_hexadecimal ? 16 : 10);
    if (error == std::errc() && stopped == end) return mask;
    throw_error(ExitCode::usage, "--mask: '", printable(input), "' is no number of 32 bits. Write it as 6 or as 0x6.");
}

/// An option of which blobs and scenes do not all take the same.
struct GivenOption {
    unsigned option;
    const char* name;
    bool is_given;
};

std::array<GivenOption, 11> given_options(const QueryArguments& arguments) {
    return {{{option_any, "--any", arguments.any},
             {option_all, "--all", arguments.all},
             {option_crossings, "--crossings", arguments.crossings},
             {option_first, "--first", arguments.first.has_value()},
             {option_accuracy, "--accuracy", !arguments.accuracy.empty()},
             {option_limit, "--limit", arguments.limit.has_value()},
             {option_from, "--from", arguments.from != 0},
             {option_mask, "--mask", !arguments.mask.empty()},
             {option_culling, "--culling", arguments.culling != FaceCulling::none},
             {option_sweep, "--ignore-leaving", arguments.ignore_leaving},
             {option_sweep, "--skin", arguments.skin != "0"}}};
}

}  // namespace

QueryCall::QueryCall(const QueryKind& kind, const QueryArguments& arguments) : arguments_(arguments) {
    const std::size_t given = arguments.words.size();
    const std::optional<std::vector<const QueryWord*>> words = words_of(kind, given);
    if (!words) {
        throw_error(ExitCode::usage, "query ", kind.name, " takes ", counted(word_count(kind), "argument"), ": ",
                    words_text(kind), "; here are ", given, '.');
    }
    read_words(*words);
    if (!arguments.mask.empty()) mask_ = mask_argument(arguments.mask);
    open_asset(kind);
    origin_ = scene() == nullptr ? blob().source_origin() : scene()->source_origin();
    if (origin_ != Vec3d{}) read_words(*words);
}

void QueryCall::read_words(std::span<const QueryWord* const> words) {
    words_.clear();
    for (const QueryWord* word : words)
        for (unsigned i = 0; i < word->count; ++i) read_word(typed(arguments_.words[words_.size()]), *word, i);
}

/// For a normal and an offset in the source: normal * (p - origin) <= offset - normal * origin.
float QueryCall::plane_offset(const std::string& input, std::span<const std::string> normal) const {
    if (origin_ == Vec3d{}) return length_argument(input, "offset");
    const auto along = [&](std::size_t axis) { return parse_double(typed(normal[axis])).value_or(0.0); };
    return place_argument(input, "offset", dot({along(0), along(1), along(2)}, origin_));
}

void QueryCall::open_asset(const QueryKind& kind) {
    file_ = AssetFile(arguments_.blob);
    const bool is_of_scene = file_.is_a_scene;
    const char* asset = is_of_scene ? "a scene" : "a blob";
    if (is_of_scene ? !kind.scene_options : kind.is_of_scenes_only) {
        throw CommandError(ExitCode::unsupported,
                           text("query ", kind.name, ": '", printable(arguments_.blob), "' is ", asset,
                                is_of_scene ? ", which does not answer this kind. 'query --help' lists those of scenes."
                                            : ", and this kind is of scenes."),
                           {.file = arguments_.blob});
    }
    const unsigned offered = is_of_scene ? *kind.scene_options : kind.options;
    for (const auto& [option, name, is_given] : given_options(arguments_)) {
        if (!is_given || (offered & option) != 0) continue;
        throw CommandError(ExitCode::unsupported,
                           text(name, ": '", printable(arguments_.blob), "' is ", asset, ", for which query ",
                                kind.name, " does not take the option. Leave it out."),
                           {.file = arguments_.blob});
    }
    file_.require_open();
}

void QueryCall::read_word(const std::string& input, const QueryWord& word, unsigned part) {
    using Type = QueryWord::Type;
    const double origin[] = {origin_.x, origin_.y, origin_.z};
    const auto whole = [&]<class Whole>(Whole least, const char* problem) {
        const std::optional<double> value = parse_double(input);
        const bool is_within = value && *value >= double(least) && *value <= double(std::numeric_limits<Whole>::max());
        if (!is_within || *value != std::floor(*value))
            throw_error(ExitCode::usage, word.name, ": '", printable(input), problem);
        words_.emplace_back(static_cast<Whole>(*value));
    };
    if (word.type == Type::length) words_.emplace_back(length_argument(input, word.name));
    if (word.type == Type::place) words_.emplace_back(place_argument(input, word.name, origin[part]));
    if (word.type == Type::offset)
        words_.emplace_back(plane_offset(input, std::span(arguments_.words).subspan(words_.size() - 3, 3)));
    if (word.type == Type::number) words_.emplace_back(number_argument(input, word.name));
    if (word.type == Type::index) whole(std::uint32_t{0}, "' is no whole number from 0 on.");
    if (word.type == Type::steps)
        whole(std::numeric_limits<std::int32_t>::min(), "' is no whole number of lattice steps of 32 bits.");
    if (word.type == Type::name) words_.emplace_back(input);
}

bool QueryCall::has_mesh(bool (Blob::*has)() const noexcept) const {
    const auto any = [has](std::span<const Blob> meshes) {
        return std::any_of(meshes.begin(), meshes.end(), [has](const Blob& mesh) { return (mesh.*has)(); });
    };
    if (scene() == nullptr) return (blob().*has)();
    const std::span<const BakedScene> tiles = scene()->tiles();
    return any(scene()->meshes()) ||
           std::any_of(tiles.begin(), tiles.end(), [&](const BakedScene& tile) { return any(tile.meshes()); });
}

TriangleId QueryCall::next_triangle() {
    const TriangleId triangle{next<std::uint32_t>()};
    if (triangle.index < blob().triangle_count()) return triangle;
    throw QueryRefusal{QueryStatus::invalid_argument,
                       text("triangle is ", triangle.index, "; the blob has ",
                            counted(blob().triangle_count(), "triangle"), ", counted from 0")};
}

}  // namespace espalier::tools
