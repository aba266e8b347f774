#include "grove/scene/gltf/animations.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "grove/base/error.h"
#include "grove/scene/gltf/accessors.h"

namespace grove {
namespace {

std::optional<std::size_t> number_of(const std::string& text) {
  std::size_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

std::size_t choose_animation(const JsonCursor& animations, const std::string& choice, const std::string& file) {
  if (choice.empty()) return 0;
  std::string names;
  for (std::size_t i = 0; i < animations.size(); ++i) {
    const std::string name = animations.element(i)["name"].text();
    if (name == choice) return i;
    names += names.empty() ? "" : ", ";
    names += std::to_string(i);
    if (!name.empty()) names += " '" + name + "'";
  }
  const std::optional<std::size_t> number = number_of(choice);
  if (number && *number < animations.size()) return *number;
  throw UsageError("--animation: " + file + " has no animation '" + choice + "'; " +
                   (names.empty() ? "it has none at all" : "there are " + names));
}

/// Keyframes as the file has them, all numbers in one row.
struct RawTrack {
  std::vector<float> times;
  std::vector<float> values;
};

template <typename Vector>
std::vector<float> flatten(const std::vector<Vector>& vectors) {
  constexpr int kWidth = Vector::length();
  std::vector<float> values;
  values.reserve(vectors.size() * kWidth);
  for (const Vector& v : vectors) {
    for (int i = 0; i < kWidth; ++i) values.push_back(v[i]);
  }
  return values;
}

class AnimationReader {
 public:
  AnimationReader(GltfDocument& document, const GltfNodes& nodes, Scene& scene) : document_(document), nodes_(nodes), scene_(scene) {}

  SceneAnimation read(const JsonCursor& source) {
    SceneAnimation animation;
    animation.name = source["name"].text();
    const JsonCursor channels = source["channels"];
    animation.channels.reserve(channels.size());
    for (std::size_t i = 0; i < channels.size(); ++i) add_channel(channels.element(i), source["samplers"], animation.channels);
    bool is_first = true;
    for (const AnimationChannel& channel : animation.channels) {
      const double first = channel.track.times.front();
      const double last = channel.track.times.back();
      animation.begin = is_first ? first : std::min(animation.begin, first);
      animation.end = is_first ? last : std::max(animation.end, last);
      is_first = false;
    }
    return animation;
  }

 private:
  void warn(const char* kind, const std::string& what, const JsonCursor& place) {
    if (document_.is_first(kind)) scene_.warn(what + ", such as " + place.path());
  }

  void add_channel(const JsonCursor& channel, const JsonCursor& samplers, std::vector<AnimationChannel>& channels) {
    const JsonCursor target = channel["target"];
    AnimationChannel result;
    const std::string path = target["path"].text();
    if (path == "translation") {
      result.target = ChannelTarget::translation;
    } else if (path == "rotation") {
      result.target = ChannelTarget::rotation;
    } else if (path == "scale") {
      result.target = ChannelTarget::scale;
    } else if (path == "weights") {
      result.target = ChannelTarget::weights;
    } else {
      warn("channel path", "animation channels of what is not translation, rotation, scale or weights are left out", target);
      return;
    }
    const JsonCursor node = target["node"];
    if (!node.exists() || node.whole() >= nodes_.tree.size()) {
      warn("channel node", "animation channels to nodes that are not there are left out", target);
      return;
    }
    result.node = static_cast<std::uint32_t>(node.whole());
    if (result.target != ChannelTarget::weights && nodes_.tree.rest[result.node].matrix) {
      warn("channel matrix", "animation channels to nodes that have a matrix are left out", target);
      return;
    }
    const JsonCursor sampler_id = channel["sampler"];
    if (!sampler_id.exists() || sampler_id.whole() >= samplers.size()) {
      warn("channel sampler", "animation channels without a sampler are left out", channel);
      return;
    }
    if (read_track(samplers.element(sampler_id.whole()), result)) channels.push_back(std::move(result));
  }

  bool read_track(const JsonCursor& sampler, AnimationChannel& channel) {
    KeyframeTrack& track = channel.track;
    const std::string interpolation = sampler["interpolation"].text("LINEAR");
    if (interpolation == "STEP") {
      track.interpolation = Interpolation::step;
    } else if (interpolation == "CUBICSPLINE") {
      track.interpolation = Interpolation::cubic_spline;
    } else if (interpolation != "LINEAR") {
      warn("interpolation", "interpolation that is none of STEP, LINEAR and CUBICSPLINE is taken as LINEAR", sampler);
    }
    if (!sampler["input"].exists() || !sampler["output"].exists()) {
      warn("missing times", "animation samplers without times or values are left out", sampler);
      return false;
    }
    const GltfAccessors accessors(document_);
    RawTrack raw{accessors.scalars(sampler["input"]), read_values(accessors, sampler["output"], channel)};
    const std::size_t parts = track.interpolation == Interpolation::cubic_spline ? 3 : 1;
    if (channel.target == ChannelTarget::weights) {
      track.width = static_cast<std::uint32_t>(raw.times.empty() ? 0 : raw.values.size() / (raw.times.size() * parts));
    }
    const std::size_t stride = track.width * parts;
    const std::size_t usable = stride == 0 ? 0 : std::min(raw.times.size(), raw.values.size() / stride);
    if (usable != raw.times.size() || usable * stride != raw.values.size()) {
      warn("keyframe count", "animation samplers with more times than values, or fewer, are cut to what they have of both", sampler);
    }
    document_.charge(raw.values.size() * sizeof(float), sampler);
    keep_keyframes(raw, usable, stride, sampler, track);
    return !track.times.empty();
  }

  static std::vector<float> read_values(const GltfAccessors& accessors, const JsonCursor& output, AnimationChannel& channel) {
    if (channel.target == ChannelTarget::weights) return accessors.scalars(output);
    channel.track.is_rotation = channel.target == ChannelTarget::rotation;
    channel.track.width = channel.track.is_rotation ? 4 : 3;
    return channel.track.is_rotation ? flatten(accessors.vec4s(output)) : flatten(accessors.vec3s(output));
  }

  // Takes over the keyframes that are in order and finite, and those that can be put in order.
  void keep_keyframes(const RawTrack& raw, std::size_t usable, std::size_t stride, const JsonCursor& sampler, KeyframeTrack& track) {
    const auto values_of = [&](std::size_t key) { return std::span(raw.values).subspan(key * stride, stride); };
    std::vector<std::size_t> keys;
    keys.reserve(usable);
    for (std::size_t key = 0; key < usable; ++key) {
      const bool is_finite = std::isfinite(raw.times[key]) && std::ranges::all_of(values_of(key), [](float x) { return std::isfinite(x); });
      if (is_finite) keys.push_back(key);
    }
    if (keys.size() != usable) warn("infinite keyframes", "keyframes that are not finite are left out", sampler);
    const auto time_of = [&](std::size_t key) { return raw.times[key]; };
    if (!std::ranges::is_sorted(keys, {}, time_of)) {
      warn("unsorted keyframes", "keyframes whose times do not ascend are sorted", sampler);
      std::ranges::stable_sort(keys, {}, time_of);
    }
    track.times.reserve(keys.size());
    track.values.reserve(keys.size() * stride);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (i + 1 < keys.size() && time_of(keys[i]) == time_of(keys[i + 1])) {
        warn("repeated keyframes", "of keyframes at the same time the last is taken", sampler);
        continue;
      }
      track.times.push_back(time_of(keys[i]));
      const auto values = values_of(keys[i]);
      track.values.insert(track.values.end(), values.begin(), values.end());
    }
    if (track.times.empty()) warn("no keyframes", "animation samplers without a usable keyframe are left out", sampler);
  }

  GltfDocument& document_;
  const GltfNodes& nodes_;
  Scene& scene_;
};

}  // namespace

std::optional<SceneAnimation> read_animation(GltfDocument& document, const GltfNodes& nodes, const std::string& choice, Scene& scene) {
  const JsonCursor animations = document.array("animations");
  const std::size_t number = choose_animation(animations, choice, document.file());
  if (animations.size() == 0) return std::nullopt;
  return AnimationReader(document, nodes, scene).read(animations.element(number));
}

}  // namespace grove
