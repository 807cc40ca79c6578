#pragma once

#include <string>
#include <utility>
#include <vector>

namespace rinkaku::report {

/// What a reader must know of the machine to judge times: processor, cores, memory, load, system, what OpenGL draws
/// with, and the versions of libraries and programs at work. Name and value each.
std::vector<std::pair<std::string, std::string>> machine_facts();

}  // namespace rinkaku::report
