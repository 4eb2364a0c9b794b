// From fragments to surfaces, sixteen at a time, and through the shader. Included once for every SIMD target, by
// Highway's rules.
#if defined(OMMA_SOFTWARE_SHADE_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_SOFTWARE_SHADE_BLOCK_INL_H_
#undef OMMA_SOFTWARE_SHADE_BLOCK_INL_H_
#else
#define OMMA_SOFTWARE_SHADE_BLOCK_INL_H_
#endif

#include <cstddef>
#include <cstring>

#include "omma/software/shader-inl.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

HWY_INLINE real loaded(const float* from) {
  real r;
  for (size_t k = 0; k < registers; ++k) r.v[k] = hn::LoadU(FloatTag(), from + k * lanes);
  return r;
}
HWY_INLINE real gathered(const float* from, const int32_t* places) {
  real r;
  for (size_t k = 0; k < registers; ++k) {
    r.v[k] = hn::GatherIndex(FloatTag(), from, hn::LoadU(IntTag(), places + k * lanes));
  }
  return r;
}

/// How the rays of a square change per pixel to the right and down: differences to the neighbours on both sides, or on
/// one where the other has no ray or jumps to another part of the world.
class RayChanges {
 public:
  RayChanges(const RayBlock& block, const SquareBorder& border) {
    constexpr int side = RayBlock::side;
    const auto surround = [](float(&ray)[side + 2][side + 2], const float(&around)[4][side]) HWY_ATTR {
      for (int i = 0; i < side; ++i) {
        ray[i + 1][0] = around[SquareBorder::left][i];
        ray[i + 1][side + 1] = around[SquareBorder::right][i];
      }
      std::memcpy(&ray[0][1], around[SquareBorder::above], sizeof around[0]);
      std::memcpy(&ray[side + 1][1], around[SquareBorder::below], sizeof around[0]);
    };
    surround(ray_[0], border.x);
    surround(ray_[1], border.y);
    surround(ray_[2], border.z);
    each_row([&](int leaf, int first, int x, int y) {
      std::memcpy(&ray_[0][y + 1][x + 1], &block.x[leaf][first], sizeof(float) * RayBlock::leaf_side);
      std::memcpy(&ray_[1][y + 1][x + 1], &block.y[leaf][first], sizeof(float) * RayBlock::leaf_side);
      std::memcpy(&ray_[2][y + 1][x + 1], &block.z[leaf][first], sizeof(float) * RayBlock::leaf_side);
    });
    alignas(64) float rows[6][RayBlock::side][RayBlock::side];
    for (int y = 0; y < RayBlock::side; ++y) {
      const vec3 here = ray(y, 0);
      const vec3 dx = between(ray(y, -1), here, ray(y, 1)), dy = between(ray(y - 1, 0), here, ray(y + 1, 0));
      store(dx.x, rows[0][y]);
      store(dx.y, rows[1][y]);
      store(dx.z, rows[2][y]);
      store(dy.x, rows[3][y]);
      store(dy.y, rows[4][y]);
      store(dy.z, rows[5][y]);
    }
    each_row([&](int leaf, int first, int x, int y) {
      for (int c = 0; c < 6; ++c) {
        std::memcpy(&changes_[c][16 * leaf + first], &rows[c][y][x], sizeof(float) * RayBlock::leaf_side);
      }
    });
  }

  HWY_INLINE vec3 dx(const int32_t* pixels) const {
    return {gathered(changes_[0], pixels), gathered(changes_[1], pixels), gathered(changes_[2], pixels)};
  }
  /// Of sixteen pixels one after another.
  HWY_INLINE vec3 dx_from(int32_t pixel) const {
    return {loaded(&changes_[0][pixel]), loaded(&changes_[1][pixel]), loaded(&changes_[2][pixel])};
  }
  HWY_INLINE vec3 dy_from(int32_t pixel) const {
    return {loaded(&changes_[3][pixel]), loaded(&changes_[4][pixel]), loaded(&changes_[5][pixel])};
  }
  HWY_INLINE vec3 dy(const int32_t* pixels) const {
    return {gathered(changes_[3], pixels), gathered(changes_[4], pixels), gathered(changes_[5], pixels)};
  }

 private:
  static constexpr int stride = RayBlock::side + 2;

