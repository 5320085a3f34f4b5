// AO radii of a speed comparison.
#pragma once

#include <vector>

#include "bench/study_scenes.h"

namespace lkao::bench {

// Longer than the diagonal of the mesh's bounds: no ray of a receiver on the mesh ends inside them.
bool is_unbounded(float radius, const scene::Mesh& mesh);

// The scene's own and infinity, or its own alone where one of these is unbounded already.
std::vector<float> compared_radii(const StudyScene& scene);

}  // namespace lkao::bench
