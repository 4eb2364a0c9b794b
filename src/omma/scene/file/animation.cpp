// Animations of a file: assimp's ticks become seconds.
#include <algorithm>
#include <cmath>

#include "omma/scene/file/import.h"

namespace omma::file {
namespace {

bool finite(const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); }
bool finite(const glm::dquat& q) {
  const double length = glm::length(q);
  return std::isfinite(length) && length > 0.0;
}
bool finite(const std::vector<float>& weights) {
  return std::all_of(weights.begin(), weights.end(), [](float w) { return std::isfinite(w); });
}

/// Keys in the order of time, without those that are not finite.
template <typename T>
Keys<T> sorted(std::vector<std::pair<double, T>> keys) {
  std::erase_if(keys, [](const auto& key) { return !std::isfinite(key.first) || !finite(key.second); });
  std::stable_sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Keys<T> result;
  for (auto& [time, value] : keys) {
    result.times.push_back(time);
    result.values.push_back(std::move(value));
  }
  return result;
}

Keys<glm::dvec3> import_keys(const aiVectorKey* source, unsigned count, double seconds_per_tick) {
  std::vector<std::pair<double, glm::dvec3>> keys;
  for (unsigned i = 0; i < count; ++i) {
    keys.emplace_back(source[i].mTime * seconds_per_tick, to_dvec3(source[i].mValue));
  }
  return sorted(std::move(keys));
}

Keys<glm::dquat> import_keys(const aiQuatKey* source, unsigned count, double seconds_per_tick) {
  std::vector<std::pair<double, glm::dquat>> keys;
  for (unsigned i = 0; i < count; ++i) {
    keys.emplace_back(source[i].mTime * seconds_per_tick, to_dquat(source[i].mValue));
  }
  Keys<glm::dquat> result = sorted(std::move(keys));
  for (glm::dquat& rotation : result.values) rotation = glm::normalize(rotation);
  return result;
}

template <typename T>
double last_time(const Keys<T>& keys) {
  return keys.times.empty() ? 0.0 : keys.times.back();
}

Keys<std::vector<float>> import_weights(const aiMeshMorphAnim& source, double seconds_per_tick) {
  std::vector<std::pair<double, std::vector<float>>> keys;
  for (unsigned i = 0; i < source.mNumKeys; ++i) {
    const aiMeshMorphKey& key = source.mKeys[i];
    std::vector<float> weights;
    for (unsigned k = 0; k < key.mNumValuesAndWeights; ++k) {
      const unsigned target = key.mValues[k];
      if (target >= 65536) continue;
      if (weights.size() <= target) weights.resize(target + 1, 0.0f);
      weights[target] = static_cast<float>(key.mWeights[k]);
    }
    keys.emplace_back(key.mTime * seconds_per_tick, std::move(weights));
  }
  return sorted(std::move(keys));
}

}  // namespace

void import_animations(Import& import) {
  for (unsigned a = 0; a < import.source.mNumAnimations; ++a) {
    const aiAnimation& source = *import.source.mAnimations[a];
    // assimp leaves the rate at 0 where a file has none, and 25 is what its own viewer takes.
    const double rate =
        source.mTicksPerSecond > 0.0 && std::isfinite(source.mTicksPerSecond) ? source.mTicksPerSecond : 25.0;
    Animation animation;
    animation.name = source.mName.C_Str();
    for (unsigned c = 0; c < source.mNumChannels; ++c) {
      const aiNodeAnim& channel = *source.mChannels[c];
      const auto node = import.node_of_name.find(channel.mNodeName.C_Str());
      if (node == import.node_of_name.end()) {
        ++import.repairs.channels_without_node;
        continue;
      }
      NodeAnimation moved;
      moved.node = node->second;
      moved.translation = import_keys(channel.mPositionKeys, channel.mNumPositionKeys, 1.0 / rate);
      moved.rotation = import_keys(channel.mRotationKeys, channel.mNumRotationKeys, 1.0 / rate);
      moved.scale = import_keys(channel.mScalingKeys, channel.mNumScalingKeys, 1.0 / rate);
      // The declared duration is missing or wrong in some files; the last key never is.
      animation.duration = std::max(
          {animation.duration, last_time(moved.translation), last_time(moved.rotation), last_time(moved.scale)});
      animation.nodes.push_back(std::move(moved));
    }
    for (unsigned c = 0; c < source.mNumMorphMeshChannels; ++c) {
      const aiMeshMorphAnim& channel = *source.mMorphMeshChannels[c];
      // FBX and Collada put "*" and a number behind the node's name.
      const std::string name = channel.mName.C_Str();
      const auto node = import.node_of_name.find(name.substr(0, name.find('*')));
      if (node == import.node_of_name.end()) {
        ++import.repairs.channels_without_node;
        continue;
      }
      MorphAnimation morph{node->second, import_weights(channel, 1.0 / rate)};
      if (morph.weights.times.empty()) continue;
      animation.duration = std::max(animation.duration, last_time(morph.weights));
      animation.morphs.push_back(std::move(morph));
    }
    import.scene.animations.push_back(std::move(animation));
  }
}

}  // namespace omma::file