  /// Calls `each(leaf, first ray, x, y)` for the rows of all leaves.
  template <typename Each>
  static HWY_INLINE void each_row(const Each& each) {
    for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
      for (int first = 0; first < 16; first += RayBlock::leaf_side) {
        each(leaf, first, RayBlock::x_of(leaf, first), RayBlock::y_of(leaf, first));
      }
    }
  }
  HWY_INLINE vec3 ray(int row, int column) const {
    return {loaded(&ray_[0][row + 1][column + 1]), loaded(&ray_[1][row + 1][column + 1]),
            loaded(&ray_[2][row + 1][column + 1])};
  }
  static HWY_INLINE vec3 between(const vec3& left, const vec3& here, const vec3& right) {
    const vec3 before = here - left, after = right - here;
    const real before2 = dot(before, before), after2 = dot(after, after), zero(0.0f);
    // Steps four times as long are jumps, and so is one from or to no ray at all.
    const truth has_before = (dot(left, left) > zero) & (before2 < real(16.0f) * after2 + 1e-30);
    const truth has_after = (dot(right, right) > zero) & (after2 < real(16.0f) * before2 + 1e-30);
    const vec3 one_side = choose(has_before, before, choose(has_after, after, vec3(zero)));
    return choose(has_before & has_after, (before + after) * real(0.5f), one_side);
  }

  float ray_[3][stride][stride];
  alignas(64) float changes_[6][Fragments::pixels];
};

/// The constants of sixteen fragments' triangles: one triangle's, or each its own.
struct OneRecord {
  const float* from;
  HWY_INLINE real operator()(size_t field) const { return real(from[field]); }
};
struct OwnRecords {
  const float* from;
  const int32_t* places;
  HWY_INLINE real operator()(size_t field) const { return gathered(from + field, places); }
};

#define OMMA_FIELD(name) offsetof(TriangleRecord, name) / sizeof(float)

template <typename Records>
HWY_INLINE vec2 vec2_of(const Records& records, size_t field) {
  return {records(field), records(field + 1)};
}
template <typename Records>
HWY_INLINE vec3 vec3_of(const Records& records, size_t field) {
  return {records(field), records(field + 1), records(field + 2)};
}
template <typename Records>
HWY_INLINE vec4 vec4_of(const Records& records, size_t field) {
  return {vec3_of(records, field), records(field + 3)};
}

/// Which parts of a surface are wanted.
struct SurfaceParts {
  bool tangents, colors, changes;
};

/// Where rays meet triangles, as in shaders/technique/triangle_surface.glsl.
template <typename Records>
HWY_INLINE Shader::Surface surface_of(const Records& t, const SurfaceParts& parts, const vec3& direction,
                                      const vec3& dx, const vec3& dy) {
  const mat3 planes(vec3_of(t, OMMA_FIELD(sum)), vec3_of(t, OMMA_FIELD(plane_b)), vec3_of(t, OMMA_FIELD(plane_c)));
  const vec3 inside = direction * planes, inside_dx = dx * planes, inside_dy = dy * planes;
  const real scale = real(1.0f) / inside.x;
  const vec2 bc = vec2(inside.y, inside.z) * scale;
  const vec2 bc_dx = (vec2(inside_dx.y, inside_dx.z) - bc * inside_dx.x) * scale;
  const vec2 bc_dy = (vec2(inside_dy.y, inside_dy.z) - bc * inside_dy.x) * scale;

  Shader::Surface surface;
  surface.position = direction * (t(OMMA_FIELD(volume)) * scale);
  const vec3 normal = vec3_of(t, OMMA_FIELD(normal)) + vec3_of(t, OMMA_FIELD(normal_b)) * bc.x +
                      vec3_of(t, OMMA_FIELD(normal_c)) * bc.y;
  // Normals that cancel say nothing; the triangle itself does.
  const vec3 flat = planes[0] * choose(t(OMMA_FIELD(volume)) < real(0.0f), real(1.0f), real(-1.0f));
  surface.normal = normalize(choose(dot(normal, normal) > real(1e-30), normal, flat));
  surface.plane = planes[0];
  surface.uv = vec2_of(t, OMMA_FIELD(uv));
  const vec2 uv_b = vec2_of(t, OMMA_FIELD(uv_b)), uv_c = vec2_of(t, OMMA_FIELD(uv_c));
  surface.uv += uv_b * bc.x + uv_c * bc.y;
  surface.uv_dx = uv_b * bc_dx.x + uv_c * bc_dx.y;
  surface.uv_dy = uv_b * bc_dy.x + uv_c * bc_dy.y;
  surface.tangent = vec4(real(0.0f));
  if (parts.tangents) {
    const vec4 tangent = vec4_of(t, OMMA_FIELD(tangent));
    surface.tangent = {
        xyz_of(tangent) + vec3_of(t, OMMA_FIELD(tangent_b)) * bc.x + vec3_of(t, OMMA_FIELD(tangent_c)) * bc.y,
        tangent.w};
  }
  surface.color = vec4(real(1.0f));
  if (parts.colors) {
    surface.color =
        vec4_of(t, OMMA_FIELD(color)) + vec4_of(t, OMMA_FIELD(color_b)) * bc.x + vec4_of(t, OMMA_FIELD(color_c)) * bc.y;
  }
  if (parts.changes) {
    const real distance = t(OMMA_FIELD(volume)) * scale;
    surface.position_dx = (dx - direction * (inside_dx.x * scale)) * distance;
    surface.position_dy = (dy - direction * (inside_dy.x * scale)) * distance;
    surface.barycentric = vec3(real(1.0f) - bc.x - bc.y, bc);
    surface.barycentric_dx = vec3(-bc_dx.x - bc_dx.y, bc_dx);
    surface.barycentric_dy = vec3(-bc_dy.x - bc_dy.y, bc_dy);
  }
  return surface;
}

