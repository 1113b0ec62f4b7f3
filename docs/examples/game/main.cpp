// Four seconds in the yard: the character falls to the floor, walks into the wall, slides along it and up the ramp.
#include <cstdio>

#include "character.hpp"
#include "level.h"

int main() {
    const espalier::Blob level_blob = espalier::open(level_bytes());  // refers to the bytes, which must stay
    if (!level_blob) {
        std::printf("the level: %s\n", espalier::describe(level_blob.status()));
        return 1;
    }
    std::printf("the level: %u triangles in %u bytes\n", static_cast<unsigned>(level_blob.triangle_count()),
                static_cast<unsigned>(level_size));

    Character character = {.position = {0, -2, 2.5f}};
    const int ticks_a_second = 60;
    for (int tick = 0; tick <= 4 * ticks_a_second; ++tick) {
        if (tick % (ticks_a_second / 2) == 0) {
            std::printf("%.1f s: %5.2f %5.2f %5.2f  %s\n", static_cast<double>(tick) / ticks_a_second,
                        static_cast<double>(character.position.x), static_cast<double>(character.position.y),
                        static_cast<double>(character.position.z),
                        character.on_ground ? "on the ground" : "in the air");
        }
        const espalier::Vec3 walk = {tick < 2 * ticks_a_second ? 4.0f : 0.5f, tick < 2 * ticks_a_second ? 1.0f : 3.0f,
                                     0};
        update(level_blob, character, walk, 1.0f / ticks_a_second);
    }
    return 0;
}
