// answers FOLDER: bakes FOLDER/positions and FOLDER/triangles, writes FOLDER/blob, and asks it the questions of the
// folder: FOLDER/origins, directions, limits and radii, arrays of float32. Writes the answers of each query to a file
// of its name, as words in the order of the fields. Each comes from one call of C++ for each question.
#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

namespace {

std::string folder;

template <class Element>
std::vector<Element> read(const char* name) {
    std::vector<Element> elements;
    std::FILE* const file = std::fopen((folder + name).c_str(), "rb");
    if (file == nullptr) return elements;
    for (Element element; std::fread(&element, sizeof element, 1, file) == 1;) elements.push_back(element);
    std::fclose(file);
    return elements;
}

/// Answers of one kind of query, word by word. They are written to a file at the end.
class Words {
public:
    explicit Words(const char* name) : name_(name) {}
    Words(const Words&) = delete;
    Words& operator=(const Words&) = delete;
    ~Words() {
        std::FILE* const file = std::fopen((folder + name_).c_str(), "wb");
        if (file == nullptr) return;
        std::fwrite(words_.data(), sizeof(std::uint32_t), words_.size(), file);
        std::fclose(file);
    }

    template <class... Fields>
    void add(const Fields&... fields) {
        (add_field(fields), ...);
    }

private:
    void add_field(float number) { words_.push_back(std::bit_cast<std::uint32_t>(number)); }
    void add_field(espalier::TriangleId triangle) { words_.push_back(triangle.index); }
    void add_field(const espalier::Vec3& vector) { add(vector.x, vector.y, vector.z); }
    template <class Number>
    void add_field(const Number& number) {
        words_.push_back(static_cast<std::uint32_t>(number));
    }

    const char* name_;
    std::vector<std::uint32_t> words_;
};

void add(Words& words, const espalier::RayHit& hit) {
    words.add(hit.t, hit.u, hit.v, hit.normal, hit.triangle, hit.status, hit.side);
}

void add(Words& words, const espalier::ClosestPoint& point) {
    words.add(point.point, point.on_shape, point.face_normal, point.distance, point.u, point.v, point.triangle,
              point.status, point.feature, point.side);
}

struct Questions {
    std::vector<espalier::Vec3> origins;
    std::vector<espalier::Vec3> directions;
    std::vector<float> limits;
    std::vector<float> radii;

