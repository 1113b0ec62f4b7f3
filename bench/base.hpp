// What most benchmarks begin with: the words of the standard library and of Espalier, rays and poses with fixed seeds,
// so that every system answers the same questions, clocks, and rows of JSON.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>
#include <espalier/advanced/statistics.hpp>
#include <runtime/lanes/select.hpp>

#include "../tests/support/base/random.hpp"
#include "../tests/support/meshes/files.hpp"
#include "../tests/support/meshes/makers.hpp"

namespace espalier::bench {

using tests::Mesh;

inline constexpr std::uint64_t seed = 2026;
inline constexpr WorkLimit unlimited = WorkLimit::unlimited();

/// An axis-aligned box.
struct Aabb {
    std::array<float, 3> low, high;

    /// Returns one that is empty.
    static Aabb none();
    void add(const Vec3& point);
    void add(const Aabb& box);
    [[nodiscard]] bool contains(const Vec3& point, float rounding) const;
    [[nodiscard]] double half_area() const;
};

struct BoundingSphere {
    Vec3 center;
    float radius = 0.0f;
};
/// Around the box of all vertices that a triangle names.
BoundingSphere bounding_sphere(const Mesh& mesh);

/// Scales the mesh by a power of two, which is exact, so that the largest side of its box is at least 128 and below
/// 256, and answers with the factor. Bullet pads boxes by a whole unit and other engines have absolute thresholds too:
/// at the size of a room they are measured at their best. The others do not care.
double bring_to_common_size(Mesh& mesh);

/// Returns the box of all positions.
Box box_around(std::span<const Vec3> positions);

/// A blob and the bytes that it points into.
struct BakedBlob {
    BakeResult baked;
    Blob blob;
};
/// Opens what was baked. Throws std::runtime_error with the mesh's name.
inline BakedBlob opened(const std::string& mesh, BakeResult baked) {
    if (!baked) throw std::runtime_error(mesh + ": " + baked.message);
    BakedBlob made{std::move(baked), {}};
    made.blob = open(made.baked.bytes);
    if (!made.blob) throw std::runtime_error(mesh + ": the blob does not open: " + describe(made.blob.status()));
    return made;
}
inline BakedBlob bake_blob(const Mesh& mesh, const BakeOptions& options = {}) {
    return opened(mesh.name, bake(std::array{mesh.view()}, options));
}
inline BakedBlob bake_blob(const Mesh& mesh, Profile profile) {
    return bake_blob(mesh, BakeOptions{.profile = profile});
}

/// Returns how many pairs of triangles touch, of a mesh and the same mesh in a pose. Throws std::runtime_error if the
/// query is refused.
inline std::uint64_t count_contacts(const Blob& blob, const Transform& pose) {
    std::uint64_t count = 0;
    const QueryStatus status = for_each_contact(
        blob, {blob, pose}, [&](const PairContact&) { ++count; }, unlimited);
    if (is_refused(status)) throw std::runtime_error(std::string("a pose is refused: ") + describe(status));
    return count;
}

/// Returns the largest magnitude of a coordinate.
inline float largest_coordinate(std::span<const Vec3> positions) {
    float largest = 0.0f;
    for (const Vec3& p : positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return largest;
}

/// 512 x 512 pinhole views from three sides, row by row. Rays have length 1 and no end.
std::vector<Ray> coherent_rays(const Mesh& mesh);

/// From a sphere of 1.2 radii around the mesh towards random points in its box. Rays have length 1 and no end.
/// The any-hit queries ask these too: a ray starts outside of the mesh and ends nowhere, so that most of them hit. It
/// is not the short ray from a surface to a light.
std::vector<Ray> incoherent_rays(const Mesh& mesh, std::size_t count, std::uint64_t number);

/// Where a second mesh stands, again and again.
///
/// Rotations are uniform; translations lead in a uniform direction, 0.6 to 1.4 times the length with which 45 to 65 of
/// 100 poses collide, about the middle of the mesh. That length is searched with `collides`.
std::vector<Transform> some_poses(const Mesh& mesh, std::size_t count, std::uint64_t number,
                                  const std::function<bool(const Transform&)>& collides);

/// Row by row.
struct Matrix {
    double at[3][3];
};
Matrix rotation_matrix(const Transform& pose);

inline std::string decimal(double value, int digits) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

/// Of so many digits, for numbers of any size.
inline std::string digits_of(double value, int digits) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

/// Returns an array of JSON; the items are JSON already.
inline std::string json_list(const std::vector<std::string>& items) {
    std::string list;
    for (const std::string& item : items) list += (list.empty() ? "" : ",") + item;
    return '[' + list + ']';
}

/// A row of a file of JSON objects, one object a line. Fields appear in the order in which they were added.
class JsonObject {
public:
    void add(const std::string& name, const std::string& text) {
        std::string quoted = "\"";
        for (const char c : text) {
            if (c == '"' || c == '\\') quoted += '\\';
            if (static_cast<unsigned char>(c) >= 0x20) quoted += c;
        }
        add_raw(name, quoted + "\"");
    }
    void add(const std::string& name, std::size_t value) { add_raw(name, std::to_string(value)); }
    void add(const std::string& name, std::optional<std::size_t> value) {
        add_raw(name, value ? std::to_string(*value) : "null");
    }
    void add(const std::string& name, std::same_as<bool> auto value) { add_raw(name, value ? "true" : "false"); }
    void add(const std::string& name, std::optional<double> value, int digits) {
        add_raw(name, value ? decimal(*value, digits) : "null");
    }
    /// `value` is JSON already.
    void add_raw(const std::string& name, const std::string& value) {
        if (!fields_.empty()) fields_ += ',';
        fields_ += '"' + name + "\":" + value;
    }
    [[nodiscard]] std::string text() const { return '{' + fields_ + '}'; }
    void print() const { std::printf("%s\n", text().c_str()); }

private:
    std::string fields_;
};

/// The name that the kernel gives; Linux only, elsewhere empty.
std::string processor();

/// Of this program.
const char* compiler();

/// Returns the date, in UTC.
std::string today();

/// Returns the mean of so many.
inline double per(std::uint64_t sum, std::size_t count) {
    return static_cast<double>(sum) / static_cast<double>(count);
}

/// The name of the instruction set with which the library's queries run here.
inline const char* instruction_set_name() {
    constexpr const char* names[] = {"scalar", "sse4.2", "avx2", "avx512", "neon", "simd128"};
    return names[static_cast<std::size_t>(detail::instruction_set())];
}

/// Adds where and when the row was measured.
inline void add_machine(JsonObject& row) {
    row.add("processor", processor());
    row.add("instruction_set", instruction_set_name());
    row.add("compiler", compiler());
    row.add("date", today());
}

/// Returns a row of measurements for docs/guide, with the fields that all of them have. `measures` names the kind of
/// row; `mesh` is the name of a mesh's file, or of a made mesh.
inline JsonObject guide_row(const std::string& measures, const std::string& mesh, std::size_t triangles) {
    JsonObject row;
    row.add("measures", measures);
    row.add("mesh", mesh);
    row.add("triangles", triangles);
    add_machine(row);
    return row;
}

inline double seconds_of(clockid_t clock) {
    std::timespec time{};
    if (clock_gettime(clock, &time) != 0) throw std::runtime_error("this system has no clock of processor time");
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The processor time of this process: work of others beside it counts less than in elapsed time, and every thread that
/// a peer may start counts.
class ProcessorTime {
public:
    [[nodiscard]] double seconds() const { return seconds_of(CLOCK_PROCESS_CPUTIME_ID) - start_; }

private:
    double start_ = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
};

/// The processor time of this thread. It takes up to a microsecond, which parts of a step are too short for.
inline double thread_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

class Stopwatch {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The upper one of the two in the middle.
inline double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Adds a field `name` with the median, and one `name`_spread with the least and the greatest.
inline void add_spread(JsonObject& row, const std::string& name, const std::vector<double>& values, int digits) {
    row.add(name, median_of(values), digits);
    const auto [least, greatest] = std::ranges::minmax(values);
    row.add_raw(name + "_spread", json_list({decimal(least, digits), decimal(greatest, digits)}));
}

}  // namespace espalier::bench
