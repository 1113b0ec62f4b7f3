#include "baking.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "base/choices.hpp"
#include "base/positions.hpp"
#include "base/vectors.hpp"
#include "files/blob_file.hpp"
#include "policy.hpp"

namespace espalier::tools {

namespace {

std::optional<int> exponent_in(const char* begin, const char* end) {
    int number = 0;
    const auto [stopped, error] = std::from_chars(begin, end, number);
    if (error != std::errc() || stopped != end) return std::nullopt;
    return number;
}

std::optional<int> step_exponent(const std::string& input) {
    if (input.starts_with("2^")) return exponent_in(input.data() + 2, input.data() + input.size());
    const std::optional<double> step = parse_double(input);
    if (!step || !std::isfinite(*step) || *step <= 0.0) return std::nullopt;
    int exponent = 0;
    if (std::frexp(*step, &exponent) != 0.5) return std::nullopt;
    return exponent - 1;
}

/// Returns nothing for auto, with which the baker chooses.
std::optional<Vec3d> parse_origin(const std::string& input) {
    if (input == "auto") return std::nullopt;
    if (input == "none") return Vec3d{};
    std::array<double, 3> coordinates{};
    std::size_t begin = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t end = input.find(',', begin);
        if ((end == std::string::npos) != (axis == 2)) {
            throw_error(ExitCode::usage, "--origin: '", printable(input),
                        "' is none of auto, none and X,Y,Z. Write three lengths with commas between, such as "
                        "500000,5400000,0.");
        }
        coordinates[axis] = parse_length(input.substr(begin, end - begin), "--origin");
        begin = end + 1;
    }
    return Vec3d{coordinates[0], coordinates[1], coordinates[2]};
}

/// Of six words, the low corner and the high one, in the source.
Box parse_range(const std::vector<std::string>& words, const Vec3d& origin) {
    std::array<double, 6> numbers{};
    std::transform(words.begin(), words.end(), numbers.begin(),
                   [](const std::string& word) { return parse_length(word, "--range"); });
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (numbers[axis] <= numbers[axis + 3]) continue;
        throw_error(ExitCode::usage, "--range: it goes from ", numbers[axis], " to ", numbers[axis + 3], " on ",
                    "xyz"[axis], ". Give the low corner of the box, then the high one: X0 Y0 Z0 X1 Y1 Z1.");
    }
    const Vec3d low = {numbers[0], numbers[1], numbers[2]}, high = {numbers[3], numbers[4], numbers[5]};
    const Box range = {to_float32(low - origin), to_float32(high - origin)};
    if (is_finite(range.min) && is_finite(range.max)) return range;
    throw_error(ExitCode::usage,
                "--range: ", listed(words, " ", [](const auto& word) { return text('\'', printable(word), '\''); }),
                " is beyond the numbers that a blob has, which end at 3.4e38.");
}

void require_as_many(const ImportResult& meshes, std::size_t expected, const ImportResult& pose, std::size_t found) {
    if (found == expected) return;
    throw CommandError(
        ExitCode::invalid_input,
        text("the pose ", names_of_inputs(pose), " has ", counted(found, "vertex"), ", and the mesh ",
             names_of_inputs(meshes), " has ", expected, ". A pose has all vertices of the mesh, in the same order."),
        {.file = only_input(pose)});
}

int parse_step_exponent(const std::string& input, const char* option) {
    const std::optional<int> exponent = step_exponent(input);
    if (exponent) return *exponent;
    throw_error(ExitCode::usage, option, ": '", printable(input),
                "' is no power of two. Write a step such as 2^-14, or 0.25, in units of "
                "the blob.");
}

/// Throws CommandError (invalid_input) for a blob without triangles.
Lattice lattice_of_blob(const std::string& path) {
    const AssetFile file = open_blob_file(path);
    if (file.blob.triangle_count() != 0) return file.blob.lattice();
    throw_error(ExitCode::invalid_input, '\'', printable(path),
                "' is a blob without triangles, which has no lattice: choose "
                "another blob, or write the step with --step.");
}

Deformation deformation_of(const BakeArguments& arguments, const Vec3d& origin) {
    Deformation deformation;
    if (!arguments.range.empty()) deformation.range = parse_range(arguments.range, origin);
    return deformation;
}

/// Above zero, in units of the blob.
double error_bound(const std::string& length, const char* option) {
    const double bound = parse_length(length, option);
    if (bound <= 0.0) {
        throw_error(ExitCode::usage, option, ' ', printable(length), ": it must be above zero.");
    }
    return bound;
}

/// The options of the command line exclude each other.
Resolution resolution(const BakeArguments& arguments) {
    if (!arguments.tolerance.empty()) return Resolution::tolerance(error_bound(arguments.tolerance, "--tolerance"));
    if (arguments.max_error) return Resolution::tolerance(error_bound(*arguments.max_error, "--max-error"));
    if (!arguments.step.empty()) return Resolution::step(parse_step_exponent(arguments.step, "--step"));
    if (!arguments.lattice_of.empty()) return Resolution::same_as(lattice_of_blob(arguments.lattice_of));
    return Resolution::bits(arguments.bits);
}

