// Reading of a model file by Assimp, and its conversion.
#pragma once
#include "content/models/model.h"

#include <filesystem>
#include <string>

namespace lfdsim::reader {

/// Returns a file's model. `up`: "y" or "z", the file's axis that points up; "" by format. Throws std::runtime_error, which says
/// what is wrong.
Model import(const std::filesystem::path& file, const std::string& up);

}  // namespace lfdsim::reader