/// `yes` where the condition holds.
HWY_INLINE Shader::Surface choose(const truth& condition, const Shader::Surface& yes, const Shader::Surface& no,
                                  const SurfaceParts& parts) {
  Shader::Surface surface;
  surface.position = choose(condition, yes.position, no.position);
  surface.normal = choose(condition, yes.normal, no.normal);
  surface.plane = choose(condition, yes.plane, no.plane);
  surface.tangent = choose(condition, yes.tangent, no.tangent);
  surface.uv = choose(condition, yes.uv, no.uv);
  surface.uv_dx = choose(condition, yes.uv_dx, no.uv_dx);
  surface.uv_dy = choose(condition, yes.uv_dy, no.uv_dy);
  surface.color = choose(condition, yes.color, no.color);
  if (parts.changes) {
    surface.position_dx = choose(condition, yes.position_dx, no.position_dx);
    surface.position_dy = choose(condition, yes.position_dy, no.position_dy);
    surface.barycentric = choose(condition, yes.barycentric, no.barycentric);
    surface.barycentric_dx = choose(condition, yes.barycentric_dx, no.barycentric_dx);
    surface.barycentric_dy = choose(condition, yes.barycentric_dy, no.barycentric_dy);
  }
  return surface;
}

/// Of sixteen fragments from `at` on.
HWY_INLINE Shader::Surface surfaces_of(const Fragments& fragments, uint32_t at, const SurfaceParts& parts,
                                       const vec3& direction, const RayChanges& changes) {
  constexpr size_t record_floats = sizeof(TriangleRecord) / sizeof(float);
  /// Computing for all sixteen what a few are of is less work than fetching for each what its own triangle has.
  constexpr int few = 4;
  const int32_t* pixels = &fragments.pixel[at];
  const uint32_t* record = &fragments.record[at];
  bool in_a_row = true;
  int changed = 0;
  for (int i = 1; i < 16; ++i) {
    in_a_row &= pixels[i] == pixels[0] + i;
    changed += record[i] != record[i - 1];
  }
  const vec3 dx = in_a_row ? changes.dx_from(pixels[0]) : changes.dx(pixels);
  const vec3 dy = in_a_row ? changes.dy_from(pixels[0]) : changes.dy(pixels);
  const auto* records = reinterpret_cast<const float*>(fragments.records().data());
  const auto of_one = [&](uint32_t number) HWY_ATTR {
    return surface_of(OneRecord{records + number * record_floats}, parts, direction, dx, dy);
  };
  if (changed <= few) {
    Shader::Surface surface = of_one(record[0]);
    for (int i = 1; i < 16 && changed > 0; ++i) {
      if (record[i] == record[i - 1]) continue;
      --changed;
      surface = choose(from_bits(0xffffu << i & 0xffffu), of_one(record[i]), surface, parts);
    }
    return surface;
  }
  int32_t places[16];
  for (int i = 0; i < 16; ++i) places[i] = int32_t(record[i] * record_floats);
  return surface_of(OwnRecords{records, places}, parts, direction, dx, dy);
}

void shade_fragments(const ShadedScene& scene, const RayBlock& block, const SquareBorder& border,
                     Fragments& fragments) {
  Shader shader(scene);
  const RayChanges changes(block, border);
  for (const FragmentGroup& group : fragments.groups()) {
    const bool is_background = group.material == background_material;
    if (!is_background) shader.set_material(scene, group.material, group.reflects);
    const SurfaceParts parts{shader.needs_tangents(), fragments.has_colors(), shader.needs_changes()};
    for (uint32_t at = group.first; at < group.first + group.count; at += 16) {
      const vec3 direction(loaded(&fragments.x[at]), loaded(&fragments.y[at]), loaded(&fragments.z[at]));
      const vec4 color = is_background ? vec4(shader.background(direction), real(1.0f))
                                       : shader.shade(surfaces_of(fragments, at, parts, direction, changes));
      for (size_t k = 0; k < registers; ++k) {
        hn::StoreU(color.x.v[k], FloatTag(), &fragments.red[at + k * lanes]);
        hn::StoreU(color.y.v[k], FloatTag(), &fragments.green[at + k * lanes]);
        hn::StoreU(color.z.v[k], FloatTag(), &fragments.blue[at + k * lanes]);
        hn::StoreU(color.w.v[k], FloatTag(), &fragments.coverage[at + k * lanes]);
      }
    }
  }
}
#undef OMMA_FIELD

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
