// OpenGL's errors as exceptions.
#pragma once

#include "lkao/gl/status.h"

namespace lkao::gl {

// Throws std::runtime_error, one line with the error's name, where OpenGL has noted an error since the last call.
// `doing` ends the sentence "OpenGL error ... while ...".
void check_errors(const char* doing);

// True where a context is current in this thread. Epoxy aborts where OpenGL is called without one.
bool has_context();

// Throws where no context is current, or one that is older than OpenGL 4.5.
void require_context();

// Before each call of a pass: a context, and no error of somebody else's that would be taken for one of ours.
void require_clean_context(HostErrors host_errors = HostErrors::reported);

}  // namespace lkao::gl
