// The squares of the image that are the nodes of its tree of cones. Matches technique/nonlinear/image_tiles.cpp.
layout(binding = 23) uniform samplerBuffer linear_texels;
uniform vec2 square_shift;  // px: how far beside its pixels' centres a pass samples

// Corner and side of a node's square, pixels of the target.
ivec3 square_of(uint data) {
  return ivec3(data & 0x3fffu, data >> 14 & 0x3fffu, 1 << int(data >> 28));
}

// Whether a node's square is drawn whole where a triangle covers it: the camera sees something everywhere in it, or
// nearly so.
bool is_whole(int node) { return texelFetch(linear_texels, 3 * node + 1).w != 0.0; }

// The rays of a square as a linear function of the pixel: with u and v from -1 to 1 across it, a vector at most `off`
// from middle + u across + v down is along the ray. Where there is none `off` is negative.
struct LinearRays {
  vec3 middle, across, down;
  float off;
};

LinearRays linear_rays(int node) {
  vec4 middle = texelFetch(linear_texels, 3 * node);
  return LinearRays(middle.xyz, texelFetch(linear_texels, 3 * node + 1).xyz, texelFetch(linear_texels, 3 * node + 2).xyz,
                    middle.w);
}

// By how much a plane's side of those rays must be missed at least to be missed by all within `margin` px.
float side_leeway(LinearRays rays, vec3 plane, float side, float margin) {
  return rays.off + 1e-6 + 2.0 * margin / side * (abs(dot(plane, rays.across)) + abs(dot(plane, rays.down)));
}
