// Settings as options of a command line.
#pragma once

#include <vector>

#include "method/list.h"
#include "method/settings.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lkao::method {

// A value that the setting does not take is an error that names the option. `settings` must outlive the parsing.
CLI::Option* add_setting_option(CLI::App& app, Settings& settings, const Setting& setting);

// An option for every setting that one of these methods has, in groups that name the methods.
void add_setting_options(CLI::App& app, Settings& settings, const std::vector<const MethodKind*>& kinds);

}  // namespace lkao::method
