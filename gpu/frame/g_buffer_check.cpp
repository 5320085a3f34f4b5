#include "gpu/frame/g_buffer_check.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <stdexcept>

#include "gpu/frame/check_block.h"
#include "gpu/frame/g_buffer.h"
#include "gpu/frame/texture_checks.h"
#include "gpu/gl/error.h"
#include "lut/ray_options.h"

namespace lkao::gl {
namespace {

struct Results {
  LKAO_CHECK_RESULTS
};

bool are_most(std::uint32_t count, const Results& results) { return 2 * count > results.receiver_count; }

void require_hits(const Results& results, PositionSpace space) {
  if (results.receiver_count == 0 || are_most(results.hit_count, results)) return;
  const bool is_view = space == PositionSpace::view;
  const char *name = is_view ? "view" : "world", *other = is_view ? "world" : "view";
  const std::string likely =
      are_most(results.other_space_hit_count, results)
          ? fmt::format("they are not in {} space; they fit {} space: set position_space", name, other)
      : are_most(results.flipped_hit_count, results)
          ? "they fit a picture whose rows run downwards: turn camera.projection upside down"
          : fmt::format("they fit neither space as the camera sees them, nor upside down; said is {} space", name);
  throw std::invalid_argument(fmt::format("positions miss their pixels by more than two in {} of {} tried: {}",
                                          results.receiver_count - results.hit_count, results.receiver_count, likely));
}

}  // namespace

GBufferCheck::Kind GBufferCheck::kind_of(const GBuffer& g_buffer) {
  return {.place_format = format_of(place_of(g_buffer)),
          .normal_format = format_of(g_buffer.normals),
          .geometric_normal_format = g_buffer.geometric_normals != 0 ? format_of(g_buffer.geometric_normals) : 0,
          .has_positions = g_buffer.positions != 0,
          .has_depth = g_buffer.depth != 0,
          .position_space = g_buffer.position_space,
          .normal_space = g_buffer.normal_space,
          .normal_encoding = g_buffer.normal_encoding};
}

void GBufferCheck::look_at(const GBuffer& g_buffer) {
  const Kind kind = kind_of(g_buffer);
  if (checked_ == kind) return;
  checked_.reset();
  largest_error_ = largest_texel_ = 0;
  if (!program_) {
    program_ = make_program({"frame/check.comp"});
    results_ = make_buffer(sizeof(Results), nullptr, GL_DYNAMIC_STORAGE_BIT);
  }
  Results results{};
  glNamedBufferSubData(results_.name(), 0, sizeof(results), &results);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, results_.name());
  glUseProgram(program_.name());
  glDispatchCompute(LKAO_CHECKED_SIDE / 8, LKAO_CHECKED_SIDE / 8, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(results_.name(), 0, sizeof(results), &results);
  check_errors("checking a G-buffer");
  if (g_buffer.positions != 0) require_hits(results, g_buffer.position_space);
  largest_error_ = std::bit_cast<float>(results.largest_error_bits);
  largest_texel_ = std::bit_cast<float>(results.largest_texel_bits);
  has_half_positions_ = g_buffer.positions != 0 && steps_of(g_buffer.positions).relative > 0x1p-20f;
  if (results.receiver_count > 0) checked_ = kind;
}

std::vector<std::string> GBufferCheck::remarks(const RayOptions& options) const {
  std::vector<std::string> remarks;
  if (!checked_) return remarks;
  if (has_half_positions_) {
    remarks.push_back(
        fmt::format("positions of half floats are off by up to {:.2g}, at the edges of surfaces too: 32-bit "
                    "floats, depth or linear depth are better",
                    largest_texel_));
  }
  const float radius = options.radius;
  if (lut::has_automatic_offset(options) && std::isfinite(radius) && largest_error_ > radius / 16) {
    remarks.push_back(
        fmt::format("{} may be off by {:.2g}, so receivers start that far off their surfaces, up to a quarter "
                    "of the AO radius of {:.2g}: contact is lost",
                    checked_->has_positions ? "positions"
                    : checked_->has_depth   ? "depth"
                                            : "linear_depth",
                    largest_error_, radius));
  }
  return remarks;
}

}  // namespace lkao::gl
