// Which Embree the program measures against and finds its camera rays with.
#pragma once

namespace lkao::scene {

// Of the headers that it was compiled with, "3.13.5".
const char* embree_version();

}  // namespace lkao::scene
