#include "cost_model_file.hpp"

#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "blob_file.hpp"
#include "report/json_output.hpp"

namespace espalier::tools {

namespace {

constexpr double most_expensive = 1e6;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw CommandError(ExitCode::invalid_input, text("cost model '", printable(path), "': ", why));
}

}  // namespace

CostModel read_cost_model(const std::string& path) {
    const std::vector<std::byte> bytes = read_file(path);
    const char* begin = reinterpret_cast<const char*>(bytes.data());
    const Json document = Json::parse(begin, begin + bytes.size(), nullptr, false);
    if (document.is_discarded()) refuse(path, "it is no JSON. Write an object such as {\"node_visit\": 1.2}.");
    if (!document.is_object()) refuse(path, "it is no JSON object. Write one such as {\"node_visit\": 1.2}.");
    CostModel model;
    const std::pair<const char*, float*> fields[] = {{"node_visit", &model.node_visit},
                                                     {"leaf_visit", &model.leaf_visit},
                                                     {"leaf_group", &model.leaf_group},
                                                     {"triangle", &model.triangle},
                                                     {"byte_price", &model.byte_price}};
    for (const auto& [key, value] : document.items()) {
        float* target = nullptr;
        for (const auto& [name, field] : fields) {
            if (key == name) target = field;
        }
        const std::string field = text("field '", printable(key), '\'');
        if (target == nullptr) {
            refuse(
                path,
                field + " is not known. The fields are node_visit, leaf_visit, leaf_group, triangle and byte_price.");
        }
        const double cost = value.is_number() ? value.get<double>() : -1.0;
        if (!(cost >= 0.0 && cost <= most_expensive)) refuse(path, field + ": write a number from 0 to 1000000.");
        *target = static_cast<float>(cost);
    }
    return model;
}

}  // namespace espalier::tools
