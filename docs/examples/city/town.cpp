#include "town.hpp"

namespace city {

namespace {

/// Returns a number without pattern that depends on its arguments alone.
std::uint32_t hash(int x, int y, std::uint32_t of) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9E3779B1u ^ static_cast<std::uint32_t>(y) * 0x85EBCA77u ^ of;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    return h ^ h >> 15;
}

/// Returns a number from low to high.
int choose(int low, int high, int x, int y, std::uint32_t of) {
    return low + static_cast<int>(hash(x, y, of) % static_cast<std::uint32_t>(high - low + 1));
}

constexpr int half_street = 4;

/// Returns how far a coordinate is from the next street, in metres.
int to_street(int metres) {
    const int past = metres % street_distance;
    return past < street_distance - past ? past : street_distance - past;
}
bool is_street(int x, int y) { return to_street(x) <= half_street || to_street(y) <= half_street; }

Solid make_house(int width, int length, int floors) {
    Solid house;
    const int half_width = width * metre / 2, half_length = length * metre / 2, floor = 3 * metre;
    house.add_box({-half_width, -half_length, -2 * metre}, {half_width, half_length, floors * floor});
    house.add_roof({-half_width - 16, -half_length - 16, floors * floor},
                   {half_width + 16, half_length + 16, (floors + 1) * floor});
    for (int level = 0; level < floors; ++level)  // windows
        for (int y = -half_length + metre; y + 2 * metre <= half_length; y += 3 * metre)
            for (const int side : {-half_width - 8, half_width})
                house.add_box({side, y, level * floor + metre}, {side + 8, y + metre, level * floor + 2 * metre + 32});
    house.add_box({half_width / 2, -half_length / 2, floors * floor},
                  {half_width / 2 + 48, -half_length / 2 + 48, (floors + 1) * floor + 16});
    return house;
}

/// A block of flats: windows, and a balcony for each flat.
Solid make_flats(int floors) {
    Solid flats = make_house(12, 20, floors);
    for (int level = 1; level < floors; ++level)
        for (int y = -9; y <= 5; y += 4)
            flats.add_box({6 * metre, y * metre, level * 3 * metre},
                          {7 * metre + 32, (y + 3) * metre, level * 3 * metre + metre});
    return flats;
}

Solid make_tower() {
    Solid tower;
    std::vector<int> radii;
    for (int level = 0; level < 24; ++level) {
        radii.push_back(8 * metre - level * 6);
        radii.push_back(8 * metre - level * 6 - 24);
    }
    tower.add_rings(-2 * metre, metre + 16, radii);
    return tower;
}

Solid make_tree(bool is_fir) {
    Solid tree;
    tree.add_rings(-32, metre, {20, 16, 14});
    if (is_fir) tree.add_rings(metre, 48, {120, 50, 104, 42, 88, 34, 70, 26, 50, 16, 0});
    else tree.add_rings(metre + 32, 48, {24, 90, 132, 152, 158, 146, 118, 74, 20});
    return tree;
}

Solid make_lamp() {
    Solid lamp;
    lamp.add_rings(-16, metre, {8, 6, 6, 5, 5});
    lamp.add_box({-4, -4, 3 * metre + 48}, {80, 4, 4 * metre - 8});
    lamp.add_box({56, -10, 3 * metre + 32}, {88, 10, 3 * metre + 48});
    return lamp;
}

/// A tile of the ground, two triangles for 4 by 4 metres, in the space of the town.
Solid make_ground(int tile_x, int tile_y) {
    constexpr int cell = 4;
    Solid ground;
    const auto at = [](int x, int y) -> Point {
        return {x * metre, y * metre, ground_height(x, y) - (is_street(x, y) ? 10 : 0)};
    };
    for (int x = tile_x; x < tile_x + tile_side; x += cell)
        for (int y = tile_y; y < tile_y + tile_side; y += cell)
            ground.add_quad(at(x, y), at(x + cell, y), at(x + cell, y + cell), at(x, y + cell));
    return ground;
}

/// A town that instances are added to.
struct Builder {
    Town town;

