// Rays of the falloffs that methods have of their own.
//
// Numbers of equations are of M. McGuire et al., "The Alchemy Screen-Space Ambient Obscurance Algorithm", HPG 2011; the
// ball is that of L. Szirmay-Kalos et al., "Volumetric Ambient Occlusion for Real-Time Rendering and Games", IEEE
// Computer Graphics and Applications 30(1), 2010, on which VAO++ is built.
//
// Rays cannot tell all: Alchemy looks at pixels evenly on the screen where Eq. 9 has directions, and so counts what
// faces the eye for more; VAO counts what is free along lines of view, not from the receiver. That is left in the
// difference.
#pragma once

#include <vector>

#include "bench/report/contestants.h"
#include "lkao/sample_pattern.h"

namespace lkao::bench {

// 1024 rays; the share of them that is blocked is what occlusion_of() takes. Of Alchemy, where few rays count for much,
// others for each seed.
SamplePattern pattern_of(OwnFalloff falloff, int seed);

// Of these shares.
std::vector<float> occlusion_of(OwnFalloff falloff, std::vector<float> blocked_shares);

}  // namespace lkao::bench
