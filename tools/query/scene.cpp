// What a scene holds: its instances, and which of them touch each other.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include <espalier/scenes/moving_scene.hpp>
#include <espalier/scenes/pairs.hpp>

#include <import/base/numbers.hpp>

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
    const auto name = call.next<std::string>();
    const std::size_t dot = name.find('.');
    const std::optional<std::uint32_t> index = parse_index(std::string_view(name).substr(0, dot));
    const std::optional<std::uint32_t> in_tile =
        dot == std::string::npos ? no_instance.in_tile : parse_index(std::string_view(name).substr(dot + 1));
    if (!index || !in_tile)
        throw_error(ExitCode::usage, "instance '", printable(name),
                    "': give its number, as in 3, or, for "
                    "one in a tile, both numbers, as in 3.5.");
    const InstanceId instance{*index, *in_tile};
    if (instance_at(*call.scene(), instance)) return instance;
    throw QueryRefusal{
        QueryStatus::invalid_argument,
        text("instance is ", printable(name), "; the scene has ", counted(call.scene()->instance_count(), "instance"),
             ", counted from 0",
             dot == std::string::npos ? "" : ", and this one is no tile or a tile with fewer instances")};
}

Answer instance_answer(QueryCall& call) {
    const InstanceId id = next_instance(call);
    const Instance instance = *instance_at(*call.scene(), id);
    const auto& [x, y, z, w] = instance.transform.rotation;
    Answer answer(call);
    Record& record = answer.record.instance(*call.scene(), id);
    record.add("rotation", text(shortest(x), ' ', shortest(y), ' ', shortest(z), ' ', shortest(w)));
    record.add_silently("rotation", Json::array({json_number(x), json_number(y), json_number(z), json_number(w)}));
    if (id.in_tile == no_instance.in_tile) record.add("translation", call.in_source(instance.transform.translation));
    else record.add("translation", instance.transform.translation);  // in the space of the tile
    record.add("scale", instance.transform.scale);
    record.add_count("mask", instance.mask).add_count("user", instance.user).add_count("source", instance.source);
    return answer;
}

Answer candidates_answer(QueryCall& call) {
    const auto box = call.next<Box>();
    Answer answer(call);
    const auto visit = [&](InstanceId instance) {
        if (answer.is_full(call)) return Visit::stop;
        answer.add().instance(*call.scene(), instance);
        return Visit::next;
    };
    answer.status = for_each_candidate(*call.scene(), box, visit, call.mask());
    return answer.counted_list("instances", "instance");
}

/// Returns the exponent of a step of the world: the farthest coordinate is 2^27 to 2^28 of them.
int step_exponent_for(const Box& bounds) {
    float farthest = 0.0f;
    for (const Vec3& corner : {bounds.min, bounds.max})
        for (const float coordinate : {corner.x, corner.y, corner.z})
            farthest = std::max(farthest, std::fabs(coordinate));
    int exponent = 0;
    std::frexp(farthest, &exponent);
    return std::clamp(exponent - 28, -100, 80);
}

bool has_surface(const BakedScene& scene, std::uint32_t part) {
    const std::size_t meshes = scene.meshes().size();
    return part < meshes ? scene.meshes()[part].triangle_count() != 0
                         : scene.tiles()[part - meshes].instance_count() != 0;
}

/// The instances of a baked scene that a mask selects, as instances that all meet each other.
class Instances {
public:
    Instances(const BakedScene& scene, std::uint32_t mask) {
        const std::uint32_t count = std::max(scene.instance_count(), 1u);
        block_.resize(static_cast<std::size_t>(moving_scene_bytes(count) / sizeof(Unit) + 1));
        moving_ = create_moving_scene(std::as_writable_bytes(std::span(block_)), count,
                                      step_exponent_for(scene.bounds()), scene.meshes(), scene.tiles());
        if (!moving_)
            throw_error(ExitCode::unsupported, "query pairs: the scene has ", counted(count, "instance"),
                        ", and 16777216 is the most.");
        for (std::uint32_t number = 0; number < scene.instance_count() && status_ == QueryStatus::ok; ++number) {
            Instance instance = *instance_at(scene, InstanceId{number});
            if ((instance.mask & mask) == 0 || !has_surface(scene, instance.mesh)) continue;
            instance.mask = ~0u;
            numbers_.push_back(number);  // slots are counted up
            status_ = insert(moving_, instance).status;
        }
        repack(moving_);
    }

    /// Finds the pairs that touch, all in one call, since the limit of work is that of a call.
    FilledPairs<InstancePair> collect(std::vector<InstancePair>& pairs, WorkLimit limit) {
        if (status_ != QueryStatus::ok) return {0, {}, status_};
        pairs.resize(1024);
        while (collect_candidate_pairs(moving_, pairs).status == QueryStatus::output_full)
            pairs.resize(2 * pairs.size());
        return collect_colliding_pairs(moving_, pairs, limit);
    }
    [[nodiscard]] InstanceId id_of(std::uint32_t slot) const { return {numbers_[slot]}; }

private:
    struct alignas(32) Unit {
        std::byte bytes[32];
    };
    std::vector<Unit> block_;
    MovingScene moving_;
    std::vector<std::uint32_t> numbers_;
    QueryStatus status_ = QueryStatus::ok;
};

/// The instance, and its number in the list that was baked.
Record record_of(const QueryCall& call, InstanceId id) {
    Record record(call.options().json);
    record.instance(*call.scene(), id).add_count("source", instance_at(*call.scene(), id)->source);
    return record;
}

Answer pairs_answer(QueryCall& call) {
    Instances instances(*call.scene(), call.mask());
    std::vector<InstancePair> pairs;
    const FilledPairs<InstancePair> found = instances.collect(pairs, WorkLimit(call.options().work_limit));
    Answer answer(call, found.status);
    std::uint32_t next = call.options().from;
    const std::span<InstancePair> all = found.in(pairs);
    for (const InstancePair& pair : all.subspan(std::min<std::size_t>(next, all.size()))) {
        if (call.options().limit && answer.list.size() == *call.options().limit) {
            answer.status = QueryStatus::output_full;
            break;
        }
        Record& record = answer.add().title("pair");
        record.add("a", record_of(call, instances.id_of(pair.a))).add("b", record_of(call, instances.id_of(pair.b)));
        ++next;
    }
    return answer.counted_list("pairs", "pair", &next);
}

}  // namespace

QueryKinds scene_kinds() {
    constexpr QueryFamily family{"What the scene holds; not of blobs"};
    return {
        family.of_scenes("instance",
                         "One instance, as 3, or 3.5 for one in a tile: its mesh, its place and its numbers",
                         {name_word("instance", "its number, from 0, as 3; of one in a tile both numbers, as 3.5")}, 0,
                         instance_answer),
        family.of_scenes("candidates", "The instances whose boxes in the tree touch an axis-aligned box",
                         {point_word("min", Range::number), point_word("max", Range::number)},
                         option_limit | option_mask, candidates_answer),
        family.of_scenes("pairs", "The pairs of instances whose surfaces touch; a tile is one instance", {},
                         option_limit | option_from | option_mask | option_work_limit, pairs_answer),
    };
}

}  // namespace espalier::tools
