// Where tests find files and the tool. In a source of its own, so that no other test's code depends on where the
// checkout lies and a compiler cache serves them all.
#pragma once

namespace omma::places {

extern const char* const source;        ///< the checkout
extern const char* const test_models;   ///< where Debian's assimp-testmodels lie; may be absent
extern const char* const shared_data;   ///< real scenes and calibrations; may be absent
extern const char* const tool;          ///< the program `omma`
extern const char* const image_output;  ///< where image tests put what they drew

}  // namespace omma::places
