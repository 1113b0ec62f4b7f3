#include <baker/c/options.hpp>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <baker/base/number_text.hpp>
#include <baker/c/arrays.hpp>
#include <baker/c/structure.hpp>

namespace espalier::baker {

namespace {

static_assert(static_cast<std::uint8_t>(Profile::tiny) == ESPALIER_PROFILE_TINY &&
              static_cast<std::uint8_t>(Effort::best) == ESPALIER_EFFORT_BEST &&
              static_cast<std::uint8_t>(Builder::insertion) == ESPALIER_BUILDER_INSERTION);

Failure invalid(std::string message) { return {ESPALIER_BAKE_INVALID_OPTIONS, std::move(message)}; }

/// Returns nothing if the number is whole and fits into an int. bake() checks its range.
std::optional<Failure> check_whole(const char* name, double value) {
    constexpr double most = 1e6;
    if (std::abs(value) <= most && value == std::trunc(value)) return std::nullopt;
    return invalid(std::string(name) + " is " + number_text(value) + "; choose a whole number");
}

std::optional<Failure> read_resolution(const espalier_bake_options& options, Resolution& resolution) {
    switch (options.resolution_kind) {
        case ESPALIER_RESOLUTION_BITS:
            if (auto failure = check_whole("resolution, in bits,", options.resolution)) return failure;
            resolution = Resolution::bits(options.resolution < 0.0 ? 0u : static_cast<unsigned>(options.resolution));
            return std::nullopt;
        case ESPALIER_RESOLUTION_TOLERANCE:
            resolution = Resolution::tolerance(options.resolution);
            return std::nullopt;
        case ESPALIER_RESOLUTION_STEP:
            if (auto failure = check_whole("resolution, the exponent of a step,", options.resolution)) return failure;
            resolution = Resolution::step(static_cast<int>(options.resolution));
            return std::nullopt;
        default:
            return invalid("resolution_kind " + std::to_string(options.resolution_kind) +
                           " does not exist; choose ESPALIER_RESOLUTION_BITS, _TOLERANCE or _STEP");
    }
}

std::optional<Failure> read_deformation(const espalier_bake_options& options, std::size_t positions,
                                        std::optional<Deformation>& deformation) {
    if (options.deformable == 0) return std::nullopt;
    deformation.emplace();
    const espalier_box& range = options.range;
    if (options.has_range != 0)
        deformation->range = Box{{range.min.x, range.min.y, range.min.z}, {range.max.x, range.max.y, range.max.z}};
    if (options.pose_count == 0) return std::nullopt;
    if (options.poses == nullptr)
        return Failure{ESPALIER_BAKE_INVALID_ARGUMENT, "poses is null, but pose_count is " +
                                                           std::to_string(options.pose_count) +
                                                           "; give the positions of each pose in a row"};
    constexpr auto most_bytes = static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max());
    const std::size_t pose_bytes = positions * sizeof(Vec3);
    if (pose_bytes == 0) return std::nullopt;  // bake() refuses a deformable blob without triangles
    if (options.pose_count > most_bytes / pose_bytes)
        return Failure{ESPALIER_BAKE_INVALID_ARGUMENT,
                       "pose_count is " + std::to_string(options.pose_count) + ", more than any memory holds"};
    const char* const first = static_cast<const char*>(options.poses);
    for (std::size_t i = 0; i < options.pose_count; ++i)
        deformation->poses.push_back(copy_vectors(first + i * pose_bytes, positions));
    return std::nullopt;
}

}  // namespace

espalier_bake_options default_options() {
    const BakeOptions defaults;
    espalier_bake_options options = {};
    options.resolution = defaults.resolution.value();
    options.resolution_kind = ESPALIER_RESOLUTION_BITS;
    options.profile = static_cast<espalier_profile>(defaults.profile);
    options.effort = static_cast<espalier_effort>(defaults.effort);
    options.builder = static_cast<espalier_builder>(defaults.build.builder);
    options.flat_angle = -1.0;
    options.max_dropped = BakePolicy().max_dropped;
    options.duplicate_budget = defaults.build.duplicate_budget;
    options.byte_price = defaults.build.byte_price;
    options.max_leaf_triangles = defaults.build.max_leaf_triangles;
    options.threads = defaults.threads;
    return options;
}

std::optional<Failure> read_options(const void* given, espalier_bake_options& options) {
    options = default_options();
    if (given == nullptr) return std::nullopt;
    constexpr std::size_t first_size =
        offsetof(espalier_bake_options, progress_user) + sizeof(espalier_bake_options::progress_user);
    if (auto complaint = read_structure(given, first_size, "the structure of options", options))
        return Failure{ESPALIER_BAKE_INVALID_ARGUMENT, std::move(*complaint)};
    if ((options.allocate == nullptr) != (options.release == nullptr))
        return Failure{ESPALIER_BAKE_INVALID_ARGUMENT,
                       "one of allocate and release is null; give both of them, or neither for malloc() and free()"};
    return std::nullopt;
}

ResultMemory memory_of(const espalier_bake_options& options) {
    if (options.allocate == nullptr || options.release == nullptr) return default_memory;
    return {options.allocate, options.release, options.memory_user};
}

std::optional<Failure> translate(const espalier_bake_options& options, std::size_t positions, BakeOptions& translated) {
    if (auto failure = read_resolution(options, translated.resolution)) return failure;
    translated.profile = Profile{options.profile};
    translated.effort = Effort{options.effort};
    translated.build.builder = Builder{options.builder};
    translated.original_ids = options.original_ids != 0;
    translated.drop_bad_triangles = options.drop_bad_triangles != 0;
    translated.policy = BakePolicy{options.max_dropped, options.allow_empty != 0, options.strict != 0};
    if (options.chooses_origin != 0) translated.origin.reset();
    else translated.origin = Vec3d{options.origin.x, options.origin.y, options.origin.z};
    if (!(options.flat_angle < 0.0)) translated.flat_angle = options.flat_angle;  // NaN too, which bake() refuses
    translated.bounds = {options.oriented_box != 0, options.sphere != 0, options.k_dop != 0};
    translated.build.duplicate_budget = options.duplicate_budget;
    translated.build.byte_price = options.byte_price;
    translated.build.max_leaf_triangles = options.max_leaf_triangles;
    translated.threads = options.threads;
    if (options.progress != nullptr)
        translated.progress = [progress = options.progress, user = options.progress_user](const char* stage,
                                                                                          double done) {
            if (progress(stage, done, user) != ESPALIER_VISIT_NEXT) throw StoppedByProgress();
        };
    return read_deformation(options, positions, translated.deformation);
}

}  // namespace espalier::baker
