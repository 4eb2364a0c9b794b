#include "bench/flat_embree.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace omma::bench {
namespace {

constexpr int side = 4;

/// Towards the light, in the world.
const glm::vec3 sun = glm::normalize(glm::vec3(0.5f, 1.0f, 0.35f));

struct Shape {
  const glm::uvec3* triangles;
  std::vector<glm::vec3> normals;  ///< by vertex, camera frame, of any length
  glm::vec3 color;
  uint32_t first_triangle;
};

}  // namespace

struct FlatEmbree::State {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene tree = rtcNewScene(device);
  std::vector<Shape> shapes;  ///< by instance
  glm::vec3 sun_in_camera;

  ~State() {
    rtcReleaseScene(tree);
    rtcReleaseDevice(device);
  }

  /// Calls `see(index of the ray, packet, lane)` for every ray, met or not.
  template <typename See>
  void trace(std::span<const glm::vec3> directions, int width, const See& see) const;
};

FlatEmbree::FlatEmbree(const Scene& scene, const glm::dmat4& worldFromCamera, bool shades)
    : state_(std::make_unique<State>()) {
  const glm::dmat4 cameraFromWorld = glm::inverse(worldFromCamera);
  state_->sun_in_camera = glm::mat3(cameraFromWorld) * sun;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
    RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
    const glm::dmat4 cameraFromObject = cameraFromWorld * instance.worldFromObject;
    const glm::mat3 normals(glm::transpose(glm::inverse(glm::dmat3(cameraFromObject))));
    Shape shape{triangles, std::vector<glm::vec3>(shades ? mesh.positions.size() : 0),
                glm::vec3(scene.materials[size_t(mesh.material)].base_color), instance.first_triangle};
    tbb::parallel_for(size_t{0}, mesh.positions.size(), [&](size_t i) {
      positions[i] = glm::vec3(cameraFromObject * glm::dvec4(glm::dvec3(mesh.positions[i]), 1.0));
      if (shades) shape.normals[i] = normals * mesh.normals[i];
    });
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(state_->tree, geometry);
    rtcReleaseGeometry(geometry);
    state_->shapes.push_back(std::move(shape));
  }
  rtcCommitScene(state_->tree);
}

FlatEmbree::~FlatEmbree() = default;

template <typename See>
void FlatEmbree::State::trace(std::span<const glm::vec3> directions, int width, const See& see) const {
  const auto height = int(directions.size() / size_t(width));
  const auto trace = [&](int x0, int y0) {
    alignas(64) RTCRayHit16 packet;
    alignas(64) int valid[16];
    for (int lane = 0; lane < 16; ++lane) {
      const int x = std::min(x0 + lane % side, width - 1), y = std::min(y0 + lane / side, height - 1);
      const glm::vec3 direction = directions[size_t(y) * size_t(width) + size_t(x)];
      packet.ray.org_x[lane] = packet.ray.org_y[lane] = packet.ray.org_z[lane] = 0.0f;
      packet.ray.dir_x[lane] = direction.x;
      packet.ray.dir_y[lane] = direction.y;
      packet.ray.dir_z[lane] = direction.z;
      packet.ray.tnear[lane] = packet.ray.time[lane] = 0.0f;
      packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
      packet.ray.mask[lane] = ~0u;
      packet.ray.flags[lane] = 0;
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      valid[lane] = direction != glm::vec3(0.0f) ? -1 : 0;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    if (std::any_of(valid, valid + 16, [](int v) { return v != 0; })) {
      rtcIntersect16(valid, tree, &context, &packet);
    }
    for (int lane = 0; lane < 16; ++lane) {
      const int x = x0 + lane % side, y = y0 + lane / side;
      if (x < width && y < height) see(size_t(y) * size_t(width) + size_t(x), packet, lane);
    }
  };
  tbb::parallel_for(tbb::blocked_range2d<int>(0, (height + side - 1) / side, 4, 0, (width + side - 1) / side, 4),
                    [&](const tbb::blocked_range2d<int>& blocks) {
                      for (int by = blocks.rows().begin(); by < blocks.rows().end(); ++by) {
                        for (int bx = blocks.cols().begin(); bx < blocks.cols().end(); ++bx)
                          trace(bx * side, by * side);
                      }
                    });
}

void FlatEmbree::nearest(std::span<const glm::vec3> directions, int width, std::span<glm::uvec2> triangles) const {
  state_->trace(directions, width, [&](size_t ray, const RTCRayHit16& packet, int lane) {
    const uint32_t instance = packet.hit.geomID[lane];
    triangles[ray] = instance == RTC_INVALID_GEOMETRY_ID
                         ? glm::uvec2(~0u)
                         : glm::uvec2(state_->shapes[instance].first_triangle + packet.hit.primID[lane], instance);
  });
}

void FlatEmbree::lambert(std::span<const glm::vec3> directions, int width, std::span<glm::vec3> colors) const {
  constexpr float ambient = 0.25f, sky = 0.6f;
  state_->trace(directions, width, [&](size_t ray, const RTCRayHit16& packet, int lane) {
    const uint32_t instance = packet.hit.geomID[lane];
    if (instance == RTC_INVALID_GEOMETRY_ID) {
      colors[ray] = glm::vec3(sky);
      return;
    }
    const Shape& shape = state_->shapes[instance];
    const glm::uvec3 corner = shape.triangles[packet.hit.primID[lane]];
    const float u = packet.hit.u[lane], v = packet.hit.v[lane];
    glm::vec3 normal =
        (1.0f - u - v) * shape.normals[corner.x] + u * shape.normals[corner.y] + v * shape.normals[corner.z];
    if (glm::dot(normal, directions[ray]) > 0.0f) normal = -normal;
    const float cosine = std::max(0.0f, glm::dot(normal, state_->sun_in_camera)) / glm::length(normal);
    colors[ray] = shape.color * (ambient + cosine);
  });
}

}  // namespace omma::bench
