#include "omma/technique/gpu_scene.h"

#include <algorithm>
#include <cmath>

#include "omma/base/error.h"
#include "omma/scene/lights.h"
#include "omma/technique/target.h"

namespace omma {
namespace {

/// Four texels, as in common/geometry.glsl.
struct InstanceRecord {
  glm::vec4 cameraFromObject[3];
  glm::uvec4 numbers;
};

/// std140, as in common/frame.glsl.
struct FrameBlock {
  glm::mat4 worldFromCamera;
  glm::vec4 ambient, background;
  glm::uvec4 counts;
  glm::vec4 reflection;
};

/// The octahedral map to two signed 16-bit numbers; zero becomes +Z. Inverse of unpack_direction in
/// common/geometry.glsl.
uint32_t pack_direction(glm::vec3 v) {
  const float sum = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
  if (!(sum > 0.0f)) return 0;
  glm::vec2 e = glm::vec2(v) / sum;
  if (v.z < 0.0f) {
    e = glm::vec2((1.0f - std::abs(e.y)) * (e.x < 0.0f ? -1.0f : 1.0f),
                  (1.0f - std::abs(e.x)) * (e.y < 0.0f ? -1.0f : 1.0f));
  }
  return glm::packSnorm2x16(e);
}

glm::uvec4 pack_attributes(const Mesh& mesh, size_t i) {
  uint32_t tangent = 0;
  if (!mesh.tangents.empty()) {
    tangent = (pack_direction(glm::vec3(mesh.tangents[i])) & ~1u) | (mesh.tangents[i].w < 0.0f ? 1u : 0u);
  }
  const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0.0f) : mesh.uvs[i];
  return {pack_direction(mesh.normals[i]), tangent, glm::floatBitsToUint(uv.x), glm::floatBitsToUint(uv.y)};
}

enum Attribute : GLuint { position_attribute, packed_attribute, color_attribute, part_attribute };

}  // namespace

GpuScene::GpuScene(const Scene& scene, const gl::Context& context)
    : scene_(&scene), context_(&context), materials_(scene, context), frame_(sizeof(FrameBlock)) {
  upload_meshes();
  list_parts();
  place_parts();
}

void GpuScene::upload_meshes() {
  const Scene& scene = *scene_;
  first_vertex_.clear();
  first_index_.clear();
  size_t vertices = 0, triangles = 0;
  for (const Mesh& mesh : scene.meshes) {
    first_vertex_.push_back(uint32_t(vertices));
    first_index_.push_back(uint32_t(3 * triangles));
    vertices += mesh.positions.size();
    triangles += mesh.triangles.size();
  }
  if (const auto most = size_t(context_->limits().buffer_texels); vertices > most || triangles > most) {
    throw MachineError("the scene has {} vertices and {} triangles, this driver's buffers hold {} of each", vertices,
                       triangles, most);
  }
  positions_ = gl::Buffer(vertices * sizeof(glm::vec3));
  attributes_ = gl::Buffer(vertices * sizeof(glm::uvec4));
  colors_ = gl::Buffer(vertices * sizeof(glm::u8vec4));
  indices_ = gl::Buffer(triangles * sizeof(glm::uvec3));

  bounds_.resize(scene.meshes.size());
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    upload_vertices(m);
    measure(m);
    if (mesh.colors.empty()) {
      colors_.write(std::span<const glm::u8vec4>(std::vector<glm::u8vec4>(mesh.positions.size(), glm::u8vec4(255))),
                    first_vertex_[m] * sizeof(glm::u8vec4));
    } else {
      colors_.write(std::span<const glm::u8vec4>(mesh.colors), first_vertex_[m] * sizeof(glm::u8vec4));
    }
    std::vector<glm::uvec3> corners(mesh.triangles);
    for (glm::uvec3& triangle : corners) triangle += first_vertex_[m];
    indices_.write(std::span<const glm::uvec3>(corners), first_index_[m] * sizeof(uint32_t));
  }
  position_texels_ = gl::Texture::of_buffer(GL_RGB32F, positions_);
  attribute_texels_ = gl::Texture::of_buffer(GL_RGBA32UI, attributes_);
  color_texels_ = gl::Texture::of_buffer(GL_RGBA8, colors_);
  triangle_texels_ = gl::Texture::of_buffer(GL_RGB32UI, indices_);
}

