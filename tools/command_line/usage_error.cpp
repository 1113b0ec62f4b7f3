#include "verb.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>

#include <import/base/numbers.hpp>
#include <import/platform/files.hpp>

namespace espalier::tools {

namespace {

/// Names that are no kind of query: names of calls in C++ and C, and those that kinds had in earlier versions.
constexpr std::array<std::pair<const char*, const char*>, 10> other_names_of_kinds{
    {{"raycast", "ray"},
     {"closest", "closest-point"},
     {"nearest", "closest-point"},
     {"nearest-segment", "closest-point-segment"},
     {"nearest-box", "closest-point-box"},
     {"inside", "contains"},
     {"planes", "convex-volume"},
     {"within", "within-distance"},
     {"steps", "to-lattice"},
     {"contact", "fix-internal-edge-normal"}}};

/// The optimal string alignment distance (Damerau 1964), over three rows of its table.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
        std::swap(before_last, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

/// Returns the first of the words, in lower case, that are nearest to `typed` in lower case, by letters inserted, left
/// out, replaced or exchanged with the next. Empty if none is within a third of its length.
std::string similar_word(std::string_view typed, std::span<const std::string> words) {
    const std::string lower = lower_case(typed);
    std::string nearest;
    std::size_t least = typed.size() / 3 + 1;
    for (const std::string& word : words) {
        const std::size_t found = distance(lower, word);
        if (found >= least) continue;
        least = found;
        nearest = word;
    }
    return nearest;
}

/// The verb or the kind of query that was being read.
const CLI::App& innermost(const CLI::App& app) {
    const CLI::App* verb = &app;
    while (!verb->get_subcommands().empty()) verb = verb->get_subcommands().front();
    return *verb;
}

/// "espalier query BLOB ray"
std::string command_of(const CLI::App& verb) {
    if (verb.get_parent() == nullptr) return verb.get_name();
    return text(command_of(*verb.get_parent()), verb.get_parent()->get_name() == "query" ? " BLOB " : " ",
                verb.get_name());
}

std::string did_you_mean(const std::string& word) { return word.empty() ? "" : text("; did you mean '", word, "'?"); }

/// The words before and after the first `divider`, or the whole and nothing.
std::pair<std::string, std::string> divided(const std::string& line, const std::string& divider) {
    const std::size_t at = line.find(divider);
    if (at == std::string::npos) return {line, {}};
    return {line.substr(0, at), line.substr(at + divider.size())};
}

std::string unknown_option(const CLI::App& verb, const std::string& typed) {
    std::vector<std::string> names;
    for (const CLI::Option* option : verb.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return text("there is no option '", printable(typed), "' here", did_you_mean(similar_word(typed, names)));
}

/// Of the verbs, or of the kinds of query.
std::vector<std::string> names_below(const CLI::App& verb) {
    std::vector<std::string> names;
    for (const CLI::App* one : verb.get_subcommands({})) names.push_back(one->get_name());
    return names;
}

/// "BLOB is missing before 'ray'" where the kind of a query stands in the blob's place; else empty.
std::string missing_blob(const CLI::App& verb) {
    const CLI::Option* blob = verb.get_option_no_throw("blob");
    if (blob == nullptr || blob->count() == 0) return {};
    const std::string& given = blob->results().front();
    const std::vector<std::string> kinds = names_below(verb);
    std::error_code error;
    if (std::find(kinds.begin(), kinds.end(), given) == kinds.end() || std::filesystem::exists(path_of(given), error))
        return {};
    return text("BLOB is missing before '", given, '\'');
}

std::string unknown_verb(const CLI::App& verb, const std::string& typed) {
    if (std::string missing = missing_blob(verb); !missing.empty()) return missing;
    const std::vector<std::string> names = names_below(verb);
    const bool is_query = verb.get_parent() != nullptr;
    std::string meant = similar_word(typed, names);
    for (const auto& [name, kind] : other_names_of_kinds)
        if (is_query && typed == name) meant = kind;
    return text("there is no ", is_query ? "kind of query" : "verb", " '", printable(typed), "'", did_you_mean(meant));
}

/// A value or a positional word that is missing: "--output BLOB", "MESH", "origin x y z, direction x y z".
std::string name_of_option(const CLI::App& verb, const std::string& name) {
    const CLI::Option* option = verb.get_option_no_throw(name);
    if (option == nullptr) return name;
    if (name == "words") return option->get_description();
    return option->get_positional() ? option->get_type_name() : text(name, ' ', option->get_type_name());
}

std::string message_of(const CLI::App& verb, const CLI::ParseError& error) {
    const std::string words = error.what();
    const std::vector<std::string> left = verb.remaining();
    const auto option =
        std::find_if(left.begin(), left.end(), [](const std::string& word) { return word.starts_with('-'); });
    const auto word =
        std::find_if(left.begin(), left.end(), [](const std::string& one) { return !one.starts_with('-'); });
    const bool lacks_verb = verb.get_require_subcommand_min() > 0;
    if (lacks_verb && word != left.end()) return unknown_verb(verb, *word);
    if (option != left.end()) return unknown_option(verb, *option);
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && word != left.end()) {
        return text("'", printable(*word), "' is one word too many");
    }
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
        const std::string name = divided(words, " is required").first;
        if (name != "A subcommand") return text(name_of_option(verb, name), " is missing");
        if (std::string missing = missing_blob(verb); !missing.empty()) return missing;
        return verb.get_parent() == nullptr ? "the verb is missing" : "the kind of query is missing";
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
        const auto [name, reason] = divided(words, ": ");
        const auto [limit, given] = divided(reason, " required but received ");
        if (name == "words") {
            const std::string count = limit.substr(limit.rfind(' ') + 1);  // "At least 6", "At Most 6"
            return text("this query takes ", count, count == "1" ? " word: " : " words: ", name_of_option(verb, name),
                        "; here are ", given);
        }
        if (limit == "At Most 1" && !given.empty()) return text(name, " is given ", given, " times; give it once");
        return text(name_of_option(verb, name), ": a value is missing");
    }
    if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
        const auto [name, value] = divided(divided(words, "Could not convert: ").second, " = ");
        return text("'", printable(value.substr(std::min(value.size(), value.find_first_not_of(' ')))),
                    "' is no value for ", name_of_option(verb, name));
    }
    if (const auto [one, other] = divided(words, " excludes "); !other.empty())
        return text(one, " and ", other, " exclude each other; give one of them");
    if (const auto [one, other] = divided(words, " requires "); !other.empty())
        return text(one, " needs ", other, " beside it");
    return printable(words);
}

}  // namespace

CommandError usage_error(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& verb = innermost(app);
    std::string message = message_of(verb, error);
    if (!message.ends_with('?') && !message.ends_with('.')) message += '.';
    return {ExitCode::usage, text(message, " Run '", command_of(verb), " --help'.")};
}

}  // namespace espalier::tools
