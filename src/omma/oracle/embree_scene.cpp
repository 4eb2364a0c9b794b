#include "omma/oracle/embree_scene.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "omma/base/error.h"
#include "omma/scene/coverage.h"

namespace omma {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr int block = 4;  // rays go in squares of 4 x 4: sixteen that are close to each other

/// Releases an Embree object when it goes.
template <typename T, void (*Release)(T)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(T object) : object_(object) {}
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() {
    if (object_ != nullptr) Release(object_);
  }
  operator T() const { return object_; }

 private:
  T object_ = nullptr;
};

using Device = Handle<RTCDevice, rtcReleaseDevice>;
using Tree = Handle<RTCScene, rtcReleaseScene>;
using Geometry = Handle<RTCGeometry, rtcReleaseGeometry>;

/// What a mesh's rays need to know; Embree hands it to the filter.
struct MeshData {
  const Scene* scene;
  const Mesh* mesh;
  Material::Alpha alpha;
  bool cull;  ///< rays pass its back faces
};

/// A point where a ray meets a triangle, as Embree tells of it.
struct Candidate {
  uint32_t triangle;  ///< of its mesh
  float u, v;
  float facing;  ///< ray times geometric normal, both in the object's own frame, where the winding is as modelled
};

/// False for what a ray passes: back faces of single-sided materials, holes, blended surfaces.
bool stops(const MeshData& data, const Candidate& candidate, Solid solid) {
  if (data.cull && candidate.facing >= 0.0f) return false;
  if (data.alpha == Material::Alpha::opaque) return true;
  if (data.alpha == Material::Alpha::blend && solid == Solid::opaque) return false;
  const float cutoff = coverage_cutoff(data.scene->materials[size_t(data.mesh->material)]);
  return coverage(*data.scene, *data.mesh, candidate.triangle, candidate.u, candidate.v) >= cutoff;
}

/// What a query asks for, behind Embree's own context.
struct Query {
  RTCIntersectContext context;
  Solid solid = Solid::opaque;
  std::vector<RayHit>* collected = nullptr;  ///< receives blended surfaces; the ray then stops at nothing
};

/// Takes back the hits that a ray passes.
void filter(const RTCFilterFunctionNArguments* arguments) {
  const auto& data = *static_cast<const MeshData*>(arguments->geometryUserPtr);
  const auto& query = *reinterpret_cast<const Query*>(arguments->context);
  const unsigned count = arguments->N;
  RTCRayN* ray = arguments->ray;
  RTCHitN* hit = arguments->hit;
  for (unsigned i = 0; i < count; ++i) {
    if (arguments->valid[i] != -1) continue;
    const Candidate candidate{RTCHitN_primID(hit, count, i), RTCHitN_u(hit, count, i), RTCHitN_v(hit, count, i),
                              RTCRayN_dir_x(ray, count, i) * RTCHitN_Ng_x(hit, count, i) +
                                  RTCRayN_dir_y(ray, count, i) * RTCHitN_Ng_y(hit, count, i) +
                                  RTCRayN_dir_z(ray, count, i) * RTCHitN_Ng_z(hit, count, i)};
    if (query.collected == nullptr) {
      if (!stops(data, candidate, query.solid)) arguments->valid[i] = 0;
      continue;
    }
    if (data.alpha == Material::Alpha::blend && !(data.cull && candidate.facing >= 0.0f)) {
      const uint32_t instance = RTCHitN_instID(hit, count, i, 0);
      query.collected->push_back(
          {data.scene->instances[instance].first_triangle + candidate.triangle, instance, RTCRayN_tfar(ray, count, i)});
    }
    arguments->valid[i] = 0;
  }
}

Query make_query(Solid solid, RTCIntersectContextFlags flags) {
  Query query;
  rtcInitIntersectContext(&query.context);
  query.context.flags = flags;
  query.solid = solid;
  return query;
}

glm::vec3 at(std::span<const glm::vec3> values, size_t i) { return values.empty() ? glm::vec3(0.0f) : values[i]; }

}  // namespace

