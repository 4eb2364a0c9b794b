#include "omma/technique/sample_places.h"

#include "omma/technique/target.h"

namespace omma {

namespace {

std::vector<glm::ivec2> ask_for_places(int samples) {
  // Asked of a framebuffer of its own: what is bound may be anything, and stays bound.
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  static constexpr Channel channels[] = {Channel::color};
  const Target target(ImageSize{1, 1}, channels, samples);
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  // A driver may have more samples than it was asked for.
  GLint given = 0;
  glGetIntegerv(GL_SAMPLES, &given);
  std::vector<glm::ivec2> places;
  for (int s = 0; s < given; ++s) {
    glm::vec2 place;
    glGetMultisamplefv(GL_SAMPLE_POSITION, GLuint(s), &place.x);
    places.emplace_back(glm::round(place * float(sample_parts)));
  }
  glBindFramebuffer(GL_FRAMEBUFFER, GLuint(bound));
  return places;
}

}  // namespace

std::span<const glm::ivec2> SamplePlaces::of(int samples) {
  if (samples <= 1) return one_sample_place;
  std::vector<glm::ivec2>& places = known_[samples];
  if (places.empty()) places = ask_for_places(samples);
  return places;
}

}  // namespace omma