BuildOptions build_options(const BakeArguments& arguments) {
    BuildOptions build;
    if (arguments.leaf_size) build.max_leaf_triangles = *arguments.leaf_size;
    if (arguments.byte_price) build.byte_price = *arguments.byte_price;
    if (arguments.builder) build.builder = *arguments.builder;
    if (arguments.duplicate_budget) {
        if (build.builder != Builder::spatial_splits) {
            throw_error(ExitCode::usage,
                        "--duplicate-budget needs --builder spatial_splits: the other builders store each "
                        "triangle once.");
        }
        build.duplicate_budget = *arguments.duplicate_budget;
    }
    return build;
}

}  // namespace

void refuse_options_of_rigid_blobs(const BakeArguments& arguments) {
    if (!arguments.deformable) return;
    const auto refuse_if = [](bool is_given, const std::string& option, const char* reason) {
        if (is_given) throw_error(ExitCode::usage, "--deformable excludes ", option, ": ", reason);
    };
    if (arguments.profile)
        refuse_if(*arguments.profile != Profile::fast, "--profile " + name_in(profile_choices, *arguments.profile),
                  "the leaves of a deformable blob keep their size, which those of profile fast alone do. Leave "
                  "--profile out.");
    refuse_if(arguments.builder == Builder::spatial_splits, "--builder spatial_splits",
              "it clips triangles as they are in one pose. Choose another builder.");
    refuse_if(arguments.drop_bad_triangles, "--drop-bad-triangles",
              "a deformable blob needs the positions of all vertices. Mend the mesh.");
    refuse_if(arguments.flat_angle.has_value(), "--flat-angle",
              "edge flags describe one pose, and a deformable blob has many. Use the normals of triangles.");
    refuse_if(!arguments.bounds.empty(), "--bounds",
              "stored bounds describe one pose, and a deformable blob has many. Leave them out.");
    refuse_if(arguments.instancing != Instancing::off, "--instances",
              "the meshes of a scene are rigid. Bake the blob alone; a moving scene takes it as an instance.");
}

void refuse_options_of_blobs(const BakeArguments& arguments) {
    if (arguments.instancing == Instancing::off) return;
    const std::pair<const char*, bool> given[] = {{"--remap", !arguments.remap.empty()},
                                                  {"--reorder", !arguments.reorder.empty()},
                                                  {"--max-bytes", arguments.max_bytes.has_value()},
                                                  {"--fastest-under", arguments.fastest_under.has_value()},
                                                  {"--max-error", arguments.max_error.has_value()}};
    for (const auto& [option, is_given] : given) {
        if (!is_given) continue;
        throw_error(ExitCode::usage, option, " is for one blob, and --instances makes a scene of several. ",
                    "Leave one of them out.");
    }
}

BakeOptions bake_options(const BakeArguments& arguments) {
    BakeOptions options;
    options.resolution = resolution(arguments);
    options.origin = parse_origin(arguments.origin);
    // The poses of a deformable blob count from one that their user states.
    if (!options.origin && arguments.deformable) options.origin = Vec3d{};
    if (arguments.profile) options.profile = *arguments.profile;
    if (arguments.deformable) {
        options.profile = Profile::fast;
        options.deformation = deformation_of(arguments, options.origin.value_or(Vec3d{}));
    }
    options.original_ids = arguments.original_ids;
    options.flat_angle = arguments.flat_angle;
    for (const std::string& name : arguments.bounds) {
        options.bounds.oriented_box |= name == "obb";
        options.bounds.sphere |= name == "sphere";
        options.bounds.k_dop |= name == "kdop";
    }
    options.drop_bad_triangles = arguments.drop_bad_triangles;
    options.effort = arguments.effort;
    options.threads = arguments.threads;
    options.build = build_options(arguments);
    return options;
}

Poses import_poses(const BakeArguments& arguments, const ImportOptions& options, const ImportResult& meshes,
                   const Vec3d& origin) {
    Poses poses;
    const std::size_t expected = positions_in_a_row(meshes, origin).size();
    ImportOptions of_poses = options;
    of_poses.require_vertices = false;  // their faces do not count
    for (const std::string& path : arguments.poses) {
        ImportResult pose = import_with_progress({&path, 1}, of_poses, arguments.quiet);
        std::vector<Vec3> positions = positions_in_a_row(pose, origin);
        require_as_many(meshes, expected, pose, positions.size());
        if (const std::optional<std::size_t> wrong = first_not_finite(positions))
            refuse_position(pose, *wrong,
                            text("has ", words_for_not_finite(positions[*wrong]), ". Mend the pose, or leave it out."));
        poses.files.push_back(std::move(pose.files.front()));
        poses.positions.push_back(std::move(positions));
    }
    return poses;
}

}  // namespace espalier::tools
