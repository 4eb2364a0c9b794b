// What becomes of an edge, from its two ends alone and in an order of their own: its two triangles decide alike.
#include "technique/subdivision/screen.glsl"

uniform float tolerance;       // pixels
uniform vec2 edge_range;       // lengths, as the distance of two rays on the unit sphere: longer ones are always
                               // split, shorter ones never
uniform vec4 tile_border;      // pixels, a little outside the tile: left, top, right, bottom

// What becomes of an edge: one of these, or how often it is halved until its parts are straight.
const int BROKEN = -2, SPLIT = -1, STRAIGHT = 0;

// The sides of the tile that a pixel lies beyond. Whatever is not seen lies beyond all.
int beyond(vec2 pixel) {
  return int(pixel.x < tile_border.x) | int(pixel.y < tile_border.y) << 1 | int(pixel.x > tile_border.z) << 2 |
         int(pixel.y > tile_border.w) << 3 | (is_seen(pixel) ? 0 : 15);
}

bool comes_first(vec3 a, vec3 b) {
  return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

// The share of the way from a to b at which the angle between them is halved.
float middle_share(vec3 a, vec3 b) {
  precise float a_length = length(a), b_length = length(b);
  precise float share = a_length / (a_length + b_length);
  return share;
}

vec3 middle(vec3 a, vec3 b) {
  vec3 first = comes_first(a, b) ? a : b, second = comes_first(a, b) ? b : a;
  precise vec3 point = first + (second - first) * middle_share(first, second);
  return point;
}

// The way in the image from a to b if the lens went on as it begins at a: straight over a seam. A seam may lie between a
// and a point close by, but then not behind a.
vec2 way_onward(vec3 a, vec3 b, vec2 a_pixel) {
  const float share = 0.125;
  vec3 from = normalize(a), step = (normalize(b) - from) * share;
  vec2 ahead = pixel_of(from + step), behind = pixel_of(from - step);
  float ahead_length = is_seen(ahead) ? distance(ahead, a_pixel) : NOWHERE;
  float behind_length = is_seen(behind) ? distance(behind, a_pixel) : NOWHERE;
  vec2 change = ahead_length <= behind_length ? ahead - a_pixel : a_pixel - behind;
  return min(ahead_length, behind_length) < NOWHERE ? change / share : vec2(0.0);
}

// Where that way ends, and a little further, for the lens may be curved up to the seam. It leads nowhere from a point on
// the seam itself, nor at a pole.
vec2 onward(vec3 a, vec3 b, vec2 a_pixel) {
  const float longest = 8.0;  // pixels; much more than an edge has that is split no more
  vec2 way = way_onward(a, b, a_pixel);
  return length(way) < longest ? on_grid(a_pixel + 1.25 * way) : a_pixel;
}

// How far apart points come to lie that are as far apart as a and b, near a: along the edge and across it.
float reach(vec3 a, vec3 b, vec2 a_pixel) {
  vec3 from = normalize(a), along = normalize(b) - from;
  vec3 aside = from + cross(from, along);
  return is_seen(a_pixel) ? max(length(way_onward(a, b, a_pixel)), length(way_onward(a, aside, a_pixel))) : 0.0;
}

#ifdef PART_COUNT
// The lens is smooth within each of these convex polygons; corners clockwise, pixels.
uniform vec2 part_corners[4 * PART_COUNT];

// PART_COUNT where a pixel is in none.
int part_of(vec2 pixel) {
  for (int part = 0; part < PART_COUNT; ++part) {
    float least = NOWHERE;
    for (int i = 0; i < 4; ++i) {
      vec2 corner = part_corners[4 * part + i], side = part_corners[4 * part + (i + 1) % 4] - corner;
      vec2 from = pixel - corner;
      least = min(least, side.x * from.y - side.y * from.x);
    }
    if (least >= 0.0) return part;
  }
  return PART_COUNT;
}
#endif

// Whether the lens may be smooth along an edge.
bool is_in_one_part(vec2 a_pixel, vec2 b_pixel) {
#ifdef PART_COUNT
  return part_of(a_pixel) == part_of(b_pixel);
#else
  return true;
#endif
}

// How far an edge is from straight at most, if it were all along as curved as it is anywhere: from second differences
// of its five points at the quarters. Its parts are then no worse, and splitting them comes to an end.
float greatest_deviation(vec3 a, vec3 b, vec2 a_pixel, vec2 middle_pixel, vec2 b_pixel) {
  vec2 first = pixel_of(3.0 * a + b), second = pixel_of(a + 3.0 * b);
  vec2 turn = max(abs(a_pixel + middle_pixel - 2.0 * first), abs(middle_pixel + b_pixel - 2.0 * second));
  return 2.0 * length(max(turn, abs(first + second - 2.0 * middle_pixel)));
}

#ifdef TESSELLATED
// Tessellation units take factors to 64; that leaves the inside of a triangle twice its edges' factor.
const int MOST_HALVINGS = 5;

// How often an edge is halved until its parts are straight; SPLIT where its five points do not tell: where it is not
// about as curved all along, or turns so far that a triangle of such edges might hold a pole.
int halvings(vec3 a, vec3 b, vec2 a_pixel, vec2 middle_pixel, vec2 b_pixel) {
  vec2 first = pixel_of(3.0 * a + b), second = pixel_of(a + 3.0 * b);
  vec2 turn = a_pixel + middle_pixel - 2.0 * first, middle_turn = first + second - 2.0 * middle_pixel,
       last_turn = middle_pixel + b_pixel - 2.0 * second;
  float most = 2.0 * length(max(max(abs(turn), abs(middle_turn)), abs(last_turn)));
  float change = 2.0 * length(max(max(turn, middle_turn), last_turn) - min(min(turn, middle_turn), last_turn));
  float deviation = most + change;
  bool is_even = change <= 0.5 * most && deviation <= 0.125 * distance(a_pixel, b_pixel);
  float count = max(ceil(0.5 * log2(deviation / tolerance)), 1.0);  // halving an edge quarters the deviation
  return is_even && count <= float(MOST_HALVINGS) ? int(count) : SPLIT;
}
#endif

int ordered_edge_state(vec3 a, vec3 b, vec2 a_pixel, vec2 b_pixel) {
  if (a == vec3(0.0) || b == vec3(0.0)) return BROKEN;
  vec3 a_ray = normalize(a), b_ray = normalize(b);
  float size = distance(a_ray, b_ray);
  if (size > edge_range.x) return SPLIT;
  vec2 middle_pixel = pixel_of(a_ray + b_ray);
  bool seen = is_seen(a_pixel) && is_seen(b_pixel), all_seen = seen && is_seen(middle_pixel);
  float deviation = all_seen ? distance(middle_pixel, 0.5 * (a_pixel + b_pixel)) : NOWHERE;
  bool is_smooth = is_in_one_part(a_pixel, b_pixel);
  // Outside the tile a line need not be exact, but may not turn round a pole or leap over a seam.
  bool is_gentle = all_seen ? is_smooth && deviation < 0.125 * distance(a_pixel, b_pixel) : !seen;
  if (is_gentle && (beyond(a_pixel) & beyond(b_pixel) & beyond(middle_pixel)) != 0) return seen ? STRAIGHT : BROKEN;

  // A short edge has no room for an inflection. (Loops that run once: software rasterizers execute both sides of an
  // `if`, but skip a loop that none of their lanes enters.)
  bool is_clear = deviation > tolerance || (deviation < 0.25 * tolerance && distance(a_pixel, b_pixel) < 4.0);
  for (; !is_clear; is_clear = true) {
    deviation = max(deviation, greatest_deviation(a_ray, b_ray, a_pixel, middle_pixel, b_pixel));
  }
  bool is_straight = deviation <= tolerance;
  if (is_straight && is_smooth) return STRAIGHT;
  bool is_final = size <= edge_range.y;
#ifdef TESSELLATED
  int count = SPLIT;
  for (bool look = all_seen && is_smooth && !is_final; look; look = false) {
    count = halvings(a_ray, b_ray, a_pixel, middle_pixel, b_pixel);
  }
  if (count != SPLIT) return count;
#endif
  for (bool is_small = !is_final && size < 0.1 * edge_range.x; is_small; is_small = false) {
    is_final = max(reach(a, b, a_pixel), reach(b, a, b_pixel)) <= 0.5 * tolerance;
  }
  return !is_final ? SPLIT : is_straight ? STRAIGHT : BROKEN;
}

int edge_state(vec3 a, vec3 b, vec2 a_pixel, vec2 b_pixel) {
  bool turn = !comes_first(a, b);
  return ordered_edge_state(turn ? b : a, turn ? a : b, turn ? b_pixel : a_pixel, turn ? a_pixel : b_pixel);
}