    std::uint32_t add_mesh(Solid mesh) {
        town.meshes.push_back(std::move(mesh));
        return static_cast<std::uint32_t>(town.meshes.size() - 1);
    }
    /// Places a mesh on the ground, at a place in metres. Its size is in 64ths; quaternions need no length of 1.
    void place(std::uint32_t mesh, Kind kind, int x, int y, const espalier::Quaternion& rotation, int size = 64) {
        const espalier::Vec3 at = {static_cast<float>(x), static_cast<float>(y), in_metres(ground_height(x, y))};
        town.instances.push_back(
            {{rotation, at, static_cast<float>(size) / 64}, mesh, mask_of(kind), static_cast<std::uint32_t>(kind)});
    }
};

/// Returns a rotation by quarter turns around z.
espalier::Quaternion quarter_turns(int turns) {
    constexpr espalier::Quaternion rotation[4] = {{0, 0, 0, 1}, {0, 0, 1, 1}, {0, 0, 1, 0}, {0, 0, -1, 1}};
    return rotation[turns & 3];
}

}  // namespace

int ground_height(int x, int y) {
    // Hills of whole numbers at the corners of large cells, and between these a smooth way from one to the next.
    constexpr int cell = 128;
    const auto smooth = [](int t) { return t * t * (3 * cell - 2 * t) / (cell * cell); };
    const int i = x / cell, j = y / cell, u = smooth(x % cell), v = smooth(y % cell);
    const auto corner = [](int a, int b) { return choose(0, 14 * metre, a, b, 1); };
    const int near = corner(i, j) * (cell - u) + corner(i + 1, j) * u;
    const int far = corner(i, j + 1) * (cell - u) + corner(i + 1, j + 1) * u;
    return (near * (cell - v) + far * v) / (cell * cell);
}

Town make_town() {
    Builder builder;
    for (int x = 0; x < town_side; x += tile_side)
        for (int y = 0; y < town_side; y += tile_side)
            builder.town.instances.push_back({{}, builder.add_mesh(make_ground(x, y)), mask_of(Kind::ground)});
    const std::uint32_t houses[4] = {builder.add_mesh(make_house(8, 10, 2)), builder.add_mesh(make_house(9, 14, 2)),
                                     builder.add_mesh(make_flats(5)), builder.add_mesh(make_tower())};
    const std::uint32_t trees[2] = {builder.add_mesh(make_tree(false)), builder.add_mesh(make_tree(true))};
    const std::uint32_t lamp = builder.add_mesh(make_lamp());

    for (int x = 0; x < town_side; x += street_distance) {
        for (int y = 0; y < town_side; y += street_distance) {
            const auto distance = [](int a) { return a < town_side / 2 ? town_side / 2 - a : a - town_side / 2; };
            const bool is_centre = distance(x) + distance(y) < town_side / 3;
            const int lots = is_centre ? 2 : 3, lot_length = 48 / lots;
            for (int lot = 0; lot < 2 * lots; ++lot) {  // on both sides of the block, along the street
                const bool is_far = lot >= lots;
                const int number = choose(0, 9, x + lot, y, 2);
                const int house = !is_centre ? number % 2 : number < 3 ? 3 : number < 8 ? 2 : 1;
                builder.place(houses[house], Kind::house, x + 8 + lot_length / 2 + lot_length * (lot % lots),
                              y + (is_far ? 50 : 14), quarter_turns(is_far ? 1 : 3));
            }
            for (int tree = 0; tree < 12; ++tree) {
                const int at_x = x + choose(8, 56, x, y, 10u + static_cast<std::uint32_t>(tree));
                const int at_y = y + choose(26, 38, x, y, 30u + static_cast<std::uint32_t>(tree));
                const auto turn = static_cast<float>(choose(-9, 9, at_x, at_y, 4));
                builder.place(trees[choose(0, 1, at_x, at_y, 5)], Kind::tree, at_x, at_y, {0, 0, turn, 10},
                              choose(44, 96, at_x, at_y, 6));
            }
            for (int step = 8; step < street_distance; step += 16) {
                builder.place(lamp, Kind::lamp, x + step, y + half_street + 1, quarter_turns(3));
                builder.place(lamp, Kind::lamp, x + half_street + 1, y + step, quarter_turns(2));
            }
        }
    }
    return std::move(builder.town);
}

}  // namespace city
