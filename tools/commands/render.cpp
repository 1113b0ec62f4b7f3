// render: a picture of a blob or a scene, by casting rays at it.
#include <algorithm>
#include <charconv>
#include <numeric>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/advanced/statistics.hpp>

#include <import/base/numbers.hpp>

#include "commands.hpp"
#include "files/blob_file.hpp"
#include "files/outputs.hpp"
#include "render/shading.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"

namespace espalier::tools {

namespace {

constexpr unsigned largest_side = 16384;

struct PictureSize {
    unsigned width;
    unsigned height;
};

PictureSize picture_size(const std::string& input) {
    PictureSize size{};
    const char* end = input.data() + input.size();
    const auto width = std::from_chars(input.data(), end, size.width);
    const bool times = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
    const auto height = times ? std::from_chars(width.ptr + 1, end, size.height) : width;
    const auto sound = [](unsigned side) { return side >= 1 && side <= largest_side; };
    if (!times || height.ec != std::errc{} || height.ptr != end || !sound(size.width) || !sound(size.height)) {
        throw_error(ExitCode::usage, "--size '", printable(input),
                    "': write width and height such as 1280x720, each from 1 to ", largest_side, '.');
    }
    return size;
}

/// Rays through a pixel on a regular grid; `visit` gets each with where it goes through the picture.
template <class Visitor>
void for_each_sample(const Camera& camera, unsigned column, unsigned row, unsigned samples, const Visitor& visit) {
    const auto within = [samples](unsigned pixel, unsigned sample) {
        return static_cast<float>(pixel) + (static_cast<float>(sample) + 0.5f) / static_cast<float>(samples);
    };
    for (unsigned y = 0; y < samples; ++y) {
        for (unsigned x = 0; x < samples; ++x) visit(camera.ray(within(column, x), within(row, y)), within(row, y));
    }
}

Vec3 unit_vector(Axis axis) {
    return {axis == Axis::x ? 1.0f : 0.0f, axis == Axis::y ? 1.0f : 0.0f, axis == Axis::z ? 1.0f : 0.0f};
}

void draw_shaded(const Subject& subject, const Camera& camera, const RenderArguments& arguments, Image& image,
                 Progress& progress) {
    const Shading shading(subject, camera.view(), unit_vector(arguments.up));
    const float weight = 1.0f / static_cast<float>(arguments.samples * arguments.samples);
    const auto draw_row = [&](unsigned row) {
        for (unsigned column = 0; column < image.width(); ++column) {
            Colour sum;
            for_each_sample(camera, column, row, arguments.samples, [&](const Ray& ray, float at) {
                sum = sum + shading.colour(ray, 1.0f - at / static_cast<float>(image.height()));
            });
            image.set(column, row, weight * sum);
        }
    };
    for_each_row(image.height(), arguments.threads, draw_row, [&](double done) { progress.show("rays", done); });
}

/// Nodes and triangles that the rays of each pixel visited, on average over the pixel's rays.
struct Work {
    double mean = 0.0;
    double most = 0.0;
    double white = 0.0;  ///< what the brightest colour stands for: few pixels lie above it
};

Work draw_heatmap(const Blob& blob, const Camera& camera, const RenderArguments& arguments, Image& image,
                  Progress& progress) {
    std::vector<double> steps(std::size_t{image.width()} * image.height());
    const double weight = 1.0 / static_cast<double>(arguments.samples * arguments.samples);
    const auto count_row = [&](unsigned row) {
        for (unsigned column = 0; column < image.width(); ++column) {
            std::uint64_t sum = 0;
            for_each_sample(camera, column, row, arguments.samples, [&](const Ray& ray, float) {
                QueryCounters counters;
                static_cast<void>(raycast(blob, ray, counters));
                sum += counters.nodes + counters.triangles;
            });
            steps[std::size_t{row} * image.width() + column] = weight * static_cast<double>(sum);
        }
    };
    for_each_row(image.height(), arguments.threads, count_row, [&](double done) { progress.show("rays", done); });

    std::vector<double> sorted = steps;
    std::sort(sorted.begin(), sorted.end());
    Work work;
    work.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
    work.most = sorted.back();
    work.white = std::max(1.0, sorted[(sorted.size() - 1) / 1000 * 999]);
    for (unsigned row = 0; row < image.height(); ++row) {
        for (unsigned column = 0; column < image.width(); ++column) {
            const double heat = steps[std::size_t{row} * image.width() + column] / work.white;
            image.set(column, row, heat_colour(static_cast<float>(heat)));
        }
    }
    return work;
}

}  // namespace

ExitCode run_render(const RenderArguments& arguments, std::vector<Warning>& warnings) {
    const Console console(arguments.quiet);
    const PictureSize size = picture_size(arguments.size);
    const NamedOutput outputs[] = {{"-o", arguments.output}};
    refuse_to_overwrite_input(outputs, arguments.blob);
    if (arguments.json) refuse_standard_output(outputs);
    require_ending(outputs[0], ".png", "the picture is a PNG");
    require_writable(outputs);
    const AssetFile file(arguments.blob);
    if (arguments.heatmap && file.is_a_scene) {
        throw CommandError(ExitCode::unsupported,
                           text("--heatmap: '", printable(arguments.blob),
                                "' is a scene, and steps are counted in blobs only. Leave --heatmap out."),
                           {.file = arguments.blob});
    }
    file.require_open();
    static_cast<void>(Image(1, 1).png());  // which a build without libpng refuses
    const Subject subject(file);
    const Camera camera(subject, view_from(arguments.up, arguments.azimuth, arguments.elevation), size.width,
                        size.height);
    Image image(size.width, size.height);
    Json document = json_document();
    document["output"] = arguments.output;
    document["width"] = size.width;
    document["height"] = size.height;
    if (file.is_empty()) {
        const Warning empty{
            "empty",
            text("'", printable(arguments.blob), "' has no triangles; the picture shows the background only."),
            arguments.blob,
            {},
            {}};
        give({&empty, 1}, warnings);
    }
    document["warnings"] = warnings_json(warnings);
    {
        Progress progress(arguments.quiet);
        if (arguments.heatmap) {
            const Work work = draw_heatmap(file.blob, camera, arguments, image, progress);
            document["steps"] = {{"mean", work.mean}, {"most", work.most}, {"white", work.white}};
            console.say("steps a ray: ", rounded(work.mean, 4), " on average, ", rounded(work.most, 4),
                        " at most in a pixel; black is 0, white is ", rounded(work.white, 4), " and more");
        } else {
            draw_shaded(subject, camera, arguments, image, progress);
        }
    }
    write_output_file(arguments.output, image.png());
    console.say("wrote ", printable(arguments.output), ", ", size.width, " x ", size.height);
    if (arguments.json) print_json(document);
    return ExitCode::ok;
}

}  // namespace espalier::tools
