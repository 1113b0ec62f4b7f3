// Asks the blob in flash the same questions as the host does, prints the same line, then the stack that each query
// took.
#include <cstdint>

#include <espalier/espalier.hpp>

#include "../../platform/answers.hpp"
#include "../../platform/report.hpp"
#include "blob_in_image.hpp"
#include "semihosting.hpp"
#include "stack_paint.hpp"

namespace {

using namespace espalier;

constexpr std::uint32_t stack_samples = 64;

/// The most that any of some calls took.
class Deepest {
public:
    template <class Call>
    void measure(const Call& call) {
        const std::uint32_t used = firmware::stack_used_by(call);
        if (used > bytes_) bytes_ = used;
    }
    void print(const char* name) const {
        platform::Line line;
        line.text("stack ");
        line.text(name);
        line.text(" ");
        line.decimal(bytes_);
        line.text("\n");
        firmware::print(line.c_str());
    }

private:
    std::uint32_t bytes_ = 0;
};

void print_stack_use(const Blob& blob) {
    platform::Questions questions(blob);
    Deepest opening;
    Deepest closest_ray;
    Deepest any_ray;
    Deepest all_hits;
    Deepest sphere_overlap;
    Deepest nearest_point;
    Deepest moving_sphere;
    Deepest moving_box;
    opening.measure([] {
        Blob again;
        static_cast<void>(open(firmware::blob_in_image(), again));
    });
    for (std::uint32_t number = 0; number < stack_samples; ++number) {
        const Ray ray = questions.ray(number);
        const Sphere sphere = questions.sphere(number);
        const Vec3 point = questions.point(number);
        RayHit hit;
        Nearest nearest;
        bool answer = false;
        closest_ray.measure([&] { answer = raycast(blob, ray, hit); });
        any_ray.measure([&] { answer = occluded(blob, ray); });
        all_hits.measure([&] { answer = for_each_hit(blob, ray, [](const RayHit&) { return keep_going; }); });
        sphere_overlap.measure([&] { answer = overlaps(blob, sphere); });
        nearest_point.measure([&] { answer = closest_point(blob, point, __builtin_inff(), nearest); });
        SweepHit contact;
        const Box box = {point, {point.x + sphere.radius, point.y + sphere.radius, point.z}};
        moving_sphere.measure([&] { answer = sweep(blob, Sphere{point, sphere.radius}, ray.direction, contact); });
        moving_box.measure([&] { answer = sweep(blob, box, ray.direction, contact); });
        static_cast<void>(answer);
    }
    opening.print("open");
    closest_ray.print("raycast");
    any_ray.print("occluded");
    all_hits.print("for_each_hit");
    sphere_overlap.print("overlaps");
    nearest_point.print("closest_point");
    moving_sphere.print("sweep_sphere");
    moving_box.print("sweep_box");
}

}  // namespace

int main() {
    Blob blob;
    if (const Status status = open(firmware::blob_in_image(), blob); status != Status::ok) {
        firmware::print(describe(status));
        return 2;
    }
    firmware::print(platform::report(platform::ask_everything(blob, ESPALIER_QUESTIONS)).c_str());
    print_stack_use(blob);
    return 0;
}
