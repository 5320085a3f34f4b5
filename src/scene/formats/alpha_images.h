// Images whose alpha a file's materials show, and what is wrong with some of them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scene/holes.h"

namespace lkao::scene {

class AlphaImages {
 public:
  // It must outlive them.
  explicit AlphaImages(const DecodeAlpha& decode) : decode_(decode) {}

  // Whether anything is read at all.
  bool is_reading() const { return static_cast<bool>(decode_); }

  // What `bytes` returns, decoded; `name` and the material's are for messages. Null, and a remark, where either throws
  // std::runtime_error: then the material counts as opaque.
  std::shared_ptr<const AlphaImage> read(const std::string& name, const std::string& material, AlphaOf what,
                                         const std::function<std::string()>& bytes);

  // A line for each that could not be read, but for those after a few.
  std::vector<std::string> remarks() const;

 private:
  const DecodeAlpha& decode_;
  std::vector<std::string> faults_;
};

}  // namespace lkao::scene
