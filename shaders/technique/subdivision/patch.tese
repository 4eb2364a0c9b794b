// A point of a part. On an edge it follows from the edge's ends alone, by the halving that splits edges, so that it is
// the neighbour's point, too.
#include "technique/mesh_vertex.glsl"
#include "technique/subdivision/edge.glsl"

layout(triangles, equal_spacing, ccw) in;

in MESH_VERTEX corner[];
in vec2 corner_pixel[];
patch in uvec3 patch_halvings;

out MESH_VERTEX vertex;

struct Point {
  vec3 position;
  vec3 weight;  // barycentric
  vec2 pixel;
};

// The number-th of the points that halve the edge from corner i so many times.
Point on_edge(int i, int number, uint halvings) {
  int j = (i + 1) % 3, low = 0, high = 1 << halvings;
  vec3 from = corner[i].position, to = corner[j].position;
  float from_share = 0.0, to_share = 1.0;
  Point point;
  while (high - low > 1) {
    int at = (low + high) / 2;
    float share = mix(from_share, to_share, middle_share(from, to));
    point.position = middle(from, to);
    point.weight = vec3(0.0);
    point.weight[i] = 1.0 - share;
    point.weight[j] = share;
    if (at == number) break;
    if (at < number) {
      low = at;
      from = point.position;
      from_share = share;
    } else {
      high = at;
      to = point.position;
      to_share = share;
    }
  }
  point.pixel = on_grid(pixel_of(point.position));
  return point;
}

Point within(vec3 place) {
  Point point;
  point.weight = place / vec3(length(corner[0].position), length(corner[1].position), length(corner[2].position));
  point.weight /= point.weight.x + point.weight.y + point.weight.z;
  point.position = mat3(corner[0].position, corner[1].position, corner[2].position) * point.weight;
  point.pixel = on_grid(pixel_of(point.position));
  return point;
}

Point at_corner(int i) {
  Point point;
  point.position = corner[i].position;
  point.weight = vec3(0.0);
  point.weight[i] = 1.0;
  point.pixel = corner_pixel[i];
  return point;
}

Point point_at(vec3 place) {
  const float rounding = 1e-3;  // points lie at multiples of 1/64 on edges, and of 2/(3 * 64) from them
  for (int i = 0; i < 3; ++i) {
    if (place[i] > 1.0 - rounding) return at_corner(i);
  }
  for (int i = 0; i < 3; ++i) {
    if (place[(i + 2) % 3] > rounding) continue;
    return on_edge(i, int(round(place[(i + 1) % 3] * float(1 << patch_halvings[i]))), patch_halvings[i]);
  }
  return within(place);
}

void main() {
  Point point = point_at(gl_TessCoord);
  // Edges that are seen at five points may enclose what is not; a pixel's rounding then decides nothing that is drawn.
  if (!is_seen(point.pixel)) {
    point.pixel = mat3x2(corner_pixel[0], corner_pixel[1], corner_pixel[2]) * gl_TessCoord;
  }
  vertex.position = point.position;
  vertex.normal = mat3(corner[0].normal, corner[1].normal, corner[2].normal) * point.weight;
  vertex.tangent = mat3x4(corner[0].tangent, corner[1].tangent, corner[2].tangent) * point.weight;
  vertex.uv = mat3x2(corner[0].uv, corner[1].uv, corner[2].uv) * point.weight;
  vertex.color = mat3x4(corner[0].color, corner[1].color, corner[2].color) * point.weight;
  vertex.part = corner[0].part;
  gl_Position = clip_position(point.pixel, point.position);
}
