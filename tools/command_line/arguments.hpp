// What the command lines of several verbs have in common.
#pragma once

#include <string>

#include "base/verb_arguments.hpp"
#include "verb.hpp"

namespace espalier::tools {

inline const Choices<Axis> axes{{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}};

/// The blob or the scene that a verb reads.
void add_blob(Verb verb, std::string& blob);
void add_json(Verb verb, bool& json);
void add_json_and_quiet(Verb verb, bool& json, bool& quiet);
void add_threads(Verb verb, unsigned& threads, const std::string& description);
inline constexpr const char* strict_of_a_bake = "Warnings are errors: exit status 3, and nothing is written";
inline constexpr const char* allow_empty_of_a_bake =
    "Take files without triangles, and let bake write a blob without any; without it either is an error, and nothing "
    "is written";
/// The options of mesh files, with the descriptions of two of them. Where the last is null, there is no such option.
void add_source(Verb verb, SourceArguments& source, const char* strict = strict_of_a_bake,
                const char* allow_empty = allow_empty_of_a_bake);

// The verbs with the most options; the others are in main.cpp.
void add_bake(Verb verb, BakeArguments& arguments);
void add_query(Verb verb);
void add_trade(Verb verb, TradeArguments& arguments);

}  // namespace espalier::tools
