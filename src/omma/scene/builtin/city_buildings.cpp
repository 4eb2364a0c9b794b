// What stands on the city's blocks: houses, flats, towers, parks, trees, lamps and cars.
#include <algorithm>
#include <cmath>

#include "omma/scene/builtin/city.h"

namespace omma::builtin {
namespace {

using enum CityMaterial;

constexpr float kerb = 0.15f;  // metres above the street
constexpr float pavement_width = 4.0f;
constexpr float storey = 3.0f;    // metres; the window textures have four storeys
constexpr float window = 2.6f;    // metres from window to window
constexpr float footing = -0.2f;  // walls begin below the ground, so that nothing can leak in between

/// Linear shares of white.
Tint tint(float r, float g, float b) { return Tint(glm::clamp(glm::vec3(r, g, b), 0.0f, 1.0f) * 255.0f + 0.5f, 255); }

Tint wall_tint(Random& random) {
  const float light = random.between(0.72f, 1.0f);
  return tint(light, light * random.between(0.86f, 1.0f), light * random.between(0.68f, 0.98f));
}

void add_tree(CityGroup& group, Random& random, const glm::vec3& foot, float size) {
  const float trunk = 2.2f * size;
  const glm::vec2 profile[] = {{0.20f * size, footing}, {0.12f * size, trunk}};
  add_lathe(group[bark], foot, profile, 5, 1.0f);
  const float wide = random.between(1.5f, 2.1f) * size, tall = random.between(1.7f, 2.6f) * size;
  const float light = random.between(0.65f, 1.0f);
  add_ball(group[leaves], foot + glm::vec3(0.0f, trunk + 0.75f * tall, 0.0f), {wide, tall, wide}, 1, 0.16f,
           random.next(), tint(light * random.between(0.8f, 1.0f), light, light * 0.8f));
}

/// The arm reaches away from the frame's back.
void add_lamp(CityGroup& group, const Frame& frame) {
  const glm::vec2 profile[] = {{0.09f, footing}, {0.05f, 6.0f}};
  add_lathe(group[metal], frame.origin, profile, 4, 1.0f);
  add_box(group[metal], frame, {-0.04f, 5.9f, -1.6f}, {0.04f, 6.0f, 0.04f}, 1.0f);
  add_box(group[concrete], frame, {-0.14f, 5.78f, -1.9f}, {0.14f, 5.9f, -1.2f}, 1.0f);
}

void add_car(CityGroup& group, Random& random, const Frame& frame) {
  static constexpr glm::vec3 paints[] = {{0.75f, 0.08f, 0.06f}, {0.08f, 0.18f, 0.5f}, {0.9f, 0.9f, 0.9f},
                                         {0.12f, 0.12f, 0.13f}, {0.5f, 0.52f, 0.55f}, {0.75f, 0.55f, 0.1f}};
  const glm::vec3 paint = paints[random.below(6)];
  add_box(group[concrete], frame, {0.0f, 0.28f, 0.0f}, {1.75f, 0.85f, 4.2f}, 2.0f, tint(paint.r, paint.g, paint.b));
  add_box(group[glass], frame, {0.12f, 0.85f, 1.0f}, {1.63f, 1.42f, 3.4f}, 8.0f, tint(0.6f, 0.6f, 0.6f), sides_walls);
  add_box(group[concrete], frame, {0.12f, 1.42f, 1.0f}, {1.63f, 1.46f, 3.4f}, 2.0f, tint(paint.r, paint.g, paint.b));
  for (const float z : {0.55f, 3.05f}) {
    add_box(group[asphalt], frame, {0.05f, 0.0f, z}, {1.70f, 0.6f, z + 0.6f}, 1.0f, tint(0.2f, 0.2f, 0.2f),
            sides_walls);
  }
}

/// A roof with its ridge along x over a rectangle, closed, with eaves.
void add_pitched_roof(CityGroup& group, const Frame& frame, float width, float depth, float eaves, float rise,
                      Tint tiles, Tint gable) {
  const float out = 0.45f, x0 = -out * 0.4f, x1 = width + out * 0.4f, z0 = -out, z1 = depth + out;
  const float slope = std::hypot(rise, 0.5f * (z1 - z0));
  const auto at = [&](float x, float y, float z) { return frame.point(x, y, z); };
  const float ridge = eaves + rise, middle = 0.5f * (z0 + z1);
  const UvRect uv{0.0f, 0.0f, (x1 - x0) / 3.6f, slope / 3.6f};
  add_quad(group[roof], at(x0, eaves, z0), at(x1, eaves, z0), at(x1, ridge, middle), at(x0, ridge, middle), uv, tiles);
  add_quad(group[roof], at(x1, eaves, z1), at(x0, eaves, z1), at(x0, ridge, middle), at(x1, ridge, middle), uv, tiles);
  add_triangle(group[concrete], at(x1, eaves, z0), at(x1, eaves, z1), at(x1, ridge, middle), 4.0f, gable);
  add_triangle(group[concrete], at(x0, eaves, z1), at(x0, eaves, z0), at(x0, ridge, middle), 4.0f, gable);
  add_quad(group[concrete], at(x0, eaves, z1), at(x1, eaves, z1), at(x1, eaves, z0), at(x0, eaves, z0), {0, 0, 2, 2},
           gable);
}

void add_house(CityGroup& group, Random& random, const Frame& frame, float width, float depth) {
  const int storeys = 2 + random.below(3);
  const float eaves = kerb + storey * static_cast<float>(storeys);
  const Tint walls = wall_tint(random);
  const CityMaterial front = random.below(5) < 3 ? brick : plaster;
  add_walls(group[front], frame, {0.0f, kerb + footing, 0.0f}, {width, eaves, depth}, 0.25f / window,
            static_cast<float>(storeys) / 4.0f, walls);
  const float light = random.between(0.6f, 1.0f);
  const float rise = random.between(2.4f, 3.8f);
  add_pitched_roof(group, frame, width, depth, eaves, rise, tint(light, light * 0.95f, light * 0.92f), walls);
  if (random.below(2) == 0) {
    const float x = random.between(0.15f, 0.75f) * width;
    add_box(group[concrete], frame, {x, eaves + 0.3f * rise, depth * 0.55f},
            {x + 0.7f, eaves + rise + 0.9f, depth * 0.55f + 0.9f}, 2.0f, tint(0.55f, 0.38f, 0.33f), sides_no_bottom);
  }
  if (random.below(2) == 0) {
    add_box(group[concrete], frame, {width * 0.5f - 0.8f, footing, -1.0f}, {width * 0.5f + 0.8f, kerb + 0.3f, 0.1f},
            2.0f, white, sides_no_bottom & ~side_back);
  }
}

/// Two long rows face front and back, two short ones right and left; gardens lie inside.
void build_houses(CityGroup& group, Random& random, const Frame& frame, float side) {
  const float depth = 10.0f;
  const float inner = side - 2.0f * pavement_width;
  add_box(group[grass], frame, {pavement_width + depth, kerb, pavement_width + depth},
          {side - pavement_width - depth, kerb + 0.05f, side - pavement_width - depth}, 6.0f, white, sides_no_bottom);
  const auto row = [&](const Frame& start, float length) {
    const int houses = static_cast<int>(length / 10.4f);
    const float width = length / static_cast<float>(houses);
    for (int i = 0; i < houses; ++i) {
      if (random.below(14) == 0) continue;
      // Rows step forward and back a little, and never share a wall's plane.
      add_house(group, random, start.at(width * static_cast<float>(i) + 0.06f, 0.0f, random.between(0.0f, 0.8f)),
                width - 0.12f, depth - 1.0f);
    }
  };
  const float a = pavement_width, b = side - pavement_width;
  const glm::vec3 x = frame.right, z = frame.back;
  row({frame.point(a, 0.0f, a), x, z}, inner);
  row({frame.point(b, 0.0f, b), -x, -z}, inner);
  row({frame.point(b, 0.0f, a + depth + 1.0f), z, -x}, inner - 2.0f * depth - 2.0f);
  row({frame.point(a, 0.0f, b - depth - 1.0f), -z, x}, inner - 2.0f * depth - 2.0f);
  add_tree(group, random, frame.point(random.between(20.0f, side - 20.0f), kerb, random.between(20.0f, side - 20.0f)),
           random.between(0.9f, 1.5f));
}

/// A parapet all round a flat roof, and the roof between.
void add_flat_roof(CityGroup& group, const Frame& frame, float width, float depth, float height) {
  const float t = 0.35f, h = 0.7f;
  add_box(group[concrete], frame, {-t, height, -t}, {width + t, height + h, t}, 4.0f);
  add_box(group[concrete], frame, {-t, height, depth - t}, {width + t, height + h, depth + t}, 4.0f);
  add_box(group[concrete], frame, {-t, height, t}, {t, height + h, depth - t}, 4.0f);
  add_box(group[concrete], frame, {width - t, height, t}, {width + t, height + h, depth - t}, 4.0f);
  add_box(group[asphalt], frame, {t, height, t}, {width - t, height + 0.1f, depth - t}, 5.0f, tint(0.8f, 0.8f, 0.8f),
          side_top);
}

void add_flats(CityGroup& group, Random& random, const Frame& frame, float width, float depth) {
  const int storeys = 3 + random.below(4);
  const float ground = kerb + 3.6f, top = ground + storey * static_cast<float>(storeys);
  const Tint walls = wall_tint(random);
  const CityMaterial front = random.below(3) == 0 ? brick : plaster;
  add_walls(group[shopfront], frame, {0.0f, kerb + footing, 0.0f}, {width, ground, depth}, 0.25f / 4.0f, 1.0f,
            wall_tint(random));
  add_walls(group[front], frame, {0.0f, ground, 0.0f}, {width, top, depth}, 0.25f / window,
            static_cast<float>(storeys) / 4.0f, walls);
  for (int s = 0; s < storeys; s += 2) {
    const float y = ground + storey * static_cast<float>(s);
    add_box(group[concrete], frame, {-0.25f, y - 0.2f, -0.25f}, {width + 0.25f, y + 0.1f, depth + 0.25f}, 4.0f);
  }
  const int balconies = static_cast<int>(width / 9.0f);
  for (int s = 1; s < storeys; s += 2) {
    for (int b = 0; b < balconies; ++b) {
      const float x = width * (static_cast<float>(b) + 0.5f) / static_cast<float>(balconies),
                  y = ground + storey * static_cast<float>(s);
      add_box(group[metal], frame, {x - 1.6f, y, -1.2f}, {x + 1.6f, y + 0.95f, -0.01f}, 2.0f, white,
              sides_all & ~side_back);
    }
  }
  add_flat_roof(group, frame, width, depth, top);
  add_box(group[concrete], frame, {width * 0.3f, top, depth * 0.35f},
          {width * 0.3f + 4.0f, top + 2.6f, depth * 0.35f + 4.0f}, 4.0f, walls, sides_no_bottom);
}

void build_flats(CityGroup& group, Random& random, const Frame& frame, float side) {
  const float a = pavement_width + 0.5f, b = side - a, size = 0.5f * (b - a) - 3.0f;
  const glm::vec3 x = frame.right, z = frame.back;
  // One to each corner, fronts turned four ways.
  add_flats(group, random, {frame.point(a, 0.0f, a), x, z}, size, size * random.between(0.6f, 0.9f));
  add_flats(group, random, {frame.point(b, 0.0f, a), z, -x}, size, size * random.between(0.6f, 0.9f));
  add_flats(group, random, {frame.point(b, 0.0f, b), -x, -z}, size, size * random.between(0.6f, 0.9f));
  add_flats(group, random, {frame.point(a, 0.0f, b), -z, x}, size, size * random.between(0.6f, 0.9f));
}

void add_tower(CityGroup& group, Random& random, const Frame& frame, float width, float depth) {
  const int tiers = 2 + random.below(3);
  const CityMaterial front = random.below(4) == 0 ? plaster : glass;
  const float light = random.between(0.6f, 1.0f);
  const Tint walls = tint(light * random.between(0.8f, 1.0f), light, light);
  add_walls(group[shopfront], frame, {0.0f, kerb + footing, 0.0f}, {width, 4.2f, depth}, 0.25f / 4.5f, 1.0f,
            wall_tint(random));
  // A ledge caps the shops and every tier that another one stands on.
  const auto ledge = [&](float height, float indent) {
    add_box(group[concrete], frame, {indent - 0.4f, height - 0.3f, indent - 0.4f},
            {width - indent + 0.4f, height + 0.2f, depth - indent + 0.4f}, 4.0f);
  };
  float y = 4.2f, inset = 0.0f;
  ledge(y, inset);
  for (int tier = 0; tier < tiers; ++tier) {
    const int storeys = 5 + random.below(5);
    const float x0 = inset, x1 = width - inset, z0 = inset, z1 = depth - inset,
                top = y + storey * static_cast<float>(storeys);
    add_walls(group[front], frame, {x0, y, z0}, {x1, top, z1}, 0.25f / window, static_cast<float>(storeys) / 4.0f,
              walls);
    for (const float share : {0.0f, 1.0f}) {
      const float x = std::lerp(x0, x1, share);
      add_box(group[concrete], frame, {x - 0.3f, y, z0 - 0.3f}, {x + 0.3f, top, z0 + 0.3f}, 4.0f, white, sides_walls);
      add_box(group[concrete], frame, {x - 0.3f, y, z1 - 0.3f}, {x + 0.3f, top, z1 + 0.3f}, 4.0f, white, sides_walls);
    }
    y = top;
    if (tier + 1 < tiers) {
      ledge(y, inset);
    } else {
      add_flat_roof(group, frame.at(x0, 0.0f, z0), x1 - x0, z1 - z0, y);
    }
    inset += random.between(1.2f, 2.6f);
  }
  const glm::vec2 mast[] = {{0.35f, y}, {0.22f, y + 6.0f}, {0.06f, y + random.between(9.0f, 15.0f)}};
  add_lathe(group[metal], frame.point(width * 0.5f, 0.0f, depth * 0.5f), mast, 5, 1.0f);
}

void build_towers(CityGroup& group, Random& random, const Frame& frame, float side) {
  const float a = pavement_width + 3.0f, size = 18.0f, far = side - a - size;
  add_tower(group, random, frame.at(a, 0.0f, a), size, size * random.between(0.8f, 1.1f));
  add_tower(group, random, frame.at(far, 0.0f, far), size * random.between(0.8f, 1.0f), size);
  if (random.below(2)) add_tower(group, random, frame.at(far, 0.0f, a), size * 0.9f, size * 0.9f);
  const float low = a + 1.0f, high = side - a - 15.0f;
  add_box(group[grass], frame, {low, kerb, high}, {low + 14.0f, kerb + 0.3f, high + 14.0f}, 6.0f, white,
          sides_no_bottom);
  for (int i = 0; i < 4; ++i) {
    add_tree(group, random,
             frame.point(low + 2.0f + 10.0f * static_cast<float>(i % 2), kerb,
                         high + 2.0f + 10.0f * static_cast<float>(i / 2)),
             random.between(0.9f, 1.3f));
  }
}

void build_park(CityGroup& group, Random& random, const Frame& frame, float side) {
  const float a = pavement_width, b = side - a, m = 0.5f * side, path = 1.5f;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const float x0 = quarter % 2 ? m + path : a, x1 = quarter % 2 ? b : m - path;
    const float z0 = quarter / 2 ? m + path : a, z1 = quarter / 2 ? b : m - path;
    add_box(group[grass], frame, {x0, kerb, z0}, {x1, kerb + 0.08f, z1}, 6.0f, white, sides_no_bottom);
    for (int i = 0; i < 2; ++i) {
      add_tree(group, random,
               frame.point(random.between(x0 + 3.0f, x1 - 3.0f), kerb, random.between(z0 + 3.0f, z1 - 3.0f)),
               random.between(1.1f, 2.1f));
    }
  }
  const glm::vec2 basin[] = {{2.6f, kerb}, {2.6f, 0.7f}, {2.2f, 0.7f}, {2.0f, 0.4f},
                             {0.4f, 0.4f}, {0.3f, 1.6f}, {1.1f, 1.9f}, {0.0f, 1.8f}};
  add_lathe(group[concrete], frame.point(m, 0.0f, m), basin, 12, 4.0f);
}

/// Lamps and parked cars on the right and left, trees in front and on the right.
void furnish_pavement(CityGroup& group, Random& random, const Frame& frame, float side) {
  const glm::vec3 x = frame.right, z = frame.back;
  const Frame sides[] = {{frame.origin, x, z},
                         {frame.point(side, 0.0f, 0.0f), z, -x},
                         {frame.point(side, 0.0f, side), -x, -z},
                         {frame.point(0.0f, 0.0f, side), -z, x}};
  for (int i = 0; i < 4; ++i) {
    const Frame& edge = sides[i];
    if (i % 2 == 1) {
      add_lamp(group, edge.at(side * 0.25f, kerb, 0.6f));
      const Frame parked{edge.point(side * random.between(0.12f, 0.8f), 0.0f, -0.35f), -edge.back, edge.right};
      add_car(group, random, parked);
    }
    if (i < 2) {
      add_tree(group, random, edge.point(side * random.between(0.3f, 0.7f), kerb, 1.2f), random.between(0.85f, 1.2f));
    }
  }
}

}  // namespace

void build_block(CityGroup& group, Random& random, const Frame& frame, float side) {
  add_box(group[pavement], frame, {0.0f, 0.0f, 0.0f}, {side, kerb, side}, 4.0f, white, side_top);
  add_box(group[concrete], frame, {0.0f, footing, 0.0f}, {side, kerb, side}, 4.0f, white, sides_walls);
  const int kind = random.below(20);
  if (kind < 8) {
    build_houses(group, random, frame, side);
  } else if (kind < 14) {
    build_flats(group, random, frame, side);
  } else if (kind < 17) {
    build_towers(group, random, frame, side);
  } else {
    build_park(group, random, frame, side);
  }
  furnish_pavement(group, random, frame, side);
}

}  // namespace omma::builtin