    [[nodiscard]] espalier::Ray ray(std::size_t i) const {
        return {origins[i], directions[i], 0.05f, limits[i], static_cast<espalier::FaceCulling>(i % 3)};
    }
};

void answer_rays(const espalier::Blob& blob, const Questions& questions) {
    Words closest("raycast");
    Words any("occluded");
    Words first("closest_hits");
    Words all("all_hits");
    Words crossings("crossings");
    Words originals("original_hits");
    for (std::size_t i = 0; i < questions.origins.size(); ++i) {
        const espalier::Ray ray = questions.ray(i);
        const espalier::RayHit hit = espalier::raycast(blob, ray);
        add(closest, hit);
        any.add(espalier::occluded(blob, ray).status());
        const espalier::OriginalHit original = espalier::original_hit(blob, hit);
        originals.add(original.file, original.mesh, original.triangle, original.u, original.v, original.status);
        espalier::RayHit hits[3];
        const espalier::Filled filled = espalier::closest_hits(blob, ray, hits);
        first.add(filled.count, filled.status);
        for (std::size_t k = 0; k < filled.count; ++k) add(first, hits[k]);
        all.add(espalier::for_each_hit(blob, ray, [&](const espalier::RayHit& each) { add(all, each); }));
        crossings.add(
            espalier::for_each_crossing(blob, ray, [&](const espalier::RayHit& each) { add(crossings, each); }));
    }
}

void answer_points(const espalier::Blob& blob, const Questions& questions) {
    Words closest("closest_point");
    Words signed_distances("signed_distance");
    Words inside("contains");
    Words several("closest_triangles");
    Words windings("winding_number");
    for (const espalier::Vec3& point : questions.origins) {
        add(closest, espalier::closest_point(blob, point, 2.5f));
        add(signed_distances, espalier::signed_distance(blob, point, 2.5f));
        inside.add(espalier::contains(blob, point).status());
        espalier::ClosestPoint nearest[3];
        const espalier::Filled filled = espalier::closest_triangles(blob, point, nearest, 2.5f);
        several.add(filled.count, filled.status);
        for (std::size_t k = 0; k < filled.count; ++k) add(several, nearest[k]);
        const auto winding = espalier::winding_number(blob, point, 7);
        windings.add(winding.value, winding.status);
    }
}

template <class Shape>
void answer_volume(const espalier::Blob& blob, Words& words, const Shape& shape) {
    words.add(espalier::overlaps(blob, shape).status());
    words.add(espalier::for_each_overlap(
        blob, shape, [&](espalier::TriangleId triangle, const espalier::Triangle&) { words.add(triangle); }));
}

template <class Shape>
void answer_sweep(const espalier::Blob& blob, Words& words, const Shape& shape, const espalier::Vec3& displacement) {
    espalier::SweepOptions options;
    options.culling = espalier::FaceCulling::back;
    options.ignore_leaving = true;
    options.skin = 0.01f;
    const espalier::SweepHit hit = espalier::sweep(blob, shape, displacement, options);
    words.add(hit.t, hit.point, hit.normal, hit.face_normal, hit.triangle, hit.status, hit.feature,
              hit.starts_overlapping);
}

void answer_shapes(const espalier::Blob& blob, const Questions& questions) {
    Words segments("closest_to_segments");
    Words boxes("closest_to_boxes");
    Words touching[] = {Words("sphere"),       Words("capsule"), Words("box"),
                        Words("oriented_box"), Words("cone"),    Words("triangle")};
    Words sweeps[] = {Words("sweep_sphere"), Words("sweep_capsule"), Words("sweep_box"), Words("sweep_oriented_box")};
    const std::size_t count = questions.origins.size();
    for (std::size_t i = 0; i < count; ++i) {
        const espalier::Vec3 a = questions.origins[i];
        const espalier::Vec3 b = questions.directions[i];
        const espalier::Vec3 c = questions.directions[(i + 1) % count];
        const float radius = questions.radii[i];
        const espalier::Sphere sphere = {a, radius};
        const espalier::Capsule capsule = {a, b, radius};
        const espalier::Box box = {a, b};
        const espalier::OrientedBox oriented_box = {a, {b, c, {0.0f, 0.0f, radius}}};
        add(segments, espalier::closest_point(blob, espalier::Segment{a, b}, 1.5f));
        add(boxes, espalier::closest_point(blob, box, 1.5f));
        answer_volume(blob, touching[0], sphere);
        answer_volume(blob, touching[1], capsule);
        answer_volume(blob, touching[2], box);
        answer_volume(blob, touching[3], oriented_box);
        answer_volume(blob, touching[4], espalier::Cone{a, b, radius});
        answer_volume(blob, touching[5], espalier::Triangle{a, b, c});
        answer_sweep(blob, sweeps[0], sphere, b);
        answer_sweep(blob, sweeps[1], capsule, b);
        answer_sweep(blob, sweeps[2], box, b);
        answer_sweep(blob, sweeps[3], oriented_box, b);
    }
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: answers FOLDER\n", stderr);
        return 1;
    }
    folder = std::string(arguments[1]) + "/";
    const auto positions = read<espalier::Vec3>("positions");
    const auto triangles = read<espalier::TriangleVertices>("triangles");
    espalier::MeshView mesh;
    mesh.positions = positions;
    mesh.triangles = triangles;
    espalier::BakeOptions options;
    options.original_ids = true;
    options.flat_angle = 5.0;
    const espalier::BakeResult baked = espalier::bake(std::span(&mesh, 1), options);
    if (!baked) {
        std::fprintf(stderr, "answers: %s\n", baked.message.c_str());
        return 2;
    }
    std::FILE* const file = std::fopen((folder + "blob").c_str(), "wb");
    if (file == nullptr) return 2;
    std::fwrite(baked.bytes.data(), 1, baked.bytes.size(), file);
    std::fclose(file);
    const espalier::Blob blob = espalier::open(baked.bytes);
    const Questions questions = {read<espalier::Vec3>("origins"), read<espalier::Vec3>("directions"),
                                 read<float>("limits"), read<float>("radii")};
    answer_rays(blob, questions);
    answer_points(blob, questions);
    answer_shapes(blob, questions);
    return 0;
}
