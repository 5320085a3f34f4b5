// The words of the OpenGL side's enums.
#pragma once

#include "lkao/gl.h"
#include "method/words.h"

namespace lkao::method {

inline constexpr Word<gl::Device> kDeviceWords[] = {
    {"software", gl::Device::software}, {"hardware", gl::Device::hardware}, {"auto", gl::Device::automatic}};

inline constexpr Word<gl::GeometryBackEnd> kGeometryWords[] = {
    {"vertex_pulling", gl::GeometryBackEnd::vertex_pulling}, {"geometry_shader", gl::GeometryBackEnd::geometry_shader}};

inline constexpr Word<gl::Accumulator> kAccumulatorWords[] = {{"logic_op", gl::Accumulator::logic_op},
                                                              {"ssbo", gl::Accumulator::ssbo}};

}  // namespace lkao::method
