#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rinkaku::track {

/// The marker dictionaries, named as OpenCV's aruco module names them without "DICT_": "4X4_50", "ARUCO_ORIGINAL",
/// "APRILTAG_36h11". The index is OpenCV's number of the dictionary.
const std::vector<std::string>& dictionary_names();

/// How many markers a dictionary has; ids run from 0. Throws Error (Input), naming `where` and the nearest name, if
/// there is no such dictionary.
int dictionary_size(std::string_view where, std::string_view dictionary);

/// Throws Error (Input), naming `where`, unless the dictionary exists and has this id.
void check_marker(std::string_view where, std::string_view dictionary, int id);

}  // namespace rinkaku::track
