// How far away a group is, in steps of a quarter of an octave: near ones are looked at first, to hide far ones.
const uint DISTANCE_STEPS = 512u;

uint distance_step(Box box, Placement placement) {
  vec3 c = to_camera(placement, box.centre);
  float radius = 0.0;
  for (int i = 0; i < 3; ++i) radius += box.half_size[i] * length(placement.column[i]);
  float nearest = (length(c) - radius) / placement.scale;
  return nearest > 0.0 ? uint(clamp(floor(4.0 * log2(nearest)) + 256.0, 0.0, float(DISTANCE_STEPS - 1u))) : 0u;
}
