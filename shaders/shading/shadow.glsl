// How much of a light reaches a surface: maps of what the light sees, compared with where the surface's own plane lies
// on the ray of each texel. A plane then never shadows itself, however steeply the light falls, and what remains to be
// allowed for is how far the map's edges and depths are off: a part of a texel, along the normal. Matches
// ShadowMapRecord in shading/shadow_layers.h and software/shader-inl.h.

const float LEVEL_BIAS = 0.05, STEEP_BIAS = 0.5;  // texels: where light falls straight, where it grazes

struct ShadowMap {
  vec4 right, down, ahead;  // rows of mapFromCamera
  real focal, centre;       // texels
  truth flat_map;           // perspective, or the paraboloid's stereographic
  real near;                // metres
};

#ifndef __cplusplus
layout(binding = 26) uniform sampler2DArray shadow_maps;  // near depth / distance; flat maps: / distance ahead

int first_map_of_light(uint number) {
  return int(light_of(number).cone.z);
}
int maps_of_light(uint number) {
  return int(light_of(number).cone.w);
}
vec4 map_texel(int number, int part) {
  return texelFetch(light_texels, 4 * (int(frame.counts.x) + number) + part);
}
vec4 map_texel(float number, int part) {
  return map_texel(int(number), part);
}
float shadow_map_side() {
  return float(textureSize(shadow_maps, 0).x);
}
float shadow_texel(float number, vec2 texel) {
  return texelFetch(shadow_maps, ivec3(ivec2(texel), int(number)), 0).r;
}
#endif

// Of a light's maps the one that looks at a place the straightest.
SHADING real map_towards(int first, int count, vec3 position) {
  real nearest = real(first), farthest_ahead = real(-1e30);
  for (int i = first; i < first + count; ++i) {
    real ahead = dot(map_texel(i, 2), vec4(position, 1.0));
    nearest = choose(ahead > farthest_ahead, real(i), nearest);
    farthest_ahead = max(ahead, farthest_ahead);
  }
  return nearest;
}

SHADING ShadowMap shadow_map(real number) {
  vec4 lens = map_texel(number, 3);
  ShadowMap map;
  map.right = map_texel(number, 0);
  map.down = map_texel(number, 1);
  map.ahead = map_texel(number, 2);
  map.focal = lens.x;
  map.centre = lens.y;
  map.flat_map = lens.z > 0.5;
  map.near = lens.w;
  return map;
}

SHADING vec3 to_map(ShadowMap map, vec4 v) {
  return vec3(dot(map.right, v), dot(map.down, v), dot(map.ahead, v));
}

// What a texel's distance is a multiple of.
SHADING vec3 ray_of_texel(ShadowMap map, vec2 texel) {
  vec2 at = (texel + 0.5 - map.centre) / map.focal;
  real quarter = 0.25 * dot(at, at);
  return choose(map.flat_map, vec3(at.x, at.y, 1.0), vec3(at.x, at.y, 1.0 - quarter) / (1.0 + quarter));
}

// Share of a light that reaches the surface: a quadratic B-spline over 3 x 3 texels.
SHADING real light_reaching(uint light, Surface surface) {
  int count = maps_of_light(light);
  if (count == 0) return real(1.0);
  real number = map_towards(first_map_of_light(light), count, surface.position);
  ShadowMap map = shadow_map(number);
  vec3 place = to_map(map, vec4(surface.position, 1.0));
  vec3 plane = normalize(to_map(map, vec4(surface.plane, 0.0)));
  real above = dot(plane, place);
  plane = choose(above < 0.0, -plane, plane);
  real far = length(place);
  // A texel's side there, across the light, in metres; and the distance as the map counts it.
  real scale = choose(map.flat_map, place.z, 0.5 * (far + place.z));
  real texel = scale / map.focal;
  real distance = choose(map.flat_map, place.z, far);
  real steepness = length(cross(plane, place)) / far;
  real height = abs(above) - texel * (LEVEL_BIAS + STEEP_BIAS * steepness);

  vec2 at = map.centre + map.focal * vec2(place.x, place.y) / scale;
  real side = real(shadow_map_side());
  // Beyond a sun's map nothing casts shadows, beyond a spot's there is no light.
  truth beyond = min(min(at.x, at.y), side - max(at.x, at.y)) < 0.0;
  vec2 middle = vec2(floor(at.x), floor(at.y));
  vec2 part = at - middle - 0.5;
  vec2 weight[3] = {0.5 * (0.5 - part) * (0.5 - part), 0.75 - part * part, 0.5 * (0.5 + part) * (0.5 + part)};
  real reached = real(0.0);
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      vec2 neighbour = middle + vec2(real(i - 1), real(j - 1));
      real along = dot(plane, ray_of_texel(map, neighbour));
      // Where the ray hardly meets the plane, or never does, the surface has long ended.
      real reach = min(height / max(along, 1e-6), 2.0 * distance);
      real stored = shadow_texel(number, clamp(neighbour, vec2(0.0), vec2(side - 1.0)));
      reached += choose(stored * reach <= map.near, weight[i].x * weight[j].y, real(0.0));
    }
  }
  return choose(beyond, real(1.0), reached);
}
