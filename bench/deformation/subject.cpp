#include "subject.hpp"

#include <numbers>

namespace espalier::bench {
namespace {

constexpr double right_angle = 0.5 * std::numbers::pi;
constexpr double wave_height = 0.1;  // of the longest side
constexpr double noise_share = 0.02;
constexpr double turn_angle = std::numbers::pi / 3.0;

std::array<double, 3> numbers_of(const Vec3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
Vec3 vector_of(const std::array<double, 3>& numbers) {
    return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2])};
}

/// Turns a point of a plane about its origin.
void turn(double& x, double& y, double angle) {
    const double turned = std::cos(angle) * x - std::sin(angle) * y;
    y = std::sin(angle) * x + std::cos(angle) * y;
    x = turned;
}

}  // namespace

const char* name_of(Motion motion) {
    constexpr const char* names[] = {"bend", "twist", "wave", "fold", "collapse", "noise", "turn"};
    return names[static_cast<std::size_t>(motion)];
}

MovingMesh::MovingMesh(Mesh mesh) : mesh_(std::move(mesh)) {
    const Box box = box_around(mesh_.positions);
    const Along low = numbers_of(box.min), high = numbers_of(box.max);
    std::iota(axes_.begin(), axes_.end(), std::size_t{0});
    std::stable_sort(axes_.begin(), axes_.end(),
                     [&](std::size_t a, std::size_t b) { return high[a] - low[a] > high[b] - low[b]; });
    for (std::size_t k = 0; k < 3; ++k) {
        middle_[k] = 0.5 * (low[axes_[k]] + high[axes_[k]]);
        side_[k] = high[axes_[k]] - low[axes_[k]];
    }
}

MovingMesh::Along MovingMesh::noise_of(std::size_t index) const {
    tests::Random random(seed + index);
    Along noise;
    for (double& along : noise) along = noise_share * side_[0] * static_cast<double>(random.signed_unit());
    return noise;
}

MovingMesh::Along MovingMesh::moved(Motion motion, double time, const Along& along, std::size_t index) const {
    Along to = along;
    const double length = side_[0], angle = time * right_angle;
    switch (motion) {
        case Motion::bend: {
            if (angle == 0.0) break;
            const double radius = length / angle, at = angle * along[0] / length;
            to[0] = (radius - along[2]) * std::sin(at);
            to[2] = radius - (radius - along[2]) * std::cos(at);
            break;
        }
        case Motion::twist:
            turn(to[1], to[2], angle * along[0] / length);
            break;
        case Motion::wave:
            to[2] += wave_height * length * time * std::sin(4.0 * std::numbers::pi * (along[0] / length - time));
            break;
        case Motion::fold:
            if (along[0] > 0.0) turn(to[0], to[2], 2.0 * angle);
            break;
        case Motion::collapse:
            to[side_[2] > 0.0 ? 2 : 1] *= 1.0 - time;
            break;
        case Motion::noise: {
            const Along noise = noise_of(index);
            for (std::size_t k = 0; k < 3; ++k) to[k] += time * noise[k];
            break;
        }
        case Motion::turn:
            break;  // positions() applies the transform
    }
    return to;
}

std::vector<Vec3> MovingMesh::positions(Motion motion, double time) const {
    std::vector<Vec3> result;
    result.reserve(mesh_.positions.size());
    const Transform transform = turned(time);
    for (const Vec3& rest : mesh_.positions) {
        if (motion == Motion::turn) {
            result.push_back(to_world(transform, rest));
            continue;
        }
        const Along at = numbers_of(rest);
        Along along;
        for (std::size_t k = 0; k < 3; ++k) along[k] = at[axes_[k]] - middle_[k];
        along = moved(motion, time, along, result.size());
        Along to;
        for (std::size_t k = 0; k < 3; ++k) to[axes_[k]] = middle_[k] + along[k];
        result.push_back(vector_of(to));
    }
    return result;
}

Mesh MovingMesh::posed(Motion motion, double time) const {
    Mesh mesh = mesh_;
    mesh.positions = positions(motion, time);
    return mesh;
}