struct EmbreeScene::State {
  const Scene* scene;
  Device device;
  std::vector<MeshData> meshes;
  std::vector<Geometry> geometries;  ///< one per mesh
  std::vector<Tree> trees;           ///< one per mesh
  std::vector<Geometry> instances;
  std::vector<glm::mat3> objectFromCamera;  ///< of each instance, for directions
  Tree top;
  bool has_blending = false;

  void build(size_t m) {
    const Mesh& mesh = scene->meshes[m];
    geometries[m] = Geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    RTCGeometry geometry = geometries[m];
    // Embree reads four floats at the last vertex, so it keeps its own copy.
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
    if (positions == nullptr || triangles == nullptr)
      throw MachineError("Embree has no memory for mesh '{}'", mesh.name);
    std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    rtcSetGeometryUserData(geometry, &meshes[m]);
    rtcCommitGeometry(geometry);
    trees[m] = new_tree();
    rtcAttachGeometry(trees[m], geometry);
    rtcCommitScene(trees[m]);
  }

  Tree new_tree() const {
    Tree tree(rtcNewScene(device));
    rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    return tree;
  }
};

EmbreeScene::EmbreeScene(const Scene& scene) : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.scene = &scene;
  state.device = Device(rtcNewDevice(nullptr));
  if (state.device == nullptr) throw MachineError("Embree does not start on this processor");
  for (const Mesh& mesh : scene.meshes) {
    const Material& material = scene.materials[size_t(mesh.material)];
    state.meshes.push_back({&scene, &mesh, material.alpha, !material.double_sided});
    state.has_blending |= material.alpha == Material::Alpha::blend;
  }
  state.geometries.resize(scene.meshes.size());
  state.trees.resize(scene.meshes.size());
  for (size_t m = 0; m < scene.meshes.size(); ++m) state.build(m);
}

EmbreeScene::~EmbreeScene() = default;
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;

bool EmbreeScene::has_blending() const { return state_->has_blending; }

void EmbreeScene::update(const SceneChanges& changes) {
  for (const int mesh : changes.deformed) state_->build(size_t(mesh));
}

void EmbreeScene::set_view(const glm::dmat4& worldFromCamera) {
  State& state = *state_;
  const glm::dmat4 cameraFromWorld = glm::inverse(worldFromCamera);
  state.top = state.new_tree();
  state.instances.clear();
  state.objectFromCamera.clear();
  for (const Instance& instance : state.scene->instances) {
    state.instances.emplace_back(rtcNewGeometry(state.device, RTC_GEOMETRY_TYPE_INSTANCE));
    RTCGeometry geometry = state.instances.back();
    rtcSetGeometryInstancedScene(geometry, state.trees[size_t(instance.mesh)]);
    const glm::mat4 cameraFromObject(cameraFromWorld * instance.worldFromObject);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &cameraFromObject[0][0]);
    state.objectFromCamera.emplace_back(glm::inverse(glm::dmat3(cameraFromWorld * instance.worldFromObject)));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(state.top, geometry, unsigned(state.instances.size() - 1));
  }
  rtcCommitScene(state.top);
}

