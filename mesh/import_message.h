#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/import.h"

namespace rinkaku::mesh {

/// Why the import worker could not read a file.
struct ImportFailure {
  std::string what;
  std::string remedy;
};

/// What the import worker tells the program on its pipe: the mesh, or why there is none. Both sides run on one machine
/// and come from one build, so numbers are stored as they lie in memory.
std::vector<std::uint8_t> encode(const Imported& imported);
std::vector<std::uint8_t> encode(const ImportFailure& failure);

struct ImportMessage {
  std::optional<Imported> imported;      ///< either this
  std::optional<ImportFailure> failure;  ///< or this
};

/// Reads such a message. The sender may have been led astray by the file it read, so nothing is taken on trust: every
/// length is checked against the bytes there are, every index against what it names, every number for being finite.
/// Empty if anything is wrong, or the message is not whole.
std::optional<ImportMessage> decode(std::span<const std::uint8_t> bytes);

}  // namespace rinkaku::mesh