Transform MovingMesh::turned(double time) const {
    const double half = 0.5 * turn_angle * time;
    const auto part = static_cast<float>(std::sin(half) / std::sqrt(3.0));
    Transform transform;
    transform.rotation = {part, part, part, static_cast<float>(std::cos(half))};
    Along middle;
    for (std::size_t k = 0; k < 3; ++k) middle[axes_[k]] = middle_[k];
    const Vec3 center = vector_of(middle), moved = direction_to_world(transform, center);
    transform.translation = {center.x - moved.x, center.y - moved.y, center.z - moved.z};
    return transform;
}

std::vector<TimedPose> poses_of(const MovingMesh& mesh, std::size_t times) {
    std::vector<TimedPose> poses;
    for (std::size_t i = 1; i <= times; ++i)
        for (const Motion motion : deforming) {
            const double time = static_cast<double>(i) / static_cast<double>(times);
            poses.push_back({motion, time, mesh.positions(motion, time)});
        }
    return poses;
}

Box range_of(const MovingMesh& mesh, std::span<const TimedPose> poses) {
    std::vector<Vec3> all = mesh.rest().positions;
    const auto add = [&](const std::vector<Vec3>& positions) {
        all.insert(all.end(), positions.begin(), positions.end());
    };
    for (const TimedPose& pose : poses) add(pose.positions);
    add(mesh.positions(Motion::turn, 1.0));
    return box_around(all);
}

Mesh make_cloth(std::size_t side) {
    Mesh mesh = tests::make_plane_grid(static_cast<unsigned>(side));
    mesh.name = "cloth";
    return mesh;
}

namespace {

std::size_t load_u32(std::span<const std::byte> bytes, std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::size_t>(bytes[at + i]) << (8 * i);
    return value;
}

RefitWork work_of(const BakeResult& baked) {
    RefitWork work;
    work.nodes = baked.report.tree.nodes;
    work.leaves = baked.report.tree.leaves;
    work.leaf_vertices = load_u32(baked.bytes, format::header::vertex_slots_at);
    work.moving_bytes = baked.report.motion.moving_bytes;
    work.source_bytes = work.leaf_vertices * format::vertex_sources::number_bits(baked.report.motion.positions) / 8;
    work.still_bytes = baked.bytes.size() - work.moving_bytes - work.source_bytes;
    work.step = baked.report.lattice.step;
    return work;
}

}  // namespace

DeformableMesh::DeformableMesh(const Mesh& mesh, const DeformableOptions& options) {
    const BakeOptions bake_options = {.resolution = Resolution::bits(options.bits),
                                      .profile = Profile::fast,
                                      .effort = options.effort,
                                      .deformation = Deformation{options.range, options.poses},
                                      .build = {.max_leaf_triangles = options.max_leaf_triangles}};
    const ProcessorTime time;
    BakeResult baked = bake(std::array{mesh.view()}, bake_options);
    bake_seconds_ = time.seconds();
    if (!baked) throw std::runtime_error(mesh.name + ": " + baked.message);
    work_ = work_of(baked);
    bytes_ = std::move(baked.bytes);
    memory_.resize(work_.moving_bytes);
    deformable_ = create_deformable(open(bytes_), memory_);
    if (!deformable_) throw std::runtime_error(mesh.name + ": " + describe(deformable_.status()));
}

float DeformableMesh::move(std::span<const Vec3> positions) {
    const RefitResult result = refit(positions);
    if (!result)
        throw std::runtime_error("position " + std::to_string(result.position) + ": " + describe(result.status));
    return result.quality;
}

namespace {

Mesh at_common_size(Mesh mesh) {
    bring_to_common_size(mesh);
    return mesh;
}

}  // namespace

MotionSubject::MotionSubject(Mesh mesh, const DeformationOptions& options)
    : options_(options),
      moving_(at_common_size(std::move(mesh))),
      poses_(poses_of(moving_, options.times)),
      range_(range_of(moving_, poses_)) {}

JsonObject MotionSubject::row(const std::string& measures) const {
    JsonObject row;
    row.add("measures", measures);
    row.add("mesh", rest().name);
    row.add("triangles", rest().triangles.size());
    row.add("positions", rest().positions.size());
    row.add("bits", std::size_t{options_.bits});
    row.add("rounds", options_.rounds);
    row.add("espalier", ESPALIER_BENCH_VERSION);
    add_machine(row);
    return row;
}

}  // namespace espalier::bench
