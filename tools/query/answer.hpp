// The answer of a query, as text for people or as JSON for scripts.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/advanced/statistics.hpp>

#include "base/exit_code.hpp"
#include "report/json.hpp"
#include "report/source_point.hpp"

namespace espalier::tools {

class QueryCall;

/// A found thing: in text a title and a line for each property, in JSON an object.
class Record {
public:
    explicit Record(bool as_json) : as_json_(as_json), json_(Json::object()) {}

    Record& title(std::string_view line);
    template <std::same_as<bool> Bool>  // no pointer becomes one
    Record& add(const char* key, Bool value) {
        return put(key, value, value ? "yes" : "no");
    }
    Record& add(const char* key, float value);
    Record& add(const char* key, Vec3 value);
    Record& add(const char* key, const SourcePoint& value);
    Record& add(const char* key, Side value);
    Record& add(const char* key, const std::string& value);
    Record& add(const char* key, const SourceBox& value);
    Record& add_count(const char* key, std::uint64_t value);
    /// An object of its own; in text its lines, indented.
    Record& add(const char* key, const Record& value);
    Record& add(const char* key, const std::vector<Record>& values);
    Record& add(const char* key, std::span<const Vec3> values);
    Record& add(const char* key, const std::vector<SourcePoint>& values);
    /// Adds a value to JSON only, since the title has it in text.
    Record& add_silently(const char* key, Json value);
    /// Adds keys to JSON only, whose values are null unless they are added later: those of a hit, for a miss.
    Record& add_nulls(std::initializer_list<const char*> keys);
    /// Adds the keys by which triangle() names one, as nulls.
    Record& no_triangle(const QueryCall& call);
    /// "triangle 5 (file 0, mesh 1, triangle 7), material 3" is the title, after `before`.
    Record& triangle(const Blob& blob, TriangleId triangle, std::string_view before = "");

    /// "instance 4 of mesh 0, triangle 5" is the title, after `before`.
    Record& triangle(const BakedScene& scene, InstanceId instance, TriangleId triangle, std::string_view before = "");
    /// One of these, of the blob or of an instance of the scene that the query is of.
    Record& triangle(const QueryCall& call, TriangleId triangle, std::string_view before,
                     InstanceId instance = no_instance);
    /// Names an instance: "instance 4 of mesh 0" is the title.
    Record& instance(const BakedScene& scene, InstanceId instance);

    [[nodiscard]] const Json& json() const { return json_; }
    [[nodiscard]] std::string text() const;
    [[nodiscard]] bool as_json() const { return as_json_; }

private:
    Record& put(const char* key, Json json, std::string_view line);

    bool as_json_;
    Json json_;
    std::string title_;
    std::vector<std::string> lines_;
};

struct Answer {
    explicit Answer(const QueryCall& call, QueryStatus query_status = QueryStatus::ok);

    QueryStatus status;
    Record record;
    const char* list_name = nullptr;  ///< the key of the list in JSON; without one there is no list
    std::vector<Record> list;

    /// Appends a record to the list.
    Record& add() { return list.emplace_back(record.as_json()); }
    /// A key that is true or false, and the words for it.
    Answer& yes_or_no(const char* key, bool yes, const char* words_for_yes, const char* words_for_no);
    /// Whether the list is as long as --limit allows; then counted_list reports that there are more.
    bool is_full(const QueryCall& call);
    /// What a walk visited.
    Answer& work(const QueryCounters& counters);
    /// Ends a list: how many there are of what; with output_full that there are more, and from where on if it is known.
    Answer& counted_list(const char* name, const char* singular, const std::uint32_t* next = nullptr);

private:
    bool is_full_ = false;
};

/// Ends a query that the command refuses, as the library refuses others. The reason has no full stop.
struct QueryRefusal {
    QueryStatus status;
    std::string reason;
};

/// The status of an answer that has words for a miss: that nothing was found is an answer like any other.
QueryStatus complete(QueryStatus status);
/// The status of a refused query, else ok. What the record of a refused query holds is not printed.
QueryStatus refusal(QueryStatus status);

/// Prints the answer to stdout, of a refused query the status alone and that in JSON only. Returns no_answer and
/// reports the reason on stderr when the query was refused or answered in part.
ExitCode print_answer(const char* kind, const Answer& answer, const std::string& reason);

}  // namespace espalier::tools
