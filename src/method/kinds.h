// What each method's file gives to the list: all of a MethodKind but its word.
#pragma once

#include "method/method.h"

namespace lkao::method {

MethodKind traversal_kind();
MethodKind embree_kind();
// By OpenGL.
MethodKind masks_kind();
MethodKind volumes_kind();
MethodKind splat_kind();
MethodKind alchemy_kind();
MethodKind vao_kind();
MethodKind gtao_kind();
MethodKind vbao_kind();

}  // namespace lkao::method