void GpuScene::list_parts() {
  const Scene& scene = *scene_;
  has_blending_ = false;
  parts_.clear();
  std::vector<glm::uvec2> part_records;
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
    const auto count = uint32_t(mesh.triangles.size());
    has_blending_ |= scene.materials[size_t(mesh.material)].alpha == Material::Alpha::blend;
    for (uint32_t first = 0; first < count; first += part_triangles) {
      Part part;
      part.instance = int(i);
      part.material = mesh.material;
      part.first_index = first_index_[size_t(instance.mesh)] + 3 * first;
      part.index_count = 3 * std::min(part_triangles, count - first);
      part.first_triangle = instance.first_triangle + first;
      parts_.push_back(part);
      part_records.emplace_back(uint32_t(i), part.first_triangle);
    }
  }
  part_records_ = gl::Buffer(std::span<const glm::uvec2>(part_records));
  instances_ = gl::Buffer(scene.instances.size() * sizeof(InstanceRecord));
  instance_texels_ = gl::Texture::of_buffer(GL_RGBA32UI, instances_);
  make_vertex_array();
}

void GpuScene::make_vertex_array() {
  vertex_array_ = gl::create_vertex_array();
  const GLuint array = vertex_array_.id();
  const auto add = [array](GLuint attribute, const gl::Buffer& buffer, GLsizei stride) {
    glVertexArrayVertexBuffer(array, attribute, buffer.id(), 0, stride);
    glVertexArrayAttribBinding(array, attribute, attribute);
    glEnableVertexArrayAttrib(array, attribute);
  };
  add(position_attribute, positions_, sizeof(glm::vec3));
  glVertexArrayAttribFormat(array, position_attribute, 3, GL_FLOAT, GL_FALSE, 0);
  add(packed_attribute, attributes_, sizeof(glm::uvec4));
  glVertexArrayAttribIFormat(array, packed_attribute, 4, GL_UNSIGNED_INT, 0);
  add(color_attribute, colors_, sizeof(glm::u8vec4));
  glVertexArrayAttribFormat(array, color_attribute, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0);
  // Every part is drawn as one instance whose number (baseInstance) is the part's.
  add(part_attribute, part_records_, sizeof(glm::uvec2));
  glVertexArrayAttribIFormat(array, part_attribute, 2, GL_UNSIGNED_INT, 0);
  glVertexArrayBindingDivisor(array, part_attribute, 1);
  glVertexArrayElementBuffer(array, indices_.id());
}

bool GpuScene::reflects(int material) const {
  if (reflection_ == nullptr) return false;
  return std::any_of(scene_->instances.begin(), scene_->instances.end(), [&](const Instance& instance) {
    return instance.object == reflection_->object && scene_->meshes[size_t(instance.mesh)].material == material;
  });
}

void GpuScene::upload_vertices(size_t m) {
  const Mesh& mesh = scene_->meshes[m];
  std::vector<glm::uvec4> packed(mesh.positions.size());
  for (size_t i = 0; i < packed.size(); ++i) packed[i] = pack_attributes(mesh, i);
  attributes_.write(std::span<const glm::uvec4>(packed), first_vertex_[m] * sizeof(glm::uvec4));
  positions_.write(std::span<const glm::vec3>(mesh.positions), first_vertex_[m] * sizeof(glm::vec3));
}

void GpuScene::measure(size_t m) {
  const Mesh& mesh = scene_->meshes[m];
  bounds_[m].assign((mesh.triangles.size() + part_triangles - 1) / part_triangles, {});
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) bounds_[m][t / part_triangles].add(glm::dvec3(mesh.positions[mesh.triangles[t][c]]));
  }
}

