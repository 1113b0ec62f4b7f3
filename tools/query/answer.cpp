#include "answer.hpp"

#include <iostream>

#include <import/base/numbers.hpp>

#include "base/choices.hpp"
#include "kinds.hpp"
#include "report/diagnostics.hpp"

namespace espalier::tools {

namespace {

Json triangle_json(const Blob& blob, TriangleId triangle) {
    Json result;
    result["triangle"] = triangle.index;
    if (const Result<OriginalTriangle> original = original_triangle(blob, triangle)) {
        result["original"] = {{"file", original->file},
                              {"mesh", original->mesh},
                              {"triangle", original->triangle},
                              {"first_corner", original->first_corner}};
    }
    if (blob.has_materials()) result["material"] = material(blob, triangle);
    return result;
}

std::string triangle_text(const Blob& blob, TriangleId triangle) {
    std::string result = text("triangle ", triangle.index);
    if (const Result<OriginalTriangle> original = original_triangle(blob, triangle)) {
        result += text(" (file ", original->file, ", mesh ", original->mesh, ", triangle ", original->triangle,
                       original->first_corner == 0 ? "" : text(", from its corner ", original->first_corner), ")");
    }
    if (blob.has_materials()) result += text(", material ", material(blob, triangle));
    return result;
}

/// As they are spelled in status.hpp.
const Choices<QueryStatus> statuses{{"ok", QueryStatus::ok},
                                    {"stopped", QueryStatus::stopped},
                                    {"invalid_argument", QueryStatus::invalid_argument},
                                    {"out_of_range", QueryStatus::out_of_range},
                                    {"not_closed", QueryStatus::not_closed},
                                    {"work_limit", QueryStatus::work_limit},
                                    {"output_full", QueryStatus::output_full},
                                    {"not_found", QueryStatus::not_found},
                                    {"not_open", QueryStatus::not_open},
                                    {"no_data", QueryStatus::no_data},
                                    {"no_room", QueryStatus::no_room},
                                    {"stale_handle", QueryStatus::stale_handle},
                                    {"not_refitted", QueryStatus::not_refitted}};

}  // namespace

Record& Record::title(std::string_view line) {
    if (!as_json_) title_ = line;
    return *this;
}

Record& Record::put(const char* key, Json json, std::string_view line) {
    if (as_json_) {
        json_[key] = std::move(json);
    } else {
        lines_.push_back(line.empty() ? key : tools::text(key, ' ', line));
    }
    return *this;
}

Record& Record::add(const char* key, float value) { return put(key, json_number(value), shortest(value)); }
Record& Record::add(const char* key, Vec3 value) { return put(key, json_point(value), shortest(value)); }
Record& Record::add(const char* key, const SourcePoint& value) {
    return put(key, json_point(value), words_for_point(value));
}
Record& Record::add(const char* key, const std::string& value) { return put(key, value, value); }
Record& Record::add(const char* key, Side value) {
    return add(key, std::string(value == Side::front ? "front" : "back"));
}
Record& Record::add_count(const char* key, std::uint64_t value) { return put(key, value, tools::text(value)); }

Record& Record::add(const char* key, const SourceBox& value) {
    return put(key, json_box(value), tools::text(words_for_point(value.min), " to ", words_for_point(value.max)));
}

Record& Record::add(const char* key, const Record& value) {
    put(key, value.json_, value.title_);
    for (const std::string& line : value.lines_) lines_.push_back("  " + line);
    return *this;
}

Record& Record::add(const char* key, const std::vector<Record>& values) {
    Json json = Json::array();
    for (const Record& value : values) json.push_back(value.json_);
    put(key, std::move(json), "");
    for (const Record& value : values) {
        if (!value.title_.empty()) lines_.push_back("  " + value.title_);
        for (const std::string& line : value.lines_) lines_.push_back("    " + line);
    }
    return *this;
}

Record& Record::add(const char* key, std::span<const Vec3> values) {
    Json json = Json::array();
    for (const Vec3& value : values) json.push_back(json_point(value));
    return put(key, std::move(json), listed(values, ", ", [](Vec3 value) { return shortest(value); }));
}

Record& Record::add(const char* key, const std::vector<SourcePoint>& values) {
    Json json = Json::array();
    for (const SourcePoint& value : values) json.push_back(json_point(value));
    return put(key, std::move(json), listed(values, ", ", words_for_point));
}

Record& Record::add_silently(const char* key, Json value) {
    if (as_json_) json_[key] = std::move(value);
    return *this;
}

Record& Record::add_nulls(std::initializer_list<const char*> keys) {
    for (const char* key : keys) add_silently(key, nullptr);
    return *this;
}

Record& Record::no_triangle(const QueryCall& call) {
    if (call.scene() != nullptr) add_nulls({"instance"});
    if (call.scene() != nullptr && !call.scene()->tiles().empty()) add_nulls({"in_tile"});
    if (call.scene() != nullptr) add_nulls({"mesh", "user"});
    add_nulls({"triangle"});
    if (call.has_mesh(&Blob::has_original_ids)) add_nulls({"original"});
    if (call.has_mesh(&Blob::has_materials)) add_nulls({"material"});
    return *this;
}

Record& Record::triangle(const Blob& blob, TriangleId triangle, std::string_view before) {
    if (as_json_) {
        json_.update(triangle_json(blob, triangle));
    } else {
        title_ = std::string(before) + triangle_text(blob, triangle);
    }
    return *this;
}

Record& Record::instance(const BakedScene& scene, InstanceId instance) {
    const Instance at = *instance_at(scene, instance);
    add_silently("instance", instance.index);
    if (instance.in_tile != no_instance.in_tile) add_silently("in_tile", instance.in_tile);
    else if (!scene.tiles().empty()) add_nulls({"in_tile"});
    const std::size_t meshes = scene.meshes().size();
    const bool is_tile = instance.in_tile == no_instance.in_tile && at.mesh >= meshes;
    if (is_tile) add_silently("tile", at.mesh - meshes);
    else add_silently("mesh", at.mesh);
    add_silently("user", at.user);
    const std::string place = instance.in_tile == no_instance.in_tile
                                  ? tools::text("instance ", instance.index)
                                  : tools::text("instance ", instance.index, '.', instance.in_tile);
    return title(is_tile ? tools::text(place, " of tile ", at.mesh - meshes)
                         : tools::text(place, " of mesh ", at.mesh));
}

Record& Record::triangle(const BakedScene& scene, InstanceId instance, TriangleId triangle, std::string_view before) {
    this->instance(scene, instance);
    const std::string place = tools::text(before, title_, ", ");
    return this->triangle(mesh_at(scene, instance).value, triangle, place);
}

Record& Record::triangle(const QueryCall& call, TriangleId triangle, std::string_view before, InstanceId instance) {
    no_triangle(call);  // keys that other meshes of the scene have values for
    if (const BakedScene* scene = call.scene()) return this->triangle(*scene, instance, triangle, before);
    return this->triangle(call.blob(), triangle, before);
}

std::string Record::text() const {
    std::string result = title_;
    for (const std::string& line : lines_) result += (result.empty() ? "  " : "\n  ") + line;
    return result;
}

Answer::Answer(const QueryCall& call, QueryStatus query_status) : status(query_status), record(call.options().json) {}

Answer& Answer::yes_or_no(const char* key, bool yes, const char* words_for_yes, const char* words_for_no) {
    record.title(yes ? words_for_yes : words_for_no).add_silently(key, yes);
    return *this;
}

bool Answer::is_full(const QueryCall& call) {
    is_full_ = call.options().limit && list.size() == *call.options().limit;
    return is_full_;
}

Answer& Answer::work(const QueryCounters& counters) {
    record.add_count("nodes_visited", counters.nodes).add_count("leaves_visited", counters.leaves);
    return *this;
}

Answer& Answer::counted_list(const char* name, const char* singular, const std::uint32_t* next) {
    list_name = name;
    if (is_full_) status = QueryStatus::output_full;
    std::string words = list.size() == 1 ? text("1 ", singular) : text(list.size(), ' ', name);
    if (status == QueryStatus::output_full) {
        words += next == nullptr ? ", and there are more" : text(", and there are more: --from ", *next, " goes on");
    }
    record.title(words).add_silently("count", list.size());
    if (status == QueryStatus::output_full && next != nullptr) record.add_silently("next", *next);
    return *this;
}

QueryStatus complete(QueryStatus status) { return status == QueryStatus::not_found ? QueryStatus::ok : status; }

QueryStatus refusal(QueryStatus status) { return is_refused(status) ? status : QueryStatus::ok; }

ExitCode print_answer(const char* kind, const Answer& answer, const std::string& reason) {
    const bool is_whole = answer.status == QueryStatus::ok || answer.status == QueryStatus::output_full;
    const bool is_answer = is_whole || answer.status == QueryStatus::work_limit;
    const CommandError refusal(ExitCode::no_answer, text("query ", kind, ": ", reason, '.'));
    if (answer.record.as_json()) {
        Json document = json_document();
        document["query"] = kind;
        document["status"] = name_in(statuses, answer.status);
        if (is_answer) document.update(answer.record.json());
        if (is_answer && answer.list_name != nullptr) {
            Json& list = document[answer.list_name] = Json::array();
            for (const Record& record : answer.list) list.push_back(record.json());
        }
        if (!is_whole) return report_failure(refusal, &document);
        print_json(document);
    } else if (is_answer) {
        for (const Record& record : answer.list) std::cout << record.text() << '\n';
        if (const std::string last = answer.record.text(); !last.empty()) std::cout << last << '\n';
        finish_standard_output();
    }
    return is_whole ? ExitCode::ok : report_failure(refusal, nullptr);
}

}  // namespace espalier::tools