void EmbreeScene::nearest(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions, int width,
                          Solid solid, std::span<RayHit> hits) const {
  const auto height = int(directions.size() / size_t(width));
  const auto trace_block = [&](int x0, int y0) {
    alignas(64) RTCRayHit16 packet;
    alignas(64) int valid[16];
    const auto reset = [&](int lane) {
      const int x = x0 + lane % block, y = y0 + lane / block;
      const size_t pixel = size_t(std::min(y, height - 1)) * size_t(width) + size_t(std::min(x, width - 1));
      const glm::vec3 direction = directions[pixel], origin = at(origins, pixel);
      packet.ray.org_x[lane] = origin.x;
      packet.ray.org_y[lane] = origin.y;
      packet.ray.org_z[lane] = origin.z;
      packet.ray.dir_x[lane] = direction.x;
      packet.ray.dir_y[lane] = direction.y;
      packet.ray.dir_z[lane] = direction.z;
      packet.ray.tnear[lane] = 0.0f;
      packet.ray.tfar[lane] = infinity;
      packet.ray.time[lane] = 0.0f;
      packet.ray.mask[lane] = ~0u;
      packet.ray.flags[lane] = 0;
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      return x < width && y < height && direction != glm::vec3(0.0f);
    };
    for (int lane = 0; lane < 16; ++lane) valid[lane] = reset(lane) ? -1 : 0;
    Query query = make_query(solid, RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcIntersect16(valid, state_->top, &query.context, &packet);

    // Asking for every candidate whether it stops its ray would be slow, and most nearest hits do stop it: only rays
    // whose nearest hit does not are traced again with the question.
    alignas(64) int again[16];
    bool any_again = false;
    for (int lane = 0; lane < 16; ++lane) {
      again[lane] = 0;
      if (!valid[lane] || packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
      const Instance& instance = state_->scene->instances[packet.hit.instID[0][lane]];
      const glm::vec3 normal(packet.hit.Ng_x[lane], packet.hit.Ng_y[lane], packet.hit.Ng_z[lane]);
      const glm::vec3 direction(packet.ray.dir_x[lane], packet.ray.dir_y[lane], packet.ray.dir_z[lane]);
      const glm::mat3& objectFromCamera = state_->objectFromCamera[packet.hit.instID[0][lane]];
      const Candidate candidate{packet.hit.primID[lane], packet.hit.u[lane], packet.hit.v[lane],
                                glm::dot(objectFromCamera * direction, normal)};
      if (stops(state_->meshes[size_t(instance.mesh)], candidate, solid)) continue;
      again[lane] = reset(lane) ? -1 : 0;
      any_again = true;
    }
    if (any_again) {
      query.context.filter = filter;
      rtcIntersect16(again, state_->top, &query.context, &packet);
    }
    for (int lane = 0; lane < 16; ++lane) {
      const int x = x0 + lane % block, y = y0 + lane / block;
      if (x >= width || y >= height) continue;
      RayHit& hit = hits[size_t(y) * size_t(width) + size_t(x)];
      if (!valid[lane] || packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) {
        hit = {~0u, ~0u, infinity};
        continue;
      }
      const uint32_t instance = packet.hit.instID[0][lane];
      hit = {state_->scene->instances[instance].first_triangle + packet.hit.primID[lane], instance,
             packet.ray.tfar[lane]};
    }
  };
  tbb::parallel_for(tbb::blocked_range2d<int>(0, (height + block - 1) / block, 4, 0, (width + block - 1) / block, 4),
                    [&](const tbb::blocked_range2d<int>& blocks) {
                      for (int by = blocks.rows().begin(); by < blocks.rows().end(); ++by) {
                        for (int bx = blocks.cols().begin(); bx < blocks.cols().end(); ++bx) {
                          trace_block(bx * block, by * block);
                        }
                      }
                    });
}

std::vector<std::vector<RayHit>> EmbreeScene::blended(std::span<const glm::vec3> origins,
                                                      std::span<const glm::vec3> directions,
                                                      std::span<const RayHit> limits) const {
  std::vector<std::vector<RayHit>> found(directions.size());
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, directions.size(), 256), [&](const tbb::blocked_range<size_t>& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) {
          if (directions[i] == glm::vec3(0.0f)) continue;
          const glm::vec3 origin = at(origins, i);
          RTCRayHit ray{};
          ray.ray = {
              origin.x,           origin.y, origin.z, 0.0f, directions[i].x, directions[i].y, directions[i].z, 0.0f,
              limits[i].distance, ~0u,      0,        0};
          ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
          Query query = make_query(Solid::opaque, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
          query.context.filter = filter;
          query.collected = &found[i];
          rtcIntersect1(state_->top, &query.context, &ray);
          const auto order = [](const RayHit& a, const RayHit& b) {
            return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
          };
          std::sort(found[i].begin(), found[i].end(), order);
          // Embree may offer a triangle twice where its tree splits it.
          const auto same = [](const RayHit& a, const RayHit& b) { return a.triangle == b.triangle; };
          found[i].erase(std::unique(found[i].begin(), found[i].end(), same), found[i].end());
        }
      });
  return found;
}

}  // namespace omma
