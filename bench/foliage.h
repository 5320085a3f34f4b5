// Plants as games and films have them: cards, on which a texture shows leaves.
#pragma once

#include <string>
#include <vector>

#include "bench/study_scenes.h"

namespace lkao::bench {

// "card": a single card over a ground; "grass": tufts of three crossed cards; "trees": crowns of cards around trunks.
const std::vector<std::string>& foliage_names();

// One of them, with its view of that size. The same on every machine.
StudyScene make_foliage(const std::string& name, int width, int height);

}  // namespace lkao::bench
