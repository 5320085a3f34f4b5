// Objects that are blocked by themselves alone (--own-object).
#pragma once

#include <memory>

#include "cli/method_options.h"
#include "method/method.h"

namespace lkao::cli {

// Answers a receiver by `method` as if there were nothing but its object of the task's mesh (Mesh::objects), whose
// number it has as Receiver::excluded_instance (bake/surface_receiver.h). It prepares a method for each object, which
// must be able to answer from several threads at once, as the traversal is.
std::unique_ptr<method::Method> open_for_objects(const MethodOptions& method);

}  // namespace lkao::cli
