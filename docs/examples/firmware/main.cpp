// Does the arm hit the table? Asked on a microcontroller, of a mesh that lies in flash: no heap, no C library, no copy
// in RAM.
#include <espalier/espalier.hpp>

#include "board/semihosting.hpp"
#include "table.h"

namespace {

using espalier::Vec3;

/// The joints of an arm that stands beside the table, as the kinematics of a path have them.
struct Pose {
    const char* name;
    Vec3 shoulder;
    Vec3 elbow;
    Vec3 wrist;
    Vec3 tip;
};

constexpr Pose path[] = {
    {"at rest", {-0.9f, 0.0f, 0.9f}, {-0.8f, 0.0f, 1.3f}, {-0.45f, 0.0f, 1.25f}, {-0.4f, 0.0f, 1.1f}},
    {"above the mug", {-0.9f, 0.0f, 0.9f}, {-0.7f, -0.1f, 1.25f}, {-0.35f, -0.15f, 1.1f}, {-0.3f, -0.15f, 0.95f}},
    {"too low", {-0.9f, 0.0f, 0.9f}, {-0.6f, 0.0f, 1.1f}, {-0.2f, 0.1f, 0.9f}, {-0.15f, 0.1f, 0.74f}},
    {"through the crate", {-0.9f, 0.0f, 0.9f}, {-0.5f, 0.0f, 1.15f}, {0.0f, 0.05f, 0.95f}, {0.3f, 0.05f, 0.9f}},
    {"back", {-0.9f, 0.0f, 0.9f}, {-0.8f, 0.0f, 1.3f}, {-0.45f, 0.0f, 1.25f}, {-0.4f, 0.0f, 1.1f}},
};

struct Link {
    const char* name;
    espalier::Capsule shape;
};

void print_number(std::uint32_t number) {
    char digits[11] = {};
    char* first = digits + 10;
    do {
        *--first = static_cast<char>('0' + number % 10);
        number /= 10;
    } while (number != 0);
    board::print(first);
}

/// Yes or no is exact; the distance is of use while there is one.
bool check(const espalier::Blob& table, const Pose& pose) {
    const Link links[] = {{"upper arm", {pose.shoulder, pose.elbow, 0.06f}},
                          {"forearm", {pose.elbow, pose.wrist, 0.05f}},
                          {"gripper", {pose.wrist, pose.tip, 0.03f}}};
    board::print(pose.name);
    float clearance = __builtin_inff();
    for (const Link& link : links) {
        if (overlaps(table, link.shape)) {
            board::print(": the ");
            board::print(link.name);
            board::print(" hits the table\n");
            return false;
        }
        espalier::NearestPair nearest;
        closest_to_segment(table, {link.shape.from, link.shape.to}, __builtin_inff(), nearest);
        const float free = nearest.distance - link.shape.radius;
        if (free < clearance) clearance = free;
    }
    board::print(": clear by ");
    print_number(static_cast<std::uint32_t>(clearance * 1000.0f));
    board::print(" mm\n");
    return true;
}

}  // namespace

int main() {
    espalier::Blob table;
    // The blob is part of this program: it can be trusted, and is opened at once. For bytes that come by cable or are
    // written to flash separately, call `open`, which proves that every query on them is safe.
    if (const auto status = open_trusted_image(table_bytes(), table); status != espalier::Status::ok) {
        board::print(describe(status));
        return 1;
    }
    bool is_free = true;
    for (const Pose& pose : path) is_free = check(table, pose) && is_free;
    board::print(is_free ? "the path is free\n" : "the path is not free\n");
    return 0;
}
