// What a scene holds: its instances.
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/numbers.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

std::optional<std::uint32_t> parse_index(std::string_view word) {
    std::uint32_t value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

/// Reads "3", or "3.5" for the instance 5 of the tile that instance 3 is.
InstanceId next_instance(QueryCall& call) {
    const std::string name = call.next_name();
    const std::size_t dot = name.find('.');
    const std::optional<std::uint32_t> index = parse_index(std::string_view(name).substr(0, dot));
    const std::optional<std::uint32_t> in_tile =
        dot == std::string::npos ? no_instance.in_tile : parse_index(std::string_view(name).substr(dot + 1));
    if (!index || !in_tile)
        throw CommandError(ExitCode::usage, text("instance '", printable(name),
                                                 "': give its number, as in 3, or, for "
                                                 "one in a tile, both numbers, as in 3.5."));
    const InstanceId instance{*index, *in_tile};
    if (instance_at(*call.scene(), instance)) return instance;
    throw CommandError(
        ExitCode::usage,
        text("instance ", printable(name), ": the scene has ", counted(call.scene()->instance_count(), "instance"),
             ", counted from 0",
             dot == std::string::npos ? "." : ", and this one is no tile or a tile with fewer instances."));
}

Answer instance_answer(QueryCall& call) {
    const InstanceId id = next_instance(call);
    const Instance instance = *instance_at(*call.scene(), id);
    const auto& [x, y, z, w] = instance.transform.rotation;
    Answer answer(call);
    Record& record = answer.record.instance(*call.scene(), id);
    record.add("rotation", text(shortest(x), ' ', shortest(y), ' ', shortest(z), ' ', shortest(w)));
    record.add_silently("rotation", Json::array({json_number(x), json_number(y), json_number(z), json_number(w)}));
    record.add("translation", instance.transform.translation).add("scale", instance.transform.scale);
    record.add_count("mask", instance.mask).add_count("user", instance.user).add_count("source", instance.source);
    return answer;
}

Answer candidates_answer(QueryCall& call) {
    const auto box = call.next<Box>();
    Answer answer(call);
    const auto visit = [&](InstanceId instance) {
        if (answer.is_full(call)) return Visit::stop;
        answer.list.emplace_back(call.options().json).instance(*call.scene(), instance);
        return Visit::next;
    };
    answer.status = for_each_candidate(*call.scene(), box, visit, call.mask());
    return answer.counted_list("instances", "instance");
}

}  // namespace

QueryKinds scene_kinds() {
    constexpr QueryFamily family{scene_family};
    return {
        family.of_scenes("instance",
                         "One instance, as 3, or 3.5 for one in a tile: its mesh, its place and its numbers",
                         {name_word("instance")}, 0, instance_answer),
        family.of_scenes("candidates", "The instances whose boxes in the tree touch an axis-aligned box",
                         {point_word("min", Range::number), point_word("max", Range::number)},
                         option_limit | option_mask, candidates_answer),
    };
}

}  // namespace espalier::tools