void GpuScene::place_parts() {
  for (Part& part : parts_) {
    const Instance& instance = scene_->instances[size_t(part.instance)];
    const uint32_t first = part.first_triangle - instance.first_triangle;
    part.bounds = bounds_[size_t(instance.mesh)][first / part_triangles].transformed(instance.worldFromObject);
    part.mirrored = glm::determinant(glm::dmat3(instance.worldFromObject)) < 0.0;
  }
}

void GpuScene::update(const SceneChanges& changes) {
  if (changes.textures) {
    materials_ = Materials(*scene_, *context_);
  } else if (changes.materials) {
    materials_.update();
  }
  if (!changes.replaced.empty()) {
    upload_meshes();
  } else {
    for (const int mesh : changes.deformed) {
      upload_vertices(size_t(mesh));
      measure(size_t(mesh));
    }
  }
  if (changes.listed || !changes.replaced.empty()) list_parts();
  if (changes.of_shape()) place_parts();
}

void GpuScene::set_view(const glm::dmat4& worldFromCamera, const std::optional<glm::vec3>& background) {
  worldFromCamera_ = worldFromCamera;
  const glm::dmat4 cameraFromWorld = glm::inverse(worldFromCamera);
  std::vector<InstanceRecord> records(scene_->instances.size());
  for (size_t i = 0; i < records.size(); ++i) {
    const Instance& instance = scene_->instances[i];
    const glm::mat4 rows = glm::transpose(glm::mat4(cameraFromWorld * instance.worldFromObject));
    for (int r = 0; r < 3; ++r) records[i].cameraFromObject[r] = rows[r];
    records[i].numbers = {instance.first_triangle, first_index_[size_t(instance.mesh)] / 3,
                          uint32_t(scene_->meshes[size_t(instance.mesh)].material), uint32_t(instance.object)};
  }
  instances_.write(std::span<const InstanceRecord>(records));

  std::vector<LightRecord> lights;
  for (const Light& light : lights_of(*scene_)) lights.push_back(light_record(light, cameraFromWorld));
  std::vector<ShadowMapRecord> maps;
  if (shadows_ != nullptr) maps = shadow_map_records(shadows_->layers, worldFromCamera, near_depth, lights);
  light_texels_.reserve(lights.size() * sizeof(LightRecord) + maps.size() * sizeof(ShadowMapRecord));
  light_texels_.write(std::span<const LightRecord>(lights));
  light_texels_.write(std::span<const ShadowMapRecord>(maps), lights.size() * sizeof(LightRecord));

  FrameBlock frame{glm::mat4(worldFromCamera), glm::vec4(scene_->ambient, 0.0f),
                   background ? glm::vec4(*background, 1.0f) : glm::vec4(0.0f), glm::uvec4(lights.size(), 0, 0, 0),
                   glm::vec4(0.0f)};
  if (reflection_ != nullptr) {
    frame.counts.y = uint32_t(reflection_->object);
    frame.reflection = {reflection_->focal, reflection_->size, reflection_->last_level, 0.0f};
  }
  if (hidden_) frame.counts.z = uint32_t(*hidden_);
  frame_.write(std::span<const FrameBlock>(&frame, 1));
}

void GpuScene::bind() const {
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_.id());
  instance_texels_.bind(14);
  light_texels_.bind(15);
  if (shadows_ != nullptr) shadows_->maps.bind(26);
  if (reflection_ != nullptr) {
    reflection_->maps.bind(27);
    glBindSampler(27, 0);
  }
}

void GpuScene::bind_vertex_textures() const {
  position_texels_.bind(5);
  attribute_texels_.bind(6);
  color_texels_.bind(7);
  triangle_texels_.bind(9);
}

size_t GpuScene::bytes() const {
  return positions_.bytes() + attributes_.bytes() + colors_.bytes() + indices_.bytes() + part_records_.bytes() +
         instances_.bytes() + materials_.bytes();
}

}  // namespace omma
