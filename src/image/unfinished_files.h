// The table of files to remove when the program is interrupted: plain storage that a signal handler may walk.
#pragma once

#include <string>

namespace lkao::image {

// Enters a path; remove_unfinished_files() (atomic_file.h) will remove it until it is forgotten. Any thread.
// Returns its slot, or -1 where the table is full or the path is too long for the system.
int remember_unfinished_file(const std::string& path);

// Takes the path out again, without touching the file.
void forget_unfinished_file(int slot);

}  // namespace lkao::image
