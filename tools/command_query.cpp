// query: one ray, sphere or point against a blob.
#include <iostream>

#include <espalier/espalier.hpp>

#include "blob_file.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "json_output.hpp"
#include "numbers.hpp"

namespace espalier::tools {

namespace {

float number_argument(const std::string& input, std::string_view name) {
    const std::optional<float> value = parse_float(input);
    if (!value) {
        throw CommandError(ExitCode::usage, text(name, ": '", printable(input), "' is no number."));
    }
    return *value;
}

Vec3 point_argument(const std::vector<std::string>& numbers, std::size_t first, std::string_view name) {
    return {number_argument(numbers[first], name), number_argument(numbers[first + 1], name),
            number_argument(numbers[first + 2], name)};
}

Json triangle_json(const Blob& blob, Triangle triangle) {
    Json result;
    result["triangle"] = triangle.index;
    if (OriginalTriangle original; original_triangle(blob, triangle, original)) {
        result["original"] = {{"file", original.file},
                              {"mesh", original.mesh},
                              {"triangle", original.triangle},
                              {"first_corner", original.first_corner}};
    }
    if (blob.has_materials()) result["material"] = material(blob, triangle);
    return result;
}

std::string triangle_text(const Blob& blob, Triangle triangle) {
    std::string result = text("triangle ", triangle.index);
    if (OriginalTriangle original; original_triangle(blob, triangle, original)) {
        result += text(" (file ", original.file, ", mesh ", original.mesh, ", triangle ", original.triangle,
                       original.first_corner == 0 ? "" : text(", from its corner ", original.first_corner), ")");
    }
    if (blob.has_materials()) result += text(", material ", material(blob, triangle));
    return result;
}

Vec3 point_at(const Ray& ray, float t) {
    const auto along = [t](float origin, float direction) {
        return static_cast<float>(static_cast<double>(origin) +
                                  static_cast<double>(t) * static_cast<double>(direction));
    };
    return {along(ray.origin.x, ray.direction.x), along(ray.origin.y, ray.direction.y),
            along(ray.origin.z, ray.direction.z)};
}

Json hit_json(const Blob& blob, const Ray& ray, const RayHit& hit) {
    Json result = triangle_json(blob, hit.triangle);
    result["t"] = json_number(hit.t);
    result["u"] = json_number(hit.u);
    result["v"] = json_number(hit.v);
    result["point"] = json_point(point_at(ray, hit.t));
    result["normal"] = json_point(hit.normal);
    return result;
}

std::string hit_text(const Blob& blob, const Ray& ray, const RayHit& hit) {
    return text("hit ", triangle_text(blob, hit.triangle), "\n  t ", hit.t, "\n  point ",
                shortest(point_at(ray, hit.t)), "\n  normal ", shortest(hit.normal), "\n  u ", hit.u, "\n  v ", hit.v);
}

Json query_document(const char* query) {
    Json document = json_document();
    document["query"] = query;
    return document;
}

void print_lines(const std::string& lines) {
    std::cout << lines << '\n';
    finish_standard_output();
}

void answer(const QueryArguments& arguments, const Json& document, const std::string& lines) {
    if (arguments.json) {
        print_json(document);
    } else {
        print_lines(lines);
    }
}

void answer_yes_or_no(const QueryArguments& arguments, const char* query, const char* key, bool yes) {
    Json document = query_document(query);
    document[key] = yes;
    answer(arguments, document, yes ? key : text("not ", key));
}

void answer_list(const QueryArguments& arguments, const char* query, const char* key, Json found, std::string lines,
                 std::size_t count) {
    Json document = query_document(query);
    document["count"] = count;
    document[key] = std::move(found);
    lines += text(count, ' ', key);
    answer(arguments, document, lines);
}

}  // namespace

ExitCode run_query_ray(const QueryArguments& arguments) {
    Ray ray;
    ray.origin = point_argument(arguments.numbers, 0, "origin");
    ray.direction = point_argument(arguments.numbers, 3, "direction");
    ray.t_min = number_argument(arguments.t_min, "--t-min");
    ray.t_max = number_argument(arguments.t_max, "--t-max");
    ray.faces = arguments.faces;
    const BlobFile file = open_blob_file(arguments.blob);
    if (arguments.any) {
        answer_yes_or_no(arguments, "ray", "occluded", occluded(file.blob, ray));
        return ExitCode::ok;
    }
    if (arguments.all) {
        Json hits = Json::array();
        std::string lines;
        std::size_t count = 0;
        for_each_hit(file.blob, ray, [&](const RayHit& hit) {
            if (arguments.json) {
                hits.push_back(hit_json(file.blob, ray, hit));
            } else {
                lines += hit_text(file.blob, ray, hit) + '\n';
            }
            ++count;
            return keep_going;
        });
        answer_list(arguments, "ray", "hits", std::move(hits), std::move(lines), count);
        return ExitCode::ok;
    }
    RayHit hit;
    const bool found = raycast(file.blob, ray, hit);
    Json document = query_document("ray");
    document["hit"] = found;
    if (found) document.update(hit_json(file.blob, ray, hit));
    answer(arguments, document, found ? hit_text(file.blob, ray, hit) : "no hit");
    return ExitCode::ok;
}

ExitCode run_query_sphere(const QueryArguments& arguments) {
    const Sphere sphere{point_argument(arguments.numbers, 0, "centre"),
                        number_argument(arguments.numbers[3], "radius")};
    const BlobFile file = open_blob_file(arguments.blob);
    if (arguments.any) {
        answer_yes_or_no(arguments, "sphere", "overlaps", overlaps(file.blob, sphere));
        return ExitCode::ok;
    }
    Json triangles = Json::array();
    std::string lines;
    std::size_t count = 0;
    for_each_overlap(file.blob, sphere, [&](Triangle triangle) {
        if (arguments.json) {
            triangles.push_back(triangle_json(file.blob, triangle));
        } else {
            lines += triangle_text(file.blob, triangle) + '\n';
        }
        ++count;
        return keep_going;
    });
    answer_list(arguments, "sphere", "triangles", std::move(triangles), std::move(lines), count);
    return ExitCode::ok;
}

ExitCode run_query_nearest(const QueryArguments& arguments) {
    const Vec3 point = point_argument(arguments.numbers, 0, "point");
    const float max_distance = number_argument(arguments.max_distance, "--max-distance");
    const BlobFile file = open_blob_file(arguments.blob);
    Nearest nearest;
    const bool found = closest_point(file.blob, point, max_distance, nearest);
    Json document = query_document("nearest");
    document["found"] = found;
    std::string lines = "nothing within that distance";
    if (found) {
        document.update(triangle_json(file.blob, nearest.triangle));
        document["distance"] = json_number(nearest.distance);
        document["point"] = json_point(nearest.point);
        document["u"] = json_number(nearest.u);
        document["v"] = json_number(nearest.v);
        lines = text("nearest ", triangle_text(file.blob, nearest.triangle), "\n  distance ", nearest.distance,
                     "\n  point ", shortest(nearest.point), "\n  u ", nearest.u, "\n  v ", nearest.v);
    }
    answer(arguments, document, lines);
    return ExitCode::ok;
}

}  // namespace espalier::tools
